"""The exploded view as a sheet: lines, balloons, and the list of items beside it (ISO 7573)."""

import math
from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Part
from mechwright.geometry.segments import Point
from mechwright_cad.assembly_guide.balloons import APART, RADIUS, balloons
from mechwright_cad.assembly_guide.pictures import Pictures
from mechwright_cad.sheet.frame import EDGE, LINE, MARGIN, SHEETS, TITLE, frame
from mechwright_cad.sheet.scales import LEAST, SCALES
from mechwright_cad.sheet.sheet import HEIGHT, Fill, Sheet, Stroke, Text
from mechwright_cad.sheet.title import TitleBlock

ROW = 6.0
"""Height of a line of the list, mm."""

COLUMNS = (10.0, 10.0, 45.0, 60.0)
"""Widths of item, quantity, name, material or designation, mm."""
CHARACTER = 0.7
"""Width of a character over its height; long words are written smaller, so that they stay in their column."""

_CORNERS = 24
"""Of a ring."""


def assembly_sheet(pictures: Pictures, items: Mapping[int, Sequence[Part]], title: TitleBlock) -> Sheet:
    """The smallest sheet that holds the view, not smaller than half its size; A1 if none does."""
    lines = pictures.view.lines(pictures.shifts)
    x0, y0, x1, y1 = shapely.union_all(list(lines.values())).bounds
    column = 4 * APART * HEIGHT
    listed = {number: those for number, those in items.items() if any(part.instances for part in those)}
    torques = pictures.plan.torques
    notes = [f"{name}: {torques[name]}" for name in sorted(torques)]
    for paper in SHEETS:
        lists = math.ceil(len(listed) / _most(paper[1]))
        wide = paper[0] - 2 * (MARGIN + EDGE) - lists * sum(COLUMNS) - column
        high = paper[1] - 2 * (MARGIN + EDGE) - LINE * len(notes)
        fitting = [one for one in SCALES if one * (x1 - x0) <= wide and one * (y1 - y0) <= high]
        if lists * sum(COLUMNS) <= paper[0] / 2 and fitting and (fitting[0] >= LEAST or paper is SHEETS[-1]):
            break
    scale = fitting[0] if fitting else SCALES[-1]
    sheet = Sheet(*paper, scale)
    middle = np.array((MARGIN + EDGE + (wide + column) / 2, MARGIN + EDGE + high / 2))
    at = middle - scale * np.array(((x0 + x1) / 2, (y0 + y1) / 2))

    def on(points: Array) -> list[tuple[float, float]]:
        return [(float(x), float(y)) for x, y in scale * np.asarray(points) + at]

    for some in lines.values():
        for one in shapely.get_parts(some):
            sheet.add(Stroke(tuple(on(shapely.get_coordinates(one)))))
    for trace in pictures.traces():
        sheet.add(Stroke(tuple(on(trace)), "CENTRE"))
    numbers = {k: pictures.numbers[k] for k in pictures.plan.sequence}
    ring = RADIUS * APART * HEIGHT
    turn = np.linspace(0.0, 2 * np.pi, _CORNERS + 1)
    circle = np.column_stack((np.cos(turn), np.sin(turn)))
    for balloon in balloons(lines, numbers, HEIGHT / scale, pictures.middles):
        (place,), (tip,) = on(np.array([balloon.at])), on(np.array([balloon.tip]))
        away = np.subtract(tip, place)
        start = np.array(place) + ring * away / np.linalg.norm(away)
        sheet.add(Stroke(((float(start[0]), float(start[1])), tip), "DIM"))
        sheet.add(Fill(tuple((float(x), float(y)) for x, y in np.array(tip) + 0.6 * circle[:-1:6])))
        sheet.add(Stroke(tuple((float(x), float(y)) for x, y in np.array(place) + ring * circle), "DIM"))
        sheet.add(Text((place[0], place[1] - HEIGHT / 2), str(balloon.number), align="middle"))
    _list(sheet, listed)
    parts = [part for those in listed.values() for part in those]
    frame(sheet, title.of_assembly(parts, len(listed), scale), ())
    # Above the view, which may reach down beside the title block.
    for k, line in enumerate(notes, start=1):
        sheet.add(Text((MARGIN + EDGE, sheet.height - MARGIN - LINE * k), line, height=2.5))
    return sheet


def _most(high: float) -> int:
    """Items that a list on a sheet of this height holds."""
    return int((high - 2 * MARGIN - TITLE[1]) // ROW) - 1


def _list(sheet: Sheet, items: Mapping[int, Sequence[Part]]) -> None:
    """The list of items, from the title block upwards; what has no room there stands to the left of it."""
    ordered, most = sorted(items.items()), _most(sheet.height)
    for count, start in enumerate(range(0, len(ordered), most), start=1):
        x0 = sheet.width - MARGIN - count * sum(COLUMNS)
        _listed(sheet, (x0, MARGIN + TITLE[1]), ordered[start : start + most])


def _listed(sheet: Sheet, at: Point, items: Sequence[tuple[int, Sequence[Part]]]) -> None:
    (x0, low), rows = at, [("Item", "Qty", "Name", "Material, or order as")]
    for number, those in items:
        first = those[0]
        rows.append(
            (
                str(number),
                str(sum(len(part.instances) for part in those)),
                ", ".join(part.name for part in those),
                first.bought.designation if first.bought else first.material,
            )
        )
    for k, row in enumerate(rows):
        y, x = low + ROW * k, x0
        for width, words in zip(COLUMNS, row, strict=True):
            height = min(2.5, (width - 3.0) / max(1, len(words)) / CHARACTER)
            sheet.add(Text((x + 1.5, y + 1.8), words, height=height))
            x += width
        sheet.lines([(x0, y + ROW), (x, y + ROW)], "DIM")
    sheet.lines([(x0, low), (x0, low + ROW * len(rows))], "DIM")
