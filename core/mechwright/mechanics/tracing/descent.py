"""Least squares for many linkages at once, the crank angles eliminated point by point.

Levenberg and Marquardt's method on the unknowns x and one crank angle θ per point. θ stands in the rows of
its own point alone, so it is taken out there: with the unit tangent u of the path, the rows keep
I - u uᵀ/(1+λ) of themselves, and what is left has as many columns as x has entries, however many points there
are. The reduced system is solved by orthogonal factors, not by normal equations, which would lose half the
digits of the nearly singular systems that an exact number of points makes. As λ falls the steps become those
of Newton. Each step follows the bend of its way: the residuals a part of the way along it say how the slopes
change, and the same factors give what that asks for (geodesic acceleration; Transtrum and Sethna 2012), so
that long narrow valleys are followed in few steps. Then the angles are brought back into the order of the
points.

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

AHEAD, BENT = 0.1, 0.75
"""Part of a step after which its bend is looked at, and the most of a step that the bend may add."""

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
    system = _System(slopes, tangent, limit_slopes, damping)
    dx, dt = system.solved(miss, limits)
    # Along the step, second derivatives by the residuals a part of the way.
    with np.errstate(all="ignore"):
        made = traced.made(x + AHEAD * dx)
        seen = theta + AHEAD * dt
        bent = traced.missed(made, seen) - miss
        bent_limits = np.where(limits > 0, weight * (traced.exceeded(made, seen) - over), 0.0)
        bent -= AHEAD * (np.einsum("sndk,sk->snd", slopes, dx) + tangent * dt[..., None])
        bent_limits -= AHEAD * np.einsum("sqk,sk->sq", limit_slopes, dx)
    ax, at = system.solved(bent / AHEAD**2, bent_limits / AHEAD**2)
    small = np.hypot(_norm(ax), _norm(at)) <= BENT * np.hypot(_norm(dx), _norm(dt))
    return dx + np.where(small, ax, 0.0), dt + np.where(small, at, 0.0)


def _norm(rows: Array) -> Array:
    found: Array = np.sqrt((rows**2).sum(axis=-1, keepdims=True))
    return found


class _System:
    """Linear least squares of many linkages (s), damped, the angles of their points taken out."""

    def __init__(self, slopes: Array, tangent: Array, limit_slopes: Array, damping: Array) -> None:
        """From slopes (s, n, d, k), tangents (s, n, d) and slopes of the limits (s, q, k)."""
        length = np.sqrt((tangent**2).sum(axis=-1)) + 1e-150
        self.unit, self.length = tangent / length[..., None], length
        self.kept = 1 / (1 + damping)[:, None]
        self.share = 1 - np.sqrt(1 - self.kept)  # (I - share u uᵀ)² = I - kept u uᵀ
        self.along = np.einsum("snd,sndk->snk", self.unit, slopes)
        rest = slopes - (self.share[..., None] * self.along)[:, :, None, :] * self.unit[..., None]
        count, k = len(slopes), slopes.shape[-1]
        rows = np.concatenate([rest.reshape(count, -1, k), limit_slopes], axis=1)
        self.good = np.asarray(np.isfinite(rows).all(axis=(1, 2)))
        rows = np.where(self.good[:, None, None], rows, 0.0)
        size = np.sqrt((rows**2).sum(axis=1))
        self.size = np.maximum(size, 1e-6 * size.max(axis=1, keepdims=True) + 1e-12)
        damped = np.sqrt(damping)[:, None, None] * np.eye(k)
        q, self.r = np.linalg.qr(np.concatenate([rows / self.size[:, None, :], damped], axis=1))
        self.q = q[:, : rows.shape[1]]
        weak = np.abs(np.diagonal(self.r, axis1=1, axis2=2)).min(axis=1) < 1e-150
        self.r[weak] = np.eye(k)
        self.good &= ~weak

    def solved(self, miss: Array, limits: Array) -> tuple[Array, Array]:
        """Steps (s, k) and (s, n) that take away misses (s, n, d) and what limits are passed by (s, q)."""
        along = np.einsum("snd,snd->sn", self.unit, miss)
        rest = miss - (self.share * along)[..., None] * self.unit
        values = np.concatenate([rest.reshape(len(miss), -1), limits], axis=1)
        good = self.good & np.isfinite(values).all(axis=1)
        right = np.einsum("smk,sm->sk", self.q, np.where(good[:, None], values, 0.0))
        dx = -np.linalg.solve(self.r, right[..., None])[..., 0] / self.size
        dx = np.where(good[:, None], dx, 0.0)
        on = along + np.einsum("snk,sk->sn", self.along, dx)
        return dx, -on / self.length * self.kept


def _differences(values: Array, fine: bool) -> tuple[Array, Array]:
    """Values (...) at x, and slopes (..., k) by each unknown, of those at all places."""
    if not fine:
        return values[0], np.moveaxis(values[1:] - values[0], 0, -1) / ONE_SIDED
    ahead, behind = np.split(values[1:], 2)
    return values[0], np.moveaxis(ahead - behind, 0, -1) / (2 * SLOPE)
