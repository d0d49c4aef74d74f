"""Rules of the motion: whether the links can be joined, how far the crank goes, the transmission angle."""

import math
from typing import Any

import numpy as np

from mechwright import Finding, Severity, Stage
from mechwright.contracts.design_rule import DesignRule, Failure, no_figures
from mechwright.contracts.design_table import column
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import in_turn
from mechwright.mechanics.linkage.kinematics.period import course_of
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.swing import LEAST_TRANSMISSION, TURN_BACK
from mechwright_five_bar.kinematics.reach import reach
from mechwright_five_bar.table import FiveBarTable, ways_of

GOOD_TRANSMISSION = 40.0
"""Degrees below which the coupler mainly presses the rocker into its bearing (VDI 2127: 40 to 50)."""

Rule = DesignRule[FiveBarTable]
Fails = Failure[FiveBarTable]


def _gap(m: FiveBarTable) -> float:
    """Distance of A and B1 where crank and arm point to each other, mm."""
    return m.params.ground - m.params.crank - m.params.arm


def _are_short(m: FiveBarTable) -> bool:
    return m.params.coupler + m.params.rocker <= _gap(m)


CLOSURE = Rule(
    "five-bar.closure",
    "coupler",
    lambda f: (
        "the links cannot be joined wherever the crank stands: coupler and rocker of "
        f"{f.m.params.coupler:g} and {f.m.params.rocker:g} mm are too "
        f"{'short' if _are_short(f.m) else 'unlike'} for crank, arm and ground"
    ),
    value=lambda m: m.closure,
    limit=0.0,
    unit="mm",
    remedy=lambda f: (
        f"make coupler and rocker longer than {_gap(f.m):g} mm together"
        if _are_short(f.m)
        else "make coupler and rocker more alike"
    ),
    stage=Stage.MOTION,
    reported=lambda f: (f.m.params.coupler, None),
)


def _out_of_reach(f: Fails) -> Finding:
    """A swing that the links do not reach."""
    params = f.m.params
    one, two = params.swing_from or 0.0, params.swing_to or 0.0
    return swing.out_of_reach("five-bar.swing", ways_of(f.m), one, two, math.degrees(TURN_BACK))


SWING = Rule(
    "five-bar.swing",
    lambda f: _out_of_reach(f).parameter,
    lambda f: _out_of_reach(f).message,
    value=lambda m: m.reaches,
    limit=1,
    unit="deg",
    remedy=lambda f: _out_of_reach(f).remedy,
    stage=Stage.MOTION,
    when=lambda m: m.is_lever,
    reported=lambda f: (_out_of_reach(f).value, _out_of_reach(f).limit),
    proposed=lambda f: _out_of_reach(f).proposed,
)


def _can_run(m: FiveBarTable) -> Any:
    """Whether a phase can be joined and reaches its swing."""
    return (np.asarray(m.closure) >= 0) & (~np.asarray(m.is_lever) | m.reaches)


def _phases_run(m: FiveBarTable) -> Any:
    found = [column(_can_run(one), m.size) for one in m.phases]
    return np.concatenate(found, axis=1)[0 if m.single else slice(None)]


def _phase_message(f: Fails) -> str:
    other = f.m.phases[f.item]
    params = other.params
    said = " or ".join(f"{low:.3f} to {high:.3f}" for low, high in ways_of(other)) or "nowhere"
    return (
        f"the phase that is set with the crank at {params.setting_angle or 0:g} degrees reaches crank "
        f"angles from {said}, not from {params.swing_from or 0:g} to {params.swing_to or 0:g} degrees"
    )


OTHER_PHASES = Rule(
    "five-bar.swing",
    "phases",
    _phase_message,
    value=_phases_run,
    limit=1,
    remedy="give that phase its own swing_from and swing_to within them, or other turns",
    stage=Stage.MOTION,
    when=lambda m: bool(m.params.phases),
    reported=no_figures,
    each=False,
)


def _ends(m: FiveBarTable) -> list[float]:
    return sorted(math.degrees(end) for end in m.ends)


ROTATION = Rule(
    "five-bar.rotation",
    "crank",
    lambda f: (
        f"the crank of {f.m.params.crank:g} mm cannot turn fully: it is a lever that swings from "
        f"{_ends(f.m)[0]:.3f} to {_ends(f.m)[1]:.3f} degrees"
    ),
    value=lambda m: m.turns_fully,
    limit=1,
    unit="mm",
    remedy="say where it turns back with swing_from and swing_to, or make crank and arm shorter",
    stage=Stage.MOTION,
    severity=Severity.WARNING,
    when=lambda m: m.requested is None,
    reported=lambda f: (f.m.params.crank, None),
    proposed=lambda f: (
        {
            f"parameters.swing_{name}": round(end, 1)
            for name, end in zip(("from", "to"), _ends(f.m), strict=True)
        },
    ),
)


def _shorter_swing(f: Fails) -> tuple[Change, ...]:
    """As much of a lever's swing as keeps a good transmission angle."""
    if not f.m.is_lever:
        return ()
    course, period = course_of(f.m), math.tau * f.m.bar.turns
    start, end = course.start, course.start + course.travel
    ways = (
        swing.beside(way, (start + end) / 2, period)
        for way in reach(f.m.bar, math.radians(GOOD_TRANSMISSION))
    )
    turned = [(math.degrees(low), math.degrees(high)) for low, high in ways]
    return swing.shortened(turned, math.degrees(start), math.degrees(end))


TRANSMISSION = Rule(
    "five-bar.transmission",
    "coupler",
    "the transmission angle falls to {value:.3g} degrees",
    value=lambda m: np.degrees(m.transmission[0]),
    limit=GOOD_TRANSMISSION,
    unit="deg",
    remedy=lambda f: (
        "give a shorter swing with swing_from and swing_to"
        if f.m.is_lever
        else "make crank and arm shorter, or change coupler and rocker"
    ),
    severity=Severity.WARNING,
    proposed=_shorter_swing,
)


def _motion_message(m: FiveBarTable) -> str:
    least, most = (math.degrees(one) for one in m.transmission)
    way = (
        f"a lever that swings by {math.degrees(abs(m.ends[1] - m.ends[0])):.3f} degrees there and back"
        if m.is_lever
        else f"the crank turns fully, and after {m.bar.turns} turns all is as before"
    )
    return f"{way}; transmission angle {least:.3f} to {most:.3f} degrees"


RUNS = in_turn(
    in_turn(CLOSURE, SWING, OTHER_PHASES),
    ROTATION,
    in_turn(TRANSMISSION.but(severity=Severity.ERROR, limit=LEAST_TRANSMISSION), TRANSMISSION),
)
"""What keeps the linkage from running, or running well, in order."""

MOTION_NOTE = Note[FiveBarTable](
    "five-bar.motion", _motion_message, lambda m: math.degrees(m.transmission[0]), "deg", stage=Stage.MOTION
)
