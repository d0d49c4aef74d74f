"""A whole mechanism as MJCF. Imports the CAD kernel, for looks and for masses of what is no plate."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright_cad.exporters.mesh import part_mesh
from mechwright_cad.exporters.simulation.bearings import Bearings, bearings_of
from mechwright_cad.exporters.simulation.elements import (
    METRES,
    STEP,
    corners,
    element,
    relative,
    remark,
    without_noise,
)
from mechwright_cad.exporters.simulation.mjcf_constraints import check_gears, write_constraints
from mechwright_cad.exporters.simulation.mjcf_contacts import Placed, write_contacts
from mechwright_cad.exporters.simulation.settings import PLAIN, Options
from mechwright_cad.exporters.simulation.tree import Branch, Tree, check_masses, frames_of, placed_of, tree_of
from mechwright_cad.solids.inertia import Inertia, body_moments

TOUCH = 1e-8
"""How exactly distances of surfaces that touch are found, m; MuJoCo's own 1e-6 is a small clearance."""


def assembly(
    name: str, parts: Sequence[Part], motion: Motion, sample: int = 0, options: Options = PLAIN
) -> bytes:
    """A mechanism in its pose at one sample of the motion.

    Raises
    ------
    KinematicsError
        The motion does not say how its bodies are joined, or in a way that MJCF has no words for.
    GeometryError
        A body that moves has no mass, an instance belongs to no body, or there is no such sample.
    DesignError
        The options ask for friction, and the motion does not say how fast it runs.
    """
    placed = placed_of(parts, motion, sample)
    tree = tree_of(motion.joints, motion.poses)
    check_gears(motion.joints, tree)
    frames = frames_of(motion, sample)
    touching = [joint for joint in motion.joints.values() if joint.kind == "contact"]
    bearings = bearings_of(parts, motion, options)
    root, assets = _head(name, options, contact=bool(touching))
    for part in parts:
        if part.instances:
            mesh = part_mesh(part)
            faces = " ".join(map(str, mesh.triangles.ravel().tolist()))
            element(assets, "mesh", name=part.name, inertia="shell", vertex=corners(mesh.points), face=faces)
    bodies = _bodies(root, tree, placed, frames, bearings)
    write_contacts(assets, bodies, placed, touching, bearings.coefficient)
    write_constraints(root, bodies, tree, motion.joints, frames, bearings)
    for sentence in bearings.left_out:
        remark(root, f"left out: {sentence}")
    ET.indent(root)
    written: bytes = ET.tostring(root, encoding="utf-8")
    return written + b"\n"


def _head(name: str, options: Options, *, contact: bool) -> tuple[ET.Element, ET.Element]:
    """The root with its settings, and where meshes go."""
    root = ET.Element("mujoco", model=name)
    as_given = dict.fromkeys(("inertiafromgeom", "balanceinertia"), "false")
    element(root, "compiler", angle="radian", boundmass="0", boundinertia="0", **as_given)
    option = element(
        root, "option", gravity=options.gravity, timestep=STEP, integrator="implicitfast", ccd_tolerance=TOUCH
    )
    if not contact:
        element(option, "flag", contact="disable")
    visual = element(root, "visual")
    element(visual, "headlight", ambient="0.4 0.4 0.4", diffuse="0.6 0.6 0.6")
    return root, element(root, "asset")


def _bodies(
    root: ET.Element, tree: Tree, placed: Placed, frames: Mapping[str, Array], bearings: Bearings
) -> dict[str, ET.Element]:
    """Write all bodies with their masses, joints and looks."""
    moments = {body: body_moments((part, at.z) for part, at in here) for body, here in placed.items()}
    check_masses(tree, {body: float(found[3, 3]) for body, found in moments.items()})
    bodies = {GROUND: element(root, "worldbody")}
    for branch in tree.branches:
        body = branch.body
        local = np.linalg.inv(frames[branch.parent]) @ frames[body]
        axes = local[:3, :2].T.ravel()
        made = element(bodies[branch.parent], "body", name=body, pos=local[:3, 3] * METRES, xyaxes=axes)
        bodies[body] = made
        if moments[body][3, 3] > 0:
            _inertial(made, Inertia.of(moments[body]))
        if branch.joint.kind != "fixed":
            _joint(made, branch, frames, bearings)
        for part, at in placed[body]:
            rgba, place = [*part.colour_of(at), 1.0], [0.0, 0.0, at.z * METRES]
            looks = {"type": "mesh", "mesh": part.name, "group": "2", "contype": "0", "conaffinity": "0"}
            element(made, "geom", pos=place, rgba=rgba, **looks)
    return bodies


def _inertial(body: ET.Element, inertia: Inertia) -> None:
    tensor = without_noise(inertia.tensor * METRES**2)
    full = [float(tensor[i, j]) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    values = {"mass": relative([inertia.mass]), "fullinertia": relative(full)}
    element(body, "inertial", pos=inertia.centre * METRES, **values)


def _joint(body: ET.Element, branch: Branch, frames: Mapping[str, Array], bearings: Bearings) -> None:
    """Write a hinge or a slide in the coordinates of its body; an axis counts for the joint's body two.

    A hinge with play stands on two slides across its axis.
    """
    joint, name = branch.joint, branch.name
    place = np.linalg.inv(frames[branch.body]) @ frames[joint.one]
    axis = place[:3, :3] @ joint.axis * (-1 if branch.turned else 1)
    at = (place @ [*joint.point, 1.0])[:3] * METRES
    kind = "hinge" if joint.kind == "revolute" else "slide"
    if name in bearings.play:
        for letter, way in zip("xy", np.linalg.svd(axis[None])[2][1:], strict=True):
            element(body, "joint", name=f"{name}.{letter}", type="slide", pos=at, axis=way)
    friction = {"frictionloss": bearings.friction[name]} if name in bearings.friction else {}
    element(body, "joint", name=name, type=kind, pos=at, axis=axis, **friction)
