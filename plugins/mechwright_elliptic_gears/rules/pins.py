"""Rules of a pin that sets the phase on the machine: places of its holes, strength, play."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, Stage, kept
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import by_row
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.mechanics.strength.allowed import PIN_SHEAR, REVERSING_KEY, allowed
from mechwright.mechanics.strength.bolts import CLAMP_SAFETY, lash
from mechwright.mechanics.strength.fastening import pin_pressure, pin_shear, ring_force
from mechwright_elliptic_gears.kinematics.equations import phase_offset, ratio
from mechwright_elliptic_gears.kinematics.figures import point_window
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.kinematics.window import Window
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.dividing import PITCH, START, phases_that_work
from mechwright_elliptic_gears.parts.gear import room
from mechwright_elliptic_gears.parts.keeper import PLAY
from mechwright_elliptic_gears.parts.layout import DOWEL_GAP, PIN_HEAD, dividing_of, keeper_of, layout_of
from mechwright_elliptic_gears.table import GearTable

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def pin_play(params: EllipticGearParams, holes: float | None = None, pin: float | None = None) -> float:
    """Free turn, rad, of gear 4 against gear 3: the play of the pin in both holes over its radius.

    ``holes`` and ``pin`` are diameters, mm. Default: those of the middles of their fits.
    """
    dividing = dividing_of(params)
    holes = dividing.hole_size.middle if holes is None else holes
    pin = dividing.pin_size.middle if pin is None else pin
    return lash(2 * (holes - pin), dividing.radius_at(params.phase_degrees))


def _crowded(m: GearTable) -> Iterator[Finding]:
    """Phases whose holes find no place beside each other."""
    params, dividing = m.given, dividing_of(m.given)
    if dividing.crowded is None:
        return
    one, two = dividing.crowded
    works = phases_that_work(dividing, params.set_phases, params.eccentricity)
    words = "" if works is None else ", ".join(f"{phase:g}" for phase in works)
    yield Finding.error(
        "train.phases",
        "phases",
        f"the hole for {two:g} degrees has no wall of half a diameter to that for {one:g} degrees, on a "
        f"circle of {2 * dividing.radius:g} mm or one outside of it",
        two,
        None if works is None else min(set(works) - set(params.set_phases), key=lambda p: abs(p - two)),
        "deg",
        "leave one out, or make dowel_diameter smaller"
        + (f"; the nearest phases that work are {words}" if works else ""),
        Stage.PARTS,
        ({"parameters.phases": works},) if works else (),
    )


CROWDED = Procedure[GearTable](("train.phases",), _crowded, stage=Stage.PARTS)


def _nearest(f: Fails) -> tuple[float, float]:
    """The phase that is set, and the nearest one that has a hole, degrees."""
    given = f.m.given.phase_degrees
    return given, min(f.m.given.set_phases, key=lambda phase: abs((phase - given + 180) % 360 - 180))


NO_HOLE = Rule(
    "train.phase-hole",
    "phase",
    "there is no hole for a phase of {m.given.phase_degrees:g} degrees",
    value=by_row(lambda m: float(dividing_of(m.given).hole_at(m.given.phase_degrees) is None)),
    limit=0.0,
    unit="deg",
    remedy=lambda f: (
        f"set one of phases, the nearest is {_nearest(f)[1]:g}; or add {_nearest(f)[0]:g} to phases"
    ),
    must_be="at most",
    reported=_nearest,
    proposed=lambda f: ({"parameters.phase": _nearest(f)[1]},),
)
DOWEL_SPACER = Rule(
    "train.dowels",
    "dowel_circle",
    "dowels of {m.layout.dowel:g} mm on a circle of {value:g} mm run into the spacer",
    value=lambda m: m.layout.dowel_circle,
    limit=lambda m: m.layout.spacer + m.layout.dowel + 2 * DOWEL_GAP,
    unit="mm",
    remedy="make dowel_circle at least {limit:g}",
)
PIN_SPACER = DOWEL_SPACER.but(
    message="a pin of {m.layout.dowel:g} mm on a circle of {value:g} mm runs into the spacer"
)


def _in_four(m: GearTable) -> list[complex]:
    """Middles of the holes of gear 4."""
    return [complex(radius * np.exp(1j * START)) for radius in dividing_of(m.given).rings]


def _rim(m: GearTable) -> float:
    dividing = dividing_of(m.given)
    holes = np.array([*(dividing.centre(hole) for hole in dividing.holes), *_in_four(m)])
    return room(m.given, np.column_stack((holes.real, holes.imag))) - m.layout.dowel / 2


PIN_RIM = Rule(
    "train.dowel-rim",
    "dowel_circle",
    "{value:.2f} mm stay between the holes of the pin and the nearest root, below a module",
    value=by_row(_rim),
    limit=lambda m: LEAST_RIM * m.module,
    unit="mm",
    remedy="make dowel_circle or dowel_diameter smaller, leave phases out, or make the gears larger",
)


def _wall(m: GearTable) -> float:
    layout = m.layout
    return min(abs(hole - layout.focus) for hole in _in_four(m)) - (layout.dowel + layout.pin) / 2


PIN_WALL = Rule(
    "train.dowels",
    "dowel_circle",
    "{value:.2f} mm stay between the pin and the joint of gear 4, below {limit:.2f} mm",
    value=by_row(_wall),
    limit=lambda m: (PITCH - 1) * np.maximum(m.layout.dowel, m.layout.pin),
    unit="mm",
    remedy="make dowel_circle, pin_diameter or dowel_diameter smaller",
)

MOST_SHEAR = PIN_SHEAR["hardened, alternating"]


@kept
def _loaded(params: EllipticGearParams) -> tuple[float, float, float, float]:
    """The worst phase, degrees, and the force on the pin there, N, its shear and its pressure, MPa."""
    dividing, d = dividing_of(params), layout_of(params).dowel
    forces = {
        phase: CLAMP_SAFETY
        * ring_force(greatest_torque(params, phase).value, 1, 2 * dividing.radius_at(phase))
        for phase in params.set_phases
    }
    worst = max(forces, key=lambda phase: forces[phase])
    force = forces[worst]
    return worst, force, pin_shear(force, d), pin_pressure(force, d, params.thickness)


def _most_pressure(m: GearTable) -> float:
    return REVERSING_KEY * allowed(m.given.material).key


def _used(m: GearTable) -> float:
    """Share of what is allowed."""
    *_, shear, pressure = _loaded(m.given)
    return max(shear / MOST_SHEAR, pressure / _most_pressure(m))


def _load(m: GearTable) -> str:
    worst, force, shear, pressure = _loaded(m.given)
    return (
        f"at a phase of {worst:g} degrees inertia loads the pin with {force / CLAMP_SAFETY:.3g} N: with a "
        f"margin of {CLAMP_SAFETY:g} {shear:.3g} MPa of shear and {pressure:.3g} MPa on its holes"
    )


def slower(f: Fails) -> float:
    """The speed, rev/min, at which a share of what is allowed is 1: inertia grows with its square."""
    return rounded_down(f.m.given.speed / math.sqrt(f.value))


STRENGTH = Rule(
    "train.phase-pin",
    "speed",
    lambda f: f"{_load(f.m)}, above {MOST_SHEAR:g} and {_most_pressure(f.m):g} MPa",
    value=by_row(_used),
    limit=1.0,
    unit="rev/min",
    remedy=lambda f: f"make speed at most {slower(f):g}, or dowel_diameter or dowel_circle larger",
    must_be="at most",
    reported=lambda f: (f.m.given.speed, slower(f)),
    proposed=lambda f: ({"parameters.speed": slower(f)},),
)
LOAD = Note[GearTable](
    "train.phase-pin", _load, lambda m: _loaded(m.given)[2], "MPa", when=lambda m: _used(m) <= 1
)


def rounded_down(value: float, digits: int = 4) -> float:
    """A value above 0 with so many digits, never more than it was.

    >>> rounded_down(123.456), rounded_down(0.98765)
    (123.4, 0.9876)
    """
    step = 10 ** (math.floor(math.log10(value)) - digits + 1)
    return float(f"{math.floor(value / step) * step:.{digits}g}")


def ahead(m: GearTable) -> float:
    """How far gear 4 stands ahead of gear 3, degrees."""
    return math.degrees(phase_offset(m.given.phase_angle or 0.0, m.given.eccentricity)) % 360


def _place(m: GearTable) -> str:
    """Where the pin stands, for the bench."""
    dividing = dividing_of(m.given)
    table = ", ".join(
        f"{hole.phase:g} at {math.degrees(hole.angle - START) % 360:.3f}" for hole in dividing.holes
    )
    return (
        f"a pin of {dividing.diameter:g} mm, {dividing.radius_at(m.given.phase_degrees):g} mm from the axis, "
        f"holds gear 4 {ahead(m):.3f} degrees ahead of gear 3; phases and degrees of all holes: {table}"
    )


def _air(m: GearTable) -> float:
    """Over the pin's head, mm."""
    return PLAY if keeper_of(m.given) is not None else m.layout.crown - PIN_HEAD * m.layout.gap


def _kept_down(m: GearTable) -> str:
    """What keeps the pin from going up: its keeper, or nothing but its weight."""
    keeper = keeper_of(m.given)
    if keeper is not None:
        return (
            f"a stepped washer with an M{keeper.screw.of.size:g} x {keeper.screw.length:g} on gear 4 keeps "
            f"the pin down, {PLAY:g} mm over its head: take it off to set another phase"
        )
    return (
        f"gear 4 has no room for a keeper, and its weight alone holds the pin down, {_air(m):g} mm below the "
        "coupler: run the train with its axes upright and the coupler above, or take a clamp"
    )


def shifted_window(params: EllipticGearParams, turn: float) -> Window:
    """The window of near-constant speed with gear 4 turned by ``turn``, rad, against gear 3."""
    e, gamma = params.eccentricity, params.phase_angle or 0.0
    # dφ/dγ is -ω3/ω2 at γ; a second step makes the shift exact to far below what a window shows.
    shift = 0.0
    for _ in range(4):
        error = turn - (phase_offset(gamma + shift, e) - phase_offset(gamma, e))
        shift += error / -float(ratio(np.cos(np.asarray(gamma + shift)), e))
    return point_window(params.model_copy(update={"phase": math.degrees(gamma + shift)}))


def _windows(m: GearTable, half: float) -> list[float]:
    """Lengths, rad, of the window with gear 4 turned by ``half``, rad, back, not at all, and ahead."""
    return [shifted_window(m.given, turn).length for turn in (-half, 0.0, half)]


def window_note(half: Any, what: Any) -> Note[GearTable]:
    """What happens to the window where ``what(m)`` turns gear 4 by ``half(m)``, rad, either way."""

    def message(m: GearTable) -> str:
        lengths = _windows(m, half(m))
        return (
            f"{what(m)} lets gear 4 turn by ±{math.degrees(half(m)):.3f} degrees: the window of "
            f"near-constant speed is {min(lengths):.3f} to {max(lengths):.3f} rad long, {lengths[1]:.3f} in "
            "the middle"
        )

    def change(m: GearTable) -> float:
        lengths = _windows(m, half(m))
        return min(lengths) - lengths[1]

    return Note("train.phase-window", message, change, "rad")


PINS = in_turn(
    all_of(in_turn(CROWDED, NO_HOLE), in_turn(PIN_SPACER, PIN_RIM, PIN_WALL)),
    all_of(
        STRENGTH,
        LOAD,
        Note[GearTable]("train.phase", _place, ahead, "deg"),
        Note[GearTable]("train.phase-pin-up", _kept_down, _air, "mm"),
    ),
    window_note(lambda m: pin_play(m.given) / 2, lambda _: "the play of the pin"),
)
"""The holes of the dividing circle, then the pin in them."""
