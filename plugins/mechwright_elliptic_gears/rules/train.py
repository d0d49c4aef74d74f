"""Rules of what a train has beside its gears: point Q, joints, keyways or dowels, spacers."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Array, Bore, Finding, Stage, at_stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import number, plain
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.mechanics.openings import opening_of
from mechwright.tolerances import falls_short
from mechwright_elliptic_gears.kinematics.ellipse import perimeter_of
from mechwright_elliptic_gears.kinematics.equations import phase_offsets
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import rack_of, room
from mechwright_elliptic_gears.parts.gear_parts import Gear, gear_opening, gears_of
from mechwright_elliptic_gears.parts.layout import DOWELS
from mechwright_elliptic_gears.rules.bushings import BUSHES
from mechwright_elliptic_gears.rules.clamp import CLAMP
from mechwright_elliptic_gears.rules.pins import DOWEL_SPACER, PINS, ahead
from mechwright_elliptic_gears.table import GearTable

WALL = 0.5
"""Least wall between two openings, in diameters of the larger round one: the usual edge distance of a hole, a
diameter from its middle."""

SWEEP_GAP = 0.5
"""Least distance, mm, of a gear's tips from the spacer they sweep past: run-out and chips."""

PHASE_STEP = 1
"""Step, in degrees, in which a phase angle that works is sought."""

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def _joint_margin(m: GearTable) -> Any:
    """How far from J or K, in lengths of the coupler, the hole at Q has a wall to the joint."""
    if m.given.stages == 1:
        return 0.0
    layout = m.layout
    due = (layout.tracer + layout.pin) / 2 + WALL * np.maximum(layout.tracer, layout.pin)
    beside = np.sqrt(np.maximum(0.0, due**2 - m.given.point_across**2))
    return np.where(layout.tracer == 0, 0.0, np.ceil(beside / (2 * layout.semi_major) * 1e4) / 1e4)


def _on_coupler(key: str, unit: str) -> Rule:
    """Q within the coupler's length, and not farther beside it than half of that."""

    def ends(m: GearTable) -> tuple[Any, Any]:
        return (0.0, 1.0) if key == "point_along" else (-m.semi_major, m.semi_major)

    def outside(m: GearTable) -> Any:
        (low, high), value = ends(m), getattr(m.given, key)
        return np.maximum(low - value, value - high)

    def nearest(f: Fails) -> tuple[float, float]:
        (low, high), value = ends(f.m), getattr(f.m.given, key)
        margin = float(_joint_margin(f.m))
        inset = margin if key == "point_along" and margin < 0.5 else 0.0
        return value, low + inset if value < low else high - inset

    def message(f: Fails) -> str:
        low, high = ends(f.m)
        return f"point Q is off the coupler, which reaches from {low:g} to {high:g} {unit}".rstrip()

    return Rule(
        "point.off-coupler",
        key,
        message,
        value=outside,
        limit=0.0,
        unit=unit,
        remedy=lambda f: f"the nearest value that works is {nearest(f)[1]:g}",
        must_be="at most",
        reported=nearest,
    )


POINT = all_of(_on_coupler("point_along", ""), _on_coupler("point_across", "mm"))
"""Point Q, of pairs too."""


def _bored(m: GearTable) -> Any:
    return np.asarray(m.layout.tracer) != 0


def _off_joints(m: GearTable) -> Any:
    """The nearest place along the coupler at which the hole at Q has a wall to the joints."""
    margin = _joint_margin(m)
    return np.minimum(np.maximum(m.given.point_along, margin), 1 - margin)


TRACER = in_turn(
    Rule(
        "train.tracer",
        "tracer_diameter",
        "a hole of {value:g} mm at Q leaves too little of the coupler, whose eyes are made for pins of "
        "{limit:g} mm",
        value=lambda m: m.layout.tracer,
        limit=lambda m: m.layout.pin,
        unit="mm",
        remedy="make tracer_diameter at most {limit:g}, or pin_diameter larger",
        must_be="at most",
        when=_bored,
    ),
    Rule(
        "train.tracer",
        "tracer_diameter",
        "there is no room for a hole between the joints",
        value=_joint_margin,
        limit=0.5,
        unit="mm",
        remedy="set tracer_diameter = 0, or make pin_diameter smaller",
        must_be="below",
        when=_bored,
        reported=lambda f: (f.m.layout.tracer, 0.0),
    ),
    Rule(
        "train.tracer",
        "point_along",
        lambda f: f"the hole at Q runs into the joint {'J' if f.m.given.point_along < 0.5 else 'K'}",
        value=lambda m: np.abs(_off_joints(m) - m.given.point_along),
        limit=0.0,
        remedy=lambda f: f"the nearest value with a wall is {_off_joints(f.m):g}; or set tracer_diameter = 0",
        must_be="at most",
        when=_bored,
        reported=lambda f: (f.m.given.point_along, float(_off_joints(f.m))),
    ),
)


def _walled(f: Fails) -> float:
    """The least eccentricity with a wall between the holes of shaft and joint."""
    return math.ceil(f.limit / (2 * f.m.layout.semi_major) * 1e4) / 1e4


JOINT = Rule(
    "train.joint",
    "eccentricity",
    "the joint stands {value:.2f} mm from the shaft, and both holes need {limit:.2f} mm",
    value=lambda m: m.layout.focus,
    limit=lambda m: (m.layout.bore + m.layout.pin) / 2 + WALL * np.maximum(m.layout.pin, m.layout.bore),
    remedy=lambda f: (
        f"the nearest eccentricity with a wall is {_walled(f):g}; or make bore or pin_diameter smaller"
    ),
    reported=lambda f: (f.m.given.eccentricity, _walled(f)),
)
JOINT_RIM = Rule(
    "train.joint-rim",
    "pin_diameter",
    lambda f: (
        f"{f.m.root_distance - f.value / 2:.2f} mm stay between a joint of {f.value:g} mm and the nearest "
        "root"
    ),
    value=lambda m: m.layout.pin,
    # The free focus is as far from its vertex as the axis is from the other.
    limit=lambda m: 2 * (m.root_distance - LEAST_RIM * m.module),
    unit="mm",
    remedy=lambda f: (
        f"make pin_diameter at most {max(0.0, math.floor(f.limit * 100) / 100):g}, or the gears larger"
    ),
    must_be="at most",
)


def _sweep_gap(m: GearTable, e: Any) -> Any:
    """From the tip at the far vertex of gear 3 to the tall spacer of gear 5, mm, at an eccentricity."""
    given, share = m.given, perimeter_of(e) / (math.pi * m.given.teeth)
    a = m.module / share if given.semi_major is None else given.semi_major
    tip = given.addendum * a * share
    return a * (1 - e) - tip - m.layout.spacer / 2


def _rounder(m: GearTable) -> float | None:
    """The greatest smaller eccentricity, to 0.001, with which the tips pass the spacer."""
    tried = np.arange(math.ceil(m.given.eccentricity * 1000) - 1, -1, -1) / 1000
    works = np.flatnonzero(_sweep_gap(m, tried) >= SWEEP_GAP)
    return float(tried[works[0]]) if works.size else None


SWEEP = Rule(
    "train.sweep",
    "eccentricity",
    "the tips of gear 3 come within {value:.2f} mm of the spacer below gear 5",
    value=lambda m: _sweep_gap(m, m.given.eccentricity),
    limit=SWEEP_GAP,
    remedy=lambda f: (
        "make bore smaller" + ("" if (e := _rounder(f.m)) is None else f", or eccentricity at most {e:g}")
    ),
    reported=lambda f: (f.m.given.eccentricity, _rounder(f.m)),
)


def _least_rim(params: EllipticGearParams, gear: Gear) -> float:
    return min(
        room(params, np.array([hole.centre])) - hole.diameter / 2
        for hole in gear.holes
        if hole.name != "joint"
    )


def _gear(params: EllipticGearParams, name: str) -> Gear:
    return next(gear for gear in gears_of(params) if gear.name == name)


def _dowel_places(m: GearTable, turn: Any) -> tuple[Array, Array]:
    """X and y (n, 3), mm, of the dowels, turned by an angle, rad."""
    angles, radius = np.array([*DOWELS.values()]) + turn, m.layout.dowel_circle / 2
    return radius * np.cos(angles), radius * np.sin(angles)


DOWEL_RIM = Rule(
    "train.dowel-rim",
    "dowel_circle",
    "{value:.2f} mm stay between the dowels and the nearest root of gear 3, below a module",
    value=lambda m: number(m.root_depth(*_dowel_places(m, 0.0)) - m.layout.dowel / 2),
    limit=lambda m: LEAST_RIM * m.module,
    unit="mm",
    remedy="make dowel_circle or dowel_diameter smaller, or the gears larger",
)


def _turned_openings(m: GearTable) -> Iterator[Finding]:
    """Keyway or dowel holes of gear 4, which the phase angle turns: rim, and wall to the joint."""
    params, fault = m.given, _phase_fault(m.given)
    if fault is None:
        return
    given = math.degrees(params.phase_angle or 0.0)
    nearest = None
    for step in range(PHASE_STEP, 181, PHASE_STEP):
        near = [(given + sign * step) % 360 for sign in (-1, 1)]
        works = [phase for phase in near if _phase_fault(params.model_copy(update={"phase": phase})) is None]
        if works:
            nearest = works[0]
            break
    smaller = "keyway_width or bore" if params.keyway_width > 0 else "dowel_circle or dowel_diameter"
    yield Finding.error(
        "train.phase",
        "phase",
        fault,
        given,
        nearest,
        "deg",
        f"make {smaller} smaller"
        + ("" if nearest is None else f"; the nearest phase that works is {nearest:g} degrees"),
    )


def _phase_fault(params: EllipticGearParams) -> str | None:
    """What stands in the way of gear 4's keyway or dowels at this phase angle."""
    gear = _gear(params, "gear-4")
    joint = next(hole for hole in gear.holes if hole.name == "joint")
    module = rack_of(params).module
    what = "keyway" if gear.key is not None else "dowels"
    if gear.key is not None:
        corners = _key_corners(params, gear)
        wall = float(np.hypot(*(corners - joint.centre).T).min()) - joint.diameter / 2
        rim = room(params, corners)
    else:
        holes = [hole for hole in gear.holes if hole is not joint]
        wall = min(_wall(joint, hole) for hole in holes)
        rim = _least_rim(params, gear)
    for left, due, where in (
        (wall, WALL * joint.diameter, "its joint"),
        (rim, LEAST_RIM * module, "its nearest root"),
    ):
        if falls_short(left, due):
            return (
                f"{max(left, 0.0):.2f} mm stay between the {what} of gear 4 and {where}, below {due:.2f} mm"
            )
    return None


def _may_clash(m: GearTable) -> Any:
    """Whether the openings of gear 4 may come near to its joint or a root (n, 1), by discs that hold them."""
    layout, joint = m.layout, m.layout.pin
    phase = np.radians(m.given.phase_degrees)
    back = -phase_offsets(phase, m.given.eccentricity)
    if m.given.dowelled:
        x, y = _dowel_places(m, back)
        held = layout.dowel / 2
    else:
        opening = opening_of(plain(m.given, 0, m.size))
        assert opening is not None  # noqa: S101 - a keyed gear has a bore
        # Its keyway, from where it leaves the bore, in a disc about the middle of its mouth.
        radius, half = layout.bore / 2, opening.width / 2
        into = radius - np.sqrt(np.maximum(radius**2 - half**2, 0.0))
        held = np.hypot(np.maximum(opening.depth, into), half) + opening.relief
        x, y = radius * np.cos(back), radius * np.sin(back)
    wall: Any = np.hypot(x - layout.focus, y).min(axis=-1, keepdims=True) - held - joint / 2
    rim: Any = m.root_depth(x, y) - held
    return falls_short(wall, WALL * joint) | falls_short(rim, LEAST_RIM * m.module)


def _wall(one: Bore, other: Bore) -> float:
    return math.dist(one.centre, other.centre) - (one.diameter + other.diameter) / 2


def _key_corners(params: EllipticGearParams, gear: Gear) -> Array:
    """Corners (n, 2), mm, of the opening that stand out of the bore."""
    loop = gear_opening(params, gear)
    assert loop is not None  # noqa: S101 - a keyed gear has a bore
    points = loop.flatten()
    out: Array = points[np.hypot(*points.T) > params.bore / 2 * (1 + 1e-9)]
    return out


def _phase_message(m: GearTable) -> str:
    """How gears 3 and 4 stand on their shaft, for the bench."""
    what, turn = "keyway" if m.given.keyway_width > 0 else "first dowel hole", ahead(m)
    return (
        f"gear 4 stands {turn:.3f} degrees ahead of gear 3 on their shaft: its {what} lies "
        f"{-turn % 360:.3f} degrees counter-clockwise from its far vertex, seen from the coupler's side"
    )


TRAIN = in_turn(
    all_of(
        TRACER,
        JOINT,
        JOINT_RIM,
        SWEEP,
        in_turn(DOWEL_SPACER, DOWEL_RIM, when=lambda m: m.given.dowelled),
        BUSHES,
    ),
    in_turn(PINS, when=lambda m: m.given.phase_joint == "pins"),
    in_turn(CLAMP, when=lambda m: m.given.phase_joint == "clamp"),
    in_turn(
        Procedure[GearTable](
            ("train.phase",),
            lambda m: at_stage(Stage.PARTS, _turned_openings(m)),
            stage=Stage.PARTS,
            when=_may_clash,
        ),
        Note[GearTable]("train.phase", _phase_message, ahead, "deg"),
        when=lambda m: not m.given.adjustable,
    ),
    when=lambda m: m.given.stages == 2,
)
"""A train's own parts, joints, and how its phase is set."""
