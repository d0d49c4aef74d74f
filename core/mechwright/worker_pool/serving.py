"""The process of a worker: it reads calls, and answers them."""

import contextlib
import importlib
import io
import os
import pickle
import signal
import sys
import threading
from collections.abc import Sequence
from dataclasses import dataclass, field
from queue import SimpleQueue
from typing import BinaryIO, NoReturn

from mechwright.contracts.guard import during
from mechwright.worker_pool.budget import limit_cores
from mechwright.worker_pool.lifeline import end_with_parent
from mechwright.worker_pool.pickling import KnownPickler
from mechwright.worker_pool.recorded_warnings import RecordedWarning, record_warnings, take_warnings

_answers: list[BinaryIO] = []
"""The stream of answers, in a worker."""


@dataclass(frozen=True)
class Answer:
    """The answer to a call: its value, or the error that it raised."""

    value: object = None
    error: Exception | None = None
    warnings: Sequence[RecordedWarning] = field(default_factory=take_warnings)


def report_progress(done: float, what: str) -> None:
    """Report to the process that made the call: the part that is done, 0 to 1, and the present step."""
    if _answers:
        _send((done, what))


def _send(message: object, known: Sequence[object] = ()) -> None:
    buffer = io.BytesIO()
    KnownPickler(buffer, known).dump(message)
    _answers[0].write(buffer.getbuffer())
    _answers[0].flush()


def serve(parent: int, cores: int, modules: Sequence[str]) -> NoReturn:
    """Answer calls from standard input until the process that made the worker ends it, or ends itself.

    SIGTERM raises KeyboardInterrupt in a call, which may tidy up. The keyboard stops the parent alone.
    """
    end_with_parent(parent)
    requests: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_read, args=(requests,), daemon=True).start()
    _answers.append(os.fdopen(os.dup(1), "wb"))
    with contextlib.suppress(OSError):  # standard error may be closed
        os.dup2(2, 1)  # a library that prints would spoil the answers
    limit_cores(cores)
    record_warnings()
    for module in modules:
        with contextlib.suppress(ImportError):
            importlib.import_module(module)
    while True:
        _answer(requests.get())


def _read(requests: SimpleQueue[bytes]) -> None:
    """Read requests; end the process, whatever it does, where nobody is left to write one."""
    with contextlib.suppress(EOFError):
        while True:
            requests.put(pickle.load(sys.stdin.buffer))  # noqa: S301 - of the process that started this one
    os._exit(1)


def _answer(request: bytes) -> None:
    known: Sequence[object] = ()
    try:
        signal.signal(signal.SIGTERM, _interrupt)
        function, arguments, known_of, caller = pickle.loads(request)  # noqa: S301
        known = known_of(*arguments) if known_of else ()
        with during(caller):
            answer = Answer(function(*arguments))
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
    except KeyboardInterrupt:
        os._exit(1)  # nothing is left to tidy up, and libraries take a while for it
    except Exception as error:
        answer = Answer(error=error)
    with contextlib.suppress(OSError):  # the disk may be full
        sys.stdout.flush()
    try:
        _send(answer, known)
    except Exception as error:
        _send(Answer(error=error, warnings=answer.warnings))


def _interrupt(*_: object) -> NoReturn:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # tidying up is not interrupted
    raise KeyboardInterrupt
