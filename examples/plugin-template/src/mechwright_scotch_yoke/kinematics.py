"""The motion in closed form: with the crank angle θ = ω t, the yoke stands at x = r cos θ."""

import math
from typing import TYPE_CHECKING

import numpy as np

from mechwright import Channel, Motion, Poses, Scalar
from mechwright_scotch_yoke.checks import peak_force
from mechwright_scotch_yoke.plates import yoke_mass

if TYPE_CHECKING:
    from mechwright_scotch_yoke.family import ScotchYokeParams


def omega(params: "ScotchYokeParams") -> float:
    """Angular speed of the crank, rad/s."""
    return params.speed * math.tau / 60


def motion(params: "ScotchYokeParams", samples: int) -> Motion:
    """One turn of the crank, ``samples`` instants, both ends included."""
    r, w = params.crank_radius, omega(params)
    theta = np.linspace(0.0, math.tau, samples)
    x = r * np.cos(theta)
    zero = np.zeros(samples)
    return Motion(
        input_name="theta",
        channels={
            "theta": Channel(theta, "rad", "angle of the crank"),
            "omega": Channel(np.full(samples, w), "rad/s", "angular velocity of the crank"),
            "x": Channel(x, "mm", "place of the yoke"),
            "velocity": Channel(-r * w * np.sin(theta), "mm/s", "velocity of the yoke"),
            "acceleration": Channel(-r * w**2 * np.cos(theta), "mm/s^2", "acceleration of the yoke"),
            "jerk": Channel(r * w**3 * np.sin(theta), "mm/s^3", "jerk of the yoke"),
        },
        poses={
            "crank": Poses.planar(0.0, 0.0, theta),
            "yoke": Poses.planar(x, 0.0, zero),
        },
        scalars={
            "stroke": Scalar(2 * r, "mm"),
            "max_velocity": Scalar(r * w, "mm/s"),
            "yoke_mass": Scalar(yoke_mass(params), "kg"),
            "peak_force": Scalar(peak_force(params, w), "N"),
        },
    )
