"""Whether the plates of many slider-cranks find layers.

Bounds of the rooms between plates tell it; where they leave it open, the rooms themselves are measured.

Crank, rod, and slider with its rails are in three layers, or crank and slider share one. A spindle takes up
every layer from its lowest plate to its highest; crank and rod as well as rod and slider meet on their pin,
and so never share one. Heads of pins forbid nothing: without room for them pins have none.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.mechanics.linkage.closeness import PLAN_CHORD, Closeness
from mechwright_slider_crank import room_kernels as kernels
from mechwright_slider_crank.many import Cranks
from mechwright_slider_crank.period_kernels import circle_of
from mechwright_slider_crank.plates import TURN_SAMPLES, standing
from mechwright_slider_crank.room_kernels import (
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
from mechwright_slider_crank.sizes import HEAD_SHARE, Sizes, clear_overhang, corner_of

Bools = NDArray[np.bool_]

_SURE = 1e-6
"""mm by which a bound has to be past its limit: more than rounding."""

_CIRCLE = circle_of(TURN_SAMPLES)


def needed(crank: int, rod: int, slider: int) -> tuple[int, ...]:
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


HEADS = {HEAD_SLIDER: PIN_SLIDER, HEAD_RAIL: PIN_RAIL, HEAD_CRANK: WRIST_CRANK}
"""Rooms of the pins' heads to those of the pins: between the same, but heads are wider."""

ALWAYS = (WRIST_RAIL, DOWEL_SLIDER)
"""Rooms that every dealing needs."""

WAYS = ((1, 2, 1), (2, 1, 2), (1, 2, 3), (1, 3, 2), (2, 1, 3), (2, 3, 1), (3, 1, 2), (3, 2, 1))
"""Layers of crank, rod and slider in each dealing."""

_OF_WAY = tuple(needed(*layers) for layers in WAYS)
"""The rooms that each dealing needs."""


@dataclass(frozen=True)
class Rooms:
    """What is known of designs (n,) at the places ``left``, with the rails with which they find layers.

    ``blocked`` and ``free`` (n, ALL_ROOMS) say which rooms are too small and which are large enough.
    """

    left: NDArray[np.intp]
    sizes: Sizes
    blocked: Bools
    free: Bools

    def some(self, places: NDArray[np.intp]) -> "Rooms":
        """Those at these places, which are among ``left``."""
        which = np.searchsorted(self.left, places)
        return Rooms(places, some_sizes(self.sizes, which), self.blocked[which], self.free[which])


def forbid_layers(found: Answer, designs: Designs, many: Cranks, sizes: Sizes) -> Rooms:
    """Forbid the designs that are open and whose plates find no layers."""
    many.ends  # noqa: B018 - found once for all
    left = found.left
    chosen, cranks, few = designs.some(left), many.some(left), some_sizes(sizes, left)
    blocked, free = _judged(chosen, cranks, few)
    stuck, stands = decided(blocked, free)
    again = np.flatnonzero(stuck)
    if again.size and "rail_overhang" not in designs.varied and designs.common.rail_overhang is None:
        # What finds no layers has longer rails where it finds some with them.
        others, slid = chosen.some(again), cranks.some(again)
        longer = longer_rails(others, slid, some_sizes(few, again))
        overhang: Any = np.array(np.broadcast_to(few.overhang, left.size), dtype=float)
        overhang[again] = longer.overhang
        few = replace(few, overhang=overhang)
        blocked[again], free[again] = _judged(others, slid, longer)
        stuck[again], stands[again] = decided(blocked[again], free[again])
    found.forbid("slider-crank.layers", stuck, left)
    found.doubt(~stuck & ~stands, left)
    return Rooms(left, few, blocked, free)


def longer_rails(designs: Designs, many: Cranks, sizes: Sizes) -> Sizes:
    """Sizes with rails whose dowels stand outside of all that crank and rod sweep."""
    low, high = np.sort(np.stack([many.ends.near_position, many.ends.far_position]), axis=0)
    crank, clearance = many.bars[:, 0], designs.full("clearance")
    return replace(sizes, overhang=clear_overhang(sizes, crank, (low, high), clearance))


def _judged(designs: Designs, many: Cranks, sizes: Sizes) -> tuple[Bools, Bools]:
    """Rooms by bounds, and where these do not tell whether there are layers, by measure."""
    many.ends  # noqa: B018 - found once for all
    blocked, free = bounds_of(designs, many, sizes, rods=False)

    def known() -> Bools:
        return np.asarray(np.logical_or(*decided(blocked, free)))

    closer(designs, many, sizes, blocked, free, known)
    return blocked, free


def closer(
    designs: Designs, many: Cranks, sizes: Sizes, blocked: Bools, free: Bools, known: Callable[[], Bools]
) -> None:
    """Look closer at the rooms of designs of which not enough is ``known`` (n,), until it is."""
    if (left := np.flatnonzero(~known())).size:
        bounds = bounds_of(designs.some(left), many.some(left), some_sizes(sizes, left), rods=True)
        blocked[left] |= bounds[0]
        free[left] |= bounds[1]
        for place in np.flatnonzero(~known()).tolist():
            measure(designs, place, _at(sizes.overhang, place), blocked, free)


def some_sizes(sizes: Sizes, places: NDArray[np.intp]) -> Sizes:
    """Those of the designs at these places."""
    return Sizes(*(_at(getattr(sizes, name), places) for name in Sizes.__dataclass_fields__))


def _at(value: Any, places: NDArray[np.intp] | int) -> Any:
    return value[places] if isinstance(value, np.ndarray) else value


def bounds_of(designs: Designs, many: Cranks, sizes: Sizes, *, rods: bool) -> tuple[Bools, Bools]:
    """Which rooms (n, ALL_ROOMS) are certainly too small, and which are certainly large enough."""
    count = len(designs)
    low, high = np.sort(np.stack([many.ends.near_position, many.ends.far_position]), axis=0)
    rail = (high - low + sizes.slider_length) / 2 + sizes.overhang
    apart = sizes.slider_width / 2 + designs["play"] + sizes.rail / 2
    long, wide, thick = sizes.slider_length / 2, sizes.slider_width / 2, sizes.rail / 2
    disc = np.maximum(many.bars[:, 0] + sizes.pin_boss, sizes.shaft / 2 + sizes.wall)
    table = [
        sizes.rod_boss, disc, long, wide, corner_of(long, wide), rail, thick, corner_of(rail, thick),
        (low + high) / 2, apart, rail - sizes.rail / 2,
    ]  # fmt: skip
    rows = np.stack([np.broadcast_to(one, count) for one in table], axis=1).astype(float)
    rooms = kernels.rooms(many.bars, many.drives[:, :2].copy(), rows, _CIRCLE, PLAN_CHORD, rods)
    radii: dict[int, Any] = dict.fromkeys((SHAFT_ROD, SHAFT_SLIDER, SHAFT_RAIL), sizes.shaft / 2)
    radii |= dict.fromkeys((PIN_SLIDER, PIN_RAIL, WRIST_CRANK, WRIST_RAIL), sizes.pin / 2)
    radii |= dict.fromkeys((DOWEL_CRANK, DOWEL_ROD, DOWEL_SLIDER), sizes.spacer)
    limit = designs["clearance"] + 2 * PLAN_CHORD
    radii |= dict.fromkeys(HEADS, sizes.head[0] / 2)
    blocked, free = np.empty((count, ALL_ROOMS), bool), np.empty((count, ALL_ROOMS), bool)
    for room in range(ALL_ROOMS):
        least, own = limit + radii.get(room, 0.0), HEADS.get(room, room)
        blocked[:, room] = rooms[:, own, 1] < least - _SURE
        free[:, room] = rooms[:, own, 0] >= least + _SURE
    # The rails are as far from each other as their sides, and their dowels from the other one's.
    between = sizes.slider_width + 2 * designs["play"]
    near = np.minimum(between, between + sizes.rail / 2 - sizes.spacer)
    blocked[:, WRIST_RAIL] |= near < limit - _SURE
    free[:, WRIST_RAIL] &= near >= limit + _SURE
    return blocked, free


def decided(blocked: Bools, free: Bools) -> tuple[Bools, Bools]:
    """Which designs (n,) certainly find no layers, and which certainly do."""
    stuck = np.all([blocked[:, way].any(axis=1) for way in _OF_WAY], axis=0) | blocked[:, ALWAYS].any(axis=1)
    stands = np.any([free[:, way].all(axis=1) for way in _OF_WAY], axis=0) & free[:, ALWAYS].all(axis=1)
    return stuck, stands


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


def measure(designs: Designs, place: int, overhang: float, blocked: Bools, free: Bools) -> None:
    """Measure the rooms of a design that bounds leave open, as its layers are found with such rails."""
    changes = {name: values[place].item() for name, values in designs.varied.items()}
    changes["rail_overhang"] = float(overhang)
    left = np.flatnonzero(~blocked[place] & ~free[place]).tolist()
    wanted = {name for room in left for name in _PLATES[room]}
    plates, spindles, poses, clearance = standing(designs.common.model_copy(update=changes), wanted)
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
