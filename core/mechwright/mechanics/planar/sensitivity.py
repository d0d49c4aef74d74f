"""How the links of a planar machine move if its numbers change a little: first order, all changes at once.

With the joint equations F(x, p) = 0, x the poses of the links and p the numbers of the machine, dx follows
from J dx = -F_p dp with the Jacobian J = F_x: one linear system for all changes. The rows of F are those of
:class:`~mechwright.mechanics.planar.cluster.ClusterEquations`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.assembly_order import Cluster
from mechwright.mechanics.planar.cluster import ClusterEquations
from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import GearPair, Joint, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, Turning


@dataclass(frozen=True)
class Pose:
    """Where a link stands: its origin (d,), x + i y, mm, and its angle (d,), rad."""

    origin: Plane
    angle: Array

    @property
    def direction(self) -> Plane:
        """Its x axis (d,), a unit vector."""
        return np.asarray(np.exp(1j * self.angle))


@dataclass(frozen=True)
class Change:
    """What is added to the numbers of a machine with one drive; numbers, or arrays (...) as poses have them.

    Parameters
    ----------
    places
        (joint, link) to the change of the joint's place in the link, mm: of a pin, of the line of a slide in
        its guide, of its point in the block. Names that are no joints are for callers, as traced points.
    block_angles
        Slide to the change of its direction in the block, rad.
    phases
        Gear pair to the change of its phase, rad.
    input
        Change of the input, rad or mm.
    """

    places: Mapping[tuple[str, str], Any] = field(default_factory=dict)
    block_angles: Mapping[str, Any] = field(default_factory=dict)
    phases: Mapping[str, Any] = field(default_factory=dict)
    input: Any = 0.0

    def scaled(self, factor: Any) -> "Change":
        """So many times the change."""
        return Change(
            {key: value * factor for key, value in self.places.items()},
            {key: value * factor for key, value in self.block_angles.items()},
            {key: value * factor for key, value in self.phases.items()},
            self.input * factor,
        )

    def plus(self, other: "Change") -> "Change":
        """Both changes."""
        return Change(
            _sum(self.places, other.places),
            _sum(self.block_angles, other.block_angles),
            _sum(self.phases, other.phases),
            self.input + other.input,
        )

    def place(self, joint: str, link: str) -> Any:
        """The change of a place; 0 where there is none."""
        return self.places.get((joint, link), 0j)


def _sum(one: Mapping[Any, Any], two: Mapping[Any, Any]) -> dict[Any, Any]:
    return {key: one.get(key, 0.0) + two.get(key, 0.0) for key in {**one, **two}}


def changed(machine: Machine, change: Change) -> Machine:
    """The machine with other numbers; its drives are those that were."""
    return replace(machine, joints=tuple(_changed(joint, change) for joint in machine.joints))


def _changed(joint: Joint, change: Change) -> Joint:
    if isinstance(joint, Revolute):
        one, two = (joint.place(link) + change.place(joint.name, link) for link in joint.links)
        return replace(joint, place_one=one, place_two=two)
    if isinstance(joint, Prismatic):
        line, point = (joint.place(link) + change.place(joint.name, link) for link in joint.links)
        angle = joint.block_angle + change.block_angles.get(joint.name, 0.0)
        return replace(joint, line=line, point=point, block_angle=angle)
    return replace(joint, phase=joint.phase + change.phases.get(joint.name, 0.0))


def sensitivities(
    machine: Machine, poses: Mapping[str, Pose], changes: Sequence[Change]
) -> list[dict[str, Pose]]:
    """How links move with each of some changes, per unit of it.

    Parameters
    ----------
    machine
        One design; its numbers have no columns.
    poses
        Link to its pose at d positions, the ground among them.
    changes
        Numbers, or arrays (d,).

    Returns
    -------
    moved
        For each change the derivatives of the poses by it (d,), the ground among them, which stands still.
        NaN where the joint equations are singular: at a dead point.

    Examples
    --------
    A crank of 30 mm whose pin is drilled 1 mm too far out moves nothing else; its input turns all of it.

    >>> from mechwright.mechanics.planar.machine import Drive
    >>> crank = Machine([Revolute("A0", "ground", "crank", 0j, 0j)], [Drive("crank")])
    >>> stands = {name: Pose(np.zeros(1, complex), np.zeros(1)) for name in ("ground", "crank")}
    >>> (found,) = sensitivities(crank, stands, [Change(input=2.0)])
    >>> found["crank"].angle.tolist()
    [2.0]
    """
    links = machine.links
    count = poses[links[0]].angle.size
    cluster = Cluster(links, tuple(machine.joints), tuple(range(len(machine.drives))))
    stand = [poses[link] for link in links]
    parts = [part for one in stand for part in (one.origin.real, one.origin.imag, one.angle)]
    x = np.stack(parts, axis=-1)
    still = Turning.of(np.zeros(count))
    standing = {GROUND: BodyMotion.about(0j, still)}
    jacobian = ClusterEquations.of(machine, cluster).jacobian(x, standing, [still] * len(machine.drives))
    rows = [_rows(machine, poses, change, count) for change in changes]
    found = -_solved(jacobian, np.stack(rows, axis=-1))
    none = np.zeros(count)
    moved = []
    for number in range(len(changes)):
        dx, dy, turn = (found[:, part::3, number] for part in range(3))
        own = {link: Pose(dx[:, k] + 1j * dy[:, k], turn[:, k]) for k, link in enumerate(links)}
        moved.append({GROUND: Pose(none.astype(np.complex128), none), **own})
    return moved


def _rows(machine: Machine, poses: Mapping[str, Pose], change: Change, count: int) -> Array:
    """Derivative of all joint equations by a change (d, m)."""
    rows: list[Any] = []
    for joint in machine.joints:
        if isinstance(joint, Revolute):
            ends = [change.place(joint.name, link) * poses[link].direction for link in joint.links]
            gap = ends[0] - ends[1]
            rows += [gap.real, gap.imag]
        elif isinstance(joint, GearPair):
            rows.append(-change.phases.get(joint.name, 0.0))
        else:
            rows += [_on_line(joint, poses, change).imag, change.block_angles.get(joint.name, 0.0)]
    for drive in machine.drives:
        driven = machine.driven_joint(drive)
        way = _on_line(driven, poses, change).real if isinstance(driven, Prismatic) else 0.0
        rows.append(way - change.input)
    return np.stack([np.broadcast_to(np.asarray(row, float), (count,)) for row in rows], axis=-1)


def _on_line(joint: Prismatic, poses: Mapping[str, Pose], change: Change) -> Any:
    """How a change moves the block's point along the line and to its left, as seen from the guide."""
    guide, block = poses[joint.guide], poses[joint.block]
    point = change.place(joint.name, joint.block) * block.direction / guide.direction
    return (point - change.place(joint.name, joint.guide)) * np.exp(-1j * np.asarray(joint.line_angle))


def _solved(matrix: Array, right: Array) -> Array:
    """Solutions (d, m, q); NaN where a matrix is singular or no number."""
    found = np.full(right.shape, np.nan)
    good = np.flatnonzero(np.isfinite(matrix).all(axis=(1, 2)))
    try:
        found[good] = np.linalg.solve(matrix[good], right[good])
    except np.linalg.LinAlgError:
        for place in good.tolist():
            if np.linalg.matrix_rank(matrix[place]) == matrix.shape[1]:
                found[place] = np.linalg.solve(matrix[place], right[place])
    return found
