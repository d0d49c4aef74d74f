"""Work done at once gives what it gives one after another."""

import threading
from pathlib import Path

import pytest
import shapely

from mechwright.geometry.prepared import prepared
from mechwright.worker_pool.budget import threaded_map


def test_results_come_in_the_order_of_the_items() -> None:
    assert threaded_map(lambda n: n * n, range(9)) == [n * n for n in range(9)]
    assert threaded_map(str, []) == []


def test_the_error_of_the_first_item_is_raised() -> None:
    def fail(n: int) -> int:
        if n:
            raise ValueError(n)
        return n

    with pytest.raises(ValueError, match="1"):
        threaded_map(fail, range(4))


def test_a_single_item_takes_no_thread() -> None:
    assert threaded_map(lambda _: threading.current_thread(), [0]) == [threading.current_thread()]


def test_what_is_prepared_is_a_copy_and_nothing_else_in_cam_prepares():
    shape = shapely.box(0, 0, 2, 1)
    own = prepared(shape)
    assert shapely.is_prepared(own)
    assert not shapely.is_prepared(shape)
    assert shapely.equals_identical(own, shape)
    for path in (Path(__file__).parents[2] / "cam" / "mechwright_cam").rglob("*.py"):
        assert ("shapely.prepare(" in path.read_text(encoding="utf-8")) == (path.name == "threads.py"), path
