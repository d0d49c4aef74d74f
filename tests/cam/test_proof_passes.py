"""Places along a way, cuts that last, feeds of an edge in a hole: closed forms of what bounds a pass."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from shop import MILL
from test_proof_parts import paths_of

from mechwright_cam.proof import depth_of_cut
from mechwright_cam.proof.depth_of_cut import MOVES_BETWEEN
from mechwright_cam.proof.rubbing import at_the_edge
from mechwright_cam.proof.simulation import loads_in


def test_places_are_evenly_apart_around_corners() -> None:
    first, last = (
        np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 4.0]]),
        np.array([[10.0, 0.0], [10.0, 4.0], [7.0, 4.0]]),
    )
    places, owner = depth_of_cut._places(first, last, np.array([5, 6, 8]), np.array([5, 6, 8]), 2.0)
    wanted = [[1, 0], [3, 0], [5, 0], [7, 0], [9, 0], [10, 1], [10, 3], [9, 4]]
    np.testing.assert_allclose(places, wanted, atol=1e-9)
    assert owner.tolist() == [5, 5, 5, 5, 5, 6, 6, 8]
    places, owner = depth_of_cut._places(first, last, np.array([5, 6, 8]), np.array([6]), 3.0)
    np.testing.assert_allclose(places, [[10, 1.5]], atol=1e-9)
    assert owner.tolist() == [6]


def test_cuts_last_if_they_are_long_enough_on_end() -> None:
    near, far = MOVES_BETWEEN, MOVES_BETWEEN + 1
    assert list(depth_of_cut._lasting([3, 3 + near], [5.0, 7.0], 12.0)) == [(3, 5.0), (3 + near, 7.0)]
    assert list(depth_of_cut._lasting([3, 3 + near], [5.0, 7.0], 12.1)) == []
    assert list(depth_of_cut._lasting([3, 3 + far], [5.0, 7.0], 12.0)) == []
    assert list(depth_of_cut._lasting([3, 3 + far], [5.0, 7.0], 7.0)) == [(3 + far, 7.0)]
    assert list(depth_of_cut._lasting([], [], 1.0)) == []


def test_a_window_is_on_end_if_the_one_before_is_large_as_well() -> None:
    loads = SimpleNamespace(step=np.array([4, 4, 5, 7, 8, 9]))
    large = np.array([True, True, True, True, False, True])
    assert depth_of_cut._on_end(loads, large).tolist() == [1, 2]  # type: ignore[arg-type]
    assert depth_of_cut._on_end(loads, np.ones(6, dtype=np.bool_)).tolist() == [1, 2, 4, 5]  # type: ignore[arg-type]
    assert depth_of_cut._on_end(loads, np.zeros(6, dtype=np.bool_)).size == 0  # type: ignore[arg-type]


def test_a_long_arc_is_looked_at_closely_where_it_takes_much() -> None:
    """The second turn about a disc of 220 mm takes 0.2 mm of a slot of 6 mm; its box has too many fine cells."""
    paths = paths_of("G0 X110 Y0\nG1 Z-5 F100\nG3 I-110\nG1 Z-5.2\nG3 I-110")
    box = (-120.0, -120.0, 120.0, 120.0)
    job = SimpleNamespace(stock=box, thickness=6.0, gone=(), part=SimpleNamespace(material="aluminium"))
    scene = SimpleNamespace(paths=paths, job=job, simulation=SimpleNamespace(cell=0.5))
    every = loads_in(paths, job, box, 0.5)  # type: ignore[arg-type]
    loads = every.only((every.step == paths.cuts[-1]) & ~every.down)
    assert np.hypot(loads.x, loads.y) == pytest.approx(110, abs=0.5)
    for window in range(4, loads.step.size - 1, 25):
        for limit, stays in ((1.3, False), (1.1, True)):
            assert depth_of_cut._stays(scene, MILL, loads, window, limit) is stays  # type: ignore[arg-type]


def suspects(lines: str, limit: float) -> list[tuple[int, float]]:
    """Cuts, from 0 on, that are deeper than this without a cut before them, and how much of each, mm; 6 mm mill."""
    paths = paths_of(f"G0 X-20 Y0\n{lines}")
    steps, lengths = depth_of_cut._suspects(depth_of_cut._Cuts(paths), MILL, limit, 2.0)
    return [(step - int(paths.cuts[0]), length) for step, length in zip(steps, lengths, strict=True)]


def test_of_a_deep_move_as_much_is_suspected_as_no_cut_before_has_opened() -> None:
    """Places stand a diameter of 6 mm apart; one that a cut before has passed within 1 mm is open."""
    assert suspects("G1 Z-5 F100\nX40", 2.0) == [(1, 60.0)]
    assert suspects("G1 Z-5 F100\nX40", 5.0) == []
    opened = "G1 Z-3 F100\nX10\nG0 Z1\nX-20\nG1 Z-5\nX40"
    assert suspects(opened, 3.0) == [(5, 30.0)]  # the first goes as deep as it may, and reaches half the way
    assert suspects(opened, 2.5) == [(1, 30.0), (5, 30.0)]
    beside = "G1 Z-3 F100\nX40\nG0 Z1\nX-20 Y{}\nG1 Z-5\nX40"
    assert suspects(beside.format(0.99), 3.0) == []
    assert suspects(beside.format(1.01), 3.0) == [(5, 60.0)]
    # What comes later opens nothing for what was before.
    assert suspects("G1 Z-5 F100\nX40\nG0 Z1\nX-20\nG1 Z-3\nX40", 3.0) == [(1, 60.0)]


def test_a_window_is_excused_by_its_own_arcs_alone() -> None:
    """A straight cut before a small hole, and one behind it, may not be fed as the hole may."""
    paths = paths_of("G1 X20 F100\nG3 I-2\nG1 X40")
    line, hole, on = paths.cuts[-3:].tolist()
    for first, last, times in ((line, line, 1.0), (line, hole, 2.5), (hole, hole, 2.5), (on, on, 1.0)):
        loads = SimpleNamespace(first=[first], last=[last], radius=[3.0], down=[False])
        assert at_the_edge(loads, paths, 0) == pytest.approx(times)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("lines", "down", "times"),
    [
        ("G1 X20 F100", False, 1.0),
        ("G1 X3 F100", False, 1.0),
        ("G1 X2.99 F100", False, math.inf),  # chords in a hole that is no wider than two cutters
        ("G1 X2 Y3 F100", False, 1.0),
        ("G1 Z-2 F100", True, 1.0),
        ("G3 I-2 F100", False, 1 + 3 / 2),
        ("G3 I-2 F100\nG3 I-6\nG1 X50", False, 1 + 3 / 2),
        ("G3 I-6 F100\nG3 I-2", True, 1 + 3 / 2),
        ("G3 I-12 F100", False, 1 + 3 / 12),
    ],
)
def test_the_edge_is_faster_than_the_axis_as_its_way_is_longer(lines: str, down: bool, times: float) -> None:
    paths = paths_of(lines)
    first, last = int(paths.cuts[0]), int(paths.cuts[-1])
    loads = SimpleNamespace(first=[first], last=[last], radius=[3.0], down=[down])
    assert at_the_edge(loads, paths, 0) == pytest.approx(times)  # type: ignore[arg-type]
