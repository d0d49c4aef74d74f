"""One period of a design, and the peaks of its channels."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Scalar, kept
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_five_bar.loop import Loop, close
from mechwright_five_bar.masses import MILLI, Carried, carried_of, masses_of, wheel_force
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.reach import bar_of, course_of

JOINTS = ("A0", "A", "C", "B1", "B0")


@dataclass(frozen=True)
class Period:
    """One period of the crank: times (n,), s, the crank, the links, and their motion over time."""

    time: Array
    drive: Turning
    loop: Loop
    bodies: dict[str, BodyMotion]


def period_of(params: FiveBarParams, samples: Samples | None = None) -> Period:
    """The period of a design whose links can be joined; by default as fine as peaks are sought."""
    course = course_of(params)
    if samples is None:
        samples = math.ceil(PEAK_SAMPLES * max(1.0, abs(course.travel) / math.tau))
    time, drive = course.period(samples, params.speed * math.tau / 60)
    return driven_by(params, drive, time)


def driven_by(params: FiveBarParams, drive: Turning, time: Array) -> Period:
    """The links for any motion of the crank, at times (n,), s."""
    bar = bar_of(params)
    loop = close(bar, drive.theta)
    return Period(time, drive, loop, loop.bodies(bar, drive))


def carried(params: FiveBarParams, period: Period) -> Carried:
    """Forces of a period; the parts can be made."""
    return carried_of(params, bar_of(params), period.loop, period.bodies, masses_of(params))


@dataclass(frozen=True)
class Loads:
    """The largest sizes over a period, and whether the torque on the arm ``reverses`` its sign."""

    peaks: Mapping[str, Scalar]
    reverses: bool


def peaks_of(params: FiveBarParams) -> Mapping[str, Scalar]:
    """Largest sizes over a period of rates, joint forces and torques."""
    return loads_of(params).peaks


@kept
def loads_of(params: FiveBarParams) -> Loads:
    """Forces of a period as far as checks ask for them; the parts can be made."""
    period = period_of(params)
    found = carried(params, period)
    peaks = {
        **rate_peaks(period.bodies),
        "drive_torque": most(found.drive, "N*m"),
        "arm_torque": most(found.arm_torque, "N*m"),
        "tooth_force": most(wheel_force(params, found.arm_torque), "N"),
        "shaking_force": most(np.abs(found.forces.shaking) * MILLI, "N"),
        **{f"force_{name}": most(found.joint(name), "N") for name in JOINTS},
    }
    return Loads(peaks, float(found.arm_torque.min()) < 0 < float(found.arm_torque.max()))


def rate_peaks(bodies: dict[str, BodyMotion]) -> dict[str, Scalar]:
    """Largest sizes of the coupler's angular velocity and acceleration."""
    turning = bodies["coupler"].turning
    return {"omega_c": most(turning.omega, "rad/s"), "alpha_c": most(turning.alpha, "rad/s^2")}


def most(values: Array, unit: str) -> Scalar:
    """The largest size among values, in their unit."""
    return Scalar(float(np.abs(values).max()), unit)
