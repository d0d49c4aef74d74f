"""What a design table leaves open, from what it gives: every dimension of the mechanism.

In this order, each from those before it (docs/geneva.md, "What is left out"):

    angles and roller   those of :mod:`mechwright_geneva.slot_choice`
    l                   as the centre distance wants it, or 100 mm, more where the driver's shaft needs it
    pin                 the largest standard one up to 1.2 r
    crank plate         8 mm, of pins below 2 mm three and a half of them
    dowels              0.06 l, 2 to 4 mm; down to half of it where the driver has less room, or none
    bores               the largest standard shaft up to 0.12 l that leaves the walls
    load                0.01 kg m², of a wheel below 100 mm as that of a disc, with the fourth power of l
"""

import math

from mechwright import kept
from mechwright_geneva.openings import driver_opening, driver_radius, hub_radius, reach
from mechwright_geneva.params import GenevaParams, Sizes
from mechwright_geneva.series import PINS, largest, up_to
from mechwright_geneva.slot_choice import Slot, slot_of
from mechwright_geneva.usual import FAIR_SHAFT, LEAST_SHAFT, PIN, SHAFT, crank_of, dowel_of, load_of, wall_of

LEFT_OPEN = tuple(name for name, field in Sizes.model_fields.items() if field.is_required())
"""The keys that a design file may leave out and that have a value here."""


@kept
def sized(params: GenevaParams) -> Sizes:
    """The table with all that it leaves out. Its law has been found free of faults before."""
    if isinstance(params, Sizes):
        return params
    slot = slot_of(params)
    wall = params.least_wall or wall_of(slot.entry_radius)
    pin = params.pin_diameter or largest(PINS, PIN * slot.roller_radius)
    open_ones: dict[str, object] = {
        **slot.sizes(),
        "least_wall": wall,
        "pin_diameter": pin,
        "crank_thickness": crank_of(pin),
        "load_inertia": load_of(slot.entry_radius),
        # Placeholders: what follows is found with a complete table.
        "fixing": dowel_of(slot.entry_radius),
        "bore": 0.0,
        "driver_bore": 0.0,
    }
    given = params.model_dump(exclude_none=True)
    open_ones["left_out"] = tuple(name for name in LEFT_OPEN if getattr(params, name) is None)
    table = Sizes.model_validate({**open_ones, **given})
    return table.model_copy(update={**_driver(params, table, slot), **_wheel(params, table, slot)})


def _driver(params: GenevaParams, table: Sizes, slot: Slot) -> dict[str, float]:
    """Dowels and bore of the driver, in the room that its relief leaves about its axis."""
    room = slot.axes - slot.entry_radius - table.lock_clearance
    radius = slot.entry_radius
    shafts = _shafts(radius) if params.driver_bore is None else (params.driver_bore,)
    fair = next((one for one in shafts[::-1] if one >= math.floor(FAIR_SHAFT * radius)), shafts[0])

    def fits(bore: float, dowel: float) -> bool:
        opening = driver_opening(table.model_copy(update={"driver_bore": bore}))
        return driver_radius(reach(opening), table.least_wall, dowel) <= room

    dowels: tuple[float, ...] = (params.fixing or 0.0,)
    if params.fixing is None:
        thick = dowel_of(radius)
        dowels = (*(one for one in up_to(PINS, thick) if one >= thick / 2), 0.0)
    dowel = next((one for one in dowels if fits(fair, one)), dowels[-1])
    return {"fixing": dowel, "driver_bore": next((one for one in shafts if fits(one, dowel)), shafts[-1])}


def _wheel(params: GenevaParams, table: Sizes, slot: Slot) -> dict[str, float]:
    """Bore of the wheel, inside the slots' bottoms."""
    if params.bore is not None:
        return {}
    room = slot.bottom - slot.roller_radius - params.groove_clearance / 2 - table.least_wall
    shafts = _shafts(slot.entry_radius)
    able = (one for one in shafts if hub_radius(table.model_copy(update={"bore": one})) <= room)
    return {"bore": next(able, shafts[-1])}


def _shafts(entry_radius: float) -> tuple[float, ...]:
    """Standard shafts for a wheel, the largest first, down to the least that is worth having."""
    able = tuple(up_to(PINS, SHAFT * entry_radius))
    worth = tuple(one for one in able if one >= math.floor(LEAST_SHAFT * entry_radius))
    return worth or able or PINS[:1]
