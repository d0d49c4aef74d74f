"""Links as flat strips: cut on a two-axis mill, drilled square, and bent.

Every joint sits on a facet that touches the sphere of radius ρ with its inner face, so that its bore points
at the centre. Two neighbouring facets meet at the angle δ between their joints: one bend of δ, whose tangent
points lie (ρ - r) tan(δ/2) from the joints on the inner face, if r is the bend's inside radius. Between them
lie (r + K t) δ of strip, measured on the neutral fibre. Long arcs get several bends.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright import Arc, Line, Loop, Outline, Segment, circle
from mechwright_spherical.parts.hardware import FlatTable

SHARPEST = math.radians(60)
"""Largest angle of one bend: with more, facets of a usual radius grow longer than the link is worth."""

NOTCH = 1.5
"""Radius of the half-round notches that mark the middle of a bend on both edges, mm: a 3 mm end mill cuts
them, and they keep the bend from tearing."""


@dataclass(frozen=True, slots=True)
class Strip:
    """A strip with a bore at both ends.

    Parameters
    ----------
    bends
        Number of bends.
    angle
        Of each bend, rad.
    length
        From bore to bore along the flat strip, mm.
    leg
        From a bore to the nearest end of a bend, mm.
    middles
        Where the bends' middles lie, from the first bore, mm.
    """

    bends: int
    angle: float
    length: float
    leg: float
    middles: tuple[float, ...]


def bends_of(arc: Any) -> Any:
    """How often a strip is bent, for arcs in rad: one of exactly the sharpest bend once."""
    return np.ceil(arc / SHARPEST - 1e-9)


def leg_of(arc: Any, radius: Any, flat: FlatTable) -> Any:
    """From a bore to the nearest end of a bend, mm, for arcs in rad and radii in mm."""
    return (radius - flat.bend_radius) * np.tan(arc / bends_of(arc) / 2)


def strip(arc: float, radius: float, flat: FlatTable) -> Strip:
    """The strip of a link with an arc, rad, whose facets touch the sphere of ``radius``, mm."""
    bends, leg = int(bends_of(arc)), float(leg_of(arc, radius, flat))
    angle = arc / bends
    allowance = (flat.bend_radius + flat.neutral * flat.thickness) * angle
    step = 2 * leg + allowance
    middles = tuple(leg + allowance / 2 + number * step for number in range(bends))
    return Strip(bends, angle, bends * step, leg, middles)


def strip_outline(found: Strip, width: float, bore: float) -> Outline:
    """The flat strip, mm, along x from the first bore: round ends about the bores, notches at the bends."""
    half = width / 2
    lower: list[Segment] = []
    at = 0.0
    for middle in found.middles:
        lower.append(Line((at, -half), (middle - NOTCH, -half), "edge"))
        lower.append(Arc((middle, -half), NOTCH, math.pi, -math.pi, "bend"))
        at = middle + NOTCH
    lower.append(Line((at, -half), (found.length, -half), "edge"))
    upper = [segment.moved(found.length, 0.0, math.pi) for segment in lower]
    outer = Loop(
        (
            *lower,
            Arc((found.length, 0.0), half, -math.pi / 2, math.pi, "end"),
            *upper,
            Arc((0.0, 0.0), half, math.pi / 2, math.pi, "end"),
        )
    )
    bores = tuple(
        Loop((circle((x, 0.0), bore / 2, clockwise=True, tag="bore"),)) for x in (0.0, found.length)
    )
    return Outline(outer, bores)
