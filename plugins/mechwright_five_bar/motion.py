"""The motion of a design: channels, poses and figures over one period of the crank."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mechwright import Channel, Finding, KinematicsError, Load, Motion, Scalar, Stage, Trace
from mechwright.contracts.finding import errors, refuse
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.planar.channels import point_channels, rate_channels, turning_channels
from mechwright_five_bar.checks import findings
from mechwright_five_bar.frames import frames_of, held_by, pivot_of
from mechwright_five_bar.masses import MILLI, masses_of
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import JOINTS, Period, carried, peaks_of, period_of, rate_peaks
from mechwright_five_bar.reach import bar_of, course_of, is_lever, transmission_of


def motion_of(params: FiveBarParams, samples: Samples) -> Motion:
    """Sample the turns of the crank that bring the linkage back, or one swing there and back, ends included.

    Forces and masses are those of the real parts, and left out where ``check`` finds that there can be none.

    Raises
    ------
    KinematicsError
        ``check`` finds an error of the motion; the message is that of the first one.
    """
    check_moves(params)
    return motion_over(params, period_of(params, samples), varies=is_lever(params))


def check_moves(params: FiveBarParams) -> Sequence[Finding]:
    """What is found of a design that moves; raises as :func:`motion_of`."""
    found = findings(params)
    refuse(found, Stage.MOTION, KinematicsError)
    return found


def motion_over(params: FiveBarParams, period: Period, *, varies: bool = True) -> Motion:
    """The motion over samples of the crank; ``varies``: its speed is not constant."""
    found = check_moves(params)
    drive, bodies, loop = period.drive, period.bodies, period.loop
    channels = {
        "theta": Channel(drive.theta, "rad", "angle of the crank"),
        "time": Channel(period.time, "s", "time"),
    }
    driven = rate_channels(drive, "_a", "the crank")
    channels |= driven if varies else {"omega_a": driven["omega_a"]}
    for name, angle, suffix in (("coupler", "sigma", "_c"), ("rocker", "psi", "_r"), ("arm", "phi", "_b")):
        channels |= turning_channels(bodies[name].turning, angle, suffix, f"the {name}")
    cosine = (loop.coupler.direction * np.conj(loop.rocker.direction)).real
    channels["transmission_angle"] = Channel(
        np.arccos(np.minimum(1.0, np.abs(cosine))), "rad", "transmission angle"
    )
    point = params.coupler_point
    moving = bodies["coupler"].point(point)
    channels |= point_channels("P", replace(moving, position=moving.position + pivot_of(params)))
    figures = _figures(params)
    if not errors(found):
        forces = carried(params, period)
        for name in JOINTS:
            channels[f"force_{name}"] = Channel(forces.joint(name), "N", f"force in joint {name}")
        channels["shaking_force"] = Channel(
            np.asarray(np.abs(forces.forces.shaking)) * MILLI, "N", "force on the ground"
        )
        channels["arm_torque"] = Channel(forces.arm_torque, "N*m", "torque on the arm")
        channels["drive_torque"] = Channel(forces.drive, "N*m", "torque of the drive")
        figures |= {f"{name}_max": value for name, value in peaks_of(params).items()}
        figures |= {f"mass_{name}": Scalar(mass.mass, "kg") for name, mass in masses_of(params).items()}
    else:
        figures |= {f"{name}_max": value for name, value in rate_peaks(period_of(params).bodies).items()}
    trace = Trace("coupler", (point.real, point.imag, 0.0))
    force = (params.load_x, params.load_y, 0.0)
    loads = {"load": Load("coupler", force=force, point=trace.point)}
    frames, held = frames_of(params, bodies), held_by(params)
    return Motion("theta", channels, frames, figures, {"P": trace}, held, loads=loads)


def _figures(params: FiveBarParams) -> dict[str, Scalar]:
    least, greatest = transmission_of(params)
    figures = {
        "least_transmission_angle": Scalar(least, "rad"),
        "greatest_transmission_angle": Scalar(greatest, "rad"),
        "ratio": Scalar(params.ratio, ""),
    }
    if is_lever(params):
        course = course_of(params)
        ends = sorted((course.start, course.start + course.travel))
        figures |= {
            "swing_from": Scalar(math.degrees(ends[0]), "deg"),
            "swing_to": Scalar(math.degrees(ends[1]), "deg"),
        }
    else:
        figures["turns"] = Scalar(float(bar_of(params).turns), "")
    return figures
