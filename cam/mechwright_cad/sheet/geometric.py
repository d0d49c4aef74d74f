"""Datums and frames of geometrical tolerances (ISO 5459, ISO 1101)."""

import math
from typing import Literal

from mechwright.geometry.segments import Point
from mechwright_cad.sheet.circles import ring
from mechwright_cad.sheet.sheet import Fill, Sheet, Text, width_of
from mechwright_cad.sheet.tables import SMALL

HIGH = 5.0
"""Height of a frame, mm: twice its letters."""

Symbol = Literal["position", "perpendicularity", "profile"]


def datum(sheet: Sheet, letter: str, foot: Point, way: Point) -> None:
    """A datum: a triangle on a face at ``foot``, a line the ``way`` out of it, a letter in a square."""
    (x, y), (u, v) = foot, way
    tip, half, far = 2.5, 1.5, 6.0
    sheet.add(Fill(((x - half * v, y + half * u), (x + half * v, y - half * u), (x + tip * u, y + tip * v))))
    end = x + far * u, y + far * v
    sheet.lines([(x + tip * u, y + tip * v), end], "DIM")
    boxed(sheet, letter, (end[0] + HIGH / 2 * u, end[1] + HIGH / 2 * v))


def boxed(sheet: Sheet, letter: str, middle: Point) -> None:
    """A letter in a square, its middle at a place."""
    x, y, half = *middle, HIGH / 2
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    sheet.lines([(x + half * a, y + half * b) for a, b in corners], "DIM")
    sheet.add(Text((x, y - SMALL / 2), letter, "DIM", height=SMALL, align="middle"))


def tolerance_frame(sheet: Sheet, at: Point, symbol: Symbol, zone: str, datums: str = "") -> float:
    """A frame with its lower left corner at a place; gives its width, mm."""
    cells = [HIGH, width_of(zone, SMALL) + 2.0, *(HIGH for _ in datums)]
    x, y = at
    wide = sum(cells)
    sheet.lines([(x, y), (x + wide, y), (x + wide, y + HIGH), (x, y + HIGH), (x, y)], "DIM")
    _symbol(sheet, (x + HIGH / 2, y + HIGH / 2), symbol)
    for cell, text in zip(cells, ("", zone, *datums), strict=True):
        if text:
            middle = (x + cell / 2, y + (HIGH - SMALL) / 2)
            sheet.add(Text(middle, text, "DIM", height=SMALL, align="middle"))
            sheet.lines([(x, y), (x, y + HIGH)], "DIM")
        x += cell
    return wide


def _symbol(sheet: Sheet, middle: Point, symbol: Symbol) -> None:
    x, y = middle
    match symbol:
        case "position":
            sheet.lines(ring(middle, 1.0), "DIM")
            sheet.lines([(x - 1.7, y), (x + 1.7, y)], "DIM")
            sheet.lines([(x, y - 1.7), (x, y + 1.7)], "DIM")
        case "profile":
            angles = [k * math.pi / 16 for k in range(17)]
            half = [(x + 1.6 * math.cos(a), y - 0.8 + 1.6 * math.sin(a)) for a in angles]
            sheet.lines([*half, half[0]], "DIM")
        case "perpendicularity":
            sheet.lines([(x - 1.5, y - 1.5), (x + 1.5, y - 1.5)], "DIM")
            sheet.lines([(x, y - 1.5), (x, y + 1.5)], "DIM")
