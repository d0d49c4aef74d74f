"""The ground plate, from which a base, legs and a motor can follow."""

from mechwright import GroundPlate, MountingError
from mechwright.contracts.mounting import SCREW_HOLE
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.plates import BOLT, joints_of, layout_of


def mounting_of(params: FourBarParams) -> GroundPlate:
    """The one ground plate, or the lower one of two, and the crank's shaft.

    Raises MountingError where the bolts of two plates have no ends for pillars.
    """
    layout = layout_of(params)
    if layout.sides == 2 and params.screw_hole is None:
        raise MountingError(
            "parameters.screw_hole: the bolts of both ground plates have no threaded ends for the pillars of "
            f"a frame; set screw_hole = {SCREW_HOLE:g}",
            ({"parameters.screw_hole": SCREW_HOLE},),
        )
    low, shaft = layout.bottom("ground"), joints_of(params)["shaft"]
    x = sorted({at.real for at in layout.screws})
    y = sorted({at.imag for at in layout.screws})
    return GroundPlate(
        "ground",
        low,
        low + params.ground_thickness,
        ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])),
        layout.hole,
        "crank",
        (0.0, 0.0),
        params.pin_diameter,
        layout.stack.spans["shaft"][0] - shaft.below * params.pin_diameter,
        "parameters.screw_offset",
        "parameters.screw_hole",
        "parameters.pin_diameter",
        "parameters.ground_thickness",
        bolts=("bolt", BOLT * layout.hole) if layout.sides == 2 else None,
    )
