"""The ground plate over its gears, from which a base, legs and a motor can follow."""

from mechwright import GroundPlate, MountingError
from mechwright.standards.screws import FRAME, through_hole
from mechwright_five_bar.parts.hub import Hub, hub_of
from mechwright_five_bar.parts.parts import spans_of
from mechwright_five_bar.table import FiveBarTable

KEY_ROOM = 1.0
"""Around the heads of the clamp's screws, mm, in the way of a key to them."""


def mounting_of(m: FiveBarTable) -> GroundPlate:
    """The ground plate and the crank's shaft; raises MountingError where it stands on posts of its own."""
    params = m.params
    if params.screw_hole is None:
        hole = through_hole(FRAME, params.ground_thickness)
        raise MountingError(
            "parameters.screw_hole: the ground plate stands on posts that are pressed into it, where the "
            f"pillars of a frame would be; set screw_hole = {hole:g}",
            ({"parameters.screw_hole": hole},),
        )
    layout, hub = m.layout, hub_of(params)
    low = layout.heights["ground"]
    x = sorted({at.real for at in layout.posts})
    y = sorted({at.imag for at in layout.posts})
    return GroundPlate(
        "ground",
        low,
        low + params.ground_thickness,
        ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])),
        params.screw_hole,
        "crank",
        (0.0, 0.0),
        params.pin_diameter,
        spans_of(params, layout)["shaft-a0"][0],
        "parameters.post_offset",
        "parameters.screw_hole",
        "parameters.pin_diameter",
        "parameters.ground_thickness",
        offset=params.post_offset,
        outwards=(1.0, 1.0),
        neck=low - layout.heights["pinion"],
        access=() if hub is None else (_way(m, hub),),
    )


def _way(m: FiveBarTable, hub: Hub) -> tuple[tuple[float, float], float]:
    """Of a key to the screws of the arm's gear, wherever in its swing it stands."""
    at = m.train.places["wheel"]
    return (at.real, at.imag), hub.circle + hub.clamp.size.head / 2 + KEY_ROOM
