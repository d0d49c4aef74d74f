"""Paths of solutions while the nine points move, compiled: predictors of fourth order, then Newton."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.synthesis.nine.equations import evaluate, solve

ARRIVED, LOST, FAR, SINGULAR = 0, 1, 2, 3
"""How a path ends: at the wanted points, where the steps became too short, beyond :data:`INFINITY`, or, as is
said of lost ones afterwards, in a singular solution."""

CLOSE = 1e-8
"""Last step of Newton of a good step, as a share of each unknown or of 1."""

PREDICTED = 1e-3
"""Error of a prediction that is good, in the same measure: the next step of Newton is some 1e-6 then."""

SHORTEST, LONGEST = 1e-8, 0.1
"""Steps, as shares of the way."""

INFINITY = 1e7
"""Sizes of the points beyond which a solution counts as infinite."""

FIRST_STEP = 0.01
"""Share of the way that is tried first."""

GROWS_AFTER = 3
"""Good steps after which they become twice as long."""


@compiled
def _rate(z: Plane, points: Plane, way: Plane, values: Plane, slopes: Plane, rate: Plane) -> bool:
    """dz/dt (8,) where the points move by ``way``; False where it is infinite."""
    evaluate(z, points, way, values, slopes, rate)
    for i in range(8):
        rate[i] = -rate[i]
    return solve(slopes, rate)


@compiled
def newton(z: Plane, points: Plane, values: Plane, slopes: Plane, along: Plane) -> float:
    """One step of Newton, in place; its size as a share of each unknown or of 1, infinite where it fails."""
    evaluate(z, points, points, values, slopes, along)
    if not solve(slopes, values):
        return np.inf
    size = 0.0
    for i in range(8):
        z[i] -= values[i]
        size = max(size, abs(values[i]) / max(1.0, abs(z[i])))
    if not size < np.inf:
        return np.inf
    return size


@compiled
def follow(
    starts: Plane, begin: Plane, end: Plane, close: float, predicted: float, shortest: float, longest: float,
    ends: Plane, how: NDArray[np.int64], reached: Array,
) -> int:  # fmt: skip
    """Follow solutions while the points move on a straight line.

    Parameters
    ----------
    starts
        (n, 8) solutions at ``begin``.
    begin, end
        (2, 8) points.
    close
        Greatest last step of Newton of a good step, as a share of each unknown or of 1.
    predicted
        Greatest error of the prediction, in the same measure.
    shortest, longest
        Least and greatest step, as a share of the way.
    ends
        (n, 8) where the paths end is written here.
    how
        (n,) how each ends: :data:`ARRIVED`, :data:`LOST` or :data:`FAR`.
    reached
        (n,) the share of the way that each has come.

    Returns
    -------
    int
        Steps that were tried, of all paths.
    """
    values, along = np.empty(8, np.complex128), np.empty(8, np.complex128)
    slopes = np.empty((8, 8), np.complex128)
    k1, k2 = np.empty(8, np.complex128), np.empty(8, np.complex128)
    k3, k4 = np.empty(8, np.complex128), np.empty(8, np.complex128)
    z, trial, guess = np.empty(8, np.complex128), np.empty(8, np.complex128), np.empty(8, np.complex128)
    way = end - begin
    here = np.empty_like(begin)
    steps = 0
    for n in range(starts.shape[0]):
        z[:] = starts[n]
        t, h, good = 0.0, min(FIRST_STEP, longest), 0
        state = LOST
        fresh = False
        while True:
            if t >= 1.0:
                state = ARRIVED
                break
            if not h > shortest:
                break
            step = min(h, 1.0 - t)
            steps += 1
            here[:] = begin + t * way
            if not fresh:
                if not _rate(z, here, way, values, slopes, k1):
                    break
                fresh = True
            here[:] = begin + (t + step / 2) * way
            trial[:] = z + (step / 2) * k1
            fine = _rate(trial, here, way, values, slopes, k2)
            if fine:
                trial[:] = z + (step / 2) * k2
                fine = _rate(trial, here, way, values, slopes, k3)
            here[:] = begin + (t + step) * way if t + step < 1.0 else end
            if fine:
                trial[:] = z + step * k3
                fine = _rate(trial, here, way, values, slopes, k4)
            if fine:
                guess[:] = z + (step / 6) * (k1 + 2 * k2 + 2 * k3 + k4)
                trial[:] = guess
                first = newton(trial, here, values, slopes, along)
                fine = first < predicted
                if fine:
                    fine = newton(trial, here, values, slopes, along) < close
            if not fine:
                h, good = step / 2, 0
                continue
            z[:] = trial
            t = t + step if t + step < 1.0 else 1.0
            fresh = False
            good += 1
            if good >= GROWS_AFTER:
                h, good = min(2 * h, longest), 0
            if np.abs(z).max() > INFINITY:
                state = FAR
                break
        ends[n] = z
        how[n] = state
        reached[n] = t
    return steps


@compiled
def settle(found: Plane, points: Plane, steps: int, last: Array) -> None:
    """Newton's steps on solutions (n, 8), in place; the size of the last step of each comes into ``last``."""
    values, along = np.empty(8, np.complex128), np.empty(8, np.complex128)
    slopes = np.empty((8, 8), np.complex128)
    for n in range(found.shape[0]):
        last[n] = np.inf
        for _ in range(steps):
            last[n] = newton(found[n], points, values, slopes, along)
            if not last[n] < np.inf:
                break


@dataclass(frozen=True)
class Paths:
    """Where paths have come.

    Parameters
    ----------
    ends
        (n, 8) solutions.
    how
        (n,) :data:`ARRIVED`, :data:`LOST` or :data:`FAR`.
    reached
        (n,) share of the way that each has come.
    """

    ends: Plane
    how: NDArray[np.int64]
    reached: Array


def tracked(
    starts: Plane, begin: Plane, end: Plane, predicted: float = PREDICTED, longest: float = LONGEST
) -> Paths:
    """Follow solutions (n, 8) from points ``begin`` (2, 8) to ``end`` on a straight line."""
    n = len(starts)
    ends, how, reached = np.empty_like(starts), np.empty(n, np.int64), np.empty(n)
    follow(starts, begin, end, CLOSE, predicted, SHORTEST, longest, ends, how, reached)
    return Paths(ends, how, reached)
