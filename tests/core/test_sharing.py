"""Items shared out between interpreters: the same results as of one, and the same first error."""

import os
import signal
import threading
import time
import warnings
from pathlib import Path

import pytest

from mechwright.worker_pool import pool, sharing
from mechwright.worker_pool.budget import available_cores, limit_cores, limited_cores
from mechwright.worker_pool.sharing import shared

HERE = os.getpid()


class Item:
    """A number with a thing that results refer to."""

    def __init__(self, number: int) -> None:
        self.number, self.thing = number, object()

    def known(self) -> list[object]:
        return [self.thing]


def told(item: Item) -> tuple[int, int, object, int]:
    """Its number, who was asked, its thing, and how many cores there were."""
    return item.number, os.getpid(), item.thing, available_cores()


def odd(number: int) -> int:
    """Raises for an odd number."""
    if number % 2:
        raise ValueError(f"{number} is odd")
    return number


def fallen(item: tuple[int, Path]) -> int:
    """Notes the process, and kills every one but that of the item."""
    process, file = item
    file.write_text(str(os.getpid()))
    if os.getpid() != process:
        os.kill(os.getpid(), signal.SIGKILL)
    return os.getpid()


def locked(item: tuple[int, Path]) -> tuple[int, object]:
    """A result that cannot be copied; notes a process other than that of the item."""
    process, file = item
    if os.getpid() != process:
        file.write_text(str(os.getpid()))
    return os.getpid(), threading.Lock()


def warned(process: int) -> int:
    """Warns in every process but that of the item."""
    if os.getpid() != process:
        warnings.warn("not at home", UserWarning, stacklevel=1)
    return process


@pytest.fixture(autouse=True)
def four_cores_at_once(monkeypatch):
    monkeypatch.setattr(sharing, "START", 0.0)
    with limited_cores(4):
        yield


@pytest.mark.parametrize("most", [1, 2, 3, 8])
def test_every_item_has_one_place_and_none_waits_for_less_than_another_took(most, monkeypatch):
    monkeypatch.setattr(sharing, "START", 2.0)
    seconds = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0]
    found = sharing.assign(seconds, most)
    assert sorted(place for places in found for place in places) == list(range(8))
    ends = [2.0 * (who > 0) + sum(seconds[place] for place in places) for who, places in enumerate(found)]
    assert max(ends) <= max(max(seconds) + 2, (sum(seconds) + 2 * (most - 1)) / most + max(seconds))


def test_results_are_in_order_refer_to_the_items_things_and_come_of_several_processes():
    items = [Item(number) for number in range(3)]
    found = shared(told, items, [1, 1, 1], Item.known)
    assert [number for number, *_ in found] == [0, 1, 2]
    assert all(thing is item.thing for (_, _, thing, _), item in zip(found, items, strict=True))
    assert len({process for _, process, *_ in found}) == 3
    assert sorted(allowed for *_, allowed in found) == [1, 1, 2]
    assert available_cores() == 4


def test_little_work_starts_nothing(monkeypatch):
    monkeypatch.setattr(sharing, "START", 2.0)
    monkeypatch.setattr(pool, "_Worker", None)
    assert shared(odd, [2, 4], [1, 1]) == [2, 4]
    assert shared(odd, [], []) == []
    limit_cores(1)
    assert shared(odd, [2, 4], [100, 100]) == [2, 4]


@pytest.mark.parametrize("numbers", [[1, 2, 3, 4], [2, 1, 3], [2, 2, 3, 1]])
def test_the_first_item_that_fails_tells_whoever_works_on_it(numbers):
    first = next(number for number in numbers if number % 2)
    with pytest.raises(ValueError, match=rf"^{first} is odd$"):
        shared(odd, numbers, [1.0] * len(numbers))


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no way to kill a process here")
def test_what_was_killed_is_done_here(tmp_path):
    files = [tmp_path / "first", tmp_path / "second"]
    killed = []

    def noted(_: float) -> None:
        """Wait until the other process has begun."""
        while not (files[1].exists() and files[1].read_text()):
            time.sleep(0.01)
        killed.append(int(files[1].read_text()))

    assert shared(fallen, [(HERE, file) for file in files], [1, 1], progress=noted) == [HERE, HERE]
    assert killed != [HERE]
    assert files[1].read_text() == str(HERE)


def test_what_cannot_be_copied_is_done_here(tmp_path):
    items = [(HERE, tmp_path / "first"), (HERE, tmp_path / "second")]
    assert [process for process, _ in shared(locked, items, [1, 1])] == [HERE, HERE]
    assert not items[0][1].exists()
    assert items[1][1].read_text() != str(HERE)


def test_warnings_of_others_are_heard_here():
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        assert shared(warned, [HERE, HERE], [1, 1]) == [HERE, HERE]
    assert [str(one.message) for one in heard] == ["not at home"]
