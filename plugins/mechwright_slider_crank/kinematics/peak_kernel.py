"""Compiled peaks of the slider's rates over a period, of a table of slider-cranks one after the other.

General chains (:mod:`mechwright.mechanics.planar.compiled_chain`) take four times as long for this figure.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled

GRID, ROUNDS, NEAR = 720, 5, 17
"""Half degrees find a peak; five rounds on eight times closer points find its value to 1e-9 of a turn."""

_SHARES = np.linspace(0.0, 1.0, 2 * GRID + 1)
CIRCLE = np.ascontiguousarray([np.cos(math.tau * _SHARES), np.sin(math.tau * _SHARES), _SHARES])
"""Cosine and sine of shares of a turn, and the shares (3, m): those among which levers have their peaks."""


@compiled
def _drive(drive: Array, circle: Array, rows: Array) -> None:
    """Cosine and sine of the crank's angle, and its first two rates: rows (4, m)."""
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
def _sizes(bar: Array, rows: Array, rate: int, found: Array) -> None:
    """Sizes of the slider's velocity or acceleration (m,)."""
    a, c, e, branch = bar[0], bar[1], bar[2], bar[4]
    cos, sin = math.cos(bar[3]), math.sin(bar[3])
    for i in range(found.size):
        x, y = a * (rows[0, i] * cos + rows[1, i] * sin), a * (rows[1, i] * cos - rows[0, i] * sin)
        t, omega, alpha = e - y, rows[2, i], rows[3, i]
        w = branch * math.sqrt(c * c - t * t)
        turn = -x / w
        velocity = -y - t * turn
        bend = (y + t * turn * turn) / w
        acceleration = (-x - w * turn * turn - t * bend) * omega * omega + velocity * alpha
        found[i] = abs(velocity * omega) if rate == 1 else abs(acceleration)


@compiled
def peaks(bars: Array, drives: Array, circle: Array, rate: int) -> Array:
    """The greatest size (n,) of the slider's velocity, ``rate`` 1, or acceleration, 2, over a period.

    It is independent of samples; of a lever it is that among those of ``circle`` (3, m). Of a crank every
    other of these is looked at first.

    Parameters
    ----------
    bars
        (n, 5): crank a, rod c and offset e, mm, direction of the slide, rad, and the branch.
    drives
        (n, 5): start and travel, rad, whether it rocks, acceleration ratio, and speed, rad/s.
    """
    best = np.empty(len(bars))
    rows, found = np.empty((4, circle.shape[1])), np.empty(circle.shape[1])
    some, near, sizes = np.empty((3, NEAR)), np.empty((4, NEAR)), np.empty(NEAR)
    for one in range(len(bars)):
        bar, drive = bars[one], drives[one]
        if one == 0 or (drive != drives[one - 1]).any():
            _drive(drive, circle, rows)
        _sizes(bar, rows, rate, found)
        if drive[2] > 0:
            best[one] = found.max()
            continue
        top = int(np.argmax(found[::2]))
        best[one], centre, half = found[2 * top], top / GRID, 1 / GRID
        for _ in range(ROUNDS):
            for k in range(NEAR):
                share = centre + half * (2 * k / (NEAR - 1) - 1)
                if drive[3] != 0:  # a crank that accelerates does not end as it has begun
                    share = min(max(share, 0.0), 1.0)
                angle = math.tau * share
                some[0, k], some[1, k], some[2, k] = math.cos(angle), math.sin(angle), share
            _drive(drive, some, near)
            _sizes(bar, near, rate, sizes)
            top = int(np.argmax(sizes))
            best[one], centre = max(best[one], sizes[top]), some[2, top]
            half /= 8
    return best
