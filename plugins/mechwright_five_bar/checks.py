"""What an engineer would object to in a five-bar, and the figures worth knowing.

Each group needs what the groups before it have found to be sound, so the first group with an error ends the
list.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import combinations

from mechwright import Finding, GeometryError, Severity, Stage, kept, of_stage, until_error
from mechwright.contracts.finding import Change
from mechwright.mechanics.gearing.usual import chosen
from mechwright.mechanics.linkage import bushing_findings
from mechwright.mechanics.linkage.usual import told
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.swing import LEAST_TRANSMISSION, TURN_BACK
from mechwright.mechanics.strength.bearings_life import SINTERED_PRESSURE
from mechwright.mechanics.strength.judging import SLOWEST
from mechwright.mechanics.strength.pressure import most_pressed, too_pressed
from mechwright.tolerances import falls_short
from mechwright_five_bar.clamp_checks import clamps_hold, places_apart
from mechwright_five_bar.frames import layout_of
from mechwright_five_bar.joints import bosses_of
from mechwright_five_bar.limits import USUAL_FACE
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import JOINTS, loads_of
from mechwright_five_bar.phases import phases_of
from mechwright_five_bar.reach import (
    bar_of,
    course_of,
    is_lever,
    reach,
    transmission_of,
    turns_fully,
    ways_about,
    within,
)
from mechwright_five_bar.strength_checks import teeth_bear, teeth_judged
from mechwright_five_bar.train import train_of
from mechwright_five_bar.usual import USUAL, USUAL_TEETH, modules

GOOD_TRANSMISSION = 40.0
"""Degrees below which the coupler mainly presses the rocker into its bearing (VDI 2127: 40 to 50)."""


@kept
def findings(params: FiveBarParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design that shows its first phase.

    No error among it means that the parts can be built.
    """
    return until_error(params, sound, _bearings, teeth_bear, clamps_hold)


@kept
def judged(params: FiveBarParams) -> tuple[Finding, ...]:
    """The same without the sizes that would bear a load."""
    return until_error(params, sound, _bearings, teeth_judged, clamps_hold)


@kept
def sound(params: FiveBarParams) -> tuple[Finding, ...]:
    """What is to be said of the motion and of the shapes, before any load."""
    bushings = partial(bushing_findings, "five-bar.bushing-wall")
    return until_error(
        params, _joined, _lever, _transmission, _gears, bushings, _room, places_apart, _layers, _figures
    )


def _joined(params: FiveBarParams) -> Iterator[Finding]:
    """Whether the loop closes, and where the crank shall go: all that a motion needs."""
    bar = bar_of(params)
    if not reach(bar, TURN_BACK):
        span = params.coupler + params.rocker
        far = params.ground - params.crank - params.arm
        short = span <= far
        yield Finding.error(
            "five-bar.closure",
            "coupler",
            "the links cannot be joined wherever the crank stands: coupler and rocker of "
            f"{params.coupler:g} and "
            f"{params.rocker:g} mm are too {'short' if short else 'unlike'} for crank, arm and ground",
            params.coupler,
            unit="mm",
            remedy=f"make coupler and rocker longer than {far:g} mm together" if short else
            "make coupler and rocker more alike",
        )  # fmt: skip
    elif is_lever(params) and within(params) is None:
        yield _out_of_reach(params)
    else:
        yield from _others(params)


def _others(params: FiveBarParams) -> Iterator[Finding]:
    """Whether the other phases, for which the plates are laid out as well, can be joined and reach."""
    for other in phases_of(params)[1:]:
        ways = reach(bar_of(other), TURN_BACK)
        if not ways or (is_lever(other) and within(other) is None):
            at = f"with the crank at {other.setting_angle or 0:g} degrees"
            said = " or ".join(f"{low:.3f} to {high:.3f}" for low, high in ways_about(other)) or "nowhere"
            yield Finding.error(
                "five-bar.swing",
                "phases",
                f"the phase that is set {at} reaches crank angles from {said}, not from "
                f"{other.swing_from or 0:g} to {other.swing_to or 0:g} degrees",
                remedy="give that phase its own swing_from and swing_to within them, or other turns",
            )
            return


def _out_of_reach(params: FiveBarParams) -> Finding:
    """A swing that the links do not reach."""
    assert params.swing_from is not None and params.swing_to is not None  # noqa: S101, PT018
    ways = ways_about(params)
    return swing.out_of_reach(
        "five-bar.swing", ways, params.swing_from, params.swing_to, math.degrees(TURN_BACK)
    )


def _lever(params: FiveBarParams) -> Iterator[Finding]:
    """Whether a crank that nobody asked to swing has to."""
    if params.swing_from is not None or turns_fully(bar_of(params)):
        return
    course = course_of(params)
    ends = sorted((math.degrees(course.start), math.degrees(course.start + course.travel)))
    yield Finding.warning(
        "five-bar.rotation",
        "crank",
        f"the crank of {params.crank:g} mm cannot turn fully: it is a lever that swings from {ends[0]:.3f} "
        "to "
        f"{ends[1]:.3f} degrees",
        params.crank,
        unit="mm",
        remedy="say where it turns back with swing_from and swing_to, or make crank and arm shorter",
        proposed=({"parameters.swing_from": round(ends[0], 1), "parameters.swing_to": round(ends[1], 1)},),
    )


def _transmission(params: FiveBarParams) -> Iterator[Finding]:
    angle = math.degrees(transmission_of(params)[0])
    if not falls_short(angle, GOOD_TRANSMISSION):
        return
    jams = falls_short(angle, LEAST_TRANSMISSION)
    yield Finding(
        "five-bar.transmission",
        Severity.ERROR if jams else Severity.WARNING,
        "coupler",
        f"the transmission angle falls to {angle:.3g} degrees",
        angle,
        LEAST_TRANSMISSION if jams else GOOD_TRANSMISSION,
        "deg",
        "give a shorter swing with swing_from and swing_to"
        if is_lever(params)
        else "make crank and arm shorter, or change coupler and rocker",
        Stage.PARTS,
        _shorter_swing(params) if is_lever(params) else (),
    )


def _shorter_swing(params: FiveBarParams) -> tuple[Change, ...]:
    """As much of a lever's swing as keeps a good transmission angle."""
    bar, course = bar_of(params), course_of(params)
    start, end = course.start, course.start + course.travel
    period = math.tau * bar.turns
    ways = [
        swing.beside(way, (start + end) / 2, period) for way in reach(bar, math.radians(GOOD_TRANSMISSION))
    ]
    turned = [(math.degrees(low), math.degrees(high)) for low, high in ways]
    return swing.shortened(turned, math.degrees(start), math.degrees(end))


@of_stage(Stage.PARTS)
def _gears(params: FiveBarParams) -> Iterator[Finding]:
    try:
        train = train_of(params)
    except GeometryError as error:
        yield replace(_named("five-bar.gears", error), proposed=tuple(_nearest(params)))
        return
    sizes = ", ".join(f"{name} {count}" for name, count in train.teeth.items())
    yield Finding.note(
        "five-bar.gears",
        f"gears of module {train.module:.6g} mm with teeth {sizes}: the arm turns {params.ratio:g} times "
        "as far as "
        f"the crank",
        train.module,
        "mm",
    )


def _nearest(params: FiveBarParams) -> Iterator[Change]:
    """The module nearest to the one that is given with which the gears stand, and none."""
    least, most = modules(params.ground, params.crank_teeth, params.idler_teeth, params.arm_teeth)
    if params.module is None:
        return
    if least < most:
        up = params.module < least
        step = math.ceil(least * _THOUSANDTHS) if up else math.floor(most * _THOUSANDTHS)
        yield {"parameters.module": step / _THOUSANDTHS}
    yield {"parameters.module": None}


_THOUSANDTHS = 1000
"""Of a millimetre: a module that is proposed is rounded so."""


def _named(code: str, error: GeometryError, remedy: str = "") -> Finding:
    """An error whose message begins with the parameter that it is about, and may end in what to do."""
    parameter, _, said = str(error).partition(": ")
    if parameter not in FiveBarParams.model_fields:
        parameter, said = "crank", str(error)
    message, _, own = said.partition("; ")
    return Finding.error(code, parameter, message, remedy=own or remedy)


@of_stage(Stage.PARTS)
def _room(params: FiveBarParams) -> Iterator[Finding]:
    """Whether the bores of crank, arm and rocker leave material between them."""
    for name, bosses in bosses_of(params).items():
        if name == "coupler":
            continue
        for one, two in combinations(bosses, 2):
            distance, needed = abs(one.centre - two.centre), (one.bore + two.bore) / 2 + params.rim
            if falls_short(distance, needed):
                yield Finding.error(
                    "five-bar.bores",
                    name,
                    f"the bores of the {name} are {distance:.4g} mm apart and leave less than the rim of "
                    f"{params.rim:g} mm",
                    distance,
                    needed,
                    "mm",
                    f"make {name} at least {math.ceil(needed * 1e4) / 1e4:g}, or take smaller pins, "
                    "bushings or rims",
                )


@of_stage(Stage.PARTS)
def _layers(params: FiveBarParams) -> Iterator[Finding]:
    try:
        layout = layout_of(params)
    except GeometryError as error:
        yield _named(
            "five-bar.layers",
            error,
            "make crank and arm shorter than the ground, pins, rims or webs smaller, or the swing shorter",
        )
        return
    order = sorted(layout.stack.layer.items(), key=lambda item: (item[1], item[0]))
    height = max(high for _, high in layout.stack.spans.values())
    yield from told("five-bar.sizes", USUAL, params)
    yield from chosen("five-bar.chosen", params, {**USUAL_TEETH, "gear_thickness": USUAL_FACE})
    yield Finding.note(
        "five-bar.stack",
        f"{len(layout.stack.layers)} layers, {height:.4g} mm high: "
        + ", ".join(f"{name} in {number}" for name, number in order),
        height,
        "mm",
    )


def _figures(params: FiveBarParams) -> Iterator[Finding]:
    least, most = (math.degrees(one) for one in transmission_of(params))
    course, bar = course_of(params), bar_of(params)
    way = (
        f"a lever that swings by {math.degrees(abs(course.travel)):.3f} degrees there and back"
        if is_lever(params)
        else f"the crank turns fully, and after {bar.turns} turns all is as before"
    )
    yield Finding.note(
        "five-bar.motion", f"{way}; transmission angle {least:.3f} to {most:.3f} degrees", least, "deg"
    )


@of_stage(Stage.PARTS)
def _bearings(params: FiveBarParams) -> Iterator[Finding]:
    peaks = loads_of(params).peaks
    widths = dict.fromkeys(JOINTS, params.thickness) | dict.fromkeys(("A0", "B0"), params.ground_thickness)
    joint, force, pressure = most_pressed(peaks, widths, params.pin_diameter)
    more = _stronger(params, pressure / SINTERED_PRESSURE)
    yield from too_pressed("five-bar.bearing-pressure", joint, force, pressure, more)
    yield Finding.note(
        "five-bar.forces",
        f"the drive needs up to {peaks['drive_torque'].value:.4g} N m; the gears put up to "
        f"{peaks['arm_torque'].value:.4g} N m on the arm, {peaks['tooth_force'].value:.4g} N between "
        "teeth; joint "
        f"{joint} carries up to {force:.4g} N, and the moving masses shake the ground with up to "
        f"{peaks['shaking_force'].value:.4g} N",
        peaks["drive_torque"].value,
        "N*m",
    )


def _stronger(params: FiveBarParams, over: float) -> tuple[Change, ...]:
    """Larger bearings, or less of what they carry, which is so many times ``over`` its limit."""
    found: list[Change] = []
    for share in (1.05, 1.2, 1.5):
        root = math.sqrt(over * share)
        found.append({
            "parameters.pin_diameter": math.ceil(2 * root * params.pin_diameter) / 2,
            "parameters.thickness": math.ceil(2 * root * params.thickness) / 2,
        })  # fmt: skip
        speed = params.speed / math.sqrt(over * share)
        if speed >= SLOWEST:
            found.append({"parameters.speed": float(f"{speed:.2g}")})
    return tuple(found)
