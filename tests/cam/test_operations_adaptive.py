"""Adaptive clearing: engagement, coverage, and the proof of what it makes part of."""

import math
from functools import cache

import numpy as np
import pytest
import shapely
from by_control import posted, prove
from by_night import by_night, examples
from engagement import engagements
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, job, plate, rounded_box
from planning_simulation import check_rules

from mechwright.contracts.part import Pocket, Profile
from mechwright_cam.operations import engagement
from mechwright_cam.operations.clearing import COARSE_FROM
from mechwright_cam.operations.engagement import BENDS, clear, straight_layer
from mechwright_cam.operations.engagement import engagements as planned
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import FeedArc

MILL = LIBRARY.get("mill-8")
BOX = shapely.Polygon(rounded_box(32, 26, 6).flatten())
RING = BOX.difference(shapely.box(-2, -1, 2, 1))
TEE = shapely.union_all([shapely.box(-18, -6.5, 18, 6.5), shapely.box(-7, -15, 7, 0)])
BOUND = 5.0
"""Degrees by which the simulated engagement may exceed the set one."""


def recess(**changes):
    pocket = Pocket("recess", rounded_box(26, 18, 4), (), 0, 4)
    outside = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6)
    return job(plate(machined=(pocket, outside)), "mill-6", "mill-4", **changes)


def test_engagement_on_a_straight_front_is_the_closed_form():
    cleared = shapely.box(-50, -50, 50, 0)
    for angle in (30, 60, 90, 120):
        layer = straight_layer(4.0, math.radians(angle))
        way = np.array([[-1.0, layer - 4.0], [1.0, layer - 4.0]])
        # Stock above the way: on the left, from the outward normal forwards to where the front is crossed.
        found = math.degrees(planned(way, cleared, 4.0)[0])
        assert found == pytest.approx(min(angle, 90) if angle <= 90 else angle, abs=4)


@pytest.mark.parametrize("radius", [1.0, 4.0])
def test_what_is_worth_a_pass_goes_with_the_size_of_the_cutter(radius):
    """Squares of 0.02 radii squared and more; the cutter stands at the origin, and the nearest comes last."""
    clearing = engagement._Clearing(shapely.box(-50, -50, 50, 50), radius, math.radians(60), True)
    clearing.end = (0.0, 0.0)

    def square(area, x):
        half = math.sqrt(area) * radius / 2
        return shapely.box(x - half, -half, x + half, half)

    near, far, farther = square(0.021, 5.0), square(0.5, 20.0), square(0.03, -30.0)
    crumbs = [square(0.019, 6.0), square(0.001, 2.0)]
    assert clearing._nearest_last([near, farther, *crumbs, far]) == [farther, far, near]


@pytest.mark.parametrize("angle", [30, 60, 90, 120])
@pytest.mark.parametrize("hole", [4.5, 7.0, 30.0])
def test_a_layer_in_a_round_hole_engages_the_cutter_as_asked(angle, hole):
    """Of all the angle 85 % of the layer, for the spiral leans outwards: circles of hole and cutter cross there."""
    radius, turn = 4.0, math.radians(angle)
    layer = engagement._Clearing(BOX, radius, turn, True)._ring_layer(hole)
    away = hole + layer / 0.85 - radius
    crossing = complex(away + radius * math.cos(turn), radius * math.sin(turn))
    assert abs(crossing) == pytest.approx(hole, rel=1e-9) or layer == pytest.approx(0.03 * radius)


def test_engagement_in_a_slot_is_a_half_turn():
    assert math.degrees(planned(np.array([[0, 0], [1, 0]]), shapely.Polygon(), 4.0)[0]) >= 178


@pytest.mark.parametrize(
    ("area", "angle", "climb"),
    [
        (TEE, 60, True),
        (BOX, 100, False),
        *(
            pytest.param(*one, marks=by_night)
            for one in ((BOX, 60, True), (TEE, 100, False), (RING, 60, True), (RING, 100, False))
        ),
    ],
)
def test_engagement_stays_below_the_angle_and_all_that_is_roomy_is_cleared(area, angle, climb):
    cavities = clear(area, MILL, math.radians(angle), climb)
    bend = BENDS[-1] * MILL.radius
    roomy, cleared = area.buffer(-bend).buffer(bend), shapely.union_all([one.cleared for one in cavities])
    assert roomy.difference(cleared.buffer(0.05)).area < 0.02 * area.area
    for cavity in cavities:
        found = engagements(cavity, MILL.radius, area.bounds)
        assert found.max() <= angle + BOUND
        assert found.max() > angle / 2  # and is used


@settings(max_examples=examples(2, 8), deadline=None, suppress_health_check=list(HealthCheck))
@given(seed=st.integers(0, 10**6), angle=st.sampled_from([60, 80, 100]))
def test_engagement_in_random_areas(seed, angle):
    rng = np.random.default_rng(seed)
    turn = np.sort(rng.uniform(0, math.tau, 7))
    far = rng.uniform(9, 15, 7)
    area = shapely.Polygon(np.column_stack((far * np.cos(turn), far * np.sin(turn)))).buffer(0)
    area = max(shapely.get_parts(area.union(shapely.Point(0, 0).buffer(9))), key=lambda p: p.area)
    cavities = clear(area, MILL, math.radians(angle), True)
    assert cavities
    for cavity in cavities:
        assert engagements(cavity, MILL.radius, area.bounds, 32).max() <= angle + BOUND
        for one in cavity.passes:
            assert shapely.covers(
                area.buffer(COARSE_FROM), shapely.LineString(one.path.points(0.5)).buffer(MILL.radius)
            )


def test_an_area_too_narrow_to_turn_in_is_left():
    assert clear(shapely.box(0, 0, 40, 2.1 * MILL.radius), MILL, math.radians(60), True) == []


def test_adaptive_recess_is_proven():
    of = recess(clearing="adaptive")
    program = plan(of)
    names = [o.name for s in program.sections for o in s.operations]
    assert (
        names.index("recess: clear") < names.index("recess: rough the rest") < names.index("recess: finish")
    )
    proof = prove(posted(of, program), of)
    assert proof.ok, [check.message for check in proof.failures]
    check_rules(of, program)


@cache
def sections_of(**settings):
    return plan(recess(**settings)).sections


@pytest.mark.parametrize(
    "change", [{"engagement": 100}, {"adaptive_depth": 0.4}, {"clearing": "contour"}, {"climb": False}]
)
def test_every_key_of_adaptive_clearing_counts(change):
    base = {"clearing": "adaptive", "engagement": 80}
    assert sections_of(**base) != sections_of(**base | change)


def test_climb_turns_the_passes_round():
    def turns(climb):
        (moves,) = [
            o.moves
            for s in plan(recess(clearing="adaptive", engagement=90, climb=climb)).sections
            for o in s.operations
            if o.name == "recess: clear"
        ]
        return sum((1 if m.ccw else -1) for m in moves if isinstance(m, FeedArc))

    assert turns(True) * turns(False) < 0
