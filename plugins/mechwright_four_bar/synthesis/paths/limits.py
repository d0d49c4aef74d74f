"""Limits of a linkage as functions that are above 0 where it breaks them, with their slopes; compiled.

The limits come as one array (:data:`SIZE`,), in units of the path's size; those that are not asked for are
infinite:

    0..3    logarithms of the least crank, follower, coupler and ground, 4..7 of the greatest
    8       greatest distance of the coupler point from A and from B
    9       greatest cosine of the transmission angle
    10..13  the rectangle of A0 and B0: least x, least y, greatest x, greatest y
    14..17  the rectangle of the coupler point in the coupler's frame, likewise
"""

import math

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright_four_bar.synthesis.paths.kernels import lengths, square

SIZE = 18
"""Numbers of the array of limits."""

COUNT = 24
"""Limits: 8 of lengths, 2 of the coupler point's distances, 2 of the transmission angle, 8 of A0 and B0, 4
of the
coupler point's place."""

NAMES = (
    *("shortest_link",) * 4, *("longest_link",) * 6, *("least_transmission_angle",) * 2, *("frame",) * 8,
    *("coupler_point",) * 4,
)  # fmt: skip
"""Key of the requirement that each limit comes from."""

NEVER = -1e300
"""Value of a limit that is not asked for."""


@compiled
def broken(solution: Array, limits: Array, values: Array, slopes: Array, sloped: bool) -> None:
    """By how much a solution (9,) breaks the limits, into ``values`` (24,).

    With ``sloped`` the derivatives go into ``slopes`` (24, 9). Lengths in natural logarithms, angles in
    cosines, places in units; 0 or less is kept.
    """
    a, b, c, shape_slope = lengths(solution)
    s, q = complex(solution[5], solution[6]), complex(solution[7], solution[8])
    squared = max(square(s), 1e-300)
    f = math.sqrt(squared)
    if sloped:
        slopes[:] = 0.0
    for i in range(4):
        size, of_a, of_b = 1.0, 0.0, -1
        if i == 0:
            size, of_a = a, 1.0
        elif i == 1:
            size, of_b = b, 0
        elif i == 2:
            size, of_b = c, 1
        length = math.log(size * f)
        values[i] = limits[i] - length
        values[4 + i] = length - limits[4 + i]
        if sloped:
            slopes[i, 0] = -of_a
            slopes[4 + i, 0] = of_a
            if of_b >= 0:
                for k in range(3):
                    slopes[4 + i, k] = shape_slope[of_b, k] / size
                    slopes[i, k] = -shape_slope[of_b, k] / size
            for k in range(2):
                slopes[4 + i, 5 + k] = solution[5 + k] / squared
                slopes[i, 5 + k] = -solution[5 + k] / squared
    _point_distances(limits, c, s, q, shape_slope, values, slopes, sloped)
    # Cosines of the angle at B over the shortest and over the longest diagonal.
    for i in range(2):
        sign = 1.0 if i == 0 else -1.0
        diagonal = 1 - a if i == 0 else 1 + a
        cosine = (b * b + c * c - diagonal * diagonal) / (2 * b * c)
        values[10 + i] = sign * cosine - limits[9]
        if sloped:
            by_b, by_c = (1 / c - cosine / b), (1 / b - cosine / c)
            for k in range(3):
                slopes[10 + i, k] = sign * (by_b * shape_slope[0, k] + by_c * shape_slope[1, k])
            by_diagonal = -diagonal / (b * c)
            slopes[10 + i, 0] += sign * by_diagonal * (-a if i == 0 else a)
    _places(solution, limits, s, q, f, values, slopes, sloped)


@compiled
def _point_distances(
    limits: Array, c: float, s: complex, q: complex, shape_slope: Array, values: Array,
    slopes: Array, sloped: bool,
) -> None:  # fmt: skip
    """Distances of the coupler point from A and B, over the greatest."""
    reach = limits[8]
    if not math.isfinite(reach):
        values[8] = values[9] = NEVER
        return
    other = q - c * s  # q is turned with the ground, and so is B
    for i in range(2):
        z = q if i == 0 else other
        distance = math.sqrt(max(square(z), 1e-300))
        values[8 + i] = distance / reach - 1
        if sloped:
            scale = 1 / (distance * reach)
            slopes[8 + i, 7] = z.real * scale
            slopes[8 + i, 8] = z.imag * scale
            if i == 1:
                slopes[9, 5] = -c * z.real * scale
                slopes[9, 6] = -c * z.imag * scale
                along = (z.conjugate() * s).real * scale
                for k in range(3):
                    slopes[9, k] = -along * shape_slope[1, k]


@compiled
def _places(
    solution: Array,
    limits: Array,
    s: complex,
    q: complex,
    f: float,
    values: Array,
    slopes: Array,
    sloped: bool,
) -> None:
    """A0 and B0 in their rectangle, and the coupler point in its own."""
    if math.isfinite(limits[10]):
        for pivot in range(2):
            for k in range(2):
                place = solution[3 + k] + (solution[5 + k] if pivot else 0.0)
                low, high = 12 + 4 * pivot + k, 14 + 4 * pivot + k
                values[low] = limits[10 + k] - place
                values[high] = place - limits[12 + k]
                if sloped:
                    slopes[low, 3 + k], slopes[high, 3 + k] = -1.0, 1.0
                    if pivot:
                        slopes[low, 5 + k], slopes[high, 5 + k] = -1.0, 1.0
    else:
        values[12:20] = NEVER
    if not math.isfinite(limits[14]):
        values[20:24] = NEVER
        return
    turned = q * s.conjugate() / f
    by_q = s.conjugate() / f
    by_s_x = q / f - turned * (s.real / (f * f))
    by_s_y = -1j * q / f - turned * (s.imag / (f * f))
    for k in range(2):
        place = turned.real if k == 0 else turned.imag
        values[20 + k] = limits[14 + k] - place
        values[22 + k] = place - limits[16 + k]
        if sloped:
            for i, slope in enumerate((by_s_x, by_s_y, by_q, 1j * by_q)):
                value = slope.real if k == 0 else slope.imag
                slopes[20 + k, 5 + i], slopes[22 + k, 5 + i] = -value, value
