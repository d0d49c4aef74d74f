"""Channels of a motion: the input, links, slides, traced points, transmission angle, acceleration poles."""

from collections.abc import Mapping

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Channel
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.channels import RATES, along, point_channels, turning_channels
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Machine, Prismatic
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.relative_motion import relative, relative_pole
from mechwright.mechanics.planar.rigid import Turning

PHI, STROKE = "phi", "stroke"
"""Names of the input: the angle of a driver that turns, the way of one that slides."""


def input_channels(table: AnyPlanarTable, drive: Turning, time: Array) -> dict[str, Channel]:
    """The input and its rates, and time."""
    time_channel = {"time": Channel(time, "s", "time")}
    if not table.driver_slides:
        return {
            PHI: Channel(drive.theta, "rad", "angle of the driver"),
            **time_channel,
            "omega_in": Channel(drive.omega, "rad/s", "angular velocity of the driver"),
            "alpha_in": Channel(drive.alpha, "rad/s^2", "angular acceleration of the driver"),
        }
    return {
        STROKE: Channel(drive.theta, "mm", "way of the driver"),
        **time_channel,
        "v_in": Channel(drive.omega, "mm/s", "velocity of the driver"),
        "a_in": Channel(drive.alpha, "mm/s^2", "acceleration of the driver"),
    }


def solution_channels(table: AnyPlanarTable, found: Solution) -> dict[str, Channel]:
    """What links, slides and points do."""
    channels: dict[str, Channel] = {}
    machine, linkage = table.machine, table.linkage
    for link in turning_links(machine):
        turning = found.bodies[link].turning
        channels |= turning_channels(turning, f"theta_{link}", f"_{link}", f"the {link}")
    for joint in machine.joints:
        if isinstance(joint, Prismatic):
            channels |= _slide_channels(joint, found)
    for name, (link, point) in linkage.traces.items():
        channels |= point_channels(name, found.bodies[link].point(linkage.points[link][point]))
    channels["transmission_angle"] = Channel(transmission_angle(found), "rad", "least transmission angle")
    for one, two in table.pole_pairs:
        channels |= _pole_channels(found, one, two)
    return channels


def turning_links(machine: Machine) -> tuple[str, ...]:
    """The links that can turn: others hang on the ground by slides alone."""
    still = {GROUND}
    slides = [joint for joint in machine.joints if isinstance(joint, Prismatic)]
    for _ in slides:
        still |= {link for slide in slides if still & set(slide.links) for link in slide.links}
    return tuple(link for link in machine.links if link not in still)


def transmission_angle(found: Solution) -> Array:
    """The least transmission angle of all groups (..., n), rad, 0 to π/2; π/2 where there are none."""
    sines = list(found.sines.values())
    if not sines:
        return np.full(next(iter(found.bodies.values())).turning.theta.shape, np.pi / 2)
    return np.asarray(np.arcsin(np.minimum(np.minimum.reduce(np.broadcast_arrays(*sines)), 1.0)))


def _slide_channels(joint: Prismatic, found: Solution) -> Mapping[str, Channel]:
    seen = relative(found.bodies[joint.block], found.bodies[joint.guide]).point(joint.point)
    turn = np.exp(-1j * np.asarray(joint.line_angle))
    values = (seen.position - joint.line, seen.velocity, seen.acceleration, seen.jerk)
    return {
        f"{letter}_{joint.name}": Channel(np.asarray((value * turn).real), unit, label)
        for letter, value, unit, label in zip(
            "svaj",
            values,
            ("mm", "mm/s", "mm/s^2", "mm/s^3"),
            (f"way along {joint.name}", *(f"{word} along {joint.name}" for word in RATES)),
            strict=True,
        )
    }


def _pole_channels(found: Solution, one: str, two: str) -> dict[str, Channel]:
    """The pole on the ground and in the first link; none where the links only shift at some time."""
    pole, ground = relative_pole(found.bodies[one], found.bodies[two])
    if not (np.isfinite(ground).all() and np.isfinite(pole.moving).all()):
        return {}
    suffix = f"_{one}" if two == GROUND else f"_{one}_{two}"
    seen = "" if two == GROUND else f" as seen from the {two}"
    what = f"the acceleration pole of the {one}{seen}"
    return {
        f"xG{suffix}": Channel(ground.real, "mm", along("x", "", what)),
        f"yG{suffix}": Channel(ground.imag, "mm", along("y", "", what)),
        f"xG{suffix}_in_{one}": Channel(pole.moving.real, "mm", f"{along('x', '', what)} in the {one}"),
        f"yG{suffix}_in_{one}": Channel(pole.moving.imag, "mm", f"{along('y', '', what)} in the {one}"),
    }
