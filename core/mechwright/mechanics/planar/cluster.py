"""Links that no closed form finds: followed along the input by Newton's method, with rates in closed form.

From one sample of the input to the next the pose is predicted by its rates and corrected. A correction
of more than a quarter of the predicted move would jump to another way to put the links together: the step is
halved then. With J the Jacobian of the joint equations, all rates follow from one factorisation:
J x⁽ᵏ⁾ = -cₖ, where cₖ is the k-th rate of the equations if the sought links had no k-th rate.
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

CLOSED = 1e-12
"""Largest error of the joint equations over the size of the machine, in which a pose is exact."""

ITERATIONS = 12
QUARTER = 0.25
SHORTEST = 2.0**-20
"""Share of a step below which a machine is at a dead point: it does not close beyond."""


@dataclass
class ClusterEquations:
    """The links of a cluster, whose coordinates (d, 3 k) are origins and angles, among those that stand.

    Numbers are of d designs at one sample.
    """

    machine: Machine
    cluster: Cluster

    def row(self, place: int) -> "ClusterEquations":
        """The same of one design, with numbers (1,)."""
        own = [_each_place(joint, lambda one: one[place : place + 1]) for joint in self.machine.joints]
        return self.of(replace(self.machine, joints=own), self.cluster)

    @classmethod
    def of(cls, machine: Machine, cluster: Cluster) -> "ClusterEquations":
        """Of a machine whose joints have the numbers of all designs, each (d,)."""
        own = {joint.name for joint in cluster.joints}
        return cls(machine, replace(cluster, joints=tuple(one for one in machine.joints if one.name in own)))

    def bodies(self, orders: Sequence[Array], standing: Mapping[str, BodyMotion]) -> dict[str, BodyMotion]:
        """All bodies with coordinates and their three rates, each (..., d, 3 k)."""
        found = dict(standing)
        for number, link in enumerate(self.cluster.links):
            x, y, angle = ([one[..., 3 * number + part] for one in orders] for part in range(3))
            origin = PointMotion(*(a + 1j * b for a, b in zip(x, y, strict=True)))
            found[link] = BodyMotion(origin, Turning(*angle))
        return found

    def equations(
        self, bodies: Mapping[str, BodyMotion], inputs: Sequence[Turning]
    ) -> list[tuple[Array, Array, Array, Array]]:
        """Every joint equation and its three rates, each (d,)."""
        rows: list[tuple[Array, Array, Array, Array]] = []
        for joint in self.cluster.joints:
            if isinstance(joint, Revolute):
                ends = [bodies[link].point(joint.place(link)) for link in joint.links]
                gaps = _orders(ends[0], ends[1])
                rows += [tuple(one.real for one in gaps), tuple(one.imag for one in gaps)]  # type: ignore[list-item]
            elif isinstance(joint, GearPair):
                one, two, carrier = (_angles(bodies[link].turning) for link in joint.links)
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
                rates = [one * turn for one in (point.velocity, point.acceleration, point.jerk)]
                rows.append((lever.imag, *(one.imag for one in rates)))
                angle = _angles(seen.turning)
                straight = angle[0] + joint.block_angle - joint.line_angle
                rows.append((np.sin(straight), *angle[1:]))
        for number in self.cluster.drives:
            rows.append(self._drive(number, bodies, inputs[number]))
        return rows

    def _drive(
        self, number: int, bodies: Mapping[str, BodyMotion], wanted: Turning
    ) -> tuple[Array, Array, Array, Array]:
        drive = self.machine.drives[number]
        joint, asked = self.machine.driven_joint(drive), _angles(wanted)
        if isinstance(joint, Revolute):
            one, two = (_angles(bodies[link].turning) for link in (drive.link, drive.on))
            return tuple(a - b - c for a, b, c in zip(one, two, asked, strict=True))  # type: ignore[return-value]
        seen = relative(bodies[joint.block], bodies[joint.guide]).point(joint.point)
        turn = np.exp(-1j * np.asarray(joint.line_angle))
        along = [
            (one * turn).real
            for one in (seen.position - joint.line, seen.velocity, seen.acceleration, seen.jerk)
        ]
        return tuple(a - c for a, c in zip(along, asked, strict=True))  # type: ignore[return-value]

    def residual(self, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]) -> Array:
        """Joint equations (d, m)."""
        zero = np.zeros_like(x)
        rows = self.equations(self.bodies((x, zero, zero, zero), standing), inputs)
        return np.stack([np.broadcast_to(one[0], x.shape[:1]) for one in rows], axis=-1)

    def jacobian(self, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]) -> Array:
        """Derivatives (d, m, 3 k) by the coordinates: each is the rate if that one alone has the rate 1."""
        still = _rest(standing)
        rest = [Turning.of(one.theta) for one in inputs]
        unit = np.broadcast_to(np.eye(x.shape[1])[:, None, :], (x.shape[1], *x.shape))
        zero = np.zeros_like(unit)
        rows = self.equations(self.bodies((np.broadcast_to(x, unit.shape), unit, zero, zero), still), rest)
        found = np.stack([np.broadcast_to(one[1], unit.shape[:2]) for one in rows], axis=-1)
        return np.asarray(np.moveaxis(found, 0, -1))

    def rates(
        self, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]
    ) -> tuple[list[Array], Array]:
        """Three rates (d, 3 k) of the coordinates, and the smallest singular value over the largest (d,)."""
        jacobian = self.jacobian(x, standing, inputs)
        orders = [x, *(np.zeros_like(x) for _ in range(3))]
        for order in (1, 2, 3):
            rows = self.equations(self.bodies(orders, standing), inputs)
            right = np.stack([np.broadcast_to(one[order], x.shape[:1]) for one in rows], axis=-1)
            orders[order] = _solved(jacobian, -right)
        values = np.linalg.svd(np.where(np.isfinite(jacobian), jacobian, 0.0) / _scale(x), compute_uv=False)
        with np.errstate(invalid="ignore", divide="ignore"):
            return orders[1:], values[..., -1] / values[..., 0]


def _scale(x: Array) -> Array:
    """Angles count as lengths of the machine's size."""
    size = max(1.0, float(np.nanmax(np.abs(x), initial=1.0)))
    return np.tile([1.0, 1.0, size], x.shape[1] // 3)


def followed(
    machine: Machine, cluster: Cluster, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]
) -> tuple[dict[str, BodyMotion], Array]:
    """The motion of the links of a cluster from the drawn pose on, and how far they are from a dead point.

    Samples are followed from the one that is nearest to the drawn input, to both ends; NaN beyond a dead
    point.
    """
    numbers = [np.shape(one) for joint in cluster.joints for one in _places(joint).values()]
    shape = np.broadcast_shapes(
        *numbers,
        *(one.theta.shape for one in inputs),
        *(body.turning.theta.shape for body in standing.values()),
        *(np.shape(machine.drawn[link].origin) for link in cluster.links),
    )
    samples, designs = shape[-1], int(np.prod(shape[:-1], dtype=int))
    own = [_each_place(joint, lambda one: _column(one, designs)) for joint in machine.joints]
    sought = ClusterEquations.of(replace(machine, joints=own), cluster)
    flat = {name: _flat(body, shape, designs) for name, body in standing.items()}
    drives = [_flat_turning(one, shape, designs) for one in inputs]
    begin = int(np.argmin(np.abs(drives[0].theta[0] - np.ravel(machine.drawn_at[0])[0])))
    found = np.full((4, samples, designs, 3 * len(cluster.links)), np.nan)
    sines = np.full((samples, designs), np.nan)
    start = _drawn(machine, cluster, designs)
    for way in (range(begin, samples), range(begin, -1, -1)):
        x, last = start, None
        for sample in way:
            here = _at(flat, drives, sample)
            if last is None:
                x = _newton(sought, x, *here)
            elif sample != begin:
                x = _step(sought, x, found[1, last], _at(flat, drives, last), here)
            found[0, sample] = x
            rates, sines[sample] = sought.rates(x, *here)
            found[1:, sample] = rates
            last = sample
    return _bodies(cluster, found, shape), np.moveaxis(sines, 0, -1).reshape(shape)


_Here = tuple[dict[str, BodyMotion], list[Turning]]


def _drawn(machine: Machine, cluster: Cluster, designs: int) -> Array:
    columns = []
    for link in cluster.links:
        pose = machine.drawn[link]
        for value in (np.real(pose.origin), np.imag(pose.origin), pose.angle):
            columns.append(_column(np.asarray(value, float), designs))
    return np.stack(columns, axis=-1).astype(float)


def _places(joint: Joint) -> dict[str, Any]:
    """The numbers of a joint that may be columns over designs, by field; the ratio of gears is one number."""
    return {
        field.name: value
        for field in fields(joint)
        if field.name != "ratio" and not isinstance(value := getattr(joint, field.name), str)
    }


def _each_place(joint: Joint, change: Callable[[Any], Array]) -> Joint:
    """A joint with all its numbers changed."""
    changes: Any = {name: change(value) for name, value in _places(joint).items()}
    return replace(joint, **changes)


def _column(value: Any, designs: int) -> Array:
    """A number, or a column (d, 1), as (d,)."""
    return np.broadcast_to(np.ravel(value), (designs,))


def _step(sought: ClusterEquations, x: Array, rates: Array, last: _Here, here: _Here) -> Array:
    """The pose at the next sample: in one step where that is sure, else in as many as it needs."""
    moved = here[1][0].theta - last[1][0].theta
    speed = last[1][0].omega
    with np.errstate(invalid="ignore", divide="ignore"):
        ahead = x + rates * np.where(speed != 0, moved / speed, 0.0)[:, None]
    found = _newton(sought, ahead, *here)
    scale = _scale(x)
    off, way = (np.abs(one * scale).max(axis=1) for one in (found - ahead, ahead - x))
    sure = (off <= QUARTER * way + 1e-6) | ~np.isfinite(x).all(axis=1)
    for place in np.flatnonzero(~sure).tolist():
        found[place] = _careful(sought.row(place), x[place : place + 1], last, here, place)
    return found


def _careful(sought: ClusterEquations, x: Array, last: _Here, here: _Here, place: int) -> Array:
    """The same of one design, with steps that are halved; NaN where it does not get there."""
    one, two = _one(last, place), _one(here, place)
    done, step, scale = 0.0, 0.5, _scale(x)
    while done < 1:
        step = min(step, 1 - done)
        target = _between(one, two, done + step)
        found = _newton(sought, x, *target)
        ahead = _newton(sought, x, *_between(one, two, done + step / 2))
        off, way = (np.abs(one * scale).max() for one in (2 * ahead - x - found, found - x))
        if np.isfinite(found).all() and off <= QUARTER * way + 1e-9:
            x, done, step = found, done + step, 2 * step
        else:
            step /= 2
        if step < SHORTEST:
            return np.full(x.shape[1], np.nan)
    return np.asarray(x[0])


def _newton(
    sought: ClusterEquations, x: Array, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]
) -> Array:
    size = _scale(x)[2]
    for _ in range(ITERATIONS):
        gap = sought.residual(x, standing, inputs)
        if np.nanmax(np.abs(gap), initial=0.0) <= CLOSED * size:
            break
        x = x - _solved(sought.jacobian(x, standing, inputs), gap)
    left = np.abs(sought.residual(x, standing, inputs)).max(axis=1)
    return np.where((left <= 1e3 * CLOSED * size)[:, None], x, np.nan)


def _solved(matrix: Array, right: Array) -> Array:
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


def _bodies(cluster: Cluster, found: Array, shape: tuple[int, ...]) -> dict[str, BodyMotion]:
    bodies = {}
    for number, link in enumerate(cluster.links):
        x, y, angle = (
            [np.moveaxis(one[..., 3 * number + part], 0, -1).reshape(shape) for one in found]
            for part in range(3)
        )
        origin = PointMotion(*(a + 1j * b for a, b in zip(x, y, strict=True)))
        bodies[link] = BodyMotion(origin, Turning(*angle))
    return bodies


def _flat(body: BodyMotion, shape: tuple[int, ...], designs: int) -> BodyMotion:
    origin = [
        np.broadcast_to(one, shape).reshape(designs, shape[-1])
        for one in (body.origin.position, body.origin.velocity, body.origin.acceleration, body.origin.jerk)
    ]
    return BodyMotion(PointMotion(*origin), _flat_turning(body.turning, shape, designs))


def _flat_turning(turning: Turning, shape: tuple[int, ...], designs: int) -> Turning:
    return Turning(*(np.broadcast_to(one, shape).reshape(designs, shape[-1]) for one in _angles(turning)))


def _at(bodies: Mapping[str, BodyMotion], drives: Sequence[Turning], sample: int) -> _Here:
    """What stands, and the inputs, at one sample (d,)."""

    def turning(one: Turning) -> Turning:
        return Turning(*(values[:, sample] for values in _angles(one)))

    def point(one: PointMotion) -> PointMotion:
        return PointMotion(
            one.position[:, sample], one.velocity[:, sample], one.acceleration[:, sample], one.jerk[:, sample]
        )

    found = {name: BodyMotion(point(body.origin), turning(body.turning)) for name, body in bodies.items()}
    return found, [turning(one) for one in drives]


def _one(here: _Here, place: int) -> _Here:
    some = slice(place, place + 1)
    bodies = {
        name: BodyMotion(
            PointMotion(*(getattr(body.origin, order)[some] for order in _POINT)), body.turning.part(some)
        )
        for name, body in here[0].items()
    }
    return bodies, [one.part(some) for one in here[1]]


_POINT = ("position", "velocity", "acceleration", "jerk")


def _between(one: _Here, two: _Here, share: float) -> _Here:
    """Between two samples, in proportion: what stands there is near enough to lead on to the next sample."""

    def mixed(a: Any, b: Any) -> Any:
        return a + share * (b - a) if share < 1 else b

    bodies = {
        name: BodyMotion(
            PointMotion(*(mixed(getattr(body.origin, o), getattr(two[0][name].origin, o)) for o in _POINT)),
            Turning(
                *(
                    mixed(a, b)
                    for a, b in zip(_angles(body.turning), _angles(two[0][name].turning), strict=True)
                )
            ),
        )
        for name, body in one[0].items()
    }
    drives = [
        Turning(*(mixed(a, b) for a, b in zip(_angles(x), _angles(y), strict=True)))
        for x, y in zip(one[1], two[1], strict=True)
    ]
    return bodies, drives


def _rest(bodies: Mapping[str, BodyMotion]) -> dict[str, BodyMotion]:
    return {
        name: BodyMotion(PointMotion.of(body.origin.position), Turning.of(body.turning.theta))
        for name, body in bodies.items()
    }


def _angles(turning: Turning) -> tuple[Array, Array, Array, Array]:
    return turning.theta, turning.omega, turning.alpha, turning.jerk


def _orders(one: PointMotion, two: PointMotion) -> tuple[Plane, Plane, Plane, Plane]:
    return (
        one.position - two.position,
        one.velocity - two.velocity,
        one.acceleration - two.acceleration,
        one.jerk - two.jerk,
    )
