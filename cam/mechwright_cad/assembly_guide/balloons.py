"""Numbers of items beside a picture, in two columns, each in the order of what it points at."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import shapely

from mechwright.geometry.segments import Point
from mechwright_cad.assembly_guide.view import Lines

RADIUS = 0.42
"""Of a ring, as a share of the distance of two rings in a column."""

APART = 3.0
"""Distance of two rings in a column, in heights of letters, at least."""


@dataclass(frozen=True)
class Balloon:
    """A ring with a number, and the place that its leader ends in."""

    number: int
    at: Point
    tip: Point


def balloons(
    lines: Lines,
    numbers: Mapping[int, int],
    letter: float,
    middles: Mapping[int, Point] = MappingProxyType({}),
) -> list[Balloon]:
    """One for each item; of one whose copies are all hidden the leader ends over the middle of one.

    Parameters
    ----------
    lines
        What is seen of each body, mm.
    numbers
        Body to the number of its item.
    letter
        Height of the numbers, mm.
    middles
        Body to its middle in the picture, mm.
    """
    whole = shapely.union_all(list(lines.values()))
    x0, _, x1, _ = whole.bounds
    apart = APART * letter
    tips: dict[int, Point] = {}
    for body, number in numbers.items():
        if number not in tips and body in lines and not lines[body].is_empty:
            tips[number] = _tip(lines[body])
    for body, number in numbers.items():
        if number not in tips and body in middles:
            tips[number] = middles[body]
    found = []
    ordered = sorted(tips, key=lambda number: (tips[number][0], number))
    half = len(ordered) // 2
    for those, x in ((ordered[:half], x0 - 2 * apart), (ordered[half:], x1 + 2 * apart)):
        column = sorted(those, key=lambda number: (-tips[number][1], number))
        wanted = [tips[number][1] for number in column]
        for number, y in zip(column, _spread(wanted, apart), strict=True):
            found.append(Balloon(number, (x, y), tips[number]))
    return found


def _tip(seen: shapely.Geometry) -> Point:
    """Where a leader ends: on the middle of the longest line."""
    longest = max(shapely.get_parts(seen), key=lambda one: (round(one.length, 3), one.bounds))
    at = longest.interpolate(0.5, normalized=True)
    return float(at.x), float(at.y)


def _spread(wanted: list[float], apart: float) -> list[float]:
    """Heights from the top down, at least so far apart and as near to the wanted ones as that leaves."""
    placed: list[float] = []
    for height in wanted:
        placed.append(min(height, placed[-1] - apart) if placed else height)
    if placed:
        excess = (sum(placed) - sum(wanted)) / len(placed)
        placed = [height - excess for height in placed]
    return placed
