"""Planar adjustable four-bars projected onto the sphere, against a second computation."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from mechwright.mechanics.adjustable import Limits, Pins, PlaneSpace, Unknowns, fit, settings_of
from mechwright.mechanics.adjustable import Path as Paths
from mechwright_spherical.kinematics.projection import project, unproject
from mechwright_spherical.synthesis.space import SphereSpace
from mechwright_spherical.synthesis.structural import (
    PhasedDesign,
    best_centre,
    errors,
    projected_pins,
    scaled_error,
    smallest_length,
)

FACTS = {
    fact["name"]: fact
    for fact in json.loads(
        (Path(__file__).parents[1] / "data" / "adjustable.json").read_text(encoding="utf-8")
    )["facts"]
}


def planar() -> PhasedDesign:
    """The reference four-bar with two phases."""
    fact = FACTS["adjust.planar4.two.points"]
    design, angles = np.array(fact["inputs"]["design"]), fact["inputs"]["crank_deg"]
    a0, b0 = design[:, 0] + 1j * design[:, 1], design[:, 2] + 1j * design[:, 3]
    r1, r3, length, px, py = design[:, 4:].T
    a = a0 + r1 * np.exp(1j * np.radians([row[0] for row in angles]))
    c, _ = PlaneSpace(0j).third(a, b0, length, r3, np.ones(2))
    p = a + (px + 1j * py) * (c - a) / length
    targets = np.array([complex(*point) for row in fact["expected"] for point in row])
    theta = np.concatenate([np.radians(np.array(row) - row[0]) for row in angles])
    phase = np.repeat([0, 1], [len(row) for row in angles])
    return PhasedDesign(Pins(a0, a, b0, b0, c, p), 0.0, phase, theta, targets)


@pytest.mark.parametrize("name", [name for name in FACTS if name.startswith("project") and "max" in name])
def test_the_error_of_the_projection(name):
    inputs = FACTS[name]["inputs"]
    centre = inputs.get("centre", [24.6, 33.4])
    found = (
        float(scaled_error(planar(), inputs["d"]))
        if centre == [0, 0]
        else (float(errors(planar(), inputs["d"], centre).max()) * inputs["d"])
    )
    assert found == pytest.approx(FACTS[name]["expected"], abs=1e-7)


@pytest.mark.parametrize("d", [150, 300, 600, 1200])
def test_the_follower_s_arc_splits(d):
    pins = projected_pins(planar().pins, np.array([float(d)]), np.zeros((1, 2)))
    space = SphereSpace(np.array([0.0, 0.0, 1.0]))
    arcs = np.degrees(space.apart(pins.b1, pins.c))[0]
    np.testing.assert_allclose(arcs, FACTS[f"project.planar4.d{d}.R3_deg"]["expected"], atol=1e-7)


@pytest.mark.parametrize(
    ("tolerance", "least"), [(2, 327.92), (1, 468.69), (0.5, 666.34), (0.2, 1056.92), (0.1, 1496.29)]
)
def test_the_least_length_for_an_error(tolerance, least):
    assert smallest_length(planar(), tolerance) == pytest.approx(least, abs=0.01)


@pytest.mark.parametrize(
    ("d", "centre", "most"),
    [(150, (24.46, 33.48), 2.4197), (300, (24.60, 33.48), 0.6576), (1200, (24.63, 33.43), 0.0422)],
)
def test_the_best_centre_hardly_depends_on_the_length(d, centre, most):
    at, value = best_centre(planar(), d)
    np.testing.assert_allclose(at, centre, atol=0.1)
    assert value * d <= most * 1.002


def test_there_is_no_optimum_of_the_length():
    values = scaled_error(planar(), np.geomspace(400, 8000, 60))
    assert (np.diff(values) < 0).all()


def test_fitted_on_the_sphere_the_projected_machine_is_exact_and_has_one_set_of_links():
    design, d, centre = planar(), np.array([300.0]), np.array([[50.0, 40.0]])
    start = projected_pins(design.pins, d, centre)
    targets = project(np.column_stack([design.targets.real, design.targets.imag]), 300.0, centre=centre[0]).T
    space = SphereSpace(targets[:, 0])
    unknowns = Unknowns(space, 4, "moving", 2)
    phases = tuple(targets[:, design.phase == k] for k in (0, 1))
    task = Paths(phases, 0.2).task(unknowns, Limits(math.radians(20), 0.02, 2.0))
    x = unknowns.of_pins(Pins(*(getattr(start, name)[:, 0] for name in Pins.__slots__)))
    theta = np.concatenate([design.angles[design.phase == k][1:] for k in (0, 1)])
    before = np.linalg.norm(task.misses(x, theta), axis=-1).max() * 0.2 * 300
    found = fit(task, x[None], theta[None], 100)
    after = np.linalg.norm(task.misses(found.x[0], found.theta[0]), axis=-1).max() * 0.2 * 300
    assert 0.5 < before < 5
    assert after < 1e-9
    pins = unknowns.pins(found.x[0])
    for one, two in ((pins.a0, pins.a), (pins.b1, pins.c)):
        assert np.ptp(space.apart(one, two)) < 1e-12
    assert settings_of(space, pins).crank_chords.shape == (2, 2)


@pytest.mark.parametrize("moves", ["moving", "fixed", "both"])
@pytest.mark.parametrize("bars", [4, 5])
def test_pins_on_the_sphere_give_their_unknowns_back(bars, moves):
    rng = np.random.default_rng(2)
    pole = np.array([2.0, -1.0, 2.0]) / 3
    unknowns = Unknowns(SphereSpace(pole), bars, moves, 3, 0.5 if bars == 5 else 0.0, arm_turned=True)
    pins = unknowns.pins(rng.uniform(-0.5, 0.1, (5, unknowns.size)))
    again = unknowns.pins(unknowns.of_pins(pins))
    for name in Pins.__slots__:
        place = getattr(pins, name)
        assert place.shape == (3, 5, 3)
        np.testing.assert_allclose(np.linalg.norm(place, axis=0), 1.0)
        np.testing.assert_allclose(getattr(again, name), place, atol=1e-12)


def test_the_spherical_reference_comes_back_from_its_points():
    fact = FACTS["adjust.sphere4.two.points"]
    points = tuple(np.array(row).T for row in fact["expected"])
    pin = {name: np.array(FACTS[f"adjust.sphere4.{name}"]["expected"]) for name in ("a1", "b1", "a1n", "b1n")}
    a0, b0 = np.array([0.0, 0, 1]), np.array([math.sin(math.radians(70)), 0, math.cos(math.radians(70))])
    both = [np.stack(pair, axis=-1) for pair in ((a0, a0), (pin["a1"], pin["a1n"]), (b0, b0), (b0, b0))]
    pins = Pins(*both, np.stack([pin["b1"], pin["b1n"]], axis=-1), np.stack([points[0][:, 0]] * 2, axis=-1))
    unknowns = Unknowns(SphereSpace(points[0][:, 0]), 4, "moving", 2)
    x = unknowns.of_pins(pins)
    for name in Pins.__slots__:
        np.testing.assert_allclose(getattr(unknowns.pins(x), name), getattr(pins, name), atol=1e-12)
    theta = np.concatenate([np.radians(np.array(row)[1:] - row[0]) for row in fact["inputs"]["crank_deg"]])
    task = Paths(points, 1.0).task(unknowns, Limits(math.radians(15), 0.05, 2.5))
    np.testing.assert_allclose(task.misses(x, theta), 0, atol=1e-12)
    rng = np.random.default_rng(0)
    found = fit(
        task,
        x + 0.02 * rng.normal(size=(6, x.size)),
        theta + 0.02 * rng.normal(size=(6, theta.size)),
        100,
        (1.0,),
    )
    assert (np.sqrt(found.squares) < 1e-12).sum() >= 5


def test_the_way_back_to_the_plane_is_the_inverse():
    flat = np.random.default_rng(4).uniform(-2, 2, (20, 2))
    np.testing.assert_allclose(unproject(project(flat, 3.0, centre=(0.4, 1.0)), 3.0, centre=(0.4, 1.0)), flat)
