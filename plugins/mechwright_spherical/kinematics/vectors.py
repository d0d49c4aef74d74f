"""Vectors on the sphere, components first.

All arrays have the shape (3, ...): one row per component, so that thousands of poses of many designs are
worked on row by row. Axes and pins are unit vectors; angles are in rad.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array, GeometryError

LEAST_LENGTH = 1e-9
"""A vector shorter than this has no direction: what is left of numbers near 1 that cancel."""


def vector(values: ArrayLike) -> Array:
    """The direction of a vector (3,), as a unit vector.

    Raises
    ------
    GeometryError
        It has no direction.

    >>> vector([0, 3, 4]).tolist()
    [0.0, 0.6, 0.8]
    """
    found = np.asarray(values, dtype=float)
    length = float(np.sqrt((found * found).sum()))
    if not length > LEAST_LENGTH:
        raise GeometryError(f"{found.tolist()} is no direction; give a vector away from the centre")
    return np.asarray(found / length, dtype=float)


def direction(angle: float) -> Array:
    """The direction in a link's frame at an arc, rad, from its first joint."""
    return np.array([math.cos(angle), math.sin(angle), 0.0])


def dot(a: Array, b: Array) -> Array:
    """Scalar product (...) of vectors (3, ...)."""
    found: Array = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return found


def cross(a: Array, b: Array) -> Array:
    """Vector product (3, ...); both broadcast against each other behind the first axis."""
    first = a[1] * b[2] - a[2] * b[1]
    found = np.empty((3, *np.shape(first)))
    found[0] = first
    found[1] = a[2] * b[0] - a[0] * b[2]
    found[2] = a[0] * b[1] - a[1] * b[0]
    return found


def norm(a: Array) -> Array:
    """Length (...) of vectors (3, ...)."""
    return np.asarray(np.sqrt(dot(a, a)))


def column(a: Array, like: Array) -> Array:
    """Give vectors (3, ...) as many axes as ``like`` (3, ...) has, by new ones at the end."""
    return a.reshape(a.shape + (1,) * (like.ndim - a.ndim))


def arc(a: Array, b: Array) -> Array:
    """Angle (...) between vectors (3, ...), 0 to π, exact for small and for large angles alike."""
    return np.asarray(np.arctan2(norm(cross(a, b)), dot(a, b)))


def rotate(axis: Array, angle: ArrayLike, v: Array) -> Array:
    """Turn vectors (3, ...) by ``angle`` (...) about a unit ``axis`` (3, ...): the formula of Rodrigues.

    >>> rotate(np.array([0.0, 0, 1]), np.pi / 2, np.array([1.0, 0, 0])).round(12).tolist()
    [0.0, 1.0, 0.0]
    """
    along = axis * dot(axis, v)
    return np.asarray(along + np.cos(angle) * (v - along) + np.sin(angle) * cross(axis, v))


def azimuth(axis: Array, a: Array, b: Array) -> Array:
    """Angle (...) by which ``a`` turns about ``axis`` to come to the meridian of ``b``, -π to π."""
    swing = cross(axis, a)
    return np.asarray(np.arctan2(dot(swing, b), dot(cross(swing, axis), b)))


def rotation_about(axis: Array, angle: ArrayLike) -> Array:
    """Rotation matrices (3, 3, ...) about a unit axis (3,) by ``angle`` (...)."""
    angle = np.asarray(angle, dtype=float)
    return np.stack([rotate(column(axis, angle[None]), angle, e) for e in _units(angle)], axis=1)


def _units(like: Array) -> list[Array]:
    return [np.broadcast_to(column(e, like[None]), (3, *like.shape)) for e in np.eye(3)]


def perpendicular(axis: Array) -> Array:
    """Some unit vector (3,) at right angles to ``axis`` (3,), a smooth choice where the axis is not near ±y.

    It lies in the plane of the axis and x wherever that is one.
    """
    candidates = (np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    helper = candidates[0] if abs(axis[0]) < 0.9 else candidates[1]  # any bound well inside 0.71 to 1
    return vector(helper - axis * float(dot(axis, helper)))
