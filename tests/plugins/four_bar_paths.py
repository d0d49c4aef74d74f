"""Paths for tests of what is fitted to them: points, limits, and a linkage that is known."""

import math

import numpy as np
import pytest

from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.synthesis.paths.asked import Limits, PathProblem
from mechwright_four_bar.synthesis.paths.search import path

CLOSED = np.array(
    [
        *(0.5 + 1.1j, 0.4 + 1.1j, 0.3 + 1.1j, 0.2 + 1j, 0.1 + 0.9j, 0.005 + 0.75j, 0.02 + 0.6j, 0.5j, 0.4j),
        *(0.03 + 0.3j, 0.1 + 0.25j, 0.15 + 0.2j, 0.2 + 0.3j, 0.3 + 0.4j, 0.4 + 0.5j, 0.5 + 0.7j, 0.6 + 0.9j),
        0.6 + 1j,
    ]
)
ANY = Limits(1e-3, 1e3, math.radians(1))
ELLIPSE = [(round(40 * math.cos(x), 6), round(18 * math.sin(x), 6)) for x in np.arange(10) * math.tau / 10]


def quiet(part, text=""):
    pass


def free(targets, limits, closed=False, senses=(1, -1), turns=None):
    return PathProblem(np.asarray(targets, dtype=complex), turns, senses, closed, 0.0, limits)


def assert_no_defect(one, targets):
    """The coupler point passes the points in order on one branch, in one turn, with the crank turning fully."""
    steps = np.diff(one.phi)
    assert (steps >= 0).all() or (steps <= 0).all()
    assert abs(one.phi[-1] - one.phi[0]) < math.tau
    assert one.bar.kind.full_turn
    turn = close(one.bar, np.linspace(0, math.tau, 721))
    assert np.isfinite(turn.joint_b).all()
    side = np.sign((turn.coupler.direction * np.conj(turn.follower.direction)).imag)
    assert (side == side[0]).all()
    again = np.sum(np.abs(path(one.bar, one.pivot, one.point, one.phi) - targets) ** 2)
    assert again == pytest.approx(one.squares, rel=1e-9, abs=1e-25)


def known(n=35, turn=5.9, sway=0.05):
    bar, pivot, point = FourBar(30, 80, 70, 90, 0.4), 12 - 7j, 55 + 35j
    phi = 0.3 + np.linspace(0, turn, n) + sway * np.sin(np.arange(n))
    return bar, pivot, point, path(bar, pivot, point, phi), phi
