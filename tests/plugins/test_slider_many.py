"""Many slider-cranks at once are what each is by itself."""

from dataclasses import replace

import numpy as np
import pytest
from by_night import in_ci
from many import Many

from mechwright import Stage
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.table_evaluation import tables
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.parts.layers import ORDER, bounds_of, measure, rooms_of
from mechwright_slider_crank.rules.loads import bears

pytestmark = in_ci

FAMILY = SliderCrankFamily()
MANY = Many(FAMILY)
ENDS = ("least", "greatest")
POINT = [f"{rate}{axis}P.{end}" for rate in ("", "v", "a", "j") for axis in "xy" for end in ENDS]
SLIDER = [
    f"{name}.{end}"
    for name in ("s", "v", "a", "jerk", "sigma", "omega_c", "alpha_c", "jerk_c", "transmission_angle")
    for end in ENDS
]
FIGURES = [
    "stroke", "time_ratio", "phi_far", "phi_near", "s_far", "s_near", "least_transmission_angle", "v_max", "a_max",
    "time.greatest", "omega_a.least", "alpha_a.greatest", "swing_from", "swing_to", "input_range", "toggle_low",
    "toggle_high",
]  # fmt: skip

PARTS = (
    "base", "rail", "crank", "rod", "slider", "shaft", "crank-pin", "wrist-pin", "dowel", "spacer", "bushing",
    "shaft-bushing",
)  # fmt: skip
BALANCES = (
    "balance_rod_x", "balance_rod_y", "balance_crank_x", "balance_crank_y", "balance_rod_weight",
)  # fmt: skip
BODIES = ("mass_crank", "mass_rod", "mass_slider")
MASSES = ["mass", *(f"mass.{part}" for part in PARTS), *BODIES, *BALANCES]


def table_of(batch):
    """The table of a batch of one structure."""
    ((_, params),) = tables(Designs(batch.common, batch.varied), (), ())
    return FAMILY.table(params, len(batch))


@pytest.mark.parametrize(
    "content",
    [
        {},
        {"rail_overhang": 25, "bushing": 0, "pin": 5},
        {"thickness": 6, "gap": 1, "clearance": 3, "material": "steel"},
        {"clearance": 0.2, "slider_width": 30, "shaft": 9, "rail": 16},
    ],
)
def test_masses_are_those_of_the_parts(content):
    """Crank and slider in one layer, or not, with heads on the pins or without, on usual rails or longer ones."""
    batch = MANY.drawn(16, content, crank=(15, 60), rod=(60, 200), offset=(-40, 40))
    found = MANY.same(batch, MASSES, Stage.PARTS)
    assert (found.forbidden == 0).sum() > 5
    assert not MANY.alone


def test_the_order_of_dealings_is_that_of_the_layers():
    assert ORDER == ((1, 2, 1), (2, 1, 2), (2, 3, 1), (3, 2, 1), (1, 3, 2), (3, 1, 2), (1, 2, 3), (2, 1, 3))


@pytest.mark.parametrize("content", [{}, {"rail_overhang": 12}])
def test_layers_and_figures(content):
    """Rails are longer where the layers need it, or as long as they are said to be."""
    batch = MANY.drawn(14, content, crank=(15, 60), rod=(60, 200), offset=(-40, 40))
    found = MANY.same(batch, SLIDER + FIGURES, Stage.PARTS)
    assert ("slider-crank.layers" in found.counts) == bool(content)
    assert not MANY.alone


def test_levers_of_both_assemblies():
    batch = MANY.drawn(
        14, {"slide_direction": 40}, crank=(10, 60), rod=(10, 60), offset=(-110, 110),
        assembly=["ahead", "behind"], clockwise=[True, False],
    )  # fmt: skip
    found = MANY.same(batch, SLIDER + POINT + FIGURES, Stage.MOTION)
    assert "slider-crank.closure" in found.counts
    assert not MANY.alone


def test_accelerating_cranks_and_sizes_that_are_given():
    batch = MANY.drawn(
        14, {"acceleration_ratio": 0.05, "coupler_x": 10}, crank=(8, 30), rod=(60, 150), pin=(2, 12), wall=(1, 5),
        rail=(2, 20), slider_length=(4, 40),
    )  # fmt: skip
    found = MANY.same(batch, POINT + FIGURES, Stage.PARTS)
    assert {"slider-crank.crank-web", "slider-crank.rail-web"} & set(found.counts)
    assert not MANY.alone


def test_what_tears_is_forbidden():
    batch = MANY.drawn(
        6, {"load": 20000, "thickness": 2}, crank=(15, 30), rod=(120, 200), material=["pom", "steel"]
    )
    found = MANY.same(batch, ["a_max"], Stage.PARTS)
    assert "slider-crank.eye" in found.counts


@pytest.mark.parametrize("content", [{"crank_shape": "arm"}, {"rod_bend": 3}, {"screw_hole": 5}])
def test_other_shapes_are_judged_as_each_is(content):
    MANY.same(MANY.drawn(2, content, crank=(15, 25)), ["a_max", "mass_rod", "mass"], Stage.PARTS)


def test_bounds_of_rooms_hold_the_rooms_and_leave_few_open():
    table = table_of(MANY.drawn(400, {}, crank=(15, 60), rod=(60, 200), offset=(-40, 40)))
    rooms = bounds_of(table, table.dimensions, rods=True)
    blocked, free = rooms.blocked, rooms.free
    assert not (blocked & free).any()
    assert rooms.known().mean() > 0.99
    for place in range(6):
        none = np.zeros_like(blocked)
        exact = replace(rooms, blocked=none.copy(), free=none.copy())
        measure(table, place, exact)
        assert (exact.blocked[place] ^ exact.free[place]).all()
        assert not (blocked[place] & exact.free[place]).any()
        assert not (free[place] & exact.blocked[place]).any()


def test_bounds_and_measured_rooms_decide_all_layers():
    rooms = rooms_of(table_of(MANY.drawn(60, {}, crank=(15, 60), rod=(60, 200), offset=(-40, 40))))
    assert rooms.known().all()


def test_an_unloaded_one_bears_for_sure_and_an_overloaded_one_does_not():
    for load, sure in ((0.0, True), (1e6, False)):
        assert (bears(table_of(MANY.drawn(5, {"load": load}, crank=(15, 25)))) == sure).all()
