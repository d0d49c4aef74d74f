"""Strength of the rollers' studs, and of the keys of wheel and driver, under the greatest load of a turn.

The stud is clamped in the crank plate, flush with its underside. The slot presses on the middle of
the roller.
"""

from collections.abc import Iterator
from functools import partial

from mechwright import Finding, material
from mechwright.geometry.keyway import Opening
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
from mechwright.mechanics.strength.judging import SHEAR_SHARE, STUD_SHARE, Stress, Way, judged
from mechwright_geneva.contact import loads
from mechwright_geneva.mechanism import Mechanism, mechanism_of
from mechwright_geneva.openings import driver_opening, wheel_opening
from mechwright_geneva.params import Sizes


def stud_findings(m: Mechanism, *, advise: bool = True) -> Iterator[Finding]:
    """What the studs bear, then how far they lean, then the keys; values that help only to ``advise``."""
    told = partial(judged, advise=advise)
    params, load = m.params, loads(m)
    said = f"{load.force:.4g} N on the roller"
    pin = Way("pin_diameter", params.pin_diameter)
    less = [Way("speed", params.speed, up=False), Way("load_inertia", params.load_inertia, up=False)]
    if params.load_torque:
        less.append(Way("load_torque", params.load_torque, up=False))
    deep = Way("crank_thickness", params.crank_thickness)
    yield from told("geneva.stud", params, stud_stresses, [pin, deep, *less], said)
    yield from told("geneva.stud-slope", params, stud_slopes, [pin, *less], said)
    key = [Way("thickness", params.thickness), Way("crank_thickness", params.crank_thickness), *less]
    yield from told("geneva.key", params, key_stresses, key)


def stud_stresses(params: Sizes) -> list[Stress]:
    """Bending and shear of a stud where it leaves the crank plate, and its pressure in the plate."""
    return stresses_under(params, loads(mechanism_of(params)).force)


def stresses_under(params: Sizes, force: float) -> list[Stress]:
    """The same under a force, N."""
    d = params.pin_diameter
    own = material(params.roller_material)
    endurance = allowed(params.roller_material).endurance
    weaker = min(own.strength, material(params.material).strength)
    held = min(allowed(name).key for name in (params.material, params.roller_material))
    return [
        Stress(
            "the stud is bent with", stud_bending(force, arm(params), d), STUD_SHARE * endurance, own.strength
        ),
        Stress("the stud is sheared with", stud_shear(force, d), SHEAR_SHARE * endurance, own.strength / 2),
        Stress(
            "the stud presses on its hole with",
            stud_pressure(force, arm(params), d, params.crank_thickness),
            held,
            weaker,
        ),
    ]


def stud_slopes(params: Sizes) -> list[Stress]:
    """How far the stud leans under its load: the roller then bears at its end."""
    force = loads(mechanism_of(params)).force
    _, slope = stud_deflection(
        force, arm(params), params.pin_diameter, material(params.roller_material).modulus
    )
    return [Stress("the stud leans by", 1e6 * slope, 1e6 * GEAR_SLOPE, unit="µrad")]


def key_stresses(params: Sizes) -> list[Stress]:
    """Pressure on the hub and shear of the keys of wheel and driver, whose torque changes its sign."""
    load = loads(mechanism_of(params))
    found = []
    driver = params.crank_thickness + params.thickness + params.axial_gap
    for name, opening, torque, length in (
        ("wheel", wheel_opening(params), load.wheel_torque, params.thickness),
        ("driver", driver_opening(params), load.crank_torque, driver),
    ):
        if opening is not None and opening.has_keyway:
            found += _key(params, name, opening, torque, length)
    return found


def _key(params: Sizes, name: str, opening: Opening, torque: float, length: float) -> list[Stress]:
    bore, bears = opening.bore, min(length, LONGEST_KEY * opening.bore)
    pressure = key_pressure(torque, bore, opening.key_top - bore / 2, bears)
    strength = material(params.material).strength
    return [
        Stress(
            f"the {name}'s key presses on its hub with",
            pressure,
            REVERSING_KEY * allowed(params.material).key,
            strength,
        ),
        Stress(
            f"the {name}'s key is sheared with",
            key_shear(torque, bore, opening.width, bears),
            PIN_SHEAR["alternating"],
            material("steel").strength / 2,
        ),
    ]


def arm(params: Sizes) -> float:
    """From the crank plate to the middle of the roller, mm."""
    return params.axial_gap + params.roller_length / 2
