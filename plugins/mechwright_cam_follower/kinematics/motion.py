"""The motion: one turn of the cam at constant speed, or what another motion of the cam makes of it."""

import math

import numpy as np

from mechwright import (
    GROUND,
    Array,
    Channel,
    Curve,
    Joint,
    Load,
    Motion,
    Poses,
)
from mechwright.contracts.figure import scalars
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.envelope import Points
from mechwright.mechanics.laws import Rates
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import turning_channels
from mechwright_cam_follower.kinematics.contact import Contact, contact_of
from mechwright_cam_follower.kinematics.figures import figures_of
from mechwright_cam_follower.kinematics.forces import loads_at, spring_at
from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.follower_dimensions import rails_of, studs_of
from mechwright_cam_follower.parts.spring_parts import SPRING, SPRING_PIN, spring_place
from mechwright_cam_follower.rules.closure import refuse_unclosed
from mechwright_cam_follower.spring.choice import load_of

CAM, FOLLOWER = "cam", "follower"
"""Bodies: what turns, and what follows."""

ROLLERS, RAILS = ("roller", "roller-2"), ("rail", "rail-2")
"""Bodies of the rollers, and of the rails that guide a slide."""

_DRAWN = 721
"""Points of a pitch curve that is drawn: each half degree."""


def motion_of(params: CamParams, samples: Samples) -> Motion:
    """Sample a turn, both ends included.

    Raises
    ------
    KinematicsError
        The follower does not reach its cam, or the law is none.
    """
    m = mechanism_of(params)
    refuse_unclosed(m)
    theta = travelled(math.tau, samples)
    return driven_by(m, *_steady(m, theta))


def _steady(m: Mechanism, theta: Array) -> tuple[Turning, Array]:
    """Give the turning of the camshaft at constant speed, and its times, s."""
    return Turning.of(m.sense * theta + 0.0, m.sense * m.omega), theta / m.omega  # never -0


def channels_of_turn(m: Mechanism, samples: int) -> dict[str, Channel]:
    """Give the channels (n, samples) of a turn."""
    cam, time = _steady(m, travelled(math.tau, samples))
    rates = m.cycle.at(travelled(math.tau, samples))
    return _channels(m, cam, time, rates, contacts_at(m, rates))


def turned_by(m: Mechanism, cam: Turning) -> Array:
    """Angles (n,), rad, within a turn of the cam: how far it has come by a motion of its shaft."""
    way = m.sense * cam.theta
    within: Array = np.where((way < 0) | (way > math.tau), np.mod(way, math.tau), way)
    return within


def driven_by(m: Mechanism, cam: Turning, time: Array) -> Motion:
    """All that moves for any motion of the camshaft, counted about +z, and its times (n,), s."""
    rates = m.cycle.at(turned_by(m, cam))
    contacts = contacts_at(m, rates)
    return Motion(
        "theta",
        _channels(m, cam, time, rates, contacts),
        {CAM: Poses.planar(0.0, 0.0, cam.theta), **_poses(m, contacts, rates)},
        m.once("figures", lambda: scalars(figures_of(m))),
        {},
        _joints(m),
        _curves(m),
        _loads(m, rates),
    )


def _channels(
    m: Mechanism, cam: Turning, time: Array, rates: Rates, contacts: tuple[Contact, ...]
) -> dict[str, Channel]:
    sense = m.sense
    over_time = cam.carried(sense * rates.v, rates.a, sense * rates.j)
    return {
        "time": Channel(time, "s", "time"),
        **turning_channels(cam, "theta", "1", "the cam"),
        **_follower(m, rates.s, over_time),
        **_contact(m, contacts, rates, over_time[1]),
    }


def contacts_at(m: Mechanism, rates: Rates) -> tuple[Contact, ...]:
    """Give the contact of each cam."""
    return tuple(contact_of(m, rates, cam) for cam in m.cams)


def place_of(m: Mechanism, rates: Rates) -> tuple[Points, Array]:
    """Origin of the follower, mm, and its angle, rad, (n,).

    The origin of a slide is its roller or the middle of its face, that of a lever its axis; a lever's +x goes
    along its arm, or along its face.
    """
    zero = np.zeros_like(rates.s)
    if m.slides:
        return np.asarray(m.offset + 1j * (m.start + rates.s), dtype=np.complex128), zero
    towards = math.pi / 2 + m.start if m.flat else math.pi - m.start
    return np.full(zero.shape, complex(m.axis)), towards - rates.s


def _poses(m: Mechanism, contacts: tuple[Contact, ...], rates: Rates) -> dict[str, Poses]:
    origin, angle = place_of(m, rates)
    poses = {FOLLOWER: Poses.planar(origin.real, origin.imag, angle)}
    if not m.flat:
        for body, contact in zip(ROLLERS, contacts, strict=False):
            poses[body] = Poses.planar(contact.centre.real, contact.centre.imag, angle)
    spring = spring_place(m)
    if spring is not None:
        pin = origin + spring.on_follower * np.exp(1j * angle)
        poses[SPRING_PIN] = Poses.planar(pin.real, pin.imag, angle)
        stands = spring.stands + (pin - spring.moves if m.slides else 0j * pin)
        poses[SPRING] = Poses.planar(stands.real, stands.imag, np.full(pin.shape, spring.direction))
    if m.railed:
        for body, place in zip(RAILS, rails_of(m).places, strict=True):
            poses[body] = Poses.planar(place.real, place.imag, np.zeros_like(angle))
    return poses


def _joints(m: Mechanism) -> dict[str, Joint]:
    found = {"camshaft": Joint("revolute", GROUND, CAM, drives=True), "guide": _guide(m)}
    if m.flat:
        found["face-on-cam"] = Joint("contact", CAM, FOLLOWER)
    else:
        for body, place in zip(ROLLERS, studs_of(m), strict=False):
            found[body] = Joint("fixed", FOLLOWER, body, (place.real, place.imag, 0.0))
            found[f"{body}-on-cam"] = Joint("contact", body, CAM, radius=m.roller)
    if m.railed:
        found |= {body: Joint("fixed", GROUND, body) for body in RAILS}
    spring = spring_place(m)
    if spring is not None:
        at = spring.on_follower
        found[SPRING_PIN] = Joint("fixed", FOLLOWER, SPRING_PIN, (at.real, at.imag, 0.0))
        # It is drawn on the pin that is there first: the standing one of a lever, that of a slide itself.
        on, other = (FOLLOWER, at + spring.stands - spring.moves) if m.slides else (GROUND, spring.stands)
        found[SPRING] = Joint("fixed", on, SPRING, (other.real, other.imag, 0.0))
    return found


def _loads(m: Mechanism, rates: Rates) -> dict[str, Load]:
    """Spring and load on the follower, which press it to the cam, and what moves with it."""
    pressed = spring_at(m, rates.s) + load_of(m)
    if m.slides:
        return {"pressed": Load(FOLLOWER, force=(0.0, -1.0, 0.0), mass=m.value("mass"), share=pressed)}
    # A lever rises clockwise.
    return {"pressed": Load(FOLLOWER, torque=(0.0, 0.0, 1.0), inertia=m.value("inertia"), share=pressed)}


def _guide(m: Mechanism) -> Joint:
    if m.slides:
        return Joint("prismatic", GROUND, FOLLOWER, axis=(0.0, 1.0, 0.0))
    return Joint("revolute", GROUND, FOLLOWER, (m.axis, 0.0, 0.0))


def _follower(m: Mechanism, lift: Array, over_time: tuple[Array, Array, Array]) -> dict[str, Channel]:
    unit = "mm" if m.slides else "rad"
    names = ("lift", "velocity", "acceleration", "jerk")
    values = (lift, *over_time)
    units = (unit, f"{unit}/s", f"{unit}/s^2", f"{unit}/s^3")
    return {
        name: Channel(value, one, f"{name} of the follower")
        for name, value, one in zip(names, values, units, strict=True)
    }


def _contact(
    m: Mechanism, contacts: tuple[Contact, ...], rates: Rates, acceleration: Array
) -> dict[str, Channel]:
    loads, found = loads_at(m, rates, contacts, acceleration), {}
    for number, contact in enumerate(contacts):
        end, of = ("", "") if number == 0 else ("2", " of the second cam")
        angle = contact.pressure_angle + np.zeros_like(rates.s)  # that of a flat slide is one number
        found[f"pressure_angle{end}"] = Channel(angle, "rad", f"pressure angle{of}")
        found[f"curvature{end}"] = Channel(inverse(contact.radius), "1/mm", f"curvature{of or ' of the cam'}")
        if not m.flat:
            found[f"pitch_curvature{end}"] = Channel(
                inverse(contact.pitch_radius), "1/mm", f"curvature of the pitch curve{of}"
            )
        found[f"contact_force{end}"] = Channel(loads.force[number], "N", f"contact force{of}")
        found[f"contact_pressure{end}"] = Channel(loads.pressure[number], "MPa", f"contact pressure{of}")
    found["torque"] = Channel(loads.torque, "N*m", "torque of the camshaft")
    return found


def inverse(radius: Array) -> Array:
    """Curvature, 1/mm; where the cam has an edge the greatest that is no fault of rounding."""
    safe = np.where(np.abs(radius) < _EDGE, _EDGE, radius)
    return 1 / safe


_EDGE = 1e-6
"""Radius, mm, below which a curve has an edge."""


def _curves(m: Mechanism) -> dict[str, Curve]:
    theta = np.linspace(0.0, math.tau, _DRAWN)
    contacts = contacts_at(m, m.cycle.at(theta))
    turned = np.exp(-1j * m.sense * theta)
    found = {}
    for number, contact in enumerate(contacts):
        end = "" if number == 0 else "-2"
        found[f"profile{end}"] = Curve.planar(CAM, contact.point * turned)
        if not m.flat:
            found[f"pitch-curve{end}"] = Curve.planar(CAM, contact.centre * turned)
    return found
