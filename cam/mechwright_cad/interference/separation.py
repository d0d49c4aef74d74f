"""Axes that separate two pieces: the method of separating axes on what a piece sweeps.

A moving piece sweeps, within an interval, no more than the convex hull of its corners at the start, in the
middle and at the end, widened by a bound of how far the corners leave the chords between. If the projections
on any axis lie further apart than that, the two pieces stay apart for the whole interval. What counts of the
bound is its share along the axis: a face that slides along another one does not come nearer.

Arrays have the pairs of pieces on their last axis: (corner, coordinate, pair).
"""

from collections.abc import Iterator

import numpy as np

from mechwright.arrays import Array

_NONE = 1e-30
"""A squared axis this short is no direction."""


def separation(
    fixed: Array, moving: Array, middle: Array, enough: Array | float, sag: Array | None = None
) -> Array:
    """The best gap (n,), mm, that any axis shows; negative where none separates.

    Parameters
    ----------
    fixed
        (k, d, n) corners of the fixed pieces.
    moving
        (j, d, n) all points that the moving pieces come to.
    middle
        (i, d, n) corners of the moving pieces in the middle of the interval, which give the axes.
    enough
        Gap, mm, one or (n,), above which no better one is looked for.
    sag
        (i, d, n) mm: how far the corners may leave the chords of their paths; taken off the gap.
    """
    if fixed.shape[1] == 2:
        return _best(fixed, moving, _plane_axes(fixed, middle), sag)
    # Most pairs lie before each other's faces; only the others need the many axes between edges.
    best = _best(fixed, moving, _normals(fixed, middle), sag)
    left = np.flatnonzero(best <= enough)
    if left.size:
        some = np.take(fixed, left, axis=-1), np.take(moving, left, axis=-1)
        bent = None if sag is None else np.take(sag, left, axis=-1)
        axes = _space_axes(some[0], np.take(middle, left, axis=-1))
        best[left] = np.maximum(best[left], _best(*some, axes, bent))
    return best


def _best(fixed: Array, moving: Array, axes: Iterator[Array], sag: Array | None) -> Array:
    best = np.full(fixed.shape[2], -np.inf)
    for axis in axes:
        np.maximum(best, gap_along(fixed, moving, axis, sag), out=best)
    return best


def gap_along(fixed: Array, moving: Array, axis: Array, sag: Array | None = None) -> Array:
    """Gap (n,), mm, of the projections of points (k, d, n) and (j, d, n) on axes (d, n) of any length."""
    square = dot(axis, axis)
    low, high = _reach(fixed, axis)
    least, most = _reach(moving, axis)
    gap = np.maximum(least - high, low - most)
    if sag is not None:
        gap -= np.abs(dot(sag, axis)).max(axis=0)
    scaled: Array = np.where(square > _NONE, gap / np.sqrt(np.maximum(square, _NONE)), -np.inf)
    return scaled


def _reach(points: Array, axis: Array) -> tuple[Array, Array]:
    """Least and greatest projection (n,) of points (k, d, n)."""
    low = high = dot(points[0], axis)
    for point in points[1:]:
        along = dot(point, axis)
        low, high = np.minimum(low, along), np.maximum(high, along)
    return low, high


def dot(a: Array, b: Array) -> Array:
    """Scalar products (..., n) of vectors (..., d, n); numpy's own sums are slow over so short an axis."""
    total: Array = a[..., 0, :] * b[..., 0, :]
    for axis in range(1, a.shape[-2]):
        total += a[..., axis, :] * b[..., axis, :]
    return total


def _plane_axes(fixed: Array, middle: Array) -> Iterator[Array]:
    along = fixed[1] - fixed[0]
    yield _normal(along)
    if len(middle) == 1:
        yield middle[0] - fixed[0]
        yield middle[0] - fixed[1]
        return
    other = middle[1] - middle[0]
    yield _normal(other)
    yield along
    yield other


def _normal(vector: Array) -> Array:
    return np.stack((-vector[1], vector[0]))


def _normals(fixed: Array, middle: Array) -> Iterator[Array]:
    for corners in (fixed, middle):
        yield _cross(corners[1] - corners[0], corners[2] - corners[0])


def _space_axes(fixed: Array, middle: Array) -> Iterator[Array]:
    one = [fixed[(i + 1) % 3] - fixed[i] for i in range(3)]
    two = [middle[(i + 1) % 3] - middle[i] for i in range(3)]
    for a in one:
        for b in two:
            yield _cross(a, b)
    # In one plane the crosses of edges are all normal to it: the edges' own normals separate there.
    first, second = _cross(one[0], one[1]), _cross(two[0], two[1])
    for a in one:
        yield _cross(first, a)
    for b in two:
        yield _cross(second, b)


def _cross(a: Array, b: Array) -> Array:
    return np.stack((a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]))
