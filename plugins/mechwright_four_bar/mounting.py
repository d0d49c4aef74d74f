"""The ground plate, from which a base, legs and a motor can follow."""

from mechwright import DesignError, GroundPlate
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.plates import joints_of, layout_of


def mounting_of(params: FourBarParams) -> GroundPlate:
    """The one ground plate and the crank's shaft; raises DesignError where there are two plates."""
    layout = layout_of(params)
    if layout.sides == 2:
        raise DesignError(
            "machine.frame: the links stand between two ground plates, whose bolts stand out below, where "
            'the legs of a base would be; leave frame out, or set frame = "none"'
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
    )
