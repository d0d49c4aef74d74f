"""The family under the kit that third parties use."""

from typing import ClassVar

from by_night import examples
from day_contract import DayContract

from mechwright_slider_crank.family import SliderCrankFamily


class TestSliderCrank(DayContract):
    family = SliderCrankFamily
    compiles = True
    night: ClassVar = {
        # The plates of the defaults are machined from an example.
        "test_programs_are_proven": {0, 2, 3},
        # An accelerating crank goes the way of a steady one.
        "test_no_interference": {3},
    }
    max_frames = examples(2, 50)
    examples = (
        {},
        {
            "assembly": "behind",
            "clockwise": True,
            "coupler_bore": 6,
            "coupler_x": 60,
            "coupler_y": 30,
            "crank_shape": "arm",
            "slide_direction": 30,
        },
        {"swing_from": 10, "swing_to": 100},
        {"acceleration_ratio": 0.1, "speed": 30},
        {"screw_hole": 6, "screw_offset": 60, "shaft": 8},
    )
    refused = (
        ({"rod": 40.01}, "rod"),
        ({"rod": 35, "acceleration_ratio": 0.1}, "acceleration_ratio"),
        ({"rod": 30, "crank": 20, "offset": 60}, "offset"),
        ({"crank": 6, "rod": 60, "pin": 8}, "crank"),
        ({"rod": 110, "rod_width": 30}, "rod_width"),
        ({"rod_bend": 60}, "rod_bend"),
        ({"rod": 35, "swing_from": -60, "swing_to": 90}, "swing_from"),
        ({"swing_from": 10}, "swing_to"),
    )
    derivatives = (
        ("phi", "omega_a"),
        ("s", "v"),
        ("v", "a"),
        ("a", "jerk"),
        ("sigma", "omega_c"),
        ("omega_c", "alpha_c"),
        ("alpha_c", "jerk_c"),
        ("xP", "vxP"),
        ("vyP", "ayP"),
        ("axP", "jxP"),
    )
    input_rate = "omega_a"
    requirements: ClassVar = {
        "stroke": ({}, {"stroke": 100, "time_ratio": 1.2, "rod": 150}),
        "poles": (
            {"starts": 400},
            {"starts": 400, "slide_direction": 20, "acceleration_ratios": (0.0, 0.1)},
        ),
    }
    max_examples = 20
