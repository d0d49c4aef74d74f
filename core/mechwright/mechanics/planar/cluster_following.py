"""The way of a cluster along the input: from sample to sample, and between them all at once.

From one sample to the next the pose is predicted by its rates and corrected by Newton's method. A correction
of more than a quarter of the predicted move would jump to another way to put the links together: the step is
halved then. Only some samples are followed so. Those between two of them start on the line between both, and
are corrected together; an interval in which that is not sure is followed sample by sample.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
from mechwright.mechanics.planar.machine import Machine, Prismatic
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion, Turning

CLOSED = 1e-12
"""Largest error of the joint equations over the size of the machine, in which a pose is exact."""

ITERATIONS = 12
QUARTER = 0.25
SHORTEST = 2.0**-20
"""Share of a step below which a machine is at a dead point: it does not close beyond."""

LEAD = 60
"""Steps of a slide from the drawn pose to the first sample."""

STRIDE = 0.06
"""Steps of the input that are followed, rad; of a slide the same share of its whole way."""


def followed(
    machine: Machine, cluster: Cluster, standing: Mapping[str, BodyMotion], inputs: Sequence[Turning]
) -> tuple[dict[str, BodyMotion], Array]:
    """The motion of the links of a cluster from the drawn pose on, and how far they are from a dead point.

    Samples are followed from the one that is nearest to the drawn input, to both ends; NaN beyond a dead
    point.
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
    slides = isinstance(machine.driven_joint(machine.drives[0]), Prismatic)
    begin = int(np.argmin(np.abs(drives[0].theta[0] - np.ravel(machine.drawn_at[0])[0])))
    stops = _stops(drives[0].theta, begin, slides)
    x = np.full((samples, designs, 3 * len(cluster.links)), np.nan)
    x[begin] = _newton(way.sought, _drawn(machine, cluster, designs), *way.at(begin))
    way.follow(x, stops[stops >= begin])
    way.follow(x, stops[stops <= begin][::-1])
    wide = _of_rows(machine, cluster, designs, samples)
    everywhere = _everywhere(flat, drives)
    for low, high in way.between(x, stops, wide, everywhere):
        first, last = (low, high) if np.isfinite(x[low]).all() else (high, low)
        way.follow(x, np.arange(first, last, 1 if last > first else -1))
    rates, sines = wide.rates(x.reshape(samples * designs, -1), *everywhere)
    found = np.stack([x, *(one.reshape(x.shape) for one in rates)])
    return _bodies(cluster, found, shape), np.moveaxis(sines.reshape(samples, designs), 0, -1).reshape(shape)


def with_lead(machine: Machine, inputs: Sequence[Turning]) -> tuple[list[Turning], int]:
    """The inputs with steps before them that lead from the drawn pose to the first sample, and their number.

    An input that starts within a step of the drawn pose needs none; one that is not an array (..., n), or is
    one of several drives, gets none.
    """
    drive = inputs[0]
    if len(inputs) > 1 or drive.theta.ndim == 0:
        return list(inputs), 0
    drawn = np.asarray(machine.drawn_at[0], float)
    drawn = drawn.reshape(-1)[0] if drawn.size == 1 else drawn.reshape(-1, 1)
    near = np.abs(drive.theta - drawn).min(axis=-1).max()
    slides = isinstance(machine.driven_joint(machine.drives[0]), Prismatic)
    stride = max(near / LEAD, 1e-300) if slides else STRIDE
    count = int(np.ceil(near / stride)) if near > stride else 0
    if not count:
        return list(inputs), 0
    first = drive.theta[..., :1]
    lead = drawn + (first - drawn) * np.arange(count) / count
    theta = np.concatenate([lead, drive.theta], axis=-1)
    rates = [
        np.concatenate([np.full(lead.shape, value), one], axis=-1)
        for value, one in ((1.0, drive.omega), (0.0, drive.alpha), (0.0, drive.jerk))
    ]
    return [Turning(theta, *rates)], count


def _stops(theta: Array, begin: int, slides: bool) -> NDArray[np.intp]:
    """The samples that are followed one after the other: both ends, the first, and some between."""
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(theta, axis=-1)).max(axis=0))])
    stride = STRIDE * max(float(np.ptp(theta)), 1e-300) if slides else STRIDE
    marks = np.floor(way / stride)
    stops = np.flatnonzero(np.diff(marks, prepend=-1.0) > 0)
    return np.unique(np.concatenate([stops, [0, begin, len(way) - 1]]))


class _Way:
    """The poses of a cluster over the samples, for the equations of all designs."""

    def __init__(
        self, sought: ClusterEquations, standing: dict[str, BodyMotion], drives: list[Turning]
    ) -> None:
        self.sought, self.standing, self.drives = sought, standing, drives

    def at(self, sample: int) -> "_Here":
        """What stands, and the inputs, at a sample."""
        return _at(self.standing, self.drives, sample)

    def follow(self, x: Array, places: NDArray[np.intp]) -> None:
        """Fill in the poses at these samples, one after the other, from the first on, which is known."""
        for last, sample in zip(places[:-1].tolist(), places[1:].tolist(), strict=True):
            here, there = self.at(last), self.at(sample)
            x[sample] = _step(self.sought, x[last], self.sought.speeds(x[last], *here), here, there)

    def between(
        self, x: Array, stops: NDArray[np.intp], wide: ClusterEquations, everywhere: "_Here"
    ) -> list[tuple[int, int]]:
        """Fill in the poses between stops all at once; give the intervals that have to be followed."""
        samples, designs, count = x.shape
        theta = self.drives[0].theta.T
        low = stops[np.clip(np.searchsorted(stops, np.arange(samples), side="right") - 1, 0, stops.size - 2)]
        high = stops[np.clip(np.searchsorted(stops, low, side="right"), 0, stops.size - 1)]
        span = theta[high] - theta[low]
        with np.errstate(invalid="ignore", divide="ignore"):
            share = np.where(span != 0, (theta - theta[low]) / span, 0.0)[..., None]
        ahead = x[low] + share * (x[high] - x[low])
        found = _newton(wide, ahead.reshape(-1, count), *everywhere).reshape(samples, designs, count)
        scale = weights(found.reshape(-1, count))
        off, way = (np.abs(one * scale).max(axis=-1) for one in (found - ahead, x[high] - x[low]))
        sure = off <= QUARTER * way + 1e-6
        lost = ~np.isfinite(x[low]).all(axis=-1) & ~np.isfinite(x[high]).all(axis=-1)
        inner = np.ones(samples, bool)
        inner[stops] = False
        x[inner] = found[inner]
        unsure = np.unique(low[inner & ~(sure | lost).all(axis=-1)])
        return [(int(one), int(stops[np.searchsorted(stops, one) + 1])) for one in unsure]


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
        found[place] = _careful(sought.row(place), x[place : place + 1], last, here, place)
    return found


def _careful(sought: ClusterEquations, x: Array, last: _Here, here: _Here, place: int) -> Array:
    """The same of one design, with steps that are halved; NaN where it does not get there."""
    one, two = _one(last, place), _one(here, place)
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
