"""The motion of a design: channels, poses and figures over one turn of the crank."""

import math
from dataclasses import replace

import numpy as np

from mechwright import Channel, KinematicsError, Motion, Scalar, Stage, Trace
from mechwright.contracts.finding import errors
from mechwright.mechanics.linkage import moving_figures
from mechwright.mechanics.planar import acceleration_pole
from mechwright.mechanics.planar.channels import point_channels, pole_channels, turning_channels
from mechwright_four_bar.checks import findings
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.masses import MICRO, MILLI, force_balance, joint_forces, masses_of
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.peaks import peaks_of, rate_peaks, speed_of, turn
from mechwright_four_bar.plates import bar_of, crank_angles, frames_of, held_by, pivot_of


def motion_of(params: FourBarParams, samples: int) -> Motion:
    """Sample one turn of the crank at constant speed, both ends included.

    Forces and masses are those of the real parts, and left out where ``check`` finds that there can be none.

    Raises
    ------
    KinematicsError
        ``check`` finds an error of the motion; the message is that of the first one.
    """
    found = findings(params)
    for finding in errors(found, Stage.MOTION):
        raise KinematicsError(f"{finding.parameter}: {finding.message}; {finding.remedy}")
    bar, omega = bar_of(params), speed_of(params)
    phi = crank_angles(params, samples)
    loop = close(bar, phi)
    bodies = loop.bodies(bar, omega)
    channels = {
        "phi": Channel(phi, "rad"),
        "time": Channel(phi / omega, "s"),
        "omega_a": Channel(np.full(samples, omega), "rad/s"),
    }
    for name, angle, suffix in (("coupler", "sigma", "_c"), ("follower", "psi", "_b")):
        channels |= turning_channels(bodies[name].turning, angle, suffix)
    cosine = (loop.coupler.direction * np.conj(loop.follower.direction)).real
    channels["transmission_angle"] = Channel(np.arccos(np.minimum(1.0, np.abs(cosine))), "rad")
    pivot = pivot_of(params)
    point = params.coupler_point
    if point is not None:
        moving = bodies["coupler"].point(point)
        channels |= point_channels("P", replace(moving, position=moving.position + pivot))
    channels |= pole_channels(acceleration_pole(bodies["coupler"]), pivot)
    figures = _figures(bar)
    if not errors(found):
        masses = masses_of(params)
        carried = joint_forces(bar, loop, bodies, masses, params.load_torque / MICRO)
        for joint, force in carried.joints.items():
            channels[f"force_{joint}"] = Channel(np.abs(force) * MILLI, "N")
        channels["shaking_force"] = Channel(np.abs(carried.shaking) * MILLI, "N")
        channels["drive_torque"] = Channel(carried.drive * MICRO, "N*m")
        figures |= {f"{name}_max": value for name, value in peaks_of(params, bar, omega).items()}
        figures |= moving_figures(masses, force_balance(bar, masses))
    else:
        figures |= {f"{name}_max": value for name, value in rate_peaks(turn(bar, omega)[1]).items()}
    traces = {} if point is None else {"P": Trace("coupler", (point.real, point.imag, 0.0))}
    return Motion("phi", channels, frames_of(params, bodies), figures, traces, held_by(params))


def _figures(bar: FourBar) -> dict[str, Scalar]:
    figures = {
        "least_transmission_angle": Scalar(bar.least_transmission_angle(), "rad"),
        "greatest_transmission_angle": Scalar(bar.greatest_transmission_angle(), "rad"),
        "grashof_excess": Scalar(bar.grashof_excess, "mm"),
    }
    limits = bar.limits()
    if limits is not None:
        figures |= {
            "swing": Scalar(limits.swing, "rad"),
            "time_ratio": Scalar(limits.time_ratio, ""),
            "limit_extended": Scalar((limits.extended + bar.ground_angle) % math.tau, "rad"),
            "limit_folded": Scalar((limits.folded + bar.ground_angle) % math.tau, "rad"),
        }
    return figures
