"""Turning points against edges, and points against outlines, in cases done by hand."""

import math

import numpy as np
import pytest

from mechwright.mechanics.gearing import contact
from mechwright.mechanics.gearing.contact import depths, turns_to_edges


def test_turns_to_the_edges_of_a_wedge():
    # A wedge of material between the directions 0.1 and 0.4 rad, in radii from 1 to 3.
    corners = np.array(
        [[r * math.cos(a), r * math.sin(a)] for r, a in ((1, 0.1), (3, 0.1), (3, 0.4), (1, 0.4))]
    )
    ends = np.roll(corners, -1, axis=0)
    angles = np.array([0.0, 0.2, 0.5])
    queries = 2 * np.column_stack((np.cos(angles), np.sin(angles)))
    zero = np.zeros(3, dtype=np.int64)
    free = turns_to_edges(queries, zero, corners, ends, np.zeros(4, dtype=np.int64), 0.1, 4.0)
    np.testing.assert_allclose(free.entering_ahead, [0.1, np.inf, np.inf])
    np.testing.assert_allclose(free.leaving_ahead, [0.4, 0.2, np.inf])
    np.testing.assert_allclose(free.entering_behind, [np.inf, 0.1, 0.4])
    np.testing.assert_allclose(free.leaving_behind, [np.inf, np.inf, 0.1])
    np.testing.assert_allclose(free.distance, [0.2, 0.2, 0.2])
    elsewhere = turns_to_edges(queries, zero + 1, corners, ends, np.zeros(4, dtype=np.int64), 0.1, 4.0)
    assert np.isinf(elsewhere.distance).all()


def test_a_circle_cuts_an_edge_twice_that_comes_nearest_between_its_ends():
    starts, ends = np.array([[2.0, -1.0]]), np.array([[2.0, 1.0]])
    zero = np.zeros(1, dtype=np.int64)
    free = turns_to_edges(np.array([[2.1, 0.0]]), zero, starts, ends, zero, 0.1, 4.0)
    turn = math.acos(2 / 2.1)
    assert free.leaving_behind == pytest.approx([turn])  # running inwards, before the nearest point
    assert free.entering_ahead == pytest.approx([turn])
    assert np.isinf(free.leaving_ahead).all()


def test_the_side_of_a_corner_is_that_of_the_steeper_edge():
    # A sharp corner of material at the origin, 30 degrees wide, between +x and 30 degrees above it.
    far = np.array([[4.0, 0.0], [4 * math.cos(math.pi / 6), 2.0]])
    corners = np.vstack(([0.0, 0.0], far))
    angles = np.radians([-100, -170, 170, 130, 15])
    points = 0.1 * np.column_stack((np.cos(angles), np.sin(angles)))
    zero = np.zeros(5, dtype=np.int64)
    found = depths(points, zero, corners, np.roll(corners, -1, axis=0), zero[:3])
    np.testing.assert_allclose(found, [-0.1, -0.1, -0.1, -0.1, 0.1 * math.sin(math.radians(15))], atol=1e-12)
    assert np.isneginf(depths(points, zero + 1, corners, np.roll(corners, -1, axis=0), zero[:3])).all()


@pytest.mark.parametrize("seed", range(6))
def test_many_points_are_compared_with_edges_near_them_alone_and_bits_are_the_same(seed, monkeypatch):
    """Nearest corners are shared by two edges; points lie on edges, in corners and far away."""
    random = np.random.default_rng(seed)
    count = int(random.integers(3, 60))
    angles = np.sort(random.uniform(0, math.tau, count))
    corners = np.column_stack((np.cos(angles), np.sin(angles))) * random.uniform(2, 5, count)[:, None]
    ends = np.roll(corners, -1, axis=0)
    points = np.concatenate((random.uniform(-6, 6, (300, 2)), corners, (corners + ends) / 2, 1.1 * corners))
    group, edges = np.zeros(len(points), np.int64), np.zeros(count, np.int64)
    all_with_all = contact.depths(points, group, corners, ends, edges)
    monkeypatch.setattr(contact, "_FEW_PAIRS", 0)
    monkeypatch.setattr(contact, "_CHUNK", 64)
    assert contact.depths(points, group, corners, ends, edges).tobytes() == all_with_all.tobytes()
