"""Whether a follower reaches its cam all the way, and whether its laws are laws: errors of the motion."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, KinematicsError, Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Change, errors
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import in_turn
from mechwright.mechanics.laws.faults import polynomial_faults, table_faults
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parameters import CamParams

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]

FLATTEST = math.radians(2)
"""Least angle between arm and line of centres: nearer to it the lever does not know which way to go."""

REACH = 0.95
"""Greatest offset, in radii of the prime circle: beyond it the follower hardly rises."""

FAULTS = ("ends", "rest", "monotone", "gap", "rows")
"""Kinds of what is wrong with a law."""


def _law_faults(m: Mechanism) -> Iterator[Finding]:
    """Errors of a table or a polynomial that is no law."""
    polynomial, table = m.given.polynomial, m.given.table
    faults = [("polynomial", one) for one in (polynomial_faults(polynomial) if polynomial else ())]
    faults += [("table", one) for one in (table_faults(table) if table else ())]
    for name, fault in faults:
        changes = tuple(_laws_instead(m.given, name))
        yield Finding.error(
            f"follower.law-{fault.kind}",
            name,
            fault.message,
            fault.value,
            fault.limit,
            "",
            fault.remedy + ", or take the nearest law that is one, as proposed" * bool(changes),
            proposed=changes,
        )


def _laws_instead(params: CamParams, name: str) -> Iterator[Change]:
    """Laws near to a table or polynomial that is none, the nearest first."""
    from mechwright.mechanics.laws.mended import instead, rows_of

    rows = params.table if name == "table" else rows_of(params.polynomial or ())
    for law, table in instead(rows or ()):
        laws = [law if one == name else one for one in params.laws]
        if law != "table":
            yield {f"parameters.{name}": None, "parameters.laws": laws}
        elif params.table is None or name == "table":
            change: Change = {"parameters.table": [list(row) for row in table or ()]}
            instead_of = {f"parameters.{name}": None, "parameters.laws": laws}
            yield change if name == "table" else {**change, **instead_of}


LAWS: Procedure[Mechanism] = Procedure(
    [f"follower.law-{kind}" for kind in FAULTS],
    _law_faults,
    common=True,
    when=lambda m: m.given.polynomial is not None or m.given.table is not None,
)

OFFSET = Rule(
    "follower.offset",
    "offset",
    lambda f: f"a follower {f.value:g} mm off the axis misses the prime circle of {f.m.prime:g} mm",
    value=lambda m: np.abs(m.offset),
    limit=lambda m: m.prime * REACH,
    unit="mm",
    remedy=lambda f: f"make it at most {_most_offset(f):g}, or base_radius larger",
    must_be="below",
    stage=Stage.MOTION,
    proposed=lambda f: ({"parameters.offset": math.copysign(_most_offset(f), f.m.offset)},),
    when=lambda m: m.slides and not m.flat,
)


def _most_offset(f: Fails) -> float:
    return math.floor(f.limit * 10) / 10


def _arm_limit(f: Fails) -> tuple[float, float]:
    least = abs(f.m.axis - f.m.arm)
    return f.m.prime, least if f.m.prime <= least else f.m.axis + f.m.arm


def _near_arm(f: Fails) -> float:
    axis, prime = f.m.axis, f.m.prime
    return math.sqrt(abs(axis**2 - prime**2)) if axis > prime else axis


ARM = Rule(
    "follower.arm",
    "arm_length",
    "an arm of {m.arm:g} mm, {m.axis:g} mm off the cam's axis, does not reach the prime circle of "
    "{m.prime:g} mm",
    value=lambda m: np.minimum(m.prime - np.abs(m.axis - m.arm), m.axis + m.arm - m.prime),
    limit=0.0,
    unit="mm",
    remedy=lambda f: (
        f"make arm_length about {_near_arm(f):.4g}: the roller's circle has to cut the prime circle"
    ),
    must_be="above",
    stage=Stage.MOTION,
    reported=_arm_limit,
    proposed=lambda f: ({"parameters.arm_length": float(f"{_near_arm(f):.4g}")},),
    when=lambda m: not m.slides and not m.flat,
)


def _need_axis(f: Fails) -> float:
    return float(math.ceil(f.value / math.cos(FLATTEST) * 1.05))


AXIS = Rule(
    "follower.axis",
    "centre_distance",
    "the lever's axis, {m.axis:g} mm off the cam's, stands within base circle and face, {value:g} mm",
    value=lambda m: m.given.base_radius + m.face,
    limit=lambda m: m.axis * math.cos(FLATTEST),
    unit="mm",
    remedy=lambda f: f"make centre_distance {_need_axis(f):g}, or base_radius smaller",
    must_be="below",
    stage=Stage.MOTION,
    reported=lambda f: (f.m.axis, f.value),
    proposed=lambda f: ({"parameters.centre_distance": _need_axis(f)},),
    when=lambda m: not m.slides and m.flat,
)


def _left(m: Mechanism) -> Any:
    """Give the least angle, degrees, between arm or face and the line of centres."""
    if m.flat:
        return np.degrees(m.start - m.stroke)
    return np.degrees(np.minimum(m.start, math.pi - m.start - m.stroke))


SWING = Rule(
    "follower.swing",
    lambda f: "swings" if f.m.given.swings is not None else "centre_distance",
    "at {m.given.stroke:g} degrees of swing the lever comes within {value:.3g} degrees of the line of "
    "centres",
    value=_left,
    limit=math.degrees(FLATTEST),
    unit="deg",
    remedy=lambda f: (
        "use a shorter swing, or a larger centre_distance"
        if f.m.flat
        else "use a shorter swing, or arms as long as the cam's axis is away"
    ),
    stage=Stage.MOTION,
    when=lambda m: not m.slides,
)

CLOSURE = in_turn(LAWS, OFFSET, ARM, AXIS, SWING)


def refuse_unclosed(m: Mechanism) -> None:
    """KinematicsError where the follower does not reach its cam, or the law is none."""
    with np.errstate(invalid="ignore"):
        found = CLOSURE.findings(m, quick=True)
    for finding in errors(found, Stage.MOTION):
        raise KinematicsError(f"{finding.parameter}: {finding.message}; {finding.remedy}")
