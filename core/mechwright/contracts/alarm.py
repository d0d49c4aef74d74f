"""A time for a piece of work in the main thread: by the system's alarm, or by a thread where it has none."""

import contextlib
import ctypes
import os
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from mechwright.systems import alarm, alarm_left


class TimeUpError(BaseException):
    """The time of a call is over; not an Exception, so that a plugin that catches any does not go on."""


_watched: list[bool] = []
"""Whether a thread watches the time of a call."""
AGAIN, MOST_CAUGHT = 1.0, 5
"""Seconds from one alarm to the next of work that has caught the first, and how many it may catch."""
_SETTLED = 0.1
"""Seconds within which an error that was sent to a thread has come there."""


@contextmanager
def in_time(seconds: float, who: str = "") -> Iterator[None]:
    """Raise TimeUpError after some seconds, where this is the main thread.

    Work that catches that error again and again ends the process, with a line that begins with ``who``.

    A call inside of another one has what that has left. Without an alarm, on Windows, a thread sends it,
    which comes when a line of Python is done, and not in the middle of a long wait.
    """
    if not seconds or threading.current_thread() is not threading.main_thread():
        yield
        return
    left = alarm_left()
    if _watched if left is None else left:
        yield
        return
    over: list[bool] = []
    try:
        with _watch(seconds, over) if left is None else _alarm(seconds, over, who):
            yield
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        if over:  # a compiled module that it stops while it loads makes an error of its own of it
            raise TimeUpError(_words(seconds)) from error
        raise


def _words(seconds: float) -> str:
    return f"takes more than {seconds:g} s"


@contextmanager
def _alarm(seconds: float, over: list[bool], who: str) -> Iterator[None]:
    def up(*_: object) -> None:
        over.append(True)
        if len(over) > MOST_CAUGHT:
            with contextlib.suppress(OSError):
                os.write(2, f"mechwright: {who}: {_words(seconds)} and catches what ends it\n".encode())
            os._exit(2)
        raise TimeUpError(_words(seconds))

    with alarm(seconds, AGAIN, up):
        yield


@contextmanager
def _watch(seconds: float, over: list[bool]) -> Iterator[None]:
    # A thread is sent a class, which has no words but its own.
    kind = type("TimeUpError", (TimeUpError,), {"__str__": lambda _: _words(seconds)})
    main, lock, ended = threading.get_ident(), threading.Lock(), threading.Event()

    def watch() -> None:
        if not ended.wait(seconds):
            with lock:
                if not ended.is_set():
                    over.append(True)
                    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(main), ctypes.py_object(kind))

    _watched.append(True)
    threading.Thread(target=watch, daemon=True).start()
    come = False
    try:
        yield
    except TimeUpError:
        come = True
        raise
    finally:
        with lock:
            ended.set()
        _watched.clear()
        if over and not come:  # the work ended as the error was sent, which comes now
            time.sleep(_SETTLED)
