"""Shaft openings of wheel and driver."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright import Array, Finding
from mechwright.geometry.keyway import (
    KEYS,
    LEAST_WIDTH,
    SMALLEST_EDGE,
    Opening,
    key_for_bore,
    key_of_width,
)
from mechwright.mechanics.openings import keyway_findings, too_small
from mechwright_geneva.params import Sizes


def wheel_opening(params: Sizes) -> Opening | None:
    """The wheel's opening; None without a bore."""
    return _opening(params.bore, params.keyway_width, params.keyway_relief)


def driver_opening(params: Sizes) -> Opening | None:
    """The driver's opening; None without a bore."""
    return _opening(params.driver_bore, params.driver_keyway_width, params.keyway_relief)


def _opening(bore: float, width: float, relief: float) -> Opening | None:
    if bore == 0:
        return None
    key = key_of_width(width)
    if key is None:
        return Opening(bore)
    return Opening(bore, key.width, key.hub_depth, relief)


def reach(opening: Opening | None) -> float:
    """How far an opening reaches from the axis, mm: to the farthest corner of its keyway."""
    if opening is None:
        return 0.0
    if not opening.has_keyway:
        return opening.bore / 2
    # A relief bulges beyond its corner by less than its own bite.
    return math.hypot(opening.floor, opening.width / 2) + opening.bite / 2


def reaches(bore: Array, width: float, relief: float) -> Any:
    """The same (...) of openings with one keyway, 0 for none."""
    key = key_of_width(width)
    if key is None:
        return np.asarray(bore / 2)
    return np.where(bore > 0, np.hypot(bore / 2 + key.hub_depth, width / 2) + relief / math.sqrt(2) / 2, 0.0)


def opening_area(bore: ArrayLike, width: float, relief: float) -> Array:
    """Area (...) of openings with one keyway, mm²; each size of bore with a keyway is drawn once."""
    bores = np.asarray(bore, dtype=float)
    if key_of_width(width) is None:
        return np.asarray(math.pi / 4 * bores**2)
    sizes, which = np.unique(bores, return_inverse=True)
    drawn = [_opening(size, width, relief) for size in sizes.tolist()]
    areas = np.array([0.0 if one is None else abs(one.loop().area) for one in drawn])
    return np.asarray(areas[which].reshape(bores.shape))


def unfit(bore: Array, width: float, relief: float) -> list[tuple[str, NDArray[np.bool_]]]:
    """Codes of errors of openings with one keyway, in the order of :func:`opening_findings`, and of which."""
    small = np.asarray((bore > 0) & (bore < LEAST_WIDTH) | (0 < width < LEAST_WIDTH))
    found = [("bore.size", small)]
    if width == 0:
        return found
    key = key_of_width(width)
    if key is None:
        return [*found, ("bore.keyway-width", np.ones_like(bore, dtype=bool))]
    mouth = np.sqrt(np.maximum(bore**2 - width**2, 0.0)) / 2
    most = math.sqrt(2) * (np.minimum(width / 2, bore / 2 + key.hub_depth - mouth) - SMALLEST_EDGE)
    return [
        *found,
        ("bore.keyway-width", np.asarray(bore <= width)),
        ("bore.keyway-relief", np.asarray(relief > np.maximum(0.0, most))),
    ]


def hub_radius(params: Sizes) -> float:
    """Radius about the wheel's axis that the slots must leave alone: opening or hub, mm."""
    return max(reach(wheel_opening(params)), params.hub_diameter / 2)


def driver_radius(bore: float, least_wall: float, fixing: float) -> float:
    """Radius about the crank's axis that opening (as far as it reaches), walls and dowels need, mm."""
    return float(around(bore, least_wall, fixing))


def around(bore: ArrayLike, least_wall: ArrayLike, fixing: ArrayLike) -> Any:
    """The same of many designs (...)."""
    bore, wall, fixing = (np.asarray(one, dtype=float) for one in (bore, least_wall, fixing))
    return bore + np.where(fixing > 0, 2 * wall + fixing, wall)


def opening_findings(params: Sizes) -> Iterator[Finding]:
    """What is wrong with bores and keyways by themselves."""
    for bore, width in (("bore", "keyway_width"), ("driver_bore", "driver_keyway_width")):
        yield from _one(params, bore, width)
    yield from too_small({"keyway_relief": params.keyway_relief, "fixing": params.fixing})


def _one(params: Sizes, bore_name: str, width_name: str) -> Iterator[Finding]:
    bore, width = float(getattr(params, bore_name)), float(getattr(params, width_name))
    small = list(too_small({bore_name: bore, width_name: width}))
    yield from small
    if small or width == 0:
        return
    key = key_of_width(width)
    if key is not None:
        opening = Opening(bore, key.width, key.hub_depth, params.keyway_relief)
        yield from keyway_findings(opening, bore_name, width_name)
        return
    fitting = key_for_bore(bore)
    yield Finding.error(
        "bore.keyway-width",
        width_name,
        f"no standard key is {width:g} mm wide",
        width,
        fitting.width if fitting else None,
        "mm",
        f"use one of {', '.join(f'{one.width:g}' for one in KEYS)}",
        proposed=({f"parameters.{width_name}": fitting.width},) if fitting else (),
    )
