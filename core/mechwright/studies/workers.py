"""Who does the work of a sweep: processes of this machine, or the workers of a Dask cluster."""

import contextlib
import multiprocessing
import os
import signal
import time
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from typing import Any, Protocol

from mechwright.beside import end_with_parent, without_script
from mechwright.cores import cores, keep_to
from mechwright.errors import DesignError, MechwrightError, PluginError
from mechwright.extras import optional, require
from mechwright.scripting.heard import Heard, Teller
from mechwright.studies.portion import Portion
from mechwright.studies.task import Source, Task, fingerprint, unlike

ADDRESS = "DASK_SCHEDULER_ADDRESS"
"""Environment variable: the scheduler whose workers are taken where no other one is named."""

AHEAD = 3
"""Tasks that are given out for each worker: one that is done, one that waits, and one at work."""

Found = bytes | Portion
"""The table of a task, or what came of a slice of it."""

_AGAIN = 3
"""Times that processes are killed without finishing anything until no others are started."""

LOOK = 5.0
"""Seconds between two looks at workers: the pool overlooks one that is killed while it writes a result."""

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


class _Listed:
    """Tasks that are all there from the beginning."""

    def __init__(self, tasks: Sequence[Task]) -> None:
        self._tasks = deque(tasks)

    def take(self) -> Task | None:
        return self._tasks.popleft() if self._tasks else None

    def again(self, task: Task) -> None:
        self._tasks.appendleft(task)


def queue_of(tasks: Queue | Sequence[Task]) -> Queue:
    """Tasks as they are taken one by one."""
    return _Listed(tasks) if isinstance(tasks, Sequence) else tasks


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

    def done(self, source: Source, tasks: Queue | Sequence[Task]) -> Iterator[tuple[Task, Found]]:
        """Each task with what came of it, as soon as it is there; more tasks may be taken then."""
        ...


class Alone:
    """No worker but the process that asks."""

    count = local = 1

    def done(self, source: Source, tasks: Queue | Sequence[Task]) -> Iterator[tuple[Task, Found]]:
        """One after the other."""
        queue = queue_of(tasks)
        while (task := queue.take()) is not None:
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
        self._teller = Teller()

    def done(self, source: Source, tasks: Queue | Sequence[Task]) -> Iterator[tuple[Task, Found]]:
        """A few tasks each ahead; raises PluginError where processes are killed again and again."""
        queue, tries = queue_of(tasks), 0
        while tries < _AGAIN:
            try:
                for one in self._once(source, queue):
                    tries = 0
                    yield one
                return
            except BrokenProcessPool:
                tries += 1
        raise PluginError(
            "--workers: processes were killed again and again, mostly for want of memory; take fewer, or a "
            "smaller study.batch"
        )

    def _once(self, source: Source, tasks: Queue | Sequence[Task]) -> Iterator[tuple[Task, Found]]:
        context, queue = multiprocessing.get_context("spawn"), queue_of(tasks)
        running: dict[Future[tuple[Found, list[Heard]]], Task] = {}
        pool, others = (
            ProcessPoolExecutor(self.count, context, _begin),
            set(multiprocessing.active_children()),
        )
        workers, results, ended = set[Any](), getattr(pool, "_result_queue", None), False
        try:
            while True:
                for task in _some(queue, AHEAD * self.count - len(running)):
                    with _returned(queue, task), without_script():
                        running[pool.submit(source.told, task)] = task
                if not running:
                    ended = True
                    return
                workers |= {*multiprocessing.active_children()} - others
                done = wait(running, LOOK, return_when=FIRST_COMPLETED).done
                if not done and not all(worker.is_alive() for worker in workers):
                    raise BrokenProcessPool("a worker was killed while it wrote")
                for future in done:
                    content, heard = future.result()
                    task = running.pop(future)
                    self._teller.tell(heard)
                    yield task, content
        except BrokenProcessPool:
            while running:  # the one that was given out first is taken first again
                queue.again(running.popitem()[1])
            raise
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            if not ended:  # the interpreter would wait for what workers are at, a minute or more
                for worker in multiprocessing.active_children():
                    if worker not in others:  # whoever calls from Python may have processes of their own
                        worker.terminate()
                _end_results(results)


def _end_results(results: Any) -> None:
    """Have the results of a pool end with its workers.

    A worker that is killed while it writes leaves a part of a result. The pool waits for the rest as long as
    anybody could write it, and the interpreter waits for the pool. This process could: it has the queue.
    """
    with contextlib.suppress(AttributeError, OSError):
        results._writer.close()


@contextlib.contextmanager
def _returned(queue: Queue, task: Task) -> Iterator[None]:
    """Take back a task that could not be given out."""
    try:
        yield
    except Exception:
        queue.again(task)
        raise


def _begin() -> None:
    """A worker: it has one core, and nobody to wait for when whoever asked is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the keyboard stops who asked, who ends this one
    keep_to(1)
    end_with_parent()


def _some(queue: Queue, count: int) -> Iterator[Task]:
    """So many tasks at most."""
    for _ in range(count):
        task = queue.take()
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
    number = count or cores()
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
        self.address, self.local = address, cores()
        self._teller = Teller()

    def done(self, source: Source, tasks: Queue | Sequence[Task]) -> Iterator[tuple[Task, Found]]:
        """A few tasks ahead for each thread; raises PluginError where the cluster cannot do them."""
        queue, client = queue_of(tasks), self._connected(CONNECT)
        while True:
            running: dict[str, tuple[Any, Task]] = {}
            try:
                self._check(client, source.family)
                yield from self._once(client, source, queue, running)
                break
            except MechwrightError:
                raise  # of a disk that is full, which is an OSError as well
            except _lost() as error:
                while running:
                    queue.again(running.popitem()[1][1])
                _closed(client)
                client = self._connected(BACK, str(error))
        _closed(client)

    def _once(
        self, client: Any, source: Source, queue: Queue, running: dict[str, tuple[Any, Task]]
    ) -> Iterator[tuple[Task, Found]]:
        distributed = optional("distributed")
        threads = max(sum(client.nthreads().values()), 1)
        own = fingerprint(source.family)
        # With results it would fetch them by itself, and wait for ever if the scheduler ended meanwhile.
        ended = distributed.as_completed(loop=client.loop)
        while True:
            for task in _some(queue, AHEAD * threads - len(running)):
                with _returned(queue, task):
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
            content, heard = future.result(BACK)
            del running[future.key]
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
                        f"--scheduler: {self.address}: nobody answers within {seconds:g} s{said}"
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
