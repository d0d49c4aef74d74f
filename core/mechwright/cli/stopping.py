"""How a command is stopped: by the keyboard, or by a system that ends or hangs up; all of them tidy up."""

import signal
import threading
from types import FrameType

NOTHING = "nothing was written"
"""What stands when work that writes nothing, or only at its end, is stopped."""

_FIRST = 128
"""What shells add to the number of a signal to make an exit code of it."""

_heard: list[int] = []


class StoppedError(BaseException):
    """A command has been stopped; it says what stands. As the keyboard's it is no fault that some catch."""


def hear() -> None:
    """Have signals that end a program stop it as the keyboard does."""
    if threading.current_thread() is not threading.main_thread():
        return
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        # Whoever ignores the end of a terminal, as nohup does, goes on doing so.
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _stop)


def _stop(number: int, _: FrameType | None) -> None:
    _heard[:] = [number]
    raise KeyboardInterrupt


def exit_code() -> int:
    """Of a command that was stopped: 130 by the keyboard."""
    return _FIRST + (_heard.pop() if _heard else signal.SIGINT)
