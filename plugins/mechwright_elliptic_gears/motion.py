"""The motion of a design: channels, poses and figures over one turn of gear 2."""

import math
from collections.abc import Callable

import numpy as np

from mechwright.errors import DesignError
from mechwright.motion import Array, Channel, Motion, Poses, Scalar
from mechwright_elliptic_gears.gear import BODIES, ellipse_of
from mechwright_elliptic_gears.kinematics import (
    Turning,
    coupler,
    coupler_midpoint,
    driven,
    pitch_radii,
    shaft_pressure_angle,
    steepest_shaft_pressure_angle,
)
from mechwright_elliptic_gears.params import EllipticGearParams
from mechwright_elliptic_gears.window import near_constant

BAND = 0.02
"""Width of the band of near-constant speed of Q over a ω2: the 10 mm/s at a = 50 mm and 10 rad/s with which
the published pairs are compared."""

_PEAK_SAMPLES = 2048
"""Grid that finds a peak; twice refined by its own step it is exact to 1e-9 of a turn."""


def motion_of(params: EllipticGearParams, samples: int) -> Motion:
    """Sample one turn of gear 2 at constant speed, both ends included.

    Raises
    ------
    DesignError
        Fewer than two samples.
    """
    if samples < 2:
        raise DesignError(f"samples: {samples} are too few for a turn; take at least 2")
    a, e = ellipse_of(params).semi_major, params.eccentricity
    omega = params.speed * math.tau / 60
    theta2 = np.linspace(0, math.tau, samples)
    gear2 = Turning.of(theta2, omega)
    gear4 = driven(gear2, e)
    link = coupler(gear2, gear4)
    s2, s4 = pitch_radii(gear2, a, e)
    q = coupler_midpoint(gear2, gear4, a, e)
    channels = {"time": Channel(theta2 / omega, "s")}
    for number, turning in (("2", gear2), ("4", gear4), ("3", link)):
        channels |= {
            f"theta{number}": Channel(turning.theta, "rad"),
            f"omega{number}": Channel(turning.omega, "rad/s"),
            f"alpha{number}": Channel(turning.alpha, "rad/s^2"),
            f"jerk{number}": Channel(turning.jerk, "rad/s^3"),
        }
    channels |= {
        "ratio": Channel(gear4.omega / gear2.omega, ""),
        "s2": Channel(s2, "mm"),
        "s4": Channel(s4, "mm"),
        "xQ": Channel(q.position.real, "mm"),
        "yQ": Channel(q.position.imag, "mm"),
        "vxQ": Channel(q.velocity.real, "mm/s"),
        "vyQ": Channel(q.velocity.imag, "mm/s"),
        "vQ": Channel(q.speed, "mm/s"),
        "axQ": Channel(q.acceleration.real, "mm/s^2"),
        "ayQ": Channel(q.acceleration.imag, "mm/s^2"),
        "aQ": Channel(np.abs(q.acceleration), "mm/s^2"),
        "pressure_angle": Channel(shaft_pressure_angle(gear2, e, math.radians(params.pressure_angle)), "rad"),
    }
    still = 2 * a * e
    first, second = BODIES
    poses = {
        first: Poses.planar(0.0, 0.0, gear2.theta),
        second: Poses.planar(2 * a, 0.0, gear4.theta),
        "coupler": Poses.planar(still * np.cos(theta2), still * np.sin(theta2), link.theta),
    }
    return Motion("theta2", channels, poses, _figures(params, a, omega))


def _figures(params: EllipticGearParams, a: float, omega: float) -> dict[str, Scalar]:
    e = params.eccentricity

    def pair(theta2: Array) -> tuple[Turning, Turning]:
        gear2 = Turning.of(theta2, omega)
        return gear2, driven(gear2, e)

    def speed(theta2: Array) -> Array:
        return coupler_midpoint(*pair(theta2), a, e).speed

    window = near_constant(speed, BAND * a * omega)
    return {
        "centre_distance": Scalar(2 * a, "mm"),
        "ratio_max": Scalar((1 + e) / (1 - e), ""),
        "ratio_min": Scalar((1 - e) / (1 + e), ""),
        "omega4_max": Scalar(omega * (1 + e) / (1 - e), "rad/s"),
        "alpha4_max": Scalar(peak(lambda t: np.abs(pair(t)[1].alpha)), "rad/s^2"),
        "jerk4_max": Scalar(peak(lambda t: np.abs(pair(t)[1].jerk)), "rad/s^3"),
        "vQ_max": Scalar(peak(speed), "mm/s"),
        "aQ_max": Scalar(peak(lambda t: np.abs(coupler_midpoint(*pair(t), a, e).acceleration)), "mm/s^2"),
        "window_start": Scalar(window.start, "rad"),
        "window_length": Scalar(window.length, "rad"),
        "window_speed": Scalar(window.low, "mm/s"),
        "pressure_angle_max": Scalar(
            steepest_shaft_pressure_angle(e, math.radians(params.pressure_angle)), "rad"
        ),
    }


def peak(function: Callable[[Array], Array]) -> float:
    """Greatest value of a smooth function of period 2π, independent of any sampling of the motion.

    >>> round(peak(lambda t: 3 + np.sin(t - 1)), 12)
    4.0
    """
    centre, half = math.pi, math.pi
    best = -math.inf
    for _ in range(3):
        at = centre + half * np.linspace(-1, 1, _PEAK_SAMPLES + 1)
        values = function(at)
        top = int(np.argmax(values))
        best = max(best, float(values[top]))
        centre, half = float(at[top]), half * 2 / _PEAK_SAMPLES
    return best
