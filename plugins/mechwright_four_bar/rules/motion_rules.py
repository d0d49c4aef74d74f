"""Rules of the motion: links that can be joined, a crank that turns or swings, transmission angles."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Severity, Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import in_turn
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.accelerating import of_acceleration
from mechwright.mechanics.planar.swing import LEAST_TRANSMISSION, TURN_BACK
from mechwright_four_bar.kinematics.dimensions import FourBar, Kind
from mechwright_four_bar.kinematics.reach import reach, reach_of, toggles
from mechwright_four_bar.table import FourBarTable

LEAST_ROOM = 1e-6
"""Share of the longest link by which the dyad must clear the diagonal: less is lost in any tolerance, and
which way the linkage goes through the line-up is left to chance."""

GOOD_TRANSMISSION = 40.0
"""Degrees below which the coupler mainly presses the follower into its bearing (VDI 2127: 40 to 50)."""

Rule = DesignRule[FourBarTable]
Fails = Failure[FourBarTable]
Proc = Procedure[FourBarTable]


def above(value: float) -> str:
    """A limit that is printed as no less than it is."""
    return f"{math.ceil(value * 1e4) / 1e4:g}" if value < 1e3 else f"{math.ceil(value * 100) / 100:.2f}"


def below(value: float) -> str:
    """A length rounded down, as a remedy says it."""
    return f"{math.floor(value * 1e4) / 1e4:g}" if value < 1e3 else f"{math.floor(value * 100) / 100:.2f}"


def _longest(f: Fails) -> str:
    return max(
        zip(("crank", "coupler", "follower", "ground"), f.m.bar.lengths, strict=True), key=lambda p: p[1]
    )[0]


CLOSURE = Rule(
    "four-bar.closure",
    _longest,
    lambda f: (
        f"the links cannot be joined: the {_longest(f)} of {f.value:g} mm is longer than the others "
        f"together, {f.limit:g} mm"
    ),
    value=lambda t: t.bar.longest,
    limit=lambda t: sum(t.bar.lengths) - t.bar.longest,
    unit="mm",
    remedy=lambda f: f"make {_longest(f)} at most {below(f.limit)}",
    must_be="at most",
    stage=Stage.MOTION,
    when=lambda t: ~np.asarray(t.bar.closes),
)


def _nearest_turning(bar: FourBar) -> tuple[str, float, float, str]:
    """The parameter to change, its value, the nearest one with which the crank turns, and how to say so."""
    a, c, b, f = bar.lengths
    room = LEAST_ROOM * bar.longest
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
    side = f"at most {below(near)}" if near < value else f"at least {above(near)}"
    return name, value, near, f"make {name} {side}"


def _stuck(t: FourBarTable) -> Any:
    """Levers that do not reach what is requested, or nothing at all."""
    return np.isnan(t.closed_ways.travel)


def _nowhere(m: FourBarTable) -> Iterator[Finding]:
    parameter, value, near, remedy = _nearest_turning(m.bar)
    said = f"the links are within {LEAST_TRANSMISSION:g} degree of a toggle wherever the crank stands"
    yield Finding.error("four-bar.rotation", parameter, said, value, near, "mm", remedy)


def _turned_ways(m: FourBarTable, least: float) -> list[tuple[float, float]]:
    """In degrees from X."""
    angle = m.bar.ground_angle
    return [(math.degrees(low + angle), math.degrees(high + angle)) for low, high in reach(m.bar, least)]


def _out_of_reach(m: FourBarTable) -> Iterator[Finding]:
    one, two = m.params.swing_from, m.params.swing_to
    if one is not None and two is not None:
        ways = _turned_ways(m, TURN_BACK)
        yield swing.out_of_reach("four-bar.swing", ways, one, two, LEAST_TRANSMISSION)


def _acceleration(m: FourBarTable) -> Iterator[Finding]:
    params = m.params
    course = m.closed_ways.course
    yield from of_acceleration("four-bar.acceleration", course, params.acceleration_ratio, params.speed)


def _tight(t: FourBarTable) -> Any:
    """Cranks without room to turn without a doubt, whose swing is not stated."""
    short = np.asarray(t.bar.crank_room) < LEAST_ROOM * np.asarray(t.bar.longest)
    return short & (t.requested is None)


def _lines_up(m: FourBarTable) -> Iterator[Finding]:
    parameter, value, near, remedy = _nearest_turning(m.bar)
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


def _swings(m: FourBarTable) -> Iterator[Finding]:
    bar, course = m.bar, m.closed_ways.course
    parameter, value, near, remedy = _nearest_turning(bar)
    ends = [math.degrees(x) for x in sorted((course.start, course.start + course.travel))]
    said = " and ".join(f"{math.degrees(float(x)):.3f}" for x in toggles(bar, m.closed_ways))
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


def _shorter_swing(f: Fails) -> tuple[Change, ...]:
    """As much of a lever's swing as keeps a good transmission angle."""
    if not f.m.lever:
        return ()
    course = f.m.closed_ways.course
    start, end = math.degrees(course.start), math.degrees(course.start + course.travel)
    return swing.shortened(_turned_ways(f.m, math.radians(GOOD_TRANSMISSION)), start, end)


def _shorter_link(f: Fails) -> str:
    if f.m.lever:
        return "give a shorter swing with swing_from and swing_to"
    shortest = "ground" if f.m.bar.kind is Kind.DOUBLE_CRANK else "crank"
    return f"make the {shortest} shorter, or change coupler and follower"


JAMS = Rule(
    "four-bar.transmission",
    "follower",
    "the transmission angle falls to {value:.3g} degrees",
    value=lambda t: np.degrees(t.transmission[0]),
    limit=LEAST_TRANSMISSION,
    unit="deg",
    remedy=_shorter_link,
    proposed=_shorter_swing,
)

MOTION = in_turn(
    CLOSURE,
    Proc(
        ("four-bar.rotation",),
        _nowhere,
        when=lambda t: _stuck(t) & ((t.requested is None) | reach_of(t.bar, TURN_BACK).empty),
        certain=True,
    ),
    Proc(("four-bar.swing",), _out_of_reach, when=_stuck, certain=True),
    Proc(
        ("four-bar.acceleration",),
        _acceleration,
        when=lambda t: t.lever & (np.asarray(t.params.acceleration_ratio) != 0),
        certain=True,
    ),
    Proc(("four-bar.acceleration",), _acceleration, when=lambda t: t.single),
    Proc(
        ("four-bar.change-point",),
        _lines_up,
        when=lambda t: _tight(t) & ~np.asarray(t.bar.rocks),
        stage=Stage.PARTS,
        certain=True,
    ),
    Proc(("four-bar.rotation",), _swings, when=lambda t: t.single and _tight(t)),
    JAMS,
    JAMS.but(limit=GOOD_TRANSMISSION, severity=Severity.WARNING),
)
"""In order."""


def _motion_message(m: FourBarTable) -> str:
    least, most = map(math.degrees, m.transmission)
    said = f"transmission angle {least:.3f} to {most:.3f} degrees"
    limits = m.bar.limits()
    if m.lever:
        swings = math.degrees(abs(m.closed_ways.course.travel))
        return f"{m.bar.kind.value}, a lever that swings by {swings:.3f} degrees there and back; {said}"
    if limits is None:
        return f"{m.bar.kind.value}, the follower turns fully; {said}"
    return (
        f"{m.bar.kind.value}, the follower swings by {math.degrees(limits.swing):.4f} degrees with a time "
        f"ratio of {limits.time_ratio:.5f}; {said}"
    )


NOTE = Note(
    "four-bar.motion", _motion_message, lambda m: math.degrees(m.transmission[0]), "deg", stage=Stage.MOTION
)
"""Of what moves."""
