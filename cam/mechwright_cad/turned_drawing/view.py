"""Views of a turned part: its side, cut open above the axis where it has a bore, and cuts through seats."""

import math

from mechwright.contracts.turned import Flats, KeySeat, Turned
from mechwright.geometry.segments import Point
from mechwright_cad.sheet.circles import arc
from mechwright_cad.sheet.sheet import Sheet

OVERHANG = 3.0
"""How far a centre line goes beyond its view, mm."""

HATCH = 2.5
"""Between lines of a cut face, mm."""


def side(sheet: Sheet, turned: Turned, left: float, axis: float) -> None:
    """The part with its axis level, its foot at x = ``left``."""
    s = sheet.scale
    corners = [(left + s * z, s * r) for r, z in turned.profile]
    inner, end = s * turned.bore / 2, left + s * turned.length
    for sign in (1, -1):
        points = [(x, axis + sign * y) for x, y in corners]
        sheet.lines([(left, axis), *points, (end, axis)])
        if sign < 0 or inner == 0:
            for x, y in _edges(corners):
                sheet.lines([(x, axis), (x, axis + sign * y)])
    if inner > 0:
        sheet.lines([(left, axis + inner), (end, axis + inner)])
        _hatch(sheet, corners, inner, axis)
    for thread in turned.threads:
        deep = s * (thread.depth if thread.end == "lower" else -thread.depth)
        x0 = left if thread.end == "lower" else end
        for wide in (thread.core, thread.diameter):  # ISO 6410: core and nominal diameter, hidden
            half = s * wide / 2
            sheet.lines([(x0, axis - half), (x0 + deep, axis - half)], "HATCH")
            sheet.lines([(x0, axis + half), (x0 + deep, axis + half)], "HATCH")
            sheet.lines([(x0 + deep, axis - half), (x0 + deep, axis + half)], "HATCH")
    for seat in turned.seats:
        sheet.lines([(left + s * z, axis + s * y) for z, y in _mouth(seat, turned.length)])
    for flat in turned.flats:
        _flat(sheet, turned, flat, (left, axis))
    sheet.lines([(left - OVERHANG, axis), (end + OVERHANG, axis)], "CENTRE")


def _flat(sheet: Sheet, turned: Turned, flat: Flats, at: Point) -> None:
    """One of two flats, seen square on, with the thin diagonals that mark a flat face (ISO 128)."""
    s, (left, axis) = sheet.scale, at
    steps = [step for low, step in zip(turned.starts, turned.steps, strict=True) if low <= flat.at]
    half = s * math.sqrt((steps[-1].diameter / 2) ** 2 - (flat.across / 2) ** 2)
    x0, x1 = left + s * flat.at, left + s * (flat.at + flat.length)
    low, high = axis - half, axis + half
    sheet.lines([(x0, low), (x1, low), (x1, high), (x0, high), (x0, low)])
    for y0, y1 in ((low, high), (high, low)):
        sheet.lines([(x0, y0), (x1, y1)], "HATCH")


def _mouth(seat: KeySeat, part: float) -> list[Point]:
    """The closed line (z, y) of a key seat seen from its open side, half circles at its closed ends."""
    half, (lower, upper) = seat.width / 2, seat.round_ends(part)
    low, high = seat.at, seat.at + seat.length
    line = (
        list(arc((high - half, 0.0), half, -math.pi / 2, math.pi / 2))
        if upper
        else [(high, -half), (high, half)]
    )
    line += (
        list(arc((low + half, 0.0), half, math.pi / 2, 3 * math.pi / 2))
        if lower
        else [(low, half), (low, -half)]
    )
    return [*line, line[0]]


def _edges(corners: list[Point]) -> list[Point]:
    """Where the outside has an edge between its ends, and how high it is seen there."""
    highest: dict[float, float] = {}
    for x, y in corners:
        highest[x] = max(y, highest.get(x, 0.0))
    ends = (corners[0][0], corners[-1][0])
    return [(x, y) for x, y in highest.items() if x not in ends]


def _hatch(sheet: Sheet, corners: list[Point], inner: float, axis: float) -> None:
    """Lines at 45° over the cut above the axis, clipped to its profile."""
    import shapely

    low, high = corners[0][0], corners[-1][0]
    face = shapely.Polygon([(low, inner), *corners, (high, inner)])
    top = max(y for _, y in corners)
    step, start = HATCH * math.sqrt(2), low - top
    lines = [
        shapely.LineString([(x, 0.0), (x + top, top)])
        for x in (start + step * k for k in range(math.ceil((high - start) / step)))
    ]
    for line in lines:
        for piece in shapely.get_parts(shapely.intersection(line, face)):
            if piece.geom_type == "LineString" and piece.length > 0:
                (x0, y0), (x1, y1) = shapely.get_coordinates(piece).tolist()
                sheet.lines([(x0, axis + y0), (x1, axis + y1)], "HATCH")


def across(sheet: Sheet, seat: KeySeat, diameter: float, centre: Point) -> tuple[Point, Point, Point, Point]:
    """The cut through a seat; gives the ends of its mouth, the middle of its floor, and the point opposite.

    The seat is on top: the floor's distance from the axis is up.
    """
    s, (cx, cy) = sheet.scale, centre
    r, half, floor = s * diameter / 2, s * seat.width / 2, s * seat.floor
    mouth = math.sqrt(max(r * r - half * half, floor * floor))
    begin = math.atan2(mouth, half)
    rim = list(arc(centre, r, math.pi - begin, 2 * math.pi + begin))
    sheet.lines([*rim, (cx + half, cy + floor), (cx - half, cy + floor), rim[0]])
    _cut_face(sheet, [*rim, (cx + half, cy + floor), (cx - half, cy + floor)])
    for a, b in (
        ((cx - r - OVERHANG, cy), (cx + r + OVERHANG, cy)),
        ((cx, cy - r - OVERHANG), (cx, cy + r + OVERHANG)),
    ):
        sheet.lines([a, b], "CENTRE")
    return (cx - half, cy + mouth), (cx + half, cy + mouth), (cx + half, cy + floor), (cx, cy - r)


def _cut_face(sheet: Sheet, ring: list[Point]) -> None:
    import shapely

    face = shapely.Polygon(ring)
    x0, y0, x1, y1 = face.bounds
    step, start = HATCH * math.sqrt(2), x0 - (y1 - y0)
    for k in range(math.ceil((x1 - start) / step)):
        x = start + step * k
        line = shapely.LineString([(x, y0), (x + y1 - y0, y1)])
        for piece in shapely.get_parts(shapely.intersection(line, face)):
            if piece.geom_type == "LineString" and piece.length > 0:
                sheet.lines(tuple(map(tuple, shapely.get_coordinates(piece).tolist())), "HATCH")
