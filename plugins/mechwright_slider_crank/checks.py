"""What an engineer would object to in a slider-crank, and the figures worth knowing."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding, GeometryError, MechwrightError, Stage, kept, of_stage, until_error
from mechwright.contracts.finding import Change
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.accelerating import of_acceleration
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright.mechanics.strength.judging import SLOWEST
from mechwright.tolerances import exceeds, falls_short
from mechwright_slider_crank.course import (
    course_of,
    ends_of,
    is_lever,
    least_of,
    period_of,
    toggles,
    turns,
    ways,
    within,
)
from mechwright_slider_crank.forces import balance, joint_forces
from mechwright_slider_crank.outlines import rod_outline
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.plates import TURN_SAMPLES, Layout, layout_of, masses_of
from mechwright_slider_crank.sizes import LEAST_WEB, MAX_PRESSURE, sizes_of
from mechwright_slider_crank.strength_checks import strength_findings, strength_judged

TURN_MARGIN = 5e-4
"""The rod is longer than crank and offset by at least this part: then it stays 1.8° away from standing across
the slide, where the least friction blocks it."""

LEAST_TRANSMISSION = 25.0
"""Degrees between rod and normal of the slide: there the guide bears 2.1 times the force along it, and with a
friction coefficient of 0.2 takes 43 % of that. Machines that carry a load stay above 40°."""

MOST_BEND = 0.5
"""Bend of a rod over its length: at more its legs are steeper than 45° and carry bending before all."""


@kept
def findings(params: SliderCrankParams) -> tuple[Finding, ...]:
    """All findings; where the crank cannot turn or a plate cannot be drawn, only those that say so."""
    return until_error(params, _sound, strength_findings, _figures)


@kept
def judged(params: SliderCrankParams) -> tuple[Finding, ...]:
    """The same without the sizes that would bear a load."""
    return until_error(params, _sound, strength_judged, _figures)


@kept
def _sound(params: SliderCrankParams) -> tuple[Finding, ...]:
    return until_error(params, _joined, _accelerates, _turns, _webs, _drawn, _carried)


def _joined(params: SliderCrankParams) -> Iterator[Finding]:
    """Whether crank, rod and slider can be put together and move: all that a motion needs."""
    if not is_lever(params) or within(params) is not None:
        return
    if ways(params, TURN_BACK):
        yield _out_of_reach(params)
        return
    limit = params.crank + params.rod
    yield Finding.error(
        "slider-crank.closure",
        "offset",
        f"crank and rod, {limit:.6g} mm together, do not reach a slide line {abs(params.offset):.6g} mm "
        f"away, or only within {math.degrees(TURN_BACK):g} degree of standing across it",
        abs(params.offset),
        limit,
        "mm",
        f"make offset at most {0.99 * limit:.4g} mm either way",
    )


def _out_of_reach(params: SliderCrankParams) -> Finding:
    """A swing that the links do not reach."""
    found = [(math.degrees(low), math.degrees(high)) for low, high in ways(params, TURN_BACK)]
    said = " or ".join(f"{low:.3f} to {high:.3f}" for low, high in found)
    assert params.swing_from is not None  # noqa: S101 - left to itself a lever goes within its way
    assert params.swing_to is not None  # noqa: S101
    key, value, limit = swing.past(found, params.swing_from, params.swing_to)
    return Finding.error(
        "slider-crank.swing",
        key,
        f"the crank cannot swing from {params.swing_from:g} to {params.swing_to:g} degrees: it reaches "
        f"{said} degrees, {math.degrees(TURN_BACK):g} degree before the rod stands across the slide",
        value,
        limit,
        "deg",
        f"keep swing_from and swing_to within {said}",
        proposed=(*swing.shortened(found, params.swing_from, params.swing_to), swing.LEFT_OUT),
    )


def _accelerates(params: SliderCrankParams) -> Iterator[Finding]:
    course = course_of(params)
    return of_acceleration("slider-crank.acceleration", course, params.acceleration_ratio, params.speed)


def _turns(params: SliderCrankParams) -> Iterator[Finding]:
    span = params.crank + abs(params.offset)
    limit = span * (1 + TURN_MARGIN)
    if params.swing_from is None and falls_short(params.rod, limit):
        yield _blocked(params, span, limit)
        if turns(params):
            return
    angle = math.degrees(least_of(params))
    if falls_short(angle, LEAST_TRANSMISSION):
        wanted = span / math.cos(math.radians(LEAST_TRANSMISSION))
        yield Finding.warning(
            "slider-crank.transmission",
            "rod",
            f"the transmission angle falls to {angle:.4g}°, below {LEAST_TRANSMISSION:g}°: the rod pushes "
            "the slider against its guide more than along it",
            angle,
            LEAST_TRANSMISSION,
            "deg",
            f"make rod {wanted:.5g} mm or longer, or crank or offset smaller",
            Stage.PARTS,
            _shorter_swing(params) if is_lever(params) else (),
        )


def _shorter_swing(params: SliderCrankParams) -> tuple[Change, ...]:
    """As much of a lever's swing as keeps the transmission angle."""
    course = course_of(params)
    start, end = math.degrees(course.start), math.degrees(course.start + course.travel)
    found = ways(params, math.radians(LEAST_TRANSMISSION))
    return swing.shortened([(math.degrees(low), math.degrees(high)) for low, high in found], start, end)


def _blocked(params: SliderCrankParams, span: float, limit: float) -> Finding:
    """A crank that cannot turn fully, which is a lever, or that only just can."""
    crank = params.rod / (1 + TURN_MARGIN) - abs(params.offset)
    offset = params.rod / (1 + TURN_MARGIN) - params.crank
    others = [f"crank at most {crank:.6g} mm"] if crank > 0 else []
    others += [f"offset at most {offset:.6g} mm"] if offset > 0 else []
    remedy = f"make rod at least {limit:.6g} mm" + (f", or {' or '.join(others)}" if others else "")
    if turns(params):
        over = 100 * (params.rod / span - 1)
        return Finding.error(
            "slider-crank.crank-turn",
            "rod",
            f"a rod of {params.rod:g} mm is {max(over, 0.0):.2g} % longer than crank and offset together, "
            f"{span:.6g} mm, and the least is {100 * TURN_MARGIN:g} %: nearer to standing across the slide "
            "the least friction blocks it",
            params.rod,
            limit,
            "mm",
            remedy,
            Stage.PARTS,
        )
    course = course_of(params)
    low, high = (math.degrees(end) for end in sorted((course.start, course.start + course.travel)))
    said = " and ".join(f"{math.degrees(end):.3f}" for end in toggles(params) or ())
    return Finding.warning(
        "slider-crank.crank-turn",
        "rod",
        f"the crank cannot turn fully, as a rod of {params.rod:g} mm does not span crank and offset, "
        f"{span:.6g} mm: it is a lever that swings from {low:.3f} to {high:.3f} degrees, its toggles at "
        f"{said} degrees",
        params.rod,
        limit,
        "mm",
        f"say where it turns back with swing_from and swing_to, or {remedy}",
    )


@of_stage(Stage.PARTS)
def _webs(params: SliderCrankParams) -> Iterator[Finding]:
    """Room between bores, and around them where a width is the designer's own."""
    sizes = sizes_of(params)
    between = params.crank - (sizes.shaft + sizes.pin) / 2
    yield from _web(
        "slider-crank.crank-web",
        "crank",
        "between the bores of shaft and crank pin",
        between,
        f"make crank at least {params.crank + LEAST_WEB - between:.4g} mm, or pin or shaft thinner",
    )
    between = params.rod - sizes.rod_bore
    yield from _web(
        "slider-crank.rod-web",
        "rod",
        "between the bores of the rod",
        between,
        f"make rod at least {params.rod + LEAST_WEB - between:.4g} mm, or pin or bushing smaller",
    )
    if params.coupler_bore > 0:
        point = params.coupler_point
        nearest = min(abs(point), abs(point - params.rod))
        between = nearest - (sizes.rod_bore + params.coupler_bore) / 2
        yield from _web(
            "slider-crank.coupler-web",
            "coupler_bore",
            "between the coupler point's bore and a joint's",
            between,
            "move the coupler point away from the joints, or make coupler_bore smaller",
        )
    for parameter, width in (("slider_width", sizes.slider_width), ("slider_length", sizes.slider_length)):
        yield from _web(
            "slider-crank.slider-web",
            parameter,
            "beside the slider's pin",
            (width - sizes.pin) / 2,
            f"make {parameter} at least {sizes.pin + 2 * LEAST_WEB:.4g} mm, or pin thinner",
        )
    yield from _web(
        "slider-crank.rail-web",
        "rail",
        "beside the rail's dowels",
        (sizes.rail - sizes.dowel) / 2,
        f"make rail at least {sizes.dowel + 2 * LEAST_WEB:.4g} mm, or pin thinner",
    )


def _web(code: str, parameter: str, where: str, web: float, remedy: str) -> Iterator[Finding]:
    if falls_short(web, LEAST_WEB):
        message = f"{web:.3g} mm are left {where}, the limit is {LEAST_WEB:g} mm"
        yield Finding.error(code, parameter, message, web, LEAST_WEB, "mm", remedy)


@of_stage(Stage.PARTS)
def _drawn(params: SliderCrankParams) -> Iterator[Finding]:
    """Whether the rod can be drawn, and all plates find their layers."""
    most = MOST_BEND * params.rod
    if exceeds(abs(params.rod_bend), most):
        yield Finding.error(
            "slider-crank.rod-bend",
            "rod_bend",
            f"the rod leaves the straight line by {abs(params.rod_bend):g} mm, half its length is {most:g}",
            abs(params.rod_bend),
            most,
            "mm",
            f"make rod_bend at most {most:g} mm either way",
        )
        return
    try:
        outline = rod_outline(params)
        outline.polygon()
    except GeometryError as error:
        parameter = "rod_bend" if params.rod_bend else "rod_width"
        yield Finding.error(
            "slider-crank.rod-shape",
            parameter,
            f"the rod cannot be drawn: {error}",
            remedy=f"change {parameter}, or make wall smaller",
        )
        return
    try:
        layout_of(params)
    except MechwrightError as error:
        remedy = (
            "use crank_shape = 'arm', or a longer rod" if params.crank_shape == "disc" else "use a longer rod"
        )
        yield Finding.error(
            "slider-crank.layers",
            "crank_shape",
            str(error),
            remedy=f"{remedy}, a narrower rail, or thinner pins and walls",
            proposed=() if params.rail_overhang is None else ({"parameters.rail_overhang": None},),
        )


def _at_work(params: SliderCrankParams) -> Forces:
    _, _, bodies = period_of(params, TURN_SAMPLES)
    return joint_forces(params.linkage, bodies, masses_of(params), params.load)


@of_stage(Stage.PARTS)
def _carried(params: SliderCrankParams) -> Iterator[Finding]:
    sizes, carried = sizes_of(params), _at_work(params)
    force = float(max(np.abs(carried.joints["crank-pin"]).max(), np.abs(carried.joints["wrist-pin"]).max()))
    pressure = force / (sizes.pin * params.thickness)
    if exceeds(pressure, MAX_PRESSURE):
        yield Finding.warning(
            "slider-crank.pin-pressure",
            "pin",
            f"{force:.4g} N press on the rod's bores with {pressure:.4g} MPa, the limit is "
            f"{MAX_PRESSURE:g} MPa",
            pressure,
            MAX_PRESSURE,
            "MPa",
            "thicker pins, a thicker plate, or less load or speed",
            proposed=_stronger(params, force / (MAX_PRESSURE * params.thickness), pressure / MAX_PRESSURE),
        )


def _stronger(params: SliderCrankParams, pin: float, over: float) -> tuple[Change, ...]:
    """Thicker pins, mm, or less of what they carry, which is so many times ``over`` its limit.

    Thicker pins make heavier plates, so that more than the first may be needed.
    """
    found: list[Change] = [{"parameters.pin": math.ceil(2 * share * pin) / 2} for share in (1.0, 1.15, 1.4)]
    for share in (1.05, 1.2):
        if params.load != 0:
            found.append({"parameters.load": float(f"{params.load / over / share:.2g}")})
        if (speed := params.speed / math.sqrt(over) / share) >= SLOWEST:
            found.append({"parameters.speed": float(f"{speed:.2g}")})
    return tuple(found)


def _figures(params: SliderCrankParams) -> Iterator[Finding]:
    ends, layout, carried = ends_of(params), layout_of(params), _at_work(params)
    sense = "away from the crank" if ends.slow_outward != params.clockwise else "towards the crank"
    angle = math.degrees(least_of(params))
    yield Finding.note(
        "slider-crank.stroke",
        f"stroke {ends.stroke:.6g} mm, time ratio {ends.time_ratio:.6g}"
        + (f", slower {sense}" if ends.time_ratio > 1 + 1e-9 else "")
        + f"; limits at crank angles {math.degrees(ends.far):.4f}° and {math.degrees(ends.near):.4f}°; least "
        f"transmission angle {angle:.4f}°",
        ends.stroke,
        "mm",
    )
    yield _layers(layout)
    masses = masses_of(params)
    joints = {name: np.abs(carried.joints[name]).max() for name in ("crank-pin", "wrist-pin", "guide")}
    weights = balance(params.crank, params.rod, masses)
    yield Finding.note(
        "slider-crank.forces",
        f"torque up to {np.abs(carried.drive).max() / 1e3:.4g} N m, "
        + ", ".join(f"{name.replace('-', ' ')} {peak:.4g} N" for name, peak in joints.items())
        + f", shaking force {np.abs(carried.shaking).max():.4g} N",
        float(np.abs(carried.drive).max()) / 1e3,
        "N*m",
    )
    yield Finding.note(
        "slider-crank.balance",
        f"moving masses {masses['crank'].mass * 1e3:.4g} g crank, {masses['rod'].mass * 1e3:.4g} g rod, "
        f"{masses['slider'].mass * 1e3:.4g} g slider; full force balance takes {abs(weights.rod):.4g} kg mm "
        f"on the rod behind the crank pin and {abs(weights.crank):.4g} kg mm on the crank",
        abs(weights.crank),
        "kg*mm",
    )


def _layers(layout: Layout) -> Finding:
    names = sorted(layout.stack.layer, key=lambda name: (layout.stack.layer[name], name))
    order = [
        " and ".join(name for name in names if layout.stack.layer[name] == number and name != "rail-2")
        for number in range(len(layout.stack.layers))
    ]
    words = ", ".join(order).replace("rail-1", "rails")
    top = layout.stack.layers[-1]
    return Finding.note(
        "slider-crank.stack",
        f"layers from below: {words}; {top.bottom + top.thickness:.4g} mm high"
        + ("" if layout.heads else "; the pins end flush, secure the rod with rings or adhesive"),
        float(len(layout.stack.layers)),
    )
