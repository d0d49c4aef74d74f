"""The motion of a pair: channels, poses and figures over one turn of the driver."""

import math
from collections.abc import Mapping

import numpy as np

from mechwright import GROUND, Array, Channel, Curve, Joint, Load, Motion, Poses
from mechwright.contracts.figure import Figure, scalars
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import turning_channels
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.parts.teeth import rolling_pair

CIRCLE_SAMPLES = 361
"""Points of a pitch circle that is drawn."""


def motion_of(m: GearTable, samples: Samples) -> Motion:
    """Sample one turn of the driver at constant speed, both ends included.

    The driver turns about the origin. A driven gear turns about (a, 0), the other way round, and a ring about
    (-a, 0), the same way round.
    """
    phi = travelled(math.tau, samples)
    return motion_over(m, Turning.of(phi, float(m.omega)), phi / float(m.omega))


def driven(m: GearTable, driver: Turning) -> Turning:
    """The driven gear, for any motion of the driver."""
    return driver.scaled(m.ratio)


def channels_over(m: GearTable, driver: Turning, time: Array) -> dict[str, Channel]:
    """Angles of both gears and their rates."""
    return {
        "time": Channel(time, "s", "time"),
        **turning_channels(driver, "theta1", "1", "gear 1"),
        **turning_channels(driven(m, driver), "theta2", "2", "gear 2"),
    }


def motion_over(m: GearTable, driver: Turning, time: Array) -> Motion:
    """The motion for any motion of the driver, at times (n,), s."""
    (one, two), pair = m.names, rolling_pair(m)
    poses = {
        one: Poses.planar(0.0, 0.0, driver.theta),
        two: Poses.planar(pair.axis, 0.0, driven(m, driver).theta + pair.start),
    }
    held = {
        "o1": Joint("revolute", GROUND, one, drives=True),
        "o2": Joint("revolute", GROUND, two, (pair.axis, 0.0, 0.0)),
        "mesh": Joint("gear", one, two),
    }
    loads = {"load_torque": Load(two, resisting=m.given.load_torque)}
    channels = channels_over(m, driver, time)
    return Motion("theta1", channels, poses, scalars(figures_of(m)), {}, held, _circles(m), loads)


def _circles(m: GearTable) -> dict[str, Curve]:
    around = np.exp(1j * np.linspace(0.0, math.tau, CIRCLE_SAMPLES))
    return {
        f"pitch-{name}": Curve.planar(name, abs(float(m.pair.operating(gear))) * around)
        for gear, name in enumerate(m.names)
    }


def figures_of(m: GearTable) -> Mapping[str, Figure]:
    """The figures of a pair, or of a table of pairs."""
    pair = m.pair
    found = {
        "ratio": Figure(lambda: abs(m.ratio)),
        "centre_distance": Figure(lambda: m.distance, "mm"),
        "operating_pressure_angle": Figure(lambda: pair.operating_angle, "rad"),
        "contact_ratio": Figure(lambda: pair.contact_ratio),
        "tip_shortening": Figure(lambda: pair.shortening * pair.module, "mm"),
        "backlash": Figure(lambda: pair.backlash, "mm"),
    }
    for gear in (0, 1):
        found |= {
            f"shift{gear + 1}": Figure(lambda gear=gear: pair.shifts[gear]),
            f"tip_diameter{gear + 1}": Figure(lambda gear=gear: 2 * abs(pair.tip(gear)), "mm"),
            f"root_diameter{gear + 1}": Figure(lambda gear=gear: 2 * abs(pair.root(gear)), "mm"),
            f"pitch_diameter{gear + 1}": Figure(lambda gear=gear: 2 * abs(pair.operating(gear)), "mm"),
            f"sliding{gear + 1}": Figure(lambda gear=gear: pair.sliding(gear)),
        }
    return found


def table_channels(m: GearTable, samples: int) -> dict[str, Channel]:
    """The channels (n, samples) of a table of pairs over one turn of each driver."""
    phi = travelled(math.tau, samples)
    omega = np.broadcast_to(m.omega, (m.size, 1))
    return channels_over(m, Turning.of(np.broadcast_to(phi, (m.size, samples)), omega), phi / omega)
