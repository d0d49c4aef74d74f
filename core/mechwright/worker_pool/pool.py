"""Worker processes that take calls from one queue, and end with the process that made them."""

import contextlib
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from queue import SimpleQueue
from typing import IO, Any, TypeVar

from mechwright.contracts.guard import now
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.worker_pool.pickling import KnownUnpickler
from mechwright.worker_pool.recorded_warnings import RecordedWarning, WarningRelay
from mechwright.worker_pool.serving import Answer

R = TypeVar("R")

_SERVE = (
    "import pickle, signal, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); "
    "sys.path[:], setup = pickle.load(sys.stdin.buffer); "
    "from mechwright.worker_pool.serving import serve; serve(*setup)"
)

Known = Callable[..., Sequence[object]]
"""A function of a call's arguments: the objects that the result refers to, and that are not copied."""

_Call = tuple[bytes, Sequence[object], Progress, Future[Any]]


class LostError(Exception):
    """The process of a call ended before it answered, or could not be started."""


class WorkerPool(contextlib.AbstractContextManager["WorkerPool"]):
    """Interpreters that take calls from one queue; each does one call at a time.

    Interpreters and no threads, because an import holds the interpreter's lock; started afresh, because a
    fork of a process with threads may hang. A worker whose process ends is started again at the next call.

    Parameters
    ----------
    cores
        The cores that each worker may use.
    modules
        Names of modules that each worker imports at once, if it can.
    grace
        Seconds that calls have to tidy up when the pool is closed; 0 kills them at once.
    quiet
        Whether to drop what workers print.
    relay
        Issues the warnings of workers.
    """

    def __init__(
        self,
        cores: Sequence[int],
        modules: Sequence[str] = (),
        *,
        grace: float = 0.0,
        quiet: bool = False,
        relay: WarningRelay | None = None,
    ) -> None:
        self._relay, self._grace = relay or WarningRelay(), grace
        self._recorded: SimpleQueue[RecordedWarning] = SimpleQueue()
        self._calls: SimpleQueue[_Call | None] = SimpleQueue()
        self._workers: list[_Worker] = []
        with contextlib.suppress(RuntimeError):  # the system may start no further thread
            for count in cores:
                setup = os.getpid(), count, tuple(modules)
                self._workers.append(_Worker(self._calls, self._recorded, setup, quiet))

    def submit(
        self,
        function: Callable[..., R],
        *arguments: Any,
        known: Known | None = None,
        progress: Progress = unheard,
    ) -> Future[R]:
        """Have a worker call a function of a module; :meth:`result` gives the result.

        Arguments and result are copied by pickle, but for what is ``known``. A thread calls ``progress`` with
        each :func:`~mechwright.worker_pool.serving.report_progress` of the call.
        """
        future: Future[R] = Future()
        try:
            if not self._workers:
                raise LostError
            request = pickle.dumps((function, arguments, known, now()))
            self._calls.put((request, known(*arguments) if known else (), progress, future))
        except Exception as error:  # what cannot be pickled says so in many ways
            future.set_exception(error)
        return future

    def result(self, future: Future[R]) -> R:
        """The result of a call; waits for it, and issues the warnings of workers.

        Raises what the call raises, and LostError if its process ended.
        """
        try:
            return future.result()
        finally:
            while not self._recorded.empty():
                self._relay.issue([self._recorded.get()])

    def close(self) -> None:
        """End all processes; calls without an answer raise LostError."""
        for worker in self._workers:
            self._calls.put(None)
            worker.stop(self._grace)
        for worker in self._workers:
            worker.join(self._grace)
        self._workers = []

    def __exit__(self, *_: object) -> None:
        self.close()


class _Worker:
    """A thread that has a process of its own answer calls.

    The thread lives as long as the worker: Linux ends a process with the thread that started it.
    """

    def __init__(
        self,
        calls: SimpleQueue[_Call | None],
        recorded: SimpleQueue[RecordedWarning],
        setup: tuple[object, ...],
        quiet: bool,
    ) -> None:
        self._calls, self._recorded, self._setup, self._quiet = calls, recorded, setup, quiet
        self._lock, self._closed = threading.Lock(), False
        self._process: subprocess.Popen[bytes] | None = None
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def _work(self) -> None:
        with contextlib.suppress(LostError, OSError):
            self._streams()
        while (call := self._calls.get()) is not None:
            request, known, progress, future = call
            try:
                requests, answers = self._streams()
                pickle.dump(request, requests)
                requests.flush()
                while not isinstance(answer := KnownUnpickler(answers, known).load(), Answer):
                    progress(*answer)
            except Exception as error:  # a process that broke down may leave anything
                self._end()
                future.set_exception(LostError(str(error)))
                continue
            for one in answer.warnings:
                self._recorded.put(one)
            if answer.error is None:
                future.set_result(answer.value)
            else:
                future.set_exception(answer.error)
        self._end()

    def _streams(self) -> tuple[IO[bytes], IO[bytes]]:
        """Standard input and output of the process, which is started if there is none."""
        with self._lock:
            if self._closed or not sys.executable:
                raise LostError
            begun, process = self._process is not None, self._process
            if process is None:
                process = self._process = subprocess.Popen(  # noqa: S603 - our own interpreter and words
                    # -P: a module in the current folder must not stand in for one of ours.
                    [sys.executable, "-P", "-c", _SERVE],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL if self._quiet else None,
                )
        assert process.stdin is not None  # noqa: S101 - asked for above
        assert process.stdout is not None  # noqa: S101
        if not begun:
            pickle.dump((sys.path, self._setup), process.stdin)
            process.stdin.flush()
        return process.stdin, process.stdout

    def stop(self, grace: float) -> None:
        """End the process, or interrupt its call where that has time to tidy up."""
        with self._lock:
            self._closed = True
            if self._process is not None:
                self._process.terminate() if grace else self._process.kill()

    def join(self, grace: float) -> None:
        """Wait until the process has ended; kill it after the time to tidy up."""
        self._thread.join(grace)
        with self._lock:
            if self._process is not None:
                self._process.kill()
        self._thread.join()

    def _end(self) -> None:
        with self._lock:
            process, self._process = self._process, None
        if process is not None:
            process.kill()
            with contextlib.suppress(OSError), process:  # closes the pipes
                pass
