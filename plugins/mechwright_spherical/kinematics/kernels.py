"""Compiled extremes of a travel, and the room between crank and rocker, for many four-bars.

A linkage is a row (5,): the arcs ground, input, coupler and output, rad, and the branch; it lies as
:mod:`mechwright_spherical.kinematics.four_bar` has it. A drive is a row (4,): start and travel, rad, whether
it rocks, and the speed, rad/s. With a and b the pins, o and c the axes, n = c x b and m = c x n,
a.b = cos α3 gives

    ψ'   = -a'.b / a.n,                     ψ'' = -(a''.b + 2 a'.b' + ψ'² a.m) / a.n,
    ψ''' = -(a'''.b + 3 a''.b' + 3 a'.b'' + 3 ψ' ψ'' a.m - ψ'³ a.n) / a.n
"""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled

OMEGA, ALPHA, JERK, OMEGA_PSI, ALPHA_PSI, JERK_PSI, ROWS = range(7)
"""Rows of extremes."""


def circle_of(samples: int) -> Array:
    """Cosine and sine of shares of a turn, and the shares (3, samples), both ends included."""
    share = np.linspace(0.0, 1.0, samples)
    return np.ascontiguousarray([np.cos(math.tau * share), np.sin(math.tau * share), share])


@compiled
def _pin(
    ax: float, ay: float, az: float, cx: float, cz: float, ca: float, cb: float, branch: float
) -> tuple[float, float, float]:
    """The pin b over the pin a and the axis c = (cx, 0, cz), from the cosines of coupler and output."""
    px, pz, qx, qz = ax + cx, az + cz, ax - cx, az - cz
    p, q = px * px + ay * ay + pz * pz, qx * qx + ay * ay + qz * qz
    along, across = (ca + cb) / p, (ca - cb) / q
    high = branch * math.sqrt(max(1 - along * (ca + cb) - across * (ca - cb), 0.0) / (p * q))
    # (a + c) x (a - c)
    wx, wy, wz = ay * qz - pz * ay, pz * qx - px * qz, px * ay - ay * qx
    return (
        along * px + across * qx + high * wx,
        (along + across) * ay + high * wy,
        along * pz + across * qz + high * wz,
    )


@compiled
def extremes(bars: Array, drives: Array, circle: Array) -> Array:
    """Least and greatest rates (n, ROWS, 2) of input and output at samples of a period.

    ``circle`` is (3, m): cosine and sine of the samples' shares of a turn, and the shares.
    """
    found = np.empty((len(bars), ROWS, 2))
    rows = np.empty((ROWS, circle.shape[1]))
    for one in range(len(bars)):
        bar, drive = bars[one], drives[one]
        size, az, cx, cz = math.sin(bar[1]), math.cos(bar[1]), math.sin(bar[0]), math.cos(bar[0])
        ca, cb, branch = math.cos(bar[2]), math.cos(bar[3]), bar[4]
        start, travel, rocks, speed = drive[0], drive[1], drive[2], drive[3]
        for i in range(circle.shape[1]):
            if rocks > 0:
                theta, half = start + travel / 2 * (1 - circle[0, i]), travel / 2
                cos, sin = math.cos(theta), math.sin(theta)
                omega, alpha = half * speed * circle[1, i], half * speed * speed * circle[0, i]
                jerk = -half * speed**3 * circle[1, i]
            else:
                cos, sin, omega, alpha, jerk = circle[0, i], circle[1, i], speed, 0.0, 0.0
            ax, ay = size * cos, size * sin
            bx, by, bz = _pin(ax, ay, az, cx, cz, ca, cb, branch)
            # n = c x b and m = c x n, c = (cx, 0, cz)
            nx, ny, nz = -cz * by, cz * bx - cx * bz, cx * by
            mx, my, mz = -cz * ny, cz * nx - cx * nz, cx * ny
            an, am = ax * nx + ay * ny + az * nz, ax * mx + ay * my + az * mz
            by_ = -1 / an
            one_ = (ax * by - ay * bx) * by_
            b1x, b1y = one_ * nx, one_ * ny
            two = (-ax * bx - ay * by + 2 * (ax * b1y - ay * b1x) + one_ * one_ * am) * by_
            b2x, b2y = two * nx + one_ * one_ * mx, two * ny + one_ * one_ * my
            three = (ay * bx - ax * by) - 3 * (ax * b1x + ay * b1y) + 3 * (ax * b2y - ay * b2x)
            three = (three + 3 * one_ * two * am - one_**3 * an) * by_
            rows[OMEGA, i], rows[ALPHA, i], rows[JERK, i] = omega, alpha, jerk
            rows[OMEGA_PSI, i], rows[ALPHA_PSI, i] = one_ * omega, two * omega * omega + one_ * alpha
            rows[JERK_PSI, i] = three * omega**3 + 3 * two * omega * alpha + one_ * jerk
        for row in range(ROWS):
            found[one, row, 0], found[one, row, 1] = rows[row].min(), rows[row].max()
    return found


@compiled
def _to_arc(px: float, py: float, pz: float, s: Array, e: Array, nx: float, ny: float, nz: float) -> float:
    """Cosine of the angle from a point to the arc from s to e, whose unit normal is given."""
    ahead = (ny * s[2] - nz * s[1]) * px + (nz * s[0] - nx * s[2]) * py + (nx * s[1] - ny * s[0]) * pz
    behind = (e[1] * nz - e[2] * ny) * px + (e[2] * nx - e[0] * nz) * py + (e[0] * ny - e[1] * nx) * pz
    if ahead > 0 and behind > 0:
        beside = nx * px + ny * py + nz * pz
        return math.sqrt(max(1 - beside * beside, 0.0))
    ends: float = max(s[0] * px + s[1] * py + s[2] * pz, e[0] * px + e[1] * py + e[2] * pz)
    return ends


@compiled
def _within(px: float, py: float, pz: float, s: Array, e: Array, nx: float, ny: float, nz: float) -> bool:
    """Whether a point of an arc's great circle lies on the arc."""
    ahead = (ny * s[2] - nz * s[1]) * px + (nz * s[0] - nx * s[2]) * py + (nx * s[1] - ny * s[0]) * pz
    behind = (e[1] * nz - e[2] * ny) * px + (e[2] * nx - e[0] * nz) * py + (e[0] * ny - e[1] * nx) * pz
    found: bool = ahead > 0 and behind > 0
    return found


@compiled
def nearest(bars: Array, drives: Array, circle: Array) -> Array:
    """How near crank and rocker come at samples of the way (n, 3).

    The greatest cosine of the angle from an end of one to the other's arc, that of the angle between ends,
    and 1 where they cross, else 0. Of two arcs that do not cross an end is nearest: the distance to a great
    circle has no least value but where it is 0.
    """
    found = np.empty((len(bars), 3))
    o, a, b, c = np.array((0.0, 0.0, 1.0)), np.empty(3), np.empty(3), np.empty(3)
    for one in range(len(bars)):
        bar, drive = bars[one], drives[one]
        size, turned = math.sin(bar[1]), math.sin(bar[3])
        a[2], c[0], c[1], c[2] = math.cos(bar[1]), math.sin(bar[0]), 0.0, math.cos(bar[0])
        ca, cb, branch = math.cos(bar[2]), math.cos(bar[3]), bar[4]
        arc, end, cross = -1.0, c[2], 0.0
        for i in range(circle.shape[1]):
            if drive[2] > 0:
                theta = drive[0] + drive[1] * circle[2, i]
                cos, sin = math.cos(theta), math.sin(theta)
            else:
                cos, sin = circle[0, i], circle[1, i]
            a[0], a[1] = size * cos, size * sin
            b[0], b[1], b[2] = _pin(a[0], a[1], a[2], c[0], c[2], ca, cb, branch)
            end = max(end, b[2], a[0] * c[0] + a[2] * c[2], a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
            # The normal of the crank's circle, o x a, and of the rocker's, c x b.
            fx, fy = -sin, cos
            gx, gy, gz = -c[2] * b[1] / turned, (c[2] * b[0] - c[0] * b[2]) / turned, c[0] * b[1] / turned
            arc = max(
                arc,
                _to_arc(o[0], o[1], o[2], c, b, gx, gy, gz),
                _to_arc(a[0], a[1], a[2], c, b, gx, gy, gz),
                _to_arc(c[0], c[1], c[2], o, a, fx, fy, 0.0),
                _to_arc(b[0], b[1], b[2], o, a, fx, fy, 0.0),
            )
            lx, ly, lz = fy * gz, -fx * gz, fx * gy - fy * gx
            for sign in (1.0, -1.0):
                x, y, z = sign * lx, sign * ly, sign * lz
                if _within(x, y, z, o, a, fx, fy, 0.0) and _within(x, y, z, c, b, gx, gy, gz):
                    cross = 1.0
        found[one, 0], found[one, 1], found[one, 2] = arc, end, cross
    return found
