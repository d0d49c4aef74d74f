"""Least squares for many linkages at once, the crank angles eliminated point by point.

Levenberg and Marquardt's method on the unknowns x and one crank angle θ per point. θ stands in the rows of
its own point alone, so it is taken out there: with the unit tangent u of the path, the rows keep
I - u uᵀ/(1+λ) of themselves, and what is left has as many columns as x has entries, however many points there
are. The reduced system is solved by orthogonal factors, not by normal equations, which would lose half the
digits of the nearly singular systems that an exact number of points makes. As λ falls the steps become those
of Newton. After each step the angles of a phase are brought back into the order of its points.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.adjustable.mechanism import Pins
from mechwright.mechanics.adjustable.order import isotonic
from mechwright.mechanics.adjustable.task import Task

SLOPE = 1e-6
"""Step of central differences, for unknowns of the order of 1: their error is 1e-10."""

FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-2, 1e-15, 1e8
"""Marquardt's λ at the start; where steps are Newton's; and where a start has given up."""

LONGEST_STEP = 0.5
"""Most that an unknown or an angle changes in a step, rad or a part of the path's size."""

ARRIVED = 1e-28
"""Sum of squares, in sizes of the path, that is rounding."""

WEIGHTS = (1.0, 10.0, 100.0)
"""Of the limits, one after the other: a start is led to them, then held."""


@dataclass(frozen=True, slots=True)
class Fit:
    """Fitted linkages: unknowns (s, k), crank angles (s, n), rad, and sums of squares (s,).

    ``squares`` are those of the points' distances, in sizes of the path; ``excess`` the most by which a limit
    is passed.
    """

    x: Array
    theta: Array
    squares: Array
    excess: Array

    def best(self, count: int) -> "Fit":
        """The nearest ones, first the nearest; limits that are passed count as distance."""
        order = np.argsort(self.squares + self.excess**2, kind="stable")[:count]
        return Fit(self.x[order], self.theta[order], self.squares[order], self.excess[order])


def fit(task: Task, x: Array, theta: Array, steps: int, weights: tuple[float, ...] = WEIGHTS) -> Fit:
    """Fit from starts (s, k) and (s, n); ``steps`` for each of the weights."""
    sense = _senses(task, theta)
    for weight in weights:
        x, theta = _fit(task, x, _ordered(task, theta, sense), sense, weight, steps)
    squares = (task.misses(x, theta) ** 2).sum(axis=(-1, -2))
    return Fit(x, theta, squares, task.excess(x, theta).max(axis=-1))


def _senses(task: Task, theta: Array) -> Array:
    """Sense (s, n) in which the crank goes through each point's phase, from the last one's angle."""
    last = np.array([np.flatnonzero(task.phase == k)[-1] for k in range(task.unknowns.phases)])
    return np.where(theta[:, last][:, task.phase] >= 0, 1.0, -1.0)


def _ordered(task: Task, theta: Array, sense: Array) -> Array:
    """The nearest angles that go one way from the pose of setting, within a turn."""
    found = theta * sense
    for phase in range(task.unknowns.phases):
        own = task.phase == phase
        found[:, own] = np.clip(isotonic(found[:, own]), 0.0, math.tau)
    return np.asarray(found * sense)


def _fit(task: Task, x: Array, theta: Array, sense: Array, weight: float, steps: int) -> tuple[Array, Array]:
    x, theta = x.copy(), theta.copy()
    live = np.arange(len(x))
    damping = np.full(len(x), FIRST_DAMPING)
    cost = _cost(task, x, theta, weight)
    live = live[np.isfinite(cost)]
    for _ in range(steps):
        live = live[(damping[live] < MOST_DAMPING) & (cost[live] > ARRIVED)]
        if live.size == 0:
            break
        dx, dt = _step(task, x[live], theta[live], damping[live], weight)
        dx, dt = (np.where(np.isfinite(one), one, 0.0) for one in (dx, dt))
        most = np.maximum(np.abs(dx).max(axis=1), np.abs(dt).max(axis=1)) / LONGEST_STEP
        scale = 1 / np.maximum(most, 1.0)[:, None]
        new_x = x[live] + scale * dx
        new_theta = _ordered(task, theta[live] + scale * dt, sense[live])
        new = _cost(task, new_x, new_theta, weight)
        better = new < cost[live]
        good = live[better]
        x[good], theta[good], cost[good] = new_x[better], new_theta[better], new[better]
        damping[live] = np.where(better, np.maximum(damping[live] / 5, LEAST_DAMPING), damping[live] * 4)
    return x, theta


def _cost(task: Task, x: Array, theta: Array, weight: float) -> Array:
    with np.errstate(all="ignore"):
        pins = task.unknowns.pins(x)
        squares = (task.missed(pins, theta) ** 2).sum(axis=(-1, -2))
        return np.asarray(squares + ((weight * task.exceeded(pins, theta)) ** 2).sum(axis=-1))


def _step(task: Task, x: Array, theta: Array, damping: Array, weight: float) -> tuple[Array, Array]:
    """Steps (s, k) and (s, n)."""
    # All places about x in one go: the arrays are small, and each call on them costs more than its numbers.
    steps = SLOPE * _units(x.shape[1])
    with np.errstate(all="ignore"):
        pins = task.unknowns.pins(np.concatenate([x[None], x + steps, x - steps]))
        miss, gained = _central(task.missed(pins, theta))
        here = Pins(*(getattr(pins, name)[..., :1, :, :] for name in Pins.__slots__))
        ahead, behind = task.missed(here, np.stack([theta + SLOPE, theta - SLOPE]))
        excess, passed = _central(task.exceeded(pins, theta))
    tangent, slopes = (ahead - behind) / (2 * SLOPE), gained / (2 * SLOPE)
    limits, limit_slopes = weight * excess, passed * (weight / (2 * SLOPE))
    length = np.sqrt((tangent**2).sum(axis=-1)) + 1e-150
    unit = tangent / length[..., None]
    kept = 1 / (1 + damping)[:, None]
    share = 1 - np.sqrt(1 - kept)  # (I - share u uᵀ)² = I - kept u uᵀ
    along = np.einsum("snd,snd->sn", unit, miss)
    along_slopes = np.einsum("snd,sndk->snk", unit, slopes)
    rest = miss - (share * along)[..., None] * unit
    rest_slopes = slopes - (share[..., None] * along_slopes)[:, :, None, :] * unit[..., None]
    count = len(x)
    rows = np.concatenate([rest_slopes.reshape(count, -1, x.shape[1]), limit_slopes], axis=1)
    values = np.concatenate([rest.reshape(count, -1), limits], axis=1)
    dx = _solved(rows, values, damping)
    on = along + np.einsum("snk,sk->sn", along_slopes, dx)
    return dx, -on / length * kept


def _central(values: Array) -> tuple[Array, Array]:
    """Values (...) at x, and differences (..., k) over two steps of each unknown, of those at all places."""
    ahead, behind = np.split(values[1:], 2)
    return values[0], np.moveaxis(ahead - behind, 0, -1)


def _solved(rows: Array, values: Array, damping: Array) -> Array:
    """Least squares (s, k) of rows (s, m, k), damped in proportion to the columns."""
    good = np.asarray(np.isfinite(rows).all(axis=(1, 2)) & np.isfinite(values).all(axis=1))
    rows = np.where(good[:, None, None], rows, 0.0)
    values = np.where(good[:, None], values, 0.0)
    size = np.sqrt((rows**2).sum(axis=1))
    size = np.maximum(size, 1e-6 * size.max(axis=1, keepdims=True) + 1e-12)
    scaled = rows / size[:, None, :]
    k = rows.shape[2]
    damped = np.sqrt(damping)[:, None, None] * np.eye(k)
    q, r = np.linalg.qr(np.concatenate([scaled, damped], axis=1))
    right = np.einsum("smk,sm->sk", q[:, : rows.shape[1]], values)
    weak = np.abs(np.diagonal(r, axis1=1, axis2=2)).min(axis=1) < 1e-150
    r[weak] = np.eye(k)
    found = -np.linalg.solve(r, right[..., None])[..., 0] / size
    return np.where((weak | ~good)[:, None], 0.0, found)


def _units(size: int) -> Array:
    return np.eye(size)[:, None, :]
