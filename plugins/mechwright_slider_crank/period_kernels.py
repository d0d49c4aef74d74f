"""Compiled extremes of a period, and rooms between plates, for many slider-cranks one after the other.

Formulas are those of :mod:`mechwright_slider_crank.kinematics`, in the slide frame, one sample after the
other. A linkage is a row (5,): crank a, rod c and offset e, mm, direction of the slide, rad, and the branch.
A drive is a row (5,): start and travel, rad, whether it rocks, acceleration ratio, and speed, rad/s.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.compiled_point import point_rates

(
    S, V, A, JERK, SIGMA, OMEGA_C, ALPHA_C, JERK_C, COSINE, OMEGA_A, ALPHA_A, JERK_A,
    X, Y, VX, VY, AX, AY, JX, JY, LEAN, ROWS,
) = range(22)  # fmt: skip
"""Rows of a table over the samples; LEAN is the size of the rod's extent along the slide over its length."""

GRID, ROUNDS, NEAR = 720, 5, 17
"""Peaks are sought as :func:`mechwright_slider_crank.motion.peaks` does."""


def circle_of(samples: int) -> Array:
    """Cosine and sine of shares of a turn, and the shares (3, samples), both ends included."""
    share = np.linspace(0.0, 1.0, samples)
    return np.ascontiguousarray([np.cos(math.tau * share), np.sin(math.tau * share), share])


@compiled
def _moved(bar: Array, theta: float, omega: float, alpha: float, jerk: float, rows: Array, i: int) -> None:
    a, c, e, branch = bar[0], bar[1], bar[2], bar[4]
    x, y = a * math.cos(theta - bar[3]), a * math.sin(theta - bar[3])
    t = e - y
    w = branch * math.sqrt(c * c - t * t)
    s1 = -x / w
    s2 = (y + t * s1 * s1) / w
    s3 = (x + 3 * t * s1 * s2 + w * s1**3) / w
    v1, v2 = -y - t * s1, -x - w * s1 * s1 - t * s2
    v3 = y + t * s1**3 - 3 * w * s1 * s2 - t * s3
    rows[S, i], rows[COSINE, i], rows[LEAN, i] = x + w, abs(t) / c, abs(w) / c
    rows[SIGMA, i] = math.atan(t / w) + (0.0 if branch > 0 else math.pi) + bar[3]
    rows[OMEGA_A, i], rows[ALPHA_A, i], rows[JERK_A, i] = omega, alpha, jerk
    square, cube = omega * omega, omega**3
    rows[V, i], rows[OMEGA_C, i] = v1 * omega, s1 * omega
    rows[A, i], rows[ALPHA_C, i] = v2 * square + v1 * alpha, s2 * square + s1 * alpha
    rows[JERK, i] = v3 * cube + 3 * v2 * omega * alpha + v1 * jerk
    rows[JERK_C, i] = s3 * cube + 3 * s2 * omega * alpha + s1 * jerk


@compiled
def _turning(drive: Array, share: float, rows: Array, i: int, bar: Array) -> None:
    """The linkage at a share of its period."""
    start, travel, rocks, ratio, speed = drive[0], drive[1], drive[2], drive[3], drive[4]
    if rocks > 0:
        cos, sin, half = math.cos(math.tau * share), math.sin(math.tau * share), travel / 2
        theta = start + half * (1 - cos)
        _moved(bar, theta, half * speed * sin, half * speed**2 * cos, -half * speed**3 * sin, rows, i)
    else:
        omega = math.copysign(speed, travel) * (math.exp(ratio * travel * share) if ratio != 0 else 1.0)
        _moved(bar, travel * share, omega, ratio * omega**2, 2 * ratio**2 * omega**3, rows, i)


@compiled
def _traced(bar: Array, point: Array, rows: Array, i: int, theta: float) -> None:
    """The coupler point in space, up to its jerk."""
    x, y = bar[0] * math.cos(theta), bar[0] * math.sin(theta)
    cos, sin = math.cos(rows[SIGMA, i]), math.sin(rows[SIGMA, i])
    qx, qy = point[0] * cos - point[1] * sin, point[0] * sin + point[1] * cos
    rows[X, i], rows[Y, i] = x + qx, y + qy
    crank = rows[OMEGA_A, i], rows[ALPHA_A, i], rows[JERK_A, i]
    coupler = rows[OMEGA_C, i], rows[ALPHA_C, i], rows[JERK_C, i]
    rates = point_rates(x, y, qx, qy, crank, coupler)
    rows[VX, i], rows[VY, i], rows[AX, i], rows[AY, i], rows[JX, i], rows[JY, i] = rates


@compiled
def extremes(
    bars: Array,
    drives: Array,
    points: Array,
    samples: int,
    wanted: NDArray[np.int64],
    traced: bool,
) -> Array:
    """Least and greatest values (n, k, 2) of wanted rows (k,) over a period of so many samples."""
    found = np.empty((len(bars), len(wanted), 2))
    rows = np.empty((ROWS, samples))
    for one in range(len(bars)):
        drive = drives[one]
        for i in range(samples):
            share = i / (samples - 1)
            _turning(drive, share, rows, i, bars[one])
            if traced:
                swung = drive[0] + drive[1] / 2 * (1 - math.cos(math.tau * share))
                _traced(bars[one], points[one], rows, i, swung if drive[2] > 0 else drive[1] * share)
        for place in range(len(wanted)):
            row = rows[wanted[place]]
            found[one, place, 0], found[one, place, 1] = row.min(), row.max()
    return found


@compiled
def _angles(drive: Array, circle: Array, rows: Array) -> None:
    """Cosine and sine of the crank's angle, and its first two rates: rows of a small table."""
    start, travel, rocks, ratio, speed = drive[0], drive[1], drive[2], drive[3], drive[4]
    sense = math.copysign(1.0, travel)
    for i in range(circle.shape[1]):
        if rocks > 0:
            theta = start + travel / 2 * (1 - circle[0, i])
            rows[0, i], rows[1, i] = math.cos(theta), math.sin(theta)
            rows[2, i] = travel / 2 * speed * circle[1, i]
            rows[3, i] = travel / 2 * speed * speed * circle[0, i]
        else:
            omega = sense * speed * (math.exp(ratio * travel * circle[2, i]) if ratio != 0 else 1.0)
            rows[0, i], rows[1, i] = circle[0, i], sense * circle[1, i]
            rows[2, i], rows[3, i] = omega, ratio * omega * omega


@compiled
def _along(bar: Array, rows: Array) -> None:
    """Sizes of the slider's velocity and acceleration, of the rod's two rates, and of its extent."""
    a, c, e, branch = bar[0], bar[1], bar[2], bar[4]
    cos, sin = math.cos(bar[3]), math.sin(bar[3])
    for i in range(rows.shape[1]):
        x, y = a * (rows[0, i] * cos + rows[1, i] * sin), a * (rows[1, i] * cos - rows[0, i] * sin)
        t, omega, alpha = e - y, rows[2, i], rows[3, i]
        w = branch * math.sqrt(c * c - t * t)
        s1 = -x / w
        s2 = (y + t * s1 * s1) / w
        v1 = -y - t * s1
        rows[4, i] = abs(v1 * omega)
        rows[5, i] = abs((-x - w * s1 * s1 - t * s2) * omega * omega + v1 * alpha)
        rows[6, i], rows[7, i] = abs(s1 * omega), abs(s2 * omega * omega + s1 * alpha)
        rows[8, i] = abs(w) / c


_SIZES = 9


@compiled
def peaks(bars: Array, drives: Array, circle: Array, which: int) -> Array:
    """The greatest size (n,) of the slider's velocity, ``which`` 0, or acceleration, 1, over a period.

    It is independent of samples; of a lever it is that among those of ``circle`` (3, m): cosine and sine of
    shares of a turn, and the shares. Of a crank every other of these is looked at first.
    """
    found = np.empty(len(bars))
    rows, near = np.empty((_SIZES, circle.shape[1])), np.empty((_SIZES, NEAR))
    some = np.empty((3, NEAR))
    row = 4 + which
    for one in range(len(bars)):
        bar, drive = bars[one], drives[one]
        if one == 0 or (drive != drives[one - 1]).any():
            _angles(drive, circle, rows)
        _along(bar, rows)
        if drive[2] > 0:
            found[one] = rows[row].max()
            continue
        top = int(np.argmax(rows[row, ::2]))
        best, centre, half = rows[row, 2 * top], top / GRID, 1 / GRID
        for _ in range(ROUNDS):
            for k in range(NEAR):
                share = centre + half * (2 * k / (NEAR - 1) - 1)
                if drive[3] != 0:
                    share = min(max(share, 0.0), 1.0)
                some[0, k], some[1, k], some[2, k] = (
                    math.cos(math.tau * share),
                    math.sin(math.tau * share),
                    share,
                )
            _angles(drive, some, near)
            _along(bar, near)
            top = int(np.argmax(near[row]))
            best, centre = max(best, near[row, top]), some[2, top]
            half /= 8
        found[one] = best
    return found


@compiled
def most_force(bars: Array, drives: Array, inertias: Array, circle: Array) -> Array:
    """What no force of shaft, crank pin and wrist pin exceeds at any sample (n,), mN.

    ``inertias`` are (n, 6): mass of the slider, then of the rod mass and the farthest that any of it lies
    from the crank pin, of the crank mass and the same from the shaft, each of them or more, kg, mm; and the
    load on the slider, mN.

    The force in the wrist pin has the component p along the slide, which moves the slider, and q across the
    rod, which turns the rod; both directions are as far from each other as the rod from the slide's normal.
    """
    found = np.zeros(len(bars))
    rows = np.empty((_SIZES, circle.shape[1]))
    for one in range(len(bars)):
        a, c, mass = bars[one, 0], bars[one, 1], inertias[one]
        if one == 0 or (drives[one] != drives[one - 1]).any():
            _angles(drives[one], circle, rows)
        _along(bars[one], rows)
        most = 0.0
        for i in range(circle.shape[1]):
            driven = rows[2, i] * rows[2, i] + abs(rows[3, i])
            p = mass[0] * rows[5, i] + abs(mass[5])
            q = mass[1] * mass[2] * (mass[2] * rows[7, i] + a * driven) / c
            in_a = (p + q) / rows[8, i]
            in_a += mass[1] * (a * driven + mass[2] * (rows[7, i] + rows[6, i] * rows[6, i]))
            most = max(most, in_a + mass[3] * mass[4] * driven)
        found[one] = most
    return found
