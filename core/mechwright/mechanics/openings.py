"""The opening for a shaft of a design table."""

from mechwright.contracts.keyed import Keyed
from mechwright.contracts.limits import limits
from mechwright.contracts.measure import Measure
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry.keyway import Opening, key_of_width
from mechwright.standards.keys import depth_tolerance

HUB_WIDTH = "JS9"
"""Tolerance class of a hub's keyway: a mill keeps it, and a key h9 slides or sticks lightly."""


def opening_of(table: Keyed) -> Opening | None:
    """The shaft opening, None without a bore.

    Raises
    ------
    GeometryError
        The keyway's width is not standard and its depth is not given.
    """
    if table.bore == 0:
        return None
    if table.keyway_width == 0:
        return Opening(table.bore)
    depth = table.keyway_depth
    if depth is None:
        key = key_of_width(table.keyway_width)
        if key is None:
            raise GeometryError(
                f"keyway_depth: no standard key is {table.keyway_width:g} mm wide; give a depth"
            )
        depth = key.hub_depth
    return Opening(table.bore, table.keyway_width, depth, table.keyway_relief)


def keyway_measures(opening: Opening | None) -> tuple[Measure, ...]:
    """Width of a hub's keyway and what is measured across it and the bore; none without a keyway.

    >>> [(one.what, one.nominal, one.greatest) for one in keyway_measures(Opening(12, 4, 1.8))][1]
    ('across bore and keyway', 13.8, 13.9)
    """
    if opening is None or not opening.has_keyway:
        return ()
    width, across = opening.width, round(opening.bore + opening.depth, 6)
    try:
        lower, upper = (one / 1000 for one in limits(width, HUB_WIDTH))
        wide = Measure("width of the keyway", width, width + lower, width + upper, HUB_WIDTH)
    except DesignError:  # the table of limits does not hold the class
        wide = Measure("width of the keyway", width, by=HUB_WIDTH)
    deepest = round(across + depth_tolerance(width), 6)
    return wide, Measure("across bore and keyway", across, across, deepest, "DIN 6885-1")
