"""Plates that move past each other: what collides is found, what touches does not collide."""

import math

import numpy as np
import pytest
import shapely
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Bore, Instance, Part, Pocket, Profile
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright_cad.interference import interference, plates
from mechwright_cad.interference.path import Path
from mechwright_cad.interference.slabs import SURE_IN_PLAN, TOUCH, Circle, Slab

TURN = np.linspace(0, math.tau, 181)
STILL = Poses.planar(0.0, 0.0, np.zeros(181))


def motion(**poses):
    return Motion(
        "theta2", {"theta2": Channel(TURN, "rad")}, {name.replace("_", "-"): p for name, p in poses.items()}
    )


def plate(name, outer, *inner, body=None, z=0.0, thickness=5.0, machined=()):
    return Part(
        name, Outline(outer, inner), thickness, "steel", (Instance(body or name, z),), machined=machined
    )


def box(x0, y0, x1, y1):
    return Loop.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def disc(radius, centre=(0.0, 0.0)):
    return Loop((circle(centre, radius),))


def hole(radius, centre=(0.0, 0.0)):
    return Loop((circle(centre, radius, clockwise=True),))


def spin(radius=0.0, phase=0.0, turns=1.0):
    return Poses.planar(radius * np.cos(TURN), radius * np.sin(TURN), turns * TURN + phase)


def test_a_pin_without_clearance_turns_in_its_bore():
    for radius in (0.5, 3.0, 40.0):
        lug = plate("lug", box(-50, -50, 50, 50), hole(radius))
        pin = plate("pin", disc(radius))
        for turning in (
            motion(lug=STILL, pin=spin()),
            motion(lug=spin(), pin=STILL),
            motion(lug=spin(30), pin=spin(30, turns=-2)),
        ):
            report = interference([lug, pin], turning)
            assert report.clear, report.collisions
            assert report.pairs == 1


def test_a_pin_that_is_too_thick_is_found_at_every_size():
    for radius in (0.5, 3.0, 40.0):
        lug, pin = plate("lug", box(-50, -50, 50, 50), hole(radius)), plate("pin", disc(radius + 0.02))
        (hit,) = interference([lug, pin], motion(lug=STILL, pin=spin())).collisions
        assert hit.depth == pytest.approx(0.02, abs=0.002)
        assert math.hypot(*hit.at[:2]) == pytest.approx(radius, abs=0.05)


def test_a_block_without_clearance_slides_in_its_guide():
    guide = plate("guide", box(-60, -30, 60, 30), Loop.polygon([(-50, -10), (-50, 10), (50, 10), (50, -10)]))
    block = plate("block", box(-20, -10, 20, 10))
    slide = Poses.planar(30 * np.cos(TURN), 0.0, np.zeros(181))
    assert interference([guide, block], motion(guide=STILL, block=slide)).clear
    skewed = Poses.planar(30 * np.cos(TURN), 0.0, np.full(181, 0.002))
    (hit,) = interference([guide, block], motion(guide=STILL, block=skewed)).collisions
    assert hit.depth == pytest.approx(20 * math.sin(0.002) - 10 * (1 - math.cos(0.002)), abs=1e-3)
    wide = Poses.planar(30.05 * np.cos(TURN), 0.0, np.zeros(181))
    (hit,) = interference([guide, block], motion(guide=STILL, block=wide)).collisions
    assert hit.depth == pytest.approx(0.05, abs=1e-3)
    assert hit.instant.value % math.pi == pytest.approx(
        0, abs=0.02
    ) or hit.instant.value % math.pi == pytest.approx(math.pi, abs=0.02)


def test_a_pin_slides_in_a_slot_of_its_own_width():
    slot = Loop.polygon([(-40, -4), (-40, 4), (40, 4), (40, -4)])
    yoke, pin = plate("yoke", box(-60, -30, 60, 30), slot), plate("pin", disc(4))
    cross = Poses.planar(0.0, 25 * np.sin(TURN), np.zeros(181))
    assert interference([yoke, pin], motion(yoke=cross, pin=spin(25))).clear
    (hit,) = interference([yoke, plate("pin", disc(4.03))], motion(yoke=cross, pin=spin(25))).collisions
    assert hit.depth == pytest.approx(0.03, abs=0.002)


def test_plates_on_each_other_touch_and_pressed_into_each_other_do_not():
    low, high = plate("low", box(0, 0, 50, 50)), plate("high", box(0, 0, 50, 50), z=5.0)
    assert interference([low, high], motion(low=STILL, high=spin())).clear
    sunk = plate("high", box(0, 0, 50, 50), z=4.95)
    (hit,) = interference([low, sunk], motion(low=STILL, high=spin())).collisions
    assert hit.depth == pytest.approx(0.05, abs=1e-9)


def bump(height):
    """A disc of radius 20 with a bump one degree long."""
    outer = [(20 * math.cos(a), 20 * math.sin(a)) for a in np.radians(np.arange(1.0, 360.0, 0.25))]
    outer += [
        (r * math.cos(a), r * math.sin(a))
        for r, a in ((20 + height, math.radians(-0.5)), (20 + height, math.radians(0.5)))
    ]
    return Loop.polygon(outer)


@pytest.mark.parametrize("phase", [0.0, 0.1, 0.9, 1.0, 1.7])
def test_a_bump_of_a_fiftieth_of_a_millimetre_is_found_between_samples(phase):
    # Samples are 2 degrees apart; the bump passes the corner of the stop within a degree or so.
    wheel = plate("wheel", bump(0.03))
    stop = plate("stop", Loop.polygon([(20.01, 0), (25, -1), (25, 1)]))
    turning = motion(wheel=spin(phase=math.radians(phase)), stop=STILL)
    (hit,) = interference([stop, wheel], turning).collisions
    assert hit.depth == pytest.approx(0.02, abs=0.001)
    (hit,) = interference([wheel, stop], turning).collisions
    assert {hit.first, hit.second} == {"wheel", "stop"}
    assert hit.depth == pytest.approx(0.02, abs=0.001)
    met = math.degrees(hit.instant.value) + phase
    assert abs((met + 180) % 360 - 180) < 1.01
    assert str(hit.instant) == f"theta2 = {math.degrees(hit.instant.value):.3f} deg"
    assert interference([plate("wheel", bump(0.005)), stop], turning).clear


def test_the_gap_of_a_clear_mechanism_is_measured():
    cam = plate("cam", disc(20, (3.0, 0.0)))
    wall = plate("wall", box(23.25, -50, 30, 50))
    report = interference([cam, wall], motion(cam=spin(), wall=STILL))
    assert report.clear
    assert report.closest is not None
    assert report.closest.distance == pytest.approx(0.25, abs=0.01)
    assert math.cos(report.closest.instant.value) == pytest.approx(1, abs=1e-3)


def test_what_lies_inside_is_found():
    big, small = plate("big", box(-50, -50, 50, 50)), plate("small", box(-2, -1, 2, 1))
    for parts in ([big, small], [small, big]):
        (hit,) = interference(parts, motion(big=STILL, small=spin(10))).collisions
        assert hit.depth == pytest.approx(5.0)
    thick = plate("big", box(-50, -50, 50, 50), thickness=80), plate("small", box(-2, -1, 2, 1), thickness=80)
    (hit,) = interference(thick, motion(big=STILL, small=spin(10))).collisions
    assert hit.depth > 40  # the least way out is longer than that
    twin = plate("twin", box(-50, -50, 50, 50))
    (hit,) = interference([big, twin], motion(big=STILL, twin=STILL)).collisions
    assert hit.depth == pytest.approx(5.0)  # the thickness: less than the hundred of the plan view


def test_parts_of_one_body_must_not_overlap_but_may_touch():
    plate_ = plate("plate", box(0, 0, 40, 40), body="frame")
    beside = plate("beside", box(40, 0, 60, 40), body="frame")
    assert interference([plate_, beside], motion(frame=spin(20))).clear
    over = plate("over", box(39.9, 0, 60, 40), body="frame")
    (hit,) = interference([plate_, over], motion(frame=spin(20))).collisions
    assert (hit.first, hit.second) == ("frame-plate", "frame-over")
    assert hit.depth == pytest.approx(0.1, abs=0.06)


def test_a_recess_makes_room_to_its_depth():
    recess = Pocket("recess", box(-10, -30, 10, 30), (), 0, 3.0)  # open at the rim
    outside = Profile("outside", box(-30, -20, 30, 20), "outside", 0, 5.0)
    base = plate("base", box(-30, -20, 30, 20), machined=(recess, outside))
    slide = Poses.planar(0.0, 40 * np.cos(TURN), np.zeros(181))
    rider = plate("rider", box(-10, -5, 10, 5), z=2.0)
    assert interference([base, rider], motion(base=STILL, rider=slide)).clear
    (hit,) = interference(
        [base, plate("rider", box(-10, -5, 10, 5), z=1.9)], motion(base=STILL, rider=slide)
    ).collisions
    assert hit.depth == pytest.approx(0.1, abs=1e-6)
    counterbore = plate(
        "base",
        box(-30, -20, 30, 20),
        hole(3),
        machined=(Bore("seat", (0.0, 0.0), 12, 0, 2.0), Bore("bore", (0.0, 0.0), 6, 0, 5.0), outside),
    )
    head, shank = plate("head", disc(6), z=3.0), plate("shank", disc(3), z=-5.0, thickness=8.0)
    assert interference([counterbore, head, shank], motion(base=STILL, head=spin(), shank=spin())).clear
    assert not interference(
        [counterbore, plate("head", disc(6), z=2.9)], motion(base=STILL, head=spin())
    ).clear


def test_plates_face_to_face_are_compared_in_one_plane():
    flip = np.diag((1.0, -1.0, -1.0))
    turned = Poses(np.tile((0.0, 0.0, 8.0), (181, 1)), spin().rotation @ flip)
    arm = Loop.polygon([(0, 0), (30, 0), (30, 4), (0, 4)])  # not symmetric: mirrored it lies elsewhere
    low = plate("low", box(20, -10, 40, -1))
    for thickness, clear in ((2.0, True), (4.0, False)):
        report = interference([low, plate("arm", arm, thickness=thickness)], motion(low=STILL, arm=turned))
        assert report.clear is clear
    still = Poses(np.tile((0.0, 0.0, 8.0), (181, 1)), np.tile(flip, (181, 1, 1)))
    assert not interference([low, plate("arm", arm, thickness=4.0)], motion(low=STILL, arm=still)).clear
    upper = plate("low", box(20, 1, 40, 10))
    assert interference([upper, plate("arm", arm, thickness=4.0)], motion(low=STILL, arm=still)).clear


def test_an_instance_of_no_body_is_refused():
    with pytest.raises(GeometryError, match=r"instance of body 'ghost', .* it has wheel"):
        interference([plate("ghost", disc(3)), plate("wheel", disc(3))], motion(wheel=STILL))


def test_a_motion_of_two_samples_is_checked_too():
    two = Motion(
        "s",
        {"s": Channel(np.array([0.0, 10.0]), "mm")},
        {
            "a": Poses.planar(0.0, 0.0, np.zeros(2)),
            "b": Poses.planar(np.array([-20.0, 20.0]), 0.0, np.zeros(2)),
        },
    )
    (hit,) = interference([plate("a", box(-1, -1, 1, 1)), plate("b", box(-1, 0.5, 1, 3))], two).collisions
    assert hit.depth == pytest.approx(0.5, abs=0.02)
    assert str(hit.instant).startswith("s = 5") or str(hit.instant).startswith("s = 4")


# Against brute force: thousands of poses, each compared by itself.


@st.composite
def shapes(draw):
    """A star-shaped polygon, convex or not, with or without a hole."""
    radii = draw(st.lists(st.floats(3, 12), min_size=3, max_size=9))
    angles = np.linspace(0, math.tau, len(radii), endpoint=False) + draw(st.floats(0, 1))
    outer = [(r * math.cos(a), r * math.sin(a)) for r, a in zip(radii, angles, strict=True)]
    inside = min(radii) * math.cos(math.pi / max(len(radii), 3)) * 0.6
    inner = (hole(inside),) if draw(st.booleans()) and inside > 0.5 else ()
    return Outline(Loop.polygon(outer), inner)


@st.composite
def movements(draw):
    x0, y0 = draw(st.floats(-25, 25)), draw(st.floats(-25, 25))
    ax, ay = draw(st.floats(-12, 12)), draw(st.floats(-12, 12))
    turns, swing = draw(st.sampled_from([-2, -1, 0, 1, 3])), draw(st.floats(0, 1))
    first, second = draw(st.sampled_from([1, 2, 3])), draw(st.sampled_from([1, 2]))

    def at(t):
        return Poses.planar(
            x0 + ax * np.cos(first * t), y0 + ay * np.sin(second * t), turns * t + swing * np.sin(t)
        )

    return at


@settings(max_examples=examples(8, 40))
@given(shapes(), shapes(), movements(), movements())
def test_random_plates_agree_with_brute_force(one, two, first, second):
    parts = [
        Part(name, outline, 3.0, "pom", (Instance(name),)) for name, outline in (("one", one), ("two", two))
    ]
    report = interference(parts, motion(one=first(TURN), two=second(TURN)))
    t = np.linspace(0, math.tau, 541)
    a, b = _moved(one.polygon(), first(t)), _moved(two.polygon(), second(t))
    common = shapely.intersection(a, b)
    if not report.clear:
        (hit,) = report.collisions
        at = np.array([hit.instant.value])
        a, b = _moved(one.polygon(), first(at)), _moved(two.polygon(), second(at))
        assert shapely.intersects(a, b).all()
        assert hit.depth > 0
        return
    # A circle of SURE_IN_PLAN inside the overlap would be a collision that nobody may miss.
    thick = shapely.buffer(common, -SURE_IN_PLAN)
    assert shapely.is_empty(thick).all()
    if report.closest is not None:
        at = np.array([report.closest.instant.value])
        a, b = _moved(one.polygon(), first(at)), _moved(two.polygon(), second(at))
        assert shapely.distance(a, b)[0] == pytest.approx(report.closest.distance, abs=0.01)


@settings(max_examples=examples(8, 40))
@given(shapes(), shapes(), movements(), movements())
def test_random_plates_that_collide_are_as_deep_as_brute_force_says(one, two, first, second):
    parts = [
        Part(name, outline, 3.0, "pom", (Instance(name),)) for name, outline in (("one", one), ("two", two))
    ]
    report = interference(parts, motion(one=first(TURN), two=second(TURN)))
    if report.clear:
        return
    t = np.linspace(0, math.tau, 181)
    depth = max(
        min(_depth(a, b), 3.0)
        for a, b in zip(_moved(one.polygon(), first(t)), _moved(two.polygon(), second(t)), strict=True)
    )
    assert report.collisions[0].depth >= 0.9 * depth - TOUCH


def _moved(polygon, poses):
    return np.array(
        [
            shapely.transform(polygon, lambda p, r=r, d=d: p @ r[:2, :2].T + d[:2])
            for r, d in zip(poses.rotation, poses.position, strict=True)
        ]
    )


def _depth(a, b):
    """Greatest distance of points of one boundary inside the other from its boundary; on a fixed fine grid."""
    best = 0.0
    for p, q in ((a, b), (b, a)):
        line = shapely.intersection(p.boundary, q)
        points = shapely.points(shapely.get_coordinates(shapely.segmentize(line, 0.2)))
        if points.size:
            best = max(best, shapely.distance(points, q.boundary).max())
    return best


def test_a_slab_turned_over_lies_as_deep_as_it_stood_and_is_its_own_mirror_image():
    wedge = shapely.Polygon([(0, 0), (4, 0), (0, 1)])
    over = Slab(wedge, 1.5, 4.0).face_down()
    assert (over.bottom, over.top) == (-4.0, -1.5)
    assert over.polygon.equals(shapely.Polygon([(0, 0), (4, 0), (0, -1)]))
    assert over.polygon.exterior.is_ccw
    again = over.face_down()
    assert (again.bottom, again.top) == (1.5, 4.0)
    assert again.polygon.equals(wedge)


@pytest.mark.parametrize(
    ("height", "hits"), [(9.0, True), (10.5, False), (-4.5, False), (0.5, False), (1.5, True)]
)
def test_a_plate_turned_over_meets_what_is_at_its_height(height, hits):
    """A plate from 5 to 10 mm above its origin, face down: it fills what lies 5 to 10 mm below it."""
    still = np.zeros(181)
    flat = plate("flat", box(-9, -9, 9, 9), thickness=4.0, z=-4.0)
    over = plate("over", box(-9, -9, 9, 9), z=5.0)
    turned = Poses(
        np.column_stack((still, still, still + height)), np.tile(np.diag((1.0, -1.0, -1.0)), (181, 1, 1))
    )
    report = interference([flat, over], motion(flat=STILL, over=turned))
    assert bool(report.collisions) is hits


def test_two_circles_that_slide_past_each_other_meet_while_their_rims_cross():
    """Of 2 and 1 mm, half a millimetre a sample: their rims cross from 3 mm apart to 1 mm, on either side."""
    way = np.column_stack((np.linspace(-10.0, 10.0, 41), np.zeros(41)))
    found = plates._circles(Circle(np.zeros(2), 2.0), Circle(np.zeros(2), 1.0), Path(way, np.zeros((41, 1))))
    away = np.abs(-10.0 + 0.5 * found.hits)
    assert ((away >= 1.0 - 1e-9) & (away <= 3.0 + 1e-9)).all()
    assert {int(time) for time in found.hits} >= {14, 15, 16, 17, 22, 23, 24, 25}
    beside = Path(way + np.array([0.0, 3.2]), np.zeros((41, 1)))
    found = plates._circles(Circle(np.zeros(2), 2.0), Circle(np.zeros(2), 1.0), beside)
    assert found.hits.size == 0
    assert found.gap == pytest.approx(0.2, abs=0.01)
