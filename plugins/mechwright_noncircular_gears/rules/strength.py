"""Strength of teeth and keys under inertia and load, at the worst angle of the driver.

At constant speed of the driver the torque on the driven gear is J2 α2 and the load; teeth touch at the pitch
point, where one pair carries all.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright import Array, Severity, kept, material
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.gearing import Rolling, driven_torque, turned_back
from mechwright.mechanics.gearing.inertia import UNSURE, near_moment
from mechwright.mechanics.strength.gear_stresses import bent_root, loaded_key, pressed_flanks
from mechwright.mechanics.strength.judging import Stress, StressRule, Way
from mechwright.mechanics.strength.tooth_bending import Rack, tangential_force
from mechwright_noncircular_gears.kinematics.law import GRID
from mechwright_noncircular_gears.kinematics.laws.sector import swung
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.table import GearTable, table_of


@dataclass(frozen=True)
class Loads:
    """What the mesh bears over a lobe (n,).

    Parameters
    ----------
    torque
        On the driven gear, N m.
    ratio
        Output speed over input speed.
    force
        Along the pitch tangent, N.
    radii
        Radii of curvature of both pitch curves, mm.
    """

    torque: Array
    ratio: Array
    force: Array
    radii: tuple[Array, Array]

    @property
    def reverses(self) -> bool:
        """Whether both flanks are loaded."""
        return turned_back(self.torque)


@kept
def loads(params: NoncircularParams) -> Loads:
    """Under inertia and load."""
    m = table_of(params)
    return _loads(m, m.outlines[1].polar_moment)


def _loads(m: GearTable, moment: float) -> Loads:
    """The same with a polar moment of the driven gear, mm⁴."""
    law, a, params = m.law, m.pair.distance, m.given
    phi = law.grid(GRID)
    ratio, first, _ = law.rates(phi)
    density = material(params.material).density * 1e-6  # g/cm³ to kg/mm³
    inertia = moment * params.thickness * density
    angular = first if params.sector is None else swung(law, phi, math.radians(params.sector))[1]
    torque = driven_torque(inertia, angular * m.omega**2, params.load_torque)
    now = Rolling.of(law, phi, params.side)
    force = tangential_force(np.abs(torque), a * now.r2, now.tilt, math.radians(params.pressure_angle))
    with np.errstate(divide="ignore"):
        return Loads(torque, ratio, force, (a / now.curvature1, a / now.curvature2))


def _roots(m: GearTable, under: Loads) -> list[Stress]:
    cutter, module = m.profile, m.rack.module
    own = Rack(math.radians(cutter.pressure_angle), cutter.addendum, cutter.dedendum, cutter.tip_radius)
    found = (
        bent_root(
            f"teeth of gear {number} are bent at their roots with",
            *(m.given, under.force, radius, own, module),
            reverses=under.reverses,
        )
        for number, radius in enumerate(under.radii, start=1)
    )
    return [one for one in found if one is not None]


def _flanks(m: GearTable, under: Loads) -> list[Stress]:
    angle = math.radians(m.given.pressure_angle)
    return [pressed_flanks("flanks press on each other with", m.given, under.force, *under.radii, angle)]


def _keys(m: GearTable, under: Loads) -> list[Stress]:
    most = max(float(np.abs(under.torque).max()), float(np.abs(under.torque * under.ratio).max()))
    return [*loaded_key(m.given, m.opening, most, reverses=under.reverses)]


def _either(m: GearTable) -> list[Loads]:
    """The least and the greatest loads, by the polar moment of the driven gear without drawing its teeth."""
    teeth = m.teeth[1]
    if m.given.internal:
        rest = float(m.ring_plate.moment)
    else:
        rest = 0.0 if m.opening is None else float(m.opening.loop().moments[3:5].sum())
    moment = near_moment(teeth.curve, teeth.rack)
    return [_loads(m, rest + share * moment) for share in UNSURE]


def _wider(m: GearTable) -> Way:
    return Way("thickness", m.given.thickness)


def _larger(m: GearTable) -> Way:
    size = "module" if m.given.module is not None else "centre_distance"
    return Way(size, m.given.module or m.given.centre_distance or 0.0)


def _bore(m: GearTable) -> Way:
    return Way("bore", m.given.bore)


def _rule(
    code: str, stresses: Callable[[GearTable, Loads], list[Stress]], larger: Callable[[GearTable], Way]
) -> StressRule[GearTable]:
    def ways(m: Any) -> list[Way]:
        less = [Way("load_torque", m.given.load_torque, up=False), Way("speed", m.given.speed, up=False)]
        return [_wider(m), larger(m), *less]

    def bears(m: GearTable) -> bool:
        if m.given.sector is not None:
            return False
        some = [one for under in _either(m) for one in stresses(m, under)]
        return all(one.severity is Severity.NOTE for one in some)

    return StressRule[GearTable](code, lambda m: stresses(m, loads(m.given)), ways, table_of, bears=bears)


STRENGTH = all_of(
    _rule("gear.root", _roots, _larger),
    _rule("gear.flank", _flanks, _larger),
    _rule("gear.key", _keys, _bore),
)
"""Teeth, their flanks, then the keys."""
