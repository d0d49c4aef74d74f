"""Places along a path: where they are, and which way it goes there."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright_cam.plane.leads import CANDIDATES
from mechwright_cam.plane.path import Cut, Path

STEP = 0.1
"""Places at which a way is looked at, mm."""
LEAST_PIECE = 0.1
"""A path is not divided nearer to a node, mm."""


class Place(NamedTuple):
    """A place on a cut: length from the path's start, mm, the point, and the heading, rad."""

    at: float
    point: Point
    heading: float


def place_on(start: Point, cut: Cut, share: float, done: float) -> Place:
    """The place at a share of a cut."""
    at = done + share * cut.length
    if not cut.turn:
        x, y = (a + share * (b - a) for a, b in zip(start, (cut.x, cut.y), strict=True))
        return Place(at, (x, y), math.atan2(cut.y - start[1], cut.x - start[0]))
    radius = math.hypot(start[0] - cut.cx, start[1] - cut.cy)
    angle = math.atan2(start[1] - cut.cy, start[0] - cut.cx) + share * cut.turn * cut.length / radius
    point = cut.cx + radius * math.cos(angle), cut.cy + radius * math.sin(angle)
    return Place(at, point, angle + cut.turn * math.pi / 2)


def walk(path: Path) -> Iterator[tuple[Point, Cut, float]]:
    """The cuts of a path, with their starts and the way before them."""
    here, done = path.start, 0.0
    for cut in path.cuts:
        yield here, cut, done
        here, done = (cut.x, cut.y), done + cut.length


def heading_at(path: Path, at: int) -> float:
    """Direction of travel at the start (0) or at the end (-1) of a path, rad."""
    start, cut, done = list(walk(path))[at]
    return place_on(start, cut, 1.0 if at else 0.0, done).heading


def candidates(path: Path) -> tuple[Array, Array, Array]:
    """Places at which a contour may be entered: ways (k,), points (k, 2) and headings (k,)."""
    spacing = path.length / CANDIDATES
    found: list[Place] = []
    for start, cut, done in walk(path):
        if cut.length >= 2 * LEAST_PIECE:
            count = max(1, math.floor(cut.length / max(spacing, 2 * LEAST_PIECE)))
            found += [place_on(start, cut, (k + 0.5) / count, done) for k in range(count)]
    at, places, headings = zip(*found, strict=True) if found else ((), (), ())
    return np.array(at), np.array(places).reshape(-1, 2), np.array(headings)


def centres(path: Path, side: int, widest: float, distance: float) -> tuple[Array, Array]:
    """Ways (n,) along a contour, and the places (n, 2) of a tool at this distance, around corners as well.

    The ways are the same for all distances up to the ``widest``.
    """
    found: list[Place] = []
    for start, cut, done in walk(path):
        steps = max(1, math.ceil(cut.length / STEP))
        places = [place_on(start, cut, k / steps, done) for k in range(steps + 1)]
        if found:
            turn = (places[0].heading - found[-1].heading + math.pi) % math.tau - math.pi
            corner = math.ceil(abs(turn) * max(widest, STEP) / STEP)
            found += [
                places[0]._replace(heading=found[-1].heading + turn * k / corner) for k in range(1, corner)
            ]
        found += places
    at, points, headings = (np.array(column) for column in zip(*found, strict=True))
    normals = np.column_stack((-np.sin(headings), np.cos(headings))) * side
    return at, points + distance * normals
