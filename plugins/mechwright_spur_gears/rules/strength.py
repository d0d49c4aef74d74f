"""Strength of teeth and keys under a steady torque (ISO 6336, simple form)."""

import numpy as np

from mechwright import material
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.strength.allowed import PIN_SHEAR, ROOT_SAFETY, allowed
from mechwright.mechanics.strength.fastening import LONGEST_KEY, key_pressure, key_shear
from mechwright.mechanics.strength.hertz import contact_modulus, line_pressure, relative_radius
from mechwright.mechanics.strength.judging import Stress, StressRule, Way
from mechwright.mechanics.strength.tooth_bending import STRAIGHT, Rack, root_stress
from mechwright_spur_gears.gear_table import GearTable, table_of
from mechwright_spur_gears.pair import module_of

KEY_STEEL = "steel"
"""Of keys."""


def tangential_force(m: GearTable) -> np.ndarray:
    """On the operating pitch circles, N."""
    return np.asarray(1000 * m.given.load_torque / abs(m.pair.operating(1)))


def root_stresses(m: GearTable) -> list[Stress]:
    """Bending at the roots; a tooth that is loaded at its tip carries alone. A ring's is one of a rack."""
    pair, given = m.pair, m.given
    own = Rack(pair.angle, given.addendum, given.dedendum, given.tip_radius)
    bears = allowed(given.material).root
    found = []
    for gear, flank in enumerate(m.flanks):
        height = pair.addendum[gear] + pair.shifts[gear] - pair.shortening
        value = root_stress(
            tangential_force(m) * np.cos(pair.operating_angle) / np.cos(pair.angle),
            given.thickness,
            pair.module,
            np.where(np.asarray(pair.teeth[gear]) < 0, STRAIGHT, pair.teeth[gear]),
            rack=own,
            shift=pair.shifts[gear],
            addendum=height,
        )
        what = f"teeth of {flank.words} are bent at their roots with"
        found.append(Stress(what, _number(value), bears, ROOT_SAFETY * bears))
    return found


def _number(value: np.ndarray) -> float:
    """A number of one design; a column stays one."""
    return value.item() if np.ndim(value) == 0 else value  # type: ignore[return-value]


def flank_pressures(m: GearTable) -> list[Stress]:
    """Hertz pressure at the pitch point; more than is allowed wears the flanks."""
    pair, own = m.pair, material(m.given.material)
    sine = np.sin(pair.operating_angle)
    radius = relative_radius(pair.operating(0) * sine, pair.operating(1) * sine)
    force = tangential_force(m) / np.cos(pair.operating_angle)
    pressure = line_pressure(force, m.given.thickness, radius, contact_modulus(own, own))
    what = "flanks press on each other with"
    return [Stress(what, _number(np.asarray(pressure)), allowed(m.given.material).contact)]


def key_stresses(m: GearTable) -> list[Stress]:
    """Pressure on the hubs and shear of the keys; none without keys."""
    if not m.single or m.opening is None or not m.opening.has_keyway:
        return []
    given, opening = m.given, m.opening
    torque = given.load_torque * max(0.0 if m.ring else 1.0, abs(float(m.ratio)))
    bears = min(given.thickness, LONGEST_KEY * opening.bore)
    pressure = key_pressure(torque, opening.bore, opening.key_top - opening.bore / 2, bears)
    sheared = key_shear(torque, opening.bore, opening.width, bears)
    own = material(given.material)
    return [
        Stress("the key presses on its hub with", pressure, allowed(given.material).key, own.strength),
        Stress("the key is sheared with", sheared, PIN_SHEAR["swelling"], material(KEY_STEEL).strength / 2),
    ]


def _wider(m: GearTable) -> Way:
    return Way("thickness", m.given.thickness)


def _larger(m: GearTable) -> Way:
    given = m.given
    if given.diametral_pitch is not None:
        return Way("diametral_pitch", given.diametral_pitch, up=False)
    return Way("module", module_of(given))


def _less(m: GearTable) -> Way:
    return Way("load_torque", m.given.load_torque, up=False)


ROOT = StressRule[GearTable](
    "gear.root", root_stresses, lambda m: [_wider(m), _larger(m), _less(m)], table_of
)
FLANK = StressRule[GearTable](
    "gear.flank", flank_pressures, lambda m: [_wider(m), _larger(m), _less(m)], table_of
)
KEY = StressRule[GearTable](
    "gear.key", key_stresses, lambda m: [_wider(m), Way("bore", m.given.bore), _less(m)], table_of
)
STRENGTH = all_of(ROOT, FLANK, KEY)
"""What teeth and keys bear."""
