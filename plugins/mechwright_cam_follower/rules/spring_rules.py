"""The spring and the guide that are bought: whether one holds the follower, and what they bear."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, Stage, kept
from mechwright.contracts.design_rule import DesignRule, Failure, no_figures
from mechwright.contracts.design_table import by_row
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note, Procedure
from mechwright.standards.linear_guides import linear_guides
from mechwright.standards.spring_strength import fatigue_safety
from mechwright.standards.springs import SCATTER
from mechwright.tolerances import exceeds
from mechwright_cam_follower.field_kinds import AUTO
from mechwright_cam_follower.kinematics.extremes import face_ends, load_peak, pressure_peak, weakest
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.follower_dimensions import follower_depth
from mechwright_cam_follower.parts.moved_mass import own_inertia, own_mass
from mechwright_cam_follower.parts.slide_dimensions import carriage_place
from mechwright_cam_follower.parts.spring_parts import spring_place
from mechwright_cam_follower.spring.choice import SAFE, mounted_spring, nearest

SPARE = 1.15
"""What is proposed over the mass or inertia of the parts: another spring has another pin and another tail."""

GUIDE_SAFETY = 2.0
"""Of a carriage against its static moment: it runs for long, and the figures are a handbook's."""

SLOWEST = 0.01
"""Speed of the design table, rev/min, below which no remedy is looked for."""

_HALVINGS = 10

_DIGITS = 3
"""Of a speed that is proposed."""


def _unit(m: Mechanism) -> str:
    return "N" if m.slides else "N·m"


def _lack(m: Mechanism) -> float:
    """0 where a spring holds the follower, else what the nearest lacks; infinite where none has room."""
    if mounted_spring(m.given) is not None:
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
    mounted, lack = found
    near = "" if given.spring != AUTO else f"; the nearest, {mounted.spring.name},"
    return (
        f"{what} holds the follower on its cam at {given.speed:g} rev/min with a safety of {SAFE:g} against "
        f"fatigue{near} lacks {lack:.3g} {_unit(f.m)}"
    )


@kept
def _slower(params: CamParams) -> float | None:
    """The greatest speed below the present one, rev/min, that some spring bears; None where none is."""

    def works(speed: float) -> bool:
        return mounted_spring(params.model_copy(update={"speed": speed})) is not None

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
    if given.spring != AUTO and mounted_spring(given.model_copy(update={"spring": AUTO})) is not None:
        return ({"parameters.spring": AUTO},)
    speed = _slower(given)
    return () if speed is None else ({"parameters.speed": speed},)


def _remedy(f: Failure[Mechanism]) -> str:
    changes = [(key.partition(".")[2], value) for one in _changes(f) for key, value in one.items()]
    if not changes:
        return "make the follower lighter, or its load smaller"
    key, value = changes[0]
    if isinstance(value, str):
        return f'set {key} = "{value}"'
    return f"set {key} = {value:g}, or make the follower lighter"


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
    mounted, ends = place.mounted, np.array([0.0, m.stroke])
    low, high = mounted.pull(ends).tolist()
    short, long = mounted.length(ends).tolist()
    safety = fatigue_safety(low, high, mounted.spring.wire, mounted.spring.mean)
    least = weakest(m)
    stands = f"x {place.stands.real:.2f}, y {place.stands.imag:.2f}"
    left = f"{least.value:.3g} {_unit(m)} are left over what is asked"
    return (
        f"extension spring {mounted.spring.name}: {low:.3g} N at {short:.4g} mm to {high:.3g} N at "
        f"{long:.4g} mm, safety against fatigue {safety:.3g}; its pins are at "
        f"{abs(place.on_follower):.4g} mm on the follower, and at {stands}; {left}, at "
        f"{math.degrees(least.angle):.1f} degrees, and a tenth of what is asked if its force is "
        f"{SCATTER:.0%} less; friction and weights are not counted"
    )


def _least(m: Mechanism) -> Any:
    return weakest(m).value


def _is_mounted(m: Mechanism) -> bool:
    return _when(m) and mounted_spring(m.given) is not None


def _note(unit: str, *, slides: bool) -> Note[Mechanism]:
    return Note(
        "follower.spring-force", _words, _least, unit, when=lambda m: m.slides == slides and _is_mounted(m)
    )


SPRING_NOTES = (_note("N", slides=True), _note("N*m", slides=False))


def _moved(m: Mechanism) -> Iterator[Finding]:
    """The spring is chosen for the mass or inertia that is stated, so the parts must not have more."""
    key, unit = ("mass", "kg") if m.slides else ("inertia", "kg*m^2")
    own, stated = (own_mass if m.slides else own_inertia)(m), float(m.value(key))
    if exceeds(own, stated):
        works = float(f"{own * SPARE:.2g}")
        what = (
            f"slide, roller, spring pin and carriage alone have {own:.3g} kg"
            if m.slides
            else f"lever, roller and spring pin alone have {own:.3g} kg·m² about the lever's axis"
        )
        yield Finding.error(
            f"follower.{key}",
            key,
            f"{what}, and the spring is chosen for {stated:.3g}",
            own,
            stated,
            unit,
            f"set {key} = {works:g}, or more",
            Stage.PARTS,
            ({f"parameters.{key}": works},),
        )


MOVED = Procedure[Mechanism](["follower.mass", "follower.inertia"], _moved, when=_is_mounted)


def _tilts(m: Mechanism) -> float:
    """Moment about both axes across the way over what the carriage bears; 0 without one."""
    guide = m.given.linear_guide
    if guide is None:
        return 0.0
    force = float(load_peak(m, "contact_force_max").value)
    sideways = force * math.sin(float(pressure_peak(m).value))
    far = float(carriage_place(m)) + m.roller
    if m.flat:
        far = float(carriage_place(m)) + max(map(abs, face_ends(m)))
    low = guide.height - guide.under
    place = spring_place(m)
    pull = (
        0.0 if place is None else place.mounted.strongest * (place.mounted.height + follower_depth(m) + low)
    )
    moment = sideways * far + force * (low + m.given.thickness) + pull
    return float(moment / 1000 / guide.tilt)


GUIDE = DesignRule[Mechanism](
    "follower.guide-moment",
    "guide",
    lambda f: f"contact and spring tilt the carriage with {f.value:.2f} of the static moment of its guide",
    value=by_row(_tilts),
    limit=1 / GUIDE_SAFETY,
    remedy="take a larger guide, or load it less",
    must_be="at most",
    proposed=lambda f: tuple(
        {"parameters.guide": one.name} for one in linear_guides() if one.name > str(f.m.given.guide)
    ),
    when=lambda m: m.given.linear_guide is not None,
)
