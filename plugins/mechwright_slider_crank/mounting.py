"""What a frame is told of the base and of the shaft's end below it."""

from mechwright import GroundPlate, MountingError
from mechwright.contracts.mounting import SCREW_HOLE
from mechwright_slider_crank.base import shaft_end
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.plates import layout_of


def mounting_of(params: SliderCrankParams) -> GroundPlate:
    """The base and the crank's shaft; raises DesignError where the base has no holes for legs."""
    layout, hole = layout_of(params), params.screw_hole
    if hole is None:
        raise MountingError(
            f"parameters.screw_hole: the base has no holes for the screws of legs; make it {SCREW_HOLE:g}",
            ({"parameters.screw_hole": SCREW_HOLE},),
        )
    low, end = layout.stack.bottom("base"), shaft_end(params)
    one, two, three, four = ((at.real, at.imag) for at in layout.screws)
    return GroundPlate(
        "base",
        low,
        low + params.thickness,
        (one, two, three, four),
        hole,
        "crank",
        (0.0, 0.0),
        end.diameter,
        low - end.whole,
        "parameters.screw_offset",
        "parameters.screw_hole",
        "parameters.shaft",
        "parameters.thickness",
        neck=end.neck,
    )
