"""Where labels of a view stand: beside what they name, on no line and on no other label."""

import math
from collections.abc import Sequence

import shapely

from mechwright.geometry.segments import Point
from mechwright_cad.sheet.geometric import HIGH, boxed
from mechwright_cad.sheet.sheet import Sheet, Stroke, Text, width_of
from mechwright_cad.sheet.tables import SMALL

_AIR = 0.6
"""Round a label, mm."""

_WAYS = [math.radians(angle) for angle in (45, 135, 315, 225, 0, 180, 90, 270)]
_STEPS = (0.8, 2.5, 5.0, 8.0, 12.0, 17.0, 24.0)
"""How far from the edge of what it names a label may stand, mm; from the second on with a leader."""


_FLAT = 0.1
"""A way whose cosine is less goes straight up or down."""


class Labels:
    """Labels of a view, one after the other. One without room is left out: the table has its place."""

    def __init__(self, sheet: Sheet, lines: Sequence[Sequence[Point]], room: shapely.Polygon) -> None:
        self.sheet = sheet
        self.room = room
        self._lines = shapely.STRtree([shapely.LineString(line) for line in lines if len(line) > 1])
        self._taken: list[shapely.Polygon] = []

    def put(self, text: str, at: Point, radius: float, outwards: Point | None = None) -> None:
        """A label beside a circle, mm of the sheet; ``outwards`` is the way that is tried first."""
        ways = _WAYS
        if outwards is not None and outwards != (0.0, 0.0):
            first = math.atan2(outwards[1], outwards[0])
            ways = sorted(_WAYS, key=lambda way: abs(math.remainder(way - first, math.tau)))
        place = self._place((width_of(text, SMALL), SMALL), at, radius, ways)
        if place is None:
            return
        step, way, box = place
        self.sheet.add(Text(box.bounds[:2], text, "DIM", height=SMALL))
        self._leader(at, radius, step, way, box)

    def put_square(self, letter: str, at: Point, radius: float) -> None:
        """A letter in a square beside a circle: the sign of a datum."""
        place = self._place((HIGH, HIGH), at, radius, _WAYS)
        if place is None:
            return
        step, way, box = place
        x0, y0, x1, y1 = box.bounds
        boxed(self.sheet, letter, ((x0 + x1) / 2, (y0 + y1) / 2))
        self._leader(at, radius, step, way, box)

    def _place(
        self, size: tuple[float, float], at: Point, radius: float, ways: Sequence[float]
    ) -> tuple[float, float, shapely.Polygon] | None:
        boxes = [(step, way, _box(size, at, radius + step, way)) for step in _STEPS for way in ways]
        free = next((one for one in boxes if self._is_free(one[2], lines=True)), None)
        if free is None:
            free = next((one for one in boxes if self._is_free(one[2], lines=False)), None)
        if free is not None:
            self._taken.append(free[2].buffer(_AIR))
        return free

    def _leader(self, at: Point, radius: float, step: float, way: float, box: shapely.Polygon) -> None:
        if step > _STEPS[0]:
            x0, y0, x1, y1 = box.bounds
            start = at[0] + radius * math.cos(way), at[1] + radius * math.sin(way)
            end = min(max(start[0], x0), x1), min(max(start[1], y0), y1)
            self.sheet.add(Stroke((start, end), "DIM"))

    def _is_free(self, box: shapely.Polygon, *, lines: bool) -> bool:
        if not self.room.contains(box) or any(box.intersects(other) for other in self._taken):
            return False
        return not (lines and self._lines.query(box.buffer(_AIR / 2), predicate="intersects").size)


def _box(size: tuple[float, float], at: Point, away: float, way: float) -> shapely.Polygon:
    """The box of a label of a size whose nearest side or corner is so far away, mm."""
    (wide, high), (x, y) = size, at
    c, s = math.cos(way), math.sin(way)
    x += away * c + (0.0 if c > _FLAT else -wide if c < -_FLAT else -wide / 2)
    y += away * s + (0.0 if s > _FLAT else -high if s < -_FLAT else -high / 2)
    return shapely.box(x, y, x + wide, y + high)
