"""Work done at once gives what it gives one after another."""

import threading

import pytest

from mechwright_cam.threads import together


def test_results_come_in_the_order_of_the_items() -> None:
    assert together(lambda n: n * n, range(9)) == [n * n for n in range(9)]
    assert together(str, []) == []


def test_the_error_of_the_first_item_is_raised() -> None:
    def fail(n: int) -> int:
        if n:
            raise ValueError(n)
        return n

    with pytest.raises(ValueError, match="1"):
        together(fail, range(4))


def test_a_single_item_takes_no_thread() -> None:
    assert together(lambda _: threading.current_thread(), [0]) == [threading.current_thread()]
