"""Adjustable linkages through points of each phase, from many random starts.

First the first phase alone: with the pose of setting given it has more unknowns than a few points have
equations, so many linkages pass through it. Each then asks for the other phases: from the pose of setting its
pivots are set everywhere on a grid, and the best places start the fit of all phases together.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.adjustable.fit import Fit, fit
from mechwright.mechanics.adjustable.mechanism import Pins, Unknowns, follow
from mechwright.mechanics.adjustable.space import Points
from mechwright.mechanics.adjustable.task import Limits, Task
from mechwright.mechanics.tracing.order import assigned

FITTED = 48
"""Random starts of the first phase that are fitted, in each round."""

LED = 12
"""Linkages of the first phase for which other phases are looked for."""

PLACES = 3
"""Places of the pivots on the grid from which a phase is fitted."""

SCAN = 20
"""Angles of each pivot at the setting, on the grid."""

SAMPLES = 48
"""Crank angles at which a path is compared with points before the fit."""

STEPS = 40
"""Of a fit, for each weight of the limits."""

HOPELESS = 1e9
"""Cost of a linkage that means nothing."""

SHORT, LONG = 0.1, 4.0
"""Lengths of random links, in sizes of the path, where the limits allow them: log-uniform."""


@dataclass(frozen=True, slots=True)
class Path:
    """Points (n + 1,) of each phase in order, the pose of setting first, and their size."""

    phases: tuple[Points, ...]
    size: float

    def task(self, unknowns: Unknowns, limits: Limits, count: int | None = None) -> Task:
        """The task of all phases, or of the first ``count``."""
        taken = self.phases[:count]
        number = np.concatenate([np.full(one.shape[-1] - 1, k) for k, one in enumerate(taken)])
        targets = np.concatenate([one[..., 1:] for one in taken], axis=-1)
        return Task(replace(unknowns, phases=len(taken)), targets, number, self.size, limits)


def search(
    path: Path,
    unknowns: Unknowns,
    limits: Limits,
    starts: int,
    seed: int,
    progress: Callable[[float], None],
) -> Fit:
    """Linkages near the points, the nearest first; several may be the same.

    Parameters
    ----------
    path
        What is wanted.
    unknowns
        The linkage; its space stands in the path's first point.
    limits
        Kept by penalties: look at ``Fit.excess``.
    starts
        Random linkages to compare with the first phase.
    seed
        Of the random numbers.
    progress
        Told the part that is done, 0 to 1.
    """
    rng = np.random.default_rng(seed)
    alone = path.task(unknowns, limits, 1)
    one = replace(unknowns, phases=1)
    x = _random(one, path, limits, starts, rng)
    costs, theta = _compared(one, path, 0, one.pins(x), limits)
    order = np.argsort(costs, kind="stable")[:FITTED]
    first = fit(alone, x[order], theta[order], STEPS).best(FITTED)
    progress(0.4)
    if unknowns.phases == 1:
        return first
    led = _apart(first)
    begun = [_begun(unknowns, path, limits, first.x[k], first.theta[k]) for k in led]
    starts_x = np.concatenate([x for x, _ in begun])
    starts_theta = np.concatenate([theta for _, theta in begun])
    progress(0.6)
    task = path.task(unknowns, limits)
    rough = fit(task, starts_x, starts_theta, STEPS // 2, (1.0, 10.0)).best(FITTED // 2)
    progress(0.8)
    found = fit(task, rough.x, rough.theta, 2 * STEPS, (10.0, 100.0)).best(FITTED)
    progress(1.0)
    return found


def _random(one: Unknowns, path: Path, limits: Limits, count: int, rng: np.random.Generator) -> Array:
    """Unknowns (count, k) of linkages of one phase, within the limits of length where they can be."""
    space, p = one.space, one.space.pose_point()
    p = p.reshape((*p.shape, 1, 1))

    def lengths(n: int) -> Array:
        low, high = (
            math.log(max(limits.shortest, 0.05 * path.size)),
            math.log(min(limits.longest, 4 * path.size)),
        )
        return np.exp(rng.uniform(low, max(low, high), (n, 1)))

    def angle(n: int) -> Array:
        return rng.uniform(0, math.tau, (n, 1))

    a, c = (space.around(p, lengths(count), angle(count)) for _ in "ac")
    a0, b1 = space.around(a, lengths(count), angle(count)), space.around(c, lengths(count), angle(count))
    b0 = b1 if one.bars == 4 else space.around(b1, lengths(count), angle(count))
    return one.of_pins(Pins(*np.broadcast_arrays(a0, a, b0, b1, c, p)))


def _compared(unknowns: Unknowns, path: Path, phase: int, pins: Pins, limits: Limits) -> tuple[Array, Array]:
    """Sums of squares (s,) of the best assignment of a phase's points, and crank angles (s, n).

    ``pins`` (s, 1) are those of that phase. The crank may go either way.
    """
    targets = path.phases[phase][..., 1:]
    costs, angles = [], []
    for sense in (1.0, -1.0):
        theta = sense * np.linspace(0.0, math.tau, SAMPLES, endpoint=False)
        with np.errstate(all="ignore"):
            curve, cosine = follow(unknowns.space, pins, unknowns.ratio, theta)
            apart = unknowns.space.misses(curve[..., None], targets[..., None, :]) / path.size
        pinched = np.maximum(np.abs(cosine) - math.cos(limits.least_transmission), 0.0)
        distances = (apart**2).sum(axis=-1) + pinched[..., None]
        sums, chosen = assigned(np.nan_to_num(distances, nan=HOPELESS, posinf=HOPELESS))
        whole = pinched.mean(axis=-1) if limits.full_turn else 0.0
        costs.append(np.nan_to_num(sums + whole, nan=HOPELESS))
        angles.append(theta[chosen])
    better = costs[1] < costs[0]
    return np.where(better, costs[1], costs[0]), np.where(better[:, None], angles[1], angles[0])


def _apart(found: Fit) -> list[int]:
    """The nearest linkages of the first phase that differ from each other."""
    taken: list[int] = []
    for k in range(len(found.x)):
        if all(np.abs(found.x[k] - found.x[other]).max() > 0.02 for other in taken):
            taken.append(k)
        if len(taken) == LED:
            break
    return taken


def _begun(unknowns: Unknowns, path: Path, limits: Limits, x: Array, theta: Array) -> tuple[Array, Array]:
    """Starts (s, k), (s, n) of all phases from one linkage of the first phase, the pivots set on a grid."""
    space = unknowns.space
    one = replace(unknowns, phases=1).pins(x[None])
    grid = math.tau / SCAN * np.arange(SCAN)
    alpha, beta = (angle.reshape(-1, 1) for angle in np.meshgrid(grid, grid, indexing="ij"))
    columns, angles = [[_row(one, 0)] * PLACES], [np.broadcast_to(theta, (PLACES, theta.size))]
    for phase in range(1, unknowns.phases):
        if unknowns.moves == "fixed":
            pins = Pins(*np.broadcast_arrays(
                space.turn(one.a, alpha, one.a0), one.a,
                space.turn(one.c, beta, one.b0), space.turn(one.c, beta, one.b1), one.c, one.p,
            ))  # fmt: skip
        else:
            pins = Pins(*np.broadcast_arrays(
                one.a0, space.turn(one.a0, alpha, one.a),
                one.b0, one.b1, space.turn(one.b1, beta, one.c), one.p,
            ))  # fmt: skip
        costs, found = _compared(unknowns, path, phase, pins, limits)
        wrong = (space.side(pins.a, pins.b1, pins.c) != space.side(one.a, one.b1, one.c))[:, 0]
        order = np.argsort(np.where(wrong, np.inf, costs), kind="stable")[:PLACES]
        columns.append([_row(pins, int(k)) for k in order])
        angles.append(found[order])
    starts = [unknowns.of_pins(_joined(column)) for column in zip(*columns, strict=True)]
    return np.stack(starts), np.concatenate(angles, axis=-1)


def _row(pins: Pins, k: int) -> Pins:
    """One of many sets (s, 1) of pins, as (1,)."""
    return Pins(*(getattr(pins, name)[..., k, :] for name in Pins.__slots__))


def _joined(phases: tuple[Pins, ...]) -> Pins:
    """The pins (phases,) of several phases (1,) in one set."""
    return Pins(*(np.concatenate([getattr(one, name) for one in phases], axis=-1) for name in Pins.__slots__))
