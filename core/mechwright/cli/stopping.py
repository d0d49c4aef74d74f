"""How a command is stopped: by the keyboard, or by a system that ends or hangs up; all of them tidy up."""

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

from mechwright.cli.streams import say
from mechwright.systems import STOPS

NOTHING = "nothing was written"
"""What stands when work that writes nothing, or only at its end, is stopped."""

_FIRST = 128
"""What shells add to the number of a signal to make an exit code of it."""

_heard: list[int] = []


class StoppedError(BaseException):
    """A command has been stopped; it says what stands. As the keyboard's it is no fault that some catch."""


@contextmanager
def heard() -> Iterator[None]:
    """Have signals that end a program stop it as the keyboard does, as long as the block lasts."""
    _heard.clear()
    before = {}
    if threading.current_thread() is threading.main_thread():
        # Whoever ignores the end of a terminal, as nohup does, goes on doing so.
        usual = (signal.SIG_DFL, signal.default_int_handler)
        before = {one: handler for one in STOPS if (handler := signal.getsignal(one)) in usual}
    for number in before:
        signal.signal(number, _stop)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def stopped() -> bool:
    """Whether a signal has come: compiled modules that it stops while they load raise errors of their own."""
    return bool(_heard)


def _stop(number: int, _: FrameType | None) -> None:
    _heard[:] = [number]
    raise KeyboardInterrupt


def deaf() -> None:
    """Let nothing stop the process any more; its last words are being said."""
    if threading.current_thread() is threading.main_thread():
        for number in STOPS:
            signal.signal(number, signal.SIG_IGN)


def ended(stands: str = "") -> NoReturn:
    """End what has been stopped: a line that says what stands, and exit code 130 by the keyboard."""
    deaf()
    say(f"mechwright: stopped; {stands or NOTHING}")
    # Python would end by the signal, whatever the code, if the keyboard came while a text was executed,
    # as dataclasses do; it forgets that with the next text.
    exec("")  # noqa: S102
    sys.exit(_FIRST + (_heard.pop() if _heard else signal.SIGINT))
