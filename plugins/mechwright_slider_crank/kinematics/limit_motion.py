"""The slider-crank at its limit, c = a + |e|: its rates in a form that stands through the change point.

Where crank and rod stand across the slide in one line, w = 0 and the crank can go on in either assembly;
undisturbed it changes into the other one. In the slide frame, with e ≥ 0, φ' = 2 h - π/2, E = e + a cos² h:

    w = 2 β √(a E) sin h,   ω = -β √a cos h / √E,   α = β √a e sin h / (2 E^(3/2)),
    j = β √a e cos h (E + 3 a sin² h) / (4 E^(5/2)).

The curve is smooth and closes after two turns of the crank. Without an offset it is w = β a cos φ', where the
rod turns against the crank; it closes after one. A slide on the right, e < 0, is the mirror image.
"""

from typing import Any

import numpy as np

from mechwright import Array
from mechwright.tolerances import TOLERANCES

LIMIT = TOLERANCES.slack
"""Part of the rod by which a linkage at its limit may miss it: rounding of the design file."""


def at_limit(crank: Any, rod: Any, offset: Any) -> Any:
    """Whether the rod is as long as crank and offset together."""
    return abs(rod - crank - abs(offset)) <= LIMIT * rod


def turns_to_close(offset: Any) -> Any:
    """Turns of the crank after which the linkage stands as at the start."""
    return np.where(np.asarray(offset) == 0, 1, 2)


def rod_at_limit(
    crank: Any, offset: Any, branch: int, angle: Array, first: Any
) -> tuple[Array, Array, Array, Array]:
    """W (..., n), mm, and the rod's three rates per crank radian, at crank angles (..., n), rad.

    Angles count from the slide. The slider is ahead of the pin, ``branch`` +1, or behind it at the angle
    ``first``, or just past that.
    """
    central, mirror = np.asarray(offset) == 0, np.where(np.asarray(offset) < 0, -1.0, 1.0)
    e, angle, first = np.abs(offset), mirror * angle, mirror * first
    none = np.zeros_like(angle)
    still = branch * _sign(np.cos(first), -np.sin(first))
    h, start = (angle + np.pi / 2) / 2, (first + np.pi / 2) / 2
    cos, sin = np.cos(h), np.sin(h)
    size = np.where(central, 1.0, e + crank * cos * cos)
    root = branch * _sign(np.sin(start), np.cos(start)) * np.sqrt(crank)
    return (
        np.where(central, still * crank * np.cos(angle), 2 * root * np.sqrt(size) * sin),
        np.where(central, none - still, -root * cos / np.sqrt(size)),
        np.where(central, none, mirror * root * e * sin / (2 * size**1.5)),
        np.where(central, none, root * e * cos * (size + 3 * crank * sin * sin) / (4 * size**2.5)),
    )


def _sign(value: Any, next_: Any) -> Any:
    """The sign of a value, or where it vanishes that of its slope."""
    return np.copysign(1.0, np.where(np.abs(value) < TOLERANCES.angle_rad, next_, value))
