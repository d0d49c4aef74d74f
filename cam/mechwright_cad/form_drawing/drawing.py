"""The whole drawing of a part of free form: views in first-angle projection, chart of bores, title block."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.contracts.free_form import FreeForm
from mechwright.contracts.materials import material
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.geometry.segments import Point
from mechwright_cad.form_drawing import chart as charts
from mechwright_cad.form_drawing import dimensions as dimensioning
from mechwright_cad.form_drawing.dimensions import Placed
from mechwright_cad.form_drawing.projection import FRONT, LEFT, RIGHT, TOP, Projection, projected
from mechwright_cad.sheet.frame import EDGE, LINE, MARGIN, SHEETS, TITLE, frame
from mechwright_cad.sheet.scales import LEAST, SCALES
from mechwright_cad.sheet.sheet import Sheet, Text, width_of
from mechwright_cad.sheet.title import TitleBlock, projection_sign
from mechwright_cad.sheet.words import GENERAL
from mechwright_cad.solids.solid import part_solid

APART = 12.0
"""Between two views and round all of them, mm."""

OVERHANG = 4.0
"""How far the axis of a bore goes beyond its ends, mm."""

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class _Plan:
    """What a sheet holds."""

    form: FreeForm
    views: tuple[Projection, Projection, Projection]
    rows: list[charts.Row]
    notes: list[str]

    def box(self, k: int) -> Box:
        """Of the lines of a view, the centre included where axes meet there, mm of the part."""
        points = [point for line in (*self.views[k].visible, *self.views[k].hidden) for point in line]
        found = np.array([*points, (0.0, 0.0)] if self.form.centre else points)
        (x0, y0), (x1, y1) = found.min(axis=0).tolist(), found.max(axis=0).tolist()
        return x0, y0, x1, y1

    def room(self, k: int, scale: float) -> tuple[float, float, float, float]:
        """What a view takes to the left of, below, to the right of and above the part's origin, mm."""
        x0, y0, x1, y1 = (scale * end for end in self.box(k))
        view, sizes = self.views[k].view, self.form.sizes
        beside, below = dimensioning.upright_rows(view, sizes), dimensioning.level_rows(view, sizes)
        if k > 0:
            return -x0, below - y0, x1 + beside, y1
        # Angles run about the centre, outside of the whole view.
        reach = max(-x0, x1, -y0, y1) + dimensioning.angle_rows(sizes)
        left, low, right, high = (reach * share for share in self._turned())
        flat = dimensioning.distance_rows(sizes)
        return max(flat - x0, left), max(below - y0, low), max(x1 + beside, right), max(y1, high)

    def _turned(self) -> tuple[float, float, float, float]:
        """How far the angles of the front view reach to the left, down, right and up, as shares of 1."""
        ends = dimensioning.ends_of(self.form.sizes)
        if not ends:
            return 0.0, 0.0, 0.0, 0.0
        x, y = zip(*ends, strict=True)
        return max(-min(x), 0.0), max(-min(y), 0.0), max(*x, 0.0), max(*y, 0.0)

    def size(self, scale: float) -> tuple[float, float]:
        """Width and height of all, mm of the sheet without its frame and title block."""
        front, top, left = (self.room(k, scale) for k in range(3))
        wide, high = charts.size_of(self.rows)
        first = max(front[0], top[0]) + max(front[2], top[2])
        second = max(left[0] + left[2], wide)
        upper = max(front[1], left[1]) + max(front[3], left[3])
        lower = max(top[1] + top[3], high)
        return first + second + 2 * APART, upper + lower + 2 * APART


def form_sheet(part: Part, title: TitleBlock) -> Sheet:
    """The drawing of a part of free form; raises GeometryError for another."""
    form = part.free_form
    if form is None:
        raise GeometryError(f"part {part.name} is of no free form: it has no drawing of this kind")
    solid = part_solid(part)
    side = RIGHT if title.third_angle else LEFT
    views = projected(solid, FRONT), projected(solid, TOP), projected(solid, side)
    plan = _Plan(form, views, charts.rows_of(form), notes_of(part, form))
    paper, scale = _fitting(plan)
    sheet = Sheet(*paper, scale)
    bottom = MARGIN + max(TITLE[1], LINE * (len(plan.notes) + 1)) + EDGE
    used = plan.size(scale)
    left = MARGIN + EDGE + max((paper[0] - 2 * (MARGIN + EDGE) - used[0]) / 2, 0.0)
    top = paper[1] - MARGIN - EDGE - max((paper[1] - MARGIN - EDGE - bottom - used[1]) / 2, 0.0)
    front, upon, beside = (plan.room(k, scale) for k in range(3))
    x, second = left + max(front[0], upon[0]), left + max(front[0], upon[0]) + max(front[2], upon[2]) + APART
    head, foot = max(front[3], beside[3]), max(front[1], beside[1])
    if title.third_angle:
        high = max(upon[1] + upon[3], charts.size_of(plan.rows)[1])
        y, lower = top - high - APART - head, top
    else:
        y = top - head
        lower = y - foot - APART
    origins: list[Point] = [(x, y), (x, lower - upon[3]), (second + beside[0], y)]
    for k, origin in enumerate(origins):
        _view(sheet, plan, k, origin)
    charts.chart(sheet, plan.rows, (second, lower))
    stock = f"{part.material}, {material(part.material).grades.plate}"
    frame(sheet, title.of_part(part, stock, scale), plan.notes)
    projection_sign(sheet, third_angle=title.third_angle)
    return sheet


def notes_of(part: Part, form: FreeForm) -> list[str]:
    """What holds for the whole part."""
    return [
        *GENERAL,
        f"Process: {form.process}",
        f"Form by {part.name}.step; this drawing states sizes and limits",
        *form.notes,
    ]


def _fitting(plan: _Plan) -> tuple[tuple[float, float], float]:
    """The smallest sheet and the largest scale that hold all; the last of both where none does."""
    foot = max(TITLE[1], LINE * (len(plan.notes) + 1))
    for paper in SHEETS:
        for scale in SCALES:
            wide, high = plan.size(scale)
            room = paper[0] - 2 * (MARGIN + EDGE), paper[1] - 2 * (MARGIN + EDGE) - foot
            if wide <= room[0] and high <= room[1] and (scale >= LEAST or paper is SHEETS[-1]):
                return paper, scale
    return SHEETS[-1], SCALES[-1]


def _view(sheet: Sheet, plan: _Plan, k: int, origin: Point) -> None:
    found, scale = plan.views[k], sheet.scale

    def on(line: Sequence[Point]) -> list[Point]:
        return [(origin[0] + scale * x, origin[1] + scale * y) for x, y in line]

    for line in found.hidden:
        sheet.lines(on(line), "HIDDEN")
    for line in found.visible:
        sheet.lines(on(line))
    x0, y0, x1, y1 = plan.box(k)
    (left, low), (right, high) = on([(x0, y0), (x1, y1)])
    placed = Placed(found.view, origin, (left, low, right, high), scale)
    if plan.form.centre:
        _cross(sheet, origin, named=k == 0)
    _axes(sheet, placed, plan.form)
    dimensioning.draw(sheet, placed, plan.form.sizes)


def _cross(sheet: Sheet, at: Point, *, named: bool) -> None:
    """The centre in which axes meet."""
    x, y = at
    sheet.lines([(x - OVERHANG, y), (x + OVERHANG, y)], "DIM")
    sheet.lines([(x, y - OVERHANG), (x, y + OVERHANG)], "DIM")
    if named:
        sheet.add(Text((x - OVERHANG - width_of("centre", 2.0), y + 1.0), "centre", "TEXT", 2.0))


def _axes(sheet: Sheet, placed: Placed, form: FreeForm) -> None:
    """The axis of each bore, with its name in the front view, or where it is seen end on."""
    for one in form.bores:
        first, second = (placed.at(end) for end in (one.start, one.end))
        along = abs(float(placed.view.towards @ np.array(one.axis)))
        if along > 1 - dimensioning.ACROSS:
            x, y = first
            arm = placed.scale * one.diameter / 2 + OVERHANG / 2
            sheet.lines([(x - arm, y), (x + arm, y)], "CENTRE")
            sheet.lines([(x, y - arm), (x, y + arm)], "CENTRE")
        else:
            u = np.subtract(second, first) / np.linalg.norm(np.subtract(second, first))
            ends = [
                (at[0] + sign * OVERHANG * float(u[0]), at[1] + sign * OVERHANG * float(u[1]))
                for at, sign in ((first, -1), (second, 1))
            ]
            sheet.lines(ends, "CENTRE")
            first = ends[0]
        end_on = along > 1 - dimensioning.ACROSS
        if end_on or (placed.view == FRONT and charts.is_radial(one)):
            back = 0.0 if end_on else width_of(one.name, 2.5)
            sheet.add(Text((first[0] + 1.0 - back, first[1] + 1.0), one.name, "TEXT", 2.5))
