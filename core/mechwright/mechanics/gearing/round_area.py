"""Areas of round gears by closed forms, of many at once.

They are those of :mod:`mechwright.mechanics.gearing.rack` on a circle of radius R, in the half of a tooth and
of the space beside it, by Green's theorem: with u the arc from where a flank crosses the pitch circle, its
side of the space -1, and a, c as of a fillet, 2 dA is

    flank   (sin²α - u sin α cos α/R) (R - cot α u) du,  from u1 at the tip to u2 at the fillet,
            u1 = (R sin α - √(R² sin²α + 2 R h_a + h_a²))/cos α
    fillet  -(L + r_f - R c/L) ((L + r_f)/R + r_f c/L²) da,  L² = a² + c²
    tip, root  the square of their radius times their angle.
"""

import math
from typing import Any

import numpy as np

NODES = 12
"""Of Gauss' quadrature along a fillet, over the τ that :class:`Rack` takes it by: rounding is left."""

_RULE = np.polynomial.legendre.leggauss(NODES)


def round_area(
    module: Any, teeth: Any, angle: Any, addendum: Any, dedendum: Any, tip_radius: Any, backlash: Any
) -> Any:
    """Area inside the teeth, mm², of numbers or of arrays (n,).

    Parameters
    ----------
    module, addendum, dedendum, tip_radius, backlash
        mm, as of :class:`mechwright.mechanics.gearing.rack.Rack`.
    teeth
        Their number.
    angle
        The pressure angle, rad.

    Examples
    --------
    >>> from mechwright.mechanics.gearing import Rack, Round, Teeth, gear_loop
    >>> rack = Rack(2.0, math.radians(20), 2.0, 2.5, 0.76, 0.05)
    >>> drawn = gear_loop(Teeth(Round(25.0), rack, 25, 0.0))[0].area
    >>> found = round_area(2.0, 25, math.radians(20), 2.0, 2.5, 0.76, 0.05)
    >>> bool(abs(found / drawn - 1) < 1e-6)
    True
    """
    radius, pitch = module * teeth / 2, math.pi * module
    sin, cos = np.sin(angle), np.cos(angle)
    c, space = dedendum - tip_radius, (pitch + backlash) / 4
    straight = dedendum - tip_radius * (1 - sin)
    land = space - straight * sin / cos - tip_radius * cos
    tip, foot = radius + addendum, radius - dedendum
    first = (radius * sin - np.sqrt((radius * sin) ** 2 + tip**2 - radius**2)) / cos
    last = straight / (sin * cos)

    def flank(u: Any) -> Any:
        return sin**2 * radius * u - sin * cos * u**2 + cos**2 * u**3 / (3 * radius)

    turned = np.arctan2(-first * cos**2, radius - first * sin * cos)
    on_tip = pitch / 2 - space + first + radius * turned
    arcs = (tip**2 * on_tip + foot**2 * land) / radius
    return teeth * (arcs + flank(last) - flank(first) - _fillet(radius, c, tip_radius, sin / cos))


def _fillet(radius: Any, c: Any, tip_radius: Any, tangent: Any) -> Any:
    """Twice the area that a fillet takes."""
    course, found = np.arcsinh(1 / tangent), 0.0
    for node, weight in zip(*_RULE, strict=True):
        wide = np.cosh(course * (1 + node) / 2)
        reach = c * wide + tip_radius
        across = reach - radius / wide
        found = found + weight * c * wide * across * (reach / radius + tip_radius / (c * wide**2))
    return found * course / 2
