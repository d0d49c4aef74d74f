"""The four-bar under the kit that third parties use."""

from typing import ClassVar

from mechwright.testing import FamilyContract
from mechwright_four_bar.family import FourBars


class TestFourBars(FamilyContract):
    family = FourBars
    examples = (
        {},
        {"coupler_point_x": 40, "coupler_point_y": 30, "branch": "crossed", "direction": "cw", "pivot_x": 5},
        {"coupler_bend": 25, "bushing_wall": 0, "ground_angle": 30, "load_torque": 2, "speed": 300},
    )
    refused = (
        ({"crank": 70}, "crank"),
        ({"crank": 60}, "ground"),
        ({"coupler": 400}, "coupler"),
        ({"crank": 50, "coupler": 60, "follower": 80, "ground": 90}, "ground"),
        ({"crank": 8}, "crank"),
        ({"coupler_point_x": 3, "coupler_point_y": 0}, "coupler_point_x"),
        ({"coupler_bend": 20, "web_width": 17}, "coupler_bend"),
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
    requirements: ClassVar = {
        "path": ({"starts": 4000, "designs": 2, "tolerance": 0.1},),
        "poles": ({"starts": 800, "designs": 3},),
    }
