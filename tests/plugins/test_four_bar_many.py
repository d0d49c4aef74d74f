"""Many four-bars at once are what each is by itself."""

import math

import numpy as np
import pytest
from by_night import in_ci
from many import Many

from mechwright import Stage
from mechwright.contracts.evaluation import Batch
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams

pytestmark = in_ci

FAMILY = FourBars()
MANY = Many(FAMILY)
POINT = [
    f"{rate}{axis}P.{end}" for rate in ("", "v", "a", "j") for axis in "xy" for end in ("least", "greatest")
]
LINKS = [
    f"{name}.{end}"
    for name in (
        "sigma",
        "psi",
        "omega_c",
        "alpha_c",
        "jerk_c",
        "omega_b",
        "alpha_b",
        "jerk_b",
        "transmission_angle",
    )
    for end in ("least", "greatest")
]
FIGURES = [
    "least_transmission_angle", "greatest_transmission_angle", "grashof_excess", "swing", "time_ratio",
    "limit_extended", "limit_folded", "omega_b_max", "alpha_b_max", "time.greatest", "omega_a.greatest",
    "alpha_a.least", "jerk_a.least", "swing_from", "swing_to", "input_range", "toggle_low", "toggle_high",
]  # fmt: skip


def test_cranks_and_levers_of_both_branches():
    batch = MANY.drawn(
        16, {"speed": 100, "bushing_wall": 0}, crank=(0, 100), coupler=(5, 150), follower=(5, 150),
        ground=(1, 150), ground_angle=(-300, 300), branch=["open", "crossed"], direction=["cw", "ccw"],
    )  # fmt: skip
    found = MANY.same(batch, LINKS + FIGURES, Stage.PARTS)
    assert {"four-bar.closure", "four-bar.bores", "parameters.crank"} & set(found.counts)
    assert not MANY.alone


@pytest.mark.parametrize(
    "content",
    [
        {"frame": "two"},
        {"coupler_point_x": 20, "coupler_point_y": 30, "web_width": 7},
        {"bushing_wall": 0, "rim": 6},
    ],
)
def test_masses_of_links_are_those_of_the_parts(content):
    links = ["mass.crank", "mass.coupler"] + ["mass.follower"] * ("frame" in content)
    batch = MANY.drawn(10, content, crank=(16, 45), coupler=(60, 120), follower=(60, 120), thickness=(4, 8))
    found = MANY.same(batch, links, Stage.PARTS)
    assert (found.forbidden == 0).sum() > 3
    assert not MANY.alone


def test_accelerating_cranks_and_coupler_points():
    batch = MANY.drawn(
        12, {"acceleration_ratio": 0.1, "coupler_point_x": 20, "pivot_x": 5, "ground": 90},
        crank=(20, 50), coupler=(60, 120), follower=(40, 100), coupler_point_y=(-40, 40),
    )  # fmt: skip
    found = MANY.same(batch, POINT + LINKS + FIGURES, Stage.MOTION)
    assert "four-bar.acceleration" in found.counts
    assert not MANY.alone


def test_what_tears_is_what_tears_of_each():
    batch = MANY.drawn(
        8, {"speed": 3000, "thickness": 2, "rim": 1, "load_torque": 100, "ground": 100},
        crank=(10, 30), coupler=(90, 110), follower=(70, 90), material=["pom", "steel"],
    )  # fmt: skip
    found = MANY.same(batch, ["alpha_b_max"], Stage.PARTS)
    assert "four-bar.eye" in found.counts
    assert not MANY.alone


def test_forces_and_masses_are_those_of_each():
    batch = MANY.drawn(4, {"ground": 90}, crank=(15, 25), coupler=(80, 100))
    MANY.same(batch, ["mass_coupler", "force_A.greatest", "xG.least", "alpha_b_max"], Stage.PARTS)
    assert MANY.alone == 4


@pytest.mark.parametrize(
    "content", [{"frame": "one"}, {"coupler_bend": 3}, {"coupler_bend": 3, "swing_from": 10, "swing_to": 50}]
)
def test_one_plate_and_bent_couplers(content):
    MANY.same(MANY.drawn(3, content, crank=(15, 25)), ["alpha_b_max", "mass.crank"], Stage.PARTS)
    assert not MANY.alone


def test_swings_that_are_given():
    batch = MANY.drawn(
        60, {"speed": 100, "bushing_wall": 0}, crank=(20, 200), coupler=(5, 150), follower=(5, 150),
        ground=(60, 150), ground_angle=(-300, 300), swing_from=(-360, 360), swing_to=(-360, 360),
    )  # fmt: skip
    found = MANY.same(batch, LINKS + FIGURES, Stage.PARTS)
    assert {"four-bar.closure", "four-bar.swing"} <= set(found.counts)
    assert (found.forbidden == 0).sum() > 5
    assert not MANY.alone


def test_one_swing_of_cranks_and_levers():
    batch = MANY.drawn(
        25, {"swing_from": 130, "swing_to": 40, "ground": 100, "ground_angle": 10}, crank=(20, 90),
        coupler=(60, 110), follower=(60, 110), branch=["open", "crossed"],
    )  # fmt: skip
    found = MANY.same(batch, LINKS + FIGURES, Stage.MOTION)
    assert np.isfinite(found.values["toggle_low"]).any()
    assert np.isnan(found.values["toggle_low"][found.forbidden == 0]).any()
    assert not MANY.alone


def test_a_lever_turns_back_at_one_degree():
    batch = MANY.drawn(50, {"ground": 110, "coupler": 60, "follower": 75}, crank=(60, 90))
    found = FAMILY.evaluate(batch, ["least_transmission_angle"])
    assert (found.forbidden == 0).all()
    assert found.values["least_transmission_angle"] == pytest.approx(1.0, abs=1e-9)


def test_rates_of_a_parallelogram_like_linkage_in_closed_form():
    # With the crank over the ground line the follower turns with a/(f - a) times sin(b)/sin(d) of the triangle.
    a, c, b, f = 30.0, 100.0, 90.0, 95.0
    found = FAMILY.evaluate(
        Batch(
            FourBarParams,
            {"ground": f},
            {"crank": np.array([a]), "coupler": np.array([c]), "follower": np.array([b])},
        ),
        ["grashof_excess", "swing"],
    )
    far, near = (math.acos((b * b + f * f - x * x) / (2 * b * f)) for x in (c + a, c - a))
    assert found.values["swing"][0] == pytest.approx(math.degrees(far - near))
    assert found.values["grashof_excess"][0] == pytest.approx(b + f - a - c)
