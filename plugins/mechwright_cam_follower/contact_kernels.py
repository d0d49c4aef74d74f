"""Compiled contacts of rollers for many cams: :meth:`Geometry.contact` in one pass over the samples."""

import math
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.envelope import Points
from mechwright.mechanics.laws import Rates


def contacts(
    slides: bool, sigma: int, sign: float, place: Any, arm: Any, start: Any, radius: Any, rates: Rates
) -> tuple[Points, Points, Points, Points, Array]:
    """Centre, contact, outward normal and direction, and radius ρ of the pitch curve, (n, k) each.

    Parameters
    ----------
    slides
        Whether the follower is a slide.
    sigma, sign
        The turn of the cam; -1 for the second roller of a pair, else 1.
    place, arm, start, radius
        Numbers or (n, 1): the slide's offset or the axis of the lever, mm, its arm, mm; where the roller is
        lowest, mm, of a lever the angle of its arm, rad; and the roller's radius, mm.
    rates
        (1, k) or (n, k).
    """
    sizes = np.stack(np.broadcast_arrays(place, arm, start, radius), axis=-1).astype(float).reshape(-1, 4)
    count = max(len(sizes), len(rates.s))
    sizes = np.ascontiguousarray(np.broadcast_to(sizes, (count, 4)))
    one, two, three = (np.ascontiguousarray(values, dtype=float) for values in (rates.s, rates.v, rates.a))
    return _contacts(slides, float(sigma), sign, sizes, one, two, three)


@compiled
def _contacts(
    slides: bool, sigma: float, sign: float, sizes: Array, lift: Array, rate: Array, bend: Array
) -> tuple[Points, Points, Points, Points, Array]:
    n, k = len(sizes), lift.shape[1]
    centre, point = np.empty((n, k), np.complex128), np.empty((n, k), np.complex128)
    outward, direction = np.empty((n, k), np.complex128), np.empty((n, k), np.complex128)
    pitch = np.empty((n, k))
    for i in range(n):
        place, arm, start, radius = sizes[i, 0], sizes[i, 1], sizes[i, 2], sizes[i, 3]
        row = i if len(lift) > 1 else 0
        for j in range(k):
            s, v, a = lift[row, j], rate[row, j], bend[row, j]
            if slides:
                x, y, fx, fy, ax, ay, dx, dy = place, start + s, 0.0, v, 0.0, a, 0.0, sign
            else:
                # exp(-i angle); the roller is at place - arm times it
                cos, sin = math.cos(start + s), -math.sin(start + s)
                x, y = place - arm * cos, -arm * sin
                fx, fy = -arm * v * sin, arm * v * cos
                ax, ay = arm * (v * v * cos - a * sin), arm * (v * v * sin + a * cos)
                dx, dy = -sign * sin, sign * cos
            vx, vy = fx + sigma * y, fy - sigma * x
            ax, ay = ax + 2 * sigma * fy - x, ay - 2 * sigma * fx - y
            speed = math.sqrt(vx * vx + vy * vy)
            nx, ny = (-vy / speed, vx / speed) if speed > 0 else (0.0, 0.0)
            centre[i, j] = complex(x, y)
            point[i, j] = complex(x - sigma * radius * nx, y - sigma * radius * ny)
            outward[i, j] = complex(sigma * nx, sigma * ny)
            direction[i, j] = complex(dx, dy)
            pitch[i, j] = -sigma * (speed * speed * speed) / (vx * ay - vy * ax)
    return centre, point, outward, direction, pitch
