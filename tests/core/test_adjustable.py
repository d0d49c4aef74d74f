"""Adjustable linkages in the plane: counts, order, recovery of known mechanisms, search with limits."""

import json
import math
from pathlib import Path as File

import numpy as np
import pytest
from by_night import by_night
from hypothesis import given
from hypothesis import strategies as st

from mechwright.mechanics.adjustable import (
    Limits,
    Path,
    Pins,
    PlaneSpace,
    Unknowns,
    exact_number,
    fit,
    follow,
    search,
    settings_of,
)
from mechwright.mechanics.tracing.order import assigned, isotonic

FACTS = {
    fact["name"]: fact
    for fact in json.loads(
        (File(__file__).parents[1] / "data" / "adjustable.json").read_text(encoding="utf-8")
    )["facts"]
}
ROOMY = Limits(math.radians(15), 0.1, 8.0)
ROOMS = [
    (4, "moving", False), (4, "fixed", False), (4, "both", False), (5, "moving", False),
    (5, "moving", True), (5, "fixed", True), (5, "both", True),
]  # fmt: skip


def four_bars(name: str, scale: float):
    """Pins, points and crank angles of a reference mechanism, in units of ``scale``."""
    fact = FACTS[name]
    design, angles = np.array(fact["inputs"]["design"]), fact["inputs"]["crank_deg"]
    a0, b0 = design[:, 0] + 1j * design[:, 1], design[:, 2] + 1j * design[:, 3]
    r1, r3, length, px, py = design[:, 4:].T
    a = a0 + r1 * np.exp(1j * np.radians([row[0] for row in angles]))
    c, _ = PlaneSpace(0j).third(a, b0, length, r3, np.ones(len(design)))
    p = a + (px + 1j * py) * (c - a) / length
    points = tuple(np.array([complex(*point) for point in row]) / scale for row in fact["expected"])
    theta = np.concatenate([np.radians(np.array(row)[1:] - row[0]) for row in angles])
    return Pins(*(one / scale for one in (a0, a, b0, b0, c, p))), points, theta


def five_bars(scale: float):
    fact = FACTS["adjust.planar5.three.points"]
    design, angles = np.array(fact["inputs"]["design"]), fact["inputs"]["crank_deg"]
    a0, b0 = design[:, 0] + 1j * design[:, 1], design[:, 2] + 1j * design[:, 3]
    r1, r4, _, offset, length, px, py = design[:, 4:].T
    first = np.radians([row[0] for row in angles])
    a, b1 = a0 + r1 * np.exp(1j * first), b0 + r4 * np.exp(1j * (offset + 0.5 * first))
    p = np.array([complex(*row[0]) for row in fact["expected"]])
    c = a + (p - a) / (px + 1j * py) * length
    points = tuple(np.array([complex(*point) for point in row]) / scale for row in fact["expected"])
    theta = np.concatenate([np.radians(np.array(row)[1:] - row[0]) for row in angles])
    return Pins(*(one / scale for one in (a0, a, b0, b1, c, p))), points, theta


@pytest.mark.parametrize(("bars", "moves", "turned"), ROOMS)
@pytest.mark.parametrize("phases", [1, 2, 3])
def test_an_exact_number_of_points_makes_a_square_system_of_full_rank(bars, moves, turned, phases):
    rng = np.random.default_rng([bars, phases])
    unknowns = Unknowns(PlaneSpace(0.2 + 0.9j), bars, moves, phases, 0.5 if bars == 5 else 0.0, turned)
    assert unknowns.size == exact_number(bars, moves, phases, turned) - phases
    pins, _, _ = five_bars(90.0) if bars == 5 else four_bars("adjust.planar4.three.points", 45.0)
    pins = Pins(*(getattr(pins, name)[:phases] for name in Pins.__slots__))
    point = complex(pins.p[0])
    unknowns = Unknowns(PlaneSpace(point), bars, moves, phases, unknowns.ratio, turned)
    ranks = []
    for _ in range(12):
        x = unknowns.of_pins(pins) + 0.1 * rng.normal(size=unknowns.size)
        count = unknowns.size
        phase = np.sort(np.resize(np.arange(phases), count))
        theta = (rng.uniform(0.1, 2.0, count) if bars == 5 else rng.uniform(0.3, 6, count)) * (
            -1 if bars == 5 else 1
        )

        def path(both, phase=phase, count=count):
            found, _ = follow(
                unknowns.space, unknowns.pins(both[:-count]).of(phase), unknowns.ratio, both[-count:]
            )
            return np.concatenate([found.real, found.imag])

        both = np.concatenate([x, theta])
        slopes = np.array([(path(both + h) - path(both - h)) / 2e-5 for h in 1e-5 * np.eye(both.size)]).T
        values = np.linalg.svd(slopes / np.linalg.norm(slopes, axis=0), compute_uv=False)
        ranks.append(values[-1] / values[0] if np.isfinite(values).all() else 0.0)
    assert slopes.shape[0] == slopes.shape[1]
    assert max(ranks) > 1e-9


@pytest.mark.parametrize(
    ("fact", "room"),
    [
        ("count.4.moving_pivots_R1_R3_kept", (4, "moving", False)),
        ("count.4.fixed_pivots", (4, "fixed", False)),
        ("count.4.fixed_and_moving", (4, "both", False)),
        ("count.5.moving_pivots_rephased", (5, "moving", True)),
        ("count.5.moving_pivots_not_rephased", (5, "moving", False)),
        ("count.5.fixed_pivots_rephased", (5, "fixed", True)),
        ("count.5.fixed_moving_rephased", (5, "both", True)),
    ],
)
def test_counts_are_those_of_the_second_computation(fact, room):
    bars, moves, turned = room
    assert [exact_number(bars, moves, m, turned) for m in (1, 2, 3)] == FACTS[fact]["expected"]


@given(st.lists(st.floats(-5, 5), min_size=1, max_size=9))
def test_isotonic_is_the_nearest_sequence_that_does_not_fall(values):
    found = isotonic(np.array(values))
    assert (np.diff(found) >= -1e-12).all()
    # The residual of a projection on a convex cone is square to it, and has no component inside it.
    rest = np.array(values) - found
    assert abs(rest @ found) < 1e-9
    assert all(rest[k:].sum() <= 1e-9 for k in range(len(values)))


def test_points_are_assigned_in_order_at_least_cost():
    rng = np.random.default_rng(3)
    costs = rng.uniform(size=(5, 7, 3))
    sums, chosen = assigned(costs)
    for case in range(5):
        ways = [(i, j, k) for i in range(7) for j in range(i, 7) for k in range(j, 7)]
        best = min(ways, key=lambda way: sum(costs[case, s, n] for n, s in enumerate(way)))
        assert tuple(chosen[case]) == best
        assert sums[case] == pytest.approx(sum(costs[case, s, n] for n, s in enumerate(best)))


@pytest.mark.parametrize(
    ("name", "noise"), [("adjust.planar4.two.points", 0.02), ("adjust.planar4.three.points", 0.02)]
)
def test_four_bars_come_back_from_their_points(name, noise):
    pins, points, theta = four_bars(name, 45.0)
    unknowns = Unknowns(PlaneSpace(complex(points[0][0])), 4, "moving", len(points))
    task = Path(points, 1.0).task(unknowns, ROOMY)
    x = unknowns.of_pins(pins)
    np.testing.assert_allclose(task.misses(x, theta), 0, atol=1e-12)
    rng = np.random.default_rng(0)
    found = fit(
        task,
        x + noise * rng.normal(size=(6, x.size)),
        theta + noise * rng.normal(size=(6, theta.size)),
        100,
        (1.0,),
    )
    assert (np.sqrt(found.squares) < 1e-12).all()
    assert (np.abs(found.x - x).max(axis=1) < 1e-8).sum() >= 4


def test_five_bars_with_three_phases_come_back():
    pins, points, theta = five_bars(90.0)
    unknowns = Unknowns(PlaneSpace(complex(points[0][0])), 5, "moving", 3, 0.5)
    task = Path(points, 1.0).task(unknowns, ROOMY)
    x = unknowns.of_pins(pins)
    np.testing.assert_allclose(task.misses(x, theta), 0, atol=1e-12)
    rng = np.random.default_rng(0)
    found = fit(
        task,
        x + 0.002 * rng.normal(size=(6, x.size)),
        theta + 0.002 * rng.normal(size=(6, theta.size)),
        150,
        (1.0,),
    )
    assert (np.sqrt(found.squares) < 1e-11).sum() >= 5
    settings = settings_of(unknowns.space, unknowns.pins(found.best(1).x[0]))
    np.testing.assert_allclose(np.degrees(settings.crank), [0, 15, -12], atol=1e-4)
    np.testing.assert_allclose(np.degrees(settings.follower), [0, -19, 11], atol=1e-4)


@pytest.mark.parametrize(
    ("pins", "ratio", "count", "noise", "least"),
    [
        (four_bars("adjust.planar4.two.points", 45.0)[0], 0.0, 10, 0.1, 4),
        pytest.param(four_bars("adjust.planar4.three.points", 45.0)[0], 0.0, 8, 0.05, 6, marks=by_night),
        pytest.param(five_bars(90.0)[0], 0.5, 12, 0.02, 5, marks=by_night),
    ],
)
def test_surplus_points_bring_the_mechanism_back(pins, ratio, count, noise, least):
    """With more points than unknowns there is one mechanism; starts around it find it."""
    phases = len(pins.a)
    unknowns = Unknowns(PlaneSpace(complex(pins.p[0])), 5 if ratio else 4, "moving", phases, ratio)
    theta = np.linspace(0, -2.0 if ratio else 5.2, count)[1:]
    points = []
    for phase in range(phases):
        curve, _ = follow(unknowns.space, pins.of(np.full(count - 1, phase)), ratio, theta)
        points.append(np.concatenate([[pins.p[0]], curve]))
    task = Path(tuple(points), 1.0).task(unknowns, ROOMY)
    x, rng = unknowns.of_pins(pins), np.random.default_rng(5)
    angles = np.tile(theta, phases)
    found = fit(
        task,
        x + noise * rng.normal(size=(6, x.size)),
        angles + noise * rng.normal(size=(6, angles.size)),
        200,
        (1.0,),
    )
    back = (np.sqrt(found.squares) < 1e-10) & (np.abs(found.x - x).max(axis=1) < 1e-5)
    assert back.sum() >= least


def test_settings_and_chords_of_the_reference():
    pins, points, _ = four_bars("adjust.planar4.three.points", 1.0)
    settings = settings_of(PlaneSpace(complex(points[0][0])), pins)
    sweeps = FACTS["adjust.planar4.slot_sweep_deg"]["expected"]
    np.testing.assert_allclose(np.degrees([settings.crank, settings.follower])[:, 1:].T, sweeps, atol=1e-9)
    np.testing.assert_allclose(settings.crank_chords[0, 1:], [12.986, 18.042], atol=5e-4)
    np.testing.assert_allclose(settings.follower_chords[0, 1:], [19.499, 12.553], atol=5e-4)


@pytest.mark.parametrize("moves", ["moving", "fixed", "both"])
@pytest.mark.parametrize("bars", [4, 5])
def test_pins_give_their_unknowns_back(bars, moves):
    rng = np.random.default_rng(2)
    unknowns = Unknowns(PlaneSpace(0.4 - 0.2j), bars, moves, 3, 0.5 if bars == 5 else 0.0, arm_turned=True)
    x = rng.uniform(-1, 1, (5, unknowns.size))
    pins = unknowns.pins(x)
    again = unknowns.pins(unknowns.of_pins(pins))
    for name in Pins.__slots__:
        np.testing.assert_allclose(getattr(again, name), getattr(pins, name), atol=1e-12)


def assert_kept(task, found, k):
    """In order, the links' lengths common, the transmission angle kept over the whole range."""
    unknowns = task.unknowns
    pins = unknowns.pins(found.x[k])
    for phase in range(unknowns.phases):
        theta = np.concatenate([[0.0], found.theta[k][task.phase == phase]])
        steps = np.diff(theta)
        assert (steps >= -1e-12).all() or (steps <= 1e-12).all()
        assert abs(theta[-1]) <= math.tau + 1e-9
    space = unknowns.space
    for one, two in ((pins.a0, pins.a), (pins.b1, pins.c)):
        assert np.ptp(space.apart(one, two)) < 1e-12
    assert found.excess[k] < 1e-5


@pytest.mark.parametrize(
    "moves", ["moving", pytest.param("fixed", marks=by_night), pytest.param("both", marks=by_night)]
)
def test_a_search_meets_fewer_points_than_unknowns_exactly(moves):
    """Four and four points, as the source draws them: a family of linkages, found within the limits."""
    _, points, _ = four_bars("adjust.planar4.two.points", 45.0)
    path = Path(tuple(one[:4] for one in points), 1.0)
    unknowns = Unknowns(PlaneSpace(complex(points[0][0])), 4, moves, 2)
    limits = Limits(math.radians(30), 0.2, 4.0, full_turn=True, least_chord=0.25)
    found = search(path, unknowns, limits, 2000, 0, lambda part: None)
    good = np.flatnonzero((np.sqrt(found.squares) < 1e-11) & (found.excess < 1e-6))
    assert good.size > 3
    task = path.task(unknowns, limits)
    for k in good[:4]:
        assert_kept(task, found, k)
        pins = unknowns.pins(found.x[k])
        assert min(chord.min() for chord in task.chords(pins)) > 0.25 - 1e-5
