"""The mechanism as links and joints of a robot: what URDF and SDF have in common.

A link's frame stands in the joint by which it hangs on its parent and is turned as the body. Angles and ways
of joints are 0 in the pose that is written.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Instance, Part
from mechwright.errors import KinematicsError
from mechwright_cad.exporters.simulation.bearings import bearings_of
from mechwright_cad.exporters.simulation.elements import METRES, without_noise
from mechwright_cad.exporters.simulation.settings import Options
from mechwright_cad.exporters.simulation.tree import Branch, check_masses, frames_of, placed_of, tree_of
from mechwright_cad.solids.inertia import Inertia, body_moments

WHOLE = math.tau - 1e-6
"""A joint that turns as far as this over the motion, rad, has no limits."""


MOMENTS = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
"""Names of the six moments and products of inertia in URDF and SDF, with their places in the tensor."""


@dataclass(frozen=True)
class Link:
    """A body that hangs on another.

    Parameters
    ----------
    name, parent
        Of the bodies; the ground is ``GROUND``.
    branch
        The joint between them, and which way it counts.
    place
        (4, 4) frame of the link in that of its parent, m.
    axis
        (3,) of the joint, in the link's frame: a positive angle of the link is about it.
    limits
        Least and greatest angle, rad, or way, m, over the motion; None for a joint that turns all round, or
        is fixed.
    inertia
        Mass, kg, centre, m, and inertia, kg m², in the link's frame; None of a body without parts.
    looks
        Parts with the (3,) place of each in the link's frame, m.
    """

    name: str
    parent: str
    branch: Branch
    place: Array
    axis: Array
    limits: tuple[float, float] | None
    inertia: tuple[float, Array, Array] | None
    looks: tuple[tuple[Part, Instance, Array], ...]


@dataclass(frozen=True)
class End:
    """Where a joint that closes a loop is made on one of its two bodies: (4, 4), m, in that link's frame."""

    body: str
    place: Array


@dataclass(frozen=True)
class Linked:
    """All links, parents before children, and what no tree of joints holds.

    Parameters
    ----------
    ground
        What stands still: parts with their place.
    links
        All bodies.
    loops
        Name of a pin that closes a loop to its joint and its ends on both bodies, ``one`` first.
    mimics
        Body to the body whose angle it follows in a gear of a constant ratio, with that ratio.
    left_out
        Sentences about what the file cannot say.
    friction
        Name of a joint to its torque, N m, or force, N, of friction.
    """

    ground: tuple[tuple[Part, Instance, Array], ...]
    links: tuple[Link, ...]
    loops: Mapping[str, tuple[Joint, End, End]]
    mimics: Mapping[str, tuple[str, float]]
    left_out: tuple[str, ...]
    friction: Mapping[str, float]

    def joint_of(self, body: str) -> str:
        """The name of the joint by which a body hangs on its parent."""
        return next(link.branch.name for link in self.links if link.name == body)


def linked(parts: Sequence[Part], motion: Motion, sample: int, options: Options) -> Linked:
    """A mechanism in its pose at one sample of the motion.

    Raises
    ------
    KinematicsError
        The motion does not say how its bodies are joined, or in a way that no tree of joints holds.
    GeometryError
        A body that moves has no mass, an instance belongs to no body, or there is no such sample.
    DesignError
        The options ask for friction, and the motion does not say how fast it runs.
    """
    placed = placed_of(parts, motion, sample)
    bearings = bearings_of(parts, motion, options)
    joints, empty = _with_parts(motion.joints, placed)
    tree = tree_of(joints, [body for body in motion.poses if body not in empty])
    bodies = frames_of(motion, sample)
    moments = {body: body_moments((part, at.z) for part, at in here) for body, here in placed.items()}
    check_masses(tree, {body: float(found[3, 3]) for body, found in moments.items()})
    frames = {GROUND: np.eye(4)}
    links = []
    for branch in tree.branches:
        joint, body = branch.joint, branch.body
        frame = bodies[body].copy()
        if joint.kind != "fixed":
            frame[:3, 3] = (bodies[joint.one] @ [*joint.point, 1.0])[:3]
        frame[:3, 3] *= METRES
        frames[body] = frame
        axis = frame[:3, :3].T @ bodies[joint.one][:3, :3] @ joint.axis * (-1 if branch.turned else 1)
        offset = frame[:3, :3].T @ (bodies[body][:3, 3] * METRES - frame[:3, 3])
        inertia = None
        if moments[body][3, 3] > 0:
            of = Inertia.of(moments[body])
            inertia = (float(of.mass), of.centre * METRES + offset, without_noise(of.tensor * METRES**2))
        links.append(
            Link(
                body,
                branch.parent,
                branch,
                np.linalg.inv(frames[branch.parent]) @ frame,
                axis,
                _limits(branch, motion, sample),
                inertia,
                tuple((part, at, offset + _height(at)) for part, at in placed[body]),
            )
        )
    loops = {}
    for name, joint in tree.loops.items():
        point = (bodies[joint.one] @ [*joint.point, 1.0])[:3] * METRES
        ends = []
        for body in (joint.one, joint.two):
            there = frames[body].copy()
            there[:3, 3] = point
            ends.append(End(body, np.linalg.inv(frames[body]) @ there))
        loops[name] = (joint, ends[0], ends[1])
    ground = tuple((part, at, _height(at)) for part, at in placed[GROUND])
    mimics, left_out = _coupled(joints, tree.branches)
    none = (f"body {body}: no part is an instance of it" for body in empty)
    play = (f"play of {name}: {2 / METRES * one:.3f} mm" for name, one in bearings.play.items())
    rubbing = [f"friction of contact {name}" for name, one in joints.items() if one.kind == "contact"]
    more = (*bearings.left_out, *play, *(rubbing if bearings.coefficient else ()))
    return Linked(ground, tuple(links), loops, mimics, (*none, *left_out, *more), bearings.friction)


def _with_parts(
    joints: Mapping[str, Joint], placed: Mapping[str, Sequence[object]]
) -> tuple[dict[str, Joint], list[str]]:
    """The joints without bodies that move, have no parts and hold no other body; and these bodies."""
    left, empty = dict(joints), list[str]()
    fixed = {joint.two for joint in joints.values() if joint.kind == "fixed"}  # frames that somebody may want
    for body in [body for body, here in placed.items() if body and not here and body not in fixed]:
        fewer = {name: joint for name, joint in left.items() if body not in (joint.one, joint.two)}
        try:
            tree_of(fewer, [one for one in placed if one and one != body and one not in empty])
        except KinematicsError:
            continue  # something hangs on it
        left, empty = fewer, [*empty, body]
    return left, empty


def _coupled(
    joints: Mapping[str, Joint], branches: Sequence[Branch]
) -> tuple[dict[str, tuple[str, float]], tuple[str, ...]]:
    """Gears of a constant ratio, as the angle of a body by that of another; and what is left out."""
    known = {branch.body: branch for branch in branches if branch.joint.kind in ("revolute", "prismatic")}
    mimics: dict[str, tuple[str, float]] = {}
    left_out = []
    for name, joint in joints.items():
        if joint.kind == "contact":
            left_out.append(f"contact {name}: {joint.one or 'the ground'} and {joint.two} push each other")
        if joint.kind != "gear":
            continue
        one, two = known.get(joint.one), known.get(joint.two)
        if joint.ratio is None or one is None or two is None:
            why = "its ratio changes over the turn" if joint.ratio is None else "its bodies turn on others"
            left_out.append(f"gear {name} of {joint.one} and {joint.two}: {why}")
            continue
        # Angles of the joints count for their body two; those of the links for the body that hangs.
        ratio = joint.ratio * (METRES if two.joint.kind == "prismatic" else 1.0)
        ratio *= (-1 if one.turned else 1) * (-1 if two.turned else 1)
        if joint.two in mimics or _follows(mimics, joint.one, joint.two):
            why = f"{joint.two} follows another body already"
            left_out.append(f"gear {name} of {joint.one} and {joint.two}: {why}")
            continue
        mimics[joint.two] = (joint.one, ratio)
    return mimics, tuple(left_out)


def _height(at: Instance) -> Array:
    return np.array([0.0, 0.0, at.z * METRES])


def _follows(mimics: Mapping[str, tuple[str, float]], body: str, other: str) -> bool:
    """Whether a body follows another, through any number of gears."""
    while body in mimics:
        body = mimics[body][0]
        if body == other:
            return True
    return False


def _limits(branch: Branch, motion: Motion, sample: int) -> tuple[float, float] | None:
    """The range of a joint over the motion, from 0 where it is written."""
    joint = branch.joint
    if joint.kind not in ("revolute", "prismatic"):
        return None
    way = _ways(branch, motion)
    way = way - way[sample]
    low, high = float(way.min()), float(way.max())
    return None if joint.kind == "revolute" and high - low > WHOLE else (low, high)


def _ways(branch: Branch, motion: Motion) -> Array:
    """Angle, rad, or way, m, of a link in its joint (n,) over the motion."""
    joint = branch.joint
    rotation, position = motion.poses[joint.two].rotation, motion.poses[joint.two].position
    axis = np.array(joint.axis)
    if joint.one != GROUND:
        one = motion.poses[joint.one]
        turned = np.swapaxes(one.rotation, 1, 2)
        rotation = turned @ rotation
        position = (turned @ (position - one.position)[..., None])[..., 0]
    sign = -1.0 if branch.turned else 1.0
    if joint.kind == "prismatic":
        along: Array = sign * METRES * (position @ axis)
        return along
    across = np.linalg.svd(axis[None])[2][1:]
    first = rotation[0].T @ across[0]
    now = rotation @ first
    third = np.cross(axis, across[0])
    turn: Array = sign * np.unwrap(np.arctan2(now @ third, now @ across[0]))
    return turn
