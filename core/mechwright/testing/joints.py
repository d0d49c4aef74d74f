"""What is wrong with the joints of a motion: each has to be what the poses show."""

import math
from collections.abc import Mapping

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Motion, Poses
from mechwright.units import kind

APART = 1e-8
"""How far a joint may come apart over the motion, mm for each mm of the mechanism, and rad: rounding."""


def joint_faults(motion: Motion) -> list[str]:
    """Joints that come apart while the mechanism moves, and bodies that none holds."""
    if not motion.joints:
        return []
    still = Poses(np.zeros((motion.samples, 3)), np.tile(np.eye(3), (motion.samples, 1, 1)))
    poses = {**motion.poses, GROUND: still}
    size = max([1.0, *(float(np.abs(pose.position).max()) for pose in motion.poses.values())])
    size = max([size, *(math.hypot(*joint.point) for joint in motion.joints.values())])
    found: list[str] = []
    turns: dict[str, Array] = {}
    for name, joint in motion.joints.items():
        turn, way = _relative(poses[joint.one], poses[joint.two])
        found += [f"joint {name}: {fault}" for fault in _faults(joint, turn, way, size)]
        if joint.kind == "revolute":
            turns.setdefault(joint.two, _angle(turn, joint.axis))
        if joint.kind == "prismatic":
            turns.setdefault(joint.two, (way - way[0]) @ joint.axis)
        if joint.drives:
            value = _angle(turn, joint.axis) if joint.kind == "revolute" else (way - way[0]) @ joint.axis
            found += _drive_faults(name, joint, value, motion, size)
    for name, joint in motion.joints.items():
        if joint.kind == "gear":
            found += [f"joint {name}: {fault}" for fault in _gear_faults(joint, turns)]
    return found + [f"body {body} is held by no joint" for body in _loose(motion)]


def _relative(one: Poses, two: Poses) -> tuple[Array, Array]:
    """Rotations (n, 3, 3) and positions (n, 3), mm, of ``two`` in the coordinates of ``one``."""
    turn = np.einsum("nji,njk->nik", one.rotation, two.rotation)
    return turn, np.einsum("nji,nj->ni", one.rotation, two.position - one.position)


def _faults(joint: Joint, turn: Array, way: Array, size: float) -> list[str]:
    """What comes apart: in ``two``, place and axis have to be the same at every sample."""
    place = np.einsum("nji,nj->ni", turn, np.array(joint.point) - way)
    axis = np.einsum("nji,j->ni", turn, np.array(joint.axis))
    away = way - way[0]
    across = away - np.outer(away @ joint.axis, joint.axis)
    checks: dict[str, tuple[tuple[str, Array, float, str], ...]] = {
        "fixed": (("moves", away, size, "mm"), ("turns", turn - turn[0], 1.0, "rad")),
        "revolute": (
            ("its point comes apart", place - place[0], size, "mm"),
            ("its axis tilts", axis - axis[0], 1.0, "rad"),
        ),
        "prismatic": (("leaves its axis", across, size, "mm"), ("turns", turn - turn[0], 1.0, "rad")),
    }
    return [
        f"{what} by {worst:.3g} {unit}, the limit is {APART * scale:.3g}"
        for what, values, scale, unit in checks.get(joint.kind, ())
        if (worst := float(np.abs(values).max())) > APART * scale
    ]


def _angle(turn: Array, axis: tuple[float, float, float]) -> Array:
    """Angles (n,) about an axis from the first sample on, rad, without jumps."""
    since = np.einsum("nij,kj->nik", turn, turn[0])
    spin = np.stack([since[:, 2, 1] - since[:, 1, 2], since[:, 0, 2] - since[:, 2, 0]], axis=1)
    sine = np.column_stack([spin, since[:, 1, 0] - since[:, 0, 1]]) @ axis / 2
    cosine = (np.trace(since, axis1=1, axis2=2) - 1) / 2
    angle: Array = np.unwrap(np.arctan2(sine, cosine))
    return angle


def _drive_faults(name: str, joint: Joint, value: Array, motion: Motion, size: float) -> list[str]:
    """The driven joint follows the input, where that is an angle of a hinge or a way of a slide."""
    drive = motion.channels[motion.input_name]
    unit = {"revolute": "rad", "prismatic": "mm"}.get(joint.kind)
    if unit is None:
        return [f"joint {name}: no input drives a {joint.kind} joint"]
    if kind(drive.unit) != kind(unit):
        return []
    worst = float(np.abs(value - (drive.values - drive.values[0])).max())
    limit = APART * (size if unit == "mm" else float(np.abs(drive.values).max()) + 1)
    if worst <= limit:
        return []
    return [f"joint {name}: {worst:.3g} {unit} away from the input {motion.input_name} that drives it"]


def _gear_faults(joint: Joint, turns: Mapping[str, Array]) -> list[str]:
    missing = [body for body in (joint.one, joint.two) if body not in turns]
    if missing:
        return [f"no revolute or prismatic joint has {body} as its body two" for body in missing]
    if joint.ratio is None:
        return []
    worst = float(np.abs(turns[joint.two] - joint.ratio * turns[joint.one]).max())
    limit = APART * (1 + float(np.abs(turns[joint.two]).max()))
    return [] if worst <= limit else [f"the gear slips by {worst:.3g} rad or mm, the limit is {limit:.3g}"]


def _loose(motion: Motion) -> list[str]:
    """Bodies that no chain of joints leads to from the ground."""
    reached, links = {GROUND}, [j for j in motion.joints.values() if j.kind not in {"gear", "contact"}]
    for _ in links:
        for joint in links:
            if joint.one in reached or joint.two in reached:
                reached |= {joint.one, joint.two}
    return [body for body in motion.poses if body not in reached]
