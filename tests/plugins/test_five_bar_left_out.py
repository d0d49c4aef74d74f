"""Gears of five-bars that a design leaves out follow from its module and from what their teeth carry."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright import GeometryError, Severity, Stage
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.standards.stock import is_sold, plate_within
from mechwright.testing.evaluation import assert_same
from mechwright_five_bar.defaults.complete_parameters import CompleteParams
from mechwright_five_bar.defaults.face_width import MOST_MODULES
from mechwright_five_bar.defaults.teeth import modules
from mechwright_five_bar.family import FiveBars
from mechwright_five_bar.kinematics.train import gear_outlines, train_of
from mechwright_five_bar.rules.gears import require_gears
from mechwright_five_bar.rules.strength import root_stresses
from mechwright_five_bar.table import FiveBarTable

FAMILY = FiveBars()


def errors_of(params):
    return [one for one in FAMILY.judge(params) if one.severity is Severity.ERROR]


@settings(deadline=None, max_examples=40)
@given(share=st.floats(0.15, 1.65), ground=st.floats(110.0, 170.0))
def test_teeth_reach_over_the_ground_with_any_module_that_some_reach_with(share, ground):
    """Gears of 100, 200 and 200 teeth are the finest, of 18, 18 and 36 the coarsest with the usual ratio."""
    found = CompleteParams(module=share * ground / 50, ground=ground, gear_thickness=8)
    finest, coarsest = modules(ground, 100, 200, 200)[0], modules(ground, 18, 18, 36)[1]
    assert found.ratio == 0.5
    if finest <= found.module <= coarsest:
        places = train_of(found).places
        assert abs(places["wheel"]) == pytest.approx(ground)
        assert abs(places["idler"]) == pytest.approx(
            found.module * (found.crank_teeth + found.idler_teeth) / 2
        )
    else:
        with pytest.raises(GeometryError, match="module"):
            require_gears(FiveBarTable.of(found))


@pytest.mark.parametrize(
    ("given", "teeth"),
    [
        ({}, (20, 20, 40)),
        ({"module": 1}, (42, 42, 84)),
        ({"module": 2}, (21, 21, 42)),
        ({"module": 3}, (20, 20, 40)),
        ({"module": 1, "idler_teeth": 0}, (70, 0, 140)),
        ({"module": 1, "crank_teeth": 30}, (30, 70, 40)),
        ({"module": 1, "crank_teeth": 30, "idler_teeth": 0}, (30, 0, 180)),
        ({"module": 1, "crank_teeth": 30, "idler_teeth": 30}, (30, 30, 40)),
    ],
)
def test_teeth_that_are_given_stay_and_the_others_fill_the_ground(given, teeth):
    found = CompleteParams(**given)
    assert (found.crank_teeth, found.idler_teeth, found.arm_teeth) == teeth


def test_a_module_that_no_teeth_suit_gets_the_nearest_that_they_do():
    [wrong] = errors_of(CompleteParams(module=4))
    assert wrong.parameter == "module"
    near = wrong.proposed[0]["parameters.module"]
    assert near == 3.5
    assert not errors_of(CompleteParams(module=near))


@pytest.mark.parametrize("given", [{"coupler": 20.5}, {"arm": 60}, {"load_y": -1500}])
def test_gears_are_as_wide_as_their_teeth_want(given):
    usual, found = CompleteParams(**given, gear_thickness=8), CompleteParams(**given)
    assert max(one.used for one in root_stresses(FiveBarTable.of(usual))) > 1
    assert 8 < found.gear_thickness <= MOST_MODULES * train_of(found).module
    assert is_sold(found.gear_thickness, found.material)
    used = max(one.used for one in root_stresses(FiveBarTable.of(found)))
    assert used <= 1 or found.gear_thickness == plate_within(
        MOST_MODULES * train_of(found).module, found.material
    )
    assert used > 0.7, "the next thinner plate that is sold would not do"
    assert not errors_of(found)
    chosen = [one.message for one in FAMILY.check(found) if one.code == "five-bar.chosen"]
    assert chosen == [f"defaults chosen for this design: gear_thickness = {found.gear_thickness:g}"]


def test_many_have_gears_as_wide_as_each_by_itself():
    batch = Batch(CompleteParams, {}, {"load_y": np.array([-2000.0, -700.0, 0.0, 300.0])})
    columns = ("mass",)
    found = FAMILY.evaluate(batch, columns)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, batch, columns, Stage.PARTS, FAMILY.parts))
    heavy, loaded, bare, light = found.values["mass"]
    assert heavy > loaded
    assert [bare, light] == pytest.approx([loaded, loaded], rel=1e-6)


@pytest.mark.parametrize("name", ["pinion", "idler", "wheel"])
def test_much_backlash_leaves_tips_of_a_tenth_of_the_module(name):
    table = {"crank_teeth": 18, "idler_teeth": 60, "arm_teeth": 18 if name == "pinion" else 36, "backlash": 0}
    train = train_of(CompleteParams(**table))
    with pytest.raises(
        GeometryError, match=r"backlash: 2 mm take the tips .* use at most ([\d.]+) mm"
    ) as told:
        require_gears(FiveBarTable.of(CompleteParams(**{**table, "backlash": 2})))
    most = float(re.search(r"at most ([\d.]+) mm", str(told.value))[1])
    params = CompleteParams(**{**table, "backlash": most})
    assert "five-bar.gears" not in [one.code for one in errors_of(params)]
    points = gear_outlines(params)[name].flatten()
    tip = points[np.abs(np.abs(points @ [1, 1j]) - train.tip(name)) < 1e-6]
    land = 2 * np.abs(tip[np.abs(np.angle(tip @ [1, 1j])) < math.pi / train.teeth[name]][:, 1]).max()
    assert land > 0.0999 * train.module
    if name == "pinion":
        assert land == pytest.approx(0.1 * train.module, rel=0.02)
