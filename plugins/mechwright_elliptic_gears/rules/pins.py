"""Checks of a joint that sets the phase on the machine: places of its holes, strength, play."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.mechanics.strength.allowed import PIN_SHEAR, REVERSING_KEY, allowed
from mechwright.mechanics.strength.bolts import CLAMP_SAFETY, lash
from mechwright.mechanics.strength.fastening import pin_pressure, pin_shear, ring_force
from mechwright.tolerances import falls_short
from mechwright_elliptic_gears.kinematics.equations import phase_offset, ratio
from mechwright_elliptic_gears.kinematics.figures import point_window
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.kinematics.window import Window
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.dividing import PITCH, START, phases_that_work
from mechwright_elliptic_gears.parts.gear import rack_of, room
from mechwright_elliptic_gears.parts.keeper import PLAY
from mechwright_elliptic_gears.parts.layout import DOWEL_GAP, PIN_HEAD, Layout, dividing_of, keeper_of


def pin_findings(params: EllipticGearParams) -> Iterator[Finding]:
    """The holes of the dividing circle, then the pin in them."""
    layout = Layout.of(params)
    found = [*_holes(params), *_circle(params, layout)]
    yield from found
    if errors(found):
        return
    yield from _strength(params, layout)
    yield _note(params)
    yield _held(params, layout)


def play_note(params: EllipticGearParams) -> Finding:
    """What the play of the pin does to the window."""
    return window_note(params, pin_play(params) / 2, "the play of the pin")


def pin_play(params: EllipticGearParams, holes: float | None = None, pin: float | None = None) -> float:
    """Free turn, rad, of gear 4 against gear 3: the play of the pin in both holes over its radius.

    ``holes`` and ``pin`` are diameters, mm; left out, those of the middles of their fits.
    """
    dividing = dividing_of(params)
    holes = dividing.hole_size.middle if holes is None else holes
    pin = dividing.pin_size.middle if pin is None else pin
    return lash(2 * (holes - pin), dividing.radius_at(params.phase_degrees))


def _holes(params: EllipticGearParams) -> Iterator[Finding]:
    dividing, given = dividing_of(params), params.phase_degrees
    if dividing.crowded is not None:
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
            proposed=({"parameters.phases": works},) if works else (),
        )
        return
    if dividing.hole_at(given) is None:
        nearest = min(params.set_phases, key=lambda phase: abs((phase - given + 180) % 360 - 180))
        yield Finding.error(
            "train.phase-hole",
            "phase",
            f"there is no hole for a phase of {given:g} degrees",
            given,
            nearest,
            "deg",
            f"set one of phases, the nearest is {nearest:g}; or add {given:g} to phases",
            proposed=({"parameters.phase": nearest},),
        )


def _circle(params: EllipticGearParams, layout: Layout) -> Iterator[Finding]:
    """Both circles outside the spacer, inside the rims of gears 3 and 4, and off the joint of gear 4."""
    dividing = dividing_of(params)
    least = layout.spacer + layout.dowel + 2 * DOWEL_GAP
    if falls_short(layout.dowel_circle, least):
        yield Finding.error(
            "train.dowels",
            "dowel_circle",
            f"a pin of {layout.dowel:g} mm on a circle of {layout.dowel_circle:g} mm runs into the spacer",
            layout.dowel_circle,
            least,
            "mm",
            f"make dowel_circle at least {least:g}",
        )
        return
    in_four = [radius * np.exp(1j * START) for radius in dividing.rings]
    holes = np.array([*(dividing.centre(hole) for hole in dividing.holes), *in_four])
    module = rack_of(params).module
    rim = room(params, np.column_stack((holes.real, holes.imag))) - layout.dowel / 2
    if falls_short(rim, LEAST_RIM * module):
        yield Finding.error(
            "train.dowel-rim",
            "dowel_circle",
            f"{rim:.2f} mm stay between the holes of the pin and the nearest root, below a module",
            rim,
            LEAST_RIM * module,
            "mm",
            "make dowel_circle or dowel_diameter smaller, leave phases out, or make the gears larger",
        )
        return
    wall = min(abs(hole - layout.focus) for hole in in_four) - (layout.dowel + layout.pin) / 2
    due = (PITCH - 1) * max(layout.dowel, layout.pin)
    if falls_short(wall, due):
        yield Finding.error(
            "train.dowels",
            "dowel_circle",
            f"{wall:.2f} mm stay between the pin and the joint of gear 4, below {due:.2f} mm",
            wall,
            due,
            "mm",
            "make dowel_circle, pin_diameter or dowel_diameter smaller",
        )


def _strength(params: EllipticGearParams, layout: Layout) -> Iterator[Finding]:
    """Shear of the pin and pressure in its holes at the worst of all phases."""
    dividing, d = dividing_of(params), layout.dowel
    forces = {
        phase: CLAMP_SAFETY
        * ring_force(greatest_torque(params, phase).value, 1, 2 * dividing.radius_at(phase))
        for phase in params.set_phases
    }
    worst = max(forces, key=lambda phase: forces[phase])
    force = forces[worst]
    shear, pressure = pin_shear(force, d), pin_pressure(force, d, params.thickness)
    most_shear = PIN_SHEAR["hardened, alternating"]
    most_pressure = REVERSING_KEY * allowed(params.material).key
    used = max(shear / most_shear, pressure / most_pressure)
    words = (
        f"at a phase of {worst:g} degrees inertia loads the pin with {force / CLAMP_SAFETY:.3g} N: with a "
        f"margin of {CLAMP_SAFETY:g} {shear:.3g} MPa of shear and {pressure:.3g} MPa on its holes"
    )
    if used <= 1:
        yield Finding.note("train.phase-pin", words, shear, "MPa")
        return
    most = rounded_down(params.speed / math.sqrt(used))
    yield Finding.error(
        "train.phase-pin",
        "speed",
        f"{words}, above {most_shear:g} and {most_pressure:g} MPa",
        params.speed,
        most,
        "rev/min",
        f"make speed at most {most:g}, or dowel_diameter or dowel_circle larger",
        proposed=({"parameters.speed": most},),
    )


def rounded_down(value: float, digits: int = 4) -> float:
    """A value above 0 with so many digits, never more than it was.

    >>> rounded_down(123.456), rounded_down(0.98765)
    (123.4, 0.9876)
    """
    step = 10 ** (math.floor(math.log10(value)) - digits + 1)
    return float(f"{math.floor(value / step) * step:.{digits}g}")


def _note(params: EllipticGearParams) -> Finding:
    """Where the pin stands, for the bench."""
    phase = params.phase_degrees
    turn = math.degrees(phase_offset(params.phase_angle or 0.0, params.eccentricity)) % 360
    dividing = dividing_of(params)
    table = ", ".join(
        f"{hole.phase:g} at {math.degrees(hole.angle - START) % 360:.3f}" for hole in dividing.holes
    )
    return Finding.note(
        "train.phase",
        f"a pin of {dividing.diameter:g} mm, {dividing.radius_at(phase):g} mm from the axis, holds gear 4 "
        f"{turn:.3f} degrees ahead of gear 3; phases and degrees of all holes: {table}",
        turn,
        "deg",
    )


def _held(params: EllipticGearParams, layout: Layout) -> Finding:
    """What keeps the pin from going up: its keeper, or nothing but its weight."""
    keeper = keeper_of(params)
    if keeper is not None:
        return Finding.note(
            "train.phase-pin-up",
            f"a stepped washer with an M{keeper.screw.of.size:g} x {keeper.screw.length:g} on gear 4 keeps "
            f"the pin down, {PLAY:g} mm over its head: take it off to set another phase",
            PLAY,
            "mm",
        )
    up = layout.crown - PIN_HEAD * layout.gap
    return Finding.note(
        "train.phase-pin-up",
        f"gear 4 has no room for a keeper, and its weight alone holds the pin down, {up:g} mm below the "
        "coupler: run the train with its axes upright and the coupler above, or take a clamp",
        up,
        "mm",
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


def window_note(params: EllipticGearParams, half: float, what: str) -> Finding:
    """What happens to the window where ``what`` turns gear 4 by ``half``, rad, either way."""
    lengths = [shifted_window(params, turn).length for turn in (-half, 0.0, half)]
    change = min(lengths) - lengths[1]
    return Finding.note(
        "train.phase-window",
        f"{what} lets gear 4 turn by ±{math.degrees(half):.3f} degrees: the window of near-constant speed is "
        f"{min(lengths):.3f} to {max(lengths):.3f} rad long, {lengths[1]:.3f} in the middle",
        change,
        "rad",
    )
