"""Turned copies of a feature are cleared by one plan, turned; and only true copies are."""

import math

import numpy as np
import pytest
import shapely
from by_control import posted, prove
from by_night import examples
from engagement import engagements
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, job, part, rounded_box

from mechwright.contracts.part import Pocket, Profile
from mechwright.geometry import Loop
from mechwright_cam.operations import engagement
from mechwright_cam.operations.congruent import Copies, Turn, same, turn_between
from mechwright_cam.operations.engagement import clear
from mechwright_cam.planning import plan
from mechwright_plane.offsets import ROUGH

MILL = LIBRARY.get("mill-6")
HOOK = [(6.0, -4.0), (18.0, -4.0), (18.0, 9.0), (10.0, 9.0), (10.0, 4.0), (6.0, 4.0)]
ANGLE = math.radians(80)


def turned(points, degrees, shift=(0.0, 0.0)):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [(c * x - s * y + shift[0], s * x + c * y + shift[1]) for x, y in points]


def pocket(points, depth=3.0, islands=()):
    return Pocket("p", Loop.polygon(points), tuple(Loop.polygon(i) for i in islands), 0, depth)


@given(degrees=st.floats(-180, 180), x=st.floats(-200, 200), y=st.floats(-200, 200))
def test_the_turn_of_a_copy_is_found(degrees, x, y):
    turn = turn_between(pocket(HOOK), pocket(turned(HOOK, degrees, (x, y))))
    assert turn is not None
    assert abs(turn.by) == pytest.approx(1)
    np.testing.assert_allclose(turn.points(np.array(HOOK)), turned(HOOK, degrees, (x, y)), atol=1e-9)


def test_what_is_no_copy_is_none():
    mirrored = [(x, -y) for x, y in HOOK]
    longer = [(x + (1e-4 if x > 15 else 0), y) for x, y in HOOK]
    for other in (pocket(mirrored), pocket(longer), pocket(HOOK, depth=2), pocket(HOOK[1:])):
        assert turn_between(pocket(HOOK), other) is None
    hole = [(12.0, 0.0), (12.0, 1.0), (13.0, 1.0)]
    assert turn_between(pocket(HOOK, islands=[hole]), pocket(HOOK, islands=[turned(hole, 1)])) is None
    assert turn_between(pocket(HOOK, islands=[hole]), pocket(HOOK, islands=[hole])) is not None
    # The same corners, and one edge bent: what is compared is the whole outline.
    bent = Pocket("p", rounded_box(20, 12, 3), (), 0, 3)
    assert turn_between(bent, Pocket("p", rounded_box(20, 12, 3.001), (), 0, 3)) is None
    assert turn_between(bent, bent) is not None


def test_areas_are_the_same_up_to_their_chords():
    disc = shapely.Point(0, 0).buffer(9, quad_segs=64)
    assert same(disc, shapely.Point(0, 0).buffer(9, quad_segs=50))
    assert not same(disc, disc.buffer(3 * ROUGH))
    assert not same(disc, disc.difference(shapely.box(-0.5, -10, 0.5, 10)))
    assert not same(disc, shapely.Polygon())
    assert same(shapely.Polygon(), shapely.Polygon())


@settings(max_examples=examples(1, 3), deadline=None)
@given(degrees=st.floats(-180, 180))
def test_a_turned_plan_is_as_good_as_one_of_its_own(degrees):
    area = shapely.Polygon(rounded_box(22, 16, 5).flatten())
    turn = Turn(complex(math.cos(math.radians(degrees)), math.sin(math.radians(degrees))), 30 - 7j)
    (own,) = clear(area, MILL, ANGLE, True)
    copy = turn.cavity(own)
    place = turn.shape(area)
    assert engagements(copy, MILL.radius, place.bounds, 32).max() <= math.degrees(ANGLE) + 5
    assert copy.cleared.area == pytest.approx(own.cleared.area)
    for one, other in zip(own.passes, copy.passes, strict=True):
        assert other.path.length == pytest.approx(one.path.length, rel=1e-3, abs=1e-3)
        swept = shapely.LineString(other.path.points(0.5)).buffer(MILL.radius)
        assert shapely.covers(place.buffer(0.04), swept)
        here = other.path.start
        for cut in other.path.cuts:
            if cut.turn:
                assert math.dist(here, (cut.cx, cut.cy)) == pytest.approx(
                    math.dist((cut.x, cut.y), (cut.cx, cut.cy)), abs=1e-9
                )
            here = (cut.x, cut.y)


def wheel(count, extra=()):
    """A plate with pockets around its middle, each a turned copy of the first."""
    first = [(9.0, -5.0), (23.0, -5.0), (23.0, 5.0), (9.0, 5.0)]
    pockets = [
        Pocket(f"slot-{i}", Loop.polygon(turned(first, 360 / count * i)), (), 0, 3) for i in range(count)
    ]
    outside = Profile("outside", rounded_box(80, 80, 6), "outside", 0, 6)
    of = part(rounded_box(80, 80, 6), machined=(*pockets, *extra, outside))
    return job(of, "mill-6", "mill-3", clearing="adaptive", engagement=90)


@pytest.fixture
def planned(monkeypatch):
    """Areas that are cleared by a plan of their own."""
    areas = []

    def counted(area, *rest):
        areas.append(area)
        return engagement.clear(area, *rest)

    monkeypatch.setattr("mechwright_cam.operations.congruent.clear", counted)
    return areas


def test_five_slots_are_planned_once_and_proven(planned):
    of = wheel(5)
    program = plan(of)
    assert len(planned) == 1
    names = [o.name for s in program.sections for o in s.operations]
    assert [name for name in names if name.endswith("clear")] == [f"slot-{i}: clear" for i in range(5)]
    proof = prove(posted(of, program), of)
    assert proof.ok, [check.message for check in proof.failures]


def test_a_slot_that_runs_into_another_feature_has_a_plan_of_its_own(planned):
    crossing = Pocket("crossing", Loop.polygon([(20, 3), (30, 3), (30, 12), (20, 12)]), (), 0, 3)
    of = wheel(4, (crossing,))
    program = plan(of)
    assert len(planned) >= 2
    proof = prove(posted(of, program), of)
    assert proof.ok, [check.message for check in proof.failures]


def test_another_mill_means_another_plan(planned):
    area, one = shapely.Polygon(rounded_box(13, 12, 4).flatten()), pocket(HOOK)
    copies = Copies()
    asked = ((one, MILL), (one, LIBRARY.get("mill-4")), (one, MILL))
    found = [copies.clear(feature, area, mill, ANGLE, True) for feature, mill in asked]
    assert len(planned) == 2
    assert [len(cavities) for cavities in found] == [1, 1, 1]


def test_shapes_that_all_but_touch_stay_valid_when_they_are_moved():
    rng = np.random.default_rng(5)
    turn = Turn(1.0 + 0j, 0.1 + 39.4j)
    crossed = 0
    for _ in range(300):
        end = rng.uniform(2, 9, 2)
        # The tip of one lies on the edge of the other, to the last digit.
        tip = end * rng.uniform(0.2, 0.8)
        out = np.array((-end[1], end[0])) / np.hypot(*end)
        one = shapely.Polygon([(0, 0), end, end - 3 * out])
        pair = shapely.MultiPolygon([one, shapely.Polygon([tip, tip + out + 0.3 * end, tip + out])])
        if not pair.is_valid:
            continue
        moved = turn.shape(pair)
        crossed += not shapely.transform(pair, turn.points).is_valid
        assert moved.is_valid
        assert moved.area == pytest.approx(pair.area)
        assert shapely.union_all([moved, shapely.box(-1, 38, 1, 41)]).is_valid
    assert crossed > 10, "else the test would tell nothing"
