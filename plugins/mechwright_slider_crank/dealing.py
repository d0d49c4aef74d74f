"""In which layers the plates of many slider-cranks stand, and which pins have heads.

All dealings of crank, rod, and slider with its rails are known; the first in the order of
:func:`mechwright.mechanics.linkage.stack` whose rooms are free is the one that stands: the flattest, then
the one with the shortest spindles. A head on a pin asks for more room under what stands above it; where no
dealing has that, pins have none.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.by_arrays import Designs
from mechwright_slider_crank.many import Cranks
from mechwright_slider_crank.room_kernels import HEAD_CRANK, HEAD_RAIL, HEAD_SLIDER
from mechwright_slider_crank.rooms import ALWAYS, WAYS, Bools, Rooms, closer, needed
from mechwright_slider_crank.sizes import Sizes

DOWELS = 4
"""Two in each rail."""


def _cost(layers: tuple[int, int, int]) -> tuple[int, ...]:
    """What the least of is sought: the layers, the spindles' layers, and the layers of base and plates."""
    crank, rod, slider = layers
    spindles = crank + abs(crank - rod) + abs(rod - slider) + DOWELS * slider
    return (max(layers), spindles, *layers)


ORDER = tuple(sorted(WAYS, key=_cost))
"""Layers of crank, rod and slider, those first that are taken first."""

ROOMS_OF = tuple(needed(*layers) + ALWAYS for layers in ORDER)


def _heads(crank: int, rod: int, slider: int) -> tuple[int, ...]:
    """The rooms that heads of the pins need: what stands above a pin keeps off its head."""
    above = (HEAD_SLIDER, HEAD_RAIL) if slider > max(crank, rod) else ()
    return above + ((HEAD_CRANK,) if crank > max(rod, slider) else ())


HEADS_OF = tuple(rooms + _heads(*layers) for rooms, layers in zip(ROOMS_OF, ORDER, strict=True))


@dataclass(frozen=True)
class Dealt:
    """Layers (n,) of crank, rod and slider, whether pins may have heads, and the sizes with the rails."""

    crank: NDArray[np.int64]
    rod: NDArray[np.int64]
    slider: NDArray[np.int64]
    heads: Bools
    sizes: Sizes


def dealt(designs: Designs, many: Cranks, rooms: Rooms) -> Dealt:
    """How the plates of designs stand that find layers in these rooms, which are looked at closer for it."""
    blocked, free = rooms.blocked.copy(), rooms.free.copy()
    closer(designs, many, rooms.sizes, blocked, free, lambda: _first(blocked, free)[1])
    way, _ = _first(blocked, free)
    crank, rod, slider = np.array(ORDER)[way % len(ORDER)].T
    return Dealt(crank, rod, slider, way < len(ORDER), rooms.sizes)


def _first(blocked: Bools, free: Bools) -> tuple[NDArray[np.intp], Bools]:
    """The first dealing (n,) that nothing blocks, those with heads before all others; whether it is sure."""
    ways = HEADS_OF + ROOMS_OF
    shut = np.array([blocked[:, rooms].any(axis=1) for rooms in ways])
    clear = np.array([free[:, rooms].all(axis=1) for rooms in ways])
    first = np.argmin(shut, axis=0)
    return first, clear[first, np.arange(len(blocked))]
