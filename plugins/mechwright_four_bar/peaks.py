"""Peaks of the channels of a motion."""

import math

import numpy as np

from mechwright.contracts.motion import Scalar
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.masses import MICRO, MILLI, joint_forces, masses_of
from mechwright_four_bar.motion import _most, _rate_peaks, _turn
from mechwright_four_bar.params import FourBarParams

PEAK_SAMPLES = 1441
"""Positions at which peaks are sought: four a degree."""


def speed_of(params: FourBarParams) -> float:
    """Angular velocity of the crank, rad/s, positive counter-clockwise."""
    return (1.0 if params.direction == "ccw" else -1.0) * params.speed * math.tau / 60


def peaks_of(params: FourBarParams, bar: FourBar, omega: float) -> dict[str, Scalar]:
    """Largest sizes over a turn of rates, joint forces and drive torque."""
    loop, bodies = _turn(bar, omega)
    carried = joint_forces(bar, loop, bodies, masses_of(params), params.load_torque / MICRO)
    return {
        **_rate_peaks(bodies),
        "drive_torque": _most(carried.drive * MICRO, "N*m"),
        "shaking_force": _most(np.asarray(np.abs(carried.shaking)) * MILLI, "N"),
        **{
            f"force_{joint}": _most(np.asarray(np.abs(force)) * MILLI, "N")
            for joint, force in carried.joints.items()
        },
    }
