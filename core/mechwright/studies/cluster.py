"""The workers of a Dask cluster."""

import contextlib
import logging
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from functools import cache, partial
from typing import Any

from mechwright.errors import MechwrightError, PluginError
from mechwright.extras import optional
from mechwright.studies.fingerprint import fingerprint, unlike
from mechwright.studies.task import Source, Task
from mechwright.studies.task_queue import AHEAD, Found, Queue, returned, some
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.recorded_warnings import WarningRelay

PATIENCE = 60.0
"""Seconds that a scheduler and its workers are waited for: at the beginning, and when they are gone."""
_LOOK = 0.02
"""Seconds between two looks at what is done."""
_ASK = 5.0
"""Seconds without a result until the scheduler is asked for its workers, and before it is asked again."""
_TRY = 0.5
"""Seconds between two tries to reach it."""
_LOGS = frozenset(("distributed", "tornado", "asyncio", "dask"))
"""Packages whose loggers say of a connection that is gone what is a traceback."""


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
        with _quiet_library(), contextlib.ExitStack() as clients:
            why = ""
            while True:
                running: dict[str, tuple[Any, Task]] = {}
                try:
                    client = self._connected(why)
                    clients.callback(_closed, client)
                    self._check(client, source.family)
                    yield from self._once(client, source, tasks, running)
                except MechwrightError:
                    raise  # of a disk that is full, which is an OSError as well
                except _lost() as error:
                    while running:
                        tasks.again(running.popitem()[1][1])
                    clients.close()
                    why = _words(error)
                else:
                    return

    def _once(
        self, client: Any, source: Source, tasks: Queue, running: dict[str, tuple[Any, Task]]
    ) -> Iterator[tuple[Task, Found]]:
        distributed = optional("distributed")
        threads = max(sum(_threads(client).values()), 1)
        own = fingerprint(source.family)
        # With results it would fetch them by itself, and wait for ever if the scheduler ended meanwhile.
        ended = distributed.as_completed(loop=client.loop)
        while True:
            for task in some(tasks, AHEAD * threads - len(running)):
                with returned(tasks, task):
                    future = client.submit(source.alike, own, task, pure=False)
                running[future.key] = future, task
                ended.add(future)
            if not running:
                return
            self._await(client, ended)
            future = next(ended)
            _, task = running[future.key]
            if future.status == "cancelled":
                raise distributed.comm.CommClosedError("the scheduler has ended")
            if future.status == "error":
                raise PluginError(
                    f"--scheduler: a worker failed at {task.name}: {_words(future.exception(PATIENCE))}"
                )
            content, recorded = future.result(PATIENCE)
            del running[future.key]
            self._relay.issue(recorded)
            yield task, content

    def _await(self, client: Any, ended: Any) -> None:
        """Wait for a result; raises as :meth:`_check` where the workers are gone, TimeoutError if all is."""
        asked = seen = time.monotonic()
        while not ended.has_ready():
            time.sleep(_LOOK)
            if (now := time.monotonic()) - asked >= _ASK:
                seen = now if _threads(client) else seen
                asked = time.monotonic()
                if now - seen > PATIENCE:
                    raise self._idle()

    def _idle(self) -> PluginError:
        return PluginError(
            f"--scheduler: {self.address}: has had no workers for {PATIENCE:g} s; start some, and try again"
        )

    def _connected(self, why: str = "") -> Any:
        """A client; ``why`` the one before it has ended."""
        connect = _client()
        end = time.monotonic() + PATIENCE
        while True:
            left = max(end - time.monotonic(), 1.0)
            try:
                return _in_time(partial(connect, self.address, timeout=left, set_as_default=False), left)
            except OSError as error:
                if time.monotonic() >= end:
                    said = f"; it had ended: {why}" if why else ""
                    raise PluginError(
                        f"--scheduler: {self.address}: no scheduler answers within {PATIENCE:g} s{said}"
                    ) from error
                time.sleep(_TRY)
            except (
                ValueError,
                TypeError,
                RuntimeError,
            ) as error:  # of something else
                raise PluginError(f"--scheduler: {self.address}: no scheduler: {_words(error)}") from error

    def _check(self, client: Any, family: str) -> None:
        """Refuse a cluster without workers, or with one whose tables could differ from this process's."""
        end = time.monotonic() + PATIENCE
        while not _threads(client):
            if time.monotonic() > end:
                raise self._idle()
            time.sleep(_TRY)
        own = fingerprint(family)
        for worker, said in self._fingerprints(client, family).items():
            if said != own:
                raise PluginError(f"--scheduler: worker {worker}: {unlike(said, own)}")

    def _fingerprints(self, client: Any, family: str) -> dict[str, str]:
        try:
            found: dict[str, str] = client.run(fingerprint, family)
        except _lost():
            raise
        except Exception as error:  # what a worker raises that has no such program
            raise PluginError(
                f"--scheduler: {self.address}: a worker cannot say what it has: {_words(error)}; install the "
                "same there"
            ) from error
        return found


def _in_time(call: Callable[[], Any], seconds: float) -> Any:
    """What a call gives; raises TimeoutError after some seconds, also where the library waits for ever.

    As it does for the first answer of a scheduler that has been stopped.
    """
    found = Future[Any]()

    def work() -> None:
        try:
            found.set_result(call())
        except BaseException as error:
            found.set_exception(error)

    threading.Thread(target=work, daemon=True).start()
    return found.result(seconds)


@cache
def _client() -> Any:
    """The library's class of clients, without the attempt at the end to close what cannot be closed."""
    return type("_Client", (optional("distributed").Client,), {"__del__": lambda _: None})


def _threads(client: Any) -> dict[str, int]:
    """Worker to its threads; raises TimeoutError where the scheduler does not answer."""
    found: dict[str, int] = client.sync(client.scheduler.ncores, workers=None, callback_timeout=PATIENCE)
    return found


def _lost() -> tuple[type[BaseException], ...]:
    """What tells that a scheduler has ended."""
    optional("distributed")
    from concurrent.futures import CancelledError

    return (CancelledError, OSError, TimeoutError)


def _closed(client: Any) -> None:
    with contextlib.suppress(Exception):
        client.close(timeout=2)


def _words(error: BaseException | None) -> str:
    """An error in one line."""
    said = " ".join(str(error).split())
    return said or type(error).__name__


@contextlib.contextmanager
def _quiet_library() -> Iterator[None]:
    """Keep what the library logs apart from what a command says: the error says why it ends."""
    optional("distributed")  # which sets its loggers when it is loaded
    before = []
    for name in [*_LOGS, *logging.root.manager.loggerDict]:
        if name.partition(".")[0] in _LOGS:
            log = logging.getLogger(name)
            before.append((log, log.handlers[:], log.propagate))
            log.handlers[:], log.propagate = [logging.NullHandler()], False
    try:
        yield
    finally:
        for log, handlers, propagate in reversed(before):
            log.handlers[:], log.propagate = handlers, propagate
