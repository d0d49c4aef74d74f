"""The linkages of the reference as machines, with their inputs at eight times."""

import json
from pathlib import Path

import numpy as np

from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Pose, Prismatic, Revolute

FILE = json.loads((Path(__file__).parent / "linkages.json").read_text())
LINKAGES = FILE["linkages"]
FIGURES = FILE["figures"]


def points_of(linkage):
    """Link to its points."""
    return {link: {at: complex(*p) for at, p in own.items()} for link, own in linkage["links"].items()}


def machine_of(linkage):
    """The machine of a linkage; one without an order of dyads is drawn at its first time."""
    points = points_of(linkage)
    joints = [_joint(joint, points) for joint in linkage["joints"]]
    drives = [Drive(drive["link"], drive["on"]) for drive in linkage["drivers"]]
    if "groups" not in linkage:
        first = linkage["positions"][0]
        drawn = {link: _pose(link, joints, first) for link in first["angle"] if link != "ground"}
        return Machine(joints, drives, {}, drawn, first["driver"])
    branches = dict(one for group in linkage["groups"] for one in _branch(group, joints))
    return Machine(joints, drives, branches)


def _joint(joint, points):
    if joint["type"] == "R":
        one, two = joint["links"]
        at = joint["at"]
        return Revolute(f"{at}:{one}/{two}", one, two, points[one][at], points[two][at])
    if joint["type"] == "P":
        line, block = joint["line"], joint["block"]
        places = points[line["link"]][line["point"]], points[block["link"]][block["point"]]
        return Prismatic(joint["name"], line["link"], block["link"], *places, line["angle"], block["angle"])
    return GearPair(joint["name"], *joint["links"], joint["carrier"], joint["ratio"], joint["phase"])


def _branch(group, joints):
    """The inner joint of a dyad and its branch, for the order of links of that joint."""
    kind, *rest = group
    if kind not in {"RRR", "RRP", "RPR"}:
        return
    one, two, branch = rest[0], rest[2], rest[-1]
    sort = Prismatic if kind == "RPR" else Revolute
    inner = next(joint for joint in joints if isinstance(joint, sort) and set(joint.links) == {one, two})
    swapped = kind != "RRP" and inner.links != (one, two)
    yield inner.name, -branch if swapped else branch


def _pose(link, joints, position):
    angle = position["angle"][link]
    pin = next(joint for joint in joints if isinstance(joint, Revolute) and link in joint.links)
    place = complex(*position["joints"][pin.name.split(":")[0]])
    return Pose(place - pin.place(link) * np.exp(1j * angle), angle)


def inputs_of(linkage):
    """The laws of the drives at the times of the reference."""
    t = np.array(linkage["times"])
    found = []
    for drive in linkage["drivers"]:
        a, b, c, d = [*drive["law"], 0.0, 0.0, 0.0][:4]
        found.append(
            Turning.of(a + b * t + c * t**2 / 2 + d * t**3 / 6, b + c * t + d * t**2 / 2, c + d * t, d)
        )
    return found
