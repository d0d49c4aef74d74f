"""What presses follower and cam together, and what turns the cam.

Source: R. L. Norton, Design of Machinery, chapter 15 (force-closed followers), without friction and damping.
Force of a slide, N, and torque of a lever, N·m, at the angle θ of a cam of constant speed ω (of another
motion, s'' ω² is the follower's acceleration):

    F = m ω² s'' + F0 + k s + F_load        T = J ω² ψ'' + T0 + k ψ + T_load
    N = F/cos α                             N = T/(l cos α), l from the lever's axis to the contact
    torque of the camshaft = σ F s'         = σ T ψ'

σ is 1 for a cam that turns counter-clockwise and -1 for one that turns clockwise: torque and speed of the
camshaft are counted about +z, and their product is the power that the shaft is given.

The follower stays on its cam as long as F is above 0. Of a conjugate pair the first cam carries where it is,
and the second where it is below.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright import Array, material
from mechwright.mechanics.laws import Rates
from mechwright.mechanics.strength.hertz import SHARPEST, contact_modulus, line_pressure, relative_radius
from mechwright_cam_follower.kinematics.contact import Contact
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.spring.choice import inertia_at, load_of, mounted_spring

LOCKED = 89.0
"""Degrees of pressure angle beyond which a cam locks and does not push; forces are given as those there."""


def spring_of(m: Mechanism) -> tuple[Any, Any]:
    """Preload and rate of a spring that is not bought: N and N/mm of a slide, N·m and N·m/rad of a lever."""
    names = ("spring_preload", "spring_rate") if m.slides else ("spring_torque", "spring_stiffness")
    preload, rate = (m.value(name) for name in names)
    return preload, rate


def spring_at(m: Mechanism, lift: Array) -> Array:
    """What the spring presses with at lifts (k,), (1, k) or (n, k): N of a slide, N·m of a lever.

    It is 0 where no spring that is sold holds the follower: a finding says so.
    """
    if m.given.spring is None:
        preload, rate = spring_of(m)
        return np.asarray(preload + rate * lift)
    if m.single:
        mounted = mounted_spring(m.given)
        return np.zeros_like(lift) if mounted is None else mounted.press(lift)
    lifts = np.broadcast_to(lift, (m.size, np.shape(lift)[-1]))
    return np.stack([spring_at(m.row(place), one) for place, one in enumerate(lifts)])


def force_at(m: Mechanism, rates: Rates, acceleration: Array | None = None) -> Array:
    """F or T: below 0 a follower with a spring leaves its cam.

    ``acceleration`` of the follower, mm/s² or rad/s². Default: that at the cam's own constant speed.
    """
    if acceleration is None:
        acceleration = rates.a * m.omega**2
    return np.asarray(inertia_at(m, acceleration) + load_of(m) + spring_at(m, rates.s))


@dataclass(frozen=True)
class Loads:
    """At each angle (n,).

    Parameters
    ----------
    force
        Of each contact, N; 0 where it does not carry.
    pressure
        Hertz pressure of each, MPa.
    torque
        That the camshaft has to be given, N·m about +z, as its angle is counted.
    """

    force: tuple[Array, ...]
    pressure: tuple[Array, ...]
    torque: Array


def loads_at(
    m: Mechanism, rates: Rates, contacts: tuple[Contact, ...], acceleration: Array | None = None
) -> Loads:
    """Loads of one contact, or of both of a conjugate pair; ``acceleration`` as of :func:`force_at`."""
    whole = force_at(m, rates, acceleration)
    scale, least = 1.0 if m.slides else 1000.0, math.cos(math.radians(LOCKED))
    forces = tuple(
        np.maximum(sign * whole, 0.0) * scale / np.maximum(contact.share, least * contact.lever)
        for sign, contact in zip((1.0, -1.0), contacts, strict=False)
    )
    if len(contacts) == 1:
        whole = np.maximum(whole, 0.0)
    torque = m.sense * whole * rates.v / (1000.0 if m.slides else 1.0) + 0.0  # never -0
    pressures = tuple(map(lambda one, force: _pressure(m, one, force), contacts, forces))
    return Loads(forces, pressures, torque)


def _pressure(m: Mechanism, contact: Contact, force: Array) -> Array:
    cam = material(m.given.material)
    if not m.flat:
        with np.errstate(divide="ignore"):
            radius = relative_radius(m.roller, contact.radius)
        mate = material(m.given.roller_material)
    else:
        radius, mate = contact.radius, cam
    return line_pressure(force, m.given.thickness, np.maximum(radius, SHARPEST), contact_modulus(cam, mate))


def preload_needed(m: Mechanism, rates: Rates) -> Array:
    """Preload at which the force is just 0 here, with the rate as it is."""
    preload, _ = spring_of(m)
    return np.asarray(preload - force_at(m, rates))


def rate_needed(m: Mechanism, rates: Rates) -> Array:
    """Rate of the spring at which the force is just 0 here, with the preload as it is; nan at no lift."""
    _, rate = spring_of(m)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(rates.s > 0, rate - force_at(m, rates) / rates.s, np.nan)
