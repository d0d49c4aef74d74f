"""Rules of the motion: joints that make a machine, and an input that reaches what it is to."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding, KinematicsError, Severity, Stage
from mechwright.contracts.design_rule import DesignRule, Failure, Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.swing import LEAST_TRANSMISSION, TURN_BACK
from mechwright_linkage.kinematics.linkage_table import LinkageTable
from mechwright_linkage.kinematics.period import ends_of, is_lever, ranges_of, requested, turns_fully

GOOD_TRANSMISSION = 30.0
"""Degrees below which a link mainly presses the next one into its bearings."""

Rule = DesignRule[LinkageTable]
Fails = Failure[LinkageTable]


def _joints(table: LinkageTable) -> Iterator[Finding]:
    """Whether links and joints make a machine of one degree of freedom."""
    key = table.given.table_name
    try:
        table.order  # noqa: B018 - it raises
    except KinematicsError as error:
        yield Finding.error(
            "linkage.joints",
            key,
            str(error),
            remedy="every dyad of two links has three joints: add or take away a link, a pin or a slide",
            stage=Stage.MOTION,
        )


def _reach(table: LinkageTable) -> Iterator[Finding]:
    """Whether the links close somewhere, and over all of the way that the input is to go."""
    ways = ranges_of(table)
    if not ways:
        yield Finding.error(
            "linkage.closure",
            table.given.table_name,
            "the links cannot be put together at any position of the input",
            remedy="make a link longer, or put its ends nearer to each other",
            stage=Stage.MOTION,
        )
    elif ends_of(table) is None and is_lever(table):
        yield _out_of_reach(table)


def _out_of_reach(table: LinkageTable) -> Finding:
    ways = [(one.low, one.high) for one in ranges_of(table)]
    asked = requested(table)
    if asked is None:
        return Finding.error(
            "linkage.closure",
            table.given.table_name,
            f"the links are within {math.degrees(TURN_BACK):g} degree of a dead point wherever the input "
            "stands",
            remedy="make a link longer, or put its ends nearer to each other",
            stage=Stage.MOTION,
        )
    if table.driver_slides:
        said = " or ".join(f"{low:.3f} to {high:.3f}" for low, high in ways)
        return Finding.error(
            "linkage.stroke",
            "stroke_to",
            f"the driver cannot slide from {asked[0]:g} to {asked[1]:g} mm: it reaches {said} mm",
            asked[1],
            unit="mm",
            remedy=f"keep stroke_from and stroke_to within {said}",
            stage=Stage.MOTION,
            proposed=({"parameters.stroke_from": None, "parameters.stroke_to": None},),
        )
    degrees = [(math.degrees(low), math.degrees(high)) for low, high in ways]
    one, two = (math.degrees(end) for end in asked)
    return swing.out_of_reach("linkage.swing", degrees, one, two, math.degrees(TURN_BACK))


def _rotation(table: LinkageTable) -> Iterator[Finding]:
    """A driver that cannot turn fully, where the design does not say between which angles it swings."""
    if table.driver_slides or requested(table) is not None or turns_fully(table):
        return
    ends = ends_of(table)
    assert ends is not None  # noqa: S101 - asked before
    low, high = sorted(math.degrees(end) for end in ends)
    here = next((one for one in ranges_of(table) if one.low <= math.radians((low + high) / 2) <= one.high), None)
    dead = "" if here is None else (
        f"; {here.low_joint} is at its dead point at {math.degrees(here.low):.3f} degrees and "
        f"{here.high_joint} at {math.degrees(here.high):.3f}"
    )
    yield Finding.warning(
        "linkage.rotation",
        "swing_from",
        f"the driver cannot turn fully: it swings from {low:.3f} to {high:.3f} degrees{dead}",
        high - low,
        360.0,
        "deg",
        "state where it turns back with swing_from and swing_to, or change a length",
    )


def least_transmission(table: LinkageTable) -> object:
    """The least transmission angle over the way of the input, degrees; a number or a column."""
    return np.degrees(table.least_sine_angle)


TRANSMISSION = Rule(
    "linkage.transmission",
    lambda f: f.m.given.table_name,
    lambda f: f"the transmission angle at {f.m.worst_joint} falls to {f.value:.3g} degrees",
    value=least_transmission,
    limit=LEAST_TRANSMISSION,
    unit="deg",
    remedy=lambda f: "give a shorter swing with swing_from and swing_to"
    if is_lever(f.m) and not f.m.driver_slides
    else "make the links behind the driver longer",
)
LOW_TRANSMISSION = TRANSMISSION.but(
    severity=Severity.WARNING,
    limit=GOOD_TRANSMISSION,
    when=lambda m: np.asarray(least_transmission(m)) >= LEAST_TRANSMISSION,
)

MOTION = in_turn(
    Procedure[LinkageTable](("linkage.joints",), _joints, common=True),
    Procedure[LinkageTable](("linkage.closure", "linkage.swing", "linkage.stroke"), _reach),
)
"""All that a motion needs, in order."""

TRANSMISSIONS = all_of(
    Procedure[LinkageTable](("linkage.rotation",), _rotation),
    TRANSMISSION,
    LOW_TRANSMISSION,
)
"""How well the input drives the rest."""
