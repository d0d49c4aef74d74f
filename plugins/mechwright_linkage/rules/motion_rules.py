"""Rules of the motion: joints that make a machine, and an input that reaches what it is to."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, KinematicsError, Severity, Stage, refuse
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.linkage.kinematics.figures import least_transmission, worst_joint
from mechwright.mechanics.linkage.kinematics.period import (
    course_of,
    ends_of,
    interval_of,
    is_lever,
    range_of,
    sure_to_turn,
    turns_fully,
)
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.swing import LEAST_TRANSMISSION, TURN_BACK
from mechwright.tolerances import falls_short
from mechwright_linkage.rules.closure import closure_finding
from mechwright_linkage.table import LinkageTable

GOOD_TRANSMISSION = 30.0
"""Degrees below which a link mainly presses the next one into its bearings."""

Rule = DesignRule[LinkageTable]
Fails = Failure[LinkageTable]


def _doubtful(table: LinkageTable) -> Any:
    """Which linkages may not turn all the way; of one, always."""
    return np.array(True) if table.single or not table.may_turn else ~sure_to_turn(table)


def _joints(table: LinkageTable) -> Iterator[Finding]:
    """Whether links and joints make a machine of one degree of freedom."""
    key = table.key
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


def _ends(table: LinkageTable) -> Iterator[Finding]:
    """Ends of a stroke of a driver that turns, or of a swing of one that slides."""
    given, slides = table.given, table.driver_slides
    if given.stroke_from is not None and not slides:
        yield _no_such_ends("stroke_from", "turns", "swing_from and swing_to")
    if given.swing_from is not None and slides:
        yield _no_such_ends("swing_from", "slides", "stroke_from and stroke_to")


def _no_such_ends(key: str, does: str, others: str) -> Finding:
    other = key.replace("from", "to")
    return Finding.error(
        "linkage.ends",
        key,
        f"{key} is stated, and the driver {does}",
        remedy=f"leave {key} and {other} out, and state {others}",
        stage=Stage.MOTION,
        proposed=({f"parameters.{key}": None, f"parameters.{other}": None},),
    )


def _reach(table: LinkageTable) -> Iterator[Finding]:
    """Whether the links close somewhere, and over all of the way that the input is to go."""
    if not range_of(table).intervals:
        yield closure_finding(table)
    elif ends_of(table) is None and is_lever(table):
        yield _out_of_reach(table)


def _out_of_reach(table: LinkageTable) -> Finding:
    ways = [(one.low, one.high) for one in range_of(table).intervals]
    asked = table.requested
    if asked is None:
        return Finding.error(
            "linkage.closure",
            table.key,
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
    if table.driver_slides or table.requested is not None or turns_fully(table):
        return
    course, way = course_of(table), interval_of(table)
    low, high = sorted(math.degrees(end) for end in (course.start, course.start + course.travel))
    joints = {} if way is None else {one.joint: None for one in (way.low_limit, way.high_limit) if one}
    dead = f", up to the dead points of {' and '.join(joints)}" if joints else ""
    yield Finding.warning(
        "linkage.rotation",
        "swing_from",
        f"the driver cannot turn fully: it swings from {low:.3f} to {high:.3f} degrees{dead}",
        high - low,
        360.0,
        "deg",
        "state where it turns back with swing_from and swing_to, or change a length",
    )


def _changes(table: LinkageTable) -> Iterator[Finding]:
    """Positions in which nothing decides how the linkage goes on."""
    course, found = course_of(table), range_of(table).change_points
    low, high = sorted((course.start, course.start + course.travel))
    for one in found:
        turn = 0.0 if table.driver_slides else math.tau
        at = one.value + (turn * round(((low + high) / 2 - one.value) / turn) if turn else 0.0)
        if low <= at <= high:
            unit, shown = ("mm", at) if table.driver_slides else ("deg", math.degrees(at))
            yield Finding.error(
                "linkage.change-point",
                "swing_from",
                f"with the driver at {shown:.3f} {unit} the links at {one.joint} line up ({one.kind}), and "
                "nothing decides how they go on",
                shown,
                unit=unit,
                remedy="turn the driver back before that with swing_from and swing_to, or change a length",
            )
            return


def _degrees(table: LinkageTable) -> Any:
    return np.degrees(least_transmission(table))


TRANSMISSION = Rule(
    "linkage.transmission",
    lambda f: f.m.key,
    lambda f: f"the transmission angle at {worst_joint(f.m)} falls to {f.value:.3g} degrees",
    value=_degrees,
    limit=LEAST_TRANSMISSION,
    unit="deg",
    remedy=lambda f: (
        "give a shorter swing with swing_from and swing_to"
        if is_lever(f.m) and not f.m.driver_slides
        else "make the links behind the driver longer"
    ),
)
LOW_TRANSMISSION = TRANSMISSION.but(
    severity=Severity.WARNING,
    limit=GOOD_TRANSMISSION,
    when=lambda m: ~np.asarray(falls_short(_degrees(m), LEAST_TRANSMISSION)),
)

MOTION = in_turn(
    Procedure[LinkageTable](("linkage.joints",), _joints, common=True),
    Procedure[LinkageTable](("linkage.ends",), _ends, common=True),
    Procedure[LinkageTable](("linkage.closure", "linkage.swing", "linkage.stroke"), _reach, when=_doubtful),
)
"""All that a motion needs, in order."""

TRANSMISSIONS = all_of(
    Procedure[LinkageTable](("linkage.rotation",), _rotation, when=_doubtful),
    Procedure[LinkageTable](("linkage.change-point",), _changes, when=_doubtful),
    TRANSMISSION,
    LOW_TRANSMISSION,
)
"""How well the input drives the rest."""


def moving(table: LinkageTable) -> LinkageTable:
    """The linkage of a design; raises KinematicsError where these rules find an error of the motion."""
    refuse(MOTION.findings(table), Stage.MOTION, KinematicsError)
    return table
