"""The five-bar under the kit that third parties use."""

from typing import ClassVar

from by_night import NIGHT
from day_contract import DayContract

from mechwright_five_bar.family import FiveBars

LEVER = {
    "crank": 100, "arm": 100, "coupler": 90, "rocker": 130, "ground": 125, "arm_angle": 3.5,
    "coupler_point_x": 30, "coupler_point_y": 85, "swing_from": 83, "swing_to": -37,
}  # fmt: skip
"""The reference of the adjustable five-bars."""

AGAINST = {
    "idler_teeth": 0, "arm_teeth": 20, "direction": "cw", "pivot_x": 5, "module": 5.25, "crank": 12, "arm": 12,
}  # fmt: skip
"""Crank and arm turn against each other."""


class TestFiveBars(DayContract):
    family = FiveBars
    compiles = True
    night: ClassVar = {
        # The machine of two phases has the same plates, and a clamp and slots besides.
        "test_programs_are_proven": {0},
        "test_no_interference": {0},
    }
    examples = (
        {},
        {
            **LEVER,
            "setting_angle": 83,
            "phases": [{"crank_turn": 6, "rocker_turn": -9, "swing_from": 89, "swing_to": -31}],
            "phase": 2,
        },
        *((AGAINST,) if NIGHT else ()),
    )
    refused = (
        ({"swing_from": 10}, "swing_to"),
        ({"coupler": 10, "rocker": 20}, "coupler"),
        ({"crank": 10, "pin_diameter": 8, "rim": 4}, "crank"),
        ({"module": 2.0, "crank_teeth": 20, "idler_teeth": 20, "arm_teeth": 40}, "module"),
        ({"module": 4.0}, "module"),
        ({"idler_teeth": 12}, "idler_teeth"),
        ({"idler_teeth": 0, "module": 2.05}, "module"),
        ({**LEVER, "swing_to": -150}, "swing_to"),
        ({"coupler_point_x": 3, "coupler_point_y": 0, "pin_diameter": 8, "rim": 4}, "coupler_point_x"),
    )
    derivatives = (
        ("theta", "omega_a"),
        ("sigma", "omega_c"),
        ("omega_c", "alpha_c"),
        ("alpha_c", "jerk_c"),
        ("psi", "omega_r"),
        ("omega_r", "alpha_r"),
        ("phi", "omega_b"),
        ("omega_b", "alpha_b"),
    )
    studied = (
        "crank", "coupler", "rocker", "arm", "ground", "arm_angle", "ground_angle", "coupler_point_x", "speed",
        "thickness", "rim",
    )  # fmt: skip
    input_rate = "omega_a"
    samples = 721
    max_examples = 30 if NIGHT else 3
    variations: ClassVar = {
        "ground_angle": (30,),
        "load_x": (20,),
        "load_y": (20,),
        "pivot_x": (5,),
        "direction": ("cw",),
        "module": (2.2,),
        "phases": ([{"crank_turn": 40, "rocker_turn": 12}],),
    }
    requirements: ClassVar = {"adjustable-path": ({"starts": 400, "designs": 1},)}
