"""Many five-bars at once against one after the other: what is decided by arrays is what the check finds."""

import numpy as np
import pytest
from by_night import examples, in_ci

from mechwright import Stage
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.contracts.refusals import refusals
from mechwright.testing.evaluation import assert_same
from mechwright_five_bar.evaluation import answer
from mechwright_five_bar.family import FiveBars
from mechwright_five_bar.many_masses import BODIES

pytestmark = in_ci

RANGES = {
    "crank": (8, 40), "arm": (8, 40), "coupler": (55, 120), "rocker": (55, 120), "ground": (60, 160),
    "arm_angle": (-180, 180), "coupler_point_x": (-10, 90), "coupler_point_y": (-40, 60), "pin_diameter": (6, 12),
    "clearance": (0.5, 4), "speed": (20, 600), "load_x": (-300, 300), "gear_thickness": (3, 12),
}  # fmt: skip
"""So wide that every error comes up."""

COLUMNS = (
    "least_transmission_angle", "greatest_transmission_angle", "alpha_c_max", "omega_r.greatest", "jerk_r.least",
    "yP.greatest", "ayP.least", "jxP.greatest", "transmission_angle.least", "time.greatest",
)  # fmt: skip


def many(count, content, seed=3):
    """Designs of one table, of both branches and both directions."""
    rng = np.random.default_rng(seed)
    varied = {name: rng.uniform(*ends, count) for name, ends in RANGES.items()}
    varied["branch"] = rng.choice(["open", "crossed"], count)
    varied["direction"] = rng.choice(["ccw", "cw"], count)
    return Batch(FiveBars.Params, content, varied)


@pytest.mark.parametrize("content", [{}, {"idler_teeth": 0, "crank_teeth": 30, "arm_teeth": 20}])
def test_it_says_what_the_check_and_the_motion_say(content):
    family, batch = FiveBars(), many(3000, content)
    told = refusals(batch)
    designs = Designs(told.common, told.values)
    with np.errstate(all="ignore"):
        said = answer(designs, (), Stage.PARTS)
    assert said is not None
    decided = np.flatnonzero(~said.undecided & told.known & (told.forbidden == 0))
    codes = np.array(said.codes)[said.forbidden[decided]]
    # Of each outcome some, and of those that are allowed most: there a bound could be wrong.
    some = [decided[codes == code][: examples(2, 12)] for code in said.codes if code]
    some.append(decided[codes == ""][: examples(3, 40)])
    assert {"", "five-bar.closure", "five-bar.bores"} <= set(said.codes)
    assert len(some[-1]) == examples(3, 40)
    places = np.concatenate(some)
    chosen = Batch(batch.model, content, {name: values[places] for name, values in batch.varied.items()})
    one = family.evaluate(chosen, COLUMNS, Stage.PARTS)
    assert_same(one, one_by_one(family.judge, family.solve, chosen, COLUMNS, Stage.PARTS))


PARTS = (
    "ground", "crank", "arm", "rocker", "coupler", "pinion", "idler", "wheel", "shaft-a0", "shaft-b0", "pin-a",
    "pin-b1", "pin-c", "pin-idler", "bushing", "bushing-2", "bushing-3", "post",
)  # fmt: skip
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
    family = FiveBars()
    rng = np.random.default_rng(2)
    ranges = {
        "crank": (14, 30),
        "arm": (14, 30),
        "coupler": (70, 120),
        "rocker": (70, 120),
        "ground": (95, 130),
    }
    varied = {name: rng.uniform(*ends, 60) for name, ends in ranges.items()}
    varied |= {"coupler_point_x": rng.uniform(-10, 90, 60), "gear_thickness": rng.choice([4.0, 6.0], 60)}
    designs = Designs(FiveBars.Params.model_validate(content), varied)
    with np.errstate(all="ignore"):
        said = answer(designs, MASSES, Stage.PARTS)
    assert said is not None
    allowed = said.left[: examples(6, 30)]
    assert allowed.size == examples(6, 30)
    some = Batch(FiveBars.Params, content, {name: values[allowed] for name, values in varied.items()})
    single = one_by_one(family.judge, family.solve, some, MASSES, Stage.PARTS, family.parts)
    assert_same(family.evaluate(some, MASSES), single)
    assert not set(MASSES) - set(said.values) - {"mass.idler", "mass.pin-idler", "mass.post", "mass_idler"}


def test_what_it_has_no_way_for_is_left_to_the_check():
    designs = Designs(FiveBars.Params(), {"crank_teeth": np.array([20, 30])})
    assert answer(designs, (), Stage.PARTS) is None
