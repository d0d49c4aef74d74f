"""Equations of links that no closed form finds, and their rates in closed form.

With J the Jacobian of the joint equations, all rates follow from one factorisation: J x⁽ᵏ⁾ = -cₖ, where cₖ is
the k-th rate of the equations if the sought links had no k-th rate.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.assembly_order import Cluster
from mechwright.mechanics.planar.machine import GearPair, Joint, Machine, Revolute
from mechwright.mechanics.planar.relative_motion import relative
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion, Turning


@dataclass
class ClusterEquations:
    """The links of a cluster, whose coordinates (d, 3 k) are origins and angles, among those that stand.

    Numbers are of d designs at one sample.
    """

    machine: Machine
    cluster: Cluster

    def row(self, place: int) -> "ClusterEquations":
        """The same of one design, with numbers (1,)."""
        own = [with_numbers(joint, lambda one: one[place : place + 1]) for joint in self.machine.joints]
        return self.of(replace(self.machine, joints=own), self.cluster)

    @classmethod
    def of(cls, machine: Machine, cluster: Cluster) -> "ClusterEquations":
        """Of a machine whose joints have the numbers of all designs, each (d,)."""
        own = {joint.name for joint in cluster.joints}
        return cls(machine, replace(cluster, joints=tuple(one for one in machine.joints if one.name in own)))

    def bodies(self, orders: Sequence[Array], standing: Mapping[str, BodyMotion]) -> dict[str, BodyMotion]:
        """All bodies with coordinates and their rates, each (..., d, 3 k); rates that are not given are 0."""
        found = dict(standing)
        still = [np.zeros(())] * (4 - len(orders))
        for number, link in enumerate(self.cluster.links):
            x, y, angle = ([*(one[..., 3 * number + part] for one in orders), *still] for part in range(3))
            origin = PointMotion(*(a + 1j * b for a, b in zip(x, y, strict=True)))
            found[link] = BodyMotion(origin, Turning(*angle))
        return found

    def equations(
        self, bodies: Mapping[str, BodyMotion], inputs: Sequence[Turning], rates: int = 3
    ) -> list[tuple[Array, Array, Array, Array]]:
        """Every joint equation and its three rates, each (d,); those above ``rates`` are not to be used."""
        rows: list[tuple[Array, Array, Array, Array]] = []
        for joint in self.cluster.joints:
            if isinstance(joint, Revolute):
                ends = [bodies[link].point(joint.place(link), rates) for link in joint.links]
                gaps = _orders(ends[0], ends[1])
                rows += [tuple(one.real for one in gaps), tuple(one.imag for one in gaps)]  # type: ignore[list-item]
            elif isinstance(joint, GearPair):
                one, two, carrier = (angles_of(bodies[link].turning) for link in joint.links)
                first = joint.phase, 0.0, 0.0, 0.0
                rows.append(
                    tuple(
                        b - c - joint.ratio * (a - c) - p
                        for a, b, c, p in zip(one, two, carrier, first, strict=True)
                    )
                )
            else:
                seen = relative(bodies[joint.block], bodies[joint.guide])
                turn = np.exp(-1j * np.asarray(joint.line_angle))
                point = seen.point(joint.point)
                lever = (point.position - joint.line) * turn
                higher = [one * turn for one in (point.velocity, point.acceleration, point.jerk)]
                rows.append((lever.imag, *(one.imag for one in higher)))
                angle = angles_of(seen.turning)
                straight = angle[0] + joint.block_angle - joint.line_angle
                rows.append((np.sin(straight), *angle[1:]))
        for number in self.cluster.drives:
            rows.append(self._drive(number, bodies, inputs[number]))
        return rows

    def _drive(
        self, number: int, bodies: Mapping[str, BodyMotion], wanted: Turning
    ) -> tuple[Array, Array, Array, Array]:
        drive = self.machine.drives[number]
        joint, asked = self.machine.driven_joint(drive), angles_of(wanted)
        if isinstance(joint, Revolute):
            one, two = (angles_of(bodies[link].turning) for link in (drive.link, drive.on))
            return tuple(a - b - c for a, b, c in zip(one, two, asked, strict=True))  # type: ignore[return-value]
        seen = relative(bodies[joint.block], bodies[joint.guide]).point(joint.point)
        turn = np.exp(-1j * np.asarray(joint.line_angle))
        along = [
            (one * turn).real
            for one in (seen.position - joint.line, seen.velocity, seen.acceleration, seen.jerk)
        ]
        return tuple(a - c for a, c in zip(along, asked, strict=True))  # type: ignore[return-value]

    def column_weights(self, designs: int) -> Array:
        """What a step of each coordinate counts, (d, 1, 3 k): angles as lengths of the size of the joints."""
        places = [
            np.abs(np.broadcast_to(np.ravel(place), designs))
            for joint in self.cluster.joints
            if not isinstance(joint, GearPair)
            for place in map(joint.place, joint.links)
        ]
        size = np.maximum(np.maximum.reduce(places), 1.0)[:, None]
        return np.tile(
            np.stack([np.ones_like(size), np.ones_like(size), size], axis=-1), len(self.cluster.links)
        )

    def residual(self, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]) -> Array:
        """Joint equations (d, m)."""
        rows = self.equations(self.bodies((x,), standing), inputs, 0)
        return np.stack([np.broadcast_to(one[0], x.shape[:1]) for one in rows], axis=-1)

    def jacobian(self, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]) -> Array:
        """Derivatives (d, m, 3 k) by the coordinates: each is the rate if that one alone has the rate 1."""
        still = _rest(standing)
        rest = [Turning.of(one.theta) for one in inputs]
        unit = np.broadcast_to(np.eye(x.shape[1])[:, None, :], (x.shape[1], *x.shape))
        rows = self.equations(self.bodies((np.broadcast_to(x, unit.shape), unit), still), rest, 1)
        found = np.stack([np.broadcast_to(one[1], unit.shape[:2]) for one in rows], axis=-1)
        return np.asarray(np.moveaxis(found, 0, -1))

    def speeds(self, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]) -> Array:
        """The first rates (d, 3 k) of the coordinates."""
        rows = self.equations(self.bodies((x,), standing), inputs, 1)
        right = np.stack([np.broadcast_to(one[1], x.shape[:1]) for one in rows], axis=-1)
        return solved(self.jacobian(x, standing, inputs), -right)

    def rates(
        self, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning], rates: int = 3
    ) -> tuple[list[Array], Array]:
        """Rates (d, 3 k) of the coordinates, and the smallest singular value over the largest (d,)."""
        jacobian = self.jacobian(x, standing, inputs)
        orders = [x]
        for order in range(1, rates + 1):
            rows = self.equations(self.bodies(orders, standing), inputs, order)
            right = np.stack([np.broadcast_to(one[order], x.shape[:1]) for one in rows], axis=-1)
            orders.append(solved(jacobian, -right))
        weighted = jacobian / self.column_weights(len(x))
        values = np.linalg.svd(np.nan_to_num(weighted, posinf=0.0, neginf=0.0), compute_uv=False)
        with np.errstate(invalid="ignore", divide="ignore"):
            return orders[1:], values[..., -1] / values[..., 0]


def weights(x: Array) -> Array:
    """Angles count as lengths of the machine's size."""
    size = max(1.0, float(np.nanmax(np.abs(x), initial=1.0)))
    return np.tile([1.0, 1.0, size], x.shape[1] // 3)


def solved(matrix: Array, right: Array) -> Array:
    """Solutions (d, m); NaN where a matrix is singular."""
    good = np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(right).all(axis=1)
    found = np.full(right.shape, np.nan)
    try:
        found[good] = np.linalg.solve(matrix[good], right[good, :, None])[:, :, 0]
    except np.linalg.LinAlgError:
        for place in np.flatnonzero(good):
            if np.linalg.matrix_rank(matrix[place]) == matrix.shape[1]:
                found[place] = np.linalg.solve(matrix[place], right[place])
    return found


def _rest(bodies: Mapping[str, BodyMotion]) -> dict[str, BodyMotion]:
    return {
        name: BodyMotion(PointMotion.of(body.origin.position), Turning.of(body.turning.theta))
        for name, body in bodies.items()
    }


def angles_of(turning: Turning) -> tuple[Array, Array, Array, Array]:
    """The angle and its three rates."""
    return turning.theta, turning.omega, turning.alpha, turning.jerk


def _orders(one: PointMotion, two: PointMotion) -> tuple[Plane, Plane, Plane, Plane]:
    return (
        one.position - two.position,
        one.velocity - two.velocity,
        one.acceleration - two.acceleration,
        one.jerk - two.jerk,
    )


def joint_numbers(joint: Joint) -> dict[str, Any]:
    """The numbers of a joint that may be columns over designs, by field; the ratio of gears is one number."""
    return {
        field.name: value
        for field in fields(joint)
        if field.name != "ratio" and not isinstance(value := getattr(joint, field.name), str)
    }


def with_numbers(joint: Joint, change: Callable[[Any], Array]) -> Joint:
    """A joint with all its numbers changed."""
    changes: Any = {name: change(value) for name, value in joint_numbers(joint).items()}
    return replace(joint, **changes)
