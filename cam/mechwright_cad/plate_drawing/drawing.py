"""The whole drawing of a plate: views, labels, tables of holes and corners, sizes to measure, title block."""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import shapely

from mechwright.contracts.datum import datum_bore, length_zone
from mechwright.contracts.materials import material
from mechwright.contracts.part import Part
from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.errors import GeometryError
from mechwright.geometry.segments import Point
from mechwright_cad.plate_drawing.contours import (
    Contour,
    circle_of,
    contours,
    corners,
    is_table,
    shifted,
)
from mechwright_cad.plate_drawing.holes import Hole, Kind, kinds
from mechwright_cad.plate_drawing.placing import Labels
from mechwright_cad.plate_drawing.view import bounds, draw, edge, plan
from mechwright_cad.sheet import tables
from mechwright_cad.sheet.dimensions import FREE, ROW, length, upright
from mechwright_cad.sheet.frame import EDGE, MARGIN, SHEETS, TITLE, frame
from mechwright_cad.sheet.geometric import HIGH, Symbol, datum, tolerance_frame
from mechwright_cad.sheet.scales import LEAST, SCALES
from mechwright_cad.sheet.sheet import Sheet, width_of
from mechwright_cad.sheet.tables import STEP, Row
from mechwright_cad.sheet.title import TitleBlock, projection_sign
from mechwright_cad.sheet.words import FAIR, GENERAL, number

MOST_HOLES = 100
"""Holes whose places a table holds: more would not go on a sheet of A1 beside the plan."""

MOST_MEASURES = 40
"""Rows of sizes to measure, as on a setup sheet."""

_BETWEEN = 6.0
"""Between views, and between columns of tables, mm."""


@dataclass(frozen=True)
class PlateDrawing:
    """What the drawing of a plate tells, before it has a sheet.

    Parameters
    ----------
    part
        A plate.
    tolerances
        What the design says of them: zones of fitted holes follow.
    """

    part: Part
    tolerances: Tolerances

    def __post_init__(self) -> None:
        if self.part.kind != "plate":
            raise GeometryError(f"part {self.part.name} is no plate: it has no drawing of this kind")

    @property
    def datum(self) -> Point:
        """From where holes and corners are measured, mm.

        It is that hole of the part, else the lower left corner of what it takes.
        """
        found = datum_bore(self.part)
        if found is not None:
            return found.centre
        x0, y0, _, _ = bounds(self.part)
        return x0, y0

    def zone(self, hole: Hole) -> float | None:
        """Diameter of the zone in which the axis of a fitted hole lies, mm; None where none is known."""
        found = length_zone(self.part, math.dist(hole.centre, self.datum), self.tolerances)
        return None if found is None else round(found[1] - found[0], 3)


def hole_rows(kinds: tuple[Kind, ...], origin: Point, part: str) -> list[Row]:
    """The table of holes; of very many it has the kinds alone, and the file that has their places."""
    rows = [Row(("Hole", "X", "Y", "is"), head=True)]
    many = sum(len(kind.holes) for kind in kinds) > MOST_HOLES
    for kind in kinds:
        several = len(kind.holes) > 1 or many
        if several:
            rows.append(Row((f"{kind.letter}  {len(kind.holes)} x", "", "", kind.words)))
        for name, hole in () if many else named(kind):
            x, y = (number(value) for value in shifted(hole.centre, origin))
            rows.append(Row((name, x, y, "" if several else kind.words)))
    if many:
        rows.append(Row((f"{part}.dxf has their places", "", "", "")))
    return rows


def named(kind: Kind) -> Iterator[tuple[str, Hole]]:
    """The holes of a kind with their names: A, or A1, A2 ... where there are more."""
    if len(kind.holes) == 1:
        yield kind.letter, kind.holes[0]
        return
    for count, hole in enumerate(kind.holes, start=1):
        yield f"{kind.letter}{count}", hole


def corner_rows(found: tuple[Contour, ...], origin: Point, name: str, tolerances: Tolerances) -> list[Row]:
    """The table of corners; where curves make a contour, the file that has it and its tolerance."""
    if not is_table(found):
        settings, alike = tolerances.settings, Counter(one.words for one in found)
        return [
            Row(("Contours", "", "", ""), head=True),
            *(Row((f"{many} x {words}", "", "", "")) for words, many in alike.items() if len(found) > 1),
            Row((f"{name}.dxf has the nominal curves", "", "", "")),
            Row(
                (
                    _walls(settings.gouge, settings.leftover),
                    "",
                    "",
                    "",
                )
            ),
        ]
    rows = [Row(("Corner", "X", "Y", "on to the next one"), head=True)]
    for one in found:
        whole = circle_of(one.loop)
        if whole is not None:
            x, y = (number(value) for value in shifted(whole.centre, origin))
            rows.append(Row((one.name, x, y, f"{one.words}: ⌀{number(2 * whole.radius)}")))
            continue
        rows.append(Row((one.name, "", "", one.words)))
        for corner in corners(one):
            x, y = (number(value) for value in shifted(corner.at, origin))
            rows.append(Row((corner.name, x, y, corner.words(origin))))
    return rows


def _walls(gouge: float, leftover: float) -> str:
    return f"walls {number(-gouge)} to +{number(leftover)} off them, {FAIR}"


def data_rows(part: Part) -> list[Row]:
    """The table of data, such as those of teeth."""
    return [Row(("Data", ""), head=True), *(Row(pair) for pair in part.data)] if part.data else []


def measure_rows(part: Part) -> list[Row]:
    """Sizes to measure that no view shows, such as those over pins."""
    if not part.measures:
        return []
    rows = [Row(("To be measured", "size", "least", "greatest"), head=True)]
    for one in part.measures[:MOST_MEASURES]:
        sizes = ("–" if v is None else number(v) for v in (one.nominal, one.least, one.greatest))
        rows.append(Row((one.what, *sizes)))
    return rows


def plate_sheet(told: PlateDrawing, title: TitleBlock) -> Sheet:
    """The drawing of a plate on the smallest sheet that holds it."""
    part, origin = told.part, told.datum
    found, shapes = kinds(part, origin), contours(part)
    blocks = [
        rows
        for rows in (
            hole_rows(found, origin, part.name) if found else [],
            corner_rows(shapes, origin, part.name, told.tolerances),
            data_rows(part),
            measure_rows(part),
        )
        if rows
    ]
    frames = [*_frames(told, found), *_profile(told, shapes)]
    paper, scale, columns = _fitting(part, blocks, len(frames))
    sheet = Sheet(*paper, scale)
    top = paper[1] - MARGIN - EDGE
    _views(sheet, told, found, shapes, (MARGIN + EDGE + ROW, top), title.third_angle)
    x = MARGIN + EDGE + _across(part, scale) + _BETWEEN
    for column in columns:
        y = top
        for rows in column:
            tables.draw(sheet, rows, (x, y))
            y -= STEP * (len(rows) + 1)
        if column is columns[-1]:
            for name, symbol, zone, datums in frames:
                y -= HIGH + 1.0
                tables.draw(sheet, [Row((name,))], (x, y + (HIGH + STEP) / 2))
                tolerance_frame(sheet, (x + 18.0, y), symbol, zone, datums)
        x += max(sum(tables.widths(rows)) for rows in column) + _BETWEEN
    stock = f"{material(part.material).grades.plate}, {number(part.thickness)} mm"
    frame(sheet, title.of_part(part, stock, scale), [*GENERAL, _measured(told)])
    projection_sign(sheet, third_angle=title.third_angle)
    return sheet


def _measured(told: PlateDrawing) -> str:
    if _datum_hole(told) is None:
        return "X and Y from the lower left corner"
    return "X and Y from datum B, along the part's own axes"


def _datum_hole(told: PlateDrawing) -> Hole | None:
    for kind in kinds(told.part, told.datum):
        for hole in kind.holes:
            if math.dist(hole.centre, told.datum) < 1e-6:
                return hole
    return None


Frame = tuple[str, Symbol, str, str]
"""What a frame is for, its symbol, its zone in words, and its datums."""


def _profile(told: PlateDrawing, shapes: tuple[Contour, ...]) -> list[Frame]:
    """The frame of walls that curves make: what their mill may leave and what it may cut away.

    The zone lies unequally about the nominal curve, its middle so far out of the material (ISO 1101, UZ).
    """
    if is_table(shapes):
        return []
    settings = told.tolerances.settings
    out = (settings.leftover - settings.gouge) / 2
    zone = f"{number(settings.leftover + settings.gouge)} UZ{'+' if out >= 0 else ''}{round(out, 4):g}"
    return [("Curves", "profile", zone, "A" if _datum_hole(told) is None else "AB")]


def _frames(told: PlateDrawing, found: tuple[Kind, ...]) -> list[Frame]:
    """Name, symbol, zone and datums of each frame: one for all fitted holes that have the same."""
    base = _datum_hole(told)
    rows: dict[tuple[Symbol, float, str], list[str]] = {}
    for kind in found:
        for name, hole in named(kind) if kind.holes[0].fitted else ():
            zone = told.zone(hole)
            if zone is None:
                continue
            symbol: Symbol = "position"
            datums = "AB" if base is not None else "A"
            if base is not None and hole.centre == base.centre:
                symbol, datums = "perpendicularity", "A"
            rows.setdefault((symbol, zone, datums), []).append(name)
    return [
        (_list(names), symbol, f"⌀{number(zone)}", datums) for (symbol, zone, datums), names in rows.items()
    ]


def _list(names: list[str]) -> str:
    """Names of holes in few letters.

    >>> _list(["A1", "A2", "A3", "B"])
    'A1-A3, B'
    """
    found: list[list[str]] = []
    for name in names:
        letter, count = name.rstrip("0123456789"), name.lstrip("ABCDEFGHIJKLMNOPQRSTUVWXYZ")
        last = found[-1][-1] if found else ""
        follows = last.startswith(letter) and last[len(letter) :].isdigit() and count.isdigit()
        if follows and int(count) == int(last[len(letter) :]) + 1:
            found[-1] = [found[-1][0], name]
        else:
            found.append([name])
    return ", ".join("-".join(one) for one in found)


def _across(part: Part, scale: float) -> float:
    """Width of the views with their dimensions, mm."""
    x0, y0, x1, y1 = bounds(part)
    return ROW + scale * (x1 - x0) + 3 * ROW + width_of(number(y1 - y0)) + scale * part.thickness + 4 * ROW


def _fitting(
    part: Part, blocks: list[list[Row]], frames: int
) -> tuple[tuple[float, float], float, list[list[list[Row]]]]:
    """The smallest sheet, the largest scale on it, and the columns of tables."""
    _, y0, _, y1 = bounds(part)
    for paper in SHEETS:
        high = paper[1] - 2 * MARGIN - 2 * EDGE - TITLE[1]
        for scale in SCALES:
            columns = _columns(blocks, int(high // STEP), math.ceil(frames * (HIGH + 1) / STEP))
            wide = sum(max(sum(tables.widths(rows)) for rows in one) + _BETWEEN for one in columns)
            if scale < LEAST and paper is not SHEETS[-1]:
                continue
            fits = _across(part, scale) + _BETWEEN + wide <= paper[0] - 2 * (MARGIN + EDGE)
            if fits and scale * (y1 - y0) + FREE + 2 * ROW <= high:
                return paper, scale, columns
    return SHEETS[-1], SCALES[-1], columns


def _columns(blocks: list[list[Row]], most: int, frames: int) -> list[list[list[Row]]]:
    """Tables one under the other as far as a column goes."""
    columns: list[list[list[Row]]] = [[]]
    used = 0
    for rows in blocks:
        for lot in tables.split(rows, most):
            if used and used + len(lot) + 1 > most:
                columns.append([])
                used = 0
            columns[-1].append(lot)
            used += len(lot) + 1
    if frames and used + frames > most:
        columns.append([[Row(("Geometrical tolerances",), head=True)]])
    return columns


def _views(
    sheet: Sheet,
    told: PlateDrawing,
    found: tuple[Kind, ...],
    shapes: tuple[Contour, ...],
    corner: Point,
    third_angle: bool,
) -> None:
    part, s = told.part, sheet.scale
    x0, y0, x1, y1 = bounds(part)
    left, top = corner

    def to(point: Point) -> Point:
        return left + s * (point[0] - x0), top + s * (point[1] - y1)

    lines = [(layer, tuple(map(to, points))) for layer, points in plan(part, s)]
    draw(sheet, iter(lines), lambda point: point)
    low = to((x0, y0))[1]
    length(sheet, to((x0, y0)), to((x1, y0)), low - FREE, number(x1 - x0))
    right = to((x1, y0))[0]
    upright(sheet, to((x1, y0)), to((x1, y1)), right + FREE, number(y1 - y0))
    beside = right + FREE + 3 * ROW + width_of(number(y1 - y0))

    def across(point: Point) -> Point:
        return beside + s * point[0], top + s * (point[1] - y1)

    draw(sheet, edge(part, third_angle=third_angle), across)
    length(sheet, across((0.0, y0)), across((part.thickness, y0)), low - FREE, number(part.thickness))
    face = part.thickness if third_angle else 0.0
    datum(sheet, "A", across((face, y1 - 0.25 * (y1 - y0))), (1.0 if third_angle else -1.0, 0.0))
    room = shapely.box(left - ROW, low - FREE + 3.0, right + FREE - 1.0, top + EDGE - 1.0)
    labels = Labels(sheet, [points for _, points in lines], room)
    base = _datum_hole(told)
    for kind in found if sum(len(kind.holes) for kind in found) <= MOST_HOLES else ():
        for name, hole in named(kind):
            middle = to(hole.centre)
            if base is not None and hole.centre == base.centre:
                labels.put_square("B", middle, s * hole.radius)
            labels.put(name, middle, s * hole.radius)
    if is_table(shapes):
        middle = to(((x0 + x1) / 2, (y0 + y1) / 2))
        for one in shapes:
            for point in corners(one):
                x, y = to(point.at)
                labels.put(point.name, (x, y), 0.0, (x - middle[0], y - middle[1]))
