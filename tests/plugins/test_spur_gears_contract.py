"""The built-in family under the kit that third parties use."""

from typing import ClassVar

from by_night import examples as tried
from day_contract import DayContract
from hypothesis import strategies as st

from mechwright.testing.rates import assert_rates
from mechwright_spur_gears.family import SpurGears

SMALL = {"thickness": 4, "bore": 6}
RING = {"arrangement": "internal", "teeth": 15, "mate_teeth": 40, "module": 1.5}
SET = {
    "arrangement": "planetary",
    "teeth": 20,
    "mate_teeth": 17,
    "module": 1.5,
    "keyway_width": 2,
    "keyway_relief": 1.2,
    "pin_diameter": 6,
    "planet_spacing": "nearest",
}
RACK = {"arrangement": "rack", "teeth": 14, "module": 1.5, "travel": 40, "rack_hole": 4.5}

RACK_RATES = (
    ("theta1", "omega1"),
    ("omega1", "alpha1"),
    ("alpha1", "jerk1"),
    ("travel", "velocity"),
    ("velocity", "acceleration"),
    ("acceleration", "jerk"),
)


class TestSpurGears(DayContract):
    family = SpurGears
    ci: ClassVar = (
        "test_every_parameter_counts",
        "test_fixes_of_random_designs",
        "test_fixes_of_refused_designs",
        "test_tolerances_of_random_designs",
    )
    night: ClassVar = {
        name: {1, 2, 3, 4}
        for name in ("test_programs_are_proven", "test_no_interference", "test_solids", "test_drawings")
    }
    max_frames = tried(1, 40)
    derivatives = (("theta2", "omega2"),)
    input_rate = "omega1"
    examples = (
        {**SMALL, "teeth": 13, "mate_teeth": 24, "keyway_width": 2, "keyway_relief": 1.2},
        {**SMALL, "diametral_pitch": 12, "pressure_angle": 14.5, "teeth": 32, "mate_teeth": 33},
        {**SMALL, "teeth": 18, "mate_teeth": 25, "centre_distance": 44.5, "shift_rule": "equal-sliding"},
        {**SMALL, **RING},
        {**SMALL, **SET},
        {**SMALL, **RACK},
    )
    refused = (
        ({"teeth": 9, "shift": 0.0}, "shift"),
        ({"bore": 34.0}, "bore"),
        ({"centre_distance": 50.0}, "centre_distance"),
        ({"addendum": 0.5}, "addendum"),
        ({"arrangement": "internal", "teeth": 30, "mate_teeth": 36}, "mate_teeth"),
        ({**RING, "ring_outside": 66}, "ring_outside"),
        ({**RING, "ring_addendum": 1.1}, "addendum"),
        ({"ring_hole": 4}, "ring_hole"),
        ({**SET, "planets": 6}, "planets"),
        ({**SET, "ring_teeth": 58}, "ring_teeth"),
        ({"backlash": 0.0}, "backlash"),
        ({**RACK, "rack_teeth": 6}, "travel"),
        ({**RACK, "rack_addendum": 1.2}, "rack_addendum"),
        ({**RACK, "rack_height": 5}, "rack_height"),
        ({**RACK, "rack_holes": 9}, "rack_holes"),
        ({"travel": 40}, "travel"),
        ({"teeth": 9, "mate_teeth": 30, "shift": 0.84}, "addendum"),
    )
    variations: ClassVar = {
        "load_torque": [2.0],
        "teeth": [21],
        "mate_teeth": [41],
        "centre_distance": [60.5],
        "shift": [0.2],
        "mate_shift": [0.1],
        "backlash": [0.2],
        "arrangement": ["internal"],
        "ring_addendum": [0.6],
        "ring_outside": [190.0],
        "ring_holes": [5],
        "ring_hole": [6.6],
        "ring_teeth": [53],
        "planets": [4],
        "fixed_member": ["sun", "carrier"],
        "driving_member": ["carrier"],
        "pin_diameter": [8.0],
        "carrier_thickness": [5.0],
        "rack_teeth": [20],
        "travel": [30.0],
        "rack_addendum": [0.8],
        "rack_height": [12.0],
        "rack_holes": [1],
        "rack_hole": [3.0],
        "load_force": [50.0],
    }
    max_examples = tried(4, 30)

    def test_derivatives(self, design):
        """Each rate is the derivative of its quantity; a rack has others than gears."""
        if design.get("arrangement") == "rack":
            assert_rates(self._motion(design), RACK_RATES, "", ())
            return
        super().test_derivatives(design)

    def strategy(self):
        """Random pairs near designs that can be built."""
        return st.fixed_dictionaries(
            {
                "teeth": st.integers(12, 40),
                "mate_teeth": st.integers(12, 60),
                "module": st.floats(0.8, 4),
                "shift": st.floats(-0.2, 0.5),
                "thickness": st.floats(2, 20),
                "bore": st.floats(0, 12),
            }
        )
