"""Channels of a period of five-bars: angles, rates and the coupler point."""

import math
from collections.abc import Collection
from dataclasses import replace

import numpy as np

from mechwright import Array, Channel
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.linkage.kinematics.channel_extremes import compiled_extremes, drives_of
from mechwright.mechanics.linkage.kinematics.period import Period
from mechwright.mechanics.planar.channels import point_channels, rate_channels, turning_channels
from mechwright_five_bar.table import FiveBarTable

TURNING_RATES = ("omega", "alpha", "jerk")

LINKS = (("coupler", "sigma", "_c"), ("rocker", "psi", "_r"), ("arm", "phi", "_b"))
"""Links with their angles, and the ends of the names of their rates."""

IN_CORE = {"omega_a": "omega_in"}
"""Channels to their names in compiled chains."""
for _link, _angle, _end in LINKS:
    IN_CORE |= {_angle: f"theta_{_link}"} | {f"{rate}{_end}": f"{rate}_{_link}" for rate in TURNING_RATES}


def channels_over(m: FiveBarTable, period: Period, *, varies: bool) -> dict[str, Channel]:
    """Angles and rates (..., n) without forces; ``varies``: the speed of the crank does."""
    drive, bodies = period.drive, period.solution.bodies
    channels = {
        "theta": Channel(drive.theta, "rad", "angle of the crank"),
        "time": Channel(period.time, "s", "time"),
    }
    driven = rate_channels(drive, "_a", "the crank")
    channels |= driven if varies else {"omega_a": driven["omega_a"]}
    for name, angle, suffix in LINKS:
        channels |= turning_channels(bodies[name].turning, angle, suffix, f"the {name}")
    cosine = np.abs(np.cos(bodies["coupler"].turning.theta - bodies["rocker"].turning.theta))
    channels["transmission_angle"] = Channel(np.arccos(cosine), "rad", "transmission angle")
    moving = bodies["coupler"].point(m.params.coupler_point)
    return channels | point_channels("P", replace(moving, position=moving.position + m.pivot))


def extremes_of(m: FiveBarTable, names: Collection[str]) -> dict[str, tuple[Array, Array, str]]:
    """Least and greatest values (n,) of channels of a table, and their unit; NaN of those it has not."""
    own = {name: IN_CORE.get(name, name) for name in names if name != "theta"}
    found = compiled_extremes(m, list(own.values()))
    ends = {name: found[core] for name, core in own.items() if core in found}
    for name, place in (("xP", m.params.pivot_x), ("yP", m.params.pivot_y)):
        if name in ends:
            low, high, unit = ends[name]
            ends[name] = low + np.ravel(place), high + np.ravel(place), unit
    for rate, (name, unit) in enumerate((("alpha_a", "rad/s^2"), ("jerk_a", "rad/s^3")), start=2):
        if name in names and m.chain is not None:  # a crank that turns fully has a constant speed
            bounds = m.chain.extremes(drives_of(m), [(m.chain.drive + rate, 1)], SAMPLES)[:, 0]
            low, high = np.where(m.levers[:, None], bounds, math.nan).T
            ends[name] = low, high, unit
    return ends
