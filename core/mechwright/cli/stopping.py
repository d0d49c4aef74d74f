"""How a command is stopped: by the keyboard, or by a system that ends or hangs up; all of them tidy up."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

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
        known = (getattr(signal, name, None) for name in ("SIGINT", "SIGTERM", "SIGHUP"))
        # Whoever ignores the end of a terminal, as nohup does, goes on doing so.
        usual = (signal.SIG_DFL, signal.default_int_handler)
        before = {one: signal.getsignal(one) for one in known if one is not None}
        before = {one: handler for one, handler in before.items() if handler in usual}
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


def exit_code() -> int:
    """Of a command that was stopped: 130 by the keyboard."""
    return _FIRST + (_heard.pop() if _heard else signal.SIGINT)
