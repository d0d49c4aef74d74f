"""Least squares for many linkages at once, the crank angles eliminated point by point.

Levenberg and Marquardt's method on the unknowns x and one crank angle θ per point. θ stands in the rows of
its own point alone, so it is taken out there: with the unit tangent u of the path, the rows keep
I - u uᵀ/(1+λ) of themselves, and what is left has as many columns as x has entries, however many points there
are. The reduced system is solved by orthogonal factors, not by normal equations, which would lose half the
digits of the nearly singular systems that an exact number of points makes. As λ falls the steps become those
of Newton. After each step the angles are brought back into the order of the points.

A limit g ≤ 0 of weight w and multiplier m adds the residual max(0, w g + m): with m = 0 a penalty, and an
augmented Lagrangian where m becomes that residual whenever the descent has come to rest
(:func:`settle`; Powell, Hestenes and Rockafellar).
"""

from typing import Any, Protocol

import numpy as np

from mechwright.arrays import Array

SLOPE = 1e-6
"""Step of central differences, for unknowns of the order of 1: their error is 1e-10."""

ONE_SIDED = 1e-8
"""Step of differences to one side, whose error is 1e-8: enough for steps that are not yet the last."""

FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-2, 1e-15, 1e8
"""Marquardt's λ at the start; where steps are Newton's; and where a start has given up."""

LONGEST_STEP = 0.5
"""Most that an unknown or an angle changes in a step, rad or a part of the path's size."""

STILL = 1e-11
"""Step, rad or a part of the path's size, after which a start has arrived, or is damped to a standstill."""

ARRIVED = 1e-28
"""Sum of squares, in sizes of the path, that is rounding."""

WEIGHT = 30.0
"""Weight of limits that are to be kept exactly."""

OUTER, KEPT, MOST_WEIGHT = 15, 1e-9, 1e4
"""Most changes of the multipliers; by how much a limit may be broken at the end; most by which the weight
grows where changes of the multipliers alone do not bring a limit down."""


class Traced(Protocol):
    """A linkage whose point is led through points; ``made`` is what it makes of its unknowns."""

    def made(self, x: Array) -> Any:
        """The linkages of unknowns (..., k)."""

    def missed(self, made: Any, theta: Array) -> Array:
        """Differences (..., n, d) from the points at crank angles (..., n), in sizes of the path."""

    def exceeded(self, made: Any, theta: Array) -> Array:
        """By how much each limit is passed, (..., q); 0 or less where it is kept."""

    def ordered(self, theta: Array, sense: Array) -> Array:
        """The nearest angles (s, n) in the order of the points, for senses (s, 1) or (s, n)."""


def squares(traced: Traced, x: Array, theta: Array) -> Array:
    """Sums of squares (s,) of the distances, in sizes of the path."""
    with np.errstate(all="ignore"):
        found: Array = (traced.missed(traced.made(x), theta) ** 2).sum(axis=(-1, -2))
    return found


def excess(traced: Traced, x: Array, theta: Array) -> Array:
    """The most by which linkages (s,) pass a limit; 0 or less where they keep all."""
    with np.errstate(all="ignore"):
        found: Array = traced.exceeded(traced.made(x), theta).max(axis=-1)
    return found


def descend(
    traced: Traced,
    x: Array,
    theta: Array,
    sense: Array,
    weight: Array | float,
    steps: int,
    multipliers: Array | float = 0.0,
    fine: bool = False,
) -> tuple[Array, Array]:
    """Take at most ``steps`` steps from starts (s, k) and (s, n).

    ``weight`` of the limits is one, or (s, 1); ``multipliers`` are none, or (s, q). Slopes are differences to
    one side, or if ``fine`` to both, which take twice as long.
    """
    x, theta = x.copy(), traced.ordered(theta, sense)
    count = len(x)
    weights = np.broadcast_to(np.asarray(weight, dtype=float), (count, 1))
    pushed = np.asarray(multipliers, dtype=float)
    pushed = np.broadcast_to(pushed, (count, pushed.shape[-1] if pushed.ndim else 1))
    live = np.arange(count)
    damping = np.full(count, FIRST_DAMPING)
    cost = _cost(traced, x, theta, weights, pushed)
    live = live[np.isfinite(cost)]
    for _ in range(steps):
        live = live[(damping[live] < MOST_DAMPING) & (cost[live] > ARRIVED)]
        if live.size == 0:
            break
        dx, dt = _step(traced, x[live], theta[live], damping[live], weights[live], pushed[live], fine)
        dx, dt = (np.where(np.isfinite(one), one, 0.0) for one in (dx, dt))
        most = np.maximum(np.abs(dx).max(axis=1), np.abs(dt).max(axis=1)) / LONGEST_STEP
        scale = 1 / np.maximum(most, 1.0)[:, None]
        new_x = x[live] + scale * dx
        new_theta = traced.ordered(theta[live] + scale * dt, sense[live])
        new = _cost(traced, new_x, new_theta, weights[live], pushed[live])
        better = new < cost[live]
        good = live[better]
        x[good], theta[good], cost[good] = new_x[better], new_theta[better], new[better]
        damping[live] = np.where(better, np.maximum(damping[live] / 5, LEAST_DAMPING), damping[live] * 4)
        live = live[most * LONGEST_STEP > STILL]
    return x, theta


def settle(traced: Traced, x: Array, theta: Array, sense: Array, steps: int) -> tuple[Array, Array]:
    """Descend from starts (s, k) and (s, n) until the limits are kept, ``steps`` between two changes."""
    x, theta = x.copy(), theta.copy()
    size = traced.exceeded(traced.made(x[:1]), theta[:1]).shape[-1]
    multipliers = np.zeros((len(x), size))
    weight = np.full((len(x), 1), WEIGHT)
    before = np.full(len(x), np.inf)
    live = np.arange(len(x))
    for _ in range(OUTER):
        x[live], theta[live] = descend(
            traced, x[live], theta[live], sense[live], weight[live], steps, multipliers[live], fine=True
        )
        with np.errstate(all="ignore"):
            over = traced.exceeded(traced.made(x[live]), theta[live])
        worst = over.max(axis=1)
        new = np.maximum(0.0, weight[live] * over + multipliers[live])
        moved = np.abs(new - multipliers[live]).max(axis=1)
        multipliers[live] = new
        slow = (worst > before[live] / 4) & (worst > KEPT) & (weight[live, 0] < MOST_WEIGHT * WEIGHT)
        done = ~np.isfinite(worst) | ((worst <= KEPT) & (moved <= KEPT * weight[live, 0]))
        weight[live[slow]] *= 3
        multipliers[live[slow]] /= 3
        before[live] = worst
        live = live[~done]
        if live.size == 0:
            break
    return x, theta


def _cost(traced: Traced, x: Array, theta: Array, weight: Array, pushed: Array) -> Array:
    with np.errstate(all="ignore"):
        made = traced.made(x)
        misses = (traced.missed(made, theta) ** 2).sum(axis=(-1, -2))
        over = np.maximum(weight * traced.exceeded(made, theta) + pushed, 0.0)
        return np.asarray(misses + (over**2).sum(axis=-1))


def _step(
    traced: Traced, x: Array, theta: Array, damping: Array, weight: Array, pushed: Array, fine: bool
) -> tuple[Array, Array]:
    """Steps (s, k) and (s, n)."""
    # All places about x in one go: the arrays are small, and each call on them costs more than its numbers.
    steps = (SLOPE if fine else ONE_SIDED) * np.eye(x.shape[1])[:, None, :]
    places = [x[None], x + steps, x - steps] if fine else [x[None], x + steps]
    with np.errstate(all="ignore"):
        made = traced.made(np.concatenate(places))
        miss, slopes = _differences(traced.missed(made, theta), fine)
        here = traced.made(x[None])
        ahead, behind = traced.missed(here, np.stack([theta + SLOPE, theta - SLOPE]))
        over, passed = _differences(traced.exceeded(made, theta), fine)
    tangent = (ahead - behind) / (2 * SLOPE)
    limits = np.maximum(weight * over + pushed, 0.0)
    limit_slopes = np.where((limits > 0)[..., None], passed * weight[..., None], 0.0)
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


def _differences(values: Array, fine: bool) -> tuple[Array, Array]:
    """Values (...) at x, and slopes (..., k) by each unknown, of those at all places."""
    if not fine:
        return values[0], np.moveaxis(values[1:] - values[0], 0, -1) / ONE_SIDED
    ahead, behind = np.split(values[1:], 2)
    return values[0], np.moveaxis(ahead - behind, 0, -1) / (2 * SLOPE)


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
