from typing import ClassVar

from by_night import examples
from day_contract import DayContract

from mechwright_spherical.family import Spherical

PATH = {
    "path_tolerance": 0.5,
    "five_bar": {"path": [[0.2757, 1.8649], [0.4208, 1.6891]], "path_angles": [-10, -30]},
}
FOUR_BAR = {"kind": "four-bar", "radius": 60}


class TestSpherical(DayContract):
    family = Spherical
    compiles = True
    night: ClassVar = {
        # The first has all bodies of a five-bar, in both phases; the last those of any four-bar.
        "test_programs_are_proven": {2, 3},
        "test_solids": {1, 2, 3},
        "test_no_interference": {1, 2},
    }
    nights: ClassVar = ("test_synthesis",)
    max_frames = examples(2, 50)
    examples: ClassVar = (
        PATH,
        {"five_bar": {"phase": 2, "common_arcs": True}, "drive": {"gears": False}, "flat": {"make": False}},
        FOUR_BAR,
        {**FOUR_BAR, "four_bar": {"ground": 20, "input": 60, "coupler": 50, "output": 70}},
        {**FOUR_BAR, "stand": {"arc": 80, "motor_flange": 56, "screw": 5.5}},
    )
    refused: ClassVar = (
        ({"radius": 10}, "radius"),
        ({"five_bar": {"travel": -190}}, "five_bar.travel"),
        ({"five_bar": {"start": 60}}, "five_bar.travel"),
        ({"five_bar": {"a1": [0.0, 0.0004]}}, "five_bar.a1"),
        ({"five_bar": {"a1": [0.0, 0.0, 0.0]}}, "five_bar.a1"),
        ({"five_bar": {"a1": [1.0]}}, "five_bar.a1"),
        ({"five_bar": {"ratio": 0}}, "five_bar"),
        ({"five_bar": {"projection_length": 0}}, "five_bar.projection_length"),
        ({"four_bar": {"ground": 70}}, "four_bar"),
        ({**FOUR_BAR, "four_bar": {"ground": 180}}, "four_bar.ground"),
        ({**FOUR_BAR, "four_bar": {"input": 100, "travel": 360}}, "four_bar.travel"),
        ({**FOUR_BAR, "four_bar": {"ground": 170, "input": 20, "output": 20}}, "four_bar.travel"),
        ({**FOUR_BAR, "drive": {"gears": False}, "flat": {"make": False}}, "drive"),
        ({"path_tolerance": 1}, "path_tolerance"),
        ({"hardware": {"frame": "two"}}, "hardware.frame"),
        ({"hardware": {"boss_diameter": 7, "pin_diameter": 6}}, "hardware.boss_diameter"),
        ({**FOUR_BAR, "four_bar": {"point_azimuth": 0, "point_elevation": 0}}, "four_bar.point_azimuth"),
        ({"hardware": {"gap": 0.1, "boss_diameter": 12}}, "hardware.gap"),
        ({"hardware": {"boss_diameter": 24, "gap": 3}}, "hardware.boss_diameter"),
        ({"stand": {"arc": 8}}, "stand.arc"),
        ({"stand": {"screw": 20}}, "stand.screw"),
        ({"drive": {"idler": 1, "share": 0.2}}, "drive.idler"),
        ({"flat": {"bend_radius": 50, "make": True}}, "flat.bend_radius"),
    )
    derivatives: ClassVar = (
        ("theta", "omega"),
        *((f"{axis}P", f"v{axis}P") for axis in "xyz"),
        *((f"v{axis}P", f"a{axis}P") for axis in "xyz"),
        *((f"a{axis}P", f"j{axis}P") for axis in "xyz"),
        *((f"omega3{axis}", f"alpha3{axis}") for axis in "xyz"),
        *((f"alpha3{axis}", f"jerk3{axis}") for axis in "xyz"),
    )
    input_rate = "omega"
    variations: ClassVar = {"path_tolerance": (0.1,)}
    requirements: ClassVar = {
        "adjustable-path": (
            {"unknowns": "six", "starts": 1},
            {
                "phases": [
                    [[20, 88], [-10, 78], [-27, 52], [-25, 30]],
                    [[20, 88], [-5, 87], [-24, 63], [-29, 40]],
                ],
                "linkage": "four-bar",
                "projection_length": 100,
                "projection_centre": "best",
                "tried": 500,
                "designs": 1,
            },
        ),
        "four-bar-path": ({"atlas": 200, "starts": 1},),
        "five-bar-path": ({"atlas": 200, "starts": 1, "least_transmission": 20},),
    }
