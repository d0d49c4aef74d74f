"""Who does the work of a sweep: processes of this machine, or the workers of a Dask cluster."""

import contextlib
import os
import time
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import Any, Protocol

from mechwright.errors import DesignError, MechwrightError, PluginError
from mechwright.extras import optional, require
from mechwright.studies.portion import Portion
from mechwright.studies.task import Source, Task, fingerprint, unlike
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.pool import LostError, WorkerPool
from mechwright.worker_pool.recorded_warnings import WarningRelay

ADDRESS = "DASK_SCHEDULER_ADDRESS"
"""Environment variable: the scheduler whose workers are taken where no other one is named."""

AHEAD = 3
"""Tasks that are given out for each worker: one that is done, one that waits, and one at work."""

Found = bytes | Portion
"""The table of a task, or what came of a slice of it."""

_AGAIN = 3
"""Times that processes are killed without finishing anything until no others are started."""

CONNECT = 10.0
"""Seconds until a scheduler has to answer."""

BACK = 60.0
"""Seconds that a scheduler which is gone is waited for."""


class Queue(Protocol):
    """Tasks that workers take."""

    def take(self) -> Task | None:
        """The next task; None where there is none before another one is back, or none at all."""
        ...

    def again(self, task: Task) -> None:
        """Take back a task that nobody does any more."""
        ...


class Workers(Protocol):
    """Does tasks of a study, in any order.

    ``count`` of them work at once, 0 where nobody knows before; ``local`` are the cores of this machine for
    work that only it can do.
    """

    @property
    def count(self) -> int:
        """How many tasks are done at once."""
        ...

    @property
    def local(self) -> int:
        """How many cores of this machine may be used besides."""
        ...

    def done(self, source: Source, tasks: Queue) -> Iterator[tuple[Task, Found]]:
        """Each task with what came of it, as soon as it is there; more tasks may be taken then."""
        ...


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
                for task in _some(tasks, AHEAD * self.count - len(running)):
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


@contextlib.contextmanager
def _returned(tasks: Queue, task: Task) -> Iterator[None]:
    """Take back a task that could not be given out."""
    try:
        yield
    except Exception:
        tasks.again(task)
        raise


def _some(tasks: Queue, count: int) -> Iterator[Task]:
    """So many tasks at most."""
    for _ in range(count):
        task = tasks.take()
        if task is None:
            return
        yield task


def workers_of(count: int | None, scheduler: str) -> "Workers":
    """The workers of a number and an address; by default a process for each core of this machine.

    Raises
    ------
    DesignError
        Both are given.
    PluginError
        The cluster's library is not installed.
    """
    address = scheduler or ("" if count else os.environ.get(ADDRESS, ""))
    if scheduler and count:
        raise DesignError(
            "--workers: goes with processes of this machine, and --scheduler with a cluster; take one"
        )
    if address:
        require("distributed", by="--scheduler" if scheduler else ADDRESS)
        return Cluster(address)
    number = count or available_cores()
    return Alone() if number == 1 else Processes(number)


class Cluster:
    """The workers of a Dask cluster.

    Parameters
    ----------
    address
        Of its scheduler, such as ``tcp://host:8786``.

    What a scheduler knows is gone when it ends: what is missing is then given to the one that comes after it.
    """

    count = 0

    def __init__(self, address: str) -> None:
        self.address, self.local = address, available_cores()
        self._relay = WarningRelay()

    def done(self, source: Source, tasks: Queue) -> Iterator[tuple[Task, Found]]:
        """A few tasks ahead for each thread; raises PluginError where the cluster cannot do them."""
        client = self._connected(CONNECT)
        while True:
            running: dict[str, tuple[Any, Task]] = {}
            try:
                self._check(client, source.family)
                yield from self._once(client, source, tasks, running)
                break
            except MechwrightError:
                raise  # of a disk that is full, which is an OSError as well
            except _lost() as error:
                while running:
                    tasks.again(running.popitem()[1][1])
                _closed(client)
                client = self._connected(BACK, str(error))
        _closed(client)

    def _once(
        self, client: Any, source: Source, tasks: Queue, running: dict[str, tuple[Any, Task]]
    ) -> Iterator[tuple[Task, Found]]:
        distributed = optional("distributed")
        threads = max(sum(client.nthreads().values()), 1)
        own = fingerprint(source.family)
        # With results it would fetch them by itself, and wait for ever if the scheduler ended meanwhile.
        ended = distributed.as_completed(loop=client.loop)
        while True:
            for task in _some(tasks, AHEAD * threads - len(running)):
                with _returned(tasks, task):
                    future = client.submit(source.alike, own, task, pure=False)
                running[future.key] = future, task
                ended.add(future)
            if not running:
                return
            future = next(ended)
            _, task = running[future.key]
            if future.status == "cancelled":
                raise distributed.comm.CommClosedError("the scheduler has ended")
            if future.status == "error":
                raise PluginError(f"--scheduler: a worker failed at {task.name}: {future.exception(BACK)}")
            content, recorded = future.result(BACK)
            del running[future.key]
            self._relay.issue(recorded)
            yield task, content

    def _connected(self, seconds: float, why: str = "") -> Any:
        distributed = optional("distributed")
        self._spelled()
        end = time.monotonic() + seconds
        while True:
            try:
                return distributed.Client(
                    self.address, timeout=max(end - time.monotonic(), 1.0), set_as_default=False
                )
            except OSError as error:
                if time.monotonic() >= end:
                    said = f"; it had ended: {why}" if why else ""
                    raise PluginError(
                        f"--scheduler: {self.address}: no scheduler answers within {seconds:g} s{said}"
                    ) from error
                time.sleep(0.5)

    def _spelled(self) -> None:
        """Refuse what is no address before a client waits for it."""
        optional("distributed")
        from distributed.comm.addressing import parse_address, parse_host_port
        from distributed.comm.registry import get_backend

        try:
            scheme, place = parse_address(self.address)
            get_backend(scheme)
            parse_host_port(place, 0)
        except (ValueError, TypeError) as error:
            raise PluginError(
                f"--scheduler: {self.address}: is no address: {error}; give one such as tcp://host:8786"
            ) from error

    def _check(self, client: Any, family: str) -> None:
        """Refuse a cluster without workers, or with one whose tables could differ from this process's."""
        end = time.monotonic() + CONNECT
        while not client.nthreads():
            if time.monotonic() > end:
                raise PluginError(f"--scheduler: {self.address}: has no workers; start some, and try again")
            time.sleep(0.2)
        own = fingerprint(family)
        for worker, said in client.run(fingerprint, family).items():
            if said != own:
                raise PluginError(f"--scheduler: worker {worker}: {unlike(said, own)}")


def _lost() -> tuple[type[BaseException], ...]:
    """What tells that a scheduler has ended."""
    optional("distributed")
    from concurrent.futures import CancelledError

    return (CancelledError, OSError, TimeoutError)


def _closed(client: Any) -> None:
    with contextlib.suppress(Exception):
        client.close(timeout=2)
