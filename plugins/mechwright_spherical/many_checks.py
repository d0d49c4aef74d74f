"""Errors of the links of many four-bars whose ground is outside of them, in the order of the check."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.tolerances import exceeds, falls_short
from mechwright_spherical.flat import SHARPEST
from mechwright_spherical.frame import AIR
from mechwright_spherical.hardware_checks import LONGEST_GROUND, WALL
from mechwright_spherical.stand import FLANGE_SCREWS, MOUNTING_SCREWS

_EDGE = 1e-9
"""mm. A room that is so near to its limit is left to the check itself."""


_SIZES = (
    *("standoff", "link_thickness", "link_width", "boss_diameter", "boss_height", "pin_diameter"),
    *("fit", "gap"),
)
"""Of the table hardware."""


@dataclass(frozen=True)
class Rooms:
    """Least angles (n,), rad, from ends of crank and rocker to the other's arc and ends, and crossing."""

    arc: Array
    end: Array
    cross: NDArray[np.bool_]


def hardware_errors(
    found: Answer, designs: Designs, arcs: Array, rooms: Callable[[NDArray[np.intp]], Rooms]
) -> None:
    """Forbid what the check of links, pins, stand and strips forbids; doubt what may stand on both sides."""
    left = found.left
    if not left.size:
        return
    some, few = designs.some(left), arcs[:, left]
    own = {name: some[f"hardware.{name}"] for name in _SIZES}
    thick = own["link_thickness"] + 2 * own["boss_height"]
    coupler = some["radius"] + own["standoff"]
    crank = coupler + thick + own["gap"]
    ground = crank + thick + own["gap"]
    air = _air(own, crank, rooms(left))
    outside = np.asarray(~(air < AIR))
    found.doubt(np.abs(air - AIR) < _EDGE, left)
    if designs.common.hardware.frame == "auto":
        found.doubt(~outside, left)
    boss = own["boss_diameter"]
    found.forbid("spherical.boss", _short(boss, own["pin_diameter"] + own["fit"] + 2 * WALL), left)
    found.forbid("spherical.gap", _all(own["gap"] <= np.hypot(coupler, boss / 2) - coupler, left), left)
    _shafts(found, left, some, few, own, (coupler, crank, ground))
    found.forbid("spherical.clearance", ~outside, left)
    _stand(found, left, some, few, own, ground + thick)
    if some["flat.make"] is True:
        _strips(found, left, some, few, own, (coupler, crank, ground))
    elif "flat.make" in some.varied:
        found.doubt(np.ones(left.size, bool), left)


def _short(value: Any, limit: Any) -> Any:
    return np.asarray(falls_short(value, limit))


def _all(which: Any, places: NDArray[np.intp]) -> NDArray[np.bool_]:
    return np.broadcast_to(which, places.shape)


def _air(own: dict[str, Any], radius: Any, near: Rooms) -> Array:
    """Air, mm, as :func:`mechwright_spherical.clearances.links_apart` has it."""
    arc, disc = np.arctan2(own["link_width"] / 2, radius), np.arctan2(own["boss_diameter"] / 2, radius)
    gaps = [np.where(near.cross, 0.0, near.arc) - 2 * arc, near.arc - arc - disc, near.end - 2 * disc]
    return np.asarray(radius * np.minimum.reduce(gaps))


def _shafts(
    found: Answer,
    left: NDArray[np.intp],
    some: Designs,
    arcs: Array,
    own: dict[str, Any],
    at: tuple[Any, ...],
) -> None:
    coupler, crank, ground = at
    bored, bossed = own["pin_diameter"] + own["fit"] + WALL, own["boss_diameter"] + AIR
    kappa, eta = np.radians(some["four_bar.point_azimuth"]), np.radians(some["four_bar.point_elevation"])
    to_a, to_b = (np.arccos(np.clip(np.cos(eta) * np.cos(x), -1, 1)) for x in (kappa, kappa - arcs[2]))
    for angle, diameter, there in (
        (arcs[2], bossed, crank),
        (arcs[0], bored, ground),
        (arcs[1], bored, crank),
        (arcs[3], bored, crank),
        (to_a, bored, coupler),
        (to_b, bored, coupler),
    ):
        with np.errstate(divide="ignore"):  # a point on a pin needs a sphere without end
            needed = diameter / 2 / np.tan(angle / 2)
        found.forbid("spherical.shafts", _all(exceeds(needed, there), left), left)


def _stand(
    found: Answer, left: NDArray[np.intp], some: Designs, arcs: Array, own: dict[str, Any], outside: Any
) -> None:
    plate, screw, height, arc = (some[f"stand.{name}"] for name in ("plate", "screw", "height", "arc"))
    flange = 2 * (math.hypot(*FLANGE_SCREWS[0]) * plate + 1.5 * screw)
    wide = np.maximum(own["boss_diameter"], flange * outside / (outside + height))
    needed = np.arctan2(own["boss_diameter"] / 2 + AIR, outside) + np.arctan2(wide / 2, outside)
    rim = (0.5 - abs(MOUNTING_SCREWS[0][0])) * plate
    for wrong in (
        exceeds(np.degrees(arcs[0]) + arc, LONGEST_GROUND),
        _short(np.radians(arc), needed),
        _short(rim, screw) | exceeds(flange, plate),
        _short(height, own["link_thickness"]),
    ):
        found.forbid("spherical.stand", _all(wrong, left), left)


def _strips(
    found: Answer,
    left: NDArray[np.intp],
    some: Designs,
    arcs: Array,
    own: dict[str, Any],
    at: tuple[Any, ...],
) -> None:
    coupler, crank, ground = at
    for angle, inner in zip(arcs, (ground, crank, coupler, crank), strict=True):
        bend = angle / np.ceil(angle / SHARPEST - 1e-9)
        leg = (inner + own["boss_height"] - some["flat.bend_radius"]) * np.tan(bend / 2)
        found.forbid("spherical.strip", _all(_short(leg, own["boss_diameter"] / 2), left), left)
