"""Planar dyads, projection, structural error, and both syntheses on the sphere."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from spherical_source import PlanarFiveBar

from mechwright.contracts.finding import errors as faults
from mechwright.errors import GeometryError, KinematicsError
from mechwright.mechanics.planar import Turning
from mechwright_spherical.defaults import published_example
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.five_bar import projected
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.projection import project, unproject
from mechwright_spherical.requirements import AdjustablePathRequirement
from mechwright_spherical.synthesis import structural
from mechwright_spherical.synthesis.planar import CouplerPoses, crank_dyad, points, synthesise
from mechwright_spherical.synthesis.refine import Freedom, Path, refine

ANGLES, ANGLES_N = np.radians(published_example.ANGLES), np.radians(published_example.ANGLES_N)
DESIGN = structural.PlanarDesign(
    published_example.PINS, published_example.RATIO, ANGLES, ANGLES_N, np.array(published_example.TABLE_2)
)
MECHANISM = projected(published_example.PINS, published_example.TABLE_2[0], 5.0, published_example.RATIO)
PATH = Path(ANGLES, ANGLES_N, project(published_example.TABLE_2, 5.0).T)
COORDINATE = st.floats(-50, 50)


def quiet(done, what):
    pass


# Projection


@given(
    COORDINATE,
    COORDINATE,
    st.floats(0.01, 100),
    st.floats(0.1, 100),
    COORDINATE,
    COORDINATE,
    st.sampled_from([1, -1]),
)
def test_projection_and_back(x, y, length, radius, cx, cy, side):
    on_sphere = project([x, y], length, radius, centre=(cx, cy), side=side)
    assert np.linalg.norm(on_sphere) == pytest.approx(radius, rel=1e-14)
    assert side * on_sphere[2] > 0
    scale = 1 + math.hypot(x - cx, y - cy) / length
    back = unproject(on_sphere, length, centre=(cx, cy), side=side)
    np.testing.assert_allclose(back, [x, y], atol=1e-12 * (scale**2 * length + abs(cx) + abs(cy) + 1))


def test_straight_lines_become_great_circles():
    line = np.column_stack([np.linspace(-3, 4, 9), 0.5 + 0.7 * np.linspace(-3, 4, 9)])
    seen = project(line, 2.0)
    assert np.linalg.svd(seen)[1][2] < 1e-14


@pytest.mark.parametrize("direction", [(1, 0, 0), (1, 2, 1e-9), (0.3, 0.1, -1)])
def test_the_horizon_is_refused_with_its_limit(direction):
    with pytest.raises(GeometryError, match=r"horizon.*limit is 1e-06"):
        unproject(direction, 5.0)


def test_a_length_must_be_positive():
    with pytest.raises(GeometryError, match="not above 0"):
        project((1, 1), 0.0)


# Structural error


@pytest.mark.parametrize("tolerance", [0.03, 0.004])
def test_from_the_smallest_length_on_the_tolerance_is_met(tolerance):
    d = structural.smallest_length(DESIGN, tolerance)
    assert float(structural.scaled_error(DESIGN, d)) == pytest.approx(tolerance, rel=1e-9)
    beyond = structural.scaled_error(DESIGN, np.geomspace(d, 300 * d, 400) * (1 + 1e-9))
    assert (beyond <= tolerance).all() or beyond[-1] < 1e-4  # printed targets have four decimals
    assert (beyond[:200] <= tolerance).all()


def test_the_best_centre_allows_shorter_lengths():
    assert structural.smallest_length(DESIGN, 0.01, best=True) < 0.6 * structural.smallest_length(
        DESIGN, 0.01
    )


@pytest.mark.parametrize("length", [1.0, 2.0, 5.0, 20.0])
def test_no_centre_nearby_is_better(length):
    at, value = structural.best_centre(DESIGN, length)
    generator = np.random.default_rng(3)
    for size in (1e-4, 1e-2, 0.3):
        others = structural.errors(DESIGN, length, at + size * generator.normal(size=(300, 2))).max(axis=-1)
        assert np.nanmin(others) >= value * (1 - 1e-9)
    assert value <= float(structural.errors(DESIGN, length).max())


def test_a_tolerance_that_no_length_meets_is_refused():
    with pytest.raises(KinematicsError, match="no projection length"):
        structural.smallest_length(DESIGN, 1e-9)


# Planar dyads


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_dyads_find_the_mechanism_that_made_the_poses(seed):
    """A mechanism near the published one, with common lengths; its own poses, and a guess that is off."""
    generator = np.random.default_rng(seed)
    pin = {name: complex(points(at)) for name, at in published_example.PINS.items()}
    pin = {name: z + 0.05 * complex(*generator.normal(size=2)) for name, z in pin.items()}
    r1, r3 = abs(pin["a1"] - pin["a0"]), abs(pin["c1"] - pin["b1"])
    pin["a1n"] = pin["a0"] + r1 * (pin["a1n"] - pin["a0"]) / abs(pin["a1n"] - pin["a0"])
    pin["c1n"] = pin["b1"] + r3 * (pin["c1n"] - pin["b1"]) / abs(pin["c1n"] - pin["b1"])
    p1 = complex(points(published_example.TABLE_2[0]))
    found = [
        PlanarFiveBar(pin["a0"], pin[a], pin["b0"], pin["b1"], pin[c], p1, 0.5).at(angles)
        for a, c, angles in (("a1", "c1", ANGLES), ("a1n", "c1n", ANGLES_N))
    ]
    (path, turns), (path_n, turns_n) = found
    arm = pin["b1"] - pin["b0"]
    nudge = 0.01 * generator.normal(size=10)
    guess = [pin["a0"].imag, pin["a1"].real, pin["a1"].imag, pin["a1n"].real, pin["a1n"].imag]
    rocker = [pin["c1"].real, pin["c1"].imag, pin["c1n"].real, pin["c1n"].imag, r3]
    result = synthesise(
        CouplerPoses(path, turns, path_n, turns_n),
        a0x=pin["a0"].real,
        crank_length=r1,
        b0=pin["b0"],
        arm_length=abs(arm),
        arm_angle=math.atan2(arm.imag, arm.real),
        ratio=0.5,
        crank_guess=np.add(guess, nudge[:5]),
        rocker_guess=np.add(rocker, nudge[5:]),
    )
    assert max(result.crank.residual, result.rocker.residual) < 1e-12
    for name, at in result.pins.items():
        assert abs(complex(*at) - pin[name]) < 1e-9 * max(result.crank.condition, result.rocker.condition)
    np.testing.assert_allclose(result.angles, ANGLES, atol=1e-9)


def test_dyads_that_the_poses_do_not_determine_are_refused():
    still = np.zeros(3, dtype=complex)
    with pytest.raises(KinematicsError, match="do not converge"):
        crank_dyad(
            CouplerPoses(still, still.real, still, still.real), 0.0, 1.0, published_example.CRANK_GUESS
        )


# Direct synthesis


def test_six_unknowns_end_at_the_same_error_from_every_start():
    fits = refine(MECHANISM, PATH, Freedom.SIX, starts=25, seed=1)
    np.testing.assert_allclose([fit.rms for fit in fits], 2.549624289e-05, atol=1e-11)
    for fit in fits:
        for one, two in (fit.mechanism.crank_arcs, fit.mechanism.rocker_arcs):
            assert abs(float(one - two)) < 1e-14
        for name in ("a0", "b0", "b1"):
            np.testing.assert_array_equal(getattr(fit.mechanism, name), getattr(MECHANISM, name))


def test_twelve_unknowns_meet_the_path_exactly():
    fits = refine(MECHANISM, PATH, Freedom.TWELVE, starts=16, seed=1)
    assert sum(fit.errors.max() <= 1e-12 for fit in fits) >= 12, [fit.errors.max() for fit in fits]
    best = min(fits, key=lambda fit: fit.errors.max()).mechanism
    for number, angles in ((1, ANGLES), (2, ANGLES_N)):
        loop = best.phase(number)
        mu = loop.at(Turning.of(np.linspace(angles.min(), angles.max(), 200)), 0).transmission
        assert np.isfinite(mu).all(), "it changes the branch on the way"


def test_more_unknowns_never_fit_worse():
    six, eight, twelve = (min(f.rms for f in refine(MECHANISM, PATH, freedom)) for freedom in Freedom)
    assert twelve < eight < six


def test_the_transmission_angle_is_bounded():
    def least(limit):
        (fit,) = refine(MECHANISM, PATH, Freedom.SIX, least_transmission=limit)
        mu = [
            fit.mechanism.phase(n).at(Turning.of(np.linspace(angles.min(), 0, 100)), 0).transmission
            for n, angles in ((1, ANGLES), (2, ANGLES_N))
        ]
        return math.degrees(min(np.minimum(m, np.pi - m).min() for m in mu))

    assert least(math.radians(80)) > least(0.0) + 2


def test_a_start_that_cannot_be_assembled_is_refused():
    torn = replace(PATH, angles=np.array([0.0, 2.0, 4.0, 6.0]))
    with pytest.raises(KinematicsError, match="cannot be assembled in all positions"):
        refine(MECHANISM, torn, Freedom.SIX)


# The family's kinds


def ask(kind, **table):
    family = Spherical()
    return family.synthesise(kind, family.requirements[kind].model_validate(table), quiet)


def test_the_whole_way_of_the_source_and_further():
    found = ask("adjustable-path", starts=1)
    residuals = [one.residual.value for one in found.candidates]
    assert residuals == sorted(residuals)
    assert len(residuals) == 4
    assert residuals[0] < 1e-9
    assert residuals[-2] / residuals[-1] < 1 / 60
    (note,) = found.findings
    assert note.code == "spherical.conditioning"
    assert note.value == pytest.approx(225.6, abs=0.1)
    best = linkage_of(found.candidates[0].params)
    assert max(phase.path_errors.max() for phase in best.phases) < 1e-11
    assert all(
        abs(gap.value) < 1e-11 for name, gap in found.candidates[0].figures.items() if name.endswith("gap")
    )


@pytest.mark.parametrize(
    ("table", "length", "centre"),
    [
        ({"projection_length": 8}, 8, (0, 0)),
        ({"projection_tolerance": 0.02}, 4.958, (0, 0)),
        ({"projection_tolerance": 0.02, "projection_centre": "best"}, 2.180, (0.29, 0.74)),
    ],
)
def test_the_projection_is_as_wished(table, length, centre):
    found = ask("adjustable-path", unknowns="none", radius=150, **table)
    (only,) = found.candidates
    assert only.params.five_bar.projection_length == pytest.approx(length, abs=0.01)
    assert only.params.five_bar.projection_centre == pytest.approx(centre, abs=0.02)


def test_a_path_on_the_sphere_is_projected_back():
    wanted = AdjustablePathRequirement()
    table = {name: [project(p, 5.0).tolist() for p in getattr(wanted, name)] for name in ("path", "path_n")}
    plane, sphere = ask("adjustable-path", unknowns="none"), ask("adjustable-path", unknowns="none", **table)
    assert sphere.candidates[0].residual.value == pytest.approx(plane.candidates[0].residual.value, rel=1e-6)


@pytest.mark.parametrize(
    ("table", "code"),
    [
        (
            {
                "path": [[1, 0, 0], [0.1, 0.1, 1], [0.2, 0.1, 1], [0.3, 0.1, 1]],
                "path_n": [[1, 0, 0], [0, 1, 1], [1, 1, 1]],
            },
            "spherical.horizon",
        ),
        ({"projection_tolerance": 1e-12}, "spherical.synthesis"),
    ],
)
def test_what_cannot_be_had_is_an_error_that_says_why(table, code):
    found = ask("adjustable-path", unknowns="none", **table)
    assert found.candidates == ()
    assert [one.code for one in faults(found.findings)] == [code]
    assert faults(found.findings)[0].remedy


def test_a_sphere_too_small_for_every_candidate_says_how_large():
    found = ask("adjustable-path", unknowns="six", starts=1, radius=10)
    assert found.candidates == ()
    assert "spherical.shafts" in {one.code for one in faults(found.findings)}


def test_a_point_without_direction_is_refused():
    found = ask("four-bar-path", points=[[0, 0, 0], [0, 0, 1], [0, 1, 1]], closed=False)
    assert [one.code for one in faults(found.findings)] == ["spherical.synthesis"]


@pytest.mark.parametrize(
    ("kind", "table"),
    [
        ("adjustable-path", {"turns": [0]}),
        ("adjustable-path", {"path": [[0, 0], [1, 1], [2, 1], [3, 1]]}),
        ("adjustable-path", {"ratio": 0}),
        ("four-bar-path", {"angles": [0, 10]}),
        ("four-bar-path", {"points": [[0, 0, 1]]}),
    ],
)
def test_requirements_that_do_not_go_together(kind, table):
    with pytest.raises(ValueError, match=r"path|turns|ratio|angles|points"):
        Spherical.requirements[kind].model_validate(table)
