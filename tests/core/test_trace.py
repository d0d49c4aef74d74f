"""The trace test, on systems whose numbers of solutions are known."""

import numpy as np
import pytest

from mechwright.mechanics.continuation import Start, System
from mechwright.mechanics.continuation.trace import Cut, trace, whole_cut

CUBIC = System(lambda z, p: [z[0] * z[0] * z[0] + z[0] * p[0] + p[1]])
"""Three solutions at almost all p; a point is led to the others by loops."""

CURVES = System(lambda z, p: [z[0] * z[0] - z[1] - p[0], z[1] * z[1] * p[1] - z[0] - p[2]])
"""Two parabolas, which meet in four points."""


def solutions_of_cubic(parameters):
    return np.roots([1, 0, *parameters])[:, None]


def solutions_of_curves(parameters):
    p, q, r = parameters
    first = np.roots([q, 0, -2 * p * q, -1, p * p * q - r])
    return np.stack([first, first**2 - p], axis=1)


def somewhere(count):
    rng = np.random.default_rng(3)
    return rng.normal(size=count) + 1j * rng.normal(size=count)


def whole(system, solve, count):
    parameters = somewhere(count)
    start = Start(parameters, solve(parameters))
    return whole_cut(system, start, 0, count, np.random.default_rng(4), lambda count: None)


@pytest.mark.parametrize(
    ("system", "solve", "parameters", "solutions"),
    [(CUBIC, solutions_of_cubic, 2, 3), (CURVES, solutions_of_curves, 3, 4)],
)
def test_the_slope_is_the_number_of_solutions(system, solve, parameters, solutions):
    found = trace(system, whole(system, solve, parameters))
    assert found is not None
    assert found.proves(solutions, 1e-18)
    assert not found.proves(solutions - 1, 1e-18)


def test_a_start_that_lacks_solutions_gets_them():
    """Loops of the cut bring what the start did not have, and the slope says how many there are."""
    parameters = somewhere(3)
    start = Start(parameters, solutions_of_curves(parameters)[:1])
    found = trace(CURVES, whole_cut(CURVES, start, 0, 3, np.random.default_rng(4), lambda count: None))
    assert found is not None
    assert found.proves(4, 1e-18)


def test_a_cut_that_lacks_a_point_bends():
    every = whole(CURVES, solutions_of_curves, 3)
    for number in range(len(every.points)):
        part = Cut(every.base, every.way, 0, every.numbers, np.delete(every.points, number, axis=0))
        found = trace(CURVES, part)
        assert found is not None
        assert abs(complex(found.bend)) > 1e-4
        assert not any(found.proves(count, 1e-3) for count in range(8))


def test_a_point_that_is_there_twice_proves_nothing():
    every = whole(CUBIC, solutions_of_cubic, 2)
    twice = Cut(every.base, every.way, 0, every.numbers, np.concatenate((every.points, every.points[:1])))
    assert trace(CUBIC, twice) is None
