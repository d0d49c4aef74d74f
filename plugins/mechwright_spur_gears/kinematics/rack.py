"""The motion of a pinion and its rack: there and back over the travel, v = ω r at any profile shift.

The pinion turns about the origin. The rack lies below it with its teeth up, the origin of its body in the
middle of its length, and slides along x: with the pinion at the angle θ it is at r θ - S/2, S being the
travel. The pinion swings as sectors do, θ = S/(2 r) (1 - cos ωt). In the middle of the travel a tooth of one
is in a space of the other: a space of the pinion is below its axis if the rack has an odd number of teeth.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from mechwright import GROUND, Array, Channel, Curve, Joint, Load, Motion, Poses
from mechwright.contracts.figure import Figure, scalars
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import turning_channels
from mechwright_spur_gears.gear_table import GearTable

CIRCLE_SAMPLES = 361
"""Points of a pitch circle that is drawn."""

RATES = (("velocity", "mm/s"), ("acceleration", "mm/s^2"), ("jerk", "mm/s^3"))
"""Channels of the rack beside its travel, with their units."""


def swinging(m: GearTable, phase: Array) -> Turning:
    """The pinion at phases (n,), rad, of its swing there and back."""
    half, omega = m.swing / 2, m.omega
    sin, cos = np.sin(phase), np.cos(phase)
    return Turning(half * (1 - cos), half * omega * sin, half * omega**2 * cos, -half * omega**3 * sin)


def rack_motion(m: GearTable, samples: Samples) -> Motion:
    """Sample one swing there and back, both ends included."""
    phase = travelled(math.tau, samples)
    driver, time = swinging(m, phase), phase / float(m.omega)
    channels = rack_channels(m, driver, time)
    place = channels["travel"].values - m.dimensions.travel / 2
    poses = {
        "gear-1": Poses.planar(0.0, 0.0, driver.theta + m.pinion_start - float(m.swing) / 2),
        "rack": Poses.planar(place, -float(m.distance), np.zeros_like(place)),
    }
    joints = {
        "o1": Joint("revolute", GROUND, "gear-1", drives=True),
        "guide": Joint("prismatic", GROUND, "rack", (0.0, -float(m.distance), 0.0), (1.0, 0.0, 0.0)),
    }
    joints["mesh"] = Joint("gear", "gear-1", "rack", ratio=float(m.pair.operating(0)))
    # A force against the rack whichever way it goes takes what such a torque against its pinion takes.
    loads = {"load_force": Load("gear-1", resisting=float(pinion_torque(m)))}
    return Motion("theta1", channels, poses, scalars(rack_figures(m)), {}, joints, _pitch_lines(m), loads)


def pinion_torque(m: GearTable) -> Any:
    """Of the load of the rack on its pinion, N m."""
    return m.dimensions.load_force * m.pair.operating(0) / 1000


def rack_channels(m: GearTable, driver: Turning, time: Array) -> dict[str, Channel]:
    """The pinion's angle, the rack's way, and their rates."""
    radius = m.pair.operating(0)
    way = (driver.omega, driver.alpha, driver.jerk)
    return {
        "time": Channel(time, "s", "time"),
        **turning_channels(driver, "theta1", "1", "gear 1"),
        "travel": Channel(radius * driver.theta, "mm", "travel of the rack"),
        **{
            name: Channel(radius * one, unit, f"{name} of the rack")
            for (name, unit), one in zip(RATES, way, strict=True)
        },
    }


def rack_table_channels(m: GearTable, samples: int) -> dict[str, Channel]:
    """The channels (n, samples) of a table."""
    phase = np.broadcast_to(travelled(math.tau, samples), (m.size, samples))
    return rack_channels(m, swinging(m, phase), phase / m.omega)


def _pitch_lines(m: GearTable) -> dict[str, Curve]:
    around = np.exp(1j * np.linspace(0.0, math.tau, CIRCLE_SAMPLES))
    above, half = float(m.distance - m.pair.operating(0)), float(m.rack_plate.length) / 2
    return {
        "pitch-gear-1": Curve.planar("gear-1", float(m.pair.operating(0)) * around),
        "pitch-rack": Curve.planar("rack", np.array([-half, half]) + 1j * above),
    }


def rack_figures(m: GearTable) -> Mapping[str, Figure]:
    """The figures of a rack and pinion, or of a table of them."""
    pair, plate = m.rack_pair, m.rack_plate
    return {
        "centre_distance": Figure(lambda: m.distance, "mm"),
        "travel_per_turn": Figure(lambda: math.tau * pair.operating(0), "mm"),
        "swing": Figure(lambda: m.swing, "rad"),
        "rack_speed": Figure(lambda: m.dimensions.travel / 2 * m.omega, "mm/s"),
        "rack_acceleration": Figure(lambda: m.dimensions.travel / 2 * m.omega**2, "mm/s^2"),
        "greatest_travel": Figure(lambda: pair.travel(m.dimensions.rack_teeth), "mm"),
        "rack_length": Figure(lambda: plate.length, "mm"),
        "operating_pressure_angle": Figure(lambda: pair.operating_angle, "rad"),
        "contact_ratio": Figure(lambda: pair.contact_ratio),
        "backlash": Figure(lambda: pair.backlash, "mm"),
        "shift1": Figure(lambda: pair.shifts[0]),
        "tip_diameter1": Figure(lambda: 2 * pair.tip(0), "mm"),
        "root_diameter1": Figure(lambda: 2 * pair.root(0), "mm"),
        "pitch_diameter1": Figure(lambda: 2 * pair.operating(0), "mm"),
        "sliding1": Figure(lambda: pair.sliding(0)),
        "sliding2": Figure(lambda: pair.sliding(1)),
        "pinion_torque": Figure(lambda: pinion_torque(m), "N*m"),
    }
