"""What a design of gears leaves out: it follows from what the design says.

All functions take numbers, or arrays (n,) over designs. Heights and radii are in modules.

Glossary
--------
bend
    Length of a pitch curve that goes all the way round, times its greatest curvature: 2π of a circle.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mechwright.contracts.finding import Finding
from mechwright.contracts.parameters import Parameters
from mechwright.mechanics.gearing.checks import LEAST_CLEARANCE
from mechwright.tolerances import falls_short

ADDENDUM, DEDENDUM, TIP_RADIUS = 1.0, 1.25, 0.38
"""The basic rack of ISO 53, profile A."""

CLEARANCE = DEDENDUM - ADDENDUM
"""Of tips from the mating roots: so far down fillets reach, into which tips do not run."""

MOST_TEETH = 300
"""Teeth that are chosen, and that a remedy proposes, at most: finer ones are for those who ask for them."""

LEAST_REGULARITY = 1e-4
"""Share of its regularity on the pitch curve that a flank keeps to its end: at 0 it ends in a cusp, where a
fitted curve could turn back."""

SPARE = 1e-4
"""Share of teeth beyond those with which a flank just is not undercut: bends may be off by a tenth of it."""

FACE = 10.0
"""mm: the usual face width."""

COARSE = 1.5
"""Module, mm, from which on an end mill of 1.5 mm runs down to the roots; its flutes are longer than the
usual face width."""

FLUTES = 4.5
"""Face width in modules that finer teeth have at most: the mill that cuts them is about a module wide, and
has flutes of five diameters, a part of which goes below the plate."""

PLATES = (6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.8, 0.5)
"""Thicknesses of plates that are sold, mm, below the usual one."""

SHAFTS = (10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0)
"""mm: the usual bore, and smaller shafts that are sold."""

RIM = 1.2
"""Material between bore and roots over the height of a tooth, as the checks of a rim want it."""

DOT = 1.5
"""How far below the roots of the teeth the dot stands that tells how gears are put together, mm."""

_HUNDREDTHS = 100
"""Of a module: what is less than usual is rounded so."""


def dedendum_beside(addendum: Any) -> Any:
    """The usual dedendum, or a deeper one that clears the tips of teeth that would come too near to it."""
    near = falls_short(DEDENDUM - addendum, LEAST_CLEARANCE)
    return np.where(near, np.round(addendum + CLEARANCE, 6), DEDENDUM)


def tip_radius_beside(dedendum: Any, pressure_angle: Any) -> Any:
    """The usual tip radius of a rack, or as much as its teeth have room for at their ends.

    The angle is in degrees. Where flanks meet before the end of a tooth no radius fits: it is the usual one.

    Examples
    --------
    >>> float(tip_radius_beside(1.25, 20)), float(tip_radius_beside(1.25, 25))
    (0.38, 0.31)
    """
    alpha = np.radians(pressure_angle)
    # The half land is π/4 - h_f tan α - r_f (1 - sin α) / cos α.
    most = (math.pi / 4 - dedendum * np.tan(alpha)) * np.cos(alpha) / (1 - np.sin(alpha))
    return np.where(most < 0, TIP_RADIUS, np.minimum(np.floor(_HUNDREDTHS * most) / _HUNDREDTHS, TIP_RADIUS))


def straight_depth(dedendum: Any, tip_radius: Any, pressure_angle: Any) -> Any:
    """Depth below its pitch line at which the straight flank of a rack ends; the angle is in degrees."""
    return dedendum - tip_radius * (1 - np.sin(np.radians(pressure_angle)))


def teeth_without_undercut(bend: Any, depth: Any, dedendum: Any, pressure_angle: Any) -> Any:
    """The least number of teeth of which none is undercut, wherever on its pitch curve it stands.

    With module m, radius of curvature ρ and flanks straight down to ``depth`` h, the regularity of a flank
    falls to 1 - h m / (ρ sin²α), and the length of the curve is π m z. Roots lie within ρ as well. The angle
    is in degrees.

    Examples
    --------
    >>> float(teeth_without_undercut(math.tau, 1.0, 1.25, 20))
    18.0
    """
    sine = np.sin(np.radians(pressure_angle))
    deep = np.maximum(depth / (sine * sine * (1 - LEAST_REGULARITY)), dedendum)
    return np.ceil(bend * deep / math.pi * (1 + SPARE))


def face_width(module: Any) -> Any:
    """The usual face width, mm, or what a mill that fits into the spaces of fine teeth reaches.

    Examples
    --------
    >>> [float(face_width(module)) for module in (2.0, 1.5, 1.0, 0.8)]
    [10.0, 10.0, 4.0, 3.0]
    """
    most = FLUTES * np.asarray(module)
    return np.select(
        [np.asarray(module) >= COARSE, *(most >= one for one in PLATES)], [FACE, *PLATES], PLATES[-1]
    )


def shaft_bore(radius: Any, wall: Any, most: Any = math.inf) -> Any:
    """The usual bore, or the largest smaller one up to ``most``, mm; the usual one where none fits.

    ``radius`` is where the pitch curve comes nearest to the axis, and ``wall`` what stays of it, mm.

    Examples
    --------
    >>> float(shaft_bore(12.0, 6.0)), float(shaft_bore(6.0, 2.6)), float(shaft_bore(1.0, 2.0))
    (10.0, 6.0, 10.0)
    """
    fits = [~np.asarray(falls_short(radius - one / 2, wall)) & (one <= most) for one in SHAFTS]
    return np.select(fits, SHAFTS, SHAFTS[0])


def chosen(code: str, params: Parameters, usual: Mapping[str, float]) -> Iterator[Finding]:
    """A note of what was left out and is not what is usual."""
    other = {name: getattr(params, name) for name in usual if name not in params.model_fields_set}
    said = ", ".join(f"{name} = {value:g}" for name, value in other.items() if value != usual[name])
    if said:
        yield Finding.note(code, f"defaults chosen for this design: {said}")
