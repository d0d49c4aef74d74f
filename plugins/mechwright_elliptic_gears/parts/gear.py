"""From the design table to the gear: sizes, teeth and outline."""

import math

from mechwright import Array, Outline, kept
from mechwright.mechanics.gearing import Rack, Teeth, exact_fit, gear_loop
from mechwright.mechanics.openings import opening_of
from mechwright_elliptic_gears.kinematics.ellipse import Ellipse, EllipticPair
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.backlash import backlash_of
from mechwright_elliptic_gears.parts.tooth_offset import offsets_that_mesh


@kept
def ellipse_of(params: EllipticGearParams) -> Ellipse:
    """The pitch ellipse: its perimeter 4 a E is z pitches, so a = π m z / (4 E)."""
    if params.semi_major is not None:
        return _ellipse(params.semi_major, params.eccentricity)
    assert params.module is not None  # noqa: S101 - the table has exactly one of both
    quarter = _ellipse(1.0, params.eccentricity).complete_integral
    return _ellipse(math.pi * params.module * params.teeth / (4 * quarter), params.eccentricity)


@kept
def _ellipse(semi_major: float, eccentricity: float) -> Ellipse:
    """One for all designs that share it: what is known of it need not be found again."""
    return Ellipse(semi_major, eccentricity)


def pair_of(params: EllipticGearParams) -> EllipticPair:
    """A gear and the gear that it drives."""
    return EllipticPair.of(ellipse_of(params))


def rack_of(params: EllipticGearParams) -> Rack:
    """The generating rack, in mm."""
    module = params.module
    if module is None:
        module = ellipse_of(params).perimeter / (math.pi * params.teeth)
    return Rack(
        module,
        math.radians(params.pressure_angle),
        params.addendum * module,
        params.dedendum * module,
        params.tip_radius * module,
        backlash_of(params),
    )


def fillet_mill(params: EllipticGearParams) -> float:
    """Diameter, mm, of the largest end mill that cuts every fillet exactly.

    A fillet is tightest at its bottom, where the pitch curve is flattest.
    """
    rack, depth = rack_of(params), rack_of(params).arc_depth
    return 2 * (rack.tip_radius + depth**2 / (ellipse_of(params).greatest_radius + depth))


@kept
def teeth_of(params: EllipticGearParams) -> Teeth:
    """The teeth, with the smaller offset that meshes if the table gives none."""
    offset = params.tooth_offset
    if offset is None:
        offset = offsets_that_mesh(params.teeth)[0]
    return _teeth(ellipse_of(params), rack_of(params), params.teeth, offset)


@kept
def _teeth(ellipse: Ellipse, rack: Rack, teeth: int, offset: float) -> Teeth:
    """Those of all designs that differ in bores and plates only."""
    fit = exact_fit(EllipticPair.of(ellipse), teeth, rack.pressure_angle)
    return Teeth(ellipse, rack, teeth, offset, fit=fit)


toothed = kept(gear_loop)
"""The toothed loop of teeth and its deviation, as :func:`gear_loop`."""


@kept
def outline_of(params: EllipticGearParams) -> Outline:
    """The outline in the part frame: origin on the axis of rotation, far vertex on +x.

    Its keyway, if there is one, points to the far vertex, and it has no other holes than the bore.

    Raises
    ------
    GeometryError
        The curves do not close; ``check`` says which parameter is to blame.
    """
    outer, deviation = toothed(teeth_of(params))
    opening = opening_of(params)
    return Outline(outer, () if opening is None else (opening.loop(),), deviation)


def room(params: EllipticGearParams, points: Array) -> float:
    """Least distance, mm, of points (n, 2), part frame, from the root curve; negative beyond it."""
    return float(ellipse_of(params).depth(points).min()) - rack_of(params).dedendum
