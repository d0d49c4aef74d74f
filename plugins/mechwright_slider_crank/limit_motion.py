"""The slider-crank at its limit, c = a + |e|: its rates in a form that stands through the change point.

Where crank and rod stand across the slide in one line, w = 0 and the crank can go on in either assembly;
undisturbed it changes into the other one. In the slide frame, with e ≥ 0, φ' = 2 h - π/2, E = e + a cos² h:

    w = 2 β √(a E) sin h,   ω = -β √a cos h / √E,   α = β √a e sin h / (2 E^(3/2)),
    j = β √a e cos h (E + 3 a sin² h) / (4 E^(5/2)).

The curve is smooth and closes after two turns of the crank. Without an offset it is w = β a cos φ', where the
rod turns against the crank; it closes after one. A slide on the right, e < 0, is the mirror image.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.tolerances import TOLERANCES

LIMIT = TOLERANCES.slack
"""Part of the rod by which a linkage at its limit may miss it: rounding of the design file."""


def at_limit(crank: float, rod: float, offset: float) -> bool:
    """Whether the rod is as long as crank and offset together."""
    return abs(rod - crank - abs(offset)) <= LIMIT * rod


def turns_to_close(offset: float) -> int:
    """Turns of the crank after which the linkage stands as at the start."""
    return 1 if offset == 0 else 2


def rod_at_limit(
    crank: float, offset: float, branch: int, angle: Array, first: float
) -> tuple[Array, Array, Array, Array]:
    """W (n,), mm, and the rod's three rates per crank radian, at crank angles (n,) from the slide, rad.

    The slider is ahead of the pin, ``branch`` +1, or behind it at the angle ``first``, or just past that.
    """
    if offset == 0:
        kept = branch * _sign(math.cos(first), -math.sin(first))
        none = np.zeros_like(angle)
        return kept * crank * np.cos(angle), none - kept, none, none
    if offset < 0:
        w, one, two, three = rod_at_limit(crank, -offset, branch, -angle, -first)
        return w, one, -two, three
    h, start = (angle + np.pi / 2) / 2, (first + math.pi / 2) / 2
    kept = branch * _sign(math.sin(start), math.cos(start))
    cos, sin = np.cos(h), np.sin(h)
    size = offset + crank * cos * cos
    root = kept * math.sqrt(crank)
    return (
        2 * root * np.sqrt(size) * sin,
        -root * cos / np.sqrt(size),
        root * offset * sin / (2 * size**1.5),
        root * offset * cos * (size + 3 * crank * sin * sin) / (4 * size**2.5),
    )


def _sign(value: float, next_: float) -> float:
    """The sign of a value, or where it vanishes that of its slope."""
    return math.copysign(1.0, next_ if abs(value) < TOLERANCES.angle_rad else value)
