"""Strength of teeth and keys under a steady torque (ISO 6336, simple form)."""

from collections.abc import Sequence

import numpy as np

from mechwright import material
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.linkage.turned import PIN_MATERIAL
from mechwright.mechanics.strength.allowed import REVERSING_ROOT, ROOT_SAFETY, allowed
from mechwright.mechanics.strength.fastening import (
    stud_bending,
    stud_shear,
)
from mechwright.mechanics.strength.gear_stresses import loaded_key
from mechwright.mechanics.strength.hertz import contact_modulus, line_pressure, relative_radius
from mechwright.mechanics.strength.judging import SHEAR_SHARE, STUD_SHARE, Stress, StressRule, Way
from mechwright.mechanics.strength.tooth_bending import STRAIGHT, Rack, root_stress
from mechwright_spur_gears.gear_table import AXIAL_GAP, GearTable, table_of
from mechwright_spur_gears.kinematics.rack import pinion_torque
from mechwright_spur_gears.pair import module_of
from mechwright_spur_gears.rules.teeth_rules import rolls


def root_stresses(m: GearTable) -> list[Stress]:
    """Bending at the roots; a tooth that is loaded at its tip carries alone. A ring's is one of a rack.

    Planets are pressed on by the sun on one side of their teeth, and by the ring on the other. The load of a
    rack is against it on both its ways.
    """
    given, bears, found = m.given, allowed(m.given.material).root, []
    for one in m.flanks:
        pair, gear = m.meshes[one.mesh], one.gear
        own = Rack(pair.angle, given.addendum, given.dedendum, given.tip_radius)
        value = root_stress(
            m.normal_force * np.cos(pair.angle),
            given.thickness,
            pair.module,
            np.where(rolls(pair, gear), pair.teeth[gear], STRAIGHT),
            rack=own,
            shift=pair.shifts[gear],
            addendum=pair.addendum[gear] + pair.shifts[gear] - pair.shortening,
        )
        what = f"teeth of {one.words} are bent at their roots with"
        both_ways = REVERSING_ROOT if one.bore == "pin_diameter" or m.straight else 1.0
        found.append(Stress(what, _number(value), both_ways * bears, ROOT_SAFETY * bears))
    return found


def _number(value: np.ndarray) -> float:
    """A number of one design; a column stays one."""
    return value.item() if np.ndim(value) == 0 else value  # type: ignore[return-value]


def flank_pressures(m: GearTable) -> list[Stress]:
    """Hertz pressure at the pitch points; more than is allowed wears the flanks."""
    own, found = material(m.given.material), []
    for pair in m.meshes:
        sine = np.sin(pair.operating_angle)
        radius = relative_radius(pair.operating(0) * sine, pair.operating(1) * sine)
        pressure = line_pressure(m.normal_force, m.given.thickness, radius, contact_modulus(own, own))
        limit = allowed(m.given.material).contact
        found.append(Stress("flanks press on each other with", _number(np.asarray(pressure)), limit))
    return found


def pin_stresses(m: GearTable) -> list[Stress]:
    """Bending and shear of the pins of planets, on which sun and ring press with twice a tooth's force."""
    if not m.planetary:
        return []
    given, d, own = m.dimensions, m.dimensions.pin_diameter, material(PIN_MATERIAL)
    force = 2 * m.normal_force * np.cos(m.pair.operating_angle)
    endurance, arm = allowed(PIN_MATERIAL).endurance, AXIAL_GAP + given.thickness / 2
    bent, sheared = (stud_bending(force, arm, d), stud_shear(force, d))
    return [
        Stress(
            "a planet's pin is bent with", _number(np.asarray(bent)), STUD_SHARE * endurance, own.strength
        ),
        Stress(
            "a planet's pin is sheared with",
            _number(np.asarray(sheared)),
            SHEAR_SHARE * endurance,
            own.strength / 2,
        ),
    ]


def _shaft_torque(m: GearTable) -> float:
    """Greatest torque on a gear with a shaft, N m; a ring has none."""
    if m.straight:
        return float(pinion_torque(m))
    load = float(m.given.load_torque)
    if m.planetary:
        return load * float(max(m.lever("sun"), m.lever("carrier")) / m.lever(m.driven))
    return load * max(0.0 if m.ring else 1.0, abs(float(m.ratio)))


def key_stresses(m: GearTable) -> Sequence[Stress]:
    """Pressure on the hubs and shear of the keys; none without keys."""
    if not m.single:
        return []
    plate = m.given
    if m.planetary:
        thinner = min(plate.thickness, m.dimensions.carrier_thickness)
        plate = plate.model_copy(update={"thickness": thinner})
    return loaded_key(plate, m.opening, _shaft_torque(m), reverses=m.straight)


def _wider(m: GearTable) -> Way:
    return Way("thickness", m.given.thickness)


def _larger(m: GearTable) -> Way:
    given = m.given
    if given.diametral_pitch is not None:
        return Way("diametral_pitch", given.diametral_pitch, up=False)
    return Way("module", module_of(given))


def _less(m: GearTable) -> Way:
    if m.straight:
        return Way("load_force", m.given.load_force, up=False)
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
PIN = StressRule[GearTable](
    "gear.pin",
    pin_stresses,
    lambda m: [Way("pin_diameter", m.dimensions.pin_diameter or 1.0), _less(m)],
    table_of,
)
STRENGTH = all_of(ROOT, FLANK, KEY, PIN)
"""What teeth and keys bear."""
