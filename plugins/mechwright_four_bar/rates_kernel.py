"""Position, velocity and acceleration for sweeps over very many positions, compiled to machine code.

The formulas stand once, in :func:`links`: arrays go through them as they are, and the same function is
compiled for single numbers.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright_four_bar.dimensions import FourBar

COLUMNS = ("cos_sigma", "sin_sigma", "cos_psi", "sin_psi", "omega_c", "omega_b", "alpha_c", "alpha_b")
"""What a row holds: directions of coupler and follower, and their first two rates per crank radian."""


def links(ax: Any, ay: Any, dx: Any, dy: Any, square: Any, w: Any, c: Any, b: Any) -> Any:
    """The eight rows from A (ax, ay), the diagonal to B0 (dx, dy), its square and the signed W.

    Numbers or arrays; see :mod:`mechwright_four_bar.loop` for the equations.
    """
    k = (c - b) * (c + b) + square
    share, over = 0.5 / (c * square), 1 / b
    sx, sy = (dx * k - dy * w) * share, (dy * k + dx * w) * share
    px, py = (c * sx - dx) * over, (c * sy - dy) * over
    lever = 1 / (sx * py - sy * px)
    lever_c, lever_b = lever / c, lever * over
    w1, v1 = (ay * px - ax * py) * lever_c, (ay * sx - ax * sy) * lever_b
    bend_c, bend_b = c * w1 * w1, b * v1 * v1
    rx, ry = ax + bend_c * sx - bend_b * px, ay + bend_c * sy - bend_b * py
    return sx, sy, px, py, w1, v1, (rx * px + ry * py) * lever_c, (rx * sx + ry * sy) * lever_b


_links = compiled(links)


@compiled
def _fill(a: float, c: float, b: float, bx: float, by: float, branch: int, phi: Array, out: Array) -> None:
    total, difference = (b + c) * (b + c), (b - c) * (b - c)
    for j in range(phi.size):
        ax, ay = a * math.cos(phi[j]), a * math.sin(phi[j])
        dx, dy = bx - ax, by - ay
        square = dx * dx + dy * dy
        room = (total - square) * (square - difference)
        w = branch * math.sqrt(room) if room >= 0 else math.nan
        found = _links(ax, ay, dx, dy, square, w, c, b)
        for row in range(8):
            out[row, j] = found[row]


def rates(bar: FourBar, phi: ArrayLike) -> Array:
    """Directions, velocities and accelerations, as rows (8, n) named by :data:`COLUMNS`.

    NaN where the loop cannot be closed.

    Examples
    --------
    >>> row = dict(zip(COLUMNS, rates(FourBar(40, 120, 80, 100), np.deg2rad(120))[:, 0]))
    >>> round(float(row["omega_c"]) * 10, 9), round(float(row["alpha_b"]) * 100, 8)
    (1.394587381, -11.67245774)
    """
    angles = np.ascontiguousarray(np.atleast_1d(np.asarray(phi, dtype=float)))
    out = np.empty((len(COLUMNS), angles.size))
    a, c, b, f = (float(length) for length in bar.lengths)
    pivot = f * math.cos(bar.ground_angle), f * math.sin(bar.ground_angle)
    _fill(a, c, b, *pivot, int(bar.branch), angles, out)
    return out


def rates_numpy(bar: FourBar, phi: Array) -> Array:
    """The same as :func:`rates` at angles (n,), by numpy."""
    a, c, b, f = bar.lengths
    ax, ay = a * np.cos(phi), a * np.sin(phi)
    dx, dy = f * np.cos(bar.ground_angle) - ax, f * np.sin(bar.ground_angle) - ay
    square = dx * dx + dy * dy
    with np.errstate(invalid="ignore", divide="ignore"):
        w = bar.branch * np.sqrt(((b + c) ** 2 - square) * (square - (b - c) ** 2))
        return np.array(links(ax, ay, dx, dy, square, w, c, b))
