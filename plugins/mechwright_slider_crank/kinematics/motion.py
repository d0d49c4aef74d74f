"""The motion of a design: channels, poses and figures over one turn of the crank."""

import math

import numpy as np

from mechwright import Array, Channel, KinematicsError, Load, Motion, Stage, Trace
from mechwright.contracts.figure import scalars
from mechwright.contracts.finding import refuse
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.planar import Turning, acceleration_pole
from mechwright.mechanics.planar.channels import (
    point_channels,
    pole_channels,
    rate_channels,
    turning_channels,
)
from mechwright.mechanics.planar.dynamics import Forces
from mechwright_slider_crank.kinematics.course import course_of, drive_at, is_lever
from mechwright_slider_crank.kinematics.figures import figures
from mechwright_slider_crank.kinematics.forces import MILLI, joint_forces
from mechwright_slider_crank.kinematics.limits import transmission_angle
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.kinematics.slider_crank import Bodies, SliderCrank
from mechwright_slider_crank.parts.masses import bodies_of
from mechwright_slider_crank.parts.plates import body_poses, held_by
from mechwright_slider_crank.rules.motion_rules import MOTION
from mechwright_slider_crank.rules.rule_table import buildable


def motion_of(table: Mechanism, samples: Samples) -> Motion:
    """Sample one turn of the crank, or a lever's swing there and back, both ends included.

    At its limit, c = a + |e|, the linkage goes smoothly through both assemblies, in two turns of the crank.

    Forces and masses are those of the real parts, and left out where ``check`` finds that there can be none.

    Raises
    ------
    KinematicsError
        The crank cannot turn.
    """
    course = course_of(moving(table))
    time, drive = course.period(samples, table.omega)
    return driven_by(table, drive, time, varies=course.rocks or bool(table.given.acceleration_ratio))


def moving(table: Mechanism) -> Mechanism:
    """The linkage of a design; raises KinematicsError where the rules find an error of the motion."""
    refuse(MOTION.findings(table), Stage.MOTION, KinematicsError)
    return table


def driven_by(table: Mechanism, drive: Turning, time: Array, *, varies: bool = True) -> Motion:
    """The motion for any motion of the crank, at times (n,), s; ``varies``: its speed is not constant."""
    params, linkage = moving(table).given, table.closed
    bodies = linkage.bodies(drive.theta, drive)
    channels = _channels(table, time, drive, bodies, varies=varies) | _poles(linkage, drive, bodies)
    if buildable(table):
        channels |= _forces(joint_forces(bodies, bodies_of(table), params.load))
    point = params.coupler_point
    traces = {"P": Trace("rod", (point.real, point.imag, 0.0))}
    x, y = params.load * math.cos(linkage.direction), params.load * math.sin(linkage.direction)
    loads = {"load": Load("slider", force=(x, y, 0.0))}
    poses, joints = body_poses(table, drive.theta), held_by(params)
    return Motion("phi", channels, poses, scalars(figures(table)), traces, joints, loads=loads)


def channels_over(table: Mechanism, samples: int) -> dict[str, Channel]:
    """The channels (n, samples) of a table, without poles and forces."""
    time, drive = drive_at(table, np.linspace(0.0, 1.0, samples))
    varies = np.asarray(is_lever(table)) | (np.asarray(table.given.acceleration_ratio) != 0)
    found = _channels(table, time, drive, table.closed.bodies(drive.theta, drive), varies=True)
    del found["phi"]  # the input has no extremes of its own
    for name in ("alpha_a", "jerk_a"):
        found[name] = Channel(np.where(varies, found[name].values, math.nan), found[name].unit)
    return found


def _channels(
    table: Mechanism, time: Array, drive: Turning, bodies: Bodies, *, varies: bool
) -> dict[str, Channel]:
    driven = rate_channels(drive, "_a", "the crank")
    s, v, a, jerk = bodies.along
    angle = transmission_angle(table.closed, drive.theta)
    return {
        "time": Channel(time, "s", "time"),
        "phi": Channel(drive.theta, "rad", "angle of the crank"),
        **(driven if varies else {"omega_a": driven["omega_a"]}),
        "s": Channel(s, "mm", "place of the slider"),
        "v": Channel(v, "mm/s", "velocity of the slider"),
        "a": Channel(a, "mm/s^2", "acceleration of the slider"),
        "jerk": Channel(jerk, "mm/s^3", "jerk of the slider"),
        **turning_channels(bodies.rod.turning, "sigma", "_c", "the rod"),
        "transmission_angle": Channel(angle, "rad", "transmission angle"),
        **point_channels("P", bodies.rod.point(table.given.coupler_point)),
    }


def _poles(linkage: SliderCrank, drive: Turning, bodies: Bodies) -> dict[str, Channel]:
    """The rod's acceleration pole on the ground and in the rod, for both assemblies."""
    other = SliderCrank(linkage.crank, linkage.rod, linkage.offset, linkage.direction, -linkage.branch)
    return pole_channels(acceleration_pole(bodies.rod)) | pole_channels(
        acceleration_pole(other.bodies(drive.theta, drive).rod),
        suffix="_other",
        what="the other assembly's acceleration pole",
    )


def _forces(carried: Forces) -> dict[str, Channel]:
    found = {
        f"force_{name.replace('-', '_')}": Channel(
            np.abs(force), "N", f"force in the {name.replace('-', ' ')}"
        )
        for name, force in carried.joints.items()
    }
    found["shaking_force"] = Channel(np.abs(carried.shaking), "N", "force on the ground")
    found["moment_guide"] = Channel(carried.moments["guide"] * MILLI, "N*m", "moment on the guide")
    found["drive_torque"] = Channel(carried.drive * MILLI, "N*m", "torque of the drive")
    return found
