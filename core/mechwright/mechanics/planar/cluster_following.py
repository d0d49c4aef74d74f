"""The way of a cluster along the input: by steps from the drawn pose, and between them all at once.

From one step to the next the pose is predicted by its rates and corrected by Newton's method. A correction
of more than a quarter of the predicted move would jump to another way to put the links together: the step is
halved then. Samples between two steps begin on the line between both, and are corrected together; those of
which that is not sure are followed one after the other. Steps are counted from the drawn pose, so that a
machine keeps those that were followed before.
"""

import functools
import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.assembly_order import Cluster
from mechwright.mechanics.planar.cluster import (
    ClusterEquations,
    angles_of,
    joint_numbers,
    solved,
    weights,
    with_numbers,
)
from mechwright.mechanics.planar.machine import GearPair, Machine, Prismatic
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion, Turning

CLOSED = 1e-12
"""Largest error of the joint equations over the size of the machine, in which a pose is exact."""

ITERATIONS = 12
QUARTER = 0.25
SHORTEST = 2.0**-20
"""Share of a step below which a machine is at a dead point: it does not close beyond."""

STRIDE = 0.06
"""A step of the input, rad; of a slide the same share of the machine's size."""


def followed(
    machine: Machine,
    cluster: Cluster,
    standing: Mapping[str, BodyMotion],
    inputs: Sequence[Turning],
    steps: range,
    rates: int,
) -> tuple[dict[str, BodyMotion], Array]:
    """The motion of the links of a cluster from the drawn pose on, and how far they are from a dead point.

    The first samples are ``steps`` of the input from the drawn pose, see :func:`with_steps`. Without them
    every sample is followed from its neighbour, from the one that is nearest to the drawn input to both ends.
    NaN beyond a dead point.
    """
    numbers = [np.shape(one) for joint in cluster.joints for one in joint_numbers(joint).values()]
    shape = np.broadcast_shapes(
        *numbers,
        *(one.theta.shape for one in inputs),
        *(body.turning.theta.shape for body in standing.values()),
        *(np.shape(machine.drawn[link].origin) for link in cluster.links),
    )
    samples, designs = shape[-1], int(np.prod(shape[:-1], dtype=int))
    flat = {name: _flat(body, shape, designs) for name, body in standing.items()}
    drives = [_flat_turning(one, shape, designs) for one in inputs]
    way = _Way(_of_rows(machine, cluster, designs, 1), flat, drives)
    x = np.full((samples, designs, 3 * len(cluster.links)), np.nan)
    begin = -steps.start if steps else _nearest(machine, drives[0])
    known: dict[int, Array] = {}
    if steps:
        known = machine.followed.setdefault(("poses", cluster.links, designs), known)
    for step in known.keys() & set(steps):
        x[begin + step] = known[step]
    if 0 not in known:
        x[begin] = _newton(way.sought, _drawn(machine, cluster, designs), *way.at(begin))
    last = len(steps) or samples
    way.follow(x, range(begin, last), known.keys())
    way.follow(x, range(begin, -1, -1), known.keys())
    known.update((step, x[begin + step].copy()) for step in steps if step not in known)
    wide, everywhere = _of_rows(machine, cluster, designs, samples), _everywhere(flat, drives)
    if steps:
        way.between(x, len(steps), wide, everywhere)
    higher, sines = wide.rates(x.reshape(samples * designs, -1), *everywhere, rates)
    higher += [np.full_like(higher[0], np.nan)] * (3 - rates)
    found = np.stack([x, *(one.reshape(x.shape) for one in higher)])
    return _bodies(cluster, found, shape), np.moveaxis(sines.reshape(samples, designs), 0, -1).reshape(shape)


def with_steps(machine: Machine, inputs: Sequence[Turning]) -> tuple[list[Turning], range]:
    """The inputs with steps from the drawn pose before them, as far as the samples reach, and those steps.

    Several drives get none.
    """
    if len(inputs) > 1:
        return list(inputs), range(0)
    drive = inputs[0]
    drawn = np.asarray(machine.drawn_at[0], float)
    drawn = drawn.reshape(-1)[0] if drawn.size == 1 else drawn.reshape(-1, 1)
    slides = isinstance(machine.driven_joint(machine.drives[0]), Prismatic)
    stride = STRIDE * (_size(machine) if slides else 1.0)
    share = (drive.theta - drawn) / stride
    share = share[np.isfinite(share)]
    low, high = math.floor(share.min(initial=0.0)), math.ceil(share.max(initial=0.0))
    steps = range(low, high + 1)
    ahead = np.broadcast_to(drawn + stride * np.array(steps), (*drive.theta.shape[:-1], len(steps)))
    rates = [
        np.concatenate([np.full(ahead.shape, value), one], axis=-1)
        for value, one in ((1.0, drive.omega), (0.0, drive.alpha), (0.0, drive.jerk))
    ]
    return [Turning(np.concatenate([ahead, drive.theta], axis=-1), *rates)], steps


def _size(machine: Machine) -> Array:
    """The longest way of a joint from the origin of its link, mm; a column where numbers are columns."""
    places = [
        np.abs(joint.place(link))
        for joint in machine.joints
        if not isinstance(joint, GearPair)
        for link in joint.links
    ]
    return np.asarray(functools.reduce(np.maximum, places))


def _nearest(machine: Machine, drive: Turning) -> int:
    """The sample that is nearest to the drawn input."""
    return int(np.argmin(np.abs(drive.theta[0] - np.ravel(machine.drawn_at[0])[0])))


class _Way:
    """The poses of a cluster over the samples, for the equations of all designs."""

    def __init__(
        self, sought: ClusterEquations, standing: dict[str, BodyMotion], drives: list[Turning]
    ) -> None:
        self.sought, self.standing, self.drives = sought, standing, drives

    def at(self, sample: int) -> "_Here":
        """What stands, and the inputs, at a sample."""
        return _at(self.standing, self.drives, sample)

    def follow(self, x: Array, places: range, known: Collection[int]) -> None:
        """Fill in the poses at these samples, one after the other, from the first on, which is known.

        Known are those, too, that are so many samples from the first one in the order of all.
        """
        for last, sample in pairwise(places):
            if sample - places[0] not in known:
                here, there = self.at(last), self.at(sample)
                x[sample] = _step(self.sought, x[last], self.sought.speeds(x[last], *here), here, there)

    def between(self, x: Array, count: int, wide: ClusterEquations, everywhere: "_Here") -> None:
        """Fill in the poses after the first so many samples, which are the steps, all at once."""
        theta = self.drives[0].theta.T
        stride = theta[1] - theta[0] if count > 1 else 1.0
        place = np.nan_to_num((theta[count:] - theta[0]) / stride)
        low = np.clip(np.floor(place).astype(int), 0, max(count - 2, 0))
        high, rows = np.minimum(low + 1, count - 1), np.arange(theta.shape[1])
        one, two = x[low, rows], x[high, rows]
        ahead = np.concatenate([x[:count], one + (place - low)[..., None] * (two - one)])
        found = _newton(wide, ahead.reshape(-1, x.shape[-1]), *everywhere).reshape(x.shape)[count:]
        scale = weights(found.reshape(-1, x.shape[-1]))
        off, way = (np.abs(each * scale).max(axis=-1) for each in (found - ahead[count:], two - one))
        sure = off <= QUARTER * way + 1e-6
        x[count:][sure] = found[sure]
        closes = np.asarray(np.isfinite(x[:count]).all(axis=-1))
        unsure = ~sure & (closes[low, rows] | closes[high, rows])
        for row in np.flatnonzero(unsure.any(axis=0)).tolist():
            doubtful = unsure.T[row]
            for step in np.unique(low[doubtful, row]).tolist():
                begin = step if closes[step, row] else step + 1
                some = count + np.flatnonzero((low[:, row] == step) & doubtful)
                way_to = np.abs(theta[some, row] - theta[begin, row])
                self._follow_one(x, row, [begin, *some[np.argsort(way_to)].tolist()])

    def _follow_one(self, x: Array, row: int, places: Sequence[int]) -> None:
        """Fill in the poses of one design at these samples up to a dead point, from the first on."""
        sought = self.sought.row(row)
        for last, sample in pairwise(places):
            x[sample, row] = _careful(
                sought, x[last, row][None], _one(self.at(last), row), _one(self.at(sample), row)
            )


_Here = tuple[dict[str, BodyMotion], list[Turning]]


def _drawn(machine: Machine, cluster: Cluster, designs: int) -> Array:
    columns = []
    for link in cluster.links:
        pose = machine.drawn[link]
        for value in (np.real(pose.origin), np.imag(pose.origin), pose.angle):
            columns.append(_column(np.asarray(value, float), designs))
    return np.stack(columns, axis=-1).astype(float)


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
    scale = weights(x)
    off, way = (np.abs(one * scale).max(axis=1) for one in (found - ahead, ahead - x))
    sure = (off <= QUARTER * way + 1e-6) | ~np.isfinite(x).all(axis=1)
    for place in np.flatnonzero(~sure).tolist():
        found[place] = _careful(sought.row(place), x[place : place + 1], _one(last, place), _one(here, place))
    return found


def _careful(sought: ClusterEquations, x: Array, one: _Here, two: _Here) -> Array:
    """The same of one design, with steps that are halved; NaN where it does not get there."""
    if not np.isfinite(x).all():
        return np.full(x.shape[1], np.nan)
    done, step, scale = 0.0, 0.5, weights(x)
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
    size = weights(x)[2]
    for _ in range(ITERATIONS):
        gap = sought.residual(x, standing, inputs)
        if np.nanmax(np.abs(gap), initial=0.0) <= CLOSED * size:
            break
        x = x - solved(sought.jacobian(x, standing, inputs), gap)
    left = np.abs(sought.residual(x, standing, inputs)).max(axis=1)
    return np.where((left <= 1e3 * CLOSED * size)[:, None], x, np.nan)


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
    return Turning(*(np.broadcast_to(one, shape).reshape(designs, shape[-1]) for one in angles_of(turning)))


def _at(bodies: Mapping[str, BodyMotion], drives: Sequence[Turning], sample: int) -> _Here:
    """What stands, and the inputs, at one sample (d,)."""

    def turning(one: Turning) -> Turning:
        return Turning(*(values[:, sample] for values in angles_of(one)))

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
                    for a, b in zip(angles_of(body.turning), angles_of(two[0][name].turning), strict=True)
                )
            ),
        )
        for name, body in one[0].items()
    }
    drives = [
        Turning(*(mixed(a, b) for a, b in zip(angles_of(x), angles_of(y), strict=True)))
        for x, y in zip(one[1], two[1], strict=True)
    ]
    return bodies, drives


def _of_rows(machine: Machine, cluster: Cluster, designs: int, samples: int) -> ClusterEquations:
    """The equations of all designs at so many samples, whose rows are (samples, designs) in one axis."""
    own = [
        with_numbers(joint, lambda one: np.tile(_column(one, designs), samples)) for joint in machine.joints
    ]
    return ClusterEquations.of(replace(machine, joints=own), cluster)


def _everywhere(bodies: Mapping[str, BodyMotion], drives: Sequence[Turning]) -> _Here:
    """What stands, and the inputs, at all samples: rows (samples, designs) in one axis."""

    def row(values: Any) -> Any:
        return np.ascontiguousarray(values.T).ravel()

    def turning(one: Turning) -> Turning:
        return Turning(*(row(values) for values in angles_of(one)))

    found = {
        name: BodyMotion(
            PointMotion(*(row(getattr(body.origin, order)) for order in _POINT)), turning(body.turning)
        )
        for name, body in bodies.items()
    }
    return found, [turning(one) for one in drives]
