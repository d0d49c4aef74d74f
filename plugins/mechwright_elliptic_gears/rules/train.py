"""Checks of what a train has beside its gears: point Q, joints, keyways or dowels, spacers."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Array, Bore, Finding
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.tolerances import exceeds, falls_short
from mechwright_elliptic_gears.kinematics.equations import phase_offset
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.bushes import bush_findings
from mechwright_elliptic_gears.parts.gear import ellipse_of, rack_of, room
from mechwright_elliptic_gears.parts.gear_parts import Gear, gear_opening, gears_of
from mechwright_elliptic_gears.parts.layout import DOWEL_GAP, Layout
from mechwright_elliptic_gears.rules.clamp import clamp_findings, setting_note
from mechwright_elliptic_gears.rules.pins import pin_findings, play_note

WALL = 0.5
"""Least wall between two openings, in diameters of the larger round one: the usual edge distance of a hole, a
diameter from its middle."""

SWEEP_GAP = 0.5
"""Least distance, mm, of a gear's tips from the spacer they sweep past: run-out and chips."""

PHASE_STEP = 1
"""Step, in degrees, in which a phase angle that works is sought."""


def train_findings(params: EllipticGearParams, *, noted: bool = True) -> Iterator[Finding]:
    """Point Q, then the train's own parts; ``noted`` with what the play of its joint does to the window."""
    off = list(_on_coupler(params))
    yield from off
    if params.stages == 1 or errors(off):
        return
    layout = Layout.of(params)
    found = [*_tracer(params, layout), *_joint(params, layout), *_sweep(params, layout)]
    found += _dowel_circle(params, layout) if params.dowelled else ()
    found += bush_findings(params)
    yield from found
    if errors(found):
        return
    if params.adjustable:
        pins = params.phase_joint == "pins"
        joint = list((pin_findings if pins else clamp_findings)(params))
        yield from joint
        if noted and not errors(joint):
            yield (play_note if pins else setting_note)(params)
        return
    turned = list(_turned_openings(params))
    yield from turned
    if not errors(turned):
        yield _phase_note(params)


def _on_coupler(params: EllipticGearParams) -> Iterator[Finding]:
    """Q within the coupler's length, and not farther beside it than half of that."""
    layout = Layout.of(params)
    most = layout.semi_major
    margin = _joint_margin(params, layout) if params.stages == 2 else 0.0
    for name, value, low, high, unit, inset in (
        ("point_along", params.point_along, 0.0, 1.0, "", margin if margin < 0.5 else 0.0),
        ("point_across", params.point_across, -most, most, "mm", 0.0),
    ):
        if not low <= value <= high:
            nearest = low + inset if value < low else high - inset
            yield Finding.error(
                "point.off-coupler",
                name,
                f"point Q is off the coupler, which reaches from {low:g} to {high:g} {unit}".rstrip(),
                value,
                nearest,
                unit,
                f"the nearest value that works is {nearest:g}",
            )


def _joint_margin(params: EllipticGearParams, layout: Layout) -> float:
    """How far from J or K, in lengths of the coupler, the hole at Q has a wall to the joint."""
    if layout.tracer == 0:
        return 0.0
    wanted = (layout.tracer + layout.pin) / 2 + WALL * max(layout.tracer, layout.pin)
    beside = math.sqrt(max(0.0, wanted**2 - params.point_across**2))
    return math.ceil(beside / (2 * layout.semi_major) * 1e4) / 1e4


def _tracer(params: EllipticGearParams, layout: Layout) -> Iterator[Finding]:
    if layout.tracer == 0:
        return
    if exceeds(layout.tracer, layout.pin):
        yield Finding.error(
            "train.tracer",
            "tracer_diameter",
            f"a hole of {layout.tracer:g} mm at Q leaves too little of the coupler, whose eyes are made for "
            f"pins of {layout.pin:g} mm",
            layout.tracer,
            layout.pin,
            "mm",
            f"make tracer_diameter at most {layout.pin:g}, or pin_diameter larger",
        )
        return
    margin = _joint_margin(params, layout)
    if margin >= 0.5:
        yield Finding.error(
            "train.tracer",
            "tracer_diameter",
            "there is no room for a hole between the joints",
            layout.tracer,
            0.0,
            "mm",
            "set tracer_diameter = 0, or make pin_diameter smaller",
        )
        return
    nearest = min(max(params.point_along, margin), 1 - margin)
    if nearest != params.point_along:
        yield Finding.error(
            "train.tracer",
            "point_along",
            f"the hole at Q runs into the joint {'J' if nearest == margin else 'K'}",
            params.point_along,
            nearest,
            remedy=f"the nearest value with a wall is {nearest:g}; or set tracer_diameter = 0",
        )


def _outwards(value: float, direction: float) -> float:
    """Rounded to four decimals, up, or down where ``direction`` is below 0."""
    return (math.floor if direction < 0 else math.ceil)(value * 1e4) / 1e4


def _joint(params: EllipticGearParams, layout: Layout) -> Iterator[Finding]:
    """The joint at the free focus: a wall to the bore, and a rim to the roots."""
    wanted = (layout.bore + layout.pin) / 2 + WALL * max(layout.pin, layout.bore)
    if falls_short(layout.focus, wanted):
        nearest = _outwards(wanted / (2 * layout.semi_major), 1)
        yield Finding.error(
            "train.joint",
            "eccentricity",
            f"the joint stands {layout.focus:.2f} mm from the shaft, and both holes need {wanted:.2f} mm",
            params.eccentricity,
            nearest,
            remedy=f"the nearest eccentricity with a wall is {nearest:g}; or make bore or pin_diameter "
            "smaller",
        )
    module = rack_of(params).module
    free = room(params, np.array([[layout.focus, 0.0]]))
    most = 2 * (free - LEAST_RIM * module)
    if exceeds(layout.pin, most):
        yield Finding.error(
            "train.joint-rim",
            "pin_diameter",
            f"{free - layout.pin / 2:.2f} mm stay between a joint of {layout.pin:g} mm and the nearest root",
            layout.pin,
            most,
            "mm",
            f"make pin_diameter at most {max(0.0, math.floor(most * 100) / 100):g}, or the gears larger",
        )


def _sweep(params: EllipticGearParams, layout: Layout) -> Iterator[Finding]:
    """The far vertex of gear 3 passes the tall spacer of gear 5."""
    gap = _sweep_gap(params, layout)
    if not falls_short(gap, SWEEP_GAP):
        return
    nearest = next(
        (
            e / 1000
            for e in range(math.ceil(params.eccentricity * 1000) - 1, -1, -1)
            if _sweep_gap(params.model_copy(update={"eccentricity": e / 1000}), layout) >= SWEEP_GAP
        ),
        None,
    )
    yield Finding.error(
        "train.sweep",
        "eccentricity",
        f"the tips of gear 3 come within {gap:.2f} mm of the spacer below gear 5",
        params.eccentricity,
        nearest,
        remedy="make bore smaller" + ("" if nearest is None else f", or eccentricity at most {nearest:g}"),
    )


def _sweep_gap(params: EllipticGearParams, layout: Layout) -> float:
    """From the tip at the far vertex to the spacer, mm; a smaller eccentricity has larger teeth."""
    tip = rack_of(params).addendum
    return ellipse_of(params).semi_major * (1 - params.eccentricity) - tip - layout.spacer / 2


def _dowel_circle(params: EllipticGearParams, layout: Layout) -> Iterator[Finding]:
    """The dowels stand outside the spacer, and inside the rim."""
    least = layout.spacer + layout.dowel + 2 * DOWEL_GAP
    if falls_short(layout.dowel_circle, least):
        yield Finding.error(
            "train.dowels",
            "dowel_circle",
            f"dowels of {layout.dowel:g} mm on a circle of {layout.dowel_circle:g} mm run into the spacer",
            layout.dowel_circle,
            least,
            "mm",
            f"make dowel_circle at least {least:g}",
        )
        return
    gear3 = next(gear for gear in gears_of(params) if gear.name == "gear-3")
    rim = _least_rim(params, gear3)
    module = rack_of(params).module
    if falls_short(rim, LEAST_RIM * module):
        yield Finding.error(
            "train.dowel-rim",
            "dowel_circle",
            f"{rim:.2f} mm stay between the dowels and the nearest root of gear 3, below a module",
            rim,
            LEAST_RIM * module,
            "mm",
            "make dowel_circle or dowel_diameter smaller, or the gears larger",
        )


def _least_rim(params: EllipticGearParams, gear: Gear) -> float:
    return min(
        room(params, np.array([hole.centre])) - hole.diameter / 2
        for hole in gear.holes
        if hole.name != "joint"
    )


def _turned_openings(params: EllipticGearParams) -> Iterator[Finding]:
    """Keyway or dowel holes of gear 4, which the phase angle turns: rim, and wall to the joint."""
    fault = _phase_fault(params)
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
    gear = next(gear for gear in gears_of(params) if gear.name == "gear-4")
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


def _wall(one: Bore, other: Bore) -> float:
    return math.dist(one.centre, other.centre) - (one.diameter + other.diameter) / 2


def _key_corners(params: EllipticGearParams, gear: Gear) -> Array:
    """Corners (n, 2), mm, of the opening that stand out of the bore."""
    loop = gear_opening(params, gear)
    assert loop is not None  # noqa: S101 - a keyed gear has a bore
    points = loop.flatten()
    out: Array = points[np.hypot(*points.T) > params.bore / 2 * (1 + 1e-9)]
    return out


def _phase_note(params: EllipticGearParams) -> Finding:
    """How gears 3 and 4 stand on their shaft, for the bench."""
    phase = params.phase_angle or 0.0
    turn = math.degrees(phase_offset(phase, params.eccentricity)) % 360
    what = "keyway" if params.keyway_width > 0 else "first dowel hole"
    return Finding.note(
        "train.phase",
        f"gear 4 stands {turn:.3f} degrees ahead of gear 3 on their shaft: its {what} lies "
        f"{-turn % 360:.3f} degrees counter-clockwise from its far vertex, seen from the coupler's side",
        turn,
        "deg",
    )
