"""Rules of what can be computed at all: the law, the angles, the distance of the axes."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.laws.faults import LawFault, polynomial_faults, table_faults
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.rules.slots import rounded_down

LEAST_FLOOR = 0.5
"""Least depth of a groove and length of a roller, mm."""

ANGLE_SLACK = 1e-6
"""Degrees by which the angles of a straight slot may be off: rounding of the design file."""

LENGTH_SLACK = 1e-3
"""mm by which a centre distance may be off that is given besides what tells it: decimals of a drawing."""

FLATTEST = 1.0
"""Degrees that W + θd0/2 stays below 90, and W above 0: beyond, the slot's bottom is on the wheel's axis, or
the crank has no length."""

LEAST_LOCKED = 5.0
"""Least turn of the crank between two strokes over which the disc locks the wheel, degrees."""

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]


def _law_findings(m: Mechanism) -> Iterator[Finding]:
    params = m.given
    faults: Iterator[LawFault] = iter(())
    if params.law == "polynomial":
        faults = polynomial_faults(params.polynomial or ())
    elif params.law == "table":
        faults = table_faults(params.table or ())
    for one in faults:
        remedy = f"{one.remedy}, or take the nearest law that is one, as proposed"
        found = (one.message, one.value, one.limit)
        yield Finding.error("geneva.law", params.law, *found, remedy=remedy, proposed=tuple(_laws_instead(m)))


def _laws_instead(m: Mechanism) -> Iterator[Change]:
    """Laws near to a table or polynomial that is none, the nearest first."""
    from mechwright.mechanics.laws.mended import instead, rows_of

    rows = m.given.table if m.given.law == "table" else rows_of(m.given.polynomial or ())
    for law, table in instead(rows or ()):
        found = {} if table is None else {"parameters.table": [list(row) for row in table]}
        yield {f"parameters.{m.given.law}": None, "parameters.law": law, **found}


def _entry(m: Mechanism) -> Any:
    return np.degrees(m.frame.entry_angle)


def _reach(m: Mechanism) -> Any:
    """W + θd0/2, degrees."""
    return _entry(m) + np.degrees(m.frame.crank_half) / 2


def _flatter(f: Fails) -> str:
    entry, half = float(_entry(f.m)), math.degrees(f.m.crank_half)
    most, offset = 2 * (f.limit - entry), f.limit - half / 2 - math.degrees(f.m.wheel_half)
    cures = [f"make crank_half_angle at most {rounded_down(most)}"] if most >= 5 else []
    return ", or ".join([*cures, f"make offset_angle at most {rounded_down(offset)}"])


def _locked(m: Mechanism) -> Any:
    return 360 / m.params.rollers - 2 * np.degrees(m.crank_half)


def _rollers_message(f: Fails) -> str:
    turn, half = 360 / f.m.params.rollers, math.degrees(f.m.crank_half)
    return (
        f"{f.m.params.rollers} rollers, {turn:g} degrees apart, leave {f.value:.4g} degrees of the crank's "
        f"turn to lock the wheel between strokes of {2 * half:g} degrees"
    )


def _fewer_rollers(f: Fails) -> str:
    turn, half = 360 / f.m.params.rollers, math.degrees(f.m.crank_half)
    most = max(1, math.floor(360 / (2 * half + LEAST_LOCKED)))
    cure = f"make crank_half_angle at most {math.floor((turn - LEAST_LOCKED) * 50) / 100:g}"
    return cure if f.m.params.rollers == most else f"use at most {most} rollers, or {cure}"


def _other_wheel(f: Fails) -> str:
    axes, given = f.m.axes, f.m.given
    wheel = f.m.rim * (given.centre_distance or 0.0) / axes
    cure = f"use centre_distance = {axes:.4f}, or leave it out"
    if 5 <= wheel <= 1000 and given.entry_radius is not None:
        cure = f"use entry_radius = {wheel:.4f} or leave it out, or {cure}"
    return cure


def _least_deceleration(f: Fails) -> tuple[float | None, float]:
    return f.m.params.driver_acceleration, -(f.m.driver.speed**2) / (2 * math.tau)


def _faster(f: Fails) -> str:
    given, least = _least_deceleration(f)
    faster = math.sqrt(-2 * (given or 0.0) * math.tau) * 60 / math.tau
    return (
        f"keep driver_acceleration above {-math.floor(-least * 1e4) / 1e4:g}, or begin with more than "
        f"{math.ceil(faster * 10) / 10:g} rev/min"
    )


def _thinner_floor(f: Fails) -> str:
    most = _greatest_floor(f.m)
    if most >= 0.2:
        return f"make floor at most {rounded_down(most)}"
    return "make thickness larger, or axial_gap smaller"


def _greatest_floor(m: Mechanism) -> float:
    return m.params.thickness - m.params.axial_gap - LEAST_FLOOR


LAW = Procedure[Mechanism](("geneva.law",), _law_findings, common=True)
STRAIGHT_HALF = Rule(
    "geneva.straight",
    "crank_half_angle",
    lambda f: f"a straight slot turns the crank by {90 - 180 / f.m.slots:g} degrees on either side",
    value=lambda m: np.abs(m.params.crank_half_angle - (90 - 180 / m.slots)),
    limit=ANGLE_SLACK,
    unit="deg",
    remedy=lambda f: f"use crank_half_angle = {90 - 180 / f.m.slots:g}, leave it out, or choose another law",
    must_be="at most",
    stage=Stage.MOTION,
    reported=lambda f: (f.m.params.crank_half_angle, 90 - 180 / f.m.slots),
)
STRAIGHT_OFFSET = Rule(
    "geneva.straight",
    "offset_angle",
    "a straight slot has one mouth",
    value=lambda m: np.abs(m.params.offset_angle),
    limit=0.0,
    unit="deg",
    remedy="use offset_angle = 0, leave it out, or choose another law",
    must_be="at most",
    stage=Stage.MOTION,
    reported=lambda f: (f.m.params.offset_angle, 0.0),
)
BOTTOM_ANGLE = Rule(
    "geneva.angles",
    "crank_half_angle",
    lambda f: (
        f"180/n + offset_angle + crank_half_angle/2 is {f.value:.4g} degrees: the slot's bottom would be "
        f"{'on' if f.value < 90 else 'beyond'} the wheel's axis"
    ),
    value=_reach,
    limit=90 - FLATTEST,
    unit="deg",
    remedy=_flatter,
    must_be="at most",
)
ENTRY_ANGLE = Rule(
    "geneva.angles",
    "offset_angle",
    "180/n + offset_angle is {value:.4g} degrees: nothing is left of the crank",
    value=_entry,
    limit=FLATTEST,
    unit="deg",
    remedy=lambda f: f"make offset_angle at least {FLATTEST - 180 / f.m.slots:g}",
)
CENTRES = Rule(
    "geneva.centre-distance",
    "centre_distance",
    lambda f: (
        f"a wheel of {f.m.rim:g} mm whose slots turn the crank by {2 * f.m.params.crank_half_angle:g} "
        f"degrees stands {f.m.axes:.4f} mm from the driver"
    ),
    value=lambda m: np.abs(m.axes - m.params.centre_distance),
    limit=LENGTH_SLACK,
    unit="mm",
    remedy=_other_wheel,
    must_be="at most",
    stage=Stage.MOTION,
    when=lambda m: (m.given.centre_distance is not None) & np.asarray(m.axes > 0),
    reported=lambda f: (f.m.given.centre_distance, f.m.axes),
)
ROLLERS = Rule(
    "geneva.rollers",
    "rollers",
    _rollers_message,
    value=_locked,
    limit=LEAST_LOCKED - ANGLE_SLACK,
    unit="deg",
    remedy=_fewer_rollers,
    reported=lambda f: (f.value, LEAST_LOCKED),
)
DRIVER_STOPS = Rule(
    "geneva.driver-stops",
    "driver_acceleration",
    lambda f: f"the driver stands still after {math.degrees(f.value):.4g} degrees of its turn",
    value=lambda m: m.driver.stops_at,
    limit=math.tau,
    unit="rad/s^2",
    remedy=_faster,
    must_be="above",
    stage=Stage.MOTION,
    when=lambda m: m.given.driver_law == "accelerating" and np.asarray(m.given.driver_acceleration) < 0,
    reported=_least_deceleration,
)
FLOOR = Rule(
    "geneva.floor",
    "floor",
    lambda f: (
        f"a floor of {f.m.params.floor:g} mm and a gap of {f.m.params.axial_gap:g} mm leave "
        f"{f.value:.3g} mm of the wheel's {f.m.params.thickness:g} mm for the rollers"
    ),
    value=lambda m: m.params.roller_length,
    limit=LEAST_FLOOR,
    unit="mm",
    remedy=_thinner_floor,
    when=lambda m: m.params.slots_made != "through",
    reported=lambda f: (f.m.params.floor, _greatest_floor(f.m)),
)

FEASIBLE = in_turn(
    LAW,
    all_of(
        all_of(STRAIGHT_HALF, STRAIGHT_OFFSET, when=lambda m: m.straight),
        in_turn(
            # Through the axis itself no force has a lever; where nothing is left of the crank it has none.
            BOTTOM_ANGLE.but(stage=Stage.MOTION, when=lambda m: np.asarray(_reach(m)) == 90),
            BOTTOM_ANGLE,
            ENTRY_ANGLE.but(stage=Stage.MOTION, when=lambda m: np.asarray(_entry(m)) <= 0),
            ENTRY_ANGLE,
            when=lambda m: not m.straight,
        ),
        CENTRES,
        # Strokes that do not overlap can be run.
        in_turn(ROLLERS.but(stage=Stage.MOTION, when=lambda m: np.asarray(_locked(m)) < 0), ROLLERS),
        DRIVER_STOPS,
        FLOOR,
    ),
)
"""What leaves nothing to compute, in order."""
