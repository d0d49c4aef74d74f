"""Both gears as parts: outline, bore and keyway, marks that tell how they go together."""

import math

import numpy as np

from mechwright import Bore, Colour, Feature, FittingMark, Instance, Outline, Part, Point, Profile
from mechwright.mechanics.gearing import Teeth, tip_sites
from mechwright.mechanics.openings import opening_of
from mechwright_noncircular_gears.gear import NAMES, outlines_of, rack_of, teeth_of
from mechwright_noncircular_gears.params import NoncircularParams

COLOURS: dict[str, Colour] = {"gear-1": (0.45, 0.58, 0.70), "gear-2": (0.80, 0.68, 0.42)}
"""Part to its colour."""

UNDER = 1.5
"""How far below the roots of the teeth a dot stands, mm."""


def parts_of(params: NoncircularParams) -> tuple[Part, ...]:
    """Driver and driven gear; ``check`` has found no error."""
    marks = _marks(params)
    return tuple(
        _gear(params, name, outline, mark)
        for name, outline, mark in zip(NAMES, outlines_of(params), marks, strict=True)
    )


def _gear(params: NoncircularParams, name: str, outline: Outline, mark: FittingMark) -> Part:
    depth, opening = params.thickness, opening_of(params)
    features: list[Feature] = []
    if opening is not None:
        features.append(Bore("bore", (0.0, 0.0), params.bore, 0, depth))
        if opening.has_keyway:
            features.append(Profile("keyway", opening.loop(), "inside", 0, depth))
    features.append(Profile("outside", outline.outer, "outside", 0, depth, tip_sites(outline.outer)))
    return Part(
        name,
        outline,
        depth,
        params.material,
        instances=(Instance(name, 0.0, COLOURS[name]),),
        machined=tuple(features),
        marks=(mark,),
    )


def _marks(params: NoncircularParams) -> tuple[FittingMark, FittingMark]:
    """One dot under tooth 0 of the driver, two about the space that takes it up.

    Tooth 0 of the driver lies δ pitches before the pitch point at φ = 0, and the space before tooth 0 of the
    driven gear lies as far behind it: both meet there.
    """
    driver, driven = teeth_of(params)
    tooth = _dot(driver, 0)
    space = _dot(driven, -1), _dot(driven, 0)
    at = math.degrees(_meeting(params)) % 360
    return (
        FittingMark(
            f"The one dot of gear 1 goes between the two dots of gear 2, at {at:.1f} degrees of gear 1.",
            (tooth,),
        ),
        FittingMark("Its two dots take the one dot of gear 1 between them.", space),
    )


def _dot(teeth: Teeth, number: int) -> Point:
    """A place under a tooth."""
    frame = teeth.curve.frame_at(np.asarray(teeth.tooth_arcs[number]))
    x, y = frame.offset(-teeth.rack.dedendum - UNDER).tolist()
    return round(x, 4), round(y, 4)


def _meeting(params: NoncircularParams) -> float:
    """Angle of the driver, rad, at which its tooth 0 stands on the line of centres."""
    driver = teeth_of(params)[0]
    arc = driver.tooth_arcs[0]
    return -float(driver.curve.parameter(np.asarray(arc)))


def mill_for_fillets(params: NoncircularParams) -> float:
    """Diameter, mm, of the largest end mill that cuts every fillet exactly.

    A fillet is tightest at its bottom, where the pitch curve is flattest.
    """
    rack = rack_of(params)
    depth, flattest = rack.arc_depth, 0.0
    for teeth in teeth_of(params):
        radius = teeth.curve.frame_at(teeth.arc_centres).radius
        flattest = max(flattest, float(radius.max()))
    return 2 * (rack.tip_radius + depth**2 / (flattest + depth))
