"""In which layers the plates stand, of one design or of a table, and which pins have heads.

Of one design the layers are found by :func:`mechwright.mechanics.linkage.stack`. Of a table of designs with a
disc and a straight rod bounds of the rooms between plates decide nearly all; rooms that they leave open are
measured.

Crank, rod, and slider with its rails are in three layers, or crank and slider share one. A spindle takes up
every layer from its lowest plate to its highest; crank and rod as well as rod and slider meet on their pin,
and so never share one. The first dealing whose rooms are free is the one that stands: the flattest, then the
one with the shortest spindles. A head on a pin asks for more room under what stands above it; where no
dealing has that, pins have none.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.design_table import Rowwise, column, rows_of
from mechwright.mechanics.linkage.closeness import PLAN_CHORD, Closeness
from mechwright_slider_crank.kinematics.course import ends_of
from mechwright_slider_crank.kinematics.extremes import bars_of, drives_of
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts import room_kernels as kernels
from mechwright_slider_crank.parts.dimensions import HEAD_SHARE, Dimensions, clear_overhang, corner_of
from mechwright_slider_crank.parts.plates import TURN_SAMPLES, layout_of, standing
from mechwright_slider_crank.parts.room_kernels import (
    ALL_ROOMS,
    CRANK_RAIL,
    CRANK_SLIDER,
    DOWEL_CRANK,
    DOWEL_ROD,
    DOWEL_SLIDER,
    HEAD_CRANK,
    HEAD_RAIL,
    HEAD_SLIDER,
    PIN_RAIL,
    PIN_SLIDER,
    SHAFT_RAIL,
    SHAFT_ROD,
    SHAFT_SLIDER,
    WRIST_CRANK,
    WRIST_RAIL,
)

Bools = NDArray[np.bool_]

_SURE = 1e-6
"""mm by which a bound has to be past its limit: more than rounding."""

_SHARES = np.linspace(0.0, 1.0, TURN_SAMPLES)
_CIRCLE = np.ascontiguousarray([np.cos(math.tau * _SHARES), np.sin(math.tau * _SHARES), _SHARES])
"""Cosine and sine of shares of a turn, and the shares."""

DOWELS = 4
"""Two in each rail."""

LEAST_BASE = 5.0
"""mm. A base that is narrower may have no room for its rounded corners."""

HEADS = {HEAD_SLIDER: PIN_SLIDER, HEAD_RAIL: PIN_RAIL, HEAD_CRANK: WRIST_CRANK}
"""Rooms of the pins' heads to those of the pins: between the same, but heads are wider."""

ALWAYS = (WRIST_RAIL, DOWEL_SLIDER)
"""Rooms that every dealing needs."""


def _needed(crank: int, rod: int, slider: int) -> tuple[int, ...]:
    """The rooms that a dealing of layers needs besides those that all need."""
    found = []
    low, high = sorted((crank, rod))
    if crank == slider:
        found += [CRANK_SLIDER, CRANK_RAIL]
    if rod <= crank:
        found.append(SHAFT_ROD)
    if slider <= crank:
        found += [SHAFT_SLIDER, SHAFT_RAIL]
    if low <= slider <= high:
        found += [PIN_SLIDER, PIN_RAIL]
    low, high = sorted((rod, slider))
    if low <= crank <= high:
        found.append(WRIST_CRANK)
    if crank <= slider:
        found.append(DOWEL_CRANK)
    if rod <= slider:
        found.append(DOWEL_ROD)
    return tuple(found)


def _heads(crank: int, rod: int, slider: int) -> tuple[int, ...]:
    """The rooms that heads of the pins need: what stands above a pin keeps off its head."""
    above = (HEAD_SLIDER, HEAD_RAIL) if slider > max(crank, rod) else ()
    return above + ((HEAD_CRANK,) if crank > max(rod, slider) else ())


def _cost(layers: tuple[int, int, int]) -> tuple[int, ...]:
    """What the least of is sought: the layers, the spindles' layers, and the layers of base and plates."""
    crank, rod, slider = layers
    spindles = crank + abs(crank - rod) + abs(rod - slider) + DOWELS * slider
    return (max(layers), spindles, *layers)


_DEALINGS = ((1, 2, 1), (2, 1, 2), (1, 2, 3), (1, 3, 2), (2, 1, 3), (2, 3, 1), (3, 1, 2), (3, 2, 1))
ORDER = tuple(sorted(_DEALINGS, key=_cost))
"""Layers of crank, rod and slider, those first that are taken first."""

_FLUSH = tuple(_needed(*layers) + ALWAYS for layers in ORDER)
_HEADED = tuple(rooms + _heads(*layers) for rooms, layers in zip(_FLUSH, ORDER, strict=True))
"""The rooms of each dealing without heads and with them."""


@dataclass(frozen=True)
class Layers(Rowwise):
    """Layers of crank, rod and slider, whether pins may have heads, and sizes with the rails; columns."""

    crank: Any
    rod: Any
    slider: Any
    heads: Any
    sizes: Dimensions


@dataclass(frozen=True)
class Rooms(Rowwise):
    """Which rooms (n, ALL_ROOMS) are too small, and which are large enough, with the rails of ``sizes``."""

    sizes: Dimensions
    blocked: Bools
    free: Bools

    @property
    def stuck(self) -> Bools:
        """Which designs (n, 1) certainly find no layers."""
        found: Bools = np.all([self.blocked[:, way].any(axis=1) for way in _FLUSH], axis=0)[:, None]
        return found

    @property
    def stands(self) -> Bools:
        """Which certainly find some."""
        found: Bools = np.any([self.free[:, way].all(axis=1) for way in _FLUSH], axis=0)[:, None]
        return found

    def known(self) -> Bools:
        """Which designs (n,) are decided."""
        return (self.stuck | self.stands)[:, 0]

    def dealing(self) -> tuple[NDArray[np.intp], Bools]:
        """The first dealing (n,) that nothing blocks, those with heads first, and whether it is sure."""
        ways = _HEADED + _FLUSH
        shut = np.array([self.blocked[:, rooms].any(axis=1) for rooms in ways])
        clear = np.array([self.free[:, rooms].all(axis=1) for rooms in ways])
        first = np.argmin(shut, axis=0)
        return first, clear[first, np.arange(len(self.blocked))]


def has_bounds(table: Mechanism) -> bool:
    """Whether these are designs of a table with a disc and a straight rod, for which there are bounds."""
    one = table.given
    plain = one.crank_shape == "disc" and one.rod_width is None and one.screw_hole is None
    return plain and not table.single and not np.any(one.coupler_bore) and not np.any(one.rod_bend)


def layers_of(table: Mechanism) -> Layers:
    """The layers of designs that have some; of a table those with bounds."""
    if table.single:
        layout = layout_of(table)
        layer = layout.stack.layer
        return Layers(layer["crank"], layer["rod"], layer["slider"], layout.heads, layout.sizes)
    return table.once("layers", partial(_dealt, table))


def _dealt(table: Mechanism) -> Layers:
    found = rooms_of(table)
    rooms = replace(found, blocked=found.blocked.copy(), free=found.free.copy())
    _refine(table, rooms, lambda: rooms.dealing()[1])
    way, _ = rooms.dealing()
    crank, rod, slider = (np.array(ORDER)[way % len(ORDER)].T)[:, :, None]
    return Layers(crank, rod, slider, (way < len(ORDER))[:, None], rooms.sizes)


def rooms_of(table: Mechanism) -> Rooms:
    """What is known of the rooms of a table, with the rails with which they find layers."""
    return table.once("rooms", partial(_rooms, table))


def _rooms(table: Mechanism) -> Rooms:
    found = _judged(table, table.dimensions)
    again = np.flatnonzero(found.stuck)
    if not again.size or table.given.rail_overhang is not None:
        return found
    # What finds no layers has longer rails where it finds some with them.
    others = table.rows(again)
    own = others.dimensions
    way = ends_of(others).way
    longer = replace(own, overhang=clear_overhang(own, others.given.crank, way, others.given.clearance))
    more = _judged(others, longer)
    overhang = column(table.dimensions.overhang, table.size).copy()
    overhang[again] = longer.overhang
    found.blocked[again], found.free[again] = more.blocked, more.free
    return replace(found, sizes=replace(found.sizes, overhang=overhang))


def _judged(table: Mechanism, sizes: Dimensions) -> Rooms:
    """Rooms by bounds, and where these do not tell whether there are layers, by measure."""
    rooms = bounds_of(table, sizes, rods=False)
    _refine(table, rooms, rooms.known)
    return rooms


def _refine(table: Mechanism, rooms: Rooms, known: Callable[[], Bools]) -> None:
    """Look closer at the rooms of designs of which not enough is ``known`` (n,), until it is."""
    if (left := np.flatnonzero(~known())).size:
        more = bounds_of(table.rows(left), rows_of(rooms.sizes, left, table.size), rods=True)
        rooms.blocked[left] |= more.blocked
        rooms.free[left] |= more.free
        for place in np.flatnonzero(~known()).tolist():
            measure(table, place, rooms)


def bounds_of(table: Mechanism, sizes: Dimensions, *, rods: bool) -> Rooms:
    """Which rooms are certainly too small, and which are certainly large enough."""
    count, play = table.size, table.given.play
    low, high = ends_of(table).way
    rail = (high - low + sizes.slider_length) / 2 + sizes.overhang
    apart = sizes.slider_width / 2 + play + sizes.rail / 2
    long, wide, thick = sizes.slider_length / 2, sizes.slider_width / 2, sizes.rail / 2
    disc = np.maximum(table.given.crank + sizes.pin_boss, sizes.shaft / 2 + sizes.wall)
    rows = [
        sizes.rod_boss, disc, long, wide, corner_of(long, wide), rail, thick, corner_of(rail, thick),
        (low + high) / 2, apart, rail - sizes.rail / 2,
    ]  # fmt: skip
    given = np.concatenate([column(one, count) for one in rows], axis=1)
    rooms = kernels.rooms(bars_of(table), drives_of(table)[:, :2].copy(), given, _CIRCLE, PLAN_CHORD, rods)
    radii: dict[int, Any] = dict.fromkeys((SHAFT_ROD, SHAFT_SLIDER, SHAFT_RAIL), sizes.shaft / 2)
    radii |= dict.fromkeys((PIN_SLIDER, PIN_RAIL, WRIST_CRANK, WRIST_RAIL), sizes.pin / 2)
    radii |= dict.fromkeys((DOWEL_CRANK, DOWEL_ROD, DOWEL_SLIDER), sizes.spacer)
    radii |= dict.fromkeys(HEADS, sizes.head[0] / 2)
    limit = table.given.clearance + 2 * PLAN_CHORD
    blocked, free = np.empty((count, ALL_ROOMS), bool), np.empty((count, ALL_ROOMS), bool)
    for room in range(ALL_ROOMS):
        least, own = column(limit + radii.get(room, 0.0), count)[:, 0], HEADS.get(room, room)
        blocked[:, room] = rooms[:, own, 1] < least - _SURE
        free[:, room] = rooms[:, own, 0] >= least + _SURE
    # The rails are as far from each other as their sides, and their dowels from the other one's.
    between = sizes.slider_width + 2 * play
    near = column(np.minimum(between, between + sizes.rail / 2 - sizes.spacer), count)[:, 0]
    least = column(limit, count)[:, 0]
    blocked[:, WRIST_RAIL] |= near < least - _SURE
    free[:, WRIST_RAIL] &= near >= least + _SURE
    return Rooms(sizes, blocked, free)


_MEASURED: Mapping[int, tuple[str, str]] = {
    SHAFT_ROD: ("shaft", "rod"), SHAFT_SLIDER: ("shaft", "slider"), SHAFT_RAIL: ("shaft", "rail"),
    PIN_SLIDER: ("crank-pin", "slider"), PIN_RAIL: ("crank-pin", "rail"), WRIST_CRANK: ("wrist-pin", "crank"),
    WRIST_RAIL: ("wrist-pin", "rail"), DOWEL_CRANK: ("dowel", "crank"), DOWEL_ROD: ("dowel", "rod"),
    DOWEL_SLIDER: ("dowel", "slider"), HEAD_SLIDER: ("crank-pin", "slider"), HEAD_RAIL: ("crank-pin", "rail"),
    HEAD_CRANK: ("wrist-pin", "crank"),
}  # fmt: skip

_PLATES: Mapping[int, tuple[str, ...]] = {
    **{room: (plate,) for room, (_, plate) in _MEASURED.items()},
    CRANK_SLIDER: ("crank", "slider"), CRANK_RAIL: ("crank", "rail"),
}  # fmt: skip
"""The plates that a room is between, or beside."""


def measure(table: Mechanism, place: int, rooms: Rooms) -> None:
    """Measure the rooms of a design that bounds leave open, as its layers are found with such rails."""
    row, blocked, free = table.row(place), rooms.blocked, rooms.free
    overhang: float = column(rooms.sizes.overhang, table.size)[place].item()
    row = type(row)(row.given.model_copy(update={"rail_overhang": overhang}))
    left = np.flatnonzero(~blocked[place] & ~free[place]).tolist()
    plates, spindles, poses, clearance = standing(row, {name for room in left for name in _PLATES[room]})
    close = Closeness(plates, spindles, poses, clearance)
    for room in left:
        if room in _MEASURED:
            (first, second), wider = _MEASURED[room], HEAD_SHARE if room in HEADS else 1.0
            hit = any(
                close.spindle(spindle, plate, wider * spindle.radius)
                for spindle in spindles
                for plate in plates
                if spindle.name.startswith(first)
                and plate.name.startswith(second)
                and plate.name not in spindle.plates
            )
        else:
            other = _PLATES[room][1]
            crank = next(plate for plate in plates if plate.name == "crank")
            hit = any(close.plates(crank, plate) for plate in plates if plate.name.startswith(other))
        blocked[place, room], free[place, room] = hit, not hit
