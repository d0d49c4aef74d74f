"""Whether designs close and are not undercut, and searches for the least or greatest value that is good."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mechwright import Array, Stage
from mechwright.contracts.design_rule import Bools
from mechwright.contracts.design_table import with_columns
from mechwright_cam_follower.kinematics.extremes import of_cams, pressure_peak, regular_limit, regularity
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.rules.closure import CLOSURE

HALVINGS = 24

_AT_ONCE = 4
"""Halvings of a range that one table decides: 15 designs take hardly longer than one."""

Good = Callable[[Array], Bools]
"""Which values (n,) of a parameter are good."""


def with_values(params: CamParams, **values: Array) -> Mechanism:
    """Give the table of designs that have the values (n,) of some parameters."""
    columns = {name: np.reshape(one, (-1, 1)) for name, one in values.items()}
    return Mechanism(with_columns(params, columns), len(next(iter(columns.values()))))


def fulfils(m: Mechanism, limits: Callable[[Mechanism], Any]) -> Bools:
    """Give the designs (n,) that close and keep limits, which are asked of those that close."""
    found = np.zeros(m.size, bool)
    with np.errstate(all="ignore"):  # a lever that turns just as fast as its cam touches it nowhere
        closed, places = CLOSURE.allowed(m, Stage.MOTION, lambda code, which: None)  # noqa: ARG005
        if places.size:
            found[places] = np.broadcast_to(np.ravel(limits(closed)), places.size)
    return found


def is_valid(m: Mechanism, *, steep: bool) -> Bools:
    """Give the designs (n,) that close, are not undercut, and with ``steep`` keep to their pressure angle."""

    def limits(closed: Mechanism) -> Any:
        fits = np.all(of_cams(closed, regularity) >= regular_limit(closed), axis=1)
        if steep and fits.any():
            angles = np.degrees(of_cams(closed, pressure_peak))
            fits &= np.all(angles <= closed.given.steepest, axis=1)
        return fits

    return fulfils(m, limits)


def first_good(good: Good, ladder: Sequence[float]) -> tuple[float, float] | None:
    """Give the first value of a ladder that is good, after the one before it; None if none is."""
    if good(np.array(ladder[:1])).all():
        return ladder[0], ladder[0]
    if not ladder[1:] or not (fits := good(np.array(ladder[1:]))).any():
        return None
    place = int(np.argmax(fits))
    return ladder[place], ladder[place + 1]


def bisected(good: Good, bad: float, fine: float, halvings: int = HALVINGS, at_once: int = _AT_ONCE) -> float:
    """Give the value nearest to ``bad`` that is good, from ``fine``, which is.

    >>> round(bisected(lambda values: values > 0.3, 0.0, 1.0), 6)
    0.3
    """
    for done in range(0, halvings if bad != fine else 0, at_once):
        parts = 2 ** min(at_once, halvings - done)
        values = bad + (fine - bad) * np.arange(parts + 1) / parts
        values[-1] = fine
        fits, low, high = good(values[1:-1]), 0, parts
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if fits[middle - 1] else (middle, high)
        bad, fine = values[low].item(), values[high].item()
    return fine
