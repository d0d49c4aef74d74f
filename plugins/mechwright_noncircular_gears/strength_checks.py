"""Strength of teeth and keys under inertia and load, at the worst angle of the driver.

At constant speed of the driver the torque on the driven gear is J2 α2 and the load; teeth touch at the pitch
point, where one pair carries all.
"""

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from mechwright import Array, Finding, kept, material
from mechwright.mechanics.gearing import Rolling, body, driven_torque, turned_back
from mechwright.mechanics.openings import opening_of
from mechwright.mechanics.strength.allowed import (
    PIN_SHEAR,
    REVERSING_KEY,
    REVERSING_ROOT,
    ROOT_SAFETY,
    allowed,
)
from mechwright.mechanics.strength.fastening import LONGEST_KEY, key_pressure, key_shear
from mechwright.mechanics.strength.hertz import contact_modulus, flank_radius, line_pressure, relative_radius
from mechwright.mechanics.strength.judging import Stress, Way, judged
from mechwright.mechanics.strength.tooth_bending import Rack, root_stress, tangential_force, virtual_teeth
from mechwright_noncircular_gears.gear import outlines_of, pair_of, rack_of
from mechwright_noncircular_gears.law import GRID, law_of
from mechwright_noncircular_gears.laws.sector import swung
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.profile import profile_of

KEY_STEEL = "steel"
"""Of keys."""


def strength_findings(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    """Teeth, their flanks, then the keys; values that help only to ``advise``."""
    told = partial(judged, advise=advise)
    wider = Way("thickness", params.thickness)
    size = "module" if params.module is not None else "centre_distance"
    larger = Way(size, params.module or params.centre_distance or 0.0)
    less = [Way("load_torque", params.load_torque, up=False), Way("speed", params.speed, up=False)]
    yield from told("gear.root", params, root_stresses, [wider, larger, *less])
    yield from told("gear.flank", params, flank_pressures, [wider, larger, *less])
    yield from told("gear.key", params, key_stresses, [wider, Way("bore", params.bore), *less])


@kept
def loads(params: NoncircularParams) -> tuple[Array, Array, Array, Array]:
    """Torque on the driven gear, N m, force along the pitch tangent, N, both radii of curvature, mm: (n,)."""
    law, a = law_of(params), pair_of(params).distance
    phi = law.grid(GRID)
    first = law.rates(phi)[1]
    _, inertia = body(outlines_of(params)[1], params.thickness, params.material)
    angular = first if params.sector is None else swung(law, phi, math.radians(params.sector))[1]
    torque = driven_torque(inertia, angular * params.omega**2, params.load_torque)
    now = Rolling.of(law, phi, params.side)
    alpha = math.radians(params.pressure_angle)
    force = tangential_force(np.abs(torque), a * now.r2, now.tilt, alpha)
    with np.errstate(divide="ignore"):
        return torque, force, a / now.curvature1, a / now.curvature2


@kept
def root_stresses(params: NoncircularParams) -> tuple[Stress, ...]:
    """Bending at the roots of both gears; none where the model has no figure.

    The tooth of a circular gear of the pitch curve's curvature, loaded at its tip, carries alone.
    """
    cutter = profile_of(params)
    own = Rack(math.radians(cutter.pressure_angle), cutter.addendum, cutter.dedendum, cutter.tip_radius)
    module, bears = rack_of(params).module, allowed(params.material).root
    torque, force, *radii = loads(params)
    limit = bears * (REVERSING_ROOT if turned_back(torque) else 1.0)
    found = []
    for number, radius in enumerate(radii, start=1):
        with np.errstate(all="ignore"):  # a rack far from the usual one has no section of 30 degrees
            teeth = virtual_teeth(radius, module)
            value = float(root_stress(force, params.thickness, module, teeth, rack=own).max())
        if math.isfinite(value):
            what = f"teeth of gear {number} are bent at their roots with"
            found.append(Stress(what, value, limit, ROOT_SAFETY * bears))
    return tuple(found)


@kept
def flank_pressures(params: NoncircularParams) -> tuple[Stress, ...]:
    """Hertz pressure of the flanks at the pitch point; more than is allowed wears them."""
    alpha, own = math.radians(params.pressure_angle), material(params.material)
    modulus = contact_modulus(own, own)
    _, force, one, two = loads(params)
    radius = relative_radius(flank_radius(one, alpha), flank_radius(two, alpha))
    pressure = line_pressure(force / math.cos(alpha), params.thickness, radius, modulus)
    return (
        Stress("flanks press on each other with", float(pressure.max()), allowed(params.material).contact),
    )


@kept
def key_stresses(params: NoncircularParams) -> tuple[Stress, ...]:
    """Pressure on the hubs and shear of the keys; none without keys."""
    opening = opening_of(params)
    if opening is None or not opening.has_keyway:
        return ()
    torque = loads(params)[0]
    law = law_of(params)
    ratio = law.rates(law.grid(GRID))[0]
    most = max(float(np.abs(torque).max()), float(np.abs(torque * ratio).max()))
    bore, bears = opening.bore, min(params.thickness, LONGEST_KEY * opening.bore)
    reverses = turned_back(torque)
    limit = (REVERSING_KEY if reverses else 1.0) * allowed(params.material).key
    pressure = key_pressure(most, bore, opening.key_top - bore / 2, bears)
    sheared = key_shear(most, bore, opening.width, bears)
    own = material(params.material)
    return (
        Stress("the key presses on its hub with", pressure, limit, own.strength),
        Stress(
            "the key is sheared with",
            sheared,
            PIN_SHEAR["alternating" if reverses else "swelling"],
            material(KEY_STEEL).strength / 2,
        ),
    )
