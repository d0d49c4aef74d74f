"""The motion of a design: channels, poses and figures over one period of the crank."""

from collections.abc import Mapping

import numpy as np

from mechwright import Channel, KinematicsError, Load, Motion, Scalar, Stage, Trace
from mechwright.contracts.figure import scalars
from mechwright.contracts.finding import Finding, errors, refuse
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.linkage import Mass, moving_figures
from mechwright.mechanics.linkage.kinematics.forces import MILLI, force_channels, period_forces
from mechwright.mechanics.linkage.kinematics.period import Period, period_of
from mechwright.mechanics.linkage.parts.frames import frames_of, joints_of
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar import BodyMotion, Turning, acceleration_pole
from mechwright.mechanics.planar.channels import (
    point_channels,
    pole_channels,
    rate_channels,
    turning_channels,
)
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.figures import figures_of
from mechwright_four_bar.parts.layout import layout_or_bare
from mechwright_four_bar.rules.rule_table import findings_of
from mechwright_four_bar.table import FourBarTable


def motion_of(table: FourBarTable, samples: Samples) -> Motion:
    """Sample one turn of the crank, or one swing there and back, both ends included.

    At a change point the linkage goes smoothly on, and a period may be two turns.

    Forces and masses are those of the real parts, and left out where ``check`` finds that there can be none.

    Raises
    ------
    KinematicsError
        ``check`` finds an error of the motion; the message is that of the first one.
    """
    check_moves(table)
    varies = bool(table.lever) or bool(table.params.acceleration_ratio)
    return motion_over(table, period_of(table, samples), varies=varies)


def check_moves(table: FourBarTable) -> list[Finding]:
    """What the rules find; raises KinematicsError where there is an error of the motion."""
    found = findings_of(table, quick=True)
    refuse(found, Stage.MOTION, KinematicsError)
    return found


def motion_over(table: FourBarTable, period: Period, *, varies: bool = True) -> Motion:
    """The motion over samples of the crank; ``varies``: its speed is not constant."""
    found, bodies, drive = check_moves(table), period.solution.bodies, period.drive
    channels = {
        "phi": Channel(drive.theta, "rad", "angle of the crank"),
        "time": Channel(period.time, "s", "time"),
    }
    driven = rate_channels(drive, "_a", "the crank")
    channels |= driven if varies else {"omega_a": driven["omega_a"]}
    for name, angle, suffix in (("coupler", "sigma", "_c"), ("follower", "psi", "_b")):
        channels |= turning_channels(bodies[name].turning, angle, suffix, f"the {name}")
    cosine = np.cos(bodies["coupler"].turning.theta - bodies["follower"].turning.theta)
    channels["transmission_angle"] = Channel(
        np.arccos(np.minimum(1.0, np.abs(cosine))), "rad", "transmission angle"
    )
    point = table.params.coupler_point
    if point is not None:
        channels |= point_channels("P", bodies["coupler"].point(point))
    channels |= pole_channels(acceleration_pole(bodies["coupler"]))
    figures = scalars(figures_of(table)) | _rate_peaks(table)
    if not errors(found):
        masses = table.masses
        channels |= force_channels(table, period.solution, masses)
        figures |= _force_peaks(table)
        figures |= moving_figures(masses, force_balance(table.bar, masses))
    traces = {} if point is None else {"P": Trace("coupler", (point.real, point.imag, 0.0))}
    layout = layout_or_bare(table)
    still = Turning.of(np.full_like(drive.theta, table.bar.ground_angle))
    ground = BodyMotion.about(complex(table.pivot), still)
    loads = {"load_torque": Load("follower", torque=(0.0, 0.0, table.params.load_torque))}
    frames = frames_of(layout, {**bodies, GROUND: ground})
    return Motion("phi", channels, frames, figures, traces, joints_of(layout), loads=loads)


def _rate_peaks(table: FourBarTable) -> dict[str, Scalar]:
    """Largest sizes of the follower's angular velocity and acceleration over a period."""
    turning = period_of(table, PEAK_SAMPLES).solution.bodies["follower"].turning
    return {"omega_b_max": _most(turning.omega, "rad/s"), "alpha_b_max": _most(turning.alpha, "rad/s^2")}


def _force_peaks(table: FourBarTable) -> dict[str, Scalar]:
    """Those of joint forces and drive torque."""
    _, forces = period_forces(table)
    found = {"drive_torque": _most(forces.drive * MILLI, "N*m"), "shaking_force": _most(forces.shaking, "N")}
    found |= {f"force_{joint}": _most(force, "N") for joint, force in forces.joints.items()}
    return {f"{name}_max": value for name, value in found.items()}


def _most(values: np.ndarray, unit: str) -> Scalar:
    return Scalar(float(np.abs(values).max()), unit)


def force_balance(bar: FourBar, masses: Mapping[str, Mass]) -> dict[str, complex]:
    """Counterweights on crank and follower for full force balance at any speed (Berkof and Lowen 1969).

    What is to be added to each is mass times place in its own frame, kg mm, x + i y.

    The common centre of mass rests where m2 r2 = -m3 a (1 - r3/c) and m4 r4 = -m3 r3 b/c, with r3 the centre
    of the coupler from A, along A-B and across.
    """
    crank, coupler, follower = masses["crank"], masses["coupler"], masses["follower"]
    share = coupler.centre / bar.coupler
    return {
        "crank": -coupler.mass * bar.crank * (1 - share) - crank.mass * crank.centre,
        "follower": -coupler.mass * bar.follower * share - follower.mass * follower.centre,
    }
