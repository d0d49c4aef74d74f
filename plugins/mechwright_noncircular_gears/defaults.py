"""What a design leaves out and follows from the rest: depth and number of the teeth, face width, bore."""

from collections.abc import Callable
from typing import Any

import numpy as np

from mechwright import MechwrightError, kept
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing.usual import (
    DEDENDUM,
    FACE,
    RIM,
    SHAFTS,
    dedendum_beside,
    face_width,
    shaft_bore,
    teeth_without_undercut,
)
from mechwright_noncircular_gears.kinematics.law import extremes_of
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.parts.cutter import profile_of
from mechwright_noncircular_gears.rules.law_rules import LAW
from mechwright_noncircular_gears.rules.shape_rules import HOLLOW, UNDERCUT, least_teeth, whole
from mechwright_noncircular_gears.table import table_of

TEETH = 40
"""Of the driver."""

USUAL = {"dedendum": DEDENDUM, "teeth": TEETH, "thickness": FACE, "bore": SHAFTS[0]}
"""Parameters that follow where they are left out, in the order in which they do, and what is usual."""

_APART = {
    "thickness": FACE,
    "material": "steel",
    "bore": 0.0,
    "keyway_width": 0.0,
    "keyway_depth": None,
    "keyway_relief": 0.0,
    "speed": 1.0,
    "load_torque": 0.0,
}
"""Parameters that the number of teeth does not follow from."""


def following(params: NoncircularParams) -> dict[str, Any]:
    """What is left out of a design with a complete law, as it follows from what is given and each other."""
    found: dict[str, Any] = {}
    given = frozenset(params.model_fields_set)
    for name, rule in _RULES.items():
        if name not in given:
            found[name] = rule(params)
            params = params.model_copy(update={name: found[name]})
    return found


def _dedendum(params: NoncircularParams) -> float:
    return DEDENDUM if params.addendum is None else float(dedendum_beside(params.addendum))


def _teeth(params: NoncircularParams) -> int:
    return _of_curves(params.model_copy(update=_APART))


@kept
def _of_curves(params: NoncircularParams) -> int:
    """The usual number of teeth, or the least greater one without undercut; whole numbers of both gears.

    Where the law cannot be run, pitch curves are too hollow, or no number up to 300 is without undercut, it
    is the usual one.
    """
    usual = params.model_copy(update={"teeth": whole(params, TEETH)})
    try:
        m = table_of(usual)
        if not _runs(usual) or not HOLLOW.allows(m) or _certain(usual):
            return usual.teeth
        return (None if UNDERCUT.allows(m) else least_teeth(usual)) or usual.teeth
    except MechwrightError:
        return usual.teeth


def _runs(params: NoncircularParams) -> bool:
    return _law_runs(params.model_copy(update={**_APART, "teeth": TEETH}))


@kept
def _law_runs(params: NoncircularParams) -> bool:
    """Whether the law can be run."""
    try:
        with np.errstate(all="ignore"):
            return not errors(LAW.findings(table_of(params), quick=True))
    except MechwrightError:
        return False


def _certain(params: NoncircularParams) -> bool:
    """Whether teeth can be cut wherever on their pitch curves they stand."""
    sharpest = max(one.value for one in extremes_of(params).sharpest)
    pair, cutter = table_of(params).pair, profile_of(params).sized(1.0, 0.0)
    bend = pair.rolled / pair.distance * sharpest
    least = teeth_without_undercut(bend, cutter.straight_depth, params.dedendum, params.pressure_angle)
    return bool(least <= params.teeth)


def _thickness(params: NoncircularParams) -> float:
    module = params.module
    if module is None:
        if not _runs(params):
            return FACE
        module = table_of(params).module
    return float(face_width(module))


def _bore(params: NoncircularParams) -> float:
    """The usual bore, or the largest smaller one that leaves the rim; as usual with keyways and sectors."""
    if params.keyway_width > 0 or params.sector is not None or not _runs(params):
        return SHAFTS[0]
    m = table_of(params)
    found, a, rack = m.extremes, m.pair.distance, m.rack
    slow, fast = found.slowest.value, found.fastest.value
    # Pitch radii are a i / (1 + i) and a / (1 + i), and of a gear in a ring a i / (1 - i).
    nearest = a * slow / (1 - slow) if params.internal else a * min(slow / (1 + slow), 1 / (1 + fast))
    return float(shaft_bore(nearest, RIM * (rack.addendum + rack.dedendum) + rack.dedendum))


_RULES: dict[str, Callable[[NoncircularParams], Any]] = {
    "dedendum": _dedendum,
    "teeth": _teeth,
    "thickness": _thickness,
    "bore": _bore,
}
