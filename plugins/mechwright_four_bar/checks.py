"""What an engineer would object to in a four-bar, and the figures worth knowing.

The checks run from the lengths to the forces. Each group needs what the groups before it have found to be
sound, so the first group with an error ends the list.
"""

import math
from collections.abc import Iterator
from functools import partial

from mechwright import Finding, GeometryError, Severity, Stage, kept, of_stage, until_error
from mechwright.contracts.finding import Change
from mechwright.mechanics.linkage import bushing_findings
from mechwright.mechanics.linkage.usual import told
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.accelerating import of_acceleration
from mechwright.mechanics.planar.swing import LEAST_TRANSMISSION, TURN_BACK
from mechwright.tolerances import falls_short
from mechwright_four_bar.kinematics.dimensions import FourBar, Kind
from mechwright_four_bar.kinematics.reach import (
    bar_of,
    course_of,
    is_lever,
    reach,
    toggles,
    transmission_of,
    within,
)
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.plates import hidden_point, layout_of, layout_or_none
from mechwright_four_bar.parts.usual import USUAL
from mechwright_four_bar.phase_checks import clamps_hold, places_apart
from mechwright_four_bar.room import above, room_findings
from mechwright_four_bar.strength_checks import bearing_findings, strength_findings, strength_judged

LEAST_ROOM = 1e-6
"""Share of the longest link by which the dyad must clear the diagonal: less is lost in any tolerance, and
which way the linkage goes through the line-up is left to chance."""

GOOD_TRANSMISSION = 40.0
"""Degrees below which the coupler mainly presses the follower into its bearing (VDI 2127: 40 to 50)."""


@kept
def findings(params: FourBarParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design. No error among it means that the parts can be built."""
    return until_error(params, _sound, strength_findings, clamps_hold)


@kept
def judged(params: FourBarParams) -> tuple[Finding, ...]:
    """The same without the sizes that would bear a load."""
    return until_error(params, _sound, strength_judged, clamps_hold)


@kept
def _sound(params: FourBarParams) -> tuple[Finding, ...]:
    bushings = partial(bushing_findings, "four-bar.bushing-wall")
    return until_error(
        params, _joined, _accelerates, _turning, _transmission, bushings, room_findings, places_apart,
        _layers, _figures, bearing_findings,
    )  # fmt: skip


def _joined(params: FourBarParams) -> Iterator[Finding]:
    """Whether the loop closes, and where the crank shall go: all that a motion needs."""
    bar = bar_of(params)
    if not bar.closes:
        name, longest = max(
            zip(("crank", "coupler", "follower", "ground"), bar.lengths, strict=True),
            key=lambda pair: pair[1],
        )
        limit = sum(bar.lengths) - longest
        yield Finding.error(
            "four-bar.closure",
            name,
            f"the links cannot be joined: the {name} of {longest:g} mm is longer than the others together, "
            f"{limit:g} mm",
            longest,
            limit,
            "mm",
            f"make {name} at most {_below(limit)}",
        )
    elif is_lever(params) and within(params) is None:
        yield _out_of_reach(params, bar)


def _accelerates(params: FourBarParams) -> Iterator[Finding]:
    course = course_of(params)
    return of_acceleration("four-bar.acceleration", course, params.acceleration_ratio, params.speed)


def _out_of_reach(params: FourBarParams, bar: FourBar) -> Finding:
    """A swing that the links do not reach."""
    ways = reach(bar, TURN_BACK)
    if params.swing_from is None or params.swing_to is None or not ways:
        parameter, value, near, remedy = _nearest_turning(bar, LEAST_ROOM * max(bar.lengths))
        return Finding.error(
            "four-bar.rotation",
            parameter,
            f"the links are within {math.degrees(TURN_BACK):g} degree of a toggle wherever the crank stands",
            value,
            near,
            "mm",
            remedy,
        )
    turned = [
        (math.degrees(low + bar.ground_angle), math.degrees(high + bar.ground_angle)) for low, high in ways
    ]
    return swing.out_of_reach(
        "four-bar.swing", turned, params.swing_from, params.swing_to, math.degrees(TURN_BACK)
    )


def _degrees(angle: float, bar: FourBar) -> str:
    """A crank angle from the ground line as one from X."""
    return f"{math.degrees(angle + bar.ground_angle):.3f}"


def _turning(params: FourBarParams) -> Iterator[Finding]:
    """Whether the crank turns fully, and without a doubt how the linkage goes on."""
    bar = bar_of(params)
    least = LEAST_ROOM * max(bar.lengths)
    if params.swing_from is not None or bar.crank_room >= least:
        return
    parameter, value, near, remedy = _nearest_turning(bar, least)
    if not bar.rocks:
        yield Finding.error(
            "four-bar.change-point",
            parameter,
            "all links line up once a turn, and nothing decides how the linkage goes on; a parallelogram "
            "goes as a lever that turns back before that: give swing_from and swing_to",
            value,
            near,
            "mm",
            remedy,
            Stage.PARTS,
        )
        return
    course, found = course_of(params), toggles(params)
    ends = [math.degrees(x) for x in sorted((course.start, course.start + course.travel))]
    said = "" if found is None else " and ".join(f"{math.degrees(x):.3f}" for x in found)
    yield Finding.warning(
        "four-bar.rotation",
        parameter,
        f"the crank of {bar.crank:g} mm cannot turn fully ({bar.kind.value}): it is a lever that swings from "
        f"{ends[0]:.3f} to {ends[1]:.3f} degrees, its toggles at {said} degrees",
        value,
        near,
        "mm",
        f"say where it turns back with swing_from and swing_to, or {remedy}",
    )


def _nearest_turning(bar: FourBar, room: float) -> tuple[str, float, float, str]:
    """The parameter to change, its value, the nearest one with which the crank turns, and how to say so."""
    a, c, b, f = bar.lengths
    ranges = (
        ("crank", a, 0.0, min(b + c - f, f - abs(b - c))),
        ("crank", a, f + abs(b - c), b + c - f),
        ("ground", f, a + abs(b - c), b + c - a),
    )
    options: list[tuple[float, str, float, float]] = []
    for name, value, low, high in ranges:
        if high - low > 2 * room:
            near = min(max(value, low + room), high - room)
            options.append((abs(near - value) / value, name, value, near))
    if not options:
        # Equal and long enough, coupler and follower let any crank turn.
        wanted = (a + f) / 2 + room
        return "coupler", c, wanted, f"make coupler and follower alike, and longer than {above(wanted)}"
    _, name, value, near = min(options)
    side = f"at most {_below(near)}" if near < value else f"at least {above(near)}"
    return name, value, near, f"make {name} {side}"


def _below(value: float) -> str:
    """A length rounded down, as a remedy says it."""
    return f"{math.floor(value * 1e4) / 1e4:g}" if value < 1e3 else f"{math.floor(value * 100) / 100:.2f}"


def _transmission(params: FourBarParams) -> Iterator[Finding]:
    angle = math.degrees(transmission_of(params)[0])
    if not falls_short(angle, GOOD_TRANSMISSION):
        return
    jams = falls_short(angle, LEAST_TRANSMISSION)
    shortest = "ground" if bar_of(params).kind is Kind.DOUBLE_CRANK else "crank"
    yield Finding(
        "four-bar.transmission",
        Severity.ERROR if jams else Severity.WARNING,
        "follower",
        f"the transmission angle falls to {angle:.3g} degrees",
        angle,
        LEAST_TRANSMISSION if jams else GOOD_TRANSMISSION,
        "deg",
        "give a shorter swing with swing_from and swing_to"
        if is_lever(params)
        else f"make the {shortest} shorter, or change coupler and follower",
        Stage.PARTS,
        _shorter_swing(params) if is_lever(params) else (),
    )


def _shorter_swing(params: FourBarParams) -> tuple[Change, ...]:
    """As much of a lever's swing as keeps a good transmission angle."""
    bar, course = bar_of(params), course_of(params)
    start, end = math.degrees(course.start), math.degrees(course.start + course.travel)
    ways = reach(bar, math.radians(GOOD_TRANSMISSION))
    turned = [
        (math.degrees(low + bar.ground_angle), math.degrees(high + bar.ground_angle)) for low, high in ways
    ]
    return swing.shortened(turned, start, end)


@of_stage(Stage.PARTS)
def _layers(params: FourBarParams) -> Iterator[Finding]:
    try:
        layout = layout_of(params)
    except GeometryError as error:
        other = params.model_copy(update={"frame": "two"})
        yield Finding.error(
            "four-bar.layers",
            "frame",
            str(error),
            remedy='set frame = "two"'
            if layout_or_none(other) is not None
            else "make pins, rims, webs or clearance smaller, or bend the coupler",
        )
        return
    layers = layout.stack
    order = sorted(layers.layer.items(), key=lambda item: (item[1], item[0]))
    height = max(high for _, high in layers.spans.values())
    yield from told("four-bar.sizes", USUAL, params)
    yield Finding.note(
        "four-bar.stack",
        f"{len(layers.layers)} layers, {height:.4g} mm high: "
        + ", ".join(f"{name} in {number}" for name, number in order)
        + (f"; {len(layout.posts)} posts between two ground plates" if layout.posts else ""),
        height,
        "mm",
    )
    hidden = hidden_point(params)
    if hidden:
        yield Finding.warning(
            "four-bar.point",
            "coupler_point_x",
            f"over a turn the coupler point comes under the {hidden[0]} and over the {hidden[1]}: a tool in "
            "it has no way out of its own layer",
            remedy="work with it between the plates, or cut a window along its path into one of them",
        )


def _figures(params: FourBarParams) -> Iterator[Finding]:
    bar = bar_of(params)
    if is_lever(params):
        yield _swing(params, bar)
        return
    limits = bar.limits()
    motion = (
        "the follower turns fully"
        if limits is None
        else f"the follower swings by {math.degrees(limits.swing):.4f} degrees with a time ratio of "
        f"{limits.time_ratio:.5f}"
    )
    least, most = bar.least_transmission_angle(), bar.greatest_transmission_angle()
    yield Finding.note(
        "four-bar.motion",
        f"{bar.kind.value}, {motion}; transmission angle {math.degrees(least):.3f} to "
        f"{math.degrees(most):.3f} degrees",
        math.degrees(least),
        "deg",
    )


def _swing(params: FourBarParams, bar: FourBar) -> Finding:
    course, (least, most) = course_of(params), transmission_of(params)
    return Finding.note(
        "four-bar.motion",
        f"{bar.kind.value}, a lever that swings by {math.degrees(abs(course.travel)):.3f} degrees there and "
        f"back; transmission angle {math.degrees(least):.3f} to {math.degrees(most):.3f} degrees",
        math.degrees(least),
        "deg",
    )
