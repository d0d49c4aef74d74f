"""Similarity fits: where random curves lie best on prescribed points."""

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar import Plane

ALIKE = 1e-12
"""Share of their squares within which two columns are one: no scale fits then."""


def two_columns(first: Plane, second: Plane, targets: Plane) -> tuple[Plane, Plane, Plane, Array]:
    """Least squares of X + s u + q v over complex X, s and q, for columns u, v (m, n) and points (n,).

    The result is X, s, q and the sums of squares (m,); infinite where the two columns are one.
    """
    means = [one.mean(axis=1) for one in (first, second)]
    u, v = (one - mean[:, None] for one, mean in zip((first, second), means, strict=True))
    mean = targets.mean()
    t = targets - mean
    uu, vv = (np.abs(u) ** 2).sum(axis=1), (np.abs(v) ** 2).sum(axis=1)
    uv = (np.conj(u) * v).sum(axis=1)
    ut, vt = np.conj(u) @ t, np.conj(v) @ t
    det = uu * vv - np.abs(uv) ** 2
    good = det > ALIKE * uu * vv
    safe = np.where(good, det, 1.0)
    s, q = (vv * ut - uv * vt) / safe, (uu * vt - np.conj(uv) * ut) / safe
    squares = float((np.abs(t) ** 2).sum()) - (np.conj(ut) * s + np.conj(vt) * q).real
    return (
        mean - s * means[0] - q * means[1], s, q, np.where(good, np.maximum(squares, 0.0), np.inf)
    )  # fmt: skip
