"""Points of the plane as complex numbers."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright import Array

Complex = NDArray[np.complex128]


def points(pairs: ArrayLike) -> Complex:
    """Complex numbers (...) from coordinates (..., 2)."""
    pairs = np.asarray(pairs, dtype=float)
    return np.asarray(pairs[..., 0] + 1j * pairs[..., 1])


def pairs(points: Complex) -> Array:
    """Coordinates (..., 2) from complex numbers (...)."""
    return np.stack([points.real, points.imag], axis=-1)
