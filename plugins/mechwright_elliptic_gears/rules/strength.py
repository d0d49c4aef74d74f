"""Strength of teeth, shafts, keys and dowels under inertia and load, at the worst angle of a turn."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mechwright import Array, kept, material
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.openings import opening_of
from mechwright.mechanics.strength.allowed import (
    PIN_SHEAR,
    REVERSING_KEY,
    REVERSING_ROOT,
    ROOT_SAFETY,
    allowed,
)
from mechwright.mechanics.strength.fastening import pin_pressure, pin_shear, ring_force
from mechwright.mechanics.strength.gear_stresses import loaded_key
from mechwright.mechanics.strength.hertz import contact_modulus, flank_radius, line_pressure, relative_radius
from mechwright.mechanics.strength.judging import STUD_SHARE, RowStressRule, Stress, Way
from mechwright.mechanics.strength.shaft import von_mises
from mechwright.mechanics.strength.tooth_bending import (
    EllipticMesh,
    Rack,
    root_stress,
    virtual_teeth,
)
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.kinematics.mesh_load import meshes_of
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import rack_of
from mechwright_elliptic_gears.parts.layout import DOWEL_STRENGTH, DOWELS, layout_of
from mechwright_elliptic_gears.parts.turned import MATERIAL
from mechwright_elliptic_gears.rules.load_bounds import dowels_bear, keys_bear, roots_bear, shafts_bear
from mechwright_elliptic_gears.table import GearTable, table_of

Stresses = Callable[[EllipticGearParams], Sequence[Stress]]


@kept
def root_stresses(params: EllipticGearParams) -> tuple[Stress, ...]:
    """Bending at the roots of each pair, over a whole turn; none where the model has no figure.

    The tooth of a circular gear of the pitch curve's curvature, loaded at its tip, carries alone.
    """
    own = Rack(math.radians(params.pressure_angle), params.addendum, params.dedendum, params.tip_radius)
    module, bears = rack_of(params).module, allowed(params.material).root
    found = []
    for mesh in meshes_of(params):

        def stress(point: EllipticMesh, force: Array) -> Array:
            teeth = virtual_teeth(point.curvature, module)
            return root_stress(force, params.thickness, module, teeth, rack=own)

        with np.errstate(all="ignore"):  # a rack far from the usual one has no section of 30 degrees
            value = mesh.greatest(stress).value
        if math.isfinite(value):
            limit = bears * (REVERSING_ROOT if mesh.reverses else 1.0)
            what = f"teeth of gears {mesh.names[0]} and {mesh.names[1]} are bent at their roots with"
            found.append(Stress(what, value, limit, ROOT_SAFETY * bears))
    return tuple(found)


@kept
def flank_pressures(params: EllipticGearParams) -> tuple[Stress, ...]:
    """Hertz pressure of the flanks at the pitch point of each pair; more than is allowed wears them."""
    alpha, own = math.radians(params.pressure_angle), material(params.material)
    modulus = contact_modulus(own, own)
    found = []
    for mesh in meshes_of(params):

        def pressure(point: EllipticMesh, force: Array) -> Array:
            flank = flank_radius(point.curvature, alpha)
            # Both flanks are alike at the pitch point.
            radius = flank * relative_radius(1.0, 1.0)
            return line_pressure(force / math.cos(alpha), params.thickness, radius, modulus)

        what = f"flanks of gears {mesh.names[0]} and {mesh.names[1]} press on each other with"
        found.append(Stress(what, mesh.greatest(pressure).value, allowed(params.material).contact))
    return tuple(found)


@kept
def key_stresses(params: EllipticGearParams) -> tuple[Stress, ...]:
    """Pressure on the hubs and shear of the keys; none without keys."""
    opening = opening_of(params)
    if opening is None or not opening.has_keyway:
        return ()
    first, *_ = meshes_of(params)
    torques = {"2": first.input_torque}
    if params.stages == 1:
        torques["4"] = first.greatest_torque
    elif params.keyed_phase:
        torques["3"] = torques["4"] = greatest_torque(params, params.phase_degrees).value
    gear, torque = max(torques.items(), key=lambda item: item[1])
    return loaded_key(params, opening, torque, reverses=first.reverses, gear=gear)


@kept
def shaft_stresses(params: EllipticGearParams) -> tuple[Stress, ...]:
    """Of the train's shafts where they come out of the base plate, over which their gears stand free.

    The greatest forces of both pairs are taken to act at once and in one direction.
    """
    layout = layout_of(params)
    first, second = (mesh.greatest_force.value for mesh in meshes_of(params))
    low, high = layout.lower + layout.thickness / 2, layout.upper + layout.thickness / 2
    moments = {"2": first * low, "4": first * low + second * high, "5": second * high}  # N mm
    torques = {"2": meshes_of(params)[0].input_torque}
    steel = material(MATERIAL)
    return tuple(
        Stress(
            f"the shaft of gear {name} is stressed over the base plate with",
            von_mises(params.bore, moment / 1000, torques.get(name, 0.0)),
            STUD_SHARE * allowed(steel.name).endurance,
            steel.strength,
        )
        for name, moment in moments.items()
    )


@kept
def dowel_stresses(params: EllipticGearParams) -> tuple[Stress, ...]:
    """Shear of the dowels that join gears 3 and 4, and pressure on their holes; none where others do."""
    if not params.dowelled:
        return ()
    layout, d = layout_of(params), layout_of(params).dowel
    torque = greatest_torque(params, params.phase_degrees).value
    # Of milled holes all but one carry.
    force = ring_force(torque, len(DOWELS) - 1, layout.dowel_circle)
    turned = REVERSING_KEY if meshes_of(params)[0].reverses else 1.0
    own = material(params.material)
    return (
        Stress(
            "the dowels are sheared with",
            pin_shear(force, d),
            PIN_SHEAR["hardened, alternating"],
            DOWEL_STRENGTH,
        ),
        Stress(
            "the dowels press on their holes with",
            pin_pressure(force, d, params.thickness),
            turned * allowed(own.name).key,
            own.strength,
        ),
    )


def _load(m: GearTable) -> str:
    most = max(meshes_of(m.given), key=lambda mesh: mesh.greatest_force.value).greatest_force
    return f"{most.value:.4g} N on a tooth at {math.degrees(most.angle):.1f} degrees of gear 2"


def _ways(m: GearTable, *keys: str) -> list[Way]:
    """What helps: larger parts, then less load."""
    given = m.given
    now = {key: getattr(given, key, None) for key in keys}
    if "size" in now:
        now["semi_major" if given.module is None else "module"] = given.module or given.semi_major
    if "dowel_diameter" in now:
        now["dowel_diameter"] = m.layout.dowel
    larger = [Way(key, value) for key, value in now.items() if value is not None]
    return [*larger, *(Way(key, getattr(given, key), up=False) for key in ("load_torque", "speed"))]


def _rule(
    code: str,
    stresses: Stresses,
    bears: Callable[[GearTable], Any] | None,
    *ways: str,
    load: bool = False,
) -> RowStressRule[GearTable]:
    """A rule of a group of stresses; without ``bears`` more than allowed only wears."""
    return RowStressRule[GearTable](
        code,
        lambda m: stresses(m.given),
        lambda m: _ways(m, *ways),
        table_of,
        _load if load else None,
        bears=bears,
        breaks=bears is not None,
    )


ROOT = _rule("gear.root", root_stresses, roots_bear, "thickness", "size", load=True)
FLANK = _rule("gear.flank", flank_pressures, None, "thickness", "size", load=True)
KEY = _rule("gear.key", key_stresses, keys_bear, "thickness", "bore")
SHAFT = _rule("train.shaft", shaft_stresses, shafts_bear, "bore", load=True)
DOWEL = _rule("train.dowel-load", dowel_stresses, dowels_bear, "dowel_diameter", "thickness")

STRENGTH = all_of(ROOT, FLANK, KEY, all_of(SHAFT, DOWEL, when=lambda m: m.given.stages == 2))
"""What teeth and keys bear, and the shafts and dowels of trains."""
