"""Volume, centre and second moments of plates: the outline by Green's theorem, less recesses and chamfers.

Moments of a body are kept as the matrix ∫ p pᵀ dV with p = (x, y, z, 1): the volume stands in its last
corner, the first moments beside it. A body that is moved by the matrix T has T M Tᵀ, several have the sum.
"""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.details import Chamfer, band_of
from mechwright.contracts.part import Part, Pocket
from mechwright.contracts.sections import ROUND, Section, blind, foot, plain_layers, sections

if TYPE_CHECKING:
    import shapely

FINE = 1e-5
"""Chord error of the polygons that a volume is made of, mm: a millionth of the volume of any part in use."""
NODES = 16
"""Places at which a fillet is measured for its volume: exact to far below FINE where its shape is regular."""
DEPTHS = 3
"""Depths at which chamfers are looked at, between those where one begins or ends: three (of Gauss) are exact,
for the second moments of a band along an edge are polynomials of degree 4."""
BAND = 10 * FINE
"""Chord error of the polygons along which details are cut, mm: both sides of a band have it."""


def volume(part: Part) -> float:
    """Volume of a plate part, mm³, recesses and chamfers taken out; 0 for one built as a solid.

    The plate itself is exact, what is taken out of it is right to ``FINE``.
    """
    return float(moments(part)[3, 3])


def moments(part: Part) -> Array:
    """Moments (4, 4) of a plate part in its own coordinates, mm³ to mm⁵; 0 for one built as a solid.

    Examples
    --------
    >>> from mechwright.geometry import Loop, Outline
    >>> cube = Part("cube", Outline(Loop.polygon([(0, 0), (2, 0), (2, 2), (0, 2)])), 2.0, "steel")
    >>> moments(cube).round(9).diagonal().tolist()
    [10.666666667, 10.666666667, 10.666666667, 8.0]
    """
    if part.outline is None:
        return np.zeros((4, 4))
    found = prism(part.outline.moments, 0.0, part.thickness)
    if not blind(part) and not part.details:
        return found
    whole = polygon_moments(part.outline.polygon(FINE))
    layers = plain_layers(part, FINE)
    for layer in layers:
        taken = whole - polygon_moments(layer.shape)
        found = found - prism(taken, part.thickness - layer.bottom, part.thickness - layer.top)
    for feature in blind(part):
        if isinstance(feature, Pocket) and feature.floor_radius > 0:
            found = found + _fillet(part, feature, layers)
    return found - _chamfers(part) if part.details else found


def polygon_moments(shape: "shapely.Geometry") -> Array:
    """Integrals (6,) of 1, x, y, x², y², xy over polygons, as ``Loop.moments`` has them over a loop."""
    import shapely

    found = np.zeros(6)
    for polygon in shapely.get_parts(shape):
        for ring, sign in [(polygon.exterior, 1.0), *((inner, -1.0) for inner in polygon.interiors)]:
            own = _ring_moments(shapely.get_coordinates(ring))
            found += sign * math.copysign(1.0, own[0]) * own
    return found


def _ring_moments(points: Array) -> Array:
    """The integrals inside a closed ring (n, 2), negative where it runs clockwise."""
    (x, y), (u, v) = points[:-1].T, points[1:].T
    c = x * v - u * y
    return np.array(
        [
            c.sum() / 2,
            (x + u) @ c / 6,
            (y + v) @ c / 6,
            (x * x + x * u + u * u) @ c / 12,
            (y * y + y * v + v * v) @ c / 12,
            (x * v + 2 * x * y + 2 * u * v + u * y) @ c / 24,
        ]
    )


def _slice(m: Array, z: float) -> Array:
    """Moments per height of a flat section with the integrals ``m`` (6,) at the height ``z``."""
    one, x, y, xx, yy, xy = m
    return np.array(
        [
            [xx, xy, z * x, x],
            [xy, yy, z * y, y],
            [z * x, z * y, z * z * one, z * one],
            [x, y, z * one, one],
        ]
    )


def _gauss(low: float, high: float, count: int) -> Iterator[tuple[float, float]]:
    """Places and weights of Gauss' quadrature between two numbers."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    half = (high - low) / 2
    return zip((low + half * (1 + nodes)).tolist(), (half * weights).tolist(), strict=True)


def prism(m: Array, low: float, high: float) -> Array:
    """Moments of a section that is extruded between two heights; two nodes are exact for z²."""
    found: Array = np.sum([weight * _slice(m, z) for z, weight in _gauss(low, high, 2)], axis=0)
    return found


def _fillet(part: Part, feature: Pocket, layers: tuple[Section, ...]) -> Array:
    """Moments of what a recess's fillet leaves: Gauss' quadrature of its sections over the angle."""
    import shapely

    inside, lines = foot(part, feature, layers, FINE)
    radius, floor = feature.floor_radius, feature.top + feature.depth
    found = np.zeros((4, 4))
    for angle, weight in _gauss(0.0, math.pi / 2, NODES):
        height = radius * (1 - math.cos(angle))
        wall = shapely.buffer(lines, feature.inset(height), quad_segs=ROUND)
        m = polygon_moments(shapely.intersection(inside, wall))
        found += weight * radius * math.sin(angle) * _slice(m, part.thickness - floor + height)
    return found


def _chamfers(part: Part) -> Array:
    """Moments of what chamfers take of the layers of a part."""
    import shapely

    chamfers = [detail for detail in part.details if isinstance(detail, Chamfer)]
    ends = {chamfer.width for chamfer in chamfers}
    found = np.zeros((4, 4))
    for layer in sections(part, BAND) if chamfers else ():
        inner = {depth for depth in ends if layer.top < depth < layer.bottom}
        for top, bottom in pairwise(sorted({layer.top, layer.bottom} | inner)):
            for depth, weight in _gauss(top, bottom, DEPTHS):
                cut = [band_of(one, depth, BAND) for one in chamfers if depth < one.width]
                if cut:
                    taken = shapely.intersection(layer.shape, shapely.union_all(cut))
                    found += weight * _slice(polygon_moments(taken), part.thickness - depth)
    return found
