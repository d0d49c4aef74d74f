"""How the input runs, and every body with it: frames and their rates over time.

How fast what is sampled changes: differences of eighth order, over the number of the sample.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import TIME, Motion, Poses
from mechwright.errors import DesignError

WIDTH = 9
"""Samples that a difference is taken of; among 1441 of a turn it is exact to 1e-9 of a 10th harmonic."""


def _weights() -> Array:
    """(WIDTH, 2, WIDTH): for each place in a window the weights of the first and second difference."""
    offsets = np.arange(WIDTH, dtype=float)
    found = np.empty((WIDTH, 2, WIDTH))
    for place in range(WIDTH):
        powers = (offsets - place)[None, :] ** np.arange(WIDTH)[:, None]
        wanted = np.zeros((WIDTH, 2))
        wanted[1, 0], wanted[2, 1] = 1.0, 2.0
        found[place] = np.linalg.solve(powers, wanted).T
    return found


_WEIGHTS = _weights()


def differences(values: Array) -> tuple[Array, Array]:
    """First and second differences (n, ...) of samples (n, ...), n at least 9.

    >>> one, two = differences(np.arange(12.0) ** 3)
    >>> [round(float(x), 6) for x in (one[0], one[5], two[11])]
    [0.0, 75.0, 66.0]
    """
    windows = np.lib.stride_tricks.sliding_window_view(values, WIDTH, axis=0)
    at = np.arange(len(values))
    first = np.clip(at - WIDTH // 2, 0, len(values) - WIDTH)
    both = np.einsum("nkw,n...w->kn...", _WEIGHTS[at - first], windows[first])
    return both[0], both[1]


@dataclass(frozen=True, eq=False)
class Timed:
    """Frames of a body with their first and second derivative over time, (n, 3, 4) each."""

    frames: Array
    first: Array
    second: Array


def over_time(values: Array, time: Array) -> tuple[Array, Array]:
    """Derivatives of samples (n, ...) over time (n,), s, whose steps may differ."""
    one, two = differences(values)
    shape = (-1, *[1] * (values.ndim - 1))
    pace, change = (each.reshape(shape) for each in differences(time))
    return one / pace, (two - one * change / pace) / pace**2


RESTING = 1e-9
"""Share of the greatest speed of the input below which it rests."""


@dataclass(frozen=True, eq=False)
class Course:
    """The input over its period, and the bodies.

    Parameters
    ----------
    angle, time, speed, acceleration
        Of the input (n,): rad, s, rad/s and rad/s², positive along the angle.
    bodies
        Those that have poses.
    rocks
        Whether the input goes there and back.
    """

    angle: Array
    time: Array
    speed: Array
    acceleration: Array
    bodies: Mapping[str, Timed]
    rocks: bool

    @property
    def rests(self) -> NDArray[np.bool_]:
        """Where the input stands still for a moment, (n,)."""
        return np.asarray(np.abs(self.speed) <= RESTING * np.abs(self.speed).max())

    def along(self, body: str) -> Array:
        """Frames' derivative (n, 3, 4) over the input's angle; where it rests, that of its starting."""
        one = self.bodies[body]
        speed, acceleration = self.speed[:, None, None], self.acceleration[:, None, None]
        rests = self.rests[:, None, None]
        moving = np.where(rests, 1.0, speed)
        starting = np.where(rests & (acceleration != 0), acceleration, 1.0)
        return np.where(rests, one.second / starting, one.first / moving)

    def turning(self, body: str) -> Array:
        """Turns (n, 3) of a body for one of the input, as a vector in the coordinates of the poses."""
        return turns_of(self.along(body)[:, :, :3], self.bodies[body].frames)


def course_of(motion: Motion, wanted: float | None) -> Course:
    """The course of a motion at the mean speed ``wanted``, rev/min, or as its channel of time has it.

    Raises
    ------
    DesignError
        The input is no angle, or the motion does not say how fast it runs.
    """
    channel = motion.channels[motion.input_name]
    if channel.unit != "rad":
        raise DesignError(
            f"machine: the input {motion.input_name} is in {channel.unit}, no angle, and nothing that turns "
            "drives it; leave the table out"
        )
    angle, time = channel.values, _time(motion, wanted)
    scale = 1.0
    if wanted is not None:
        turns = 1.0 if motion.rocks else abs(angle[-1] - angle[0]) / math.tau
        scale = wanted / 60 * (time[-1] - time[0]) / turns
        time = time / scale
    bodies = {body: _timed(poses, time, scale) for body, poses in motion.poses.items()}
    drive = next((one for one in motion.joints.values() if one.drives and one.kind == "revolute"), None)
    if drive is not None and motion.poses[drive.two].rates is not None:
        speed, acceleration = _shaft(drive, bodies)
    else:
        speed, acceleration = over_time(angle, time)
    return Course(angle, time, speed, acceleration, bodies, motion.rocks)


def _time(motion: Motion, wanted: float | None) -> Array:
    """The motion's time, s; that of a constant speed where it does not say."""
    if TIME in motion.channels:
        return motion.channels[TIME].values
    if wanted is None:
        raise DesignError("machine.speed: the motion does not say how fast it runs; give rev/min")
    angle = motion.channels[motion.input_name].values
    return np.asarray(np.abs(angle - angle[0]) / (wanted * math.tau / 60))


def _timed(poses: Poses, time: Array, scale: float) -> Timed:
    """A body over time (n,), its own rates ``scale`` times as fast as the family has them."""
    if poses.rates is None:
        return Timed(poses.frames, *over_time(poses.frames, time))
    return Timed(poses.frames, poses.rates.first * scale, poses.rates.second * scale**2)


def _shaft(drive: Joint, bodies: Mapping[str, Timed]) -> tuple[Array, Array]:
    """Speed and acceleration (n,) of the driven shaft about its axis, from the exact rates of its body."""
    body = bodies[drive.two]
    axis = np.asarray(drive.axis)
    if drive.one != GROUND:
        axis = bodies[drive.one].frames[0, :, :3] @ axis
    spins = [turns_of(rate[:, :, :3], body.frames) @ axis for rate in (body.first, body.second)]
    return spins[0], spins[1]


def turns_of(rates: Array, frames: Array) -> Array:
    """The vector (n, 3) of the turning R' Rᵀ, of rates (n, 3, 3) of rotations and their frames (n, 3, 4).

    Of a second derivative it is the vector of the angular acceleration.
    """
    spin = rates @ np.swapaxes(frames[:, :, :3], 1, 2)
    skew = (spin - np.swapaxes(spin, 1, 2)) / 2
    return np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)
