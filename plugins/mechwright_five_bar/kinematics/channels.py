"""Channels of a period of five-bars: angles, rates and the coupler point."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechwright import Channel
from mechwright.contracts.stretch import travelled
from mechwright.mechanics.linkage.kinematics.period import Period, drives_at
from mechwright.mechanics.planar.channels import point_channels, rate_channels, turning_channels
from mechwright_five_bar.table import FiveBarTable


def channels_over(m: FiveBarTable, period: Period, *, varies: bool) -> dict[str, Channel]:
    """Angles and rates (..., n) without forces; ``varies``: the speed of the crank does."""
    drive, bodies = period.drive, period.solution.bodies
    channels = {
        "theta": Channel(drive.theta, "rad", "angle of the crank"),
        "time": Channel(period.time, "s", "time"),
    }
    driven = rate_channels(drive, "_a", "the crank")
    channels |= driven if varies else {"omega_a": driven["omega_a"]}
    for name, angle, suffix in (("coupler", "sigma", "_c"), ("rocker", "psi", "_r"), ("arm", "phi", "_b")):
        channels |= turning_channels(bodies[name].turning, angle, suffix, f"the {name}")
    cosine = np.abs(np.cos(bodies["coupler"].turning.theta - bodies["rocker"].turning.theta))
    channels["transmission_angle"] = Channel(np.arccos(cosine), "rad", "transmission angle")
    moving = bodies["coupler"].point(m.params.coupler_point)
    return channels | point_channels("P", replace(moving, position=moving.position + m.pivot))


def channels_of(m: FiveBarTable, samples: int) -> Mapping[str, Channel]:
    """The channels (n, samples) of a table, without input and forces; NaN of those that a linkage has not."""
    time, drive = drives_at(m, travelled(math.tau, samples))
    found = channels_over(m, Period(time, drive, m.solved(drive)), varies=bool(m.levers.any()))
    own = {name: one for name, one in found.items() if name in ("alpha_a", "jerk_a")}
    rates = {
        name: replace(one, values=np.where(m.levers[:, None], one.values, math.nan))
        for name, one in own.items()
    }
    del found["theta"]  # a study has no extremes of the input
    return found | rates
