"""Compiled extremes of a period, for many four-bars one after the other: 5 ns a sample, where arrays take 25.

With a the crank as a vector, d = f - a from A to B0, s and p the directions of coupler and follower, so that
c s - b p = d, all that :mod:`mechwright.mechanics.planar.dyad` needs are real products of two of them:

    a·d = u - a²,  a×d = -t        u = a f cos x, t = a f sin x, x the crank's angle from the ground line
    s·p = (b² + c² - D²) / 2bc,    p×s = -W / 2bc,    W² = ((b + c)² - D²) (D² - (b - c)²)
    a·s + i a×s = (a·d + i a×d) (k + iW) / 2cD²,      a·p = (c a·s - a·d) / b,  a×p = (c a×s - a×d) / b

W with the sign of the branch, and with n = 1 / p×s the rates per radian of the crank

    σ'   =  n a×p / c,                                     ψ'   =  n a×s / b
    σ''  = -n (a·p + c σ'² s·p - b ψ'²) / c,               ψ''  = -n (a·s + c σ'² - b ψ'² s·p) / b
    σ''' = -n (a×p + 3c σ' σ'' s·p - 3b ψ' ψ'') / c + σ'³
    ψ''' = -n (a×s + 3c σ' σ'' - 3b ψ' ψ'' s·p) / b + ψ'³

A linkage is a row (6,): crank a, coupler c, follower b and ground f, mm, the ground's angle, rad, and the
branch. A drive is a row (5,): start and travel, rad, whether it rocks, acceleration ratio, and speed, rad/s.
Quantities over the samples are rows of a table; loops without branches run on several samples at once.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.compiled_point import point_rates

(
    COS, SIN, THETA, OMEGA_A, ALPHA_A, JERK_A, A_S, AXS, COSINE, SINE, S1, S2, S3, P1, P2, P3,
    OMEGA_C, ALPHA_C, JERK_C, OMEGA_B, ALPHA_B, JERK_B, SIGMA, PSI, X, Y, VX, VY, AX, AY, JX, JY, ROWS,
) = range(33)  # fmt: skip
"""Rows of the table; COSINE is the size of that between coupler and follower."""


@compiled
def _drive(drive: Array, circle: Array, rows: Array) -> None:
    """Crank angles and rates, as :class:`mechwright.mechanics.planar.Course` has them."""
    start, travel, rocks, ratio, speed = drive[0], drive[1], drive[2], drive[3], drive[4]
    sense = math.copysign(1.0, travel)
    for i in range(circle.shape[1]):
        if rocks > 0:
            rows[THETA, i] = start + travel / 2 * (1 - circle[0, i])
            rows[COS, i], rows[SIN, i] = math.cos(rows[THETA, i]), math.sin(rows[THETA, i])
            rows[OMEGA_A, i] = travel / 2 * speed * circle[1, i]
            rows[ALPHA_A, i] = travel / 2 * speed * speed * circle[0, i]
            rows[JERK_A, i] = -travel / 2 * speed**3 * circle[1, i]
        else:
            rows[THETA, i] = travel * circle[2, i]
            rows[COS, i], rows[SIN, i] = circle[0, i], sense * circle[1, i]
            omega = sense * speed * (math.exp(ratio * rows[THETA, i]) if ratio != 0 else 1.0)
            rows[OMEGA_A, i], rows[ALPHA_A, i] = omega, ratio * omega * omega
            rows[JERK_A, i] = 2 * ratio * ratio * omega**3


@compiled
def _rates(bar: Array, rows: Array) -> None:
    """Angles between the links, and two rates."""
    a, c, b, f = bar[0], bar[1], bar[2], bar[3]
    cos, sin, branch = math.cos(bar[4]), math.sin(bar[4]), bar[5]
    most, least, whole, off = (c + b) ** 2, (c - b) ** 2, a * a + f * f, (c - b) * (c + b)
    for i in range(rows.shape[1]):
        u = a * f * (rows[COS, i] * cos + rows[SIN, i] * sin)
        t = a * f * (rows[SIN, i] * cos - rows[COS, i] * sin)
        square = whole - 2 * u
        w = branch * math.sqrt((most - square) * (square - least))
        k, by, ad = square + off, 0.5 / (c * square), u - a * a
        a_s, axs = (ad * k + t * w) * by, (ad * w - t * k) * by
        cosine, sine = (most + least - 2 * square) / (4 * b * c), -w / (2 * b * c)
        n = 1 / sine
        a_p, axp = (c * a_s - ad) / b, (c * axs + t) / b
        s1, p1 = n * axp / c, n * axs / b
        cs, bp = c * s1 * s1, b * p1 * p1
        rows[A_S, i], rows[AXS, i], rows[SINE, i] = a_s, axs, sine
        rows[COSINE, i], rows[S1, i], rows[P1, i] = abs(cosine), s1, p1
        rows[S2, i], rows[P2, i] = -n * (a_p + cs * cosine - bp) / c, -n * (a_s + cs - bp * cosine) / b
        square = rows[OMEGA_A, i] * rows[OMEGA_A, i]
        rows[OMEGA_C, i], rows[OMEGA_B, i] = s1 * rows[OMEGA_A, i], p1 * rows[OMEGA_A, i]
        rows[ALPHA_C, i] = rows[S2, i] * square + s1 * rows[ALPHA_A, i]
        rows[ALPHA_B, i] = rows[P2, i] * square + p1 * rows[ALPHA_A, i]


@compiled
def _third(bar: Array, rows: Array) -> None:
    """Third rates."""
    a, c, b, f = bar[0], bar[1], bar[2], bar[3]
    cos, sin, whole = math.cos(bar[4]), math.sin(bar[4]), b * b + c * c - a * a - f * f
    for i in range(rows.shape[1]):
        u = a * f * (rows[COS, i] * cos + rows[SIN, i] * sin)
        t = a * f * (rows[SIN, i] * cos - rows[COS, i] * sin)
        cosine, n = (whole + 2 * u) / (2 * b * c), 1 / rows[SINE, i]
        s1, p1 = rows[S1, i], rows[P1, i]
        cs, bp = 3 * c * s1 * rows[S2, i], 3 * b * p1 * rows[P2, i]
        axs = rows[AXS, i]
        s3 = -n * ((c * axs + t) / b + cs * cosine - bp) / c + s1**3
        p3 = -n * (axs + cs - bp * cosine) / b + p1**3
        rows[S3, i], rows[P3, i] = s3, p3
        omega, alpha, jerk = rows[OMEGA_A, i], rows[ALPHA_A, i], rows[JERK_A, i]
        rows[JERK_C, i] = s3 * omega**3 + 3 * rows[S2, i] * omega * alpha + s1 * jerk
        rows[JERK_B, i] = p3 * omega**3 + 3 * rows[P2, i] * omega * alpha + p1 * jerk


@compiled
def _angles(bar: Array, rows: Array) -> None:
    """Angles of coupler and follower, which run on from the first."""
    a, c = bar[0], bar[1]
    fx, fy = bar[3] * math.cos(bar[4]), bar[3] * math.sin(bar[4])
    for i in range(rows.shape[1]):
        cos, sin = rows[COS, i], rows[SIN, i]
        sx, sy = (rows[A_S, i] * cos - rows[AXS, i] * sin) / a, (rows[A_S, i] * sin + rows[AXS, i] * cos) / a
        rows[SIGMA, i] = math.atan2(sy, sx)
        rows[PSI, i] = math.atan2(c * sy + a * sin - fy, c * sx + a * cos - fx)
        if i > 0:
            for row in (SIGMA, PSI):
                rows[row, i] -= math.tau * np.rint((rows[row, i] - rows[row, i - 1]) / math.tau)


@compiled
def _traced(bar: Array, point: Array, rows: Array) -> None:
    """The coupler point, up to its jerk."""
    a = bar[0]
    for i in range(rows.shape[1]):
        cos, sin = rows[COS, i], rows[SIN, i]
        sx, sy = (rows[A_S, i] * cos - rows[AXS, i] * sin) / a, (rows[A_S, i] * sin + rows[AXS, i] * cos) / a
        x, y = a * cos, a * sin
        qx, qy = point[0] * sx - point[1] * sy, point[0] * sy + point[1] * sx
        rows[X, i], rows[Y, i] = point[2] + x + qx, point[3] + y + qy
        crank = rows[OMEGA_A, i], rows[ALPHA_A, i], rows[JERK_A, i]
        coupler = rows[OMEGA_C, i], rows[ALPHA_C, i], rows[JERK_C, i]
        rates = point_rates(x, y, qx, qy, crank, coupler)
        rows[VX, i], rows[VY, i], rows[AX, i], rows[AY, i], rows[JX, i], rows[JY, i] = rates


@compiled
def extremes(
    bars: Array,
    drives: Array,
    points: Array,
    circle: Array,
    wanted: NDArray[np.int64],
    deep: bool,
    angles: NDArray[np.bool_],
    traced: bool,
) -> Array:
    """Least and greatest values (n, k, 2) of rows over a period.

    Parameters
    ----------
    bars, drives
        (n, 6) and (n, 5), as the module says.
    points
        (n, 4): coupler point in the coupler's frame, and A0, mm.
    circle
        (3, m): cosine and sine of the samples' shares of a turn, and the shares.
    wanted
        (k, 2): rows, and of how many samples one is taken.
    deep, traced
        Whether third rates are wanted, and the coupler point, which needs them.
    angles
        (n,) whether the angles of the links are.
    """
    found = np.empty((len(bars), len(wanted), 2))
    rows = np.empty((ROWS, circle.shape[1]))
    for one in range(len(bars)):
        if one == 0 or (drives[one] != drives[one - 1]).any():
            _drive(drives[one], circle, rows)
        _rates(bars[one], rows)
        if deep:
            _third(bars[one], rows)
        if angles[one]:
            _angles(bars[one], rows)
        if traced:
            _traced(bars[one], points[one], rows)
        for place in range(len(wanted)):
            row = rows[wanted[place, 0]]
            least, greatest = row[0], row[0]
            for i in range(0, len(row), wanted[place, 1]):
                least, greatest = min(least, row[i]), max(greatest, row[i])
            found[one, place, 0], found[one, place, 1] = least, greatest
    return found


@compiled
def most_force(bars: Array, drives: Array, inertias: Array, circle: Array) -> Array:
    """What no joint force exceeds at any sample (n,), mN.

    ``inertias`` are (n, 9): of coupler and follower mass, the farthest that any of it lies from the first
    joint, and moment of inertia about that, kg, mm, kg mm², each of them or more; the crank's mass and
    farthest place; and the size of the follower's load, mN mm.

    Moments of the follower about B0 and of the coupler about A give the components p and q of the force in B
    across both, so that it is at most (|p| + |q|) over the sine of the angle between them; the other joints
    add what accelerates the links.
    """
    found = np.zeros(len(bars))
    rows = np.empty((ROWS, circle.shape[1]))
    for one in range(len(bars)):
        a, c, b, mass = bars[one, 0], bars[one, 1], bars[one, 2], inertias[one]
        if one == 0 or (drives[one] != drives[one - 1]).any():
            _drive(drives[one], circle, rows)
        _rates(bars[one], rows)
        most = 0.0
        for i in range(circle.shape[1]):
            omega, alpha = rows[OMEGA_A, i], rows[ALPHA_A, i]
            alpha_c, alpha_b = abs(rows[ALPHA_C, i]), abs(rows[ALPHA_B, i])
            at_a = a * (omega * omega + abs(alpha))
            across = (mass[5] * alpha_b + mass[8]) / b + (mass[2] * alpha_c + mass[0] * mass[1] * at_a) / c
            in_b = across / abs(rows[SINE, i])
            in_a = in_b + mass[0] * (at_a + mass[1] * (alpha_c + rows[OMEGA_C, i] ** 2))
            in_b0 = in_b + mass[3] * mass[4] * (alpha_b + rows[OMEGA_B, i] ** 2)
            in_a0 = in_a + mass[6] * mass[7] * (omega * omega + abs(alpha))
            most = max(most, in_b0, in_a0)
        found[one] = most
    return found
