"""Dimensions of a view: lengths from the base line below it, labels above it.

Neither can run into another: each length has a row of its own, longer ones further down; the line of a label
goes up to its text, which stands to the right of it, and labels further right stand lower.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.geometry.segments import Point
from mechwright_cad.sheet.sheet import ARROW, HEIGHT, Dimension, Sheet, Stroke, Text, arrow, width_of

ROW = 8.0
"""From one row of lengths to the next, mm."""

LIFT = 6.0
"""From one label to the next, mm."""

FREE = 10.0
"""Between the view and the first row, and the first label, mm."""

GAP, OVER = 1.0, 2.0
"""From the outline to an extension line, and how far that goes beyond the dimension line, mm."""

INSIDE = 3 * ARROW[0]
"""From this width on arrows point outwards from between the extension lines, mm."""


@dataclass(frozen=True)
class Label:
    """What is said of the diameter ``height`` high at x, in mm of the sheet."""

    x: float
    height: float
    text: str


def label(sheet: Sheet, of: Label, axis: float, row: float) -> None:
    """A diameter: a line across the step, on up to its text at the height ``row``."""
    low, high = axis - of.height / 2, axis + of.height / 2
    first, second = (of.x, low), (of.x, high)
    text = Text((of.x + GAP, row), of.text, "DIM")
    end = of.x + GAP + width_of(of.text)
    strokes = [Stroke((first, (of.x, row - GAP), (end, row - GAP)), "DIM")]
    if of.height > INSIDE:
        fills = (arrow(first, second), arrow(second, first))
    else:
        tail = (of.x, low - 2 * ARROW[0])
        strokes.append(Stroke((first, tail), "DIM"))
        fills = (arrow(first, tail), arrow(second, (of.x, row)))
    sheet.add(Dimension(first, second, first, "y", text, tuple(strokes), fills))


def length(sheet: Sheet, first: Point, second: Point, y: float, text: str) -> None:
    """A length along x between two points, its line at y."""
    (x0, y0), (x1, y1) = first, second
    left, right = (x0, y), (x1, y)
    strokes = [Stroke(((x, from_ - GAP), (x, y - OVER)), "DIM") for x, from_ in ((x0, y0), (x1, y1))]
    wide = width_of(text) + 2 * GAP
    if x1 - x0 > max(INSIDE, wide):
        place = Text(((x0 + x1) / 2, y + GAP), text, "DIM", align="middle")
        strokes.append(Stroke((left, right), "DIM"))
        fills = (arrow(left, right), arrow(right, left))
    else:
        place = Text((x1 + 2 * ARROW[0], y + GAP), text, "DIM")
        strokes.append(Stroke(((x0 - 2 * ARROW[0], y), (x1 + 2 * ARROW[0] + wide, y)), "DIM"))
        fills = (arrow(left, (x0 - 1, y)), arrow(right, (x1 + 1, y)))
    sheet.add(Dimension(first, second, left, "x", place, tuple(strokes), fills))


def upright(sheet: Sheet, first: Point, second: Point, x: float, text: str) -> None:
    """A distance along y between two points, its line at x, its text on the right."""
    (x0, y0), (x1, y1) = sorted((first, second), key=lambda point: point[1])
    low, high = (x, y0), (x, y1)
    strokes = [Stroke(((from_ + GAP, y), (x + OVER, y)), "DIM") for from_, y in ((x0, y0), (x1, y1))]
    if y1 - y0 > INSIDE:
        strokes.append(Stroke((low, high), "DIM"))
        fills = (arrow(low, high), arrow(high, low))
    else:
        strokes.append(Stroke(((x, y0 - 2 * ARROW[0]), (x, y1 + 2 * ARROW[0])), "DIM"))
        fills = (arrow(low, (x, y0 - 1)), arrow(high, (x, y1 + 1)))
    place = Text((x + OVER + GAP, (y0 + y1) / 2 - HEIGHT / 2), text, "DIM")
    sheet.add(Dimension((x0, y0), (x1, y1), low, "y", place, tuple(strokes), fills))


def labels_height(count: int) -> float:
    """What so many labels take above a view, mm."""
    return FREE + LIFT * count


def rows_height(count: int) -> float:
    """What so many lengths take below a view, mm."""
    return FREE + ROW * count


def labels(sheet: Sheet, found: Sequence[Label], axis: float, top: float) -> None:
    """All labels over a view whose upper edge is at ``top``; the leftmost stands highest."""
    ordered = sorted(found, key=lambda one: -one.x)
    for number, one in enumerate(ordered):
        label(sheet, one, axis, top + FREE + LIFT * number)
