"""Figures of the whole motion: refined, so that they do not depend on how finely it is sampled."""

import math
from collections.abc import Callable

import numpy as np

from mechwright import Array, Scalar, kept
from mechwright.mechanics.peak import Peak
from mechwright_elliptic_gears.kinematics.equations import (
    Turning,
    driven,
    steepest_shaft_pressure_angle,
    train,
)
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import place, point_of_coupler, speed_of_q
from mechwright_elliptic_gears.kinematics.window import Window, near_constant
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of

BAND = 0.02
"""Width of the band of near-constant speed over a ω2 where the design names none: the 10 mm/s at a = 50 mm
and 10 rad/s with which the published trains are compared."""

POINT_RATES = ("speed", "acceleration", "jerk")
"""Rates of Q whose peaks are figures of a design."""


def band_of(params: EllipticGearParams) -> float:
    """Spread of speed, mm/s, that counts as constant."""
    if params.band is not None:
        return params.band
    return BAND * ellipse_of(params).semi_major * params.speed * math.tau / 60


def point_window(params: EllipticGearParams) -> Window:
    """The longest part of a turn on which the speed of Q stays within the band."""
    a = ellipse_of(params).semi_major
    scale = a * params.speed * math.tau / 60
    c = place(params.point_along, params.point_across, a)
    phase = params.phase_angle
    return near_constant(
        lambda theta2: scale * speed_of_q(theta2, params.eccentricity, phase, c), band_of(params)
    )


def point_peaks(params: EllipticGearParams, names: tuple[str, ...] = POINT_RATES) -> dict[str, Peak]:
    """Greatest speed, mm/s, acceleration, mm/s², and jerk, mm/s³, of Q, as far as they are asked for."""
    a, e = ellipse_of(params).semi_major, params.eccentricity
    omega = params.speed * math.tau / 60
    c = place(params.point_along, params.point_across, a)
    phase = params.phase_angle

    def size(name: str) -> Callable[[Array], Array]:
        def of(theta2: Array) -> Array:
            if name == "speed":
                return a * omega * speed_of_q(theta2, e, phase, c)
            gears = coupled_gears(Turning.of(theta2, omega), e, phase)
            found: Array = np.abs(getattr(point_of_coupler(*gears, a, e, c), name))
            return found

        return of

    return {name: peak(size(name)) for name in names}


def coupled_gears(gear2: Turning, eccentricity: float, phase: float | None) -> tuple[Turning, Turning]:
    """The two gears that carry the coupler."""
    if phase is None:
        return gear2, driven(gear2, eccentricity)
    return train(gear2, eccentricity, phase)[1:]


@kept
def figures(params: EllipticGearParams) -> dict[str, Scalar]:
    """Name to value and unit."""
    a, e = ellipse_of(params).semi_major, params.eccentricity
    omega = params.speed * math.tau / 60
    phase = params.phase_angle
    last = "4" if phase is None else "5"

    def extreme(name: str, sign: float = 1.0) -> Callable[[Array], Array]:
        def values(theta2: Array) -> Array:
            gear = coupled_gears(Turning.of(theta2, omega), e, phase)[1]
            found: Array = sign * np.abs(getattr(gear, name))
            return found

        return values

    fastest, slowest = peak(extreme("omega")).value, -peak(extreme("omega", -1.0)).value
    window = point_window(params)
    found = {
        "centre_distance": Scalar(2 * a, "mm"),
        "ratio_max": Scalar(fastest / omega, ""),
        "ratio_min": Scalar(slowest / omega, ""),
        f"omega{last}_max": Scalar(fastest, "rad/s"),
        f"alpha{last}_max": Scalar(peak(extreme("alpha")).value, "rad/s^2"),
        f"jerk{last}_max": Scalar(peak(extreme("jerk")).value, "rad/s^3"),
    }
    units = {"speed": "mm/s", "acceleration": "mm/s^2", "jerk": "mm/s^3"}
    for name, top in point_peaks(params).items():
        found |= {
            f"Q.{name}.max": Scalar(top.value, units[name]),
            f"Q.{name}.max.theta2": Scalar(top.angle, "rad"),
        }
    return found | {
        "Q.constant_speed_window.start": Scalar(window.start, "rad"),
        "Q.constant_speed_window.end": Scalar(window.start + window.length, "rad"),
        "Q.constant_speed_window.length": Scalar(window.length, "rad"),
        "Q.constant_speed_window.band": Scalar(band_of(params), "mm/s"),
        "Q.constant_speed_window.least_speed": Scalar(window.low, "mm/s"),
        "pressure_angle_max": Scalar(
            steepest_shaft_pressure_angle(e, math.radians(params.pressure_angle)), "rad"
        ),
    }
