"""Least squares from many starts at once."""

import numpy as np
import pytest

from mechwright.mechanics.multistart import HOPELESS_AFTER, distinct, least_squares


def circle_and_hyperbola(x):
    return np.stack((x[:, 0] ** 2 + x[:, 1] ** 2 - 5, x[:, 0] * x[:, 1] - 2), axis=-1)


def its_slopes(x):
    return np.stack((np.stack((2 * x[:, 0], 2 * x[:, 1]), -1), np.stack((x[:, 1], x[:, 0]), -1)), axis=1)


@pytest.mark.parametrize("slopes", [None, its_slopes])
def test_all_four_intersections_are_found(slopes):
    starts = np.random.default_rng(1).normal(0, 2, (200, 2))
    heard = []
    x, costs = least_squares(circle_and_hyperbola, starts, 60, 1e-28, heard.append, slopes)
    arrived = x[costs < 1e-26]
    points = arrived[distinct(arrived, 1e-9)]
    assert sorted(map(tuple, points.round(9).tolist())) == [(-2, -1), (-1, -2), (1, 2), (2, 1)]
    assert heard == sorted(heard)
    assert 0 < heard[0] <= heard[-1] <= 1


def test_given_slopes_replace_the_differences():
    """With a slope of the wrong sign no step helps, and the start stays where it is."""
    start = np.array([[3.0]])
    x, _ = least_squares(lambda x: x - 1, start, 40, 0.0, slopes=lambda x: -np.ones((len(x), 1, 1)))
    np.testing.assert_array_equal(x, start)


def test_what_means_nothing_is_left_out_and_what_is_hopeless_stops():
    def roots(x):
        return np.sqrt(x) + 1

    x, costs = least_squares(roots, np.array([[-1.0], [4.0]]), HOPELESS_AFTER + 30, 1e-28)
    assert x.shape == (1, 1)
    assert costs[0] >= 1
