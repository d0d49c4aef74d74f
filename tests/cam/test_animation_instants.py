"""Poles, circles and arrows of the page of a motion, worked out from its poses alone."""

import math
from pathlib import Path

import numpy as np
import pytest

from mechwright.contracts.motion import Channel, Motion, Poses, Trace
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright_cad.animation.instants import arrows, instants, lines

EXAMPLES = Path(__file__).parents[2] / "examples"
TURN = np.linspace(0, math.tau, 361)


def numbers(columns):
    return np.array([[np.nan if one is None else one for one in column] for column in columns], dtype=float)


def test_a_wheel_that_rolls_has_its_centre_on_the_line_and_the_poles_of_the_cycloid():
    """The instant centre is the point of contact, the acceleration pole the hub, the circle half as large."""
    wheel = Poses.planar(10 * TURN, 10.0, -TURN)
    (found,) = instants(Motion("phi", {"phi": Channel(TURN, "rad")}, {"wheel": wheel}))
    np.testing.assert_allclose(numbers(found["centre"]), [10 * TURN, 0 * TURN], atol=0.02)
    np.testing.assert_allclose(numbers(found["pole"]), [10 * TURN, 10 + 0 * TURN], atol=0.02)
    np.testing.assert_allclose(numbers(found["opposite"]), [10 * TURN, 10 + 0 * TURN], atol=0.02)


@pytest.mark.parametrize(
    ("name", "body", "channels"),
    [
        ("crank-rocker-finished", "coupler", ("xG", "yG")),
        ("slider-crank-quick-return", "rod", ("xG", "yG")),
        ("double-crank", "coupler", ("xG", "yG")),
    ],
)
def test_the_acceleration_pole_is_the_familys(name, body, channels):
    design = load(EXAMPLES / f"{name}.toml", host())
    motion = design.family.solve(design.params, 361)
    (found,) = [one for one in instants(motion) if one["body"] == body]
    wanted = np.array([motion.channels[channel].values for channel in channels])
    near = np.hypot(*wanted) < 500
    np.testing.assert_allclose(numbers(found["pole"])[:, near], wanted[:, near], rtol=2e-3, atol=0.05)


def test_where_a_lever_stands_its_coupler_turns_about_the_acceleration_pole():
    """Both rates are 0 at the ends of a swing: their quotient was rounding, 0.3 mm off."""
    design = load(EXAMPLES / "four-bar-double-rocker.toml", host())
    motion = design.family.solve(design.params, 361)
    (found,) = [one for one in instants(motion) if one["body"] == "coupler"]
    ends = [0, 180, 360]
    centre, pole = numbers(found["centre"]), numbers(found["pole"])
    wanted = np.array([motion.channels[channel].values for channel in ("xG", "yG")])
    np.testing.assert_allclose(centre[:, ends], wanted[:, ends], atol=0.02)
    np.testing.assert_allclose(centre[:, ends], pole[:, ends])
    assert np.isnan(numbers(found["opposite"])[:, ends]).all()


def test_a_pivot_is_no_instant_centre_worth_showing():
    turns = Poses.planar(5.0, 3.0, TURN)
    slides = Poses.planar(TURN, 0.0, 0 * TURN)
    assert instants(Motion("phi", {"phi": Channel(TURN, "rad")}, {"crank": turns, "slider": slides})) == []


def test_arrows_are_rates_of_the_path():
    poses = {"crank": Poses.planar(0.0, 0.0, TURN)}
    motion = Motion(
        "phi", {"phi": Channel(TURN, "rad")}, poses, traces={"P": Trace("crank", (7.0, 0.0, 0.0))}
    )
    found = arrows(motion)["P"]
    np.testing.assert_allclose(found["velocity"], [-np.sin(TURN), np.cos(TURN)], atol=1e-3)
    np.testing.assert_allclose(found["acceleration"], [-np.cos(TURN), -np.sin(TURN)], atol=1e-3)


def test_lines_are_the_curves_of_the_motion():
    design = load(EXAMPLES / "elliptic-pair.toml", host())
    found = lines(design.family.solve(design.params, 13))
    assert [(one["name"], one["body"]) for one in found] == [
        ("pitch-gear-2", "gear-2"),
        ("pitch-gear-4", "gear-4"),
    ]


@pytest.mark.parametrize("phi", [np.array([0.0, 1.0]), np.array([0.0, 1.0, 0.5, 0.2, 0.1, 0.0])])
def test_what_gives_no_rates_has_no_poles(phi):
    motion = Motion("phi", {"phi": Channel(phi, "rad")}, {"rod": Poses.planar(phi, phi**2, phi)})
    assert instants(motion) == []
    assert arrows(motion) == {}
