"""Who does the work of a sweep: processes of this machine, or the workers of a Dask cluster."""

import os
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait

from mechwright.errors import DesignError, PluginError
from mechwright.extras import require
from mechwright.studies.address import require_address
from mechwright.studies.cluster import Cluster
from mechwright.studies.task import Source, Task
from mechwright.studies.task_queue import AHEAD, Found, Queue, Workers, some
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.pool import LostError, WorkerPool
from mechwright.worker_pool.recorded_warnings import WarningRelay

ADDRESS = "DASK_SCHEDULER_ADDRESS"
"""Environment variable: the scheduler whose workers are taken where no other one is named."""

_AGAIN = 3
"""Times that processes are killed without finishing anything until no others are started."""


class Alone:
    """No worker but the process that asks."""

    count = local = 1

    def done(self, source: Source, tasks: Queue) -> Iterator[tuple[Task, Found]]:
        """One after the other."""
        while (task := tasks.take()) is not None:
            yield task, source.done(task)


class Processes:
    """Processes of this machine, each with one core.

    Parameters
    ----------
    count
        How many.
    """

    def __init__(self, count: int) -> None:
        self.count = self.local = count
        self._relay = WarningRelay()

    def done(self, source: Source, tasks: Queue) -> Iterator[tuple[Task, Found]]:
        """A few tasks each ahead; raises PluginError where processes are killed again and again."""
        running: dict[Future[Found], Task] = {}
        tries = 0
        with WorkerPool([1] * self.count, relay=self._relay) as pool:
            while True:
                for task in some(tasks, AHEAD * self.count - len(running)):
                    running[pool.submit(source.done, task)] = task
                if not running:
                    return
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    task, tries = running.pop(future), tries + 1
                    try:
                        found = pool.result(future)
                    except LostError:
                        tasks.again(task)
                        if tries < _AGAIN:
                            continue
                        raise PluginError(
                            "--workers: processes were killed again and again, mostly for want of memory; "
                            "take fewer, or a smaller study.batch"
                        ) from None
                    tries = 0
                    yield task, found


def workers_of(count: int | None, scheduler: str | None) -> Workers:
    """The workers of a number and an address; by default a process for each core of this machine.

    Raises
    ------
    DesignError
        Both are given, or the address is none.
    PluginError
        The cluster's library is not installed.
    """
    if scheduler is not None and count:
        raise DesignError(
            "--workers: goes with processes of this machine, and --scheduler with a cluster; take one"
        )
    address = os.environ.get(ADDRESS) or None if scheduler is None and not count else scheduler
    if address is not None:
        by = "--scheduler" if scheduler is not None else ADDRESS
        require_address(address, by)
        require("distributed", by=by)
        return Cluster(address)
    number = count or available_cores()
    return Alone() if number == 1 else Processes(number)
