"""One period of a design, and the peaks of its channels."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from mechwright import Array, Scalar, kept
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_five_bar.loop import Loop, close
from mechwright_five_bar.masses import MILLI, Carried, carried_of, masses_of, wheel_force
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.reach import bar_of, course_of

ROUGH_SAMPLES = 181
"""Positions per turn for those who judge hundreds of designs."""

SPARE = 1.003
"""Times what is seen of a peak between positions: a design that bears so much bears the real one."""

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
        samples = samples_of(params, PEAK_SAMPLES)
    time, drive = course.period(samples, params.speed * math.tau / 60)
    return driven_by(params, drive, time)


def samples_of(params: FiveBarParams, per_turn: int) -> int:
    """Positions of a period with so many a turn."""
    return math.ceil(per_turn * max(1.0, abs(course_of(params).travel) / math.tau))


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
    return _of_period(params, PEAK_SAMPLES)


@kept
def roughly_loaded(params: FiveBarParams) -> Loads:
    """The same from fewer positions, a parabola through the three at the top of each peak."""
    return _of_period(params, ROUGH_SAMPLES, between=True)


def _of_period(params: FiveBarParams, per_turn: int, *, between: bool = False) -> Loads:
    top, period = partial(most, between=between), period_of(params, samples_of(params, per_turn))
    found = carried(params, period)
    peaks = {
        **rate_peaks(period.bodies),
        "drive_torque": top(found.drive, "N*m"),
        "arm_torque": top(found.arm_torque, "N*m"),
        "tooth_force": top(wheel_force(params, found.arm_torque), "N"),
        "shaking_force": top(np.abs(found.forces.shaking) * MILLI, "N"),
        **{f"force_{name}": top(found.joint(name), "N") for name in JOINTS},
    }
    return Loads(peaks, float(found.arm_torque.min()) < 0 < float(found.arm_torque.max()))


def rate_peaks(bodies: dict[str, BodyMotion]) -> dict[str, Scalar]:
    """Largest sizes of the coupler's angular velocity and acceleration."""
    turning = bodies["coupler"].turning
    return {"omega_c": most(turning.omega, "rad/s"), "alpha_c": most(turning.alpha, "rad/s^2")}


def most(values: Array, unit: str, *, between: bool = False) -> Scalar:
    """The largest size among values, in their unit; with ``between`` also between three neighbours of it."""
    sizes = np.abs(values)
    at = int(sizes.argmax())
    top = float(sizes[at])
    if between and 0 < at < sizes.size - 1:
        before, after = float(sizes[at - 1]), float(sizes[at + 1])
        bend = 2 * top - before - after
        top = SPARE * (top + ((after - before) ** 2 / (8 * bend) if bend > 0 else 0.0))
    return Scalar(top, unit)
