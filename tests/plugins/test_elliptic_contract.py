"""The built-in family under the kit that third parties use."""

from typing import ClassVar

from by_night import examples
from day_contract import DayContract
from hypothesis import strategies as st

from mechwright.testing.strategies import tables
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.parameters import TRAIN_ONLY

QUICK = {"designs": 1, "starts": 1}


class TestEllipticGears(DayContract):
    family = EllipticGears
    night: ClassVar = {
        # The pair and the train of one phase are examples that are machined, and the plates of a clamp are in the
        # tests of the joint. Of a train with a clamp or pins no body meets another in those tests either, and of
        # one without in those of the example.
        "test_programs_are_proven": {0, 3, 4, 5},
        "test_no_interference": {3, 4, 5},
        # One with a clamp or pins has all solids of a train of one phase.
        "test_solids": {3},
    }
    nights: ClassVar = ("test_synthesis",)
    max_frames = examples(8, 50)
    examples = (
        {},
        {"module": 2, "teeth": 39},
        {"bore": 16, "keyway_width": 5, "keyway_depth": 2.4, "keyway_relief": 2},
        {"stages": 2, "bore": 12, "phase": 70, "tracer_diameter": 4, "screw_hole": 6},
        {"stages": 2, "bore": 12, "phase_joint": "pins", "phases": [20, 100], "phase": 20},
        {"stages": 2, "bore": 12, "phase_joint": "clamp", "clamp_screw": 4, "clamp_screws": 4},
    )
    refused = (
        ({"teeth": 13}, "teeth"),
        ({"tooth_offset": 0.3}, "tooth_offset"),
        ({"bore": 60}, "bore"),
        ({"band": -1}, "band"),
        ({"point_along": 1.5}, "point_along"),
        ({"stages": 2, "point_across": 80}, "point_across"),
        ({"stages": 2, "eccentricity": 0.1}, "eccentricity"),
        ({"phase": 30}, "phase"),
        ({"stages": 2, "phase_joint": "pins", "phase": 30}, "phase"),
    )
    derivatives = (
        ("theta2", "omega2"),
        ("theta4", "omega4"),
        ("omega4", "alpha4"),
        ("alpha4", "jerk4"),
        ("Q.x", "Q.velocity.x"),
        ("Q.velocity.y", "Q.acceleration.y"),
        ("Q.acceleration.x", "Q.jerk.x"),
    )
    input_rate = "omega2"
    variations: ClassVar = {
        "screw_offset": (100,),
        "phases": ((20, 150),),
        "clamp_screw": (3,),
        "clamp_screws": (5,),
    }
    requirements: ClassVar = {
        "longest-window": (QUICK,),
        "least-acceleration": (QUICK,),
        "least-jerk": (QUICK,),
    }

    def strategy(self):
        """Tables as they come, without a train's fields where there is one pair."""

        def settle(table):
            if table.get("stages", 1) == 2:
                fixed = table.get("phase_joint") in {None, "fixed"}
                out = {"phases"} if fixed else set()
                out |= {"dowel_diameter", "dowel_circle"} if table.get("phase_joint") == "clamp" else set()
                return {name: value for name, value in table.items() if name not in out}
            return {name: value for name, value in table.items() if name not in TRAIN_ONLY}

        return tables(EllipticGears.Params).flatmap(lambda table: st.just(settle(table)))
