"""Who does the work of a sweep: processes of this machine, or the workers of a Dask cluster."""

import contextlib
import itertools
import multiprocessing
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from typing import Any, Protocol

from mechwright.beside import end_with_parent
from mechwright.cores import keep_to
from mechwright.errors import PluginError
from mechwright.extras import optional
from mechwright.scripting.heard import Heard, Teller
from mechwright.sweep.task import Source, Task, fingerprint, unlike

AHEAD = 3
"""Tasks that are given out for each worker: one that is done, one that waits, and one at work."""

_AGAIN = 3
"""Times that processes which were killed are started again."""

CONNECT = 10.0
"""Seconds until a scheduler has to answer."""

BACK = 60.0
"""Seconds that a scheduler which is gone is waited for."""


class Workers(Protocol):
    """Does tasks of a study, in any order."""

    def done(self, source: Source, tasks: Sequence[Task]) -> Iterator[tuple[Task, bytes]]:
        """Each task with its table, as soon as it is there."""
        ...


class Alone:
    """No worker but the process that asks."""

    def done(self, source: Source, tasks: Sequence[Task]) -> Iterator[tuple[Task, bytes]]:
        """One after the other."""
        for task in tasks:
            yield task, source.done(task)


class Processes:
    """Processes of this machine, each with one core.

    Parameters
    ----------
    count
        How many.
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self._teller = Teller()

    def done(self, source: Source, tasks: Sequence[Task]) -> Iterator[tuple[Task, bytes]]:
        """A few tasks each ahead; raises PluginError where processes are killed again and again."""
        left = {task.name: task for task in tasks}
        for _ in range(_AGAIN):
            with contextlib.suppress(BrokenProcessPool):
                for task, content in self._once(source, list(left.values())):
                    del left[task.name]
                    yield task, content
            if not left:
                return
        raise PluginError(
            "--workers: processes were killed again and again, mostly for want of memory; take fewer, or a "
            "smaller study.batch; what is finished stays"
        )

    def _once(self, source: Source, tasks: Sequence[Task]) -> Iterator[tuple[Task, bytes]]:
        context = multiprocessing.get_context("spawn")
        waiting = iter(tasks)
        running: dict[Future[tuple[bytes, list[Heard]]], Task] = {}
        pool, others = ProcessPoolExecutor(self.count, context, _begin), multiprocessing.active_children()
        try:
            while True:
                for task in _some(waiting, AHEAD * self.count - len(running)):
                    running[pool.submit(source.told, task)] = task
                if not running:
                    return
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    task = running.pop(future)
                    content, heard = future.result()
                    self._teller.tell(heard)
                    yield task, content
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            if running:  # stopped: the interpreter would wait for what they are at, a minute or more
                for worker in multiprocessing.active_children():
                    if worker not in others:  # whoever calls from Python may have processes of their own
                        worker.terminate()


def _begin() -> None:
    """A worker: it has one core, and nobody to wait for when whoever asked is gone."""
    keep_to(1)
    end_with_parent()


def _some(tasks: Iterator[Task], count: int) -> list[Task]:
    return list(itertools.islice(tasks, max(count, 0)))


class Cluster:
    """The workers of a Dask cluster.

    Parameters
    ----------
    address
        Of its scheduler, such as ``tcp://host:8786``.

    What a scheduler knows is gone when it ends: what is missing is then given to the one that comes after it.
    """

    def __init__(self, address: str) -> None:
        self.address = address
        self._teller = Teller()

    def done(self, source: Source, tasks: Sequence[Task]) -> Iterator[tuple[Task, bytes]]:
        """A few tasks ahead for each thread; raises PluginError where the cluster cannot do them."""
        left = {task.name: task for task in tasks}
        client = self._connected(CONNECT)
        while left:
            try:
                self._check(client, source.family)
                for task, content in self._once(client, source, list(left.values())):
                    del left[task.name]
                    yield task, content
            except _lost() as error:
                _closed(client)
                client = self._connected(BACK, str(error))
        _closed(client)

    def _once(self, client: Any, source: Source, tasks: Sequence[Task]) -> Iterator[tuple[Task, bytes]]:
        distributed = optional("distributed")
        threads = max(sum(client.nthreads().values()), 1)
        waiting, own = iter(tasks), fingerprint(source.family)
        running: dict[str, tuple[Any, Task]] = {}
        # With results it would fetch them by itself, and wait for ever if the scheduler ended meanwhile.
        ended = distributed.as_completed(loop=client.loop)
        while True:
            for task in _some(waiting, AHEAD * threads - len(running)):
                future = client.submit(source.alike, own, task, pure=False)
                running[future.key] = future, task
                ended.add(future)
            if not running:
                return
            future = next(ended)
            _, task = running.pop(future.key)
            if future.status == "cancelled":
                raise distributed.comm.CommClosedError("the scheduler has ended")
            if future.status == "error":
                raise PluginError(f"--scheduler: a worker failed at {task.name}: {future.exception(BACK)}")
            content, heard = future.result(BACK)
            self._teller.tell(heard)
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
                        f"--scheduler: {self.address}: nobody answers within {seconds:g} s{said}; what is "
                        "finished stays"
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
