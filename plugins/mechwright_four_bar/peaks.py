"""Peaks of the channels of a motion."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Scalar
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_four_bar.kinematics.change_point import close_through
from mechwright_four_bar.kinematics.loop import Loop, close
from mechwright_four_bar.kinematics.reach import bar_of, course_of
from mechwright_four_bar.masses import MICRO, MILLI, joint_forces, masses_of
from mechwright_four_bar.parameters import FourBarParams


@dataclass(frozen=True)
class Period:
    """One period of the crank: times (n,), s, the crank, the links, and their motion over time."""

    time: Array
    drive: Turning
    loop: Loop
    bodies: dict[str, BodyMotion]


def period_of(params: FourBarParams, samples: Samples = PEAK_SAMPLES) -> Period:
    """The period of a design whose links can be joined; by default as fine as peaks are sought."""
    time, drive = course_of(params).period(samples, params.speed * math.tau / 60)
    return driven_by(params, drive, time)


def driven_by(params: FourBarParams, drive: Turning, time: Array) -> Period:
    """The links for any motion of the crank, at times (n,), s."""
    bar, course = bar_of(params), course_of(params)
    if bar.lines_up and not course.rocks:
        loop = close_through(bar, drive.theta, course.travel)
    else:
        loop = close(bar, drive.theta)
    return Period(time, drive, loop, loop.bodies(bar, drive))


def peaks_of(params: FourBarParams) -> dict[str, Scalar]:
    """Largest sizes over a period of rates, joint forces and drive torque."""
    found = period_of(params)
    loop, bodies = found.loop, found.bodies
    carried = joint_forces(bar_of(params), loop, bodies, masses_of(params), params.load_torque / MICRO)
    return {
        **rate_peaks(bodies),
        "drive_torque": most(carried.drive * MICRO, "N*m"),
        "shaking_force": most(np.asarray(np.abs(carried.shaking)) * MILLI, "N"),
        **{
            f"force_{joint}": most(np.asarray(np.abs(force)) * MILLI, "N")
            for joint, force in carried.joints.items()
        },
    }


def rate_peaks(bodies: dict[str, BodyMotion]) -> dict[str, Scalar]:
    """Largest sizes of the follower's angular velocity and acceleration."""
    turning = bodies["follower"].turning
    return {"omega_b": most(turning.omega, "rad/s"), "alpha_b": most(turning.alpha, "rad/s^2")}


def most(values: Array, unit: str) -> Scalar:
    """The largest size among values, in their unit."""
    return Scalar(float(np.abs(values).max()), unit)
