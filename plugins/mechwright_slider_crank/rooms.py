"""Whether the plates of many slider-cranks find layers.

Bounds of the rooms between plates tell it; where they leave it open, the rooms themselves are measured.

Crank, rod, and slider with its rails are in three layers, or crank and slider share one. A spindle takes up
every layer from its lowest plate to its highest; crank and rod as well as rod and slider meet on their pin,
and so never share one. Heads of pins forbid nothing: without room for them pins have none.
"""

from collections.abc import Mapping
from dataclasses import replace
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
    CRANK_RAIL,
    CRANK_SLIDER,
    DOWEL_CRANK,
    DOWEL_ROD,
    DOWEL_SLIDER,
    PIN_RAIL,
    PIN_SLIDER,
    ROOMS,
    SHAFT_RAIL,
    SHAFT_ROD,
    SHAFT_SLIDER,
    WRIST_CRANK,
    WRIST_RAIL,
)
from mechwright_slider_crank.sizes import Sizes, clear_overhang, corner_of

Bools = NDArray[np.bool_]

_SURE = 1e-6
"""mm by which a bound has to be past its limit: more than rounding."""

_CIRCLE = circle_of(TURN_SAMPLES)


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


ALWAYS = (WRIST_RAIL, DOWEL_SLIDER)
"""Rooms that every dealing needs."""

WAYS = tuple(
    _needed(*layers)
    for layers in ((1, 2, 1), (2, 1, 2), (1, 2, 3), (1, 3, 2), (2, 1, 3), (2, 3, 1), (3, 1, 2), (3, 2, 1))
)
"""The rooms that each dealing needs: layers of crank, rod and slider."""


def forbid_layers(found: Answer, designs: Designs, many: Cranks, sizes: Sizes) -> None:
    """Forbid the designs that are open and whose plates find no layers."""
    many.ends  # noqa: B018 - found once for all
    left = found.left
    if not left.size:
        return
    chosen = designs.some(left)
    few = _some(sizes, left)
    cranks = many.some(left)
    stuck, stands = _judged(chosen, cranks, few)
    again = np.flatnonzero(stuck)
    if again.size and "rail_overhang" not in designs.varied and designs.common.rail_overhang is None:
        # What finds no layers has longer rails where it finds some with them.
        fewer, slid = _some(few, again), cranks.some(again)
        low, high = np.sort(np.stack([slid.ends.near_position, slid.ends.far_position]), axis=0)
        others = chosen.some(again)
        crank, clearance = slid.bars[:, 0], others.full("clearance")
        longer = replace(fewer, overhang=clear_overhang(fewer, crank, (low, high), clearance))
        stuck[again], stands[again] = _judged(others, slid, longer)
    found.forbid("slider-crank.layers", stuck, left)
    found.doubt(~stuck & ~stands, left)


def _judged(designs: Designs, many: Cranks, sizes: Sizes) -> tuple[Bools, Bools]:
    """Which designs (n,) find no layers, and which do: by bounds, or where those leave it open by measure."""
    many.ends  # noqa: B018 - found once for all
    blocked, free = bounds_of(designs, many, sizes, rods=False)
    stuck, stands = decided(blocked, free)
    if (open_ := np.flatnonzero(~stuck & ~stands)).size:
        fewer = _some(sizes, open_)
        blocked[open_], free[open_] = bounds_of(designs.some(open_), many.some(open_), fewer, rods=True)
        stuck, stands = decided(blocked, free)
    for place in np.flatnonzero(~stuck & ~stands):
        measure(designs, int(place), _at(sizes.overhang, int(place)), blocked, free)
        one = slice(place, place + 1)
        stuck[one], stands[one] = decided(blocked[one], free[one])
    return stuck, stands


def _some(sizes: Sizes, places: NDArray[np.intp]) -> Sizes:
    return Sizes(*(_at(getattr(sizes, name), places) for name in Sizes.__dataclass_fields__))


def _at(value: Any, places: NDArray[np.intp] | int) -> Any:
    return value[places] if isinstance(value, np.ndarray) else value


def bounds_of(designs: Designs, many: Cranks, sizes: Sizes, *, rods: bool) -> tuple[Bools, Bools]:
    """Which rooms (n, ROOMS) are certainly too small, and which are certainly large enough."""
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
    blocked, free = np.empty((count, ROOMS), bool), np.empty((count, ROOMS), bool)
    for room in range(ROOMS):
        needed = limit + radii.get(room, 0.0)
        blocked[:, room] = rooms[:, room, 1] < needed - _SURE
        free[:, room] = rooms[:, room, 0] >= needed + _SURE
    # The rails are as far from each other as their sides, and their dowels from the other one's.
    between = sizes.slider_width + 2 * designs["play"]
    near = np.minimum(between, between + sizes.rail / 2 - sizes.spacer)
    blocked[:, WRIST_RAIL] |= near < limit - _SURE
    free[:, WRIST_RAIL] &= near >= limit + _SURE
    return blocked, free


def decided(blocked: Bools, free: Bools) -> tuple[Bools, Bools]:
    """Which designs (n,) certainly find no layers, and which certainly do."""
    stuck = np.all([blocked[:, way].any(axis=1) for way in WAYS], axis=0) | blocked[:, ALWAYS].any(axis=1)
    stands = np.any([free[:, way].all(axis=1) for way in WAYS], axis=0) & free[:, ALWAYS].all(axis=1)
    return stuck, stands


_MEASURED: Mapping[int, tuple[str, str]] = {
    SHAFT_ROD: ("shaft", "rod"), SHAFT_SLIDER: ("shaft", "slider"), SHAFT_RAIL: ("shaft", "rail"),
    PIN_SLIDER: ("crank-pin", "slider"), PIN_RAIL: ("crank-pin", "rail"), WRIST_CRANK: ("wrist-pin", "crank"),
    WRIST_RAIL: ("wrist-pin", "rail"), DOWEL_CRANK: ("dowel", "crank"), DOWEL_ROD: ("dowel", "rod"),
    DOWEL_SLIDER: ("dowel", "slider"),
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
            first, second = _MEASURED[room]
            hit = any(
                close.spindle(spindle, plate, spindle.radius)
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
