"""Compiled peaks of a period, and bounds of its forces, of a table of slider-cranks one after the other.

Formulas are in the slide frame, one sample after the other. A linkage is a row (5,): crank a, rod c and
offset e, mm, direction of the slide, rad, and the branch.
A drive is a row (5,): start and travel, rad, whether it rocks, acceleration ratio, and speed, rad/s.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column
from mechwright.mechanics.compiled import compiled
from mechwright_slider_crank.kinematics.course import drives, is_lever
from mechwright_slider_crank.kinematics.mechanism import Mechanism

GRID, ROUNDS, NEAR = 720, 5, 17
"""Peaks are sought as :func:`mechwright_slider_crank.kinematics.figures.peaks` does."""


def circle_of(samples: int) -> Array:
    """Cosine and sine of shares of a turn, and the shares (3, samples), both ends included."""
    share = np.linspace(0.0, 1.0, samples)
    return np.ascontiguousarray([np.cos(math.tau * share), np.sin(math.tau * share), share])


def bars_of(table: Mechanism) -> Array:
    """The linkages of a table (n, 5)."""
    one = table.closed
    sizes = (one.crank, one.rod, one.offset, one.direction, one.branch)
    return np.concatenate([column(size, table.size) for size in sizes], axis=1)


def drives_of(table: Mechanism) -> Array:
    """Their drives (n, 5)."""
    start, travel = drives(table)
    parts = (start, travel, is_lever(table), table.given.acceleration_ratio, table.omega)
    return np.concatenate([column(part, table.size) for part in parts], axis=1)


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
