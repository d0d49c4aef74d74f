"""Shaft openings of wheel and driver."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechwright.contracts.design_table import number
from mechwright.geometry.keyway import Opening, key_of_width
from mechwright.mechanics.linkage.areas import circle_area
from mechwright_geneva.parameters import Sizes


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


def reach(bore: ArrayLike, width: float, relief: float) -> Any:
    """How far openings (...) with one keyway reach from the axis, mm: to the farthest corner; 0 for none."""
    bores, key = np.asarray(bore, dtype=float), key_of_width(width)
    if key is None:
        return bores / 2
    # A relief bulges beyond its corner by less than its own bite.
    return np.where(
        bores > 0, np.hypot(bores / 2 + key.hub_depth, width / 2) + relief / math.sqrt(2) / 2, 0.0
    )


def opening_area(bore: ArrayLike, width: float, relief: float) -> Any:
    """Area (...) of openings with one keyway, mm²; each size of bore with a keyway is drawn once."""
    if key_of_width(width) is None:
        return circle_area(np.asarray(bore))

    def area(size: float) -> float:
        opening = _opening(size, width, relief)
        return 0.0 if opening is None else opening.loop().area

    return np.abs(by_size(area, bore))


def by_size(function: Callable[[float], float], sizes: ArrayLike) -> Any:
    """What a function gives of sizes (...); it is called once for each size."""
    different, which = np.unique(sizes, return_inverse=True)
    return number(np.array([function(size) for size in different.tolist()])[which].reshape(np.shape(sizes)))


def needed_radius(opening: ArrayLike, least_wall: ArrayLike, fixing: ArrayLike) -> Any:
    """Radius (...) that an opening, mm as far as it reaches, walls and dowels need."""
    reached, wall, dowel = (np.asarray(one, dtype=float) for one in (opening, least_wall, fixing))
    return reached + np.where(dowel > 0, 2 * wall + dowel, wall)
