"""Arrays as a page holds them: bytes as base64, coordinates in whole steps."""

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

STEPS = 65_000
"""Steps of a form across its greatest side: a plate of 300 mm has steps of 0.005 mm, a tenth of a pixel."""

FINEST = 1e-4
"""Smallest step, mm, and what steps are whole multiples of."""

KINDS: dict[str, type[np.signedinteger[Any] | np.unsignedinteger[Any]]] = {
    "i1": np.int8,
    "u1": np.uint8,
    "i2": np.int16,
    "u2": np.uint16,
    "i4": np.int32,
    "u4": np.uint32,
}
"""Name of a type of numbers on the page to its type here."""


def packed(values: Array | NDArray[Any], kind: str) -> str:
    """Numbers as base64; raises OverflowError for one that the ``kind`` cannot hold.

    >>> packed(np.array([1, -2]), "i2")
    'AQD+/w=='
    """
    whole = np.rint(np.asarray(values, dtype=np.float64))
    limits = np.iinfo(KINDS[kind])
    if whole.size and not (limits.min <= whole.min() and whole.max() <= limits.max):
        raise OverflowError(f"numbers from {whole.min():g} to {whole.max():g} do not fit into {kind}")
    return base64.b64encode(whole.astype(f"<{kind}").tobytes()).decode("ascii")


def unpacked(text: str, kind: str) -> NDArray[Any]:
    """The numbers of a text (n,), as :func:`packed` wrote it."""
    return np.frombuffer(base64.b64decode(text), dtype=f"<{kind}")


def form(points: Array, triangles: NDArray[np.int64]) -> dict[str, Any]:
    """A mesh on a page: corners (n, 3), mm, in whole steps from its least corner, and triangles (k, 3).

    >>> one = form(np.array([(0.0, 0.0, 0.0), (6.5, 0.0, 0.0), (0.0, 3.25, 1.0)]), np.array([(0, 1, 2)]))
    >>> one["step"], corners(one)[1].tolist(), indices(one).tolist()
    (0.0001, [6.5, 0.0, 0.0], [[0, 1, 2]])
    """
    low = np.floor(points.min(axis=0) / FINEST) * FINEST
    step = FINEST * max(1, int(np.ceil((points - low).max() / STEPS / FINEST)))
    wide = len(points) > np.iinfo(np.uint16).max
    return {
        "low": (np.round(low, 4) + 0.0).tolist(),
        "step": round(step, 4),
        "points": packed((points - low) / step, "u2"),
        "triangles": packed(triangles, "u4" if wide else "u2"),
        "wide": wide,
    }


def corners(one: dict[str, Any]) -> Array:
    """The corners (n, 3), mm, of a :func:`form`."""
    found: Array = unpacked(one["points"], "u2").reshape(-1, 3) * one["step"] + np.array(one["low"])
    return found


def indices(one: dict[str, Any]) -> NDArray[np.int64]:
    """The triangles (k, 3) of a :func:`form`."""
    return unpacked(one["triangles"], "u4" if one["wide"] else "u2").reshape(-1, 3).astype(np.int64)
