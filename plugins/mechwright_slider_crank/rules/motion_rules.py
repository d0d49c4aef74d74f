"""Rules of the motion: closure and swing, acceleration of the crank, full turn, transmission angle."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, Severity, Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.accelerating import of_acceleration
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright.tolerances import falls_short
from mechwright_slider_crank.kinematics.course import (
    course_of,
    is_lever,
    least_of,
    swings,
    toggles,
    turns,
    ways,
    ways_in_degrees,
)
from mechwright_slider_crank.kinematics.mechanism import Mechanism

TURN_MARGIN = 5e-4
"""The rod is longer than crank and offset by at least this part: then it stays 1.8° away from standing across
the slide, where the least friction blocks it."""

LEAST_TRANSMISSION = 25.0
"""Degrees between rod and normal of the slide: there the guide bears 2.1 times the force along it, and with a
friction coefficient of 0.2 takes 43 % of that. Machines that carry a load stay above 40°."""

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]


def _goes(m: Mechanism) -> Any:
    """Whether the crank goes where it is to: 1 or 0."""
    return np.where(is_lever(m) & np.isnan(swings(m)[0]), 0.0, 1.0)


def _meets(m: Mechanism) -> Any:
    """Whether there is a way at all."""
    return ~np.isnan(ways(m, TURN_BACK)[0][0])


def _ends(m: Mechanism) -> tuple[float, float]:
    """The ends of the swing that a design states, degrees."""
    given = m.given
    assert given.swing_from is not None  # noqa: S101 - left to itself a lever goes within its way
    assert given.swing_to is not None  # noqa: S101
    return given.swing_from, given.swing_to


def _past(f: Fails) -> tuple[str, float, float]:
    return swing.past(ways_in_degrees(f.m, TURN_BACK), *_ends(f.m))


def _reached(m: Mechanism) -> str:
    return " or ".join(f"{low:.3f} to {high:.3f}" for low, high in ways_in_degrees(m, TURN_BACK))


def _swing_message(f: Fails) -> str:
    one, two = _ends(f.m)
    return (
        f"the crank cannot swing from {one:g} to {two:g} degrees: it reaches {_reached(f.m)} degrees, "
        f"{math.degrees(TURN_BACK):g} degree before the rod stands across the slide"
    )


SWING = Rule(
    "slider-crank.swing",
    lambda f: _past(f)[0],
    _swing_message,
    value=_goes,
    limit=1.0,
    unit="deg",
    remedy=lambda f: f"keep swing_from and swing_to within {_reached(f.m)}",
    stage=Stage.MOTION,
    when=_meets,
    reported=lambda f: _past(f)[1:],
    proposed=lambda f: (
        *swing.shortened(ways_in_degrees(f.m, TURN_BACK), *_ends(f.m)),
        swing.LEFT_OUT,
    ),
)
CLOSURE = Rule(
    "slider-crank.closure",
    "offset",
    lambda f: (
        f"crank and rod, {_span(f.m):.6g} mm together, do not reach a slide line "
        f"{abs(f.m.given.offset):.6g} mm away, or only within {math.degrees(TURN_BACK):g} degree of standing "
        "across it"
    ),
    value=_goes,
    limit=1.0,
    unit="mm",
    remedy=lambda f: f"make offset at most {0.99 * _span(f.m):.4g} mm either way",
    stage=Stage.MOTION,
    when=lambda m: ~_meets(m),
    reported=lambda f: (abs(f.m.given.offset), _span(f.m)),
)


def _span(m: Mechanism) -> float:
    return m.given.crank + m.given.rod


def _accelerates(m: Mechanism) -> Iterator[Finding]:
    given = m.given
    return of_acceleration("slider-crank.acceleration", course_of(m), given.acceleration_ratio, given.speed)


def _varies(m: Mechanism) -> Any:
    return np.asarray(m.given.acceleration_ratio) != 0


def _needed(m: Mechanism) -> Any:
    """Crank and offset."""
    return m.given.crank + abs(m.given.offset)


def _least_rod(m: Mechanism) -> Any:
    return _needed(m) * (1 + TURN_MARGIN)


def _is_free(m: Mechanism) -> bool:
    """Whether the design leaves it to the dimensions how the crank goes."""
    return m.given.swing_from is None


def _turn_remedy(m: Mechanism) -> str:
    params = m.given
    crank = params.rod / (1 + TURN_MARGIN) - abs(params.offset)
    offset = params.rod / (1 + TURN_MARGIN) - params.crank
    others = [f"crank at most {crank:.6g} mm"] if crank > 0 else []
    others += [f"offset at most {offset:.6g} mm"] if offset > 0 else []
    return f"make rod at least {_least_rod(m):.6g} mm" + (f", or {' or '.join(others)}" if others else "")


def _turn_message(f: Fails) -> str:
    over = 100 * (f.value / _needed(f.m) - 1)
    return (
        f"a rod of {f.value:g} mm is {max(over, 0.0):.2g} % longer than crank and offset together, "
        f"{_needed(f.m):.6g} mm, and the least is {100 * TURN_MARGIN:g} %: nearer to standing across the "
        "slide the least friction blocks it"
    )


def _lever_message(f: Fails) -> str:
    course = course_of(f.m)
    low, high = (math.degrees(end) for end in sorted((course.start, course.start + course.travel)))
    said = " and ".join(f"{math.degrees(end):.3f}" for end in toggles(f.m))
    return (
        f"the crank cannot turn fully, as a rod of {f.value:g} mm does not span crank and offset, "
        f"{_needed(f.m):.6g} mm: it is a lever that swings from {low:.3f} to {high:.3f} degrees, its "
        f"toggles at {said} degrees"
    )


CRANK_TURN = Rule(
    "slider-crank.crank-turn",
    "rod",
    _turn_message,
    value=lambda m: m.given.rod,
    limit=_least_rod,
    unit="mm",
    remedy=lambda f: _turn_remedy(f.m),
    when=lambda m: _is_free(m) & np.asarray(turns(m)),
)
LEVER = CRANK_TURN.but(
    message=_lever_message,
    remedy=lambda f: f"say where it turns back with swing_from and swing_to, or {_turn_remedy(f.m)}",
    severity=Severity.WARNING,
    stage=Stage.MOTION,
    when=lambda m: _is_free(m) & ~np.asarray(turns(m)),
)


def _shorter_swing(f: Fails) -> tuple[Change, ...]:
    """As much of a lever's swing as keeps the transmission angle."""
    if not is_lever(f.m):
        return ()
    course = course_of(f.m)
    start, end = math.degrees(course.start), math.degrees(course.start + course.travel)
    return swing.shortened(ways_in_degrees(f.m, math.radians(LEAST_TRANSMISSION)), start, end)


TRANSMISSION = Rule(
    "slider-crank.transmission",
    "rod",
    lambda f: (
        f"the transmission angle falls to {f.value:.4g}°, below {LEAST_TRANSMISSION:g}°: the rod pushes "
        "the slider against its guide more than along it"
    ),
    value=lambda m: np.degrees(least_of(m)),
    limit=LEAST_TRANSMISSION,
    unit="deg",
    remedy=lambda f: (
        f"make rod {_needed(f.m) / math.cos(math.radians(LEAST_TRANSMISSION)):.5g} mm or longer, or crank or "
        "offset smaller"
    ),
    severity=Severity.WARNING,
    when=lambda m: (
        ~(_is_free(m) & np.asarray(turns(m)) & np.asarray(falls_short(m.given.rod, _least_rod(m))))
    ),
    proposed=_shorter_swing,
)

MOTION = in_turn(
    SWING,
    CLOSURE,
    Procedure[Mechanism](
        ("slider-crank.acceleration",), _accelerates, when=lambda m: _varies(m) & np.asarray(is_lever(m))
    ),
)
"""All that a motion needs, in order."""

TURNING = all_of(
    Procedure[Mechanism](
        ("slider-crank.acceleration",),
        _accelerates,
        when=lambda m: _varies(m) & ~np.asarray(is_lever(m)),
        warns=True,
    ),
    CRANK_TURN,
    LEVER,
    TRANSMISSION,
)
"""How well the crank gets round, and drives the slider."""
