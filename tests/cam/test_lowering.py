"""Places set onto a grid all at once take what they take one after the other."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright_cam.proof import lowering
from mechwright_cam.proof.lowering import lowered


@settings(max_examples=60, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.integers(0, 4),
    st.integers(0, 60),
    st.sampled_from([1, 50, 1_000_000]),
    st.booleans(),
)
def test_all_at_once_is_one_after_the_other(seed: int, half: int, count: int, chunk: int, even: bool) -> None:
    rng = np.random.default_rng(seed)
    size = 2 * half + 1
    heights = rng.uniform(-1.5, 0.0, (9, 12)).astype(np.float32)
    floors = np.where(rng.random((9, 12)) < 0.2, -1.0, -2.0).astype(np.float32)
    if even:
        floors = np.broadcast_to(np.float32(-1.2), (9, 12))
    heights = np.maximum(heights, floors)
    disc = rng.choice([0.0, 0.25, np.inf], (size, size)).astype(np.float32)
    disc[half, half] = 0.0
    row, column = rng.integers(-half, 9 + half, count), rng.integers(-half, 12 + half, count)
    z = rng.choice([-0.5, -1.0, -1.25, -3.0], count).astype(np.float32)
    at_once = heights.copy()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lowering, "CHUNK", chunk)
        found = lowered(at_once, floors, disc, row, column, z)
    for index in range(count):
        sums = np.zeros(3)
        most = 0.0
        for i, j in zip(*np.nonzero(np.isfinite(disc)), strict=True):
            y, x = row[index] + i - half, column[index] + j - half
            if not (0 <= y < 9 and 0 <= x < 12):
                continue
            tip = max(disc[i, j] + z[index], floors[y, x])
            more = float(heights[y, x] - np.float32(tip))
            if more > 0:
                sums += more * np.array([1, j - half, i - half])
                most = max(most, more)
                heights[y, x] = tip
        assert found.depth[index] == most
        np.testing.assert_allclose(found.sums[index], sums, atol=1e-12)
    np.testing.assert_array_equal(at_once, heights)


def test_one_floor_for_all_cells_of_a_large_plate_is_not_copied() -> None:
    size = 2000
    floors, heights = np.broadcast_to(np.float32(-5.0), (size, size)), np.zeros((size, size), np.float32)
    where, z = np.array([1000]), np.array([-1.0], np.float32)
    tracemalloc.start()
    lowered(heights, floors, np.zeros((3, 3), np.float32), where, where, z)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert heights.sum() == -9.0
    assert most < heights.nbytes / 10


def test_numbers_keep_their_order_and_their_bits_as_whole_ones() -> None:
    numbers = np.array([-np.inf, -3.0, -0.5, -1e-30, 0.0, 1e-30, 0.25, 7.0, np.inf], dtype=np.float32)
    whole = lowering._whole(numbers)
    assert (np.diff(whole) > 0).all()
    assert lowering._single(whole).view(np.int32).tolist() == numbers.view(np.int32).tolist()
