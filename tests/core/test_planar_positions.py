"""Every linkage of the independent check, solved: places, rates, poles and slides."""

import numpy as np
import pytest
from reference_linkages import LINKAGES, Case, case

from mechwright.mechanics.planar.dyad import continuous
from mechwright.mechanics.planar.machine import Machine, Pose
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright.mechanics.planar.relative_motion import instant_centre, relative, relative_pole
from mechwright.mechanics.planar.rigid import Turning

EXACT = 1e-11
"""Of max(1, |value|), for everything but poles."""
POLES = 1e-10
"""Of 1 + |place| for poles, times what their denominator loses where both links turn nearly alike."""

ORDERS = ("position", "velocity", "acceleration", "jerk")


@pytest.fixture(scope="module", params=list(LINKAGES))
def solved(request: pytest.FixtureRequest) -> tuple[Case, Solution]:
    one = case(request.param)
    return one, solve(one.machine, one.inputs)


def near(found, expected, exact=EXACT) -> bool:
    found, expected = np.asarray(found), np.asarray(expected)
    return bool((abs(found - expected) <= exact * np.maximum(1, abs(expected))).all())


def complexes(values) -> np.ndarray:
    return np.array([complex(*one) for one in values])


def test_links_turn(solved):
    one, found = solved
    for link in one.machine.links:
        turning = found.bodies[link].turning
        angle, omega, alpha, jerk = (
            np.array([position[key][link] for position in one.positions])
            for key in ("angle", "omega", "alpha", "jerk")
        )
        assert near(np.exp(1j * turning.theta), np.exp(1j * angle)), link
        for order, value in (("omega", omega), ("alpha", alpha), ("jerk", jerk)):
            assert near(getattr(turning, order), value), (link, order)


def test_pins_are_in_their_places(solved):
    one, found = solved
    for pin in one.positions[0]["joints"]:
        if (joint := one.joint(pin)) is not None:
            expected = complexes([position["joints"][pin] for position in one.positions])
            assert near(found.place(joint).position, expected), pin


def test_a_point_moves(solved):
    one, found = solved
    point = one.table["point"]
    motion = found.bodies[point["link"]].point(one.place(point["link"], point["at"]))
    for number, order in enumerate(ORDERS):
        expected = complexes([position["point"][number] for position in one.positions])
        assert near(getattr(motion, order), expected), order


def test_slides_shift(solved):
    one, found = solved
    for name in one.positions[0]["slides"]:
        slide = one.slide(name)
        seen = relative(found.bodies[slide.block], found.bodies[slide.guide]).point(slide.point)
        along = np.exp(-1j * slide.line_angle)
        for number, order in enumerate(ORDERS):
            lever = getattr(seen, order) - (slide.line if order == "position" else 0)
            expected = np.array([position["slides"][name][number] for position in one.positions])
            assert near((lever * along).real, expected), (name, order)
            if order == "position":
                assert near((lever * along).imag, 0), name


def test_poles_of_pairs(solved):
    one, found = solved
    for number, (link, other) in enumerate(one.table["pairs"]):
        body, frame = found.bodies[link], found.bodies[other]
        pole, ground = relative_pole(body, frame)
        places = {
            "acceleration_pole": ground,
            "acceleration_pole_in_j": pole.fixed,
            "acceleration_pole_in_i": pole.moving,
            "instant_centre": instant_centre(body, frame),
        }
        w, v = body.turning, frame.turning
        speed = np.max([abs(any_body.turning.omega) for any_body in found.bodies.values()], axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            lost = speed**2 / abs((w.omega - v.omega) ** 2 - 1j * (w.alpha - v.alpha))
            losses = {"instant_centre": speed / abs(w.omega - v.omega)}
        for key, place in places.items():
            for sample, position in enumerate(one.positions):
                expected = position["poles"][number][key]
                if expected is None:
                    assert np.isnan(place[sample]), (link, other, key)
                    continue
                bound = POLES * (1 + abs(complex(*expected))) * (1 + losses.get(key, lost)[sample])
                assert abs(place[sample] - complex(*expected)) <= bound, (link, other, key)


def test_columns_have_the_numbers_of_each_design(solved):
    """Two designs, the second with all lengths doubled: angles are the same, rates of places twice as large."""
    one, found = solved
    double = np.array([[1.0], [2.0]])
    lengths = {"place_one", "place_two", "line", "point"}
    joints = [
        type(joint)(
            **{key: value * double if key in lengths else value for key, value in vars(joint).items()}
        )
        for joint in one.machine.joints
    ]
    inputs = [Turning.of(t.theta[None], t.omega[None], t.alpha[None], t.jerk[None]) for t in one.inputs]
    drawn = {link: Pose(pose.origin * double, pose.angle) for link, pose in one.machine.drawn.items()}
    machine = Machine(joints, one.machine.drives, one.machine.branches, drawn, one.machine.drawn_at)
    both = solve(machine, inputs)
    for link in one.machine.links:
        for row in range(2):
            turning, expected = both.bodies[link].turning, found.bodies[link].turning
            for order in ("theta", "omega", "alpha", "jerk"):
                rows = np.broadcast_to(getattr(turning, order), (2, len(one.table["times"])))
                assert near(rows[row], getattr(expected, order)), (link, order)
    point = one.table["point"]
    place = one.place(point["link"], point["at"]) * double
    motion, single = (
        solution.bodies[point["link"]].point(lever)
        for solution, lever in ((both, place), (found, place[0, 0]))
    )
    for order in ORDERS:
        assert near(getattr(motion, order), getattr(single, order) * double), order


def test_angles_run_on_over_a_gap():
    """Samples that do not close part the angle of their own design alone."""
    angle = np.array([[3.0, np.nan, -3.0, -2.9], [3.0, 3.1, -3.1, -3.0], [np.nan, 1.0, 2.0, 3.0]])
    turn = 2 * np.pi
    expected = [[3, np.nan, turn - 3, turn - 2.9], [3, 3.1, turn - 3.1, turn - 3], [np.nan, 1, 2, 3]]
    assert np.allclose(continuous(angle), expected, rtol=0, atol=1e-12, equal_nan=True)


def test_both_ways_of_a_range_with_a_gap_are_found():
    """Chebyshev's rockers close on two stretches of the turn, whichever comes first."""
    one = case("chebyshev")
    theta = np.linspace(0, 2 * np.pi, 721)
    closes = solve(one.machine, [Turning.of(theta, 1.0)]).closes
    first, last = np.arccos(0.8), np.arccos(-0.2)
    within = (first < theta) & (theta < last) | (first < 2 * np.pi - theta) & (2 * np.pi - theta < last)
    assert np.array_equal(closes, within)
