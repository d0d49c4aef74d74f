"""Compiled: peaks of the coupler's rates of cranks that turn fully, three times as fast as chains of dyads.

Crank and arm of all five-bars of a table stand at the same angles θ and ρ θ at each sample; of these a table
(4, m) holds cos θ, sin θ, cos ρθ and sin ρθ. Rates are those of :mod:`mechwright.mechanics.planar.dyad`.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled


@compiled
def _rate(
    bar: Array, ratio: float, sense: float, weights: tuple[float, float], turns: tuple[Array, ...], out: Array
) -> None:
    """The sum (m,) of both rates per radian of the crank with weights; ``sense`` is -1 of a crank clockwise.

    It writes one row alone, so that several samples run at once.
    """
    a, c, l, b, branch = bar[0], bar[1], bar[2], bar[3], bar[7]
    x, y = bar[4] * math.cos(bar[5]), bar[4] * math.sin(bar[5])
    cos, sin, arm_cos, arm_sin = turns
    bx, by = b * math.cos(bar[6]), b * math.sin(bar[6])
    for i in range(out.size):
        ax, ay, turned = a * cos[i], a * sense * sin[i], sense * arm_sin[i]
        dx, dy = bx * arm_cos[i] - by * turned, by * arm_cos[i] + bx * turned
        px, py = x + dx - ax, y + dy - ay
        square = px * px + py * py
        w = branch * math.sqrt(((c + l) ** 2 - square) * (square - (c - l) ** 2))
        k, h = (c - l) * (c + l) + square, (0.5 / c) / square
        sx, sy = (px * k - py * w) * h, (px * w + py * k) * h
        tx, ty = (c * sx - px) / l, (c * sy - py) / l
        one, two = 2 * l / w, 2 * c / w  # the sine between both is -w / 2 c l
        rx, ry = ay - ratio * dy, ratio * dx - ax
        w1, v1 = one * (rx * tx + ry * ty), two * (rx * sx + ry * sy)
        f, g = c * w1 * w1, l * v1 * v1
        rx = ax - ratio * ratio * dx + f * sx - g * tx
        ry = ay - ratio * ratio * dy + f * sy - g * ty
        out[i] = weights[0] * w1 + weights[1] * (one * (rx * tx + ry * ty))


@compiled
def coupler_peaks(bars: Array, ratio: float, omega: Array, table: Array, order: int) -> Array:
    """The largest size (n,) of the coupler's angular velocity (order 1) or acceleration (2).

    ``bars`` (n, 8) are crank, coupler, rocker, arm and ground, mm, the ground's angle and the arm's offset,
    rad, and the branch; ``omega`` (n,) is the crank's, rad/s, of any sign.
    """
    found, out = np.empty(len(bars)), np.empty(table.shape[1])
    turns = table[0], table[1], table[2], table[3]
    for one in range(len(bars)):
        factor = omega[one] ** order
        weights = factor * (order == 1), factor * (order == 2)
        _rate(bars[one], ratio, math.copysign(1.0, omega[one]), weights, turns, out)
        peak = 0.0
        for i in range(out.size):
            peak = max(peak, abs(out[i]))
        found[one] = peak
    return found
