"""Compiled: how near and far the joints A and B1 come, and extremes over a period, of many five-bars.

Crank and arm of all of them are geared alike, so that they stand at the same angles θ and ρ θ at each sample;
of these a table (4, m) holds cos θ, sin θ, cos ρθ and sin ρθ. A linkage is a row (8,): crank a, coupler c,
rocker l, arm b and ground f, mm, the ground's angle γ and the arm's offset δ, rad, and the branch.

With x = θ - γ and y = δ + ρ θ - γ the squared distance of A and B1 is

    D² = f² + a² + b² + 2 f b cos y - 2 f a cos x - 2 a b cos(y - x);

the rates are those of :mod:`mechwright.mechanics.planar.dyad`, in real numbers.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.compiled import compiled

(
    COSINE, OMEGA_C, ALPHA_C, JERK_C, OMEGA_R, ALPHA_R, JERK_R, X, Y, VX, VY, AX, AY, JX, JY,
    A_X, A_Y, B_X, B_Y, S_X, S_Y, P_X, P_Y, NEARNESS, W1, V1, W2, V2, W3, ROWS,
) = range(30)  # fmt: skip
"""Rows of the table of a linkage; COSINE is the size of that between coupler and rocker, NEARNESS 2 / W."""

PARTS = OMEGA_C, ALPHA_C, OMEGA_R, ALPHA_R, X, Y
"""What :func:`quick` finds."""

_BLOCK = 256
"""Samples at a time: their table stays in the cache."""

_STEPS = 12
"""Newton's method within a bracket of a degree, halved where it leaves that: the slope's root to rounding."""


@compiled
def distances(bars: Array, ratio: float, theta: Array, table: Array) -> Array:
    """Least and greatest D² (n, 2), mm², over a period whose samples are at ``theta`` (m,), rad."""
    found = np.empty((len(bars), 2))
    for one in range(len(bars)):
        a, b, f = bars[one, 0], bars[one, 3], bars[one, 4]
        cg, sg = math.cos(bars[one, 5]), math.sin(bars[one, 5])
        shift = bars[one, 6] - bars[one, 5]
        cd, sd = math.cos(shift), math.sin(shift)
        fb, fa, ab, whole = 2 * f * b, 2 * f * a, 2 * a * b, f * f + a * a + b * b
        before, least, greatest = 0.0, math.inf, 0.0
        for i in range(len(theta)):
            cx, sx = table[0, i] * cg + table[1, i] * sg, table[1, i] * cg - table[0, i] * sg
            cy, sy = table[2, i] * cd - table[3, i] * sd, table[3, i] * cd + table[2, i] * sd
            slope = fa * sx - fb * ratio * sy + ab * (ratio - 1) * (sy * cx - cy * sx)
            square = whole + fb * cy - fa * cx - ab * (cy * cx + sy * sx)
            least, greatest = min(least, square), max(greatest, square)
            if i > 0 and (slope > 0) != (before > 0):
                low, high, at = theta[i - 1], theta[i], (theta[i - 1] + theta[i]) / 2
                for _ in range(_STEPS):
                    x, y = at - bars[one, 5], shift + ratio * at
                    now = fa * math.sin(x) - fb * ratio * math.sin(y) + ab * (ratio - 1) * math.sin(y - x)
                    bend = (
                        fa * math.cos(x)
                        - fb * ratio**2 * math.cos(y)
                        + ab * (ratio - 1) ** 2 * math.cos(y - x)
                    )
                    if (now > 0) == (before > 0):
                        low = at
                    else:
                        high = at
                    at = at - now / bend
                    if not low <= at <= high:
                        at = (low + high) / 2
                x, y = at - bars[one, 5], shift + ratio * at
                square = whole + fb * math.cos(y) - fa * math.cos(x) - ab * math.cos(y - x)
                least, greatest = min(least, square), max(greatest, square)
            before = slope
        found[one, 0], found[one, 1] = least, greatest
    return found


@compiled
def _placed(
    bar: Array, ratio: float, offset: tuple[float, float], pivot: tuple[float, float], turn: tuple[float, ...]
) -> tuple[float, ...]:
    """Joints A and B1, directions of coupler and rocker, 2 / W, and two rates of both, at one angle.

    ``offset`` is cosine and sine of δ, ``pivot`` is B0, ``turn`` what the table has at that angle.
    """
    a, c, l, b, branch = bar[0], bar[1], bar[2], bar[3], bar[7]
    ax, ay = a * turn[0], a * turn[1]
    bx, by = b * (offset[0] * turn[2] - offset[1] * turn[3]), b * (offset[1] * turn[2] + offset[0] * turn[3])
    dx, dy = pivot[0] + bx - ax, pivot[1] + by - ay
    square = dx * dx + dy * dy
    w = branch * math.sqrt(((c + l) ** 2 - square) * (square - (c - l) ** 2))
    k, h = (c - l) * (c + l) + square, (0.5 / c) / square
    sx, sy = (dx * k - dy * w) * h, (dx * w + dy * k) * h
    px, py = (c * sx - dx) * (1 / l), (c * sy - dy) * (1 / l)
    # The sine between both is -W / 2 c l.
    near = 2 / w
    one, two = near * l, near * c
    rx, ry = ay - ratio * by, ratio * bx - ax
    w1, v1 = one * (rx * px + ry * py), two * (rx * sx + ry * sy)
    cs, lp = c * w1 * w1, l * v1 * v1
    rx = ax - ratio * ratio * bx + cs * sx - lp * px
    ry = ay - ratio * ratio * by + cs * sy - lp * py
    w2, v2 = one * (rx * px + ry * py), two * (rx * sx + ry * sy)
    return ax, ay, bx, by, sx, sy, px, py, near, w1, v1, w2, v2


@compiled
def _rates(bar: Array, ratio: float, omega: float, table: Array, start: int, size: int, rows: Array) -> None:
    """Joints, directions of coupler and rocker, and two rates."""
    pivot = bar[4] * math.cos(bar[5]), bar[4] * math.sin(bar[5])
    offset, sense = (math.cos(bar[6]), math.sin(bar[6])), math.copysign(1.0, omega)
    for i in range(size):
        at = start + i
        turn = table[0, at], sense * table[1, at], table[2, at], sense * table[3, at]
        ax, ay, bx, by, sx, sy, px, py, near, w1, v1, w2, v2 = _placed(bar, ratio, offset, pivot, turn)
        rows[A_X, i], rows[A_Y, i], rows[B_X, i], rows[B_Y, i] = ax, ay, bx, by
        rows[S_X, i], rows[S_Y, i], rows[P_X, i], rows[P_Y, i] = sx, sy, px, py
        rows[NEARNESS, i], rows[COSINE, i] = near, abs(sx * px + sy * py)
        rows[W1, i], rows[V1, i], rows[W2, i], rows[V2, i] = w1, v1, w2, v2
        rows[OMEGA_C, i], rows[OMEGA_R, i] = w1 * omega, v1 * omega
        rows[ALPHA_C, i], rows[ALPHA_R, i] = w2 * omega * omega, v2 * omega * omega


@compiled
def _sum(
    bar: Array, ratio: float, sense: float, point: Array, parts: Array, turns: tuple[Array, ...], out: Array
) -> None:
    """A sum (m,) of rates and of the point's place, each times one of ``parts`` (6,): see :data:`PARTS`.

    It writes one row alone, so that several samples run at once.
    """
    pivot = bar[4] * math.cos(bar[5]), bar[4] * math.sin(bar[5])
    offset = math.cos(bar[6]), math.sin(bar[6])
    cos, sin, arm_cos, arm_sin = turns
    for i in range(out.size):
        turn = cos[i], sense * sin[i], arm_cos[i], sense * arm_sin[i]
        ax, ay, _, _, sx, sy, _, _, _, w1, v1, w2, v2 = _placed(bar, ratio, offset, pivot, turn)
        x, y = ax + point[0] * sx - point[1] * sy, ay + point[0] * sy + point[1] * sx
        out[i] = parts[0] * w1 + parts[1] * w2 + parts[2] * v1 + parts[3] * v2 + parts[4] * x + parts[5] * y


@compiled
def quick(bars: Array, ratio: float, omega: Array, points: Array, table: Array, row: int) -> Array:
    """Least and greatest value (n, 2) of one of :data:`PARTS`; arguments are those of :func:`extremes`."""
    found, out, parts = np.empty((len(bars), 2)), np.empty(table.shape[1]), np.zeros(6)
    turns = table[0], table[1], table[2], table[3]
    for one in range(len(bars)):
        w, more = omega[one], 0.0
        if row in (X, Y):
            parts[4 + (row == Y)], more = 1.0, points[one, 2 + (row == Y)]
        else:
            place = (row == ALPHA_C) + 2 * (row == OMEGA_R) + 3 * (row == ALPHA_R)
            parts[place] = w * w if place % 2 else w
        _sum(bars[one], ratio, math.copysign(1.0, w), points[one], parts, turns, out)
        least, greatest = out[0], out[0]
        for i in range(out.size):
            least, greatest = min(least, out[i]), max(greatest, out[i])
        found[one, 0], found[one, 1] = least + more, greatest + more
    return found


@compiled
def _third(bar: Array, ratio: float, omega: float, size: int, rows: Array) -> None:
    """Third rates."""
    c, l, cube = bar[1], bar[2], ratio**3
    for i in range(size):
        sx, sy, px, py = rows[S_X, i], rows[S_Y, i], rows[P_X, i], rows[P_Y, i]
        w1, v1, w2, v2 = rows[W1, i], rows[V1, i], rows[W2, i], rows[V2, i]
        cs, ct, lp, lt = 3 * c * w1 * w2, c * w1**3, 3 * l * v1 * v2, l * v1**3
        rx = cube * rows[B_Y, i] - rows[A_Y, i] + cs * sx - ct * sy - lp * px + lt * py
        ry = rows[A_X, i] - cube * rows[B_X, i] + cs * sy + ct * sx - lp * py - lt * px
        w3 = rows[NEARNESS, i] * l * (rx * px + ry * py)
        v3 = rows[NEARNESS, i] * c * (rx * sx + ry * sy)
        rows[W3, i] = w3
        rows[JERK_C, i], rows[JERK_R, i] = w3 * omega**3, v3 * omega**3


@compiled
def _traced(omega: float, point: Array, size: int, rows: Array) -> None:
    """The coupler point, up to its jerk."""
    for i in range(size):
        x, y, sx, sy = rows[A_X, i], rows[A_Y, i], rows[S_X, i], rows[S_Y, i]
        qx, qy = point[0] * sx - point[1] * sy, point[0] * sy + point[1] * sx
        v, g, h = rows[OMEGA_C, i], rows[ALPHA_C, i], rows[JERK_C, i]
        rows[X, i], rows[Y, i] = point[2] + x + qx, point[3] + y + qy
        rows[VX, i], rows[VY, i] = -omega * y - v * qy, omega * x + v * qx
        rows[AX, i] = -omega * omega * x - g * qy - v * v * qx
        rows[AY, i] = -omega * omega * y + g * qx - v * v * qy
        turned = h - v**3
        rows[JX, i] = omega**3 * y - turned * qy - 3 * v * g * qx
        rows[JY, i] = -(omega**3) * x + turned * qx - 3 * v * g * qy


@compiled
def extremes(
    bars: Array,
    ratio: float,
    omega: Array,
    points: Array,
    table: Array,
    wanted: NDArray[np.int64],
    deep: bool,
    traced: bool,
) -> Array:
    """Least and greatest values (n, k, 2) of the ``wanted`` rows (k,) over the samples of a period.

    Parameters
    ----------
    bars, table
        As the module says.
    ratio
        ρ, below 0 where crank and arm turn against each other.
    omega
        Of the crank (n,), rad/s, below 0 clockwise; constant.
    points
        (n, 4): coupler point in the coupler's frame, and A0, mm.
    deep, traced
        Whether third rates are wanted, and the coupler point, which needs them.
    """
    found = np.empty((len(bars), len(wanted), 2))
    rows, count = np.empty((ROWS, _BLOCK)), table.shape[1]
    for one in range(len(bars)):
        found[one, :, 0], found[one, :, 1] = math.inf, -math.inf
        for start in range(0, count, _BLOCK):
            size = min(_BLOCK, count - start)
            _rates(bars[one], ratio, omega[one], table, start, size, rows)
            if deep:
                _third(bars[one], ratio, omega[one], size, rows)
            if traced:
                _traced(omega[one], points[one], size, rows)
            for place in range(len(wanted)):
                row = rows[wanted[place]]
                least, greatest = found[one, place, 0], found[one, place, 1]
                for i in range(size):
                    least, greatest = min(least, row[i]), max(greatest, row[i])
                found[one, place, 0], found[one, place, 1] = least, greatest
    return found
