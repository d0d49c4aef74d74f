"""Which designs of a synthesis are one: near-identical ones, mirror images, cognates.

Judged by how the designs move, whatever a family calls its links: where two joints stand nearest to each
other and where farthest in the motion says all lengths, and is the same in a mirror image, in a design that
is driven the other way and in one that stands elsewhere.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.family import Family
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.synthesis import ALIKE, Candidate
from mechwright.scripting.buildable import machines

SAMPLES = 361
"""Instants of a motion that are compared: extremes are then known to a ten-thousandth of a length."""

NOTHING = 1e-6
"""mm, rad and the like: figures below this are rounding."""

SAME_CURVE = 2e-4
"""Share of its size within which two curves are one: what instants half a degree apart miss of a curve."""

PARALLEL = 1e-9
"""By how much unit vectors along one direction differ: rounding."""


def repeated(family: Family[Any], candidates: Sequence[Candidate[Any]]) -> list[str]:
    """What is given more than once, in words; empty where all designs are distinct.

    Of a machine that is set to several paths, which is several designs, the first stands for it.
    """
    motions = [family.solve(machine[0].params, SAMPLES) for machine in machines(candidates)]
    sizes = [likeness(motion) for motion in motions]
    said = []
    for (i, one), (k, other) in combinations(enumerate(sizes), 2):
        if alike(one, other):
            said.append(f"designs {i + 1} and {k + 1} are one, or mirror images of each other")
        elif not one.figures and draw_one_curve(motions[i], motions[k]):
            said.append(f"designs {i + 1} and {k + 1} are cognates of each other")
    return said


@dataclass(frozen=True)
class Likeness:
    """What two designs are compared by.

    Parameters
    ----------
    distances
        Least and greatest distance of each two joints and traced points in the motion, mm; where axes meet,
        arcs, rad.
    figures
        Sizes of the figures that the motion tells, where teeth, flanks or cams drive and not links alone.
    """

    distances: Mapping[str, float]
    figures: Mapping[str, float]


def alike(one: Likeness, other: Likeness) -> bool:
    """Whether distances agree to a share :data:`ALIKE` of the least of them, and figures to one of each.

    >>> one = Likeness({"crank": 20.0, "rod": 80.0}, {"speed": 3.0})
    >>> alike(one, Likeness({"crank": 20.1, "rod": 79.8}, {"speed": 3.01}))
    True
    >>> alike(one, Likeness({"crank": 20.0, "rod": 80.6}, {"speed": 3.0}))
    False
    """
    if one.distances.keys() != other.distances.keys() or one.figures.keys() != other.figures.keys():
        return False
    if not one.distances:  # a motion without joints and points says nothing of sizes
        return False
    lengths = [value for value in (*one.distances.values(), *other.distances.values()) if value > NOTHING]
    near = ALIKE * min(lengths, default=0.0)
    return all(abs(value - other.distances[name]) <= near for name, value in one.distances.items()) and all(
        abs(value - other.figures[name]) <= ALIKE * max(value, NOTHING) for name, value in one.figures.items()
    )


def likeness(motion: Motion) -> Likeness:
    """What a design is compared by, from its motion."""
    still = Poses(np.zeros((motion.samples, 3)), np.tile(np.eye(3), (motion.samples, 1, 1)))
    poses = {**motion.poses, GROUND: still}
    held = {name: one for name, one in motion.joints.items() if one.kind in ("revolute", "prismatic")}
    places = {name: _at(poses[one.one], one.point) for name, one in held.items()}
    axes = {name: poses[one.one].rotation @ np.array(one.axis) for name, one in held.items()}
    chained = any(one.one in motion.poses and _moves(motion.poses[one.one]) for one in held.values())
    meshes = any(
        one.kind == "contact" or (one.kind == "gear" and one.ratio is None) for one in motion.joints.values()
    )
    turning = {name: axes[name] for name, one in held.items() if one.kind == "revolute"}
    normal = next(iter(turning.values()), np.array([0.0, 0.0, 1.0]))
    planar = all(
        np.abs(np.abs((axis * normal).sum(axis=1)) - 1).max() < PARALLEL for axis in turning.values()
    )
    places |= {name: _at(poses[one.body], one.point) for name, one in motion.traces.items()}
    found = {}
    for one, other in combinations(sorted(places), 2):
        if planar:
            way = places[one] - places[other]
            apart = np.linalg.norm(way - (way * normal).sum(axis=1)[:, None] * normal, axis=1)
        else:
            # An axis may be held at either of its ends.
            ends = [axes.get(name, places[name]) for name in (one, other)]
            units = [end / np.linalg.norm(end, axis=1)[:, None] for end in ends]
            apart = np.arccos(np.minimum(np.abs((units[0] * units[1]).sum(axis=1)), 1.0))
        found[f"{one} {other} least"], found[f"{one} {other} greatest"] = (
            float(apart.min()),
            float(apart.max()),
        )
    told = {} if chained and not meshes else {name: abs(one.value) for name, one in motion.scalars.items()}
    return Likeness(found, told)


def _moves(poses: Poses) -> bool:
    return bool(np.ptp(poses.rotation, axis=0).max() > PARALLEL or np.ptp(poses.position, axis=0).max() > 0)


def draw_one_curve(one: Motion, other: Motion) -> bool:
    """Whether points that two motions trace run over one curve, at whatever time."""
    if not (one.traces and one.traces.keys() == other.traces.keys()):
        return False
    for name in one.traces:
        curves = [
            _at(motion.poses[motion.traces[name].body], motion.traces[name].point) for motion in (one, other)
        ]
        size = float(np.ptp(curves[0], axis=0).max())
        if size == 0 or any(_off(*pair) > SAME_CURVE * size for pair in (curves, curves[::-1])):
            return False
    return True


def _at(poses: Poses, point: Sequence[float]) -> Array:
    """(n, 3) places of a body's point."""
    return poses.transform(np.array([point], dtype=float))[:, 0]


def _off(points: Array, curve: Array) -> float:
    """Greatest distance of points (n, 3) from the chords of a curve (m, 3)."""
    start, way = curve[:-1], np.diff(curve, axis=0)
    square = np.maximum((way * way).sum(axis=1), np.finfo(float).tiny)
    from_start = points[:, None, :] - start
    share = np.clip((from_start * way).sum(axis=2) / square, 0.0, 1.0)
    return float(np.linalg.norm(from_start - share[..., None] * way, axis=2).min(axis=1).max())
