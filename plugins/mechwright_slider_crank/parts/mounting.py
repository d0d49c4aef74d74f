"""What a frame is told of the base and of the shaft's end below it."""

from mechwright import GroundPlate, MountingError
from mechwright.standards.screws import FRAME, through_hole
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.base import shaft_end
from mechwright_slider_crank.parts.plates import layout_of


def mounting_of(table: Mechanism) -> GroundPlate:
    """The base and the crank's shaft; raises DesignError where the base has no holes for legs."""
    layout, hole = layout_of(table), table.given.screw_hole
    if hole is None:
        hole = through_hole(FRAME, table.given.thickness)
        raise MountingError(
            f"parameters.screw_hole: the base has no holes for the screws of legs; make it {hole:g}",
            ({"parameters.screw_hole": hole},),
        )
    low, end = layout.stack.bottom("base"), shaft_end(table)
    one, two, three, four = ((at.real, at.imag) for at in layout.screws)
    return GroundPlate(
        "base",
        low,
        low + table.given.thickness,
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
