"""Linkages of the independent check: machines, and what they do at eight positions and over a whole turn.

Two ways that share no formula agree on the numbers to 4e-29 at 50 digits: Newton's method on all joint
equations with central differences, and closed forms.
"""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Pose, Prismatic, Revolute
from mechwright.mechanics.planar.rigid import Turning

REFERENCE: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "linkages.json").read_text(encoding="utf-8")
)
LINKAGES: dict[str, Any] = REFERENCE["linkages"]
FIGURES: dict[str, Any] = REFERENCE["figures"]


@dataclass(frozen=True)
class Case:
    """A linkage of the reference: its machine with drawn poses of the first position, and its inputs."""

    table: dict[str, Any]
    machine: Machine
    inputs: list[Turning]

    @property
    def positions(self) -> list[dict[str, Any]]:
        return self.table["positions"]

    def joint(self, pin: str) -> Revolute | None:
        """A revolute at a pin; None where the reference has none."""
        found = (joint for joint in self.machine.joints if joint.name.split(":")[0] == pin)
        return next((joint for joint in found if isinstance(joint, Revolute)), None)

    def slide(self, name: str) -> Prismatic:
        return next(joint for joint in self.machine.joints if joint.name == name)

    def place(self, link: str, point: str) -> complex:
        return complex(*self.table["links"][link][point])


def case(name: str) -> Case:
    """A linkage of the reference by its name."""
    return case_of(LINKAGES[name])


def case_of(table: dict[str, Any]) -> Case:
    """A linkage of the reference."""
    links = {
        link: {at: complex(*place) for at, place in places.items()} for link, places in table["links"].items()
    }
    joints = [_joint(one, links) for one in table["joints"]]
    drives = [Drive(one["link"], one["on"]) for one in table["drivers"]]
    inputs = [_law(one["law"], np.array(table["times"])) for one in table["drivers"]]
    first = table["positions"][0]
    poses = {link: _near(link, joints, first) for link in links if link != "ground" and "search" in table}
    machine = Machine(joints, drives, _branches(table, joints), poses, [inputs[0].theta[0]])
    return Case(table, machine, inputs)


def _joint(one: dict[str, Any], links: dict[str, dict[str, complex]]) -> Revolute | Prismatic | GearPair:
    if one["type"] == "R":
        a, b = one["links"]
        return Revolute(f"{one['at']}:{a}/{b}", a, b, links[a][one["at"]], links[b][one["at"]])
    if one["type"] == "G":
        return GearPair(one["name"], *one["links"], one["carrier"], one["ratio"], one["phase"])
    line, block = one["line"], one["block"]
    places = links[line["link"]][line["point"]], links[block["link"]][block["point"]]
    return Prismatic(one["name"], line["link"], block["link"], *places, line["angle"], block["angle"])


def _law(coefficients: list[float], time: np.ndarray) -> Turning:
    a, b, c, d = (*coefficients, 0.0, 0.0, 0.0)[:4]
    theta = a + b * time + c * time**2 / 2 + d * time**3 / 6
    return Turning.of(theta, b + c * time + d * time**2 / 2, c + d * time, d)


def _branches(table: dict[str, Any], joints: list[Any]) -> dict[str, int]:
    """The reference's signs are of its own order of the two links; ours of the inner joint's."""
    signs = {}
    for kind, *group in table.get("groups") or table["search"]["groups"]:
        if kind not in {"RRR", "RRP", "RPR"}:
            continue
        one, two, sign = group[0], group[2], group[-1]
        if kind == "RPR":
            inner = next(joint for joint in joints if joint.name == group[4])
        else:
            inner = next(
                joint for joint in joints if joint.name[0].isalpha() and set(joint.links) == {one, two}
            )
        signs[inner.name] = -sign if inner.links != (one, two) and kind != "RRP" else sign
    return signs


def _near(link: str, joints: list[Any], position: dict[str, Any]) -> Pose:
    """Some hundredths of a millimetre from where a link is at a position."""
    angle = position["angle"][link]
    joint = next(one for one in joints if isinstance(one, Revolute) and link in one.links)
    origin = complex(*position["joints"][joint.name.split(":")[0]]) - joint.place(link) * np.exp(1j * angle)
    return Pose(origin + 0.01, angle + 0.001)
