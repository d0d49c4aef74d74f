"""Whether rectangles fit on a blank, with the channels of mills around them."""

from collections.abc import Sequence

from mechwright.geometry.packing import on_plate

WEB = 3.0
"""Frame between two channels, mm: as wide as beside the outermost channel, stiff enough for tabs."""


def fits_blank(
    sizes: Sequence[tuple[float, float]],
    blank: tuple[float, float],
    gap: float,
    room: tuple[float, float],
    *,
    turn: bool,
) -> bool:
    """Whether rectangles ``gap`` mm apart fit on a blank, as long and wide, either way round.

    A channel and a frame stay on either side, and the mills stay within the travel ``room`` in X and Y, mm.

    >>> bars = [(180.0, 20.0), (90.0, 20.0)]
    >>> fits_blank(bars, (200.0, 63.0), 9.0, (300.0, 190.0), turn=True)
    True
    >>> fits_blank(bars, (200.0, 63.0), 9.0, (180.0, 150.0), turn=True)
    False
    """
    order, beside = sorted(sizes, key=lambda size: (-max(size), -min(size))), gap + WEB
    ways = ((blank[0] - beside, blank[1] - beside), (blank[1] - beside, blank[0] - beside))
    return any(
        on_plate(order, min(x, room[0] - gap), min(y, room[1] - gap), gap, turn) is not None for x, y in ways
    )
