"""Rules of bores, slots and the point: whether links leave material between them."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from mechwright import Finding, Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import at_stage
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.linkage.clamp_findings import no_clamp, too_near
from mechwright.mechanics.linkage.rules.part_rules import bushing_rule, least_wall
from mechwright.mechanics.linkage.setting_findings import Places
from mechwright.tolerances import falls_short
from mechwright_five_bar.kinematics.phases import set_joints
from mechwright_five_bar.parts.hardware import clamp_of_design
from mechwright_five_bar.parts.joints import slotted
from mechwright_five_bar.table import FiveBarTable

Rule = DesignRule[FiveBarTable]
Fails = Failure[FiveBarTable]


def _end_bore(joint: str) -> Callable[[FiveBarTable], Any]:
    """Diameter of a link's bore at joint A or C, mm: a stud turns in it, or a pin is pressed in."""

    def bore(m: FiveBarTable) -> Any:
        in_slots = m.params.phases and [[slotted(one.params, joint)] for one in m.each_shape()]
        return np.where(in_slots or False, m.bore, m.params.pin_diameter)

    return bore


def _link_rule(name: str, bores: Callable[[FiveBarTable], Any]) -> Rule:
    """Of a link with two bores, by the sum of their diameters."""
    return Rule(
        "five-bar.bores",
        name,
        f"the bores of the {name} are {{value:.4g}} mm apart and leave less than the rim of "
        "{m.params.rim:g} mm",
        value=lambda m: getattr(m.params, name),
        limit=lambda m: bores(m) / 2 + m.params.rim,
        unit="mm",
        remedy=lambda f: (
            f"make {name} at least {math.ceil(f.limit * 1e4) / 1e4:g}, or take smaller pins, bushings or rims"
        ),
    )


def places_of(m: FiveBarTable) -> Places:
    """Openings of the coupler of one linkage."""
    ways = set_joints(m.params)
    return Places((ways["A"], ways["C"]), m.params.coupler_point, m.bore, m.params.pin_diameter)


def _least_land(m: FiveBarTable) -> Any:
    """The least material between two bores of a coupler that is not set, mm."""
    coupler, point, both = m.params.coupler, m.params.coupler_point, (m.bore + m.params.pin_diameter) / 2
    lands = (coupler - m.bore, np.abs(point) - both, np.abs(coupler - point) - both)
    return np.minimum(np.minimum(*lands[:2]), lands[2])


def _between_phases(m: FiveBarTable) -> Iterator[Finding]:
    """Whether holes, slots and the point of several phases leave material between them in the coupler."""
    params, places = m.params, places_of(m)
    if clamp_of_design(params) is None and places.slotted:
        yield no_clamp("five-bar.phases", params.pin_diameter, params.thickness)
    elif falls_short(places.nearest.land, params.rim):
        yield too_near("five-bar.phases", places.nearest, params.rim, params.pin_diameter)


def _nearest_message(f: Fails) -> str:
    gap = places_of(f.m).nearest
    return (
        f"{gap.what} are {gap.distance:.4g} mm apart in the coupler and leave less than the rim of "
        f"{f.m.params.rim:g} mm"
    )


def _distance(f: Fails) -> tuple[float, float]:
    gap = places_of(f.m).nearest
    return gap.distance, gap.walls + f.m.params.rim


BUSHINGS: Rule = bushing_rule("five-bar").but(
    code="five-bar.bushing-wall",
    reported=lambda f: (f.m.params.bushing_wall, least_wall(f.m)),
)

ROOM = in_turn(
    BUSHINGS,
    all_of(
        _link_rule("crank", lambda m: m.params.pin_diameter + _end_bore("A")(m)),
        _link_rule("arm", lambda m: 2 * m.params.pin_diameter),
        _link_rule("rocker", lambda m: m.bore + _end_bore("C")(m)),
    ),
    Rule(
        "five-bar.bores",
        lambda f: "coupler_point_x" if (all_ := places_of(f.m)).nearest in all_.to_point else "coupler",
        _nearest_message,
        value=_least_land,
        limit=lambda m: m.params.rim,
        unit="mm",
        remedy="move the point, lengthen the coupler, or take smaller pins, bushings or rims",
        when=lambda m: not m.params.phases,
        reported=_distance,
    ),
    Procedure[FiveBarTable](
        ("five-bar.phases",),
        lambda m: at_stage(Stage.PARTS, _between_phases(m)),
        when=lambda m: bool(m.params.phases),
    ),
)
"""Of the bushings, the links, then of the coupler."""
