"""Paths over ramped tabs: where they rise, run level and sink, so that the tabs stay whole."""

import math

import numpy as np
import shapely

from mechwright.geometry.segments import Point
from mechwright_cam.setup.holding import Tab, least_z
from mechwright_plane.path import DECIMALS, Path

HEIGHT = 0.002
"""How far a straight slope of the path may be off the tab's, mm: less than half of what the proof lets into
a tab."""
LIFT = 1.5 * HEIGHT
"""The path runs so much above the tab, mm, that with this and with rounding it never cuts it."""
SHORT = 0.005
"""Stretches below this length are left out, mm: on the steepest slope they rise by about LIFT."""


def lifted_height(tabs: tuple[Tab, ...], place: Point, radius: float) -> float:
    """Lowest height over the tabs at a place, z in mm; -inf beside them."""
    return _up(float(least_z(tabs, np.array([place]), radius)[0]) + LIFT)


def over_tabs(
    path: Path, start: float, end: float, tabs: tuple[Tab, ...], radius: float
) -> list[tuple[Path, float]]:
    """Divide a path of the cutter's centre that leads over ramped tabs into stretches of even slope.

    Beside the tabs it goes evenly from ``start`` to ``end``, z in mm. Each stretch comes with the height of
    its end; there is none if the path keeps off the tabs.
    """
    steepest = max(tab.slope for tab in tabs)
    points = path.points(HEIGHT / 2 / steepest)
    way = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    way *= path.length / way[-1] if way[-1] > 0 else 1.0
    even = start + (end - start) * way / max(path.length, HEIGHT)
    least = least_z(tabs, points, radius) + LIFT
    if (least <= even).all():
        return []
    profile = shapely.LineString(np.column_stack((way, np.maximum(even, least))))
    corners = shapely.get_coordinates(shapely.simplify(profile, HEIGHT)).tolist()[1:]
    stretches: list[tuple[Path, float]] = []
    rest, done = path, 0.0
    for number, (at, height) in enumerate(corners, start=1):
        last = number == len(corners)
        if at - done < SHORT and not last:
            continue
        part, rest = (rest, rest) if last else rest.split(at - done)
        if part.cuts:
            stretches.append((part, _up(height)))
            done += part.length
    return stretches


def _up(height: float) -> float:
    """A height as programs print it, rounded upwards."""
    if math.isinf(height):
        return height
    last = 10.0**-DECIMALS
    return math.ceil(height / last - 1e-6) * last
