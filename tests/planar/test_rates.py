"""Only the rates that are needed are computed, and a gap leaves what is behind it."""

import math

import numpy as np
import pytest
from reference_machines import LINKAGES, inputs_of, machine_of

from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.machine import Drive, Machine, Revolute
from mechwright.mechanics.planar.positions import solve


@pytest.mark.parametrize("name", [name for name in LINKAGES if name != "stephenson2"])
@pytest.mark.parametrize("rates", [0, 1, 2])
def test_lower_rates_are_the_same_without_the_higher_ones(name, rates):
    machine, inputs = machine_of(LINKAGES[name]), inputs_of(LINKAGES[name])
    every, some = solve(machine, inputs), solve(machine, inputs, rates=rates)
    for link, body in every.bodies.items():
        found = some.bodies[link]
        for order in ("position", "velocity", "acceleration", "jerk")[: rates + 1]:
            assert np.array_equal(getattr(found.origin, order), getattr(body.origin, order)), (link, order)
        for order in ("theta", "omega", "alpha", "jerk")[: rates + 1]:
            assert np.array_equal(getattr(found.turning, order), getattr(body.turning, order)), (link, order)
    assert all(np.array_equal(some.sines[key], every.sines[key]) for key in every.sines)


def test_the_jerk_that_is_not_computed_is_no_number():
    found = solve(machine_of(LINKAGES["watt1"]), inputs_of(LINKAGES["watt1"]), rates=2)
    assert np.isnan(found.bodies["rocker"].origin.jerk).all()
    assert np.isnan(found.bodies["rocker"].turning.jerk).all()


def test_samples_behind_a_gap_close_and_angles_run_on_over_a_turn():
    """A lever with a toggle on both sides of its mirror line; a crank whose rod turns over, of two designs."""
    joints = [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("A", "crank", "coupler", 70.0, 0j),
        Revolute("B", "coupler", "rocker", 60.0, np.array([[75.0], [60.0]])),
        Revolute("B0", "ground", "rocker", np.array([[110.0], [10.0]]), 0j),
    ]
    phi = np.linspace(-math.pi, 3 * math.pi, 721)
    found = solve(Machine(joints, [Drive("crank")]), [Turning.of(phi, 1.0)])
    limit = math.acos((70**2 + 110**2 - 135**2) / (2 * 70 * 110))
    inside = np.abs(np.remainder(phi + math.pi, math.tau) - math.pi) < limit
    assert np.array_equal(found.closes[0], inside)
    theta = found.bodies["rocker"].turning.theta[1]
    assert np.isfinite(theta).all()
    assert np.abs(np.diff(theta)).max() < 0.5
    assert theta[-1] - theta[0] == pytest.approx(2 * math.tau, abs=1e-9)
