"""The motion of a design: channels, poses and figures over the travel of the phase that is shown."""

import math
from dataclasses import replace

import numpy as np

from mechwright import Channel, KinematicsError, Motion, Poses, Scalar, Trace
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import RATES, along, turning_channels
from mechwright_spherical.kinematics.bodies import coupler_frame, pins_of_phase, poses, quaternions
from mechwright_spherical.kinematics.drive import train_of
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.jets import Jet, turning_about
from mechwright_spherical.kinematics.linkage import Linkage, Phase, linkage_of
from mechwright_spherical.kinematics.loop import State
from mechwright_spherical.kinematics.mobility import input_range, mobility
from mechwright_spherical.kinematics.vectors import norm
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.axis_parts import axis_joints, axis_poses
from mechwright_spherical.parts.frame import shells_of
from mechwright_spherical.parts.joints import held_by
from mechwright_spherical.parts.seats import clamped
from mechwright_spherical.parts.stand import base_pose

_RATES = ("", "/s", "/s^2", "/s^3")


def motion_of(params: SphericalParams, samples: Samples) -> Motion:
    """Sample the travel of the phase that is shown at constant input speed, both ends included.

    An input that is a lever goes there and back.

    Raises
    ------
    KinematicsError
        The linkage cannot be assembled all the way, or passes a dead centre.
    """
    linkage = linkage_of(params)
    phase = linkage.shown
    time, turning = phase.course.period(samples, params.speed * math.tau / 60)
    angles = turning.theta
    with np.errstate(over="ignore", invalid="ignore"):
        state = phase.loop.at(turning, 3)
    if not all(np.isfinite(rate).all() for rate in (*state.c, *state.p)):
        bad = angles[~np.isfinite(state.c[-1]).all(axis=0)]
        at = math.degrees(float(bad[0])) if bad.size else math.degrees(float(angles[0]))
        raise KinematicsError(
            f"the linkage cannot be assembled, or is in a dead centre, at the input angle {at:.4g}° of phase "
            f"{phase.number}; shorten the travel, or choose other arcs"
        )
    channels = {
        "time": Channel(time, "s", "time"),
        **turning_channels(turning, "theta", "", "the crank"),
        **_driven(linkage, phase, state, turning),
        "transmission_angle": Channel(state.transmission, "rad", "transmission angle"),
        **_point(state.p, params.radius),
        **_spin(linkage, phase, state),
    }
    train = train_of(linkage, params.drive)
    slotted = clamped(params)
    bodies = poses(linkage, phase, state, angles, train, slotted)
    position, rotation = base_pose(linkage, shells_of(params), params.stand)
    bodies["base"] = Poses(np.tile(position, (angles.size, 1)), np.tile(rotation, (angles.size, 1, 1)))
    bodies |= axis_poses(params, bodies)
    x, y, z = bodies["coupler"].rotation[0].T @ (params.radius * np.asarray(state.p[0])[:, 0])
    traces = {"P": Trace("coupler", (float(x), float(y), float(z)))}
    held = held_by(linkage, train, params.radius, slotted) | axis_joints(params)
    return Motion("theta", channels, bodies, _figures(params, linkage), traces, held)


def _driven(linkage: Linkage, phase: Phase, state: State, turning: Turning) -> dict[str, Channel]:
    four_bar = linkage.four_bar
    if four_bar is None:
        arm = turning.scaled(phase.loop.ratio)
        return turning_channels(arm, "phi", "_phi", "the arm")
    rates = turning_about(phase.loop.b0, state.c)
    angle = four_bar.output_angle(turning.theta)
    angle = angle - math.tau * np.round(angle[0] / math.tau)
    return turning_channels(replace(rates, theta=angle), "psi", "_psi", "the rocker")


def _point(p: Jet, radius: float) -> dict[str, Channel]:
    found: dict[str, Channel] = {}
    for name, word, unit, value in zip(("", "v", "a", "j"), ("", *RATES), _RATES, p, strict=True):
        found |= {
            f"{name}{axis}P": Channel(radius * x, f"mm{unit}", along(axis, word, "point P"))
            for axis, x in zip("xyz", value, strict=True)
        }
        if name:
            found[f"{name}P"] = Channel(radius * norm(value), f"mm{unit}", f"size of the {word} of point P")
    return found


def _spin(linkage: Linkage, phase: Phase, state: State) -> dict[str, Channel]:
    found: dict[str, Channel] = {}
    spins = state.coupler_spin
    for name, word, unit, value in zip(("omega", "alpha", "jerk"), RATES, _RATES[1:], spins, strict=True):
        found |= {
            f"{name}3{axis}": Channel(x, f"rad{unit}", along(axis, f"angular {word}", "the coupler"))
            for axis, x in zip("xyz", value, strict=True)
        }
    # From the coupler's place in the position of adjustment, or at the start.
    turn = np.einsum("ijn,kj->ikn", coupler_frame(linkage, phase, state), pins_of_phase(linkage, 1))
    for name, part in zip(("q0", "q1", "q2", "q3"), quaternions(turn), strict=True):
        found[name] = Channel(part, "", f"part {name[1]} of the quaternion of the coupler")
    return found


_FIGURE_SAMPLES = 721
"""Samples of the travel for figures that are extremes: 0.5° for a whole turn, second-order exact."""


def _figures(params: SphericalParams, linkage: Linkage) -> dict[str, Scalar]:
    found: dict[str, Scalar] = {}
    for phase in linkage.phases:
        mark = f"_{phase.mark}" if phase.mark else ""
        mu = phase.state(_FIGURE_SAMPLES).transmission
        found[f"transmission_min{mark}"] = Scalar(float(np.nanmin(mu)), "rad")
        found[f"transmission_max{mark}"] = Scalar(float(np.nanmax(mu)), "rad")
        if phase.target_angles.size:
            errors = params.radius * phase.path_errors
            errors = errors[np.isfinite(errors)]
        if phase.target_angles.size and errors.size:
            found[f"path_error_max{mark}"] = Scalar(float(errors.max()), "mm")
            found[f"path_error_rms{mark}"] = Scalar(float(np.sqrt(np.mean(errors**2))), "mm")
    if linkage.five_bar is not None:
        found |= _arcs(linkage)
    else:
        found |= _mobility(linkage.four_bar) | _lever(linkage)
    return found


def _arcs(linkage: Linkage) -> dict[str, Scalar]:
    mechanism = linkage.five_bar
    assert mechanism is not None  # noqa: S101 - the caller looked
    (r1, r1n), (r3, r3n) = mechanism.crank_arcs, mechanism.rocker_arcs
    values = {"R1": r1, "R1n": r1n, "R3": r3, "R3n": r3n}
    values |= {"crank_setting": mechanism.crank_setting, "rocker_setting": mechanism.rocker_setting}
    return {name: Scalar(float(value), "rad") for name, value in values.items()}


def _lever(linkage: Linkage) -> dict[str, Scalar]:
    """Where an input that is a lever turns back, and its dead centres: input angles, in degrees."""
    phase, four_bar = linkage.shown, linkage.four_bar
    if four_bar is None or not phase.rocks:
        return {}
    low, high = phase.start, phase.start + phase.travel
    middle = (low + high) / 2
    ways = input_range(*four_bar.arcs)
    if len(ways) == 2 and ways[0][0] == 0.0:  # one way through 0
        ways = ((-ways[0][1], ways[0][1]),)
    gaps = [(abs(math.remainder(middle - (a + b) / 2, math.tau)), (b - a) / 2) for a, b in ways]
    half = min(gaps)[1]
    angles = {
        "swing_from": low,
        "swing_to": high,
        "input_range": high - low,
        "toggle_low": middle - half,
        "toggle_high": middle + half,
    }
    return {name: Scalar(math.degrees(angle), "deg") for name, angle in angles.items()}


def _mobility(four_bar: FourBar | None) -> dict[str, Scalar]:
    assert four_bar is not None  # noqa: S101 - the caller looked
    t = mobility(*four_bar.arcs).t
    return {f"T{place}": Scalar(float(value), "rad") for place, value in enumerate(t, start=1)}
