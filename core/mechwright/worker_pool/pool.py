"""Worker processes that take calls from one queue, and end with the process that made them."""

import contextlib
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from functools import partial
from queue import SimpleQueue
from types import TracebackType
from typing import IO, Any, Self, TypeVar

from mechwright.contracts.guard import now
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.worker_pool.budget import split_cores
from mechwright.worker_pool.recorded_warnings import RecordedWarning, WarningRelay
from mechwright.worker_pool.serving import Answer, report_progress

T = TypeVar("T")
R = TypeVar("R")

GRACE = 10.0
"""Seconds that an interrupted call has to tidy up before its process is killed."""

_SERVE = (
    "import pickle, signal, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); "
    "sys.path[:] = pickle.load(sys.stdin.buffer); from mechwright.worker_pool.serving import serve; serve()"
)


class LostError(Exception):
    """The process of a call ended before it answered, or could not be started."""


@dataclass(frozen=True)
class _Call:
    request: bytes
    known: Sequence[object]
    progress: Progress
    future: Future[Any]


def nothing_known(*_: object) -> Sequence[object]:
    """No object of a call's arguments that its value refers to."""
    return ()


class WorkerPool:
    """Interpreters that take calls from one queue; each does one call at a time.

    Interpreters and no threads, because an import holds the interpreter's lock; started afresh, because a
    fork of a process with threads may hang. A worker whose process ends is started again at the next call.

    Parameters
    ----------
    cores
        The cores that each worker may use.
    modules
        Names of modules that each worker imports at once. One that cannot be imported does no harm before a
        call needs it.
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
                self._workers.append(_Worker(self._calls, self._recorded, (count, tuple(modules)), quiet))

    def submit(
        self,
        function: Callable[..., R],
        *arguments: Any,
        known: Callable[..., Sequence[object]] = nothing_known,
        progress: Progress = unheard,
    ) -> Future[R]:
        """Have a worker call a function of a module; :meth:`result` gives the result.

        Parameters
        ----------
        arguments
            Copied by pickle, as is the result.
        known
            A function of the arguments: objects that the result refers to, which stay those of this process.
        progress
            Called by a thread with each :func:`~mechwright.worker_pool.serving.report_progress` of the call.
        """
        future: Future[R] = Future()
        try:
            if not self._workers:
                raise LostError
            request = pickle.dumps((function, arguments, known, now()))
            self._calls.put(_Call(request, known(*arguments), progress, future))
        except Exception as error:
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
        for _ in self._workers:
            self._calls.put(None)
        for worker in self._workers:
            worker.stop(self._grace)
        for worker in self._workers:
            worker.join(self._grace)
        self._workers = []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class _Worker:
    """A thread that has a process of its own answer calls.

    The thread lives as long as the worker: Linux ends a process with the thread that started it.
    """

    def __init__(
        self,
        calls: SimpleQueue[_Call | None],
        recorded: SimpleQueue[RecordedWarning],
        setup: tuple[int, tuple[str, ...]],
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
            try:
                answer = self._answer(call)
            except Exception as error:
                self._end()
                call.future.set_exception(LostError(str(error)))
                continue
            for one in answer.warnings:
                self._recorded.put(one)
            if answer.error is not None:
                call.future.set_exception(answer.error)
            else:
                call.future.set_result(answer.value)
        self._end()

    def _answer(self, call: _Call) -> Answer:
        requests, answers = self._streams()
        pickle.dump(call.request, requests)
        requests.flush()
        while not isinstance(message := _Unpickler(answers, call.known).load(), Answer):
            call.progress(*message)
        return message

    def _streams(self) -> tuple[IO[bytes], IO[bytes]]:
        """Standard input and output of the process, which is started if there is none."""
        with self._lock:
            if self._closed or not sys.executable:
                raise LostError
            begun = self._process is not None
            process = self._process = self._process or subprocess.Popen(  # noqa: S603 - our own interpreter
                # -P: a module in the current folder must not stand in for one of ours.
                [sys.executable, "-P", "-c", _SERVE],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL if self._quiet else None,
            )
        assert process.stdin is not None  # noqa: S101 - asked for above
        assert process.stdout is not None  # noqa: S101
        if not begun:
            pickle.dump(sys.path, process.stdin)
            pickle.dump((os.getpid(), *self._setup), process.stdin)
            process.stdin.flush()
        return process.stdin, process.stdout

    def stop(self, grace: float) -> None:
        """End the process, or interrupt its call where that has time to tidy up."""
        with self._lock:
            self._closed = True
            if self._process is not None:
                self._process.terminate() if grace else self._process.kill()

    def join(self, grace: float) -> None:
        """Wait until the process has ended."""
        self._thread.join(grace or None)
        if self._thread.is_alive() and self._process is not None:
            self._process.kill()
        self._thread.join()

    def _end(self) -> None:
        with self._lock:
            process, self._process = self._process, None
        if process is not None:
            process.kill()
            with contextlib.suppress(OSError), process:  # closes the pipes
                pass


class _Unpickler(pickle.Unpickler):  # noqa: S301 - of what a process of our own has written
    def __init__(self, stream: IO[bytes], known: Sequence[object]) -> None:
        super().__init__(stream)
        self._known = known

    def persistent_load(self, index: Any) -> object:
        return self._known[index]


def side_by_side(
    work: Callable[[T, Progress], R],
    items: Sequence[T],
    budget: int,
    progress: Callable[[int, float, str], None] = lambda *_: None,
) -> Generator[tuple[int, R | None], None, None]:
    """The index of each item and the result of ``work``, as soon as it is there; None if its process ended.

    Parameters
    ----------
    work
        A function of a module, called with an item and a progress callback. Its errors are raised.
    budget
        Cores for all items: at most as many processes work at once. Of fewer items each has several cores.
    progress
        Called with the index of an item, the part of it that is done, 0 to 1, and its present step.

    If the generator is closed, as by the keyboard, the calls under way are interrupted, and killed where they
    have not tidied up within ``GRACE`` seconds.
    """
    events: SimpleQueue[tuple[int, float, str] | Future[R]] = SimpleQueue()
    with WorkerPool(split_cores(budget, min(budget, len(items))), grace=GRACE) as pool:
        running: dict[Future[R], int] = {}
        for index, item in enumerate(items):
            heard = partial(_put, events, index)
            running[pool.submit(work, item, report_progress, progress=heard)] = index
        for future in running:
            future.add_done_callback(events.put)
        while running:
            event = events.get()
            if not isinstance(event, Future):
                progress(*event)
                continue
            try:
                found = pool.result(event)
            except LostError:
                found = None
            yield running.pop(event), found


def _put(events: SimpleQueue[Any], index: int, done: float, what: str) -> None:
    events.put((index, done, what))
