"""Work on several cores: what crossing threads of libraries leave behind."""

import threading
import warnings

from mechwright.worker_pool.budget import limited_cores, threaded_map


def test_filters_of_warnings_are_as_before_when_threads_have_crossed() -> None:
    """Two threads that set them aside and back leave those of the first, if the second began in between."""
    first_in, both_in, first_out = (threading.Event() for _ in range(3))

    def crossing(place: int) -> int:
        if place:
            first_in.wait(10)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning, lineno=place + 1)
            (both_in if place else first_in).set()
            (first_out if place else both_in).wait(10)
        if not place:
            first_out.set()
        return place

    before = list(warnings.filters)
    with limited_cores(2):
        assert threaded_map(crossing, [0, 1]) == [0, 1]
    assert warnings.filters == before
