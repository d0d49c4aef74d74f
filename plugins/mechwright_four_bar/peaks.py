"""Peaks of the channels of a motion."""

import math

import numpy as np

from mechwright import Array, Scalar
from mechwright.mechanics.planar import BodyMotion
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import Loop, close
from mechwright_four_bar.masses import MICRO, MILLI, joint_forces, masses_of
from mechwright_four_bar.params import FourBarParams

PEAK_SAMPLES = 1441
"""Positions at which peaks are sought: four a degree."""


def speed_of(params: FourBarParams) -> float:
    """Angular velocity of the crank, rad/s, positive counter-clockwise."""
    return (1.0 if params.direction == "ccw" else -1.0) * params.speed * math.tau / 60


def peaks_of(params: FourBarParams, bar: FourBar, omega: float) -> dict[str, Scalar]:
    """Largest sizes over a turn of rates, joint forces and drive torque."""
    loop, bodies = turn(bar, omega)
    carried = joint_forces(bar, loop, bodies, masses_of(params), params.load_torque / MICRO)
    return {
        **rate_peaks(bodies),
        "drive_torque": most(carried.drive * MICRO, "N*m"),
        "shaking_force": most(np.asarray(np.abs(carried.shaking)) * MILLI, "N"),
        **{
            f"force_{joint}": most(np.asarray(np.abs(force)) * MILLI, "N")
            for joint, force in carried.joints.items()
        },
    }


def turn(bar: FourBar, omega: float) -> tuple[Loop, dict[str, BodyMotion]]:
    """The turn over which peaks are sought."""
    loop = close(bar, np.linspace(0, math.tau, PEAK_SAMPLES))
    return loop, loop.bodies(bar, omega)


def rate_peaks(bodies: dict[str, BodyMotion]) -> dict[str, Scalar]:
    """Largest sizes of the follower's angular velocity and acceleration."""
    turning = bodies["follower"].turning
    return {"omega_b": most(turning.omega, "rad/s"), "alpha_b": most(turning.alpha, "rad/s^2")}


def most(values: Array, unit: str) -> Scalar:
    """The largest size among values, in their unit."""
    return Scalar(float(np.abs(values).max()), unit)
