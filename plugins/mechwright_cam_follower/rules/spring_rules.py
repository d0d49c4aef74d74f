"""The spring that is bought: whether one holds the follower, and what it does."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, Stage, kept
from mechwright.contracts.design_rule import DesignRule, Failure, Note, Procedure, no_figures
from mechwright.contracts.design_table import by_row
from mechwright.contracts.finding import Change
from mechwright.standards.spring_strength import fatigue_safety
from mechwright.standards.springs import SCATTER
from mechwright.tolerances import exceeds
from mechwright_cam_follower.kinematics.extremes import weakest
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parameters import AUTO, CamParams
from mechwright_cam_follower.parts.lever_inertia import own_inertia
from mechwright_cam_follower.parts.spring_parts import spring_place
from mechwright_cam_follower.spring.choice import SAFE, held_of, nearest

INERTIA_SPARE = 1.15
"""What is proposed over the inertia of the parts: another spring has another pin and another tail."""

SLOWEST = 0.01
"""Speed of the design table, rev/min, below which no remedy is looked for."""

_HALVINGS = 10

_DIGITS = 3
"""Of a speed that is proposed."""


def _unit(m: Mechanism) -> str:
    return "N" if m.slides else "N·m"


def _lack(m: Mechanism) -> float:
    """0 where a spring holds the follower, else what the nearest lacks; infinite where none has room."""
    if held_of(m.given) is not None:
        return 0.0
    found = nearest(m.given)
    return math.inf if found is None else max(found[1], np.finfo(float).tiny)


def _says(f: Failure[Mechanism]) -> str:
    given, found = f.m.given, nearest(f.m.given)
    what = (
        "no extension spring of the table" if given.spring == AUTO else f"the extension spring {given.spring}"
    )
    if found is None:
        return f"{what} has room at this follower, or none lasts over its stroke"
    held, lack = found
    near = "" if given.spring != AUTO else f"; the nearest, {held.spring.name},"
    return (
        f"{what} holds the follower on its cam at {given.speed:g} rev/min with a safety of {SAFE:g} against "
        f"fatigue{near} lacks {lack:.3g} {_unit(f.m)}"
    )


@kept
def _slower(params: CamParams) -> float | None:
    """The greatest speed below the present one, rev/min, that some spring bears; None where none is."""

    def works(speed: float) -> bool:
        return held_of(params.model_copy(update={"speed": speed})) is not None

    low, high = math.log(SLOWEST), math.log(params.speed)
    if not works(SLOWEST):
        return None
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if works(math.exp(middle)) else (low, middle)
    step = 10.0 ** (math.floor(low / math.log(10)) - _DIGITS + 1)
    speed = float(f"{math.floor(math.exp(low) / step) * step:.6g}")
    return speed if works(speed) else None


def _changes(f: Failure[Mechanism]) -> tuple[Change, ...]:
    given = f.m.given
    if given.spring != AUTO and held_of(given.model_copy(update={"spring": AUTO})) is not None:
        return ({"parameters.spring": AUTO},)
    speed = _slower(given)
    return () if speed is None else ({"parameters.speed": speed},)


def _remedy(f: Failure[Mechanism]) -> str:
    changes = [(key.partition(".")[2], value) for one in _changes(f) for key, value in one.items()]
    if not changes:
        return "make the follower lighter, or its load smaller"
    key, value = changes[0]
    return f'set {key} = "{value}"' if isinstance(value, str) else f"set {key} = {value:g}, or less inertia"


def _when(m: Mechanism) -> bool:
    return m.given.spring is not None


BOUGHT_SPRING = DesignRule[Mechanism](
    "follower.spring",
    "spring",
    _says,
    value=by_row(_lack),
    limit=0.0,
    remedy=_remedy,
    must_be="at most",
    proposed=_changes,
    when=_when,
    reported=no_figures,
    slow="remedy",
)


def _words(m: Mechanism) -> str:
    place = spring_place(m)
    if place is None:
        return "no spring"
    held, ends = place.held, np.array([0.0, m.stroke])
    low, high = held.pull(ends).tolist()
    short, long = held.length(ends).tolist()
    safety = fatigue_safety(low, high, held.spring.wire, held.spring.mean)
    least = weakest(m)
    return (
        f"extension spring {held.spring.name}: {low:.3g} N at {short:.4g} mm to {high:.3g} N at {long:.4g} "
        f"mm, safety against fatigue {safety:.3g}; its pins are at {abs(place.on_follower):.4g} mm on the "
        f"follower, and at x {place.stands.real:.2f}, y {place.stands.imag:.2f}; it presses with at least "
        f"{least.value:.3g} {_unit(m)} more than is asked, at {math.degrees(least.angle):.1f} degrees; a tenth "
        f"of what is asked is left where its force is {SCATTER:.0%} less; friction and weights are not counted"
    )


def _least(m: Mechanism) -> Any:
    return weakest(m).value


def _is_held(m: Mechanism) -> bool:
    return _when(m) and held_of(m.given) is not None


SPRING_NOTE = Note[Mechanism]("follower.spring-force", _words, _least, "N*m", when=_is_held)


def _inertia(m: Mechanism) -> Iterator[Finding]:
    """The spring is chosen for the inertia that is stated, so the parts must not have more."""
    own, stated = own_inertia(m), float(m.value("inertia"))
    if exceeds(own, stated):
        works = float(f"{own * INERTIA_SPARE:.2g}")
        yield Finding.error(
            "follower.inertia",
            "inertia",
            f"lever, roller and spring pin alone have {own:.3g} kg·m² about the lever's axis, and the spring "
            f"is chosen for {stated:.3g}",
            own,
            stated,
            "kg*m^2",
            f"set inertia = {works:g}, or more",
            Stage.PARTS,
            ({"parameters.inertia": works},),
        )


INERTIA = Procedure[Mechanism](["follower.inertia"], _inertia, when=_is_held)
