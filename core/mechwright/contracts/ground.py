"""The ground that everybody in a process stands on: what a call may change there is set back, and told.

A call into a plugin may spoil more than its answer: the working directory, the mask of new files, the
environment, standard output, handlers of signals, the state of generators of random numbers, how numpy and
Python treat warnings, the limit of recursion, the locale. The next file, the next call and the next figure of
somebody else would be another one. :func:`kept` notes all of it, sets back what is another afterwards, and
warns of it with who was called; a thread that goes on cannot be set back, and is told alike.

Only the main thread's calls are watched: what another thread finds changed may be anybody's doing. What a
library does to the environment or to the filters of warnings while it is loaded stays.
"""

import contextlib
import gc
import importlib
import locale
import os
import pickle
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from mechwright.systems import STOPS, block_signals, blocked_signals, signals


@dataclass(frozen=True)
class Piece:
    """A piece of the ground.

    Parameters
    ----------
    name
        What it is called in a warning.
    read
        How it stands, to be compared; None where it is not there yet.
    restored
        Sets it back to how it stood.
    by_loading
        Whether libraries change it while they are loaded.
    """

    name: str
    read: Callable[[], Any]
    restored: Callable[[Any], object]
    by_loading: bool = False


_told: set[tuple[str, int, str]] = set()
"""Which warnings were given: each is once for each method, whatever filters say of the next."""
_left: list[threading.Thread] = []


@contextmanager
def kept(file: str, line: int) -> Iterator[None]:
    """Set back what is changed meanwhile, and warn of it, with a place in the source of who was called.

    Raises RuntimeWarning where the filters of warnings make errors of them.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = [piece.read() for piece in PIECES]
    threads, modules = set(threading.enumerate()), len(sys.modules)
    try:
        yield
    finally:
        loaded = len(sys.modules) != modules
        changed = [
            piece.name for piece, was in zip(PIECES, before, strict=True) if _set_back(piece, was, loaded)
        ]
        said = [f"changes {name}, which is everybody's; it is set back" for name in changed]
        going_on = [one for one in threading.enumerate() if not (one.daemon or one in threads)]
        _left.extend(going_on)
        said += [f"leaves the thread {one.name!r} running; end it" for one in going_on]
        for text in said:
            if (file, line, text) not in _told:
                warnings.warn_explicit(text, RuntimeWarning, file, line)
                _told.add((file, line, text))


def threads_left() -> bool:
    """Whether a thread that a call has left still runs, for which the interpreter would wait at its end."""
    return any(one.is_alive() for one in _left)


def leave_behind() -> None:
    """Let the program end without waiting for threads that still run: what they would give nobody wants."""
    _left.extend(one for one in threading.enumerate() if not (one.daemon or one is threading.main_thread()))


def _set_back(piece: Piece, was: Any, loaded: bool) -> bool:
    """Whether a piece was changed, and is as it was again."""
    try:
        now = piece.read()
    except OSError:  # a working directory that was removed
        now = None
    if was is None or now == was or (loaded and piece.by_loading):
        return False
    piece.restored(was)
    return True


def _directory() -> str | None:
    try:
        return os.getcwd()  # noqa: PTH109 - as a text, at each call
    except OSError:
        return None


def _mask() -> int:
    # It cannot be asked without being set; a thread that makes a file meanwhile makes it for its owner alone.
    mask = os.umask(0o077)
    os.umask(mask)
    return mask


def _environment(was: Mapping[str, str]) -> None:
    for name in set(os.environ) - set(was):
        del os.environ[name]
    os.environ.update(was)
    if hasattr(time, "tzset"):
        time.tzset()


def _streams() -> tuple[Any, ...]:
    both = sys.stdout, sys.stderr
    return (*both, *(getattr(one, "closed", None) for one in both))


def _put_back(was: tuple[Any, ...]) -> None:
    out, err = was[:2]
    sys.stderr = opened_again(err, 2)
    sys.stdout = sys.stderr if out is err else opened_again(out, 1)


def opened_again(stream: Any, number: int) -> Any:
    """A stream of text, opened anew upon the file of this number, which stays open, if it was closed."""
    if not getattr(stream, "closed", False):
        return stream
    with contextlib.suppress(OSError, AttributeError):
        return open(number, "w", 1, stream.encoding, stream.errors, closefd=False)
    return stream


_HEARD = (
    *STOPS,
    *signals("SIGALRM", "SIGCHLD", "SIGPIPE"),
)


def _signals() -> tuple[Any, ...]:
    return (blocked_signals(), *map(signal.getsignal, _HEARD))


def _handlers(was: tuple[Any, ...]) -> None:
    for number, handler in zip(_HEARD, was[1:], strict=True):
        if handler is not None:  # one that is not Python's cannot be set from here
            signal.signal(number, handler)
    block_signals(was[0])


def _of(module: str, read: Callable[[Any], Any]) -> Callable[[], Any]:
    """How something of a module stands, if the module is loaded."""

    def reading() -> Any:
        loaded = sys.modules.get(module)
        return None if loaded is None else read(loaded)

    return reading


def _decimal(decimal: Any) -> tuple[Any, ...]:
    """What makes the present context, without the flags that sums raise."""
    _, (*settings, _, traps) = decimal.getcontext().__reduce__()
    return (*settings, [], traps)


def _set_decimal(was: tuple[Any, ...]) -> None:
    decimal = sys.modules["decimal"]
    decimal.setcontext(decimal.Context(*was))


def _filters(was: list[Any]) -> None:
    filters: Any = warnings.filters
    filters[:] = was
    warnings._filters_mutated()  # type: ignore[attr-defined]


def _callbacks(was: list[Any]) -> None:
    gc.callbacks[:] = was


PIECES: tuple[Piece, ...] = (
    Piece("standard output or standard error", _streams, _put_back),
    Piece("the filters of warnings", lambda: list(warnings.filters), _filters, by_loading=True),
    Piece(
        "who shows warnings", lambda: warnings.showwarning, lambda was: setattr(warnings, "showwarning", was)
    ),
    Piece("the working directory", _directory, os.chdir),
    Piece("the mask of new files (umask)", _mask, os.umask),
    Piece("the environment", lambda: dict(os.environ), _environment, by_loading=True),
    Piece("handlers of signals", _signals, _handlers),
    Piece("the limit of recursion", sys.getrecursionlimit, sys.setrecursionlimit),
    Piece("the limit of digits", sys.get_int_max_str_digits, sys.set_int_max_str_digits),
    Piece("whether garbage is collected", gc.isenabled, lambda was: gc.enable() if was else gc.disable()),
    Piece("what is printed of garbage", gc.get_debug, gc.set_debug),
    Piece("who is told of garbage", lambda: list(gc.callbacks), _callbacks),
    Piece(
        "the locale",
        lambda: locale.setlocale(locale.LC_ALL),
        lambda was: locale.setlocale(locale.LC_ALL, was),
    ),
    Piece(
        "the state of random numbers",
        lambda: importlib.import_module("random").getstate(),
        lambda was: sys.modules["random"].setstate(was),
    ),
    Piece(
        "the state of numpy's random numbers",
        _of("numpy", lambda numpy: pickle.dumps(numpy.random.get_state())),
        lambda was: sys.modules["numpy"].random.set_state(pickle.loads(was)),  # noqa: S301 - our own
    ),
    Piece("the context of decimal numbers", _of("decimal", _decimal), _set_decimal),
    Piece(
        "what numpy does about errors",
        _of("numpy", lambda numpy: numpy.geterr()),
        lambda was: sys.modules["numpy"].seterr(**was),
    ),
)
