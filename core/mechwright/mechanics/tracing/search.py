"""Linkages near prescribed points, within limits, from many random starts in rounds.

In each round, for every room, many random linkages are compared with the points; the best take some steps, of
these the best more, and the best of these are brought to rest with all limits kept. The search ends when the
same best has come back in several rounds, when enough linkages meet the points, or when all starts are used.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.multistart import distinct
from mechwright.mechanics.tracing.descent import Traced, descend, excess, settle, squares

SEARCH = 0.8
"""Part of a synthesis' work that is the search; the rest looks whether the designs can be built."""

MORE = 4
"""Distinct designs that are looked at for each one that is given: some of them cannot be built."""

MARGIN = 1e-9
"""Share, rad or cosine by which a search keeps inside every limit, so that rounding never breaks one."""

EXACT = 1e-11
"""Mean distance, as a share of the path's size, that is rounding: the points are met."""

STAGES = ((96, 12, 1.0), (32, 24, 10.0), (12, 40, 30.0))
"""How many of the best go on, for how many steps, and the weight of the limits meanwhile."""

SETTLED, LAST_STEPS = 15, 200
"""Most steps between two changes of the multipliers, and of those that come close in the end."""

SETTLING = 4
"""How many of the last stage are brought to rest besides those that are near: others seldom win."""

CLOSE, NEAR, FINISHED = 1e-3, 1e-4, 2
"""Root mean square distances, in sizes of the path, from which points may be met exactly in the end, by a
linkage that still comes nearer or by any; and how many of a room are followed there: where the points hardly
tell linkages apart, the way is long and flat."""

COMING = 0.9
"""Share of its distance that is left of a linkage that still comes nearer, after it was brought to rest."""

MET, ENOUGH = 1e-8, 1e-6
"""Root mean square distances, in sizes of the path: at which points are met exactly and a linkage is left as
it is; and at which it counts among those that are enough, a tenth of a micrometre on a path of 100 mm."""

BROKEN = 1e-8
"""A linkage at rest that passes a limit by more is beyond it."""

SAME_START, SAME = 1e-3, 1e-2
"""Unknowns that agree so far are one start, and one linkage where those that meet the points are counted."""

AGAIN, SAME_SQUARES = 3, 1e-3
"""Rounds that have to bring the best back, and the share of the sum of squares within which they have."""


class Room(Traced, Protocol):
    """Linkages of one branch and one sense of the crank."""

    @property
    def sense(self) -> int:
        """In which the crank goes through the points, +1 or -1."""

    def starts(self, count: int, rng: np.random.Generator) -> tuple[Array, Array, Array]:
        """Random unknowns (m, k), angles (m, n), and what to rank them by (m,); m is at most ``count``."""


@dataclass(frozen=True)
class Trace:
    """A linkage at rest.

    Parameters
    ----------
    room
        Number of its room.
    x, theta
        Unknowns (k,) and crank angles (n,), rad.
    mean
        Root mean square distance from the points, in sizes of the path.
    excess
        The most by which it passes a limit; 0 or less where it keeps all.
    """

    room: int
    x: Array
    theta: Array
    mean: float
    excess: float

    @property
    def kept(self) -> bool:
        """Whether it keeps all limits."""
        return self.excess <= BROKEN


@dataclass(frozen=True)
class Traces:
    """What a search has found: linkages within the limits, the nearest first, and those beyond one."""

    kept: tuple[Trace, ...]
    beyond: tuple[Trace, ...]
    starts: int


def search(
    rooms: Sequence[Room],
    starts: int,
    rounds: int,
    wanted: int,
    seed: int,
    met: float,
    progress: Callable[[float], None],
) -> Traces:
    """Linkages of all rooms near the points.

    Parameters
    ----------
    starts, rounds
        Random linkages of a room in one round, and most rounds.
    wanted
        How many distinct linkages that meet the points are enough.
    met
        Root mean square distance, in sizes of the path, that counts as met.
    progress
        Told the part that is done, 0 to 1.
    """
    found: list[Trace] = []
    best: list[float] = []
    tried = 0
    for turn in range(rounds):
        fresh: list[Trace] = []
        for number, room in enumerate(rooms):
            rng = np.random.default_rng([seed, turn, number])
            x, theta, cost = room.starts(starts, rng)
            tried += len(x)
            fresh += _at_rest(room, number, x, theta, cost)
            progress((turn + (number + 1) / len(rooms)) / rounds)
            if _enough([*found, *fresh], wanted, max(met, ENOUGH)):
                break
        found += fresh
        best.append(min((one.mean for one in fresh if one.kept), default=math.inf))
        if _enough(found, wanted, max(met, ENOUGH)) or _again(best, max(met, MET)):
            break
    found.sort(key=lambda one: one.mean)
    kept, beyond = (tuple(one for one in found if one.kept is good) for good in (True, False))
    return Traces(kept, beyond, tried)


def _enough(found: Sequence[Trace], wanted: int, met: float) -> bool:
    """Whether enough distinct linkages meet the points."""
    exact = [one.x for one in found if one.kept and one.mean <= met]
    return len(exact) >= wanted and len(distinct(np.array(exact), SAME)) >= wanted


def _again(best: Sequence[float], met: float) -> bool:
    """Whether the best has come back in enough rounds."""
    least = min(best)
    same = max(least * math.sqrt(1 + SAME_SQUARES), 10 * met)
    return math.isfinite(least) and sum(one <= same for one in best) >= AGAIN


def _at_rest(room: Room, number: int, x: Array, theta: Array, cost: Array) -> list[Trace]:
    """Of starts those that lead nearest to the points, at rest."""
    order = np.argsort(cost, kind="stable")[: STAGES[0][0]]
    order = order[np.isfinite(cost[order])]
    x, theta = x[order], theta[order]
    for most, steps, weight in STAGES:
        x, theta = x[:most], theta[:most]
        x, theta = descend(room, x, theta, _senses(room, x), weight, steps)
        price = squares(room, x, theta) + np.maximum(weight * excess(room, x, theta), 0.0) ** 2
        order = np.argsort(np.where(np.isfinite(price), price, np.inf), kind="stable")
        order = order[np.isfinite(price[order])]
        x, theta = x[order], theta[order]
        if len(x):
            one = distinct(x, SAME_START)
            x, theta = x[one], theta[one]
    near = np.sqrt(squares(room, x, theta) / theta.shape[1]) < NEAR
    near[:SETTLING] = True
    return followed(room, number, x[near], theta[near])


def followed(room: Room, number: int, x: Array, theta: Array) -> list[Trace]:
    """Linkages (s, k), (s, n) brought to rest within the limits; those that come close, to where they end."""
    if not len(x):
        return []
    before = np.sqrt(squares(room, x, theta) / theta.shape[1])
    x, theta = settle(room, x, theta, _senses(room, x), SETTLED)
    mean = np.sqrt(squares(room, x, theta) / theta.shape[1])
    close = np.flatnonzero((mean > MET) & (mean < np.where(mean < COMING * before, CLOSE, NEAR)))
    close = close[np.argsort(mean[close], kind="stable")][:FINISHED]
    if close.size:
        x[close], theta[close] = settle(room, x[close], theta[close], _senses(room, x[close]), LAST_STEPS)
        mean = np.sqrt(squares(room, x, theta) / theta.shape[1])
    over = excess(room, x, theta)
    good = np.isfinite(mean) & np.isfinite(over)
    return [
        Trace(number, x[k], theta[k], float(mean[k]), float(over[k])) for k in np.flatnonzero(good).tolist()
    ]


def _senses(room: Room, x: Array) -> Array:
    return np.full((len(x), 1), float(room.sense))


ROUND = 6000
"""Random linkages of a room in one round."""


def rounds_of(starts: int) -> int:
    """Rounds in which at most so many random linkages of a room are tried."""
    return max(1, math.ceil(starts / ROUND))
