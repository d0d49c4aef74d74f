"""A whole mechanism as URDF, a tree of links: each loop is cut at a joint that the file names.

Two empty links mark the place of a cut on both bodies; a simulator that can do it closes the loop there.
Imports the CAD kernel, for masses of what is no plate.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Instance, Part
from mechwright_cad.exporters.simulation.elements import METRES, element, relative, remark, text
from mechwright_cad.exporters.simulation.links import MOMENTS, Link, Linked, linked
from mechwright_cad.exporters.simulation.rotation import roll_pitch_yaw
from mechwright_cad.exporters.simulation.settings import PLAIN, Options

WORLD = "world"
"""The link that stands still."""

NO_LIMIT = 1e4
"""N m, N, rad/s and m/s where nothing limits a joint: readers ask for a number."""

KINDS = {"fixed": "fixed", "prismatic": "prismatic"}


def assembly(
    name: str, parts: Sequence[Part], motion: Motion, sample: int = 0, options: Options = PLAIN
) -> bytes:
    """A mechanism in its pose at one sample of the motion; raises as :func:`linked` does."""
    found = linked(parts, motion, sample, options)
    names = link_names(found)
    root = ET.Element("robot", name=name)
    for sentence in remarks(found, options):
        remark(root, sentence)
    _looks(element(root, "link", name=names[GROUND]), found.ground)
    for link in found.links:
        made = element(root, "link", name=names[link.name])
        if link.inertia is not None:
            _inertial(made, *link.inertia)
        _looks(made, link.looks)
        _joint(root, link, names, found)
    for loop, (_, *ends) in found.loops.items():
        for end in ends:
            mark = f"{loop}-on-{names[end.body]}"
            element(root, "link", name=mark)
            joint = element(root, "joint", name=mark, type="fixed")
            element(joint, "parent", link=names[end.body])
            element(joint, "child", link=mark)
            _origin(joint, end.place)
    ET.indent(root)
    written: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return written + b"\n"


def link_names(found: Linked) -> Mapping[str, str]:
    """Body to the name of its link."""
    bodies = {link.name for link in found.links}
    world = WORLD
    while world in bodies:
        world += "-"
    return {GROUND: world, **{body: body for body in bodies}}


def remarks(found: Linked, options: Options) -> list[str]:
    """What the file says of loops, and of what it leaves out."""
    loops = [
        f"loop joint {name} of {joint.one or WORLD} and {joint.two}: cut, see the links {name}-on-..."
        for name, (joint, *_) in found.loops.items()
    ]
    more = [f"friction of {name}: its loop is cut" for name in found.loops if name in found.friction]
    if any(options.gravity):
        more.append(f"gravity of {text(options.gravity)} m/s^2: it is the simulator's")
    return [*loops, *(f"left out: {one}" for one in (*found.left_out, *more))]


def _inertial(link: ET.Element, mass: float, centre: Array, tensor: Array) -> None:
    made = element(link, "inertial")
    element(made, "origin", xyz=centre, rpy=[0.0, 0.0, 0.0])
    element(made, "mass", value=relative([mass]))
    element(made, "inertia", **{key: relative([float(tensor[at])]) for key, at in MOMENTS.items()})


def _looks(link: ET.Element, looks: Sequence[tuple[Part, Instance, Array]]) -> None:
    for part, at, place in looks:
        visual = element(link, "visual")
        element(visual, "origin", xyz=place, rpy=[0.0, 0.0, 0.0])
        element(element(visual, "geometry"), "mesh", filename=f"{part.name}.stl", scale=[METRES] * 3)
        colour = part.colour_of(at)
        material = element(visual, "material", name="rgb-" + "-".join(f"{one:.3f}" for one in colour))
        element(material, "color", rgba=[*colour, 1.0])


def _joint(root: ET.Element, link: Link, names: Mapping[str, str], found: Linked) -> None:
    kind = link.branch.joint.kind
    told = KINDS.get(kind) or ("continuous" if link.limits is None else "revolute")
    joint = element(root, "joint", name=link.branch.name, type=told)
    element(joint, "parent", link=names[link.parent])
    element(joint, "child", link=names[link.name])
    _origin(joint, link.place)
    if told == "fixed":
        return
    element(joint, "axis", xyz=link.axis)
    limit: dict[str, Any] = {"effort": NO_LIMIT, "velocity": NO_LIMIT}
    if link.limits is not None:
        limit |= {"lower": link.limits[0], "upper": link.limits[1]}
    element(joint, "limit", **limit)
    if link.branch.name in found.friction:
        element(joint, "dynamics", damping=0.0, friction=found.friction[link.branch.name])
    if link.name in found.mimics:
        other, ratio = found.mimics[link.name]
        element(joint, "mimic", joint=found.joint_of(other), multiplier=ratio, offset=0.0)


def _origin(joint: ET.Element, place: Array) -> None:
    element(joint, "origin", xyz=place[:3, 3], rpy=np.array(roll_pitch_yaw(place[:3, :3])))
