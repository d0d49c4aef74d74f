"""The motion: one turn of the cam at constant speed, or what another motion of the cam makes of it."""

import math

import numpy as np

from mechwright import (
    GROUND,
    Array,
    Channel,
    Curve,
    Joint,
    KinematicsError,
    Load,
    Motion,
    Poses,
    Scalar,
    Stage,
    kept,
)
from mechwright.contracts.finding import errors
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.envelope import Points
from mechwright.mechanics.laws import Rates
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import turning_channels
from mechwright_cam_follower.closure import closure_findings
from mechwright_cam_follower.cycle import cycle_of
from mechwright_cam_follower.extremes import Extreme, cams_of, extremes_of, greatest, weakest_of
from mechwright_cam_follower.geometry import Contact, geometry_of
from mechwright_cam_follower.loads import loads_at, spring_of
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.sizes import rails_of, studs_of

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
    refuse_unclosed(params)
    theta = travelled(math.tau, samples)
    cam = Turning.of(params.sense * theta + 0.0, params.sense * params.omega)  # never -0
    return driven_by(params, cam, theta / params.omega)


def refuse_unclosed(params: CamParams) -> None:
    """KinematicsError where the follower does not reach its cam, or the law is none."""
    for finding in errors(closure_findings(params), Stage.MOTION):
        raise KinematicsError(f"{finding.parameter}: {finding.message}; {finding.remedy}")


def turned_by(params: CamParams, cam: Turning) -> Array:
    """Angles (n,), rad, within a turn of the cam: how far it has come by a motion of its shaft."""
    way = params.sense * cam.theta
    within: Array = np.where((way < 0) | (way > math.tau), np.mod(way, math.tau), way)
    return within


def driven_by(params: CamParams, cam: Turning, time: Array) -> Motion:
    """All that moves for any motion of the camshaft, counted about +z, and its times (n,), s."""
    rates = cycle_of(params).at(turned_by(params, cam))
    contacts = contacts_at(params, rates)
    sense = params.sense
    over_time = cam.carried(sense * rates.v, rates.a, sense * rates.j)
    channels = {"time": Channel(time, "s", "time"), **turning_channels(cam, "theta", "1", "the cam")}
    channels |= _follower(params, rates.s, over_time)
    channels |= _contact(params, contacts, rates, over_time[1])
    return Motion(
        "theta",
        channels,
        {CAM: Poses.planar(0.0, 0.0, cam.theta), **_poses(params, contacts, rates)},
        figures(params),
        {},
        _joints(params),
        _curves(params),
        _loads(params, rates),
    )


def contacts_at(params: CamParams, rates: Rates) -> tuple[Contact, ...]:
    """The contact of each cam."""
    geometry = geometry_of(params)
    return tuple(geometry.contact(rates, second) for second in cams_of(params))


def place_of(params: CamParams, rates: Rates) -> tuple[Points, Array]:
    """Origin of the follower, mm, and its angle, rad, (n,).

    The origin of a slide is its roller or the middle of its face, that of a lever its axis; a lever's +x goes
    along its arm, or along its face.
    """
    geometry, zero = geometry_of(params), np.zeros_like(rates.s)
    if params.translating:
        offset = params.value("offset") if params.contact == "roller" else 0.0
        return np.asarray(offset + 1j * (geometry.start + rates.s), dtype=np.complex128), zero
    towards = math.pi - geometry.start if params.contact == "roller" else math.pi / 2 + geometry.start
    return np.full(zero.shape, complex(params.value("centre_distance"))), towards - rates.s


def _poses(params: CamParams, contacts: tuple[Contact, ...], rates: Rates) -> dict[str, Poses]:
    origin, angle = place_of(params, rates)
    poses = {FOLLOWER: Poses.planar(origin.real, origin.imag, angle)}
    if params.contact == "roller":
        for body, contact in zip(ROLLERS, contacts, strict=False):
            poses[body] = Poses.planar(contact.centre.real, contact.centre.imag, angle)
    if params.translating:
        for body, place in zip(RAILS, rails_of(params).places, strict=True):
            poses[body] = Poses.planar(place.real, place.imag, np.zeros_like(angle))
    return poses


def _joints(params: CamParams) -> dict[str, Joint]:
    found = {"camshaft": Joint("revolute", GROUND, CAM, drives=True), "guide": _guide(params)}
    if params.contact == "roller":
        for body, place in zip(ROLLERS, studs_of(params), strict=False):
            found[body] = Joint("fixed", FOLLOWER, body, (place.real, place.imag, 0.0))
    if params.translating:
        found |= {body: Joint("fixed", GROUND, body) for body in RAILS}
    return found


def _loads(params: CamParams, rates: Rates) -> dict[str, Load]:
    """Spring and load on the follower, which press it to the cam, and what moves with it."""
    preload, rate, load = spring_of(params)
    pressed = preload + rate * rates.s + load
    if params.translating:
        return {"pressed": Load(FOLLOWER, force=(0.0, -1.0, 0.0), mass=params.value("mass"), share=pressed)}
    # A lever rises clockwise.
    return {"pressed": Load(FOLLOWER, torque=(0.0, 0.0, 1.0), inertia=params.value("inertia"), share=pressed)}


def _guide(params: CamParams) -> Joint:
    if params.translating:
        return Joint("prismatic", GROUND, FOLLOWER, axis=(0.0, 1.0, 0.0))
    return Joint("revolute", GROUND, FOLLOWER, (params.value("centre_distance"), 0.0, 0.0))


def _follower(params: CamParams, lift: Array, over_time: tuple[Array, Array, Array]) -> dict[str, Channel]:
    unit = "mm" if params.translating else "rad"
    names = ("lift", "velocity", "acceleration", "jerk")
    values = (lift, *over_time)
    units = (unit, f"{unit}/s", f"{unit}/s^2", f"{unit}/s^3")
    return {
        name: Channel(value, one, f"{name} of the follower")
        for name, value, one in zip(names, values, units, strict=True)
    }


def _contact(
    params: CamParams, contacts: tuple[Contact, ...], rates: Rates, acceleration: Array
) -> dict[str, Channel]:
    loads, found = loads_at(params, rates, contacts, acceleration), {}
    for number, contact in enumerate(contacts):
        end, of = ("", "") if number == 0 else ("2", " of the second cam")
        found[f"pressure_angle{end}"] = Channel(contact.pressure_angle, "rad", f"pressure angle{of}")
        found[f"curvature{end}"] = Channel(inverse(contact.radius), "1/mm", f"curvature{of or ' of the cam'}")
        if params.contact == "roller":
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


def _curves(params: CamParams) -> dict[str, Curve]:
    theta = np.linspace(0.0, math.tau, _DRAWN)
    contacts = contacts_at(params, cycle_of(params).at(theta))
    turned = np.exp(-1j * params.sense * theta)
    found = {}
    for number, contact in enumerate(contacts):
        end = "" if number == 0 else "-2"
        found[f"profile{end}"] = Curve.planar(CAM, contact.point * turned)
        if params.contact == "roller":
            found[f"pitch-curve{end}"] = Curve.planar(CAM, contact.centre * turned)
    return found


@kept
def figures(params: CamParams) -> dict[str, Scalar]:
    """Name to value and unit; extremes are refined, so that they do not depend on the samples."""
    omega, unit = params.omega, "mm" if params.translating else "rad"
    found: dict[str, Scalar] = {}
    for number in range(2 if params.conjugate else 1):
        end, seen = "" if number == 0 else "2", extremes_of(params, bool(number))
        for name, one, of in (
            ("pressure_angle_max", seen.pressure, "rad"),
            ("cam_radius_min", seen.innermost, "mm"),
            ("cam_radius_max", seen.outermost, "mm"),
            ("curvature_radius_min", seen.sharpest, "mm"),
        ):
            if math.isfinite(one.value):
                found[f"{name}{end}"] = Scalar(one.value, of)
                found[f"{name}{end}.theta"] = Scalar(one.angle, "rad")
    for name, order in (("velocity", "v"), ("acceleration", "a"), ("jerk", "j")):
        power = "vaj".index(order) + 1

        def size(rates: Rates, order: str = order) -> Array:
            values: Array = np.abs(getattr(rates, order))
            return values

        most = greatest(params, size).value * omega**power
        found[f"{name}_max"] = Scalar(most, f"{unit}/s" + (f"^{power}" if power > 1 else ""))
    for name, extreme, of in _loaded(params):
        found[name] = Scalar(extreme.value, of)
    if not params.conjugate:
        found["press_min"] = Scalar(weakest_of(params).value, "N" if params.translating else "N*m")
    return found


@kept
def _loaded(params: CamParams) -> tuple[tuple[str, Extreme, str], ...]:
    """Greatest force, pressure and torque, refined."""

    def of(what: str) -> Extreme:
        def measure(rates: Rates) -> Array:
            loads = loads_at(params, rates, contacts_at(params, rates))
            values = np.abs(loads.torque) if what == "torque" else np.max(getattr(loads, what), axis=0)
            return np.asarray(values)

        return greatest(params, measure)

    return (
        ("contact_force_max", of("force"), "N"),
        ("contact_pressure_max", of("pressure"), "MPa"),
        ("torque_max", of("torque"), "N*m"),
    )


def loaded(params: CamParams) -> dict[str, Extreme]:
    """Greatest contact force, N, contact pressure, MPa, and torque, N·m, by the names of the figures."""
    return {name: extreme for name, extreme, _ in _loaded(params)}
