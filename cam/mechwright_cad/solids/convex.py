"""Plates as convex prisms, which is what simulations of contact take.

A section is divided into triangles whose corners are its own, and neighbours are joined again as long as
they stay convex (Hertel and Mehlhorn 1983: at most four times as many pieces as need be).
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.part import Part
from mechwright.contracts.sections import sections

if TYPE_CHECKING:
    import shapely

CHORD = 0.002
"""Chord error of walls that touch, mm: a twentieth of a usual clearance, and a few hundred pieces."""

THIN = 1e-9
"""Area of a triangle, mm², below which it is a line by rounding."""


def prisms(part: Part) -> list[Array]:
    """Corners (k, 3), mm, of convex prisms that make up a plate in its own coordinates."""
    found = []
    for layer in sections(part, CHORD):
        low, high = part.thickness - layer.bottom, part.thickness - layer.top
        for piece in convex_pieces(layer.shape):
            rim = [np.column_stack((piece, np.full(len(piece), z))) for z in (low, high)]
            found.append(np.concatenate(rim))
    return found


def convex_pieces(shape: "shapely.Geometry") -> list[Array]:
    """Convex polygons (k, 2), counter-clockwise, that make up one or more polygons with holes.

    Examples
    --------
    >>> import shapely
    >>> angle = shapely.Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    >>> pieces = [shapely.Polygon(piece) for piece in convex_pieces(angle)]
    >>> all(piece.convex_hull.equals(piece) for piece in pieces), sum(piece.area for piece in pieces)
    (True, 3.0)
    """
    import shapely

    found = []
    for polygon in shapely.get_parts(shape):
        triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
        corners = shapely.get_coordinates(triangles).reshape(-1, 4, 2)[:, :3]
        points, index = np.unique(corners.reshape(-1, 2), axis=0, return_inverse=True)
        found += [points[piece] for piece in _joined(points, index.reshape(-1, 3))]
    return found


def _joined(points: Array, triangles: "np.ndarray[tuple[int, ...], np.dtype[np.intp]]") -> list[list[int]]:
    """Corners of the pieces, the longest inner edges taken away first."""
    pieces: dict[int, list[int]] = {}
    for number, triangle in enumerate(triangles.tolist()):
        area = _turn(points, *triangle)
        if abs(area) > THIN:
            pieces[number] = triangle if area > 0 else triangle[::-1]
    owner = {edge: number for number, piece in pieces.items() for edge in _edges(piece)}
    inner = [(a, b) for a, b in owner if a < b and (b, a) in owner]
    inner.sort(key=lambda edge: (-float(np.hypot(*(points[edge[0]] - points[edge[1]]))), edge))
    for a, b in inner:
        one, two = owner[a, b], owner[b, a]
        if one == two:
            continue
        joined = _without(pieces[one], pieces[two], a, b)
        if all(_convex(points, joined, corner) for corner in (a, b)):
            pieces[one] = joined
            owner |= dict.fromkeys(_edges(pieces.pop(two)), one)
    return list(pieces.values())


def _edges(piece: list[int]) -> Iterator[tuple[int, int]]:
    return zip(piece, piece[1:] + piece[:1], strict=True)


def _without(one: list[int], two: list[int], a: int, b: int) -> list[int]:
    """Two pieces less the edge from ``a`` to ``b`` of the first, which the second has the other way."""
    first, second = one.index(b), two.index(a)
    return one[first:] + one[:first] + (two[second:] + two[:second])[1:-1]


def _convex(points: Array, piece: list[int], corner: int) -> bool:
    at = piece.index(corner)
    return _turn(points, piece[at - 1], corner, piece[(at + 1) % len(piece)]) >= 0


def _turn(points: Array, a: int, b: int, c: int) -> float:
    """Twice the area of a triangle, mm², positive if counter-clockwise."""
    (x, y), (u, v) = points[b] - points[a], points[c] - points[b]
    return float(x * v - y * u)
