"""Central projection between the plane z = d and the sphere of radius r around the origin.

A point (x, y) of the plane is seen from the centre in the direction (x, y, d). With
t = σ r / √(x² + y² + d²) it goes to (x t, y t, d t). The projection is defined for every d > 0: the plane
need not cut the sphere. Great circles become straight lines, but lengths change: by 1/d towards the foot of
the perpendicular, by less and less away from it. The foot is the projection's centre, and may lie anywhere
in the plane.
"""

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array, GeometryError

HORIZON = 1e-6
"""Part of its length by which a direction must rise above the plane's horizon, z = 0: beyond a million
projection lengths a point of the plane means nothing."""


def project(
    points: ArrayLike,
    length: ArrayLike,
    radius: float = 1.0,
    *,
    centre: ArrayLike = (0.0, 0.0),
    side: int = 1,
) -> Array:
    """Points of the sphere (..., 3) for points of the plane (..., 2).

    Parameters
    ----------
    points
        In the plane, in its own unit of length.
    length
        Distance d (...) of the plane from the centre of the sphere, in the same unit, above 0.
    radius
        Of the sphere; the unit of the result.
    centre
        Foot of the perpendicular in the plane, (2,) or (..., 2).
    side
        +1 for the hemisphere that faces the plane, -1 for the other one: σ.

    Raises
    ------
    GeometryError
        The length is not above 0.

    >>> project([3, -4], 2.5, 7).round(4).tolist()
    [3.7566, -5.0088, 3.1305]
    """
    d = np.asarray(length, dtype=float)
    if not (d > 0).all():
        raise GeometryError(f"the projection length {float(d.min()):g} is not above 0; move the plane away")
    flat = np.asarray(points, dtype=float) - np.asarray(centre, dtype=float)
    x, y, d = np.broadcast_arrays(flat[..., 0], flat[..., 1], d)
    seen = np.stack([x, y, d], axis=-1)
    scale = side * radius / np.sqrt((seen**2).sum(axis=-1, keepdims=True))
    return np.asarray(seen * scale)


def unproject(points: ArrayLike, length: float, *, centre: ArrayLike = (0.0, 0.0), side: int = 1) -> Array:
    """Points of the plane (..., 2) for directions (..., 3) of any length on one side of the centre.

    Raises
    ------
    GeometryError
        A direction lies on the horizon or beyond it, where the plane has no point.

    >>> unproject([2, -1, 2], 5).tolist()
    [5.0, -2.5]
    """
    seen = np.asarray(points, dtype=float)
    height = np.atleast_1d(side * seen[..., 2] / np.sqrt((seen**2).sum(axis=-1)))
    if not (height > HORIZON).all():
        worst = seen.reshape(-1, 3)[int(np.argmin(height))]
        raise GeometryError(
            f"the direction {worst.tolist()} lies at or beyond the horizon of the projection, at the height "
            f"{height.min():.2g}; the limit is {HORIZON:g}: take a point nearer to the z axis"
        )
    return np.asarray(seen[..., :2] * (length / seen[..., 2:]) + np.asarray(centre, dtype=float))
