"""Compiled path points and transmission angles of many spherical linkages, for the search of a path.

A linkage is a row (k,) of unknowns as :mod:`mechwright_spherical.synthesis.four_bar_limits` and
:mod:`mechwright_spherical.synthesis.five_bar_limits` have them. Pins, and the place of the path point on the
coupler, are those of :mod:`mechwright_spherical.kinematics.chain`.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled

EDGE = 1e-12
"""As :data:`mechwright_spherical.kinematics.chain.EDGE`: rounding of a square that is 0 in a dead centre."""

Vector = tuple[float, float, float]


@compiled
def _joined(a: Vector, b: Vector, ca: float, cb: float, side: float) -> Vector:
    """The pin over pins a and b, from the cosines of its arcs to them; NaN where it cannot be."""
    tx, ty, tz, gx, gy, gz = a[0] + b[0], a[1] + b[1], a[2] + b[2], a[0] - b[0], a[1] - b[1], a[2] - b[2]
    p, q = math.sqrt(tx * tx + ty * ty + tz * tz), math.sqrt(gx * gx + gy * gy + gz * gz)
    along, across = (ca + cb) / p, (ca - cb) / q
    rest = 1 - along * along - across * across
    if not rest > -EDGE:
        return (math.nan, math.nan, math.nan)
    high = -side * math.sqrt(max(rest, 0.0)) / (p * q)
    along, across = along / p, across / q
    return (
        along * tx + across * gx + high * (ty * gz - tz * gy),
        along * ty + across * gy + high * (tz * gx - tx * gz),
        along * tz + across * gz + high * (tx * gy - ty * gx),
    )


@compiled
def _point(a: Vector, c: Vector, one: float, two: float, three: float) -> Vector:
    """The path point: shares of both pins and of their cross product."""
    return (
        one * a[0] + two * c[0] + three * (a[1] * c[2] - a[2] * c[1]),
        one * a[1] + two * c[1] + three * (a[2] * c[0] - a[0] * c[2]),
        one * a[2] + two * c[2] + three * (a[0] * c[1] - a[1] * c[0]),
    )


@compiled
def shares(kappa: float, eta: float, coupler: float) -> Vector:
    """Of the path point at azimuth and elevation over the coupler's arc."""
    two = math.cos(eta) * math.sin(kappa) / math.sin(coupler)
    return math.cos(eta) * math.cos(kappa) - two * math.cos(coupler), two, math.sin(eta) / math.sin(coupler)


@compiled
def _miss(p: Vector, turn: Array, target: Array, size: float, found: Array) -> None:
    """How far p, turned by a quaternion (4,) of length 1, is from a target (3,), in sizes."""
    w, x, y, z = turn[0], turn[1], turn[2], turn[3]
    tx, ty, tz = 2 * (y * p[2] - z * p[1]), 2 * (z * p[0] - x * p[2]), 2 * (x * p[1] - y * p[0])
    found[0] = (p[0] + w * tx + y * tz - z * ty - target[0]) / size
    found[1] = (p[1] + w * ty + z * tx - x * tz - target[1]) / size
    found[2] = (p[2] + w * tz + x * ty - y * tx - target[2]) / size


@compiled
def five_bars_missed(
    rows: Array, theta: Array, ratio: float, side: float, targets: Array, size: float
) -> Array:
    """Differences (m, n, 3) of five-bars (m, k) at crank angles (m, n) from targets (n, 3), in sizes."""
    found = np.empty((len(rows), theta.shape[1], 3))
    for i in range(len(rows)):
        x = rows[i]
        sg, cg, s1, c1, s4, c4 = (
            math.sin(x[0]), math.cos(x[0]), math.sin(x[1]), math.cos(x[1]), math.sin(x[4]), math.cos(x[4])
        )  # fmt: skip
        ca, cb = math.cos(x[2]), math.cos(x[3])
        one, two, three = shares(x[6], x[7], x[2])
        turn = x[8:12] / math.sqrt(x[8] ** 2 + x[9] ** 2 + x[10] ** 2 + x[11] ** 2)
        for j in range(theta.shape[1]):
            t = theta[i, j]
            phi = x[5] + ratio * t
            out = s4 * math.cos(phi)
            a = (s1 * math.cos(t), s1 * math.sin(t), c1)
            b = (sg * c4 + cg * out, s4 * math.sin(phi), cg * c4 - sg * out)
            p = _point(a, _joined(a, b, ca, cb, side), one, two, three)
            _miss(p, turn, targets[j], size, found[i, j])
    return found


@compiled
def four_bars_missed(rows: Array, theta: Array, side: float, targets: Array, size: float) -> Array:
    """Differences (m, n, 3) of four-bars (m, k) at input angles (m, n) from targets (n, 3), in sizes."""
    found = np.empty((len(rows), theta.shape[1], 3))
    for i in range(len(rows)):
        x = rows[i]
        c = (math.sin(x[0]), 0.0, math.cos(x[0]))
        sine, cosine, ca, cb = math.sin(x[1]), math.cos(x[1]), math.cos(x[2]), math.cos(x[3])
        one, two, three = shares(x[4], x[5], x[2])
        turn = x[6:10] / math.sqrt(x[6] ** 2 + x[7] ** 2 + x[8] ** 2 + x[9] ** 2)
        for j in range(theta.shape[1]):
            a = (sine * math.cos(theta[i, j]), sine * math.sin(theta[i, j]), cosine)
            p = _point(a, _joined(a, c, ca, cb, -side), one, two, three)
            _miss(p, turn, targets[j], size, found[i, j])
    return found


@compiled
def five_bars_pinched(
    rows: Array, first: Array, last: Array, ratio: float, stretches: int, fine: int
) -> Array:
    """Greatest cosines of μ and of 180° - μ in each stretch of the passage, (m, 2 stretches).

    Five-bars (m, k) run from crank angles (m,) to others in stretches of ``fine`` steps; an extreme of the
    diagonal between two steps is that of the parabola through three.
    """
    steps = stretches * fine
    found = np.empty((len(rows), 2 * stretches))
    values = np.empty(steps + 3)
    for i in range(len(rows)):
        x = rows[i]
        sg, cg, s1, c1, s4, c4 = (
            math.sin(x[0]), math.cos(x[0]), math.sin(x[1]), math.cos(x[1]), math.sin(x[4]), math.cos(x[4])
        )  # fmt: skip
        mean, factor = math.cos(x[2]) * math.cos(x[3]), math.sin(x[2]) * math.sin(x[3])
        step = (last[i] - first[i]) / steps
        t = first[i] - step
        phi = x[5] + ratio * t
        # Angles go on by products of complex numbers, which lose less than 1e-13 on the way.
        ct, st, cp, sp = math.cos(t), math.sin(t), math.cos(phi), math.sin(phi)
        dc, ds, ec, es = math.cos(step), math.sin(step), math.cos(ratio * step), math.sin(ratio * step)
        for j in range(steps + 3):
            across = s1 * ct * (sg * c4 + cg * s4 * cp) + s1 * st * s4 * sp
            values[j] = across + c1 * (cg * c4 - sg * s4 * cp)
            ct, st, cp, sp = ct * dc - st * ds, st * dc + ct * ds, cp * ec - sp * es, sp * ec + cp * es
        for k in range(stretches):
            least, most = math.inf, -math.inf
            for j in range(k * fine, (k + 1) * fine + 1):
                here = values[j + 1]
                rise, fall = here - values[j], here - values[j + 2]
                peak = rise * fall > 0
                # At the ends only what is inside: there the curve goes on as it came.
                if (j == 0 and abs(fall) >= abs(rise)) or (j == steps and abs(rise) >= abs(fall)):
                    peak = False
                if peak:
                    here += (rise - fall) ** 2 / (8 * (rise + fall))
                least, most = min(least, here), max(most, here)
            found[i, k] = (most - mean) / factor
            found[i, stretches + k] = (mean - least) / factor
    return found
