"""Processes side by side: every item once, one that is killed is told, and what is stopped tidies up."""

import contextlib
import os
import signal
import time
from pathlib import Path

import pytest

from mechwright.contracts.synthesis import Progress
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.sharing import side_by_side


def squared(item: int, progress: Progress) -> tuple[int, int]:
    """The square of an item and how many cores its process may use; 13 kills its process."""
    progress(0.5, "half")
    if item == 13:
        os.kill(os.getpid(), signal.SIGKILL)
    return item * item, available_cores()


def slept(folder: str, progress: Progress) -> None:
    """Says that it has begun, and whether it could tidy up."""
    try:
        progress(0.1, "sleeping")
        time.sleep(60)
    finally:
        (Path(folder) / "tidy").write_text("")


def test_every_item_is_done_once_and_one_that_kills_its_process_is_told() -> None:
    heard: list[tuple[int, float, str]] = []
    items = [2, 13, 5, 7]
    found = dict(side_by_side(squared, items, 2, lambda *at: heard.append(at)))
    assert found == {0: (4, 1), 1: None, 2: (25, 1), 3: (49, 1)}
    assert sorted(heard) == [(place, 0.5, "half") for place in range(4)]


def failed(item: int, _: Progress) -> int:
    return 1 // item


def test_the_error_of_an_item_is_raised() -> None:
    with pytest.raises(ZeroDivisionError):
        list(side_by_side(failed, [1, 0], 1))


def test_fewer_items_than_cores_share_them() -> None:
    assert sorted(found[1] for _, found in side_by_side(squared, [1, 2], 5) if found) == [2, 3]


def test_nothing_to_do_starts_nothing() -> None:
    assert list(side_by_side(squared, [], 3)) == []


def test_what_is_under_way_is_interrupted_and_tidies_up(tmp_path: Path) -> None:
    def heard(*_: object) -> None:
        raise KeyboardInterrupt

    begun = time.monotonic()
    with (
        contextlib.closing(side_by_side(slept, [str(tmp_path)], 1, heard)) as found,
        pytest.raises(KeyboardInterrupt),
    ):
        next(found)
    assert (tmp_path / "tidy").exists()
    assert time.monotonic() - begun < 50
