"""Figures of the whole motion: refined, so that they do not depend on how finely it is sampled."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from mechwright import Array, kept
from mechwright.contracts.figure import Figure
from mechwright.mechanics.peak import Peak
from mechwright_elliptic_gears.kinematics.equations import (
    Turning,
    alpha_peak,
    driven,
    jerk_peak,
    steepest_shaft_pressure_angle,
    train,
)
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import place, point_of_coupler, speed_of_q
from mechwright_elliptic_gears.kinematics.window import Window, near_constant
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of
from mechwright_elliptic_gears.table import GearTable

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


def figures_of(m: GearTable) -> dict[str, Figure]:
    """The figures of one design, or of a table of designs."""
    e, omega, last = m.given.eccentricity, m.omega, "4" if m.given.stages == 1 else "5"
    swing = (1 + e) / (1 - e)
    rates: dict[str, Callable[[], Any]] = {
        "omega": lambda: swing * omega,
        "alpha": lambda: alpha_peak(e) * omega**2,
        "jerk": lambda: jerk_peak(e) * omega**3,
    }
    if m.given.stages == 2:
        rates = {name: partial(_sought, m, f"{name}{last}_max") for name in rates}
    found = {
        "centre_distance": Figure(lambda: 2 * m.semi_major, "mm"),
        "ratio_max": Figure(lambda: rates["omega"]() / omega),
        "ratio_min": Figure((lambda: 1 / swing) if m.given.stages == 1 else partial(_sought, m, "ratio_min")),
    }
    for (name, rate), unit in zip(rates.items(), ("rad/s", "rad/s^2", "rad/s^3"), strict=True):
        found[f"{name}{last}_max"] = Figure(rate, unit)
    for name, unit in _POINT_FIGURES.items():
        found[f"Q.{name}"] = Figure(partial(_sought, m, f"Q.{name}"), unit)
    return found | {"pressure_angle_max": Figure(lambda: steepest_pressure_angle(m), "rad")}


def steepest_pressure_angle(m: GearTable) -> Any:
    """Largest pressure angle at the shaft over a turn, rad."""
    return steepest_shaft_pressure_angle(m.given.eccentricity, np.radians(m.given.pressure_angle))


_POINT_FIGURES = {
    "speed.max": "mm/s",
    "speed.max.theta2": "rad",
    "acceleration.max": "mm/s^2",
    "acceleration.max.theta2": "rad",
    "jerk.max": "mm/s^3",
    "jerk.max.theta2": "rad",
    "constant_speed_window.start": "rad",
    "constant_speed_window.end": "rad",
    "constant_speed_window.length": "rad",
    "constant_speed_window.band": "mm/s",
    "constant_speed_window.least_speed": "mm/s",
}
"""Figures of Q, which are sought design by design."""


def _sought(m: GearTable, name: str) -> Any:
    """A figure that is sought, of one design or in a column."""
    group = last_gear_figures
    if name.startswith("Q."):
        group = window_figures if "window" in name else point_figures
    if m.single:
        return group(m.given)[name]

    def columns() -> dict[str, Array]:
        each = [group(m.row(place).given) for place in range(m.size)]
        return {key: np.array([[one[key]] for one in each]) for key in each[0]}

    return m.once(group.__name__, columns)[name]


@kept
def window_figures(params: EllipticGearParams) -> dict[str, float]:
    """Figures of the longest stretch of near-constant speed of Q."""
    window = point_window(params)
    return {
        "Q.constant_speed_window.start": window.start,
        "Q.constant_speed_window.end": window.start + window.length,
        "Q.constant_speed_window.length": window.length,
        "Q.constant_speed_window.band": band_of(params),
        "Q.constant_speed_window.least_speed": window.low,
    }


@kept
def point_figures(params: EllipticGearParams) -> dict[str, float]:
    """Greatest rates of Q."""
    found: dict[str, float] = {}
    for name, top in point_peaks(params).items():
        found |= {f"Q.{name}.max": top.value, f"Q.{name}.max.theta2": top.angle}
    return found


@kept
def last_gear_figures(params: EllipticGearParams) -> dict[str, float]:
    """Greatest rates of a train's last gear."""
    omega = params.speed * math.tau / 60

    def extreme(name: str, sign: float = 1.0) -> Callable[[Array], Array]:
        def values(theta2: Array) -> Array:
            gear = coupled_gears(Turning.of(theta2, omega), params.eccentricity, params.phase_angle)[1]
            sizes: Array = sign * np.abs(getattr(gear, name))
            return sizes

        return values

    found = {f"{name}5_max": peak(extreme(name)).value for name in ("omega", "alpha", "jerk")}
    return found | {"ratio_min": -peak(extreme("omega", -1.0)).value / omega}


SOUGHT = (window_figures, point_figures, last_gear_figures)
"""What is sought of one design: figures of Q's window, of its peaks, and of a train's last gear."""
