"""What mends a cam: the least base radius, the largest roller, the best offset; each tried on the design."""

import math
from collections.abc import Callable

import numpy as np

from mechwright import kept
from mechwright_cam_follower.closure import closure_findings
from mechwright_cam_follower.extremes import cams_of, extremes_of, regular_limit
from mechwright_cam_follower.params import CamParams

_HALVINGS = 24
_LARGEST = 1000.0
"""Of a base radius, mm: as the design table has it."""
_ROUND = 100.0
"""Cures are named in hundredths of a millimetre."""
_OFFSETS = 41
"""Offsets that are tried over half the prime circle to either side."""

Cure = tuple[str, float]


def sound(params: CamParams, *, steep: bool) -> bool:
    """Whether a design closes, is not undercut, and with ``steep`` keeps to its pressure angle."""
    if closure_findings(params):
        return False
    with np.errstate(invalid="ignore"):  # a lever that turns just as fast as its cam touches it nowhere
        for second in cams_of(params):
            found = extremes_of(params, second)
            if not found.regular.value >= regular_limit(params):
                return False
            if steep and not math.degrees(found.pressure.value) <= params.steepest:
                return False
    return True


@kept
def base_for(params: CamParams, *, steep: bool = False) -> Cure | None:
    """The least base radius above the present one that mends it; None if none does."""

    def good(base: float) -> bool:
        return sound(params.model_copy(update={"base_radius": base}), steep=steep)

    low, high = params.base_radius, params.base_radius
    while not good(high):
        low, high = high, high * 1.5
        if high > _LARGEST:
            return None
    return "base_radius", math.ceil(bisected(good, low, high) * _ROUND) / _ROUND


@kept
def roller_for(params: CamParams) -> Cure | None:
    """The largest roller below the present one that is not undercut; None if not even 1 mm is."""

    def good(radius: float) -> bool:
        return sound(params.model_copy(update={"roller_radius": radius}), steep=False)

    if not good(1.0):
        return None
    return "roller_radius", math.floor(bisected(good, params.value("roller_radius"), 1.0) * _ROUND) / _ROUND


@kept
def offset_for(params: CamParams, *, steep: bool = False) -> Cure | None:
    """The offset of a slide with the least pressure angle, if it mends the design; None if it does not."""
    if not params.translating or params.contact == "flat":
        return None
    reach = (params.base_radius + params.value("roller_radius")) / 2
    best: tuple[float, float] | None = None
    for offset in np.round(np.linspace(-reach, reach, _OFFSETS), 2).tolist():
        other = params.model_copy(update={"offset": offset})
        if sound(other, steep=steep):
            angle = max(extremes_of(other, second).pressure.value for second in cams_of(params))
            best = min(best or (math.inf, 0.0), (angle, offset))
    return None if best is None else ("offset", best[1])


def bisected(good: Callable[[float], bool], bad: float, fine: float, halvings: int = _HALVINGS) -> float:
    """The value nearest to ``bad`` that is good, from ``fine``, which is."""
    for _ in range(halvings):
        middle = (bad + fine) / 2
        if good(middle):
            fine = middle
        else:
            bad = middle
    return fine
