"""Metric threads by their designations: M6, M8x1."""

import re

from mechwright.contracts.details import Thread
from mechwright.errors import GeometryError

COARSE = {
    1.6: 0.35, 2: 0.4, 2.5: 0.45, 3: 0.5, 3.5: 0.6, 4: 0.7, 5: 0.8, 6: 1, 7: 1, 8: 1.25, 10: 1.5, 12: 1.75,
    14: 2, 16: 2, 18: 2.5, 20: 2.5, 22: 2.5, 24: 3, 27: 3, 30: 3.5, 33: 3.5, 36: 4, 39: 4, 42: 4.5, 45: 4.5,
    48: 5, 52: 5, 56: 5.5, 60: 5.5, 64: 6,
}  # fmt: skip
"""Nominal diameter to coarse pitch, mm (ISO 261)."""

_NAME = re.compile(r"M(\d+(?:\.\d+)?)(?:\s*[x×]\s*(\d+(?:\.\d+)?))?")


def metric(designation: str) -> tuple[float, float]:
    """Nominal diameter and pitch of a thread, mm; the coarse pitch if none is said.

    Raises
    ------
    GeometryError
        It is no such designation, has no coarse pitch, or its pitch is too coarse for it.

    Examples
    --------
    >>> metric("M6"), metric("M8x1")
    ((6.0, 1.0), (8.0, 1.0))
    """
    found = _NAME.fullmatch(designation.strip())
    if found is None:
        raise GeometryError(f"{designation!r} is no metric thread; write M6, or M6x0.75 for a fine pitch")
    diameter = float(found[1])
    if found[2] is None and diameter not in COARSE:
        raise GeometryError(f"{designation} has no coarse pitch in ISO 261; say which, as M{diameter:g}x1")
    pitch = float(found[2] or COARSE[diameter])
    Thread("thread", (0.0, 0.0), diameter, pitch, 1.0)  # says what is wrong with the pitch
    return diameter, float(pitch)
