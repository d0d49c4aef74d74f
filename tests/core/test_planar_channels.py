"""Channels of what moves in the plane: every rate is the derivative of the channel before it."""

from itertools import pairwise

import numpy as np
import pytest

from mechwright.mechanics.planar import BodyMotion, Turning, acceleration_pole
from mechwright.mechanics.planar.channels import point_channels, pole_channels, turning_channels

TIME = np.linspace(0.0, 1.0, 20001)
SWING = Turning.of(np.sin(3 * TIME), 3 * np.cos(3 * TIME), -9 * np.sin(3 * TIME), -27 * np.cos(3 * TIME))
BODY = BodyMotion.about(5 - 2j, SWING)


def falls_short(channels, names):
    """Greatest difference of each channel from the derivative of the one before it, over its size."""
    values = [channels[name].values for name in names]
    return [
        np.abs(np.gradient(one, TIME)[1:-1] - two[1:-1]).max() / np.abs(two).max()
        for one, two in pairwise(values)
    ]


def test_rates_of_what_turns():
    found = turning_channels(SWING, "psi", "_b")
    assert {name: one.unit for name, one in found.items()} == {
        "psi": "rad",
        "omega_b": "rad/s",
        "alpha_b": "rad/s^2",
        "jerk_b": "rad/s^3",
    }
    assert max(falls_short(found, list(found))) < 1e-6


@pytest.mark.parametrize("axis", ["x", "y"])
def test_rates_of_a_point(axis):
    found = point_channels("P", BODY.point(30 + 10j))
    names = [f"{prefix}{axis}P" for prefix in ("", "v", "a", "j")]
    assert [found[name].unit for name in names] == ["mm", "mm/s", "mm/s^2", "mm/s^3"]
    assert max(falls_short(found, names)) < 1e-6


def test_the_pole_moves_with_the_pivot_on_the_ground_and_not_in_the_body():
    pole = acceleration_pole(BODY)
    here, there = pole_channels(pole), pole_channels(pole, 7 + 1j, "_other")
    assert np.abs(there["xG_other"].values - here["xG"].values - 7).max() < 1e-12
    assert np.abs(there["yG_other"].values - here["yG"].values - 1).max() < 1e-12
    assert np.array_equal(there["xG_coupler_other"].values, here["xG_coupler"].values)
    # The body turns about its origin, which therefore has no acceleration.
    assert here["xG"].values == pytest.approx(5.0)
    assert here["yG"].values == pytest.approx(-2.0)
