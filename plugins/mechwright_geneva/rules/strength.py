"""Rules of motion and load: peaks against the straight slot, the middle position, pressure, studs, keys.

The stud is clamped in the crank plate, flush with its underside. The slot presses on the middle of the
roller.
"""

import math
from typing import Any

import numpy as np

from mechwright import Severity, material
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import all_of
from mechwright.geometry.keyway import KeySize, key_of_width
from mechwright.mechanics.strength.allowed import PIN_SHEAR, REVERSING_KEY, allowed
from mechwright.mechanics.strength.beam import GEAR_SLOPE
from mechwright.mechanics.strength.fastening import (
    LONGEST_KEY,
    key_pressure,
    key_shear,
    stud_bending,
    stud_deflection,
    stud_pressure,
    stud_shear,
)
from mechwright.mechanics.strength.judging import SHEAR_SHARE, STUD_SHARE, Stress, StressRule, Way
from mechwright_geneva.kinematics.contact_forces import loads, strength
from mechwright_geneva.kinematics.figures import peaks_of, straight_peaks
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.kinematics.wall_change import switches
from mechwright_geneva.parameters import GenevaParams, Sizes
from mechwright_geneva.rules.slot_search import is_valid_at
from mechwright_geneva.rules.slots import speed_ratio

JUMP = 1e-3
"""End acceleration d²s/du² that is not the rounding of a table: below a thousandth of that of most laws."""

LEVEL = 1e-6
"""Acceleration of the driver over the square of its speed that is rounding."""

NAMED = 6
"""Changes of walls that a finding names; summary.json has all."""

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]


def _has_defaults(m: Mechanism) -> bool:
    """Whether law and angles are those of a design that states none: nobody is warned of these."""
    default = m.given.law == GenevaParams.model_fields["law"].default
    return default and "crank_half_angle" in m.params.left_out


def _gentler_law(f: Fails) -> str:
    half = math.ceil(10 * math.degrees(f.m.crank_half * math.sqrt(f.value / f.limit))) / 10
    longer = f"make crank_half_angle at least {half:g}, " if is_valid_at(f.m, half) else ""
    return f"{longer}choose a law with a lower peak, or accept it for the sake of the jerk"


ACCELERATION = Rule(
    "geneva.acceleration",
    "law",
    lambda f: (
        f"the wheel accelerates more than with {f.m.slots} straight slots: {f.value:.4g} against "
        f"{f.limit:.4g} per crank speed squared (the straight slot jerks at its ends instead)"
    ),
    value=lambda m: peaks_of(m).a,
    limit=lambda m: straight_peaks(m.slots).a,
    remedy=_gentler_law,
    must_be="at most",
    severity=Severity.WARNING,
    when=lambda m: not _has_defaults(m),
)
JUMPS = Rule(
    "geneva.jump",
    "law",
    "{m.law.name} starts or ends with a jump of the acceleration: an impact in every stroke",
    value=lambda m: max(abs(jump) for jump in m.law.jumps),
    limit=JUMP,
    remedy="choose a law whose acceleration is 0 at both ends",
    must_be="at most",
    severity=Severity.WARNING,
    reported=lambda f: (max(abs(jump) for jump in f.m.law.jumps), 0.0),
)


def _middles(m: Mechanism) -> Any:
    """The driver in the middle of the strokes of a turn."""
    strokes = np.array(m.different_strokes, dtype=float)
    return m.driver.at(m.crank_half + m.pitch * strokes)


def _slowest(m: Mechanism) -> Any:
    """Least speed of the driver in the middle of a stroke, rad/s."""
    least = np.abs(_middles(m).omega).min(axis=-1, keepdims=not m.single)
    return float(least) if m.single else least


def _work(m: Mechanism) -> Any:
    """What the load takes while the roller cannot turn the wheel, mJ."""
    return m.params.load_torque * loads(m).carried * 1e3


def _energy(m: Mechanism) -> Any:
    """Kinetic energy of the wheel there, mJ."""
    return m.params.load_inertia * (speed_ratio(m) * _slowest(m)) ** 2 / 2 * 1e3


def _stalls(m: Mechanism) -> Any:
    return np.asarray(_work(m)) >= _energy(m)


def _middle_message(f: Fails) -> str:
    m, work, energy = f.m, _work(f.m), _energy(f.m)
    lost = 1.0 if work >= energy else 1 - math.sqrt(1 - work / energy)
    return (
        f"at mid stroke, {math.degrees(m.crank_half):g} degrees of the crank, the roller cannot turn "
        f"the wheel: its own inertia carries {m.params.load_torque:g} N·m over "
        f"{math.degrees(loads(m).carried):.2f} degrees and "
        + ("stops there" if work >= energy else f"loses {100 * lost:.3g} % of its speed")
    )


def _faster(f: Fails) -> str:
    energy = _energy(f.m)
    if energy <= 0 or f.value < energy:
        return "raise load_inertia, or use straight slots where a torque has to be held at every instant"
    least = _slowest(f.m) * math.sqrt(f.value / energy) * 60 / math.tau
    there = "there above" if f.m.driver.varies else "above"
    return f"run {there} {math.ceil(least):g} rev/min, raise load_inertia, or use straight slots"


STALL = Rule(
    "geneva.singular",
    "load_torque",
    _middle_message,
    value=_work,
    limit=_energy,
    unit="mJ",
    remedy=_faster,
    must_be="below",
    when=lambda m: np.asarray(m.params.load_torque) > 0,
)
LOST_SPEED = STALL.but(
    severity=Severity.WARNING,
    limit=0.0,
    when=lambda m: (np.asarray(m.params.load_torque) > 0) & ~_stalls(m),
    reported=lambda f: (f.value, _energy(f.m)),
)


def _ramp(m: Mechanism) -> tuple[Any, float, float]:
    """Moment that is missing, N·m, greatest acceleration of the driver, rad/s², and its share of w²."""
    middles, ratio = _middles(m), speed_ratio(m)
    worst = int(np.argmax(np.abs(middles.alpha)))
    alpha = float(middles.alpha[worst])
    return (
        m.params.load_inertia * ratio * abs(alpha),
        alpha,
        abs(alpha) * ratio / float(middles.omega[worst]) ** 2,
    )


RAMP = Rule(
    "geneva.ramp",
    "driver_law",
    lambda f: (
        f"the driver accelerates by {_ramp(f.m)[1]:.4g} rad/s^2 in the middle of a stroke, where the "
        f"roller cannot turn the wheel: {f.value:.4g} N·m are missing, and the wheel coasts through the "
        "clearance"
    ),
    value=lambda m: _ramp(m)[0],
    limit=0.0,
    unit="N*m",
    remedy="have the driver reach its speed while the wheel rests; at constant speed the wheel needs no "
    "torque there",
    must_be="at most",
    severity=Severity.WARNING,
    when=lambda m: _ramp(m)[2] > LEVEL,
)
PRESSURE = Rule(
    "geneva.pressure",
    "load_inertia",
    lambda f: (
        f"the Hertz pressure reaches {f.value:.0f} MPa at "
        f"{math.degrees(loads(f.m).pressure_at):.1f} degrees of the crank; {f.m.params.material} on "
        f"{f.m.params.roller_material} yields from {f.limit:.0f} MPa"
    ),
    value=lambda m: loads(m).pressure,
    limit=lambda m: strength(m.params.material, m.params.roller_material),
    unit="MPa",
    remedy="use a stronger material, a longer roller or a lower speed",
    must_be="at most",
    severity=Severity.WARNING,
)


def _contact_message(m: Mechanism) -> str:
    load = loads(m)
    carrier = "the straight wall" if m.straight else ("the islands" if load.island else "the hub's side")
    degrees = math.degrees(load.steep)
    steep = "" if m.straight else f"; over {degrees:.1f} degrees the pressure angle is above 45"
    return (
        f"greatest contact force {load.force:.4g} N at {math.degrees(load.force_at):.2f} degrees of "
        f"the crank, on {carrier}; Hertz pressure {load.pressure:.4g} MPa, crank torque "
        f"{load.crank_torque:.4g} N·m{steep}"
    )


def arm(params: Sizes) -> float:
    """From the crank plate to the middle of the roller, mm."""
    return params.axial_gap + params.roller_length / 2


def stud_stresses(m: Mechanism) -> list[Stress]:
    """Bending and shear of a stud where it leaves the crank plate, and its pressure in the plate."""
    params, force, d = m.params, loads(m).force, m.params.pin_diameter
    own, arms = material(params.roller_material), arm(params)
    endurance = allowed(params.roller_material).endurance
    weaker = min(own.strength, material(params.material).strength)
    held = min(allowed(name).key for name in (params.material, params.roller_material))
    bent, sheared = STUD_SHARE * endurance, SHEAR_SHARE * endurance
    pressure = stud_pressure(force, arms, d, params.crank_thickness)
    return [
        Stress("the stud is bent with", stud_bending(force, arms, d), bent, own.strength),
        Stress("the stud is sheared with", stud_shear(force, d), sheared, own.strength / 2),
        Stress("the stud presses on its hole with", pressure, held, weaker),
    ]


def stud_slopes(m: Mechanism) -> list[Stress]:
    """How far the stud leans under its load: the roller then bears at its end."""
    params = m.params
    modulus = material(params.roller_material).modulus
    _, slope = stud_deflection(loads(m).force, arm(params), params.pin_diameter, modulus)
    return [Stress("the stud leans by", 1e6 * slope, 1e6 * GEAR_SLOPE, unit="µrad")]


def key_stresses(m: Mechanism) -> list[Stress]:
    """Pressure on the hub and shear of the keys of wheel and driver, whose torque changes its sign."""
    params, found = m.params, []
    driver = params.crank_thickness + params.disc_thickness
    for name, bore, width, torque, length in (
        ("wheel", params.bore, params.keyway_width, loads(m).wheel_torque, params.thickness),
        ("driver", params.driver_bore, params.driver_keyway_width, loads(m).crank_torque, driver),
    ):
        key = key_of_width(width)
        if key is not None:
            found += _key(params, name, key, bore, torque, length)
    return found


def _key(params: Sizes, name: str, key: KeySize, bore: float, torque: float, length: float) -> list[Stress]:
    bears, proud = np.minimum(length, LONGEST_KEY * bore), key.height - key.shaft_depth
    pressure = key_pressure(torque, bore, proud, bears)
    shear = key_shear(torque, bore, key.width, bears)
    hub, own = REVERSING_KEY * allowed(params.material).key, material(params.material).strength
    steel = material("steel").strength / 2
    return [
        Stress(f"the {name}'s key presses on its hub with", pressure, hub, own),
        Stress(f"the {name}'s key is sheared with", shear, PIN_SHEAR["alternating"], steel),
    ]


def _less(m: Mechanism) -> list[Way]:
    """Less speed and less load."""
    params = m.params
    ways = [Way("speed", params.speed, up=False), Way("load_inertia", params.load_inertia, up=False)]
    return [*ways, Way("load_torque", params.load_torque, up=False)] if params.load_torque else ways


def _stud_ways(m: Mechanism) -> list[Way]:
    return [Way("pin_diameter", m.params.pin_diameter)]


def _plates(m: Mechanism) -> list[Way]:
    params = m.params
    return [Way("thickness", params.thickness), Way("crank_thickness", params.crank_thickness)]


def _load(m: Mechanism) -> str:
    return f"{loads(m).force:.4g} N on the roller"


STUD = StressRule(
    "geneva.stud",
    stud_stresses,
    lambda m: [*_stud_ways(m), _plates(m)[1], *_less(m)],
    Mechanism,
    _load,
)
STUD_SLOPE = StressRule(
    "geneva.stud-slope", stud_slopes, lambda m: [*_stud_ways(m), *_less(m)], Mechanism, _load
)
KEY = StressRule("geneva.key", key_stresses, lambda m: [*_plates(m), *_less(m)], Mechanism)


def _walls_message(m: Mechanism) -> str:
    found = switches(m)
    if not found:
        wall = "one wall" if m.straight else "one wall, the same on the way back,"
        return f"{wall} carries all of the stroke"
    said = []
    for one in found[:NAMED]:
        met = "which it does not come to" if one.impact is None else f"met with {one.impact:.3g} mm/s"
        said.append(
            f"{math.degrees(one.theta):.4f} degrees at {abs(one.omega) * 60 / math.tau:.4g} rev/min to the "
            f"{one.wall} wall, {met}"
        )
    more = f", and {len(found) - NAMED} more" if len(found) > NAMED else ""
    across = f"the roller changes walls across {m.params.groove_clearance:g} mm"
    return f"{across} at {'; '.join(said)}{more}"


STRENGTH = all_of(
    all_of(
        ACCELERATION,
        ACCELERATION.but(severity=Severity.NOTE, when=_has_defaults),
        JUMPS,
        STALL,
        LOST_SPEED,
        RAMP,
        when=lambda m: not m.straight,
    ),
    PRESSURE,
    Note("geneva.contact", _contact_message, lambda m: loads(m).force, "N"),
    STUD,
    STUD_SLOPE,
    KEY,
    Note("geneva.walls", _walls_message, lambda m: len(switches(m))),
)
"""Of motion and load, in order."""
