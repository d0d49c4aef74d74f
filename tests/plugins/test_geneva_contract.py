"""The built-in family under the kit that third parties use."""

from typing import ClassVar

from by_night import examples
from day_contract import DayContract
from hypothesis import strategies as st

from mechwright.mechanics.laws import LAWS
from mechwright_geneva.family import Geneva


def rows(name, count=21):
    law = LAWS[name]()
    return [[k / (count - 1), float(law.at(k / (count - 1)).s)] for k in range(count)]


SMALL = {
    "entry_radius": 60,
    "roller_radius": 3,
    "pin_diameter": 3,
    "least_wall": 1.2,
    "thickness": 5,
    "floor": 1.5,
    "crank_thickness": 4,
    "bore": 8,
    "driver_bore": 6,
    "fixing": 2.5,
    "material": "aluminium",
}
"""Small and soft: quick to machine."""


class TestGeneva(DayContract):
    family = Geneva
    night: ClassVar = {
        # The first has more that is cut than the second, of the same kinds; the third stands on islands.
        "test_programs_are_proven": {0},
        "test_solids": {1},
        "test_no_interference": {0},
    }
    max_frames = examples(8, 50)
    examples = (
        {
            **SMALL,
            "law": "polynomial",
            "polynomial": [0, 0, 0, 10, -15, 6],
            "hub_diameter": 24,
            "hub_height": 4,
            "keyway_width": 2,
            "keyway_relief": 1.2,
            "driver_law": "harmonic",
            "driver_variation": 0.05,
            "driver_direction": "backwards",
        },
        {
            **SMALL,
            "slots": 6,
            "law": "straight",
            "entry_radius": 70,
            "driver_keyway_width": 2,
            "counterbore_diameter": 16,
            "counterbore_depth": 2,
            "driver_law": "from-rest",
            "driver_acceleration": 10,
        },
        {
            **SMALL,
            "law": "table",
            "table": rows("modified-sine"),
            "offset_angle": -12.5,
            "crank_half_angle": 45,
            "construction": "backed",
            "fixing": 1.5,
        },
    )
    refused = (
        ({"crank_half_angle": 80}, "crank_half_angle"),
        ({"offset_angle": 0}, "offset_angle"),
        (
            {"roller_radius": 7, "crank_half_angle": 50, "offset_angle": 5, "entry_radius": 100},
            "roller_radius",
        ),
        ({"bore": 60, "crank_half_angle": 50, "offset_angle": 5}, "roller_radius"),
        ({"construction": "through"}, "construction"),
        ({"law": "polynomial", "polynomial": [0, 1]}, "polynomial"),
        ({"law": "table", "table": [[0, 0], [1, 1]]}, "table"),
        ({"law": "table"}, "table"),
        ({"lock_radius": 90}, "lock_radius"),
        ({"floor": 9.8}, "floor"),
        ({"rollers": 4, "crank_half_angle": 50}, "rollers"),
        ({"driver_law": "accelerating", "driver_acceleration": -4}, "driver_acceleration"),
        ({"driver_acceleration": 4}, "driver_acceleration"),
        ({"driver_law": "harmonic"}, "driver_variation"),
    )
    variations: ClassVar = {
        "polynomial": [[0, 0, 0, 0, 35, -84, 70, -20]],
        "table": [rows("cycloidal")],
        "load_torque": [0.5],
        "counterbore_radius": [1.0],
        "counterbore_side": ["underside"],
    }
    requirements: ClassVar = {"indexing": ({"laws": ["cycloidal"], "designs": 2},)}
    max_examples = 15

    def strategy(self):
        """Random tables near designs that can be built, and any others."""
        near = st.fixed_dictionaries(
            {
                "slots": st.integers(3, 8),
                "law": st.sampled_from([*LAWS, "straight"]),
                "roller_radius": st.floats(0.5, 8),
                "entry_radius": st.floats(40, 150),
                "pin_diameter": st.floats(0.5, 8),
                "bore": st.floats(0, 20),
                "driver_bore": st.floats(0, 12),
            },
            optional={
                "groove_clearance": st.floats(0, 0.5),
                "rollers": st.integers(1, 3),
                "lock_radius": st.floats(5, 150),
                "lock_clearance": st.floats(0.01, 0.5),
                "least_wall": st.floats(0.5, 4),
                "thickness": st.floats(1, 30),
                "construction": st.sampled_from(["auto", "blind", "backed", "through"]),
                "floor": st.floats(0.5, 6),
                "keyway_width": st.sampled_from([0, 3, 4, 5]),
                "hub_diameter": st.floats(0, 60),
                "fixing": st.floats(0, 6),
                "load_torque": st.floats(0, 10),
            },
        )
        angles = st.fixed_dictionaries(
            {}, optional={"crank_half_angle": st.floats(20, 75), "offset_angle": st.floats(-20, 20)}
        )
        return st.builds(lambda one, two: {**one, **({} if one["law"] == "straight" else two)}, near, angles)
