"""Tables of five-bars against one design after the other: codes, figures and masses."""

import numpy as np
import pytest
from by_night import examples, in_ci

from mechwright import Stage
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.testing.evaluation import assert_same
from mechwright_five_bar.family import FiveBars

pytestmark = in_ci

RANGES = {
    "crank": (8, 40), "arm": (8, 40), "coupler": (55, 120), "rocker": (55, 120), "ground": (60, 160),
    "arm_angle": (-180, 180), "coupler_point_x": (-10, 90), "coupler_point_y": (-40, 60), "pin_diameter": (6, 12),
    "clearance": (0.5, 4), "speed": (20, 600), "load_x": (-300, 300), "gear_thickness": (3, 12),
}  # fmt: skip
"""So wide that every error comes up."""

COLUMNS = (
    "least_transmission_angle", "greatest_transmission_angle", "alpha_c_max", "omega_r.greatest", "jerk_r.least",
    "yP.greatest", "ayP.least", "jxP.greatest", "transmission_angle.least", "time.greatest", "turns", "swing_to",
)  # fmt: skip


def many(count, content, seed=3, left_out=()):
    """Designs of both branches and both directions."""
    rng = np.random.default_rng(seed)
    varied = {name: rng.uniform(*ends, count) for name, ends in RANGES.items() if name not in left_out}
    varied["branch"] = rng.choice(["open", "crossed"], count)
    varied["direction"] = rng.choice(["ccw", "cw"], count)
    return Batch(FiveBars.Params, content, varied)


def some_of(batch, places):
    return Batch(batch.model, batch.content, {name: values[places] for name, values in batch.varied.items()})


PHASES = {"setting_angle": 30.0, "phases": [{"crank_turn": 20, "rocker_turn": 8}]}


@pytest.mark.parametrize(
    ("content", "left_out", "codes"),
    [
        ({}, (), {"", "five-bar.closure", "five-bar.bores"}),
        ({"idler_teeth": 0, "crank_teeth": 30, "arm_teeth": 20}, (), {"", "five-bar.bores"}),
        ({"swing_from": 20.0, "swing_to": 80.0}, (), {"", "five-bar.swing"}),
        ({"module": 1.5}, ("gear_thickness",), {"", "five-bar.closure"}),
        (PHASES, ("pin_diameter",), {"", "five-bar.setting"}),
        ({**PHASES, "phase": 2}, ("pin_diameter",), {"", "five-bar.setting"}),
    ],
    ids=["idler", "pair", "swing", "module", "phases", "phase 2"],
)
def test_it_says_what_the_check_and_the_motion_say(content, left_out, codes):
    family, batch = FiveBars(), many(400, content, left_out=left_out)
    found = family.evaluate(batch, (), Stage.PARTS)
    said = np.array(found.codes)[found.forbidden]
    assert codes <= set(said)
    # Of each outcome some, and of those that are allowed most: there a bound could be wrong.
    places = [
        np.flatnonzero(said == code)[: examples(2, 12) if code else examples(3, 40)] for code in set(said)
    ]
    chosen = some_of(batch, np.concatenate(places))
    one = family.evaluate(chosen, COLUMNS, Stage.PARTS)
    assert_same(one, one_by_one(family.judge, family.solve, chosen, COLUMNS, Stage.PARTS))


@pytest.mark.parametrize("name", ["rocker", "load_x", "pivot_y"])
def test_one_parameter_may_differ_that_moves_neither_crank_nor_arm(name):
    """The distance of crank and arm is then one number for all designs of the table."""
    family, values = FiveBars(), {"rocker": (60.0, 82.0, 95.0), "load_x": (0.0, 5.0), "pivot_y": (0.0, 7.0)}
    batch = Batch(FiveBars.Params, {}, {name: np.array(values[name])})
    one = one_by_one(family.judge, family.solve, batch, COLUMNS, Stage.PARTS)
    assert_same(family.evaluate(batch, COLUMNS, Stage.PARTS), one)


PARTS = (
    "ground", "crank", "arm", "rocker", "coupler", "pinion", "idler", "wheel", "shaft-a0", "shaft-b0", "pin-a",
    "pin-b1", "pin-c", "pin-idler", "bushing", "bushing-2", "bushing-3", "post",
)  # fmt: skip
BODIES = ("mass_crank", "mass_coupler", "mass_rocker", "mass_arm", "mass_idler")
MASSES = ("mass", *(f"mass.{part}" for part in PARTS), *BODIES)


@pytest.mark.parametrize(
    "content",
    [
        {},
        {"idler_teeth": 0, "crank_teeth": 30, "arm_teeth": 20, "screw_hole": 5, "bushing_wall": 0},
        {"material": "steel", "thickness": 6, "ground_thickness": 6, "web_width": 9, "post_offset": 4},
    ],
)
def test_masses_are_those_of_the_parts(content):
    family, rng = FiveBars(), np.random.default_rng(2)
    ranges = {
        "crank": (14, 30),
        "arm": (14, 30),
        "coupler": (70, 120),
        "rocker": (70, 120),
        "ground": (95, 130),
    }
    varied = {name: rng.uniform(*ends, 60) for name, ends in ranges.items()}
    varied |= {"coupler_point_x": rng.uniform(-10, 90, 60), "gear_thickness": rng.choice([4.0, 6.0], 60)}
    batch = Batch(FiveBars.Params, content, varied)
    allowed = np.flatnonzero(family.evaluate(batch, ()).forbidden == 0)[: examples(6, 30)]
    assert allowed.size == examples(6, 30)
    some = some_of(batch, allowed)
    single = one_by_one(family.judge, family.solve, some, MASSES, Stage.PARTS, family.parts)
    assert_same(family.evaluate(some, MASSES), single)
