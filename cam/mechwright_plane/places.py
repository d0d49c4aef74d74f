"""Places along a path: where they are, and which way it goes there."""

import math

import numpy as np

from mechwright.arrays import Array
from mechwright_plane.leads import CANDIDATES
from mechwright_plane.path import Path, Place, place_on

STEP = 0.1
"""Places at which a way is looked at, mm."""
LEAST_PIECE = 0.1
"""A path is not divided nearer to a node, mm."""


def heading_at(path: Path, at: int) -> float:
    """Direction of travel at the start (0) or at the end (-1) of a path, rad."""
    start, cut, done = list(path.walk())[at]
    return place_on(start, cut, 1.0 if at else 0.0, done).heading


def candidates(path: Path) -> tuple[Array, Array, Array]:
    """Places at which a contour may be entered: ways (k,), points (k, 2) and headings (k,)."""
    spacing = path.length / CANDIDATES
    found: list[Place] = []
    for start, cut, done in path.walk():
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
    for start, cut, done in path.walk():
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
