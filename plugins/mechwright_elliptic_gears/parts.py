"""All parts of a design."""

from mechwright import Part
from mechwright_elliptic_gears.gear import opening_of
from mechwright_elliptic_gears.gear_parts import gear_part, gears_of
from mechwright_elliptic_gears.layout import Layout
from mechwright_elliptic_gears.params import EllipticGearParams
from mechwright_elliptic_gears.plates import base_part, coupler_part
from mechwright_elliptic_gears.turned import round_parts


def parts_of(params: EllipticGearParams) -> tuple[Part, ...]:
    """The gears; of a train also its coupler, base plate and round parts. ``check`` has found no error."""
    gears = tuple(gear_part(params, gear) for gear in gears_of(params))
    if params.stages == 1:
        return gears
    layout, opening = Layout.of(params), opening_of(params)
    assert opening is not None  # noqa: S101 - a train has a bore
    plates = (coupler_part(params, layout), base_part(params, layout))
    return (*gears, *plates, *round_parts(layout, opening))
