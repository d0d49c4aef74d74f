"""Strength of teeth and keys under inertia and load, at the worst angle of the driver.

At constant speed of the driver the torque on the driven gear is J2 α2 and the load; teeth touch at the pitch
point, where one pair carries all.
"""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Array, Finding, kept, material
from mechwright.mechanics.gearing import Rolling, driven_torque, turned_back
from mechwright.mechanics.gearing.inertia import UNSURE, near_moment
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
from mechwright.mechanics.strength.judging import Stress, Way, judged, judged_between
from mechwright.mechanics.strength.tooth_bending import Rack, root_stress, tangential_force, virtual_teeth
from mechwright_noncircular_gears.gear import outlines_of, pair_of, rack_of, rim_of, teeth_of
from mechwright_noncircular_gears.law import GRID, law_of
from mechwright_noncircular_gears.laws.sector import swung
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.profile import profile_of

KEY_STEEL = "steel"
"""Of keys."""


Loads = tuple[Array, Array, Array, Array]
"""Torque on the driven gear, N m, force along the pitch tangent, N, both radii of curvature, mm: (n,)."""


def strength_findings(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    """Teeth, their flanks, then the keys; values that help only to ``advise``."""
    stresses = root_stresses, flank_pressures, key_stresses
    for (code, ways), of in zip(_ways(params).items(), stresses, strict=True):
        yield from judged(code, params, of, ways, advise=advise)


def strength_judged(params: NoncircularParams) -> Iterator[Finding]:
    """The same without advice and notes: teeth are drawn only where their inertia is near what matters."""
    if params.sector is not None:
        yield from strength_findings(params, advise=False)
        return
    teeth, opening = teeth_of(params)[1], opening_of(params)
    moment = near_moment(teeth.curve, teeth.rack)
    if params.internal:
        rest = rim_of(params).moment
    else:
        rest = 0.0 if opening is None else float(opening.loop().moments[3:5].sum())
    either = [_loads(params, rest + share * moment) for share in UNSURE]
    stresses = (_roots, root_stresses), (_flanks, flank_pressures), (_keys, key_stresses)
    for (code, ways), (under, exact) in zip(_ways(params).items(), stresses, strict=True):
        yield from judged_between(code, params, [under(params, one) for one in either], exact, ways)


def _ways(params: NoncircularParams) -> dict[str, list[Way]]:
    """What helps against each finding."""
    wider = Way("thickness", params.thickness)
    size = "module" if params.module is not None else "centre_distance"
    larger = Way(size, params.module or params.centre_distance or 0.0)
    less = [Way("load_torque", params.load_torque, up=False), Way("speed", params.speed, up=False)]
    teeth = [wider, larger, *less]
    return {"gear.root": teeth, "gear.flank": teeth, "gear.key": [wider, Way("bore", params.bore), *less]}


@kept
def loads(params: NoncircularParams) -> Loads:
    """Under inertia and load."""
    return _loads(params, outlines_of(params)[1].polar_moment)


def _loads(params: NoncircularParams, moment: float) -> Loads:
    """The same with a polar moment of the driven gear, mm⁴."""
    law, a = law_of(params), pair_of(params).distance
    phi = law.grid(GRID)
    first = law.rates(phi)[1]
    density = material(params.material).density * 1e-6  # g/cm³ to kg/mm³
    inertia = moment * params.thickness * density
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
    return _roots(params, loads(params))


def _roots(params: NoncircularParams, loaded: Loads) -> tuple[Stress, ...]:
    cutter = profile_of(params)
    own = Rack(math.radians(cutter.pressure_angle), cutter.addendum, cutter.dedendum, cutter.tip_radius)
    module, bears = rack_of(params).module, allowed(params.material).root
    torque, force, *radii = loaded
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
    return _flanks(params, loads(params))


def _flanks(params: NoncircularParams, loaded: Loads) -> tuple[Stress, ...]:
    alpha, own = math.radians(params.pressure_angle), material(params.material)
    modulus = contact_modulus(own, own)
    _, force, one, two = loaded
    radius = relative_radius(flank_radius(one, alpha), flank_radius(two, alpha))
    pressure = line_pressure(force / math.cos(alpha), params.thickness, radius, modulus)
    return (
        Stress("flanks press on each other with", float(pressure.max()), allowed(params.material).contact),
    )


@kept
def key_stresses(params: NoncircularParams) -> tuple[Stress, ...]:
    """Pressure on the hubs and shear of the keys; none without keys."""
    opening = opening_of(params)
    return () if opening is None or not opening.has_keyway else _keys(params, loads(params))


def _keys(params: NoncircularParams, loaded: Loads) -> tuple[Stress, ...]:
    opening, torque = opening_of(params), loaded[0]
    if opening is None or not opening.has_keyway:
        return ()
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
