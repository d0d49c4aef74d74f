"""Whether a ``KeyboardInterrupt`` is the keyboard's, or was raised by a plugin that no key was pressed for.

A signal is known by its handler having run. So while a plugin runs, the handlers of the signals that stop a
program are listened to; a plugin that swallows one, or makes another error of it, stops nobody from stopping.
"""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from mechwright.systems import STOPS

_WORDS = "raises KeyboardInterrupt, which is the keyboard's; raise an error"

_blocks: list[list[int]] = []
"""For each block that listens, the signals that it has heard, the innermost block last."""


class UnaskedError(BaseException):
    """A ``KeyboardInterrupt`` that no signal has led to."""


@contextmanager
def listening() -> Iterator[None]:
    """Hear signals that stop the program: one that is swallowed meanwhile stops it at the end.

    Raises UnaskedError instead of a KeyboardInterrupt without a signal, as all of a thread beside the first
    are: no handler is run there.
    """
    if threading.current_thread() is not threading.main_thread():
        try:
            yield
        except KeyboardInterrupt as error:
            raise UnaskedError(_WORDS).with_traceback(error.__traceback__) from error
        return
    block: list[int] = []
    before = {one: handler for one in STOPS if callable(handler := signal.getsignal(one))}
    _blocks.append(block)
    try:
        for number, handler in before.items():
            signal.signal(number, _heard_by(block, handler))
        yield
    except BaseException as error:
        if block:
            raise KeyboardInterrupt from error
        if isinstance(error, KeyboardInterrupt):
            raise UnaskedError(_WORDS).with_traceback(error.__traceback__) from error
        raise
    else:
        if block:
            raise KeyboardInterrupt
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        del _blocks[-1]


def is_stop(error: BaseException) -> bool:
    """Whether an error within a block stops the program: outside of all, any that says so."""
    return isinstance(error, KeyboardInterrupt) and (not _blocks or bool(_blocks[-1]))


def _heard_by(block: list[int], handler: Callable[[int, FrameType | None], Any]) -> Callable[..., Any]:
    def hear(number: int, frame: FrameType | None) -> Any:
        try:
            return handler(number, frame)
        except KeyboardInterrupt:
            block.append(number)
            raise

    return hear
