"""Geneva as made: play against the exact tube, the lock, and what is said of parts that bind."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from as_made_builds import example, facts
from by_night import by_night

from mechwright.contracts.finding import Severity, Stage
from mechwright.tolerances import OFF_CENTRE
from mechwright_geneva.as_made.play import Play, drawn_room, made_room
from mechwright_geneva.as_made.slot import SAMPLES, Made, as_made
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.family import Geneva
from mechwright_geneva.rules.clearances import BINDING, LEAST_GROOVE, LEAST_LOCK

FAMILY = Geneva()
CURVED = FAMILY.Params(crank_half_angle=50, offset_angle=5, groove_clearance=0.05, lock_radius=70)
STRAIGHT = FAMILY.Params(
    slots=6, law="straight", entry_radius=80, roller_radius=4, groove_clearance=0.05, lock_radius=30
)
DESIGNS = {"G1": CURVED, "G2": STRAIGHT}


@pytest.mark.parametrize("name", DESIGNS)
def test_the_play_of_the_roller_is_that_of_the_exact_tube(name):
    m = mechanism_of(DESIGNS[name])
    cases = [fact for fact in facts("geneva.play_total") if fact["inputs"]["design"] == name]
    assert len(cases) > 12
    shares = np.radians([fact["inputs"]["theta_d_deg"] for fact in cases]) / (2 * m.crank_half)
    ahead, behind = Play.of(m.stroke(shares), drawn_room(m, 0.025)).turns()
    for fact, found in zip(cases, ahead + behind, strict=True):
        assert found == pytest.approx(fact["expected"], abs=fact["tolerance"]), fact["inputs"]


@pytest.mark.parametrize("name", DESIGNS)
def test_the_lock_is_the_reference(name):
    m = mechanism_of(DESIGNS[name])
    cases = [fact for fact in facts("geneva.lock_play_half") if fact["inputs"]["design"] == name]
    assert len(cases) == 3
    for fact in cases:
        off = fact["inputs"].get("centre_distance_error", 0.0)
        assert m.lock_play(m.arc, m.lock, off) == pytest.approx(fact["expected"], abs=fact["tolerance"])


def test_a_straight_slot_gives_way_as_its_closed_form_says():
    m = mechanism_of(STRAIGHT)
    for fact in facts("geneva.straight.dbeta_da"):
        theta = math.radians(fact["inputs"]["theta_d_deg"])
        if abs(theta - m.crank_half) < 1e-6:
            continue  # on the line of centres the wheel cannot give way
        run = m.stroke(np.array([theta / (2 * m.crank_half)]))
        turned = [Play.of(run, drawn_room(m, 0.025), off).start for off in (0.002, -0.002)]
        slope = float((turned[0] - turned[1])[0]) / 0.004
        # The wheel's angle is θw0 - β.
        assert slope == pytest.approx(-fact["expected"], rel=2e-3)


@pytest.mark.parametrize("name", DESIGNS)
def test_the_room_as_drawn_is_half_the_clearance_less_the_distance_from_the_way(name):
    m = mechanism_of(DESIGNS[name])
    run, room = m.stroke(np.array([0.15, 0.3])), drawn_room(m, 0.5)
    assert room((run.centre + 0.3 * m.slot_normal(run)) * run.to_wheel) == pytest.approx(0.2, abs=1e-12)
    if m.straight:
        assert room((m.bottom - 0.3) * np.exp(-1j * m.wheel_half)) == pytest.approx(0.2)
    else:
        outside = m.way(m.crank_half * np.array([-0.2, 2.2]))
        assert room(outside.track) == pytest.approx(0.5, abs=1e-12)


def test_the_wheel_rests_before_and_after_a_stroke():
    m = mechanism_of(STRAIGHT)
    outside, step = m.crank_half * np.array([-0.2, 2.2]), 1e-5
    run, before, after = (m.way(outside + move) for move in (0, -step, step))
    assert run.theta == pytest.approx([0, 2 * m.wheel_half])
    assert run.velocity == pytest.approx((after.centre - before.centre) / (2 * step))
    assert run.acceleration == pytest.approx((after.velocity - before.velocity) / (2 * step))


def test_each_slot_is_judged_in_its_own_place():
    one = Made(mechanism_of(CURVED), {})
    vars(one)["room"] = np.angle
    middles = [one.play(slot).here[SAMPLES // 2] for slot in (0, 1)]
    assert middles == pytest.approx([-one.m.wheel_half, one.m.wheel_half])


def test_walls_that_keep_stock_take_just_that_from_the_play():
    m = mechanism_of(STRAIGHT)
    way = np.linspace(m.bottom, 1.5 * m.rim, 4001)[:, None] * [
        [math.cos(m.wheel_half), -math.sin(m.wheel_half)]
    ]
    block = shapely.Point(0, 0).buffer(m.rim, quad_segs=4096)
    for left in (0.0, 0.01):
        material = shapely.difference(block, shapely.LineString(way).buffer(m.groove - left, quad_segs=2048))
        material = shapely.segmentize(material, 0.05)
        run = m.stroke(np.array([0.2, 0.35, 0.5]))
        ahead, behind = Play.of(run, made_room(material, m.roller)).turns()
        expected = (0.025 - left) / np.abs(run.centre)
        assert ahead == pytest.approx(expected, rel=2e-3)
        assert behind == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("name", [pytest.param("geneva-straight", marks=by_night), "geneva-cycloidal"])
def test_the_examples_run_as_made(name):
    _, said, params = example(name)
    assert not said.findings
    found = {figure.name: figure for figure in said.figures}
    room = found["slot.room"]
    assert 0 < room.low < room.made < room.design == params.groove_clearance / 2
    lock = found["lock.clearance"]
    assert lock.asked == OFF_CENTRE < lock.low < lock.made < lock.design
    turn = found["lock.play"]
    assert turn.low < turn.made < turn.design < turn.high
    error = found["wheel.error"]
    assert error.low < error.made < error.design < error.high
    (curve,) = said.curves
    assert set(curve.lines) == {"as drawn", "as made", "in the worst case"}


def test_parts_that_bind_are_refused_with_a_clearance_that_works():
    parts, _, params = example("geneva-straight")
    made = {part.name: [part] for part in parts}
    # The same walls with a larger roller, and a thicker path: what a smaller clearance would leave.
    tight = params.model_copy(update={"roller_radius": params.roller_radius + 0.038})
    one = Made(mechanism_of(tight), made)
    assert one.play().here.min() == pytest.approx(
        Made(mechanism_of(params), made).play().here.min() - 0.038, abs=1e-3
    )
    wide = {name: [replace(part, corridor=0.05) for part in copies] for name, copies in made.items()}
    found = {finding.parameter: finding for finding in as_made(params, wide).findings}
    assert set(found) == {"groove_clearance", "lock_clearance"}
    groove, lock = found["groove_clearance"], found["lock_clearance"]
    assert (groove.severity, groove.stage) == (Severity.ERROR, Stage.MACHINING)
    assert "binds in slot" in groove.message
    assert groove.value < 0
    assert "leaves 0.00" in groove.remedy
    assert lock.severity in (Severity.ERROR, Severity.WARNING)


@pytest.mark.parametrize("parameter", ["groove_clearance", "lock_clearance"])
def test_clearances_that_bind_are_said_before_anything_is_cut(parameter):
    least = {"groove_clearance": LEAST_GROOVE, "lock_clearance": LEAST_LOCK}[parameter]
    lowest = {"groove_clearance": 0.0, "lock_clearance": 0.005}[parameter]

    def about(value):
        params = FAMILY.Params(**{parameter: value})
        return [f for f in FAMILY.check(params) if f.code == "geneva.clearance"]

    assert not about(least)
    (warning,) = about(0.9 * least)
    assert (warning.severity, warning.limit, warning.stage) == (Severity.WARNING, least, Stage.MACHINING)
    (worst,) = about(lowest)
    assert worst.severity is (Severity.ERROR if lowest < BINDING else Severity.WARNING)
    assert f"{least:g}" in worst.remedy
