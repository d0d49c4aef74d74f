"""Kinematics of spherical loops, against computations that share nothing with them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.mechanics.planar import Turning
from mechwright_spherical.kinematics.bodies import quaternions
from mechwright_spherical.kinematics.chain import third_position
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.jets import turning_about
from mechwright_spherical.kinematics.loop import Loop
from mechwright_spherical.kinematics.mobility import input_range, kind, mobility
from mechwright_spherical.kinematics.vectors import arc, column, cross, dot, norm, rotate, vector

BATCH, EXAMPLES = 500, 12
"""6,000 linkages of each kind."""

SEEDS = st.integers(0, 2**32 - 1)


def pin_at(linkage, psi):
    """The pin b (3, ...) at output angles ψ (...)."""
    c = linkage.output_axis
    prolonged = np.asarray(linkage.ground, dtype=float) + linkage.output
    start = np.stack([np.sin(prolonged), 0 * prolonged, np.cos(prolonged)])
    like = np.empty((3, *np.broadcast_shapes(psi.shape, c.shape[1:])))
    return rotate(column(c, like), psi, column(start, like))


def unit(generator, count):
    found = generator.normal(size=(3, count))
    return found / np.sqrt((found**2).sum(axis=0))


def random_loops(seed, count=BATCH):
    """Five-bars that are assembled at the input angle 0, pins at least 8 degrees apart, and their input angles."""
    generator = np.random.default_rng(seed)
    pins = []
    while sum(p.shape[2] for p in pins) < count:
        found = np.stack([unit(generator, 4 * count) for _ in range(6)])
        a0, a1, b0, b1, c1, _ = found
        good = np.ones(4 * count, dtype=bool)
        for one, two in ((a0, a1), (b0, b1), (a1, c1), (b1, c1), (a1, b1)):
            good &= np.abs(dot(one, two)) < math.cos(math.radians(8))
        good &= np.abs(dot(c1, cross(a1, b1))) > 0.02
        pins.append(found[:, :, good])
    a0, a1, b0, b1, c1, p1 = np.concatenate(pins, axis=2)[:, :, :count, None]
    ratio = generator.choice([-1.5, -0.5, 0.0, 0.5, 2.0])
    angle = generator.uniform(-0.05, 0.05, (count, 3))
    return Loop.of_pins(a0, a1, b0, b1, c1, p1, float(ratio)), (a0, a1, b0, b1, c1, p1), angle


def far_from_dead_centre(state):
    mu = state.transmission
    apart = norm(cross(state.a[0], state.b[0]))
    return (np.sin(mu) > 0.1) & (apart > 0.05)


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_loops_close(seed):
    loop, (a0, a1, b0, b1, c1, p1), angle = random_loops(seed)
    state = loop.at(Turning.of(angle), 0)
    a, b, c, p = (jet[0] for jet in (state.a, state.b, state.c, state.p))
    good = np.isfinite(c).all(axis=0)
    assert good.mean() > 0.9
    for miss in (
        dot(a, c) - dot(a1, c1),
        dot(b, c) - dot(b1, c1),
        dot(c, c) - 1,
        dot(p, p) - 1,
        dot(a, a) - 1,
        dot(a0, a) - dot(a0, a1),
        dot(b0, b) - dot(b0, b1),
        dot(p, a) - dot(p1, a1),
        dot(p, c) - dot(p1, c1),
    ):
        assert np.abs(miss[good]).max() <= 1e-12
    assert (np.sign(dot(c, cross(a, b)))[good] == np.broadcast_to(loop.side, angle.shape)[good]).all()
    at_rest = loop.position(np.zeros((BATCH, 1)))
    assert np.abs(at_rest - p1).max() <= 1e-12 / 0.02


# An independent computation in extended precision: the third pin from two planes and a sphere.

LONG = np.longdouble


def long_rotate(axis, angle, v):
    axis, v, angle = (np.asarray(x, dtype=LONG) for x in (axis, v, angle))
    along = axis * (axis * v).sum(axis=0)
    swing = np.stack([axis[i - 2] * v[i - 1] - axis[i - 1] * v[i - 2] for i in range(3)])
    return along + np.cos(angle) * (v - along) + np.sin(angle) * swing


def long_path(pins, ratio, angle):
    a0, a1, b0, b1, c1, p1 = (np.asarray(pin, dtype=LONG) for pin in pins)

    def dots(x, y):
        return (x * y).sum(axis=0)

    def crosses(x, y):
        return np.stack([x[i - 2] * y[i - 1] - x[i - 1] * y[i - 2] for i in range(3)])

    def third(a, b):
        ca, cb, k = dots(a1, c1), dots(b1, c1), dots(a, b)
        n = crosses(a, b)
        q = dots(n, n)
        x, y = (ca - k * cb) / q, (cb - k * ca) / q
        side = np.sign(dots(c1, crosses(a1, b1)))
        return x * a + y * b + side * np.sqrt((1 - x * ca - y * cb) / q) * n

    def basis(a, c):
        m = crosses(a, c)
        m = m / np.sqrt(dots(m, m))
        return a, crosses(m, a), m

    a = long_rotate(a0, angle, a1)
    b = long_rotate(b0, LONG(ratio) * angle, b1)
    c = third(a, b)
    shares = [dots(e, p1) for e in basis(a1, c1)]
    return sum(share * e for share, e in zip(shares, basis(a, c), strict=True))


# Coefficients of central differences of the eighth order for the first three derivatives.
WEIGHTS = {
    1: np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / 840,
    2: np.array([-9, 128, -1008, 8064, -14350, 8064, -1008, 128, -9]) / 5040,
    3: np.array([-7, 72, -338, 488, 0, -488, 338, -72, 7]) / 240,
}
STEP = LONG(1) / 4096


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_rates_are_derivatives(seed):
    loop, pins, angle = random_loops(seed)
    angle = angle[:, :1]
    state = loop.at(Turning.of(angle, 1.0))
    good = far_from_dead_centre(state)[:, 0]
    places = np.arange(-4, 5)
    with np.errstate(invalid="ignore"):  # linkages that come apart are left out below
        values = [long_path(pins, loop.ratio, angle.astype(LONG) + n * STEP) for n in places]
    good &= np.isfinite(np.stack(values)).all(axis=(0, 1, 3))
    assert good.mean() > 0.5
    for order, limit in ((1, 1e-9), (2, 1e-7), (3, 2e-6)):
        wanted = sum(LONG(w) * v for w, v in zip(WEIGHTS[order], values, strict=True)) / STEP**order
        # Close to a dead centre the rates and the errors of the difference grow together.
        scale = 1 + np.abs(state.p[3][:, good]).max(axis=0) ** 2
        miss = np.abs(state.p[order][:, good] - wanted[:, good]).max(axis=0) / scale
        assert float(miss.max()) < limit, order


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_varying_speed_is_the_chain_rule(seed):
    loop, _, angle = random_loops(seed)
    rate, acceleration, jerk = 1.7, -2.3, 5.1
    steady = loop.at(Turning.of(angle, 1.0)).p
    moved = loop.at(Turning.of(angle, rate, acceleration, jerk))
    good = far_from_dead_centre(moved)
    wanted = (
        steady[1] * rate,
        steady[2] * rate**2 + steady[1] * acceleration,
        steady[3] * rate**3 + 3 * steady[2] * rate * acceleration + steady[1] * jerk,
    )
    for got, want in zip(moved.p[1:], wanted, strict=True):
        scale = np.abs(want[:, good]).max()
        assert np.abs(got - want)[:, good].max() <= 1e-11 * scale


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_the_coupler_moves_as_a_body(seed):
    loop, _, angle = random_loops(seed)
    state = loop.at(Turning.of(angle, 1.0))
    good = far_from_dead_centre(state)
    spin, alpha, jerk = (x[:, good] for x in state.coupler_spin)
    scale = 1 + norm(spin) ** 3 + norm(alpha) ** 1.5 + norm(jerk)
    for jet in (state.a, state.c, state.p):
        x, v, a, j = (value[:, good] for value in jet)
        wanted_a = cross(alpha, x) + cross(spin, v)
        wanted_j = cross(jerk, x) + 2 * cross(alpha, v) + cross(spin, a)
        for got, want in ((v, cross(spin, x)), (a, wanted_a), (j, wanted_j)):
            assert (np.abs(got - want).max(axis=0) / scale).max() <= 1e-12


# Four-bars


def random_arcs(seed, count=BATCH):
    return np.random.default_rng(seed).uniform(math.radians(4), math.radians(176), (4, count))


def brute_force(a1, a2, a3, a4, steps=720):
    """Whether the diagonal stays inside the reach of the far links, over a whole turn."""
    theta = np.linspace(0, math.tau, steps + 1)[:, None]
    diagonal = np.arccos(np.clip(np.cos(a1) * np.cos(a2) + np.sin(a1) * np.sin(a2) * np.cos(theta), -1, 1))
    reach = np.minimum(a3 + a4, math.tau - a3 - a4)
    return (diagonal >= np.abs(a3 - a4)) & (diagonal <= reach)


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_mobility_is_what_brute_force_sees(seed):
    a1, a2, a3, a4 = arcs = random_arcs(seed)
    found = mobility(*arcs)
    clear = np.abs(found.t).min(axis=0) > 1e-3  # else 720 steps cannot tell
    fits = brute_force(a1, a2, a3, a4)
    exists = clear & fits.any(axis=0)
    assert exists.sum() > BATCH / 4
    output = brute_force(a1, a4, a3, a2).all(axis=0)
    # The joints between coupler and cranks: the same loop seen from the coupler and from the input.
    elsewhere = [brute_force(a2, a3, a4, a1), brute_force(a3, a4, a1, a2), brute_force(a3, a2, a1, a4)]
    some = fits.all(axis=0) | output | np.any([one.all(axis=0) for one in elsewhere], axis=0)
    np.testing.assert_array_equal(found.input_full[exists], fits.all(axis=0)[exists])
    np.testing.assert_array_equal(found.output_full[exists], output[exists])
    np.testing.assert_array_equal(found.grashof[exists], some[exists])


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_grashof_needs_the_supplements_first(seed):
    """While the two largest arcs exceed 180 degrees both become supplements; then the planar rule holds."""
    arcs = random_arcs(seed)
    found = mobility(*arcs)
    ordered = np.sort(arcs, axis=0)
    planar = ordered[0] + ordered[3] <= ordered[1] + ordered[2]
    while (bad := ordered[2] + ordered[3] > math.pi).any():
        ordered[2:, bad] = math.pi - ordered[2:, bad]
        ordered = np.sort(ordered, axis=0)
    rule = ordered[0] + ordered[3] <= ordered[1] + ordered[2]
    clear = np.abs(found.t).min(axis=0) > 1e-9
    np.testing.assert_array_equal(found.grashof[clear], rule[clear])
    assert (planar != rule).mean() > 0.2, "the planar rule would do"


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_the_input_range_ends_where_the_linkage_comes_apart(seed):
    for arcs in random_arcs(seed, 60).T:
        ranges = input_range(*arcs)
        theta = np.linspace(0, math.tau, 1441)
        inside = np.zeros(theta.shape, dtype=bool)
        edge = np.zeros(theta.shape, dtype=bool)
        for low, high in ranges:
            inside |= (theta >= low) & (theta <= high)
            edge |= (np.abs(theta - low) < 0.005) | (np.abs(theta - high) < 0.005)
        seen = np.isfinite(FourBar(*arcs).loop().position(theta)).all(axis=0)
        np.testing.assert_array_equal(seen[~edge], inside[~edge])


@settings(max_examples=EXAMPLES)
@given(SEEDS)
def test_output_angle_and_pin_are_the_same_linkage(seed):
    """ψ from its own equation, b from the closed form of the loop: two ways to the same pin."""
    generator = np.random.default_rng(seed)
    a1, a2, a3, a4 = random_arcs(seed)[:, :, None]
    side = generator.choice([-1.0, 1.0], (BATCH, 1))
    linkage = FourBar(a1, a2, a3, a4, side)
    theta = generator.uniform(0, math.tau, (BATCH, 5))
    state = linkage.at(Turning.of(theta, 1.0))
    psi = linkage.output_angle(theta)
    good = np.isfinite(psi) & np.isfinite(state.c[0]).all(axis=0) & (np.sin(state.transmission) > 1e-3)
    assert good.mean() > 0.1
    b = pin_at(linkage, psi)
    assert np.abs(b - state.c[0])[:, good].max() < 1e-9
    # c.(a x b) has the sign that was asked for.
    c = linkage.output_axis
    assert (
        np.sign(dot(np.broadcast_to(c, b.shape), cross(state.a[0], state.c[0])))[good]
        == np.broadcast_to(side, theta.shape)[good]
    ).all()
    good &= np.sin(state.transmission) > 0.05
    turning = turning_about(linkage.output_axis, state.c)
    step = 1e-5
    slope = (linkage.output_angle(theta + step) - linkage.output_angle(theta - step)) / (2 * step)
    assert np.abs(turning.omega - slope)[good].max() < 1e-5 * np.abs(turning.jerk[good]).max()


def test_output_angle_goes_all_the_way_round_where_the_output_does():
    theta = np.linspace(0, math.tau, 73)
    for arcs in ((30, 80, 70, 60), (150, 100, 70, 60)):
        psi = FourBar(*np.radians(arcs)).output_angle(theta)
        assert abs(abs(psi[-1] - psi[0]) - math.tau) < 1e-12
        assert np.abs(np.diff(psi)).max() < 0.6
    rocking = FourBar(*np.radians((80, 30, 70, 60))).output_angle(theta)
    assert abs(rocking[-1] - rocking[0]) < 1e-12


@pytest.mark.parametrize(
    ("arcs", "name"),
    [
        ((80, 30, 70, 60), "crank-rocker"),
        ((80, 60, 70, 30), "rocker-crank"),
        ((30, 80, 70, 60), "double crank"),
        ((60, 70, 30, 80), "Grashof double rocker"),
        ((100, 150, 110, 120), "crank-rocker"),
        ((60, 60, 60, 60), "change-point linkage"),
    ],
)
def test_kinds(arcs, name):
    assert kind(*np.radians(arcs)) == name


def test_every_kind_has_a_name_and_the_mobility_that_it_says():
    seen = {}
    for arcs in random_arcs(7, 4000).T:
        found = mobility(*arcs)
        if input_range(*arcs):
            seen.setdefault(kind(*arcs), set()).add(
                (bool(found.input_full), bool(found.output_full), bool(found.grashof))
            )
    assert seen["crank-rocker"] == {(True, False, True)}
    assert seen["rocker-crank"] == {(False, True, True)}
    assert seen["double crank"] == {(True, True, True)}
    assert seen["Grashof double rocker"] == {(False, False, True)}
    assert {name for name, found in seen.items() if found == {(False, False, False)}} == {
        name for name in seen if name.startswith("double rocker")
    }
    assert len(seen) == 8


def test_long_projections_keep_their_digits():
    """Pins a tenth of a degree apart: the loop still closes to rounding over the arc."""
    tiny = 1e-3
    pins = [
        vector([x * tiny, y * tiny, 1.0])
        for x, y in ((0, 0), (0.1, 1), (1.2, 0), (2, 0.7), (0.9, 1.5), (0.2, 1.9))
    ]
    loop = Loop.of_pins(*pins, 0.5)
    state = loop.at(Turning.of(np.linspace(-0.5, 0, 50)), 0)
    assert np.abs(arc(state.a[0], state.c[0]) - arc(pins[1], pins[4])).max() < 1e-12
    assert np.abs(state.p[0][:, -1] - pins[5]).max() < 1e-12


def test_a_stretched_linkage_is_assembled_and_a_torn_one_is_not():
    a, b = vector([1, 0, 0]), vector([0, 1, 0])
    half = np.asarray(math.cos(math.pi / 4))
    touching = third_position(a, b, half, half, np.asarray(1.0))
    np.testing.assert_allclose(touching, vector([1, 1, 0]), atol=1e-15)
    shorter = np.asarray(math.cos(math.pi / 4 - 1e-5))
    assert np.isnan(third_position(a, b, shorter, shorter, np.asarray(1.0))).all()


@settings(max_examples=50)
@given(SEEDS)
def test_quaternions_turn_as_their_matrices(seed):
    generator = np.random.default_rng(seed)
    axis, angle = unit(generator, 1)[:, 0], generator.uniform(-math.pi, math.pi)
    matrix = np.stack([rotate(axis, angle, e) for e in np.eye(3)], axis=1)
    q = quaternions(matrix[:, :, None])[:, 0]
    sign = 1 if math.cos(angle / 2) >= 0 else -1
    np.testing.assert_allclose(
        q, sign * np.array([math.cos(angle / 2), *(math.sin(angle / 2) * axis)]), atol=1e-12
    )
