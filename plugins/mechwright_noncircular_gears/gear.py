"""From the design table to both gears: sizes, teeth and outlines."""

import math
from dataclasses import replace

import numpy as np

from mechwright import Array, Outline, kept
from mechwright.geometry import Loop
from mechwright.mechanics.gearing import (
    Rack,
    RolledCurve,
    RolledPair,
    SectorTeeth,
    Teeth,
    exact_fit,
    gear_loop,
    sector_loop,
)
from mechwright.mechanics.gearing.backlash import LEFT, PLANNED, pair_backlash
from mechwright.mechanics.gearing.checks import FULL_RIM
from mechwright.mechanics.openings import opening_of
from mechwright.tolerances import OFF_CENTRE
from mechwright_noncircular_gears.law import alike, extremes_of, law_of
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.profile import profile_of
from mechwright_noncircular_gears.ring import Rim, ring_outline

NAMES = ("gear-1", "gear-2")
"""Bodies and parts: driver and driven gear."""

_ROOM_SAMPLES = 2880
"""Points of a pitch curve from which distances are measured: an eighth of a degree."""


@kept
def pair_of(params: NoncircularParams) -> RolledPair:
    """Both pitch curves; a module asks for a centre distance of its own."""
    law = law_of(params)
    if params.centre_distance is not None:
        return alike(RolledPair.of(law, params.centre_distance, params.side))
    assert params.module is not None  # noqa: S101 - the table has exactly one of both
    return alike(RolledPair.of_pitch(law, math.pi * params.module, params.teeth, params.side))


def curves_of(params: NoncircularParams) -> tuple[RolledCurve, RolledCurve]:
    """Pitch curves of driver and driven gear."""
    pair = pair_of(params)
    return pair.driver, pair.driven


def least_backlash(params: NoncircularParams) -> float:
    """Backlash, mm, with which the pair turns as made."""
    return _backlash(params, LEFT, OFF_CENTRE)


def jamming_backlash(params: NoncircularParams) -> float:
    """Backlash, mm, below which walls as they are planned jam at the exact centre distance."""
    return _backlash(params, PLANNED, 0.0)


def _backlash(params: NoncircularParams, left: float, off_centre: float) -> float:
    upright = math.cos(extremes_of(params).steepest.value)
    return float(pair_backlash(upright, math.radians(params.pressure_angle), left, off_centre))


def backlash_of(params: NoncircularParams) -> float:
    """The design's backlash, mm."""
    return least_backlash(params) if params.backlash is None else params.backlash


def with_backlash(params: NoncircularParams, backlash: float) -> NoncircularParams:
    """The same design with another backlash, mm."""
    return params.model_copy(update={"backlash": backlash})


def rack_of(params: NoncircularParams) -> Rack:
    """The generating cutter of both gears, in mm; with a ring, that of the driver."""
    module = params.module
    if module is None:
        module = pair_of(params).rolled / (math.pi * params.teeth)
    return profile_of(params).sized(module, backlash_of(params))


def racks_of(params: NoncircularParams) -> tuple[Rack, Rack]:
    """Cutters of driver and driven gear, which differ in the height of the teeth that they leave."""
    rack = rack_of(params)
    if not params.internal:
        return rack, rack
    return rack, replace(rack, addendum=params.value("ring_addendum") * rack.module)


@kept
def teeth_of(params: NoncircularParams) -> tuple[Teeth, Teeth]:
    """Teeth of driver and driven gear.

    Tooth centres of the driver lie at arcs (j + δ) p from the pitch point at φ = 0, those of the driven gear
    at (j + δ + 1/2) p. The contact runs clockwise in the driver and in a ring, against their arcs' sense.
    """
    (one, two), (rack, mate) = curves_of(params), racks_of(params)
    offset, fit = params.tooth_offset, fit_of(params)
    if params.sector is not None:
        count, hub = params.teeth, hub_of(params) / 2
        return (
            alike(replace(SectorTeeth.over(one, rack, count, (-count, 0), -offset, hub), fit=fit)),
            alike(replace(SectorTeeth.over(two, mate, count, (0, count), offset + 0.5, hub), fit=fit)),
        )
    return (
        alike(Teeth(one, rack, params.teeth, -offset % 1.0, fit=fit)),
        alike(Teeth(two, mate, params.mate_teeth, params.side * (offset + 0.5) % 1.0, fit=fit)),
    )


def fit_of(params: NoncircularParams) -> float:
    """How near outlines come to the exact flanks, mm."""
    return exact_fit(pair_of(params), params.teeth, math.radians(params.pressure_angle))


def hub_of(params: NoncircularParams) -> float:
    """Diameter, mm, of the hubs of sectors."""
    if params.sector_hub is not None:
        return params.sector_hub
    opening, rack = opening_of(params), rack_of(params)
    reach = 0.0 if opening is None else float(np.hypot(*opening.loop().flatten().T).max())
    return math.ceil(2 * (reach + FULL_RIM * (rack.addendum + rack.dedendum)))


@kept
def toothed(teeth: Teeth) -> tuple[Loop, float]:
    """The loop of teeth, of a sector with its blank, and its deviation, as :func:`gear_loop`."""
    return sector_loop(teeth) if isinstance(teeth, SectorTeeth) else gear_loop(teeth)


@kept
def outlines_of(params: NoncircularParams) -> tuple[Outline, Outline]:
    """Outlines of driver and driven gear, each about its axis; keyways point along +x.

    Teeth of a ring are its first opening.

    Raises
    ------
    GeometryError
        The curves do not close; ``check`` says which parameter is to blame, and is to be asked first.
    """
    opening = opening_of(params)
    holes = () if opening is None else (opening.loop(),)
    (one, off), (two, more) = map(toothed, teeth_of(params))
    driver = Outline(one, holes, off)
    return driver, ring_outline(rim_of(params), two, more) if params.internal else Outline(two, holes, more)


@kept
def rim_of(params: NoncircularParams) -> Rim:
    """What lies around the teeth of a driven gear that is a ring."""
    return Rim.of(params, teeth_of(params)[1])


def pitch_points(params: NoncircularParams) -> tuple[Array, Array]:
    """Points (n, 2), mm, of both pitch curves, each in the frame of its gear."""
    one, two = map(_points, curves_of(params))
    return one, two


@kept
def _points(curve: RolledCurve) -> Array:
    points: Array = curve.frame(curve.around(_ROOM_SAMPLES)).point
    return points


def room(params: NoncircularParams, gear: int, points: Array) -> float:
    """Least distance, mm, of points (n, 2) of a gear, 0 or 1, from its root curve; below 0 beyond it."""
    curve = pitch_points(params)[gear]
    between = np.hypot(points[:, None, 0] - curve[:, 0], points[:, None, 1] - curve[:, 1])
    return float(between.min()) - rack_of(params).dedendum
