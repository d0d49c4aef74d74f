"""The motion in closed form: with the crank angle θ = ω t, the yoke stands at x = r cos θ.

Numbers are columns (n, 1) in a table of designs, and channels are (n, samples) then.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from mechwright import Channel, Figure
from mechwright_scotch_yoke.plates import yoke_mass

if TYPE_CHECKING:
    from mechwright_scotch_yoke.family import ScotchYokeParams


def omega(params: "ScotchYokeParams") -> float:
    """Angular speed of the crank, rad/s."""
    return params.speed * math.tau / 60


def peak_force(params: "ScotchYokeParams") -> float:
    """Largest force between pin and slot, N: the load and, at the dead centres, the yoke's inertia m r ω²."""
    return params.load + yoke_mass(params) * params.crank_radius / 1000 * omega(params) ** 2


def channels(params: "ScotchYokeParams", samples: int) -> dict[str, Channel]:
    """One turn of the crank, ``samples`` instants, both ends included."""
    r, w = params.crank_radius, omega(params)
    theta = np.linspace(0.0, math.tau, samples)
    return {
        "theta": Channel(theta, "rad", "angle of the crank"),
        "omega": Channel(w + 0 * theta, "rad/s", "angular velocity of the crank"),
        "x": Channel(r * np.cos(theta), "mm", "place of the yoke"),
        "velocity": Channel(-r * w * np.sin(theta), "mm/s", "velocity of the yoke"),
        "acceleration": Channel(-r * w**2 * np.cos(theta), "mm/s^2", "acceleration of the yoke"),
        "jerk": Channel(r * w**3 * np.sin(theta), "mm/s^3", "jerk of the yoke"),
    }


def figures(params: "ScotchYokeParams") -> dict[str, Figure]:
    """Single numbers worth knowing."""
    r, w = params.crank_radius, omega(params)
    return {
        "stroke": Figure(2 * r, "mm"),
        "max_velocity": Figure(r * w, "mm/s"),
        "yoke_mass": Figure(yoke_mass(params), "kg"),
        "peak_force": Figure(peak_force(params), "N"),
    }
