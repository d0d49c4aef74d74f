"""The motion of a design: channels and poses over one turn of gear 2; its figures stand in ``figures``.

What holds the gears of a pair or a train, and what is fixed to them.
"""

import math
from collections.abc import Mapping
from functools import reduce
from typing import Any

import numpy as np

from mechwright import GROUND, Array, Channel, Curve, Joint, Load, Motion, Poses, Trace
from mechwright.contracts.figure import scalars
from mechwright.contracts.joint import fixed
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.planar import PointMotion
from mechwright.mechanics.planar.channels import along, turning_channels
from mechwright_elliptic_gears.kinematics.equations import (
    Turning,
    coupler,
    driven,
    pitch_radii,
    shaft_pressure_angle,
    train,
)
from mechwright_elliptic_gears.kinematics.figures import figures_of
from mechwright_elliptic_gears.kinematics.point import place, point_of_coupler
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.clamp import clamp_of
from mechwright_elliptic_gears.parts.dividing import START
from mechwright_elliptic_gears.parts.gear import ellipse_of
from mechwright_elliptic_gears.parts.layout import (
    DOWELS,
    PHASE_PIN,
    PIN_KEEPER,
    clamp_screws,
    dividing_of,
    joining_bodies,
    keeper_of,
    layout_of,
)
from mechwright_elliptic_gears.table import GearTable, table_of


def held_by(params: EllipticGearParams) -> dict[str, Joint]:
    """Joints of all bodies of the motion; the ratio of elliptic gears changes over the turn."""
    a = ellipse_of(params).semi_major
    focus = (2 * a * params.eccentricity, 0.0, 0.0)
    if params.phase_angle is None:
        return {
            "o2": Joint("revolute", GROUND, "gear-2", drives=True),
            "o4": Joint("revolute", GROUND, "gear-4", (2 * a, 0.0, 0.0)),
            "mesh": Joint("gear", "gear-2", "gear-4"),
            **_coupler("gear-2", "gear-4", focus),
        }
    return {
        **fixed(GROUND, "base", "axis-2", "axis-5"),
        "o2": Joint("revolute", "base", "gear-2", (-2 * a, 0.0, 0.0), drives=True),
        "o4": Joint("revolute", "base", "gear-3"),
        "o5": Joint("revolute", "base", "gear-5", (2 * a, 0.0, 0.0)),
        **fixed("gear-3", "gear-4", *joining_bodies(params)),
        **fixed("gear-4", "joint-j"),
        **fixed("gear-5", "joint-k"),
        "mesh": Joint("gear", "gear-2", "gear-3"),
        "second-mesh": Joint("gear", "gear-3", "gear-5"),
        **_coupler("gear-4", "gear-5", focus),
    }


def _coupler(one: str, two: str, focus: tuple[float, float, float]) -> dict[str, Joint]:
    """The link between the free foci of two gears, 2a long."""
    return {"j": Joint("revolute", one, "coupler", focus), "k": Joint("revolute", two, "coupler", focus)}


def motion_of(params: EllipticGearParams, samples: Samples) -> Motion:
    """Sample one turn of gear 2 at constant speed, both ends included.

    The origin is the axis of the coupler's gear 2 (single pair) or 4 (train), the axis of its mate lies at
    2a on x; gear 2 of a train turns about (-2a, 0).
    """
    omega = params.speed * math.tau / 60
    theta2 = travelled(math.tau, samples)
    return driven_by(params, Turning.of(theta2, omega), theta2 / omega)


def driven_by(params: EllipticGearParams, gear2: Turning, time: Array) -> Motion:
    """The motion for any motion of gear 2, at times (n,), s; coordinates as :func:`motion_of` says."""
    a, e = ellipse_of(params).semi_major, params.eccentricity
    phase, c = params.phase_angle, place(params.point_along, params.point_across, a)
    turning = _turning(gear2, e, phase)
    channels = _channels(turning, a, e, time, math.radians(params.pressure_angle), c)
    poses = _pair_poses(turning, a, e) if phase is None else _train_poses(params, turning)
    traces = {"Q": Trace("coupler", (2 * a * params.point_along, params.point_across, 0.0))}
    around = np.linspace(0, math.tau, _PITCH_SAMPLES)
    ellipse = ellipse_of(params)
    pitch = (
        ellipse.focal_distance
        + ellipse.semi_major * np.cos(around)
        + 1j * ellipse.semi_minor * np.sin(around)
    )
    curves = {f"pitch-{name}": Curve.planar(name, pitch) for name in poses if name.startswith("gear-")}
    loads = {"load_torque": Load("gear-4" if phase is None else "gear-5", resisting=params.load_torque)}
    return Motion(
        "theta2",
        channels,
        poses,
        scalars(figures_of(table_of(params))),
        traces,
        held_by(params),
        curves,
        loads,
    )


def _turning(gear2: Turning, e: Any, phase: Any) -> dict[str, Turning]:
    """The gears by their numbers, and the coupler last; designs are columns (n, 1)."""
    if phase is None:
        gear4 = driven(gear2, e)
        return {"2": gear2, "4": gear4, "3": coupler(gear2, gear4)}
    gear3, gear4, gear5 = train(gear2, e, phase)
    return {"2": gear2, "3": gear3, "4": gear4, "5": gear5, "6": coupler(gear4, gear5)}


def channels_of(m: GearTable, samples: int) -> dict[str, Channel]:
    """The channels (n, samples) of a table of designs over one turn of gear 2 at constant speed."""
    given, theta2 = m.given, travelled(math.tau, samples)
    e, phase = given.eccentricity, given.phase_angle
    alpha, c = np.radians(given.pressure_angle), place(given.point_along, given.point_across, m.semi_major)
    turning = _turning(Turning.of(theta2, m.omega), e, phase)
    return _channels(turning, m.semi_major, e, theta2 / m.omega, alpha, c)


def _channels(
    turning: Mapping[str, Turning], a: Any, e: Any, time: Any, alpha: Any, c: Any
) -> dict[str, Channel]:
    *_, link = turning
    pair, gear2 = link == "3", turning["2"]
    first, second = (gear2, turning["4"]) if pair else (turning["4"], turning["5"])
    q = point_of_coupler(first, second, a, e, c)
    channels = {"time": Channel(time, "s", "time")}
    for number, one in turning.items():
        channels |= turning_channels(one, f"theta{number}", number, _called(number, link))
    # A gear that stands, as behind a Geneva wheel, has no ratio of speeds: 0.
    omega = np.where(gear2.omega == 0, np.inf, gear2.omega)
    channels["ratio"] = Channel(second.omega / omega, "", "ratio of the speeds")
    if pair:
        s2, s4 = pitch_radii(gear2, a, e)
        channels |= {
            "s2": Channel(s2, "mm", "pitch radius of gear 2"),
            "s4": Channel(s4, "mm", "pitch radius of gear 4"),
        }
    channels |= _point_channels(q)
    inputs = [gear2] if pair else [gear2, first]
    steepest = reduce(np.maximum, [shaft_pressure_angle(one, e, alpha) for one in inputs])
    channels["pressure_angle"] = Channel(steepest, "rad", "pressure angle at the shaft")
    return channels


_PITCH_SAMPLES = 181
"""Points of a pitch curve that is drawn: each two degrees."""


POINT = "point Q"


def _called(number: str, link: str) -> str:
    """What turns, as people are told it; the coupler is counted after the gears."""
    return "the coupler" if number == link else f"gear {number}"


def _point_channels(q: PointMotion) -> dict[str, Channel]:
    return {
        "Q.x": Channel(q.position.real, "mm", along("x", "", POINT)),
        "Q.y": Channel(q.position.imag, "mm", along("y", "", POINT)),
        "Q.velocity.x": Channel(q.velocity.real, "mm/s", along("x", "velocity", POINT)),
        "Q.velocity.y": Channel(q.velocity.imag, "mm/s", along("y", "velocity", POINT)),
        "Q.speed": Channel(q.speed, "mm/s", f"speed of {POINT}"),
        "Q.acceleration.x": Channel(q.acceleration.real, "mm/s^2", along("x", "acceleration", POINT)),
        "Q.acceleration.y": Channel(q.acceleration.imag, "mm/s^2", along("y", "acceleration", POINT)),
        "Q.acceleration": Channel(np.abs(q.acceleration), "mm/s^2", f"acceleration of {POINT}"),
        "Q.jerk.x": Channel(q.jerk.real, "mm/s^3", along("x", "jerk", POINT)),
        "Q.jerk.y": Channel(q.jerk.imag, "mm/s^3", along("y", "jerk", POINT)),
        "Q.jerk": Channel(np.abs(q.jerk), "mm/s^3", f"jerk of {POINT}"),
    }


def _pair_poses(turning: Mapping[str, Turning], a: float, e: float) -> dict[str, Poses]:
    theta2, theta4 = turning["2"].theta, turning["4"].theta
    return {
        "gear-2": Poses.planar(0.0, 0.0, theta2),
        "gear-4": Poses.planar(2 * a, 0.0, theta4),
        "coupler": Poses.planar(*_free_focus(theta2, a, e), turning["3"].theta),
    }


def _train_poses(params: EllipticGearParams, turning: Mapping[str, Turning]) -> dict[str, Poses]:
    """Gears, coupler, joints (their pins turn with gears 4 and 5), dowels, and what stands still."""
    layout = layout_of(params)
    a, e = layout.semi_major, layout.eccentricity
    theta4, theta5 = turning["4"].theta, turning["5"].theta
    j, k = _free_focus(theta4, a, e), _free_focus(theta5, a, e)
    still = np.zeros_like(theta4)
    return {
        "base": Poses.planar(0.0, 0.0, still),
        "gear-2": Poses.planar(-2 * a, 0.0, turning["2"].theta),
        "gear-3": Poses.planar(0.0, 0.0, turning["3"].theta),
        "gear-4": Poses.planar(0.0, 0.0, theta4),
        "gear-5": Poses.planar(2 * a, 0.0, theta5),
        "coupler": Poses.planar(*j, turning["6"].theta),
        "joint-j": Poses.planar(*j, theta4),
        "joint-k": Poses.planar(k[0] + 2 * a, k[1], theta5),
        "axis-2": Poses.planar(-2 * a, 0.0, still),
        "axis-5": Poses.planar(2 * a, 0.0, still),
        **_joining_poses(params, turning["3"].theta, theta4),
    }


def _joining_poses(params: EllipticGearParams, theta3: Array, theta4: Array) -> dict[str, Poses]:
    """What joins gears 3 and 4: the pin of a dividing circle, screws, or dowels."""
    if params.phase_joint == "pins":
        radius = dividing_of(params).radius_at(params.phase_degrees)
        at = theta4 + START
        found = {PHASE_PIN: Poses.planar(radius * np.cos(at), radius * np.sin(at), theta4)}
        if (keeper := keeper_of(params)) is not None:
            place = keeper.place * np.exp(1j * theta4)
            found[PIN_KEEPER] = Poses.planar(place.real, place.imag, theta4)
        return found
    if params.phase_joint == "clamp":
        clamp = clamp_of(params)
        return {
            name: Poses.planar(clamp.circle * np.cos(theta3 + at), clamp.circle * np.sin(theta3 + at), theta3)
            for name, at in zip(clamp_screws(params), clamp.directions, strict=True)
        }
    radius = layout_of(params).dowel_circle / 2
    return {
        name: Poses.planar(radius * np.cos(theta3 + at), radius * np.sin(theta3 + at), theta3)
        for name, at in (DOWELS.items() if params.dowelled else ())
    }


def _free_focus(theta: Array, a: float, e: float) -> tuple[Array, Array]:
    return 2 * a * e * np.cos(theta), 2 * a * e * np.sin(theta)
