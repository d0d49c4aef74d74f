"""The motion of a pair: channels, poses and figures until both gears are back where they began."""

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
from mechwright.mechanics.gearing import Rolling
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import turning_channels
from mechwright_noncircular_gears.checks import standing
from mechwright_noncircular_gears.gear import NAMES, curves_of, pair_of
from mechwright_noncircular_gears.law import extremes_of, law_of, least
from mechwright_noncircular_gears.laws.sector import swung
from mechwright_noncircular_gears.params import NoncircularParams

_PITCH_SAMPLES = 361
"""Points of a pitch curve that is drawn: each degree."""


def turns_of(params: NoncircularParams) -> int:
    """Turns of the driver after which both gears stand as before.

    >>> turns_of(NoncircularParams(law="ellipse", lobes=2, mate_lobes=3, teeth=40))
    3
    """
    return params.mate_lobes // math.gcd(params.lobes, params.mate_lobes)


def motion_of(params: NoncircularParams, samples: Samples) -> Motion:
    """Sample the turns of the driver at constant speed, or its swing there and back, both ends included.

    The driver turns about the origin, the driven gear about (a, 0), the other way round; a ring about
    (-a, 0), the same way.

    Raises
    ------
    KinematicsError
        The law does not turn the driven gear on all the way.
    """
    phi = travelled(math.tau * turns_of(params), samples)
    driver = Turning.of(phi, params.omega) if params.sector is None else swinging(params, phi)
    return driven_by(params, driver, phi / params.omega)


def swinging(params: NoncircularParams, phase: Array) -> Turning:
    """The driver of sectors at phases (n,), rad, of its swing there and back: φ = S/2 (1 - cos)."""
    half, omega = math.radians(params.sector or 0.0) / 2, params.omega
    sin, cos = np.sin(phase), np.cos(phase)
    return Turning(half * (1 - cos), half * omega * sin, half * omega**2 * cos, -half * omega**3 * sin)


def driven(params: NoncircularParams, driver: Turning) -> Turning:
    """The driven gear of any motion of the driver, about +z: a ring with the driver, others against it."""
    law, way = law_of(params), -params.side
    ratio, first, second = law.rates(driver.theta)
    return Turning(way * law.angle(driver.theta), *driver.carried(way * ratio, way * first, way * second))


def driven_by(params: NoncircularParams, driver: Turning, time: Array) -> Motion:
    """The motion for any motion of the driver, at times (n,), s; raises as :func:`motion_of`."""
    for finding in errors(standing(params), Stage.MOTION):
        raise KinematicsError(f"{finding.parameter}: {finding.message}; {finding.remedy}")
    law, pair, phi = law_of(params), pair_of(params), driver.theta
    ratio = law.rates(phi)[0]
    r1, r2 = pair.pitch_radii(phi)
    slope = np.abs(Rolling.of(law, phi, params.side).tilt)
    mate = driven(params, driver)
    channels = {
        "time": Channel(time, "s", "time"),
        **turning_channels(driver, "theta1", "1", "gear 1"),
        **turning_channels(mate, "theta2", "2", "gear 2"),
        "ratio": Channel(ratio, "", "ratio of the speeds"),
        "s1": Channel(r1, "mm", "pitch radius of gear 1"),
        "s2": Channel(r2, "mm", "pitch radius of gear 2"),
        "pressure_angle": Channel(
            slope + math.radians(params.pressure_angle), "rad", "pressure angle at the shaft"
        ),
    }
    a = pair.axis
    poses = {
        "gear-1": Poses.planar(0.0, 0.0, driver.theta),
        "gear-2": Poses.planar(a, 0.0, mate.theta),
    }
    held = {
        "o1": Joint("revolute", GROUND, "gear-1", drives=True),
        "o2": Joint("revolute", GROUND, "gear-2", (a, 0.0, 0.0)),
        "mesh": Joint("gear", "gear-1", "gear-2"),
    }
    loads = {"load_torque": Load("gear-2", resisting=params.load_torque)}
    return Motion("theta1", channels, poses, figures(params), {}, held, _pitch_curves(params), loads)


def _pitch_curves(params: NoncircularParams) -> dict[str, Curve]:
    found = {}
    for name, curve in zip(NAMES, curves_of(params), strict=True):
        around = np.linspace(0.0, math.tau, _PITCH_SAMPLES)
        point = curve.frame(around if params.sector is None else curve.around(_PITCH_SAMPLES)).point
        found[f"pitch-{name}"] = Curve.planar(name, point[:, 0] + 1j * point[:, 1])
    return found


@kept
def figures(params: NoncircularParams) -> dict[str, Scalar]:
    """Name to value and unit; extremes are refined, so that they do not depend on the samples."""
    found, omega = extremes_of(params), params.omega
    speed, alpha, jerk = (_greatest(params, order) for order in range(3))
    steepest = found.steepest.value + math.radians(params.pressure_angle)
    return {
        "centre_distance": Scalar(pair_of(params).distance, "mm"),
        "ratio_max": Scalar(found.fastest.value, ""),
        "ratio_max.theta1": Scalar(found.fastest.angle, "rad"),
        "ratio_min": Scalar(found.slowest.value, ""),
        "ratio_min.theta1": Scalar(found.slowest.angle, "rad"),
        "omega2_max": Scalar(speed * omega, "rad/s"),
        "alpha2_max": Scalar(alpha * omega**2, "rad/s^2"),
        "jerk2_max": Scalar(jerk * omega**3, "rad/s^3"),
        "pressure_angle_max": Scalar(steepest, "rad"),
    }


def _greatest(params: NoncircularParams, order: int) -> float:
    """The greatest size of a derivative of ψ at unit speed: of the ratio over φ, or over a swing's phase."""
    law = law_of(params)

    def size(phi: Array) -> Array:
        if params.sector is None:
            return -np.abs(law.rates(phi)[order])
        return -np.abs(swung(law, phi, math.radians(params.sector))[order])

    return -least(law, size).value
