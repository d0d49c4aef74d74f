"""Where the shafts of a pair stand and what loads them, and the base plate of a train."""

import math

from mechwright import GroundPlate, Mounting, MountingError
from mechwright.mechanics.gearing.pair_parts import pair_mounting
from mechwright.standards.screws import FRAME, through_hole
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of
from mechwright_elliptic_gears.parts.layout import OUTWARDS, layout_of, screw_offset_of, screw_places
from mechwright_elliptic_gears.parts.retainers import keep_of


def mounting_of(params: EllipticGearParams) -> Mounting | GroundPlate:
    """Both shafts of a pair, or the base plate of a train.

    At the pitch radii r2 and r4 a torque T on gear 2 is T r4/r2 on gear 4, and presses the teeth together
    with T/(r2 cos α): both are greatest where r2 is least, a (1 - e), and r4 is a (1 + e).

    Raises MountingError for gears without a bore, and for a base plate without holes in its corners.
    """
    if params.stages > 1:
        return _base_of(params)
    a, e = ellipse_of(params).semi_major, params.eccentricity
    force = 1000 / (a * (1 - e) * math.cos(math.radians(params.pressure_angle)))
    return pair_mounting(params, 2 * a, force, (1 + e) / (1 - e), ("2", "4"))


def _base_of(params: EllipticGearParams) -> GroundPlate:
    """The coupler of a train passes over all shafts, so they stand in one plate and are driven from below."""
    if params.screw_hole is None:
        hole = through_hole(FRAME, layout_of(params).base)
        raise MountingError(
            "parameters.screw_hole: the base plate of a train is fixed by screws under its gears, and a "
            f"frame asks for holes in its corners; set screw_hole = {hole:g}",
            ({"parameters.screw_hole": hole},),
        )
    layout = layout_of(params)
    keep = keep_of(params, layout)
    corner = screw_places(params)[-1]
    x, y = corner.real, corner.imag
    return GroundPlate(
        "base",
        -layout.base,
        0.0,
        ((-x, -y), (x, -y), (x, y), (-x, y)),
        params.screw_hole,
        "gear-2",
        (-2 * layout.semi_major, 0.0),
        layout.stub_diameter,
        -layout.base - layout.stub,
        "parameters.screw_offset",
        "parameters.screw_hole",
        "parameters.stub_diameter",
        "parameters.base_thickness",
        offset=screw_offset_of(params),
        outwards=OUTWARDS,
        neck=0.0 if keep is None else keep.neck,
        length_key="parameters.stub_length",
    )
