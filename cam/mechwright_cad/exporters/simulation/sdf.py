"""A whole mechanism as SDF 1.11, which keeps loops: joints hold what they hold, and each body once more.

Imports the CAD kernel, for masses of what is no plate.
"""

import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Instance, Part
from mechwright_cad.exporters.simulation.elements import METRES, element, relative, remark, text
from mechwright_cad.exporters.simulation.links import MOMENTS, Link, linked
from mechwright_cad.exporters.simulation.rotation import roll_pitch_yaw
from mechwright_cad.exporters.simulation.settings import PLAIN, Options
from mechwright_cad.exporters.simulation.urdf import NO_LIMIT, link_names

WORLD = "world"
"""SDF's own name of what stands still, on which joints may hang."""

STANDS = "stand"
"""The link that has the parts of the ground."""


def assembly(
    name: str, parts: Sequence[Part], motion: Motion, sample: int = 0, options: Options = PLAIN
) -> bytes:
    """A mechanism in its pose at one sample of the motion; raises as :func:`linked` does.

    With gravity, which SDF has in a world alone, the model stands in one.
    """
    found = linked(parts, motion, sample, options)
    names = {**link_names(found), GROUND: WORLD}
    root = ET.Element("sdf", version="1.11")
    around = root
    if any(options.gravity):
        around = element(root, "world", name=name)
        element(around, "gravity").text = text(options.gravity)
    model = element(around, "model", name=name)
    for sentence in found.left_out:
        remark(model, f"left out: {sentence}")
    if found.ground:
        stand = element(model, "link", name=_free(STANDS, list(names.values())))
        _looks(stand, found.ground)
        _joint_of(model, "stand-on-world", "fixed", WORLD, stand.attrib["name"])
    frames = {GROUND: np.eye(4)}
    for link in found.links:
        frames[link.name] = frames[link.parent] @ link.place
        made = element(model, "link", name=names[link.name])
        _pose(made, frames[link.name])
        if link.inertia is not None:
            _inertial(made, *link.inertia)
        _looks(made, link.looks)
    for link in found.links:
        kind = link.branch.joint.kind
        joint = _joint_of(model, link.branch.name, kind, names[link.parent], names[link.name])
        if kind != "fixed":
            _axis(joint, link.axis, link, found.friction.get(link.branch.name))
            if link.name in found.mimics:
                other, ratio = found.mimics[link.name]
                mimic = element(joint[-1], "mimic", joint=found.joint_of(other), axis="axis")
                for key, value in (("multiplier", ratio), ("offset", 0.0), ("reference", 0.0)):
                    element(mimic, key).text = text(value)
    for loop, (said, one, two) in found.loops.items():
        joint = _joint_of(model, loop, "revolute", names[one.body], names[two.body])
        pose = element(joint, "pose")
        pose.text = text([*two.place[:3, 3], 0.0, 0.0, 0.0])
        turned = (frames[two.body][:3, :3]).T @ frames[one.body][:3, :3]
        _axis(joint, turned @ np.array(said.axis), None, found.friction.get(loop))
    ET.indent(root)
    written: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return written + b"\n"


def _free(name: str, taken: Sequence[str]) -> str:
    while name in taken:
        name += "-"
    return name


def _joint_of(model: ET.Element, name: str, kind: str, parent: str, child: str) -> ET.Element:
    joint = element(model, "joint", name=name, type=kind)
    element(joint, "parent").text = parent
    element(joint, "child").text = child
    return joint


def _axis(joint: ET.Element, axis: Array, link: Link | None, friction: float | None) -> None:
    made = element(joint, "axis")
    element(made, "xyz").text = text(axis)
    if friction is not None:
        element(element(made, "dynamics"), "friction").text = text(friction)
    limit = element(made, "limit")
    limits = None if link is None else link.limits
    if limits is not None:
        for key, value in zip(("lower", "upper"), limits, strict=True):
            element(limit, key).text = text(value)
    element(limit, "effort").text = text(NO_LIMIT)
    element(limit, "velocity").text = text(NO_LIMIT)


def _pose(of: ET.Element, frame: Array) -> None:
    element(of, "pose").text = text([*frame[:3, 3], *roll_pitch_yaw(frame[:3, :3])])


def _inertial(link: ET.Element, mass: float, centre: Array, tensor: Array) -> None:
    made = element(link, "inertial")
    element(made, "pose").text = text([*centre, 0.0, 0.0, 0.0])
    element(made, "mass").text = relative([mass])
    inertia = element(made, "inertia")
    for key, at in MOMENTS.items():
        element(inertia, key).text = relative([float(tensor[at])])


def _looks(link: ET.Element, looks: Sequence[tuple[Part, Instance, Array]]) -> None:
    for number, (part, at, place) in enumerate(looks, start=1):
        visual = element(link, "visual", name=f"{part.name}-{number}")
        element(visual, "pose").text = text([*place, 0.0, 0.0, 0.0])
        mesh = element(element(visual, "geometry"), "mesh")
        element(mesh, "uri").text = f"{part.name}.stl"
        element(mesh, "scale").text = text([METRES] * 3)
        material = element(visual, "material")
        element(material, "diffuse").text = text([*part.colour_of(at), 1.0])
