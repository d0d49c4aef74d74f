"""Work in a second interpreter, for what needs libraries that take as long to import as all other work.

The second interpreter is faster, never different: what goes wrong there is done once more in this one, which
also tells the error. A second interpreter and no thread, because an import holds the interpreter's lock; and
started afresh, because a fork of a process with threads may hang.
"""

import contextlib
import importlib
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from types import ModuleType
from typing import IO, TypeVar, cast

if sys.platform == "linux":
    import fcntl

R = TypeVar("R")

_SERVE = "from mechwright.beside import serve; serve({}, {})"

LOOK = 0.2
"""Seconds between two looks whether the caller is still there, where the system does not say it."""


class Beside:
    """A second interpreter that imports some modules, and then works on one call.

    Parameters
    ----------
    modules
        Names; one that cannot be imported does no harm before the call needs it.
    heard
        Told each line that the call prints, on standard output or standard error, by a thread.
    """

    def __init__(self, modules: Sequence[str], heard: Callable[[str], None] | None = None) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._call: tuple[Callable[..., object], tuple[object, ...]] | None = None
        self._alive = -1
        if sys.executable:
            try:
                told, self._alive = os.pipe()
            except OSError:
                return
            try:
                # -P: a module in the current folder must not stand in for one of ours.
                self._process = subprocess.Popen(  # noqa: S603 - our own interpreter and our own words
                    [sys.executable, "-P", "-c", _SERVE.format(os.getpid(), told), *modules],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL if heard is None else subprocess.PIPE,
                    pass_fds=() if os.name == "nt" else (told,),
                )
            except OSError:
                return
            finally:
                os.close(told)
            if heard is not None and self._process.stderr is not None:
                threading.Thread(target=_listen, args=(self._process.stderr, heard), daemon=True).start()

    def ask(self, function: Callable[..., object], *arguments: object) -> None:
        """Begin the call of a function of a module, without side effects; arguments are copied by pickle."""
        self._call = function, arguments
        if self._process is None or self._process.stdin is None:
            return
        try:
            request = pickle.dumps(self._call)
        except Exception:  # noqa: BLE001,RUF100 - what cannot be copied says so in many ways
            self.close()
            return
        # A pipe holds some ten kB, and the other end reads it when its imports are done.
        threading.Thread(target=_send, args=(self._process.stdin, request), daemon=True).start()

    def result(self, kind: type[R]) -> R:
        """What the function gives, of the type ``kind``; raises what it raises."""
        assert self._call is not None  # noqa: S101 - asked before
        answer = self.answer(kind)
        if answer is not None:
            return answer
        function, arguments = self._call
        return cast(R, function(*arguments))

    def answer(self, kind: type[R]) -> R | None:
        """What the second interpreter gives, of the type ``kind``; None if it gave none, or was closed."""
        if self._process is None or self._process.stdout is None:
            return None
        try:
            found = pickle.load(self._process.stdout)  # noqa: S301 - from a process of our own
        except Exception:  # noqa: BLE001,RUF100 - a process that broke down may leave anything
            found = None
        self.close()
        return found if isinstance(found, kind) else None

    def close(self) -> None:
        """End the second interpreter, whatever it is at."""
        process, self._process = self._process, None
        if self._alive >= 0:
            os.close(self._alive)
            self._alive = -1
        if process is None:
            return
        process.kill()
        for stream in (process.stdin, process.stdout):  # who listens closes the third, at its end
            if stream is not None:
                with contextlib.suppress(OSError):
                    stream.close()
        process.wait()


def _send(pipe: IO[bytes], request: bytes) -> None:
    """Write a request; one that cannot be sent is never answered, and then done here."""
    with contextlib.suppress(OSError, ValueError):  # the other end is gone, or the pipe closed meanwhile
        pipe.write(request)
        pipe.flush()


def _listen(pipe: IO[bytes], heard: Callable[[str], None]) -> None:
    with pipe:
        for line in pipe:
            heard(line.decode(errors="replace").rstrip())


def serve(caller: int, told: int) -> None:
    """The second interpreter: read a call from standard input, write what it gives to standard output.

    ``caller`` is the number of the process that waits for it, which keeps the other end of the pipe ``told``
    open as long as it lives; without it this one ends at once.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the keyboard stops the caller, which ends this one
    if sys.platform == "linux":
        # A library that is loaded lets no thread of ours run for seconds; the system's signal needs none.
        signal.signal(signal.SIGIO, signal.SIG_DFL)
        fcntl.fcntl(told, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(told, fcntl.F_SETFL, fcntl.fcntl(told, fcntl.F_GETFL) | os.O_ASYNC)
        if os.getppid() != caller:
            os._exit(1)
    else:
        threading.Thread(target=_end_without, args=(caller,), daemon=True).start()
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # libraries that print would spoil the answer
    for module in sys.argv[1:]:
        with contextlib.suppress(ImportError):
            importlib.import_module(module)
    function, arguments = pickle.load(sys.stdin.buffer)  # noqa: S301 - from the process that started this one
    threading.Thread(target=_end_with_the_caller, daemon=True).start()
    pickle.dump(function(*arguments), answer)
    answer.close()
    os._exit(0)  # nothing is left to tidy up, and the libraries take a while for it


def _end_with_the_caller() -> None:
    sys.stdin.buffer.read()
    os._exit(1)


def _end_without(caller: int) -> None:
    """End when the caller does, whatever this process is at: also before it has read its call."""
    while os.name == "nt" or os.getppid() == caller:  # Windows tells of a parent that is gone
        time.sleep(LOOK)
    os._exit(1)


@contextlib.contextmanager
def without_script() -> Iterator[None]:
    """Have processes of multiprocessing that start meanwhile import no script.

    They import the module ``__main__`` of their parent, and a script that works at its top level, without
    ``if __name__ == "__main__"``, would begin again in each of them.
    """
    script = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = script


def end_with_parent() -> None:
    """Have a process of multiprocessing end with the one that started it, also where that is killed."""
    import multiprocessing

    def end() -> None:
        caller = multiprocessing.parent_process()
        if caller is not None:
            caller.join()
            os._exit(1)

    threading.Thread(target=end, daemon=True).start()
