"""The motion of a design: channels, poses and figures over one period of the crank."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mechwright import Channel, Finding, KinematicsError, Load, Motion, Scalar, Stage, Trace
from mechwright.contracts.finding import errors, refuse
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.linkage import moving_figures
from mechwright.mechanics.planar import acceleration_pole
from mechwright.mechanics.planar.channels import (
    point_channels,
    pole_channels,
    rate_channels,
    turning_channels,
)
from mechwright_four_bar.checks import findings
from mechwright_four_bar.kinematics.reach import bar_of, course_of, is_lever, toggles, transmission_of
from mechwright_four_bar.masses import MICRO, MILLI, force_balance, joint_forces, masses_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.plates import frames_of, held_by, pivot_of
from mechwright_four_bar.peaks import Period, peaks_of, period_of, rate_peaks


def motion_of(params: FourBarParams, samples: Samples) -> Motion:
    """Sample one turn of the crank, or one swing there and back, both ends included.

    At a change point the linkage goes smoothly on, and a period may be two turns.

    Forces and masses are those of the real parts, and left out where ``check`` finds that there can be none.

    Raises
    ------
    KinematicsError
        ``check`` finds an error of the motion; the message is that of the first one.
    """
    check_moves(params)
    varies = is_lever(params) or bool(params.acceleration_ratio)
    return motion_over(params, period_of(params, samples), varies=varies)


def check_moves(params: FourBarParams) -> Sequence[Finding]:
    """What ``check`` finds; raises KinematicsError where there is an error of the motion."""
    found = findings(params)
    refuse(found, Stage.MOTION, KinematicsError)
    return found


def motion_over(params: FourBarParams, period: Period, *, varies: bool = True) -> Motion:
    """The motion over samples of the crank; ``varies``: its speed is not constant."""
    found, bar = check_moves(params), bar_of(params)
    loop, bodies, drive = period.loop, period.bodies, period.drive
    channels = {
        "phi": Channel(drive.theta, "rad", "angle of the crank"),
        "time": Channel(period.time, "s", "time"),
    }
    driven = rate_channels(drive, "_a", "the crank")
    channels |= driven if varies else {"omega_a": driven["omega_a"]}
    for name, angle, suffix in (("coupler", "sigma", "_c"), ("follower", "psi", "_b")):
        channels |= turning_channels(bodies[name].turning, angle, suffix, f"the {name}")
    cosine = (loop.coupler.direction * np.conj(loop.follower.direction)).real
    channels["transmission_angle"] = Channel(
        np.arccos(np.minimum(1.0, np.abs(cosine))), "rad", "transmission angle"
    )
    pivot = pivot_of(params)
    point = params.coupler_point
    if point is not None:
        moving = bodies["coupler"].point(point)
        channels |= point_channels("P", replace(moving, position=moving.position + pivot))
    channels |= pole_channels(acceleration_pole(bodies["coupler"]), pivot)
    figures = _figures(params)
    if not errors(found):
        masses = masses_of(params)
        carried = joint_forces(bar, loop, bodies, masses, params.load_torque / MICRO)
        for joint, force in carried.joints.items():
            channels[f"force_{joint}"] = Channel(np.abs(force) * MILLI, "N", f"force in joint {joint}")
        channels["shaking_force"] = Channel(np.abs(carried.shaking) * MILLI, "N", "force on the ground")
        channels["drive_torque"] = Channel(carried.drive * MICRO, "N*m", "torque of the drive")
        figures |= {f"{name}_max": value for name, value in peaks_of(params).items()}
        figures |= moving_figures(masses, force_balance(bar, masses))
    else:
        figures |= {f"{name}_max": value for name, value in rate_peaks(period_of(params).bodies).items()}
    traces = {} if point is None else {"P": Trace("coupler", (point.real, point.imag, 0.0))}
    frames, held = frames_of(params, bodies), held_by(params)
    loads = {"load_torque": Load("follower", torque=(0.0, 0.0, params.load_torque))}
    return Motion("phi", channels, frames, figures, traces, held, loads=loads)


def _figures(params: FourBarParams) -> dict[str, Scalar]:
    bar = bar_of(params)
    least, greatest = transmission_of(params)
    figures = {
        "least_transmission_angle": Scalar(least, "rad"),
        "greatest_transmission_angle": Scalar(greatest, "rad"),
        "grashof_excess": Scalar(bar.grashof_excess, "mm"),
    }
    if is_lever(params):
        return figures | _lever(params)
    limits = bar.limits()
    if limits is not None:
        counted = course_of(params).counted
        figures |= {
            "swing": Scalar(limits.swing, "rad"),
            "time_ratio": Scalar(limits.time_ratio, ""),
            "limit_extended": Scalar(float(counted(limits.extended + bar.ground_angle)), "rad"),
            "limit_folded": Scalar(float(counted(limits.folded + bar.ground_angle)), "rad"),
        }
    return figures


def _lever(params: FourBarParams) -> dict[str, Scalar]:
    """Where a lever turns back, and the toggles that it stays away from: crank angles from X, in degrees."""
    course, follower = course_of(params), period_of(params).loop.follower.direction
    ends = sorted((course.start, course.start + course.travel))
    angles = {"swing_from": ends[0], "swing_to": ends[1], "input_range": ends[1] - ends[0]}
    if (found := toggles(params)) is not None:
        angles |= {"toggle_low": found[0], "toggle_high": found[1]}
    swing = float(np.ptp(np.unwrap(np.angle(follower))))
    return {
        **{name: Scalar(math.degrees(value), "deg") for name, value in angles.items()},
        "swing": Scalar(swing, "rad"),
    }
