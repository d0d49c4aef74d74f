"""A drawing that shows what layers mean: what a design without a drawing is, so that a new one builds."""

from collections.abc import Iterator

WIDE, HIGH, ROUND = 90.0, 60.0, 6.0
"""Size of the plate and radius of its corners, mm."""
QUARTER = 0.41421356237309503
"""Bulge of a quarter of a circle."""
Row = tuple[int, object]


def sample() -> bytes:
    """The drawing as a small DXF file.

    >>> sample().decode().split()[-1]
    'EOF'
    """
    rows: list[Row] = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015")]
    rows += [(9, "$INSUNITS"), (70, 4), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    rows += _entities()
    rows += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:>3}\n{value}\n" for code, value in rows).encode()


def _entities() -> Iterator[Row]:
    r, w, h, q = ROUND, WIDE, HIGH, QUARTER
    plate = [
        (r, 0, 0),
        (w - r, 0, q),
        (w, r, 0),
        (w, h - r, q),
        (w - r, h, 0),
        (r, h, q),
        (0, h - r, 0),
        (0, r, q),
    ]
    yield from _polyline("OUTLINE", plate)
    yield from _polyline("POCKET_3", _slot(30, 60, 30, 12))
    yield from _circle("THROUGH", 45, 30, 8)
    for x in (10, w - 10):
        yield from _circle("BORE_H7", x, 10, 3)
        yield from _circle("M5", x, h - 10, 2.5)
    yield from _polyline("THROUGH", _slot(20, 70, 8, 3))
    for stroke in (
        ((40, 48), (40, 54), (43, 51), (46, 54), (46, 48)),
        ((49, 54), (50.5, 48), (52, 52), (53.5, 48), (55, 54)),
    ):
        yield from _polyline("ENGRAVE_0.2", [(x, y, 0) for x, y in stroke], closed=False)


def _slot(x0: float, x1: float, y: float, radius: float) -> list[tuple[float, float, float]]:
    """Corners and bulges of a slot between two centres."""
    return [(x0, y - radius, 0), (x1, y - radius, 1), (x1, y + radius, 0), (x0, y + radius, 1)]


def _polyline(layer: str, corners: list[tuple[float, float, float]], *, closed: bool = True) -> Iterator[Row]:
    yield from [(0, "LWPOLYLINE"), (100, "AcDbEntity"), (8, layer), (100, "AcDbPolyline")]
    yield from [(90, len(corners)), (70, int(closed))]
    for x, y, bulge in corners:
        yield from [(10, x), (20, y), (42, bulge)]


def _circle(layer: str, x: float, y: float, radius: float) -> Iterator[Row]:
    yield from [(0, "CIRCLE"), (100, "AcDbEntity"), (8, layer), (100, "AcDbCircle")]
    yield from [(10, x), (20, y), (40, radius)]
