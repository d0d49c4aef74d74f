"""The ground plate, from which a base, legs and a motor can follow."""

from mechwright.contracts.mounting import GroundPlate, MountingError
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.parts import BOLT, pin_span
from mechwright.mechanics.linkage.parts.retention import retention_of
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic

BOLT_HOLE = 6.0
"""Diameter of bolts between two ground plates, mm: their ends M5 leave a shoulder."""


def mounting_of(layout: Layout) -> GroundPlate:
    """The one ground plate, or the lower one of two, and the shaft of the driven link.

    Raises
    ------
    MountingError
        No link is driven by a shaft in the ground, the shaft is not at the origin of its link, or the bolts
        of two plates have no ends for pillars.
    """
    sizes = layout.sizes
    machine = layout.linkage.machine
    if isinstance(machine.driven_joint(machine.drives[0]), Prismatic):
        raise MountingError("driver: it slides, and a frame carries the shaft of one that turns")
    shaft = next((pin for pin in layout.pins if pin.below), None)
    if shaft is None:
        raise MountingError("no link is driven about a pivot of the ground, so there is no shaft for a motor")
    if shaft.place:
        raise MountingError(
            f"the shaft of {shaft.body} is at {shaft.place:.4g} in it, and a frame needs it at 0; "
            f"make the pivot the origin of {shaft.body}"
        )
    if layout.posts and sizes.screw_hole is None:
        raise MountingError(
            "parameters.screw_hole: the bolts of both ground plates have no threaded ends for the pillars of "
            f"a frame; set screw_hole = {BOLT_HOLE:g}",
            ({"parameters.screw_hole": BOLT_HOLE},),
        )
    low = layout.stack.bottom(GROUND)
    x = sorted({at.real for at in layout.screws})
    y = sorted({at.imag for at in layout.screws})
    axis, held = shaft.places[GROUND], retention_of(layout)
    return GroundPlate(
        GROUND,
        low,
        low + sizes.ground_thickness,
        ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])),
        sizes.hole,
        shaft.body,
        (axis.real, axis.imag),
        sizes.pin_diameter,
        pin_span(layout, shaft)[0],
        "parameters.screw_offset",
        "parameters.screw_hole",
        "parameters.pin_diameter",
        "parameters.ground_thickness",
        neck=0.0 if held is None else held.neck,
        offset=(y[1] - y[0]) / 2,
        bolts=("bolt", BOLT * sizes.hole) if layout.posts else None,
    )
