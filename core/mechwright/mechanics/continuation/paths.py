"""Paths of solutions while parameters move, all in one batch: predictors of fourth order, then Newton."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.continuation.system import System
from mechwright.mechanics.planar import Plane

ARRIVED, LOST, FAR = 0, 1, 2
"""How a path ends: at the wanted parameters, where the steps became too short, or beyond :data:`INFINITY`."""

CLOSE = 1e-9
"""Last step of Newton of a good step, as a share of each unknown or of 1."""

PREDICTED = 1e-3
"""Error of a prediction that is good, in the same measure."""

FIRST_STEP, SHORTEST, LONGEST = 0.02, 1e-8, 0.1
"""Steps, as shares of the way."""

GROWS_AFTER = 3
"""Good steps after which they become twice as long."""

MOST_STEPS = 1000
"""Steps of a path, tried ones included; a usual one takes fifty."""

INFINITY = 1e7
"""Size beyond which a solution counts as infinite; parameters are of the order of 1."""

_UNDERWAY = -1


@dataclass(frozen=True)
class Paths:
    """Where paths have come.

    Parameters
    ----------
    ends
        (n, m) solutions.
    how
        (n,) :data:`ARRIVED`, :data:`LOST` or :data:`FAR`.
    """

    ends: Plane
    how: NDArray[np.int64]

    @property
    def arrived(self) -> Plane:
        """Ends of those that arrived."""
        ends: Plane = self.ends[self.how == ARRIVED]
        return ends


def _solve(slopes: Plane, right: Plane) -> Plane:
    """Solutions (n, m); NaN where a system is singular or not finite."""
    with np.errstate(all="ignore"):
        scale = np.abs(slopes).max(axis=2)
        slopes, right = slopes / scale[:, :, None], right / scale
    able = np.flatnonzero(np.isfinite(slopes).all(axis=(1, 2)) & np.isfinite(right).all(axis=1))
    answer = np.full(right.shape, np.nan, dtype=complex)
    sign, size = np.linalg.slogdet(slopes[able])
    regular = able[(sign != 0) & np.isfinite(size)]
    answer[regular] = np.linalg.solve(slopes[regular], right[regular][..., None])[..., 0]
    return answer


def newton(system: System, z: Plane, parameters: Plane) -> tuple[Plane, Array]:
    """One step from unknowns (n, m): the next ones, and its sizes as shares of each unknown or of 1."""
    with np.errstate(all="ignore"):
        values, slopes, _ = system.at(z, parameters, np.zeros(parameters.shape[1], dtype=complex))
        step = _solve(slopes, values)
        size = (np.abs(step) / np.maximum(1, np.abs(z))).max(axis=1)
        return z - step, np.where(np.isfinite(size), size, np.inf)


def tracked(system: System, starts: Plane, begin: Plane, end: Plane) -> Paths:
    """Follow solutions (n, m) from the parameters ``begin`` (k,) to ``end`` on a straight line."""
    z, n, way = starts.copy(), len(starts), end - begin
    t, h, good = np.zeros(n), np.full(n, FIRST_STEP), np.zeros(n, dtype=int)
    how = np.full(n, _UNDERWAY)
    for _ in range(MOST_STEPS):
        on = np.flatnonzero(how == _UNDERWAY)
        if not on.size:
            break
        left = 1 - t[on]
        step = np.minimum(h[on], left)
        ends = np.where(h[on] >= left, 1.0, t[on] + step)
        trial, fine = _stepped(system, z[on], begin, way, t[on], ends)
        forth, back = on[fine], on[~fine]
        z[forth], t[forth] = trial[fine], ends[fine]
        good[forth] += 1
        grown = forth[good[forth] >= GROWS_AFTER]
        h[grown], good[grown] = np.minimum(2 * h[grown], LONGEST), 0
        h[back], good[back] = step[~fine] / 2, 0
        how[back[h[back] < SHORTEST]] = LOST
        how[forth[np.abs(z[forth]).max(axis=1) > INFINITY]] = FAR
        how[forth[t[forth] >= 1]] = ARRIVED
    return Paths(z, np.where(how == _UNDERWAY, LOST, how))


def _stepped(
    system: System, z: Plane, begin: Plane, way: Plane, t: Array, ends: Array
) -> tuple[Plane, NDArray[np.bool_]]:
    """Unknowns (n, m) after a step from ``t`` to ``ends`` (n,), and where the step is good."""

    def rate(at: Plane, time: Array) -> Plane:
        _, slopes, along = system.at(at, begin + time[:, None] * way, way)
        return _solve(slopes, -along)

    h = (ends - t)[:, None]
    there = begin + ends[:, None] * way
    with np.errstate(all="ignore"):
        k1 = rate(z, t)
        k2 = rate(z + h / 2 * k1, (t + ends) / 2)
        k3 = rate(z + h / 2 * k2, (t + ends) / 2)
        k4 = rate(z + h * k3, ends)
        guess = z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    guess, first = newton(system, guess, there)
    guess, last = newton(system, guess, there)
    return guess, (first < PREDICTED) & (last < CLOSE)
