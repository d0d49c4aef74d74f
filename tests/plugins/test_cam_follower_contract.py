"""The cams under the kit that third parties use."""

from typing import ClassVar

from by_night import examples as tried
from day_contract import DayContract
from hypothesis import strategies as st

from mechwright_cam_follower.family import CamFollower

SMALL = {"base_radius": 22, "bore": 8, "thickness": 5, "follower_thickness": 4, "guide_length": 30}
ROWS = [
    [u / 48, (u / 48) ** 4 * (35 - 84 * u / 48 + 70 * (u / 48) ** 2 - 20 * (u / 48) ** 3)] for u in range(49)
]


class TestCamFollower(DayContract):
    family = CamFollower
    ci: ClassVar = (
        "test_every_parameter_counts",
        "test_fixes_of_random_designs",
        "test_fixes_of_refused_designs",
        "test_tolerances_of_random_designs",
    )
    night: ClassVar = {
        # One design is built by day; of the others, findings and motion.
        **{
            name: {0, 2, 3, 4, 5}
            for name in ("test_programs_are_proven", "test_no_interference", "test_drawings")
        },
        "test_solids": range(6),
    }
    max_frames = tried(1, 20)
    derivatives = (("lift", "velocity"), ("velocity", "acceleration"))
    input_rate = "omega1"
    samples = 2881
    examples = (
        {
            "offset": 6.0,
            "laws": ["4-5-6-7"],
            "keyway_width": 5,
            "keyway_relief": 1.5,
            "screw_diameter": 4,
            "screw_circle": 50,
        },
        {**SMALL, "lifts": [8, 8, 0, 0], "laws": ["4-5-6-7"]},
        {
            "follower": "oscillating",
            "laws": ["4-5-6-7", "polynomial"],
            "polynomial": [0, 0, 0, 0, 35, -84, 70, -20],
        },
        {"contact": "flat", "laws": ["4-5-6-7"], "turning": "cw"},
        {
            "contact": "flat",
            "follower": "oscillating",
            "base_radius": 60,
            "swings": [8, 8, 0, 0],
            "centre_distance": 150,
            "laws": ["4-5-6-7"],
        },
        {"conjugate": True, "follower": "oscillating", "laws": ["4-5-6-7", "table"], "table": ROWS},
    )
    refused = (
        ({"lifts": [5, 0]}, "lifts"),
        ({"angles": [120, 60, 120, 61]}, "angles"),
        ({"laws": ["table"]}, "table"),
        ({"laws": ["polynomial"], "polynomial": [0, 0, 1]}, "polynomial"),
        ({"offset": 47.9}, "offset"),
        ({"follower": "oscillating", "arm_length": 10, "centre_distance": 90}, "arm_length"),
        ({"follower": "oscillating", "contact": "flat", "centre_distance": 30}, "centre_distance"),
        (
            {
                "base_radius": 5,
                "bore": 0,
                "lifts": [30, 30, 0, 0],
                "angles": [50, 70, 120, 120],
                "roller_radius": 40,
            },
            "base_radius",
        ),
        ({"bore": 78}, "bore"),
        ({"pin_diameter": 18}, "pin_diameter"),
        ({"guide_length": 10}, "guide_length"),
        ({"contact": "flat", "base_radius": 5, "bore": 0}, "base_radius"),
        ({"conjugate": True, "bore": 0}, "bore"),
        ({"conjugate": True, "spring_rate": 3.0}, "spring_rate"),
    )
    variations: ClassVar = {
        "laws": [["modified-sine"]],
        "angles": [[110.0, 70.0, 120.0, 60.0]],
        "lifts": [[12.0, 12.0, 0.0, 0.0]],
        "swings": [[9.0, 9.0, 0.0, 0.0]],
        "polynomial": [[0, 0, 0, 10, -15, 6]],
        "table": [[[u, u * u * (3 - 2 * u)] for u in (n / 12 for n in range(13))]],
        "pressure_limit": [10.0],
        "face_offset": [14.0],
        "screws": [3],
        "spring": ["auto", "1.25x12.5x40", "1x10x50"],
    }
    requirements: ClassVar = {"size": ({"contact": "flat"}, {"offset": 2.0, "conjugate": True})}
    max_examples = tried(5, 40)

    def strategy(self):
        """Random cams near designs that can be built."""
        lifts = st.floats(2, 25).map(lambda lift: [lift, lift, 0.0, 0.0])
        common = {
            "base_radius": st.floats(15, 80),
            "laws": st.sampled_from([["cycloidal"], ["3-4-5"], ["modified-trapezoid", "simple-harmonic"]]),
            "turning": st.sampled_from(["ccw", "cw"]),
            "bore": st.floats(0, 20),
        }
        slide = {"lifts": lifts, "offset": st.floats(-30, 30), "conjugate": st.booleans()}
        flat = {"lifts": lifts, "contact": st.just("flat")}
        lever = {
            "follower": st.just("oscillating"),
            "swings": lifts,
            "arm_length": st.floats(30, 120),
            "centre_distance": st.floats(40, 200),
        }
        tilted = {
            "follower": st.just("oscillating"),
            "contact": st.just("flat"),
            "swings": lifts,
            "centre_distance": st.floats(40, 250),
        }
        return st.one_of(
            *(st.fixed_dictionaries({**common, **kind}) for kind in (slide, flat, lever, tilted))
        )
