"""Forces and torques of a five-bar, and their peaks over a period of the crank."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mechwright import Array, Scalar
from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.linkage.kinematics.forces import MILLI, carried
from mechwright.mechanics.linkage.kinematics.period import period_of
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar import BodyMotion
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.planar.positions import Solution
from mechwright_five_bar.parts.bodies import masses_of
from mechwright_five_bar.table import FiveBarTable

JOINTS = ("A0", "A", "C", "B1", "B0")
"""Forces of the teeth on the shafts are not among theirs."""

FORCES = {
    **{f"force_{name}": ("N", f"force in joint {name}") for name in JOINTS},
    "shaking_force": ("N", "force on the ground"),
    "arm_torque": ("N*m", "torque on the arm"),
    "drive_torque": ("N*m", "torque of the drive"),
}
"""Unit and label of what :func:`forces_of` gives."""


def forces_of(m: FiveBarTable, motion: Solution, masses: Mapping[str, Mass]) -> dict[str, Array]:
    """What joints, gears and drive carry (n,); the idler turns with the crank, and adds to its inertia."""
    given = dict(masses)
    if "idler" in given:
        added = m.train.ratio("idler") ** 2 * given["idler"].inertia
        given["crank"] = replace(given["crank"], inertia=given["crank"].inertia + added)
    found: Forces = carried(m, motion, given)
    return {
        **{f"force_{name}": np.abs(found.joints[name]) for name in JOINTS},
        "shaking_force": np.abs(found.shaking),
        "arm_torque": found.gears["gears"] * MILLI,
        "drive_torque": found.drive * MILLI,
    }


@dataclass(frozen=True)
class Loads:
    """The largest sizes over a period, and whether the torque on the arm ``reverses`` its sign."""

    peaks: Mapping[str, Scalar]
    reverses: bool


def peak_samples(m: FiveBarTable) -> Any:
    """Positions of a period among which peaks are sought: a whole number or a column."""
    return np.ceil(PEAK_SAMPLES * np.maximum(1.0, np.abs(m.closed_ways.travel) / math.tau)).astype(int)


def loads_of(m: FiveBarTable) -> Loads:
    """Forces of a period of a design whose parts can be made."""
    return m.once("loads", lambda: _loads(m))


def _loads(m: FiveBarTable) -> Loads:
    motion = period_of(m, int(peak_samples(m))).solution
    found = forces_of(m, motion, masses_of(m))
    torque = found["arm_torque"]
    peaks = {
        **rate_peaks(motion.bodies),
        "drive_torque": _peak(found["drive_torque"], "N*m"),
        "arm_torque": _peak(torque, "N*m"),
        "tooth_force": _peak(torque / (m.train.radius("wheel") * MILLI), "N"),
        "shaking_force": _peak(found["shaking_force"], "N"),
        **{f"force_{name}": _peak(found[f"force_{name}"], "N") for name in JOINTS},
    }
    return Loads(peaks, float(torque.min()) < 0 < float(torque.max()))


def rate_peaks(bodies: Mapping[str, BodyMotion]) -> dict[str, Scalar]:
    """Largest sizes of the coupler's angular velocity and acceleration."""
    turning = bodies["coupler"].turning
    return {"omega_c": _peak(turning.omega, "rad/s"), "alpha_c": _peak(turning.alpha, "rad/s^2")}


def _peak(values: Array, unit: str) -> Scalar:
    return Scalar(float(np.abs(values).max()), unit)
