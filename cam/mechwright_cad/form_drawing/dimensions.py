"""Sizes of a part of free form in its views: angles and radii about the centre, and lengths."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.contracts.free_form import AngleSize, FormSize, LengthSize, RadiusSize
from mechwright.geometry.segments import Point
from mechwright_cad.form_drawing.projection import FRONT, LEFT, RIGHT, TOP, View
from mechwright_cad.sheet.circles import arc
from mechwright_cad.sheet.dimensions import FREE, GAP, ROW, length, upright
from mechwright_cad.sheet.sheet import HEIGHT, Sheet, Stroke, Text, arrow, width_of

ACROSS = 1e-6
"""Cosine to the line of sight above which a direction is not drawn in its true size."""


@dataclass(frozen=True)
class Placed:
    """A view on a sheet: the place of the part's origin, and the box (x0, y0, x1, y1) of its lines, mm."""

    view: View
    origin: Point
    box: tuple[float, float, float, float]
    scale: float

    def at(self, place: Sequence[float]) -> Point:
        """A point of the part on the sheet."""
        x, y = self.view.seen((place[0], place[1], place[2]))
        return self.origin[0] + self.scale * x, self.origin[1] + self.scale * y


def shown_in(size: FormSize, views: Sequence[View] = (FRONT, LEFT, TOP)) -> View | None:
    """The first view in which a size is drawn true; None where it is in none."""
    if isinstance(size, AngleSize):
        directions = [size.first, size.second]
    elif isinstance(size, RadiusSize):
        directions = [size.towards]
    else:
        way = np.subtract(size.second, size.first)
        directions = [tuple(way / np.linalg.norm(way))]
    for view in views:
        true = all(abs(float(view.towards @ np.array(one))) < ACROSS for one in directions)
        level = not isinstance(size, LengthSize) or _along_paper(size, view)
        if true and level:
            return view
    return None


def is_in(size: FormSize, view: View) -> bool:
    """Whether a view shows a size; both side views show the same ones."""
    found = shown_in(size)
    return found == (LEFT if view == RIGHT else view)


def _along_paper(size: LengthSize, view: View) -> bool:
    x, y = view.seen(tuple(np.subtract(size.second, size.first)))
    return min(abs(x), abs(y)) < ACROSS


def draw(sheet: Sheet, placed: Placed, sizes: Sequence[FormSize]) -> None:
    """The sizes that a view shows; each of a kind has a row of its own, so that none meets another."""
    mine = [size for size in sizes if is_in(size, placed.view)]
    angles = sorted((one for one in mine if isinstance(one, AngleSize)), key=lambda one: one.degrees)
    for row, angle in enumerate(angles):
        _angle(sheet, placed, angle, row)
    radii = [one for one in mine if isinstance(one, RadiusSize)]
    greatest = max((one.radius for one in radii if not one.flat), default=0.0)
    flat = sorted((one for one in radii if one.flat), key=lambda one: one.radius)
    for row, distance in enumerate(flat):
        _distance(sheet, placed, distance, row)
    for radius in radii:
        if not radius.flat:
            _radius(sheet, placed, radius, outside=radius.radius >= greatest)
    _, y0, x1, _ = placed.box
    level, standing = 0, 0
    lengths = [one for one in mine if isinstance(one, LengthSize)]
    for size in sorted(lengths, key=lambda one: math.dist(one.first, one.second)):
        first, second = sorted((placed.at(size.first), placed.at(size.second)))
        if abs(first[1] - second[1]) < abs(first[0] - second[0]):
            length(sheet, first, second, y0 - FREE - ROW * level, size.text)
            level += 1
        else:
            upright(sheet, first, second, x1 + FREE + ROW * 2 * standing, size.text)
            standing += 1


def level_rows(view: View, sizes: Sequence[FormSize]) -> float:
    """What the level lengths of a view take below it, mm."""
    count = sum(1 for one in sizes if isinstance(one, LengthSize) and is_in(one, view) and _level(one, view))
    return FREE + ROW * count if count else 0.0


def upright_rows(view: View, sizes: Sequence[FormSize]) -> float:
    """What the upright lengths of a view take on its right, mm."""
    count = sum(
        1 for one in sizes if isinstance(one, LengthSize) and is_in(one, view) and not _level(one, view)
    )
    return FREE + 2 * ROW * count + width_of("⌀100.5") if count else 0.0


def angle_rows(sizes: Sequence[FormSize]) -> float:
    """What the angles take around the front view, mm."""
    return FREE + ROW * sum(isinstance(one, AngleSize) for one in sizes)


def distance_rows(sizes: Sequence[FormSize]) -> float:
    """What distances from the centre take beside it, mm."""
    count = sum(isinstance(one, RadiusSize) and one.flat for one in sizes)
    return ROW * (count + 3) if count else FREE


def ends_of(sizes: Sequence[FormSize]) -> list[Point]:
    """Directions on paper that the lines of the angles of the front view touch: their ends and the axes."""
    found: list[Point] = []
    for one in sizes:
        if isinstance(one, AngleSize):
            start, turn = _turn(FRONT, one)
            found += [
                (math.cos(angle), math.sin(angle))
                for angle in (start, start + turn, *(k * math.pi / 2 for k in range(-4, 5)))
                if min(start, start + turn) <= angle <= max(start, start + turn)
            ]
    return found


def _turn(view: View, one: AngleSize) -> tuple[float, float]:
    """Where an angle begins on paper, and how far it goes, rad."""
    first, second = (math.atan2(y, x) for x, y in (view.seen(way) for way in (one.first, one.second)))
    return first, math.remainder(second - first, math.tau)


def _level(size: LengthSize, view: View) -> bool:
    x, y = view.seen(tuple(np.subtract(size.second, size.first)))
    return abs(y) < abs(x)


def _polar(centre: Point, radius: float, angle: float) -> Point:
    return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)


def _angle(sheet: Sheet, placed: Placed, one: AngleSize, row: int) -> None:
    centre = placed.at(one.centre)
    start, turn = _turn(placed.view, one)
    radius = _reach(placed, centre) + FREE / 2 + ROW * row
    for end in (start, start + turn):
        sheet.lines([centre, _polar(centre, radius + 2.0, end)], "CENTRE")
    line = list(arc(centre, radius, start, start + turn))
    sheet.add(Stroke(tuple(line), "DIM"), arrow(line[0], line[1]), arrow(line[-1], line[-2]))
    middle = start + turn / 2
    x, y = _polar(centre, radius + GAP, middle)
    text = f"{round(one.degrees, 4):g}°"
    wide = width_of(text)
    sheet.add(
        Text((x - wide * (1 - math.cos(middle)) / 2, y - HEIGHT * (1 - math.sin(middle)) / 2), text, "DIM")
    )


def _reach(placed: Placed, centre: Point) -> float:
    """Distance of the farthest corner of a view's lines from the centre, less what is empty there, mm."""
    x0, y0, x1, y1 = placed.box
    return max(abs(x0 - centre[0]), abs(x1 - centre[0]), abs(y0 - centre[1]), abs(y1 - centre[1]))


def _radius(sheet: Sheet, placed: Placed, one: RadiusSize, *, outside: bool) -> None:
    centre = placed.at(one.centre)
    x, y = placed.view.seen(one.towards)
    angle, radius = math.atan2(y, x), placed.scale * one.radius
    tip = _polar(centre, radius, angle)
    tail = _polar(centre, radius + 14.0 if outside else radius - 14.0, angle)
    wide = width_of(one.text)
    right = tail[0] >= tip[0]
    end = (tail[0] + (wide if right else -wide), tail[1])
    sheet.add(Stroke((tip, tail, end), "DIM"), arrow(tip, tail))
    sheet.add(Text((min(tail[0], end[0]), tail[1] + GAP), one.text, "DIM"))


def _distance(sheet: Sheet, placed: Placed, one: RadiusSize, row: int) -> None:
    """Of a flat face from the centre: a line beside the direction to it."""
    centre = placed.at(one.centre)
    x, y = placed.view.seen(one.towards)
    beside = ROW * (row + 3)
    shift = (y * beside, -x * beside) if y * x <= 0 else (-y * beside, x * beside)
    far = (centre[0] + placed.scale * one.radius * x, centre[1] + placed.scale * one.radius * y)
    first, second = ((at[0] + shift[0], at[1] + shift[1]) for at in (centre, far))
    for from_, to in ((centre, first), (far, second)):
        sheet.lines([from_, to], "DIM")
    sheet.add(Stroke((first, second), "DIM"), arrow(first, second), arrow(second, first))
    share = 0.7 + 0.1 * row
    at = (first[0] + share * (second[0] - first[0]), first[1] + share * (second[1] - first[1]))
    sheet.add(Text((at[0] + GAP, at[1] + GAP), one.text, "DIM"))
