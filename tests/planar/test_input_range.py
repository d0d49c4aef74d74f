"""Limits of the input: closed forms, the reference, thin gaps, change points, groups without a closed form."""

import copy
import math
import random

import numpy as np
import pytest
from reference_machines import FIGURES, LINKAGES, machine_of

from mechwright.errors import KinematicsError
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.input_range import ranges, usable
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Pose, Prismatic, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.reach import reach


def four_bar(a, b, c, f):
    joints = [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("A", "crank", "coupler", a + 0j, 0j),
        Revolute("B", "coupler", "rocker", b + 0j, c + 0j),
        Revolute("B0", "ground", "rocker", f + 0j, 0j),
    ]
    return Machine(joints, [Drive("crank")])


def apart(one, two):
    """Difference of two angles, whole turns aside."""
    return abs(math.remainder(one - two, math.tau))


def agrees(found, expected, tolerance):
    """Whether the intervals are these, in any order and by whole turns."""
    if expected and expected[0][1] - expected[0][0] >= math.tau:
        return found.turns_fully
    if found.turns_fully or len(found.intervals) != len(expected):
        return False
    return all(
        any(
            apart(one.low, low) < tolerance and abs((one.high - one.low) - (high - low)) < tolerance
            for one in found.intervals
        )
        for low, high in expected
    )


def some_four_bars(count):
    """Four-bars of all kinds; every fifth is a parallelogram, a kite or another with a change point."""
    rng = random.Random(3)  # noqa: S311
    for number in range(count):
        a, b, c, f = (rng.uniform(20, 100) for _ in range(4))
        if number % 5 == 4:
            m, n = rng.randint(20, 90), rng.randint(20, 90)
            a, b, c, f = rng.choice([(m, n, m, n), (m, m, n, n), (m, n, n, m), (m, n, m + 7, n + 7)])
        yield FourBar(a, b, c, f)


@pytest.mark.parametrize("least", [0.0, math.radians(1), math.radians(20)])
def test_four_bars_reach_as_far_as_their_family_says(least):
    kinds = set()
    for bar in some_four_bars(300):
        kinds.add(str(bar.kind))
        found = ranges(four_bar(*bar.lengths), least)
        assert agrees(found, reach(bar, least), 1e-10), (bar, found)
        if not least:
            a, b, c, f = bar.lengths
            in_line = a + f == b + c or abs(a - f) == abs(b - c)
            assert bool(found.change_points) == (in_line and bool(found.intervals)), bar
    assert len(kinds) == 7


def test_change_points_of_four_bars_are_where_all_bars_line_up():
    parallelogram = ranges(four_bar(30.0, 80.0, 30.0, 80.0))
    assert parallelogram.turns_fully
    assert [one.kind for one in parallelogram.change_points] == ["folded", "stretched"]
    assert [one.joint for one in parallelogram.change_points] == ["B", "B"]
    values = sorted(abs(math.remainder(one.value, math.tau)) for one in parallelogram.change_points)
    assert values == pytest.approx([0.0, math.pi], abs=1e-7)
    kite = ranges(four_bar(30.0, 30.0, 80.0, 80.0))
    assert [one.kind for one in kite.change_points] == ["folded", "stretched"]
    assert all(one.change_point for one in kite.change_points)


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9])
def test_a_thin_gap_is_found_and_so_is_a_thin_interval(gap):
    """D = a + f is longer than b + c at the far side of the crank alone; D = f - a is shorter at the near side."""
    a, b, c = 30.0, 80.0, 70.0
    wide = FourBar(a, b, c, b + c - a + gap)
    expected = reach(wide)
    found = ranges(four_bar(*wide.lengths))
    assert agrees(found, expected, 1e-13 / math.sqrt(gap / 100))
    assert 0 < math.tau - (found.intervals[0].high - found.intervals[0].low) < 2 * math.sqrt(gap)
    narrow = FourBar(a, b, c, a + b + c - gap)
    assert agrees(ranges(four_bar(*narrow.lengths)), reach(narrow), 1e-13 / math.sqrt(gap / 100))


def test_the_reference_turns_or_has_these_limits():
    for name, figures in FIGURES["ranges"].items():
        if name == "tangent":
            continue  # turns on paper: its lines are parallel twice, where its pin is at infinity
        found = ranges(machine_of(LINKAGES[name]))
        assert found.turns_fully == figures["turns_fully"], name
        assert not found.turns_fully or not figures["edges"]
        ends = {
            "opens": [one.low for one in found.intervals],
            "closes": [one.high for one in found.intervals],
        }
        if not found.turns_fully:
            assert 2 * len(found.intervals) == len(figures["edges"])
            for kind, value in figures["edges"]:
                assert min(apart(end, value) for end in ends[kind]) < 1e-12, name


def test_the_reference_s_exact_limits():
    chebyshev = ranges(machine_of(LINKAGES["chebyshev"])).intervals
    assert [chebyshev[1].low, chebyshev[1].high] == pytest.approx(
        [math.acos(4 / 5), math.acos(-1 / 5)], abs=1e-14
    )
    (roberts,) = ranges(machine_of(LINKAGES["roberts"])).intervals
    assert [roberts.low, roberts.high] == pytest.approx([-math.acos(1 / 8), math.acos(1 / 8)], abs=1e-14)
    (inversor,) = ranges(machine_of(LINKAGES["peaucellier"])).intervals
    assert [inversor.low, inversor.high] == pytest.approx(
        [-2 * math.acos(55 / 80), 2 * math.acos(55 / 80)], abs=1e-14
    )
    published = ranges(machine_of(LINKAGES["stephenson3_published"])).intervals
    assert [published[1].low, published[1].high] == pytest.approx(
        [-1.0279803750832, 0.72090094918603], abs=1e-12
    )
    # Two groups close there: the second one from the drawn pose on, the first one in the interval that it never reaches.
    assert [published[1].low_limit.joint, published[1].high_limit.joint] == ["F:EF/FG", "F:EF/FG"]
    assert published[0].high_limit.joint == "C:BCE/CD"


def stephenson_with(link5):
    linkage = copy.deepcopy(LINKAGES["stephenson3"])
    linkage["links"]["link5"]["Q"] = [link5, 0.0]
    return machine_of(linkage)


def test_the_second_loop_of_a_six_bar_leaves_a_gap():
    (found,) = ranges(stephenson_with(35.0)).intervals
    assert found.high == pytest.approx(3.96243959883747, abs=1e-13)
    assert found.low + math.tau == pytest.approx(4.87852588991669, abs=1e-13)
    assert found.high_limit.joint == found.low_limit.joint == "Q:link5/link6"
    assert found.high_limit.kind == "stretched"
    assert found.high_limit.value == found.high


def test_a_gap_of_the_second_loop_between_two_samples_is_found():
    """The gap is as wide as one likes with the length of the rod at which it opens."""

    def least_closing(link5):
        return ranges(stephenson_with(link5)).turns_fully

    low, high = 35.0, 75.0
    for _ in range(35):
        middle = (low + high) / 2
        low, high = (low, middle) if least_closing(middle) else (middle, high)
    (found,) = ranges(stephenson_with(low - 1e-7)).intervals
    assert 1e-5 < math.tau - (found.high - found.low) < 1e-3


def test_usable_is_where_no_transmission_angle_is_less():
    machine = stephenson_with(35.0)
    (whole,), (part,) = ranges(machine).intervals, usable(machine).intervals
    assert whole.low < part.low < part.high < whole.high
    sines = solve(machine, [Turning.of(np.linspace(part.low, part.high, 5000))]).sines
    least = np.minimum.reduce(list(sines.values()))
    assert [least[0], least[-1]] == pytest.approx([math.sin(TURN_BACK)] * 2, abs=1e-12)
    assert least.min() >= math.sin(TURN_BACK) - 1e-12
    # A change point parts what is usable.
    assert len(usable(four_bar(30.0, 80.0, 30.0, 80.0)).intervals) == 2


def test_an_inversor_folds_where_its_outer_joints_meet():
    """OB reaches √(OA² - AB²) = 89.303: B and D meet, and the rhombus is a line."""
    linkage = copy.deepcopy(LINKAGES["peaucellier"])
    linkage["links"]["ground"]["Q"], linkage["links"]["crank"]["B"] = [45, 0], [45, 0]
    found = ranges(machine_of(linkage))
    meet = 2 * math.acos(math.sqrt(100**2 - 45**2) / 90)
    assert [one.value for one in found.change_points] == pytest.approx([-meet, meet], abs=1e-7)
    assert {one.joint.split(":")[0] for one in found.change_points} == {"D"}
    (interval,) = found.intervals
    assert interval.high == pytest.approx(2 * math.acos(55 / 90), abs=1e-12)


def slider_crank(crank, rod, offset, *, slotted=False):
    if slotted:  # the block slides in a lever with an offset line
        tail = [
            Revolute("B0", "ground", "lever", rod + 0j, 0j),
            Prismatic("slot", "lever", "block", offset * 1j, 0j),
        ]
        return Machine(
            [
                Revolute("A0", "ground", "crank", 0j, 0j),
                Revolute("A", "crank", "block", crank + 0j, 0j),
                *tail,
            ],
            [Drive("crank")],
        )
    joints = [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("A", "crank", "rod", crank + 0j, 0j),
        Revolute("B", "rod", "ram", rod + 0j, 2j),
        Prismatic("guide", "ground", "ram", (offset - 2) * 1j, 0j),
    ]
    return Machine(joints, [Drive("crank")])


def test_a_rod_that_is_too_short_stops_the_crank_where_it_is_square_to_the_slide():
    """|offset - crank sin φ| = rod."""
    found = ranges(slider_crank(50.0, 40.0, 5.0))
    assert agrees(
        found,
        [
            (-math.asin(35 / 50), math.asin(45 / 50)),
            (math.pi - math.asin(45 / 50), math.pi + math.asin(35 / 50)),
        ],
        1e-13,
    )
    assert found.intervals[0].low_limit.kind == "square to the slide"


def test_a_slotted_lever_stops_where_the_distance_is_the_offset():
    """|50 e^{iφ} - 55| = 20; without an offset the pin passes over the lever's pivot where 50 = 55 - 5."""
    (found,) = ranges(slider_crank(50.0, 55.0, 20.0, slotted=True)).intervals
    end = math.acos((50**2 + 55**2 - 20**2) / (2 * 50 * 55))
    assert [found.low, found.high] == pytest.approx([end, math.tau - end], abs=1e-12)
    assert found.low_limit.joint == "slot"
    over = ranges(slider_crank(50.0, 50.0, 0.0, slotted=True))
    assert over.turns_fully
    assert [(one.joint, one.value) for one in over.change_points] == [("slot", pytest.approx(0.0, abs=1e-7))]


def test_parallel_slides_end_what_the_input_reaches():
    intervals = ranges(machine_of(LINKAGES["tangent"])).intervals
    assert len(intervals) == 2
    assert all(one.high - one.low == pytest.approx(math.pi, abs=1e-12) for one in intervals)
    assert {one.high_limit.kind for one in intervals} == {"parallel slides"}
    short = usable(machine_of(LINKAGES["tangent"]), 0.1).intervals
    assert all(one.high - one.low == pytest.approx(math.pi - 0.2, abs=1e-12) for one in short)


def geared_five_bar(arm):
    """Two cranks that gears turn 1:-2, two bars of ``arm`` between them."""
    joints = [
        Revolute("A0", "ground", "one", 0j, 0j),
        Revolute("B0", "ground", "two", 100 + 0j, 0j),
        GearPair("gears", "one", "two", "ground", -0.5, 0.4),
        Revolute("A", "one", "left", 40 + 0j, 0j),
        Revolute("B", "two", "right", 30 + 0j, 0j),
        Revolute("C", "left", "right", arm + 0j, arm + 0j),
    ]
    return Machine(joints, [Drive("one")])


def test_gears_are_gone_through_till_they_come_back():
    """The bars stretch where |100 + 30 e^{i(0.4 - φ/2)} - 40 e^{iφ}| = 2 · 60: over two turns of the input."""
    machine = geared_five_bar(60.0)
    found = ranges(machine)
    phi = np.linspace(0, 2 * math.tau, 400001)

    def distance(phi):
        return np.abs(100 + 30 * np.exp(1j * (0.4 - phi / 2)) - 40 * np.exp(1j * phi))

    crossings = phi[:-1][np.diff(distance(phi) < 120).astype(bool)]
    ends = [end for one in found.intervals for end in (one.low, one.high)]
    assert len(ends) == len(crossings)
    assert distance(np.array(ends)) == pytest.approx(120.0, abs=1e-10)
    for end in ends:
        assert np.min(np.abs(np.remainder(end, 2 * math.tau) - crossings)) < 1e-4
    (whole,) = ranges(geared_five_bar(150.0)).intervals
    assert whole.high - whole.low == 2 * math.tau


def boom(drawn_at=60.0):
    joints = [
        Revolute("O", "ground", "boom", 0j, 0j),
        Revolute("C", "ground", "tube", 100.0, 0j),
        Revolute("D", "boom", "bar", 80.0, 0j),
        Prismatic("slide", "tube", "bar", 5 + 0j, -3 + 0j),
    ]
    angle = np.arccos((80.0**2 + 100.0**2 - (drawn_at + 8) ** 2) / (2 * 80.0 * 100.0))
    end = 80.0 * np.exp(1j * angle)
    along = np.angle(end - 100.0)
    drawn = {"boom": Pose(0j, angle), "tube": Pose(100 + 0j, along), "bar": Pose(end, along)}
    return Machine(joints, [Drive("bar", "tube")], {}, drawn, [drawn_at])


def test_the_stroke_of_a_cylinder_between_moving_links():
    """The cylinder is 8 mm longer than its slide, and 100 - 80 to 100 + 80 mm long."""
    (found,) = ranges(boom()).intervals
    assert [found.low, found.high] == pytest.approx([12.0, 172.0], abs=1e-9)
    assert found.low_limit.kind == "dead point"
    (bounded,) = ranges(boom(), bounds=(30.0, 500.0)).intervals
    assert bounded.low == 30.0
    assert bounded.low_limit is None
    assert bounded.high == pytest.approx(172.0, abs=1e-9)
    (part,) = usable(boom(), 0.2).intervals
    assert found.low < part.low < part.high < found.high


def test_the_ends_of_a_triad_are_where_the_other_crank_stands_still():
    """Stephenson III driven by link 6 is a triad: its ends are the extremes of link 6 over the crank."""
    dyadic = stephenson_with(75.0)
    phi = np.linspace(0, math.tau, 721)
    over = solve(dyadic, [Turning.of(phi, 1.0)]).bodies
    theta = over["link6"].turning.theta

    def extreme(start):
        for _ in range(30):
            turning = solve(dyadic, [Turning.of([start], 1.0)]).bodies["link6"].turning
            start -= turning.omega[0] / turning.alpha[0]
        return start, turning.theta[0]

    low, high = extreme(phi[np.argmin(theta)])[1], extreme(phi[np.argmax(theta)])[1]
    begin = 300
    drawn = {
        link: Pose(body.origin.position[begin], body.turning.theta[begin])
        for link, body in over.items()
        if link != "ground"
    }
    machine = Machine(dyadic.joints, [Drive("link6")], {}, drawn, [theta[begin]])
    (found,) = ranges(machine).intervals
    assert apart(found.low, low) < 1e-10
    assert apart(found.high, high) < 1e-10


def test_a_triad_that_turns_fully():
    assert ranges(machine_of(LINKAGES["stephenson2"])).turns_fully


def test_what_closes_nowhere_has_no_interval_and_two_drives_have_no_limits():
    assert ranges(four_bar(10.0, 20.0, 30.0, 90.0)).intervals == ()
    with pytest.raises(KinematicsError, match="has 2"):
        ranges(machine_of(LINKAGES["fivebar_two_drivers"]))
    with pytest.raises(KinematicsError, match="columns of designs"):
        ranges(four_bar(np.array([[30.0], [40.0]]), 80.0, 70.0, 90.0))
