"""The guard around every call into a plugin: who was called, where, and what was wrong with what came back.

Every method that a class overrides of its contract is wrapped when the class is made, so that a call goes
through the guard whoever makes it. Inside of a call

- an error that nobody expects, ``sys.exit`` among them, becomes a
  :class:`~mechwright.errors.PluginFaultError`;
- what is printed goes to standard error, as standard output belongs to ``--json``: by Python, by a library
  in C that does not hold it back, and by processes that are started;
- the working directory and what else everybody shares is as it was (:mod:`~mechwright.contracts.ground`);
- a family's method has a time, :data:`SECONDS`, or as many as :data:`LIMIT` says;
- the answer is what the contract's annotations say (:mod:`~mechwright.contracts.declared`), and parameters
  stay as they were.

The keyboard (:mod:`~mechwright.contracts.stops`), and a want of memory, pass through as they are.
"""

import os
import sys
import threading
import traceback
import types
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from mechwright.contracts.alarm import TimeUpError as TimeUpError
from mechwright.contracts.alarm import in_time
from mechwright.contracts.ground import kept, leave_behind, opened_again
from mechwright.contracts.stops import UnaskedError, listening
from mechwright.errors import (
    DesignError,
    GeometryError,
    KinematicsError,
    MechwrightError,
    OutputError,
    PluginFaultError,
    ToolError,
)

LIMIT = "MECHWRIGHT_PLUGIN_SECONDS"
"""Environment variable: the seconds that a call of a family's method may take."""
SECONDS = 600.0
"""Without it; the slowest call of a family that is built in takes a sixth of that."""

LOADING = 60.0
"""Seconds to load a module and make what it registers: those of this program take a hundredth of that."""

OWN = "mechwright"
"""The distribution whose families say what is wrong with a design in words of their own."""
_OURS = f" of {OWN}: "
_PACKAGES = frozenset((OWN, "mechwright_cad", "mechwright_cam"))
_CONTRACTS = (f"{OWN}.contracts.", f"{OWN}.geometry.")
"""Modules whose classes plugins make, which say nothing of who does."""

_lock = threading.Lock()
_inside: list[str] = []
"""Calls that are under way, the outermost first."""
_streams: list[Any] = []
_files: list[tuple[int, int]] = []
"""Numbers of files, and those under which they are kept, while calls are under way."""


class UnsoundError(Exception):
    """What is wrong with an answer, in words that follow who gave it."""


def now() -> str:
    """Which call into a plugin is under way, the innermost one; empty if none is."""
    return _inside[-1] if _inside else ""


@contextmanager
def during(who: str) -> Iterator[None]:
    """Let :func:`now` say that a call is under way which was so where it was made, in another process."""
    before = len(_inside)
    _inside.append(who)
    try:
        yield
    finally:
        del _inside[before:]


@contextmanager
def watched(who: str, seconds: float, code: types.CodeType) -> Iterator[bool]:
    """Report what goes wrong meanwhile with the call's name; ``seconds`` above 0 are its time limit.

    Gives whether no other call is under way. Calls of our own plugins neither listen to the keyboard nor keep
    the ground: their tests watch them, and it takes its time.
    """
    ours = _OURS in who
    ground = nullcontext() if ours else kept(code.co_filename, code.co_firstlineno)
    try:
        with _aside(who), nullcontext() if ours else listening(), in_time(seconds, who), ground:
            yield len(_inside) == 1
    except (MemoryError, KeyboardInterrupt):
        raise
    except TimeUpError as error:
        raise PluginFaultError(f"{who}: {error}; {LIMIT} in the environment sets another limit") from None
    except MechwrightError as error:
        if _needs_name(error, who):
            raise type(error)(f"{who}: {error}") from error
        raise
    except UnsoundError as error:
        raise PluginFaultError(f"{who}: {error}") from error
    except UnaskedError as error:
        raise PluginFaultError(f"{who}: {error}{_at(error)}") from error
    except SystemExit as error:
        raise PluginFaultError(
            f"{who}: ends the program by sys.exit({error.code!r}); raise an error"
        ) from error
    except BaseException as error:  # GeneratorExit, or a kind of its own: nobody above expects one
        raise PluginFaultError(f"{who}: {described(error)}") from error


@dataclass(frozen=True)
class CalledLater:
    """A function that a call has given, to be called when the call is long over: its faults are told alike.

    Examples
    --------
    >>> solid = CalledLater(lambda: 1 / 0, "plugin rod of rods: family rod: parts()", "the solid")
    >>> solid()
    Traceback (most recent call last):
    mechwright.errors.PluginFaultError: plugin rod of rods: family rod: parts(): the solid: ...
    """

    function: Callable[..., Any]
    who: str = field(compare=False)
    what: str = field(compare=False)
    check: Callable[..., None] | None = field(default=None, compare=False)
    """Raises UnsoundError where what the function gives for its arguments is wrong."""
    limited: bool = field(default=True, compare=False)
    """Whether a call has a time."""

    def __call__(self, *arguments: Any) -> Any:
        """What the function gives."""
        if not self.who:
            return self.function(*arguments)
        code = getattr(self.function, "__code__", CalledLater.__call__.__code__)
        with watched(f"{self.who}: {self.what}", time_limit() if self.limited else 0.0, code):
            found = self.function(*arguments)
            if self.check is not None:
                self.check(found, *arguments)
            return found


def later(function: Callable[..., Any], what: str, check: Callable[..., None] | None = None) -> CalledLater:
    """A function that the call under way gives away, which knows whose it is; one that does is as it was."""
    return function if isinstance(function, CalledLater) else CalledLater(function, now(), what, check)


_END = object()


def pieces(given: Iterable[Any], what: str) -> Iterator[bytes]:
    """Bytes that the call under way gives away one by one, each asked for under the guard."""

    def are_bytes(piece: object) -> None:
        if piece is not _END and not isinstance(piece, bytes):
            raise UnsoundError(f"gives {piece!r:.80} among its pieces; bytes are wanted")

    following = partial(next, iter(given), _END)
    return iter(CalledLater(following, now(), what, are_bytes, limited=False), _END)


@contextmanager
def loading(who: str, module: str) -> Iterator[None]:
    """Load a plugin's module: what it prints goes to standard error, the ground is kept, and it has a time.

    Raises TimeUpError in the module.
    """
    with _aside(who), listening(), in_time(LOADING, who), kept(f"{module}.py", 1):
        yield


def is_foreign(who: str) -> bool:
    """Whether a call, or a plugin in words, is of another distribution; one made by hand is not."""
    return who.startswith("plugin ") and _OURS not in f"{who}: "


def _needs_name(error: MechwrightError, who: str) -> bool:
    """Whether an error that another's plugin has led to does not say whose call it was.

    Which design is wrong the families of others mostly leave to whoever draws a line. Of a design or a file
    they may say it in words of their own; what they hand to our classes, as the name of a part, they do not.
    """
    if not is_foreign(who) or who in str(error):
        return False
    if type(error) in {GeometryError, KinematicsError}:
        return True
    return type(error) in {DesignError, OutputError, ToolError} and _handed_over(error)


def _handed_over(error: BaseException) -> bool:
    """Whether an error was raised in a class of a contract that the plugin itself has called."""
    modules = [
        str(frame.f_globals.get("__name__", "")) for frame, _ in traceback.walk_tb(error.__traceback__)
    ]
    callers = [name for name in modules if not name.startswith(_CONTRACTS)]
    inside = bool(modules) and modules[-1].startswith(_CONTRACTS)
    return inside and bool(callers) and callers[-1].partition(".")[0] not in _PACKAGES


def _at(error: BaseException) -> str:
    frames = traceback.extract_tb(error.__traceback__)
    return f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else " (unknown place)"


def described(error: BaseException) -> str:
    """An error in one line: its kind, its words, and where it was raised."""
    try:
        reason = " ".join(str(error).split())
    except Exception:  # words of its own may fail as well
        reason = ""
    kind = " ".join(type(error).__name__.split())
    return (f"{kind}: {reason}" if reason else kind) + _at(error)


@contextmanager
def _aside(who: str) -> Iterator[None]:
    """Have what is printed meanwhile go to standard error: for all threads, as a plugin may have its own."""
    with _lock:
        if not _inside:
            _streams[:] = [sys.stdout]
            sys.stdout = sys.stderr
            _files[:] = _turned()
        _inside.append(who)
    try:
        yield
    finally:
        with _lock:
            _inside.remove(who)
            if not _inside:
                _turn_back()


def _turn_back() -> None:
    while _files:
        number, kept_as = _files.pop()
        with suppress(OSError):  # a plugin may have closed that as well
            os.dup2(kept_as, number)
            os.close(kept_as)
    if _streams:
        sys.stdout = opened_again(_streams.pop(), 1)


def abandon() -> None:
    """Let nobody wait for calls that other threads are at; standard output is as before.

    What such a call would give nobody wants any more.
    """
    with _lock:
        _turn_back()
    leave_behind()


def _turned() -> list[tuple[int, int]]:
    """Turn the file of standard output to that of standard error; both as they were, to be set back."""
    found = []
    with suppress(OSError):  # one that was closed before, or no numbers left: then nothing is turned
        for number in (1, 2):
            found.append((number, os.dup(number)))
        os.dup2(2, 1)
    return found


def time_limit() -> float:
    """Seconds that a call with a time may take."""
    said = os.environ.get(LIMIT, "")
    try:
        seconds = float(said or SECONDS)
    except ValueError:
        seconds = -1.0
    if not 0 < seconds < 1e9:
        raise DesignError(f"{LIMIT}: {said!r} is no time in seconds above 0; write one, or leave it out")
    return seconds
