"""Fitting of curves by Bézier segments."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.errors import GeometryError
from mechwright.geometry.fit import HIGHEST_DEGREE, fit_curves, fit_nets
from mechwright.geometry.fit import _distance as distance_of_fits  # noqa: PLC2701


def arcs(radii, sweep):
    def curves(t):
        angle = sweep * t
        return np.asarray(radii)[:, None, None] * np.stack((np.cos(angle), np.sin(angle)), axis=-1)

    return curves


@given(
    st.lists(st.floats(0.1, 50), min_size=1, max_size=4),
    st.floats(0.05, 6),
    st.sampled_from([1e-2, 1e-4, 1e-6]),
)
def test_the_stated_deviation_holds_between_all_points(radii, sweep, tolerance):
    chains, deviation = fit_curves(arcs(radii, sweep), len(radii), tolerance)
    assert deviation <= tolerance
    t = np.linspace(0, 1, 777)
    for radius, chain in zip(radii, chains, strict=True):
        points = np.concatenate([segment.at(t) for segment in chain])
        # The distance from a circle is known exactly. Two per cent is what the sampling may miss.
        assert np.abs(np.hypot(*points.T) - radius).max() <= 1.02 * deviation + 1e-13 * radius


@given(st.floats(0.5, 6), st.sampled_from([1e-3, 1e-8]))
def test_ends_are_exact_and_pieces_share_their_bits(sweep, tolerance):
    curves = arcs([1.0, 20.0], sweep)
    chains, _ = fit_curves(curves, 2, tolerance, "flank")
    ends = curves(np.array([0.0, 1.0]))
    for chain, (first, last) in zip(chains, ends, strict=True):
        assert chain[0].start == tuple(first)
        assert chain[-1].end == tuple(last)
        assert all(a.end == b.start for a, b in pairwise(chain))
        assert {segment.tag for segment in chain} == {"flank"}


def test_the_degree_rises_before_curves_are_cut():
    nets, _ = fit_nets(arcs([10.0], 0.5), 1, 1e-3)
    assert [net.shape for net in nets] == [(1, 4, 2)]
    nets, _ = fit_nets(arcs([10.0], 1.0), 1, 1e-6)
    assert len(nets) == 1
    assert nets[0].shape[1] > 4
    nets, deviation = fit_nets(arcs([10.0], 6.2), 1, 1e-10)
    assert len(nets) > 1
    assert max(net.shape[1] for net in nets) <= HIGHEST_DEGREE + 1
    assert deviation <= 1e-10


def test_a_cubic_is_found_again():
    net = np.array([[0.0, 0], [1, 3], [4, -2], [5, 1]])

    def curve(t):
        t = t[:, None]
        weights = np.hstack(((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3))
        return (weights @ net)[None]

    nets, deviation = fit_nets(curve, 1, 1e-6)
    np.testing.assert_allclose(nets[0][0], net, atol=1e-13)
    assert deviation < 1e-14


def test_a_corner_is_refused():
    def corner(t):
        return np.stack((t, np.abs(t - 0.3)), axis=-1)[None]

    with pytest.raises(GeometryError, match="not smooth enough"):
        fit_nets(corner, 1, 1e-9)


def test_points_that_are_no_numbers_are_refused():
    with pytest.raises(GeometryError, match="no numbers"):
        fit_nets(lambda t: np.full((1, t.size, 2), np.nan), 1, 1e-3)
    with pytest.raises(GeometryError, match="2 curves"):
        fit_nets(arcs([1.0], 1.0), 2, 1e-3)


@given(st.floats(-0.01, 0.01), st.sampled_from([2, 3, 5]), st.sampled_from([0.05, 10.0]))
def test_the_distance_is_to_the_curve_and_not_to_the_point_of_the_same_parameter(lag, degree, length):
    """A net that runs late or early along the same line has no distance from it; one beside it has its own."""
    t = np.linspace(0.1, 0.9, 33)
    net = np.stack((np.linspace(0, length, degree + 1), np.zeros(degree + 1)), axis=-1)[None]
    exact = np.stack((length * (t + lag), np.full_like(t, 0.25)), axis=-1)[None]
    assert distance_of_fits(net, degree, t, exact) == pytest.approx(0.25, abs=1e-12)


def test_the_distance_of_a_point_beyond_the_end_is_to_the_end():
    net = np.array([[[0.0, 0.0], [1.0, 0.0]]])
    beyond = np.array([[[1.5, 0.0], [-0.25, 0.0]]])
    assert distance_of_fits(net, 1, np.array([1.0, 0.0]), beyond) == pytest.approx(0.5)


def test_a_net_that_stands_still_is_as_far_as_its_place():
    net = np.full((1, 3, 2), 2.0)
    assert distance_of_fits(net, 2, np.array([0.5]), np.array([[[2.0, 5.0]]])) == pytest.approx(3.0)
