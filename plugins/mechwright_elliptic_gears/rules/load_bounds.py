"""Bounds of loads, by which most designs of a table certainly bear theirs.

A gear lies within its pitch ellipse grown in proportion to its tips, and the coupler in a rectangle about its
eyes. Loads of pairs are in closed form, those of trains of samples of a turn, where all that goes into a
torque counts as if it acted one way.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from mechwright import Array, material
from mechwright.contracts.design_table import items, plain
from mechwright.mechanics.gearing import TO_NM
from mechwright.mechanics.openings import opening_of
from mechwright.mechanics.strength.allowed import ROOT_SAFETY, allowed
from mechwright.mechanics.strength.fastening import (
    LONGEST_KEY,
    key_pressure,
    key_shear,
    pin_pressure,
    pin_shear,
    ring_force,
)
from mechwright.mechanics.strength.gear_stresses import KEY_STEEL
from mechwright.mechanics.strength.shaft import bending_stress, torsion_stress
from mechwright.mechanics.strength.tooth_bending import FACTOR, STRAIGHT, Rack, form_factors
from mechwright.tolerances import exceeds
from mechwright_elliptic_gears.kinematics.equations import Turning, alpha_peak, coupler, train
from mechwright_elliptic_gears.kinematics.point import place
from mechwright_elliptic_gears.parts.layout import DOWEL_STRENGTH, DOWELS
from mechwright_elliptic_gears.parts.turned import MATERIAL
from mechwright_elliptic_gears.table import GearTable

TURN_SAMPLES, BETWEEN = 361, 1.1
"""Samples of a turn, and how much greater than at them loads may be between."""

SAMPLED_TO = 0.7
"""Eccentricity up to which that is so: peaks of gear 5 are at most 4 % higher than samples a degree apart, at
0.8 by a quarter. Trains beyond it are asked one by one."""

BLOCK = 512
"""Designs that are sampled at once, so that their samples stay in the cache."""

_LOOKS, _SPARE = 9, 1.1
"""Numbers of virtual teeth that are looked at, and by how much form factors between them may be greater."""


class Torques(NamedTuple):
    """What torques do not exceed, N m: on gear 2, on the gear it drives, between gears 3 and 4, on gear 5."""

    driver: Any
    first: Any
    joint: Any
    second: Any


def torques(m: GearTable) -> Torques:
    """The greatest of all that goes into each at once, as columns (n, 1)."""
    samples = _of_pair if m.given.stages == 1 else _of_train
    found = m.once("greatest torques", lambda: m.each(samples, BLOCK))
    return Torques(*(found[:, place : place + 1] for place in range(len(Torques._fields))))


def _inertia(m: GearTable) -> Any:
    """Of a gear about its axis, kg m²."""
    given, a, e = m.given, m.semi_major, np.asarray(m.given.eccentricity)
    b = a * np.sqrt(1 - e * e)
    grown = 1 + given.addendum * m.module / b
    polar = math.pi * a * b * (grown**4 * (a * a + b * b) / 4 + grown**2 * (a * e) ** 2)
    return polar * given.thickness * material(given.material).density * 1e-6 * TO_NM


def _of_pair(m: GearTable) -> Array:
    e = np.asarray(m.given.eccentricity)
    first = _inertia(m) * alpha_peak(e) * m.omega**2 + m.given.load_torque
    return items([first * (1 + e) / (1 - e), first, 0.0, 0.0], m.size)


def _of_train(m: GearTable) -> Array:
    given, layout, a, inertia = m.given, m.layout, m.semi_major, _inertia(m)
    theta = np.linspace(0.0, math.tau, TURN_SAMPLES)
    gears = train(Turning.of(theta, m.omega), given.eccentricity, np.radians(given.phase_degrees))
    (omega4, alpha4), (omega5, alpha5) = ((np.abs(one.omega), np.abs(one.alpha)) for one in gears[1:])
    link, length = coupler(*gears[1:]), 2 * a
    # The coupler's centre is in the hull of its eyes; J and K go round at 2 a e.
    c, around = place(given.point_along, given.point_across, a), layout.eye / length
    shares = np.maximum(1, np.abs(1 - c)) + around, np.maximum(1, np.abs(c)) + around
    reach, width = length + 2 * layout.eye, np.abs(given.point_across) + 2 * layout.eye
    mass = material(given.material).density * 1e-6 * layout.coupler * reach * width * TO_NM
    speed = shares[0] * omega4 + shares[1] * omega5
    change = shares[0] * np.hypot(omega4**2, alpha4) + shares[1] * np.hypot(omega5**2, alpha5)
    power = mass * (2 * a * given.eccentricity) ** 2 * speed * change
    power = power + mass * (reach**2 + width**2) / 12 * np.abs(link.omega * link.alpha)
    power = power + inertia * alpha5 * omega5 + given.load_torque * omega5
    joint = power / omega4 + inertia * alpha4
    first = joint + inertia * alpha4
    found = first * omega4 / m.omega, first, joint, power / omega5
    sure = np.where(np.asarray(given.eccentricity) <= SAMPLED_TO, BETWEEN, np.inf)
    return items([sure * one.max(axis=-1, keepdims=True) for one in found], m.size)


def _tangential(m: GearTable, torque: Any) -> Any:
    """Force along the pitch tangent, N, at the shortest lever; infinite where a flank has none."""
    alpha, e = np.radians(m.given.pressure_angle), np.asarray(m.given.eccentricity)
    reach = np.maximum(np.cos(alpha + np.arcsin(e)), 0.0)
    with np.errstate(divide="ignore"):
        return torque * 1000 * np.cos(alpha) / (m.semi_major * (1 - e) * reach)


def roots_bear(m: GearTable) -> Any:
    """Whether teeth do not break at their roots."""
    given, e, own = m.given, np.asarray(m.given.eccentricity), torques(m)
    force = _tangential(m, np.maximum(own.first, own.second))
    least, most = (2 * size * m.semi_major / m.module for size in (1 - e * e, 1 / np.sqrt(1 - e * e)))
    rack = Rack(np.radians(given.pressure_angle), given.addendum, given.dedendum, given.tip_radius)
    stress = force / (given.thickness * m.module) * _SPARE * _greatest_form(least, most, rack) * FACTOR
    return np.isfinite(stress) & ~np.asarray(exceeds(stress, ROOT_SAFETY * allowed(given.material).root))


def shafts_bear(m: GearTable) -> Any:
    """Whether a train's shafts stay straight."""
    own, layout = torques(m), m.layout
    cosine = np.cos(np.radians(m.given.pressure_angle))
    first, second = (_tangential(m, one) / cosine for one in (own.first, own.second))
    moment = first * (layout.lower + layout.thickness / 2) + second * (layout.upper + layout.thickness / 2)
    bore = np.maximum(layout.bore, 1e-6)
    bent, turned = bending_stress(bore, moment / 1000), torsion_stress(bore, own.driver)
    return ~np.asarray(exceeds(np.hypot(bent, math.sqrt(3) * turned), material(MATERIAL).strength))


def dowels_bear(m: GearTable) -> Any:
    """Whether dowels are not sheared off, and their holes keep their size."""
    if not m.given.dowelled:
        return True
    layout, own = m.layout, material(m.given.material)
    force = ring_force(torques(m).joint, len(DOWELS) - 1, layout.dowel_circle)
    pressure = pin_pressure(force, layout.dowel, m.given.thickness)
    sheared = pin_shear(force, layout.dowel)
    return ~np.asarray(exceeds(sheared, DOWEL_STRENGTH)) & ~np.asarray(exceeds(pressure, own.strength))


def keys_bear(m: GearTable) -> Any:
    """Whether keys are not sheared off, and their hubs keep their size."""
    given, own = m.given, torques(m)
    # Widths and depths of keyways are alike in a table, and bores do not matter to how far a key stands out.
    opening = opening_of(plain(given, 0, m.size))
    if opening is None or not opening.has_keyway:
        return True
    torque = np.maximum(np.maximum(own.driver, own.first), own.joint)
    proud = opening.key_top - opening.bore / 2
    bears: Any = np.minimum(given.thickness, LONGEST_KEY * np.asarray(given.bore))
    pressure = key_pressure(torque, given.bore, proud, bears)
    sheared = key_shear(torque, given.bore, opening.width, bears)
    limits = material(given.material).strength, material(KEY_STEEL).strength / 2
    return ~np.asarray(exceeds(pressure, limits[0])) & ~np.asarray(exceeds(sheared, limits[1]))


def _greatest_form(least: Any, most: Any, rack: Rack) -> Any:
    """What form and stress factors together are at most between two numbers of virtual teeth."""
    if max(map(np.ndim, (rack.angle, rack.addendum, rack.dedendum, rack.tip_radius))) == 0:
        teeth = np.geomspace(np.min(least), STRAIGHT, _LOOKS**2)
        factors = np.maximum.accumulate(_form(teeth, rack)[::-1])[::-1]
        return factors[np.maximum(np.searchsorted(teeth, least) - 1, 0)]
    ratio = np.minimum(most, STRAIGHT) / least
    return np.maximum.reduce([_form(least * ratio**share, rack) for share in np.linspace(0, 1, _LOOKS)])


def _form(teeth: Any, rack: Rack) -> Array:
    one, two = form_factors(teeth, rack)
    return np.where(np.isfinite(one * two), one * two, np.inf)
