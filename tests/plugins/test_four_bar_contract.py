"""The four-bar under the kit that third parties use."""

import math
from typing import ClassVar

import pytest
from by_night import NIGHT, examples
from day_contract import DayContract

from mechwright_four_bar.family import FourBars


class TestFourBars(DayContract):
    family = FourBars
    compiles = True
    night: ClassVar = {
        # A lever or an accelerating crank moves the plates of a crank-rocker, and the last has all its plates.
        "test_programs_are_proven": {0, 2, 3, 4},
        "test_no_interference": {0, 3, 4},
    }
    max_frames = examples(2, 50)
    examples = (
        {},
        {"crank": 70, "coupler": 70, "follower": 75, "ground": 20},
        {"coupler_point_x": 40, "coupler_point_y": 30, "branch": "crossed", "direction": "cw", "pivot_x": 5},
        {"crank": 70, "coupler": 60, "follower": 75, "ground": 110, "swing_from": 30, "swing_to": 85},
        {"acceleration_ratio": -0.1},
        {
            **dict.fromkeys(("coupler_point_x", "coupler_point_y"), 40),
            "setting_angle": 70,
            "phases": [{"crank_turn": 30, "follower_turn": 12}],
            "phase": 2,
        },
    )
    refused = (
        ({"swing_from": 10, "swing_to": 40, "acceleration_ratio": 0.1}, "acceleration_ratio"),
        ({"crank": 70, "coupler": 60, "swing_from": -60, "swing_to": 150}, "swing_to"),
        ({"swing_from": 10}, "swing_to"),
        ({"crank": 60}, "ground"),
        ({"coupler": 400}, "coupler"),
        ({"crank": 50, "coupler": 60, "follower": 80, "ground": 90}, "ground"),
        ({"crank": 8, "pin_diameter": 6, "rim": 4}, "crank"),
        ({"coupler_point_x": 3, "coupler_point_y": 0, "pin_diameter": 6, "rim": 4}, "coupler_point_x"),
        ({"crank": 70, "coupler": 60, "follower": 75, "ground": 30, "frame": "one"}, "frame"),
        ({"coupler_bend": 20, "web_width": 17}, "coupler_bend"),
        ({"coupler_bend": -158.5, "bushing_wall": 34.5}, "coupler_bend"),
        ({"coupler_point_x": 3}, "coupler_point_y"),
    )
    derivatives = (
        ("phi", "omega_a"),
        ("sigma", "omega_c"),
        ("omega_c", "alpha_c"),
        ("alpha_c", "jerk_c"),
        ("psi", "omega_b"),
        ("omega_b", "alpha_b"),
        ("alpha_b", "jerk_b"),
    )
    input_rate = "omega_a"
    variations: ClassVar = {
        "coupler_bend": (25,),
        "load_torque": (2,),
        "ground_angle": (30,),
        "phases": ([{"crank_turn": 40, "follower_turn": 12}],),
    }
    requirements: ClassVar = {
        "path": ({"starts": 4000, "designs": 2, "tolerance": 0.1},),
        "adjustable-path": ({"starts": 600, "designs": 1},),
        "poles": ({"starts": 800, "designs": 3},),
        "nine-points": ({},) if NIGHT else (),
    }


def test_a_bent_coupler_without_bushings_is_made_as_asked():
    family = FourBars()
    params = family.Params(coupler_bend=25, bushing_wall=0, ground_angle=30)
    parts = {part.name: part for part in family.parts(params)}
    assert not any(name.startswith("bushing") for name in parts)
    outline = parts["coupler"].outline
    assert outline.bounds[3] > 25
    bores = sorted(-loop.area for loop in outline.inner)
    assert bores == pytest.approx([math.pi / 4 * (6 + 0.03) ** 2] * 2)
    assert parts["coupler"].outline.area > FourBars().parts(family.Params())[2].outline.area
