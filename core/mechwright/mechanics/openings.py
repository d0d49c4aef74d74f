"""The opening for a shaft of a design table."""

from mechwright.contracts.keyed import Keyed
from mechwright.errors import GeometryError
from mechwright.geometry.keyway import Opening, key_of_width


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
