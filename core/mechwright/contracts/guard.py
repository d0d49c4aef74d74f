"""The guard around every call into a plugin: who was called, where, and what was wrong with what came back.

Every method that a class overrides of its contract is wrapped when the class is made, so that a call goes
through the guard whoever makes it. Inside of a call

- an error that nobody expects, ``sys.exit`` among them, becomes a
  :class:`~mechwright.errors.PluginFaultError`;
- what is printed goes to standard error, as standard output belongs to ``--json``: by Python, by a library
  in C that does not hold it back, and by processes that are started;
- the working directory and what else everybody shares is as it was (:mod:`~mechwright.contracts.ground`);
- a family's method has a time, :data:`SECONDS`, or as many as :data:`LIMIT` says;
- the answer is what the contract says (:meth:`~mechwright.contracts.plugin.Plugin.sound`), and parameters
  stay as they were.

The keyboard (:mod:`~mechwright.contracts.stops`), and a want of memory, pass through as they are.
"""

import functools
import inspect
import os
import signal
import sys
import threading
import traceback
import types
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, Protocol

from mechwright.contracts.ground import kept, leave_behind, opened_again
from mechwright.contracts.stops import UnaskedError, listening
from mechwright.errors import DesignError, GeometryError, KinematicsError, MechwrightError, PluginFaultError

LIMIT = "MECHWRIGHT_PLUGIN_SECONDS"
"""Environment variable: the seconds that a call of a family's method may take."""
SECONDS = 600.0
"""Without it; the slowest call of a family that is built in takes a sixth of that."""

LOADING = 60.0
"""Seconds to load a module and make what it registers: those of this program take a hundredth of that."""

OWN = "mechwright"
"""The distribution whose families say what is wrong with a design in words of their own."""
_OURS = f" of {OWN}: "

_lock = threading.Lock()
_inside: list[str] = []
"""Calls that are under way, the outermost first."""
_streams: list[Any] = []
_files: list[tuple[int, int]] = []
"""Numbers of files, and those under which they are kept, while calls are under way."""


class Called(Protocol):
    """What the guard knows of a plugin, and of its contract; :class:`Plugin` says what each of them is."""

    kind: ClassVar[str]
    limited: ClassVar[bool]
    steady: ClassVar[bool]
    unlimited: ClassVar[frozenset[str]]
    piecewise: ClassVar[frozenset[str]]
    derived: ClassVar[frozenset[str]]
    inner: ClassVar[frozenset[str]]
    registered_by: str

    @classmethod
    def sound(cls, method: str, answer: Any, arguments: tuple[Any, ...]) -> Any:
        """The answer of a method, if it is what the contract says; raises UnsoundError if not."""


class UnsoundError(Exception):
    """What is wrong with an answer, in words that follow who gave it."""


class TimeUpError(BaseException):
    """The time of a call is over; not an Exception, so that a plugin that catches any does not go on."""


def guard(cls: "type[Called]", contract: type["Called"]) -> None:
    """Wrap the methods of a contract that a class has of its own, whatever they are and wherever from.

    A method may be a function of the class or of a base that is no plugin, under any name, kept by a cache,
    or anything else that can be called.
    """
    for name in methods_of(contract):
        home, own = next((base, vars(base)[name]) for base in cls.__mro__ if name in vars(base))
        inherited = home in contract.__mro__ and name not in contract.derived
        if inherited or name in contract.inner or getattr(getattr(own, "fget", own), _MARK, False):
            continue
        if not isinstance(vars(contract)[name], property):
            setattr(cls, name, _wrapped(own, name, contract))
        elif hasattr(own, "__get__"):  # else a plain value, which is looked at when it is registered
            setattr(cls, name, property(_wrapped(_asked(own), name, contract)))


def methods_of(contract: "type[Called]") -> list[str]:
    """What is called, or asked for as a property, of the plugins of a contract."""
    return [
        name
        for name, one in vars(contract).items()
        if isinstance(one, (types.FunctionType, property)) and not name.startswith("_")
    ]


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


_MARK = "_goes_through_the_guard"


def _asked(own: Any) -> Callable[[Any], Any]:
    """A function that gives what a property gives, cached or not."""

    def asked(self: Any) -> Any:
        return own.__get__(self, type(self))

    getter = getattr(own, "fget", getattr(own, "func", None))
    return functools.wraps(getter)(asked) if getter else asked


def _wrapped(own: Any, method: str, contract: "type[Called]") -> Callable[..., Any]:
    code = getattr(inspect.unwrap(own) if callable(own) else own, "__code__", _wrapped.__code__)

    @functools.wraps(own, updated=("__dict__",) if isinstance(own, types.FunctionType) else ())
    def called(self: "Called", *arguments: Any, **named: Any) -> Any:
        with _guarded(self, method, code, contract, arguments):
            function = own.__get__(self, type(self)) if hasattr(own, "__get__") else own
            found = function(*arguments, **named)
            if isinstance(found, Iterator) and method not in contract.piecewise:
                found = tuple(found)
            if not isinstance(found, Iterator):
                return contract.sound(method, found, (*arguments, *named.values()))
        return _pieces(self, method, code, contract, found)

    setattr(called, _MARK, True)
    return called


def _pieces(
    plugin: "Called", method: str, code: types.CodeType, contract: "type[Called]", found: Iterator[Any]
) -> Generator[Any, None, None]:
    """What a method gives one after the other, each asked for under the guard."""
    while True:
        with _guarded(plugin, method, code, contract, ()):
            try:
                one = contract.sound(method, next(found), ())
            except StopIteration:
                return
        yield one


@contextmanager
def _guarded(
    plugin: "Called",
    method: str,
    code: types.CodeType,
    contract: "type[Called]",
    arguments: tuple[Any, ...],
) -> Iterator[None]:
    limited = contract.limited and method not in contract.unlimited
    seconds = _seconds() if limited else 0.0
    said = method if isinstance(vars(contract)[method], property) else f"{method}()"
    with _watched(f"{who_of(plugin)}: {said}", seconds, code, own=is_own(plugin)):
        before = repr(arguments[0]) if contract.steady and arguments and len(_inside) == 1 else ""
        yield
        if before and repr(arguments[0]) != before:
            raise UnsoundError("changes the parameters, which are everybody's; work on a copy")


@contextmanager
def _watched(who: str, seconds: float, code: types.CodeType, *, own: bool) -> Iterator[None]:
    """Have what goes wrong meanwhile be told with who was called, in a time if it is above 0."""
    try:
        with _aside(who), _listening(who), _in_time(seconds), _ground(who, code):
            yield
    except (MemoryError, KeyboardInterrupt):
        raise
    except TimeUpError as error:
        raise PluginFaultError(f"{who}: {error}; {LIMIT} in the environment sets another limit") from None
    except MechwrightError as error:
        # Which design is wrong the families of others mostly leave to whoever draws a line.
        if type(error) in {GeometryError, KinematicsError} and not own and who not in str(error):
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
        raise PluginFaultError(f"{who}: {_said(error)}") from error


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

    def __call__(self, *arguments: Any) -> Any:
        """What the function gives."""
        if not self.who:
            return self.function(*arguments)
        code = getattr(self.function, "__code__", CalledLater.__call__.__code__)
        with _watched(f"{self.who}: {self.what}", _seconds(), code, own=_OURS in self.who):
            return self.function(*arguments)


def later(function: Callable[..., Any], what: str) -> CalledLater:
    """A function that the call under way gives away, which knows whose it is; one that does is as it was."""
    return function if isinstance(function, CalledLater) else CalledLater(function, now(), what)


def pieces(given: Iterable[Any], what: str) -> Iterator[bytes]:
    """Bytes that the call under way gives away one by one, each asked for under the guard."""
    who, asked = now(), iter(given)

    def one_by_one() -> Iterator[bytes]:
        while True:
            with _watched(f"{who}: {what}", 0.0, pieces.__code__, own=_OURS in who):
                try:
                    one = next(asked)
                except StopIteration:
                    return
                if not isinstance(one, bytes):
                    raise UnsoundError(f"gives {one!r:.80} among its pieces; bytes are wanted")
            yield one

    return one_by_one()


@contextmanager
def loading(who: str, module: str) -> Iterator[None]:
    """Load a plugin's module: what it prints goes to standard error, the ground is kept, and it has a time.

    Raises TimeUpError in the module.
    """
    with _aside(who), listening(), _in_time(LOADING), kept(f"{module}.py", 1):
        yield


def _listening(who: str) -> AbstractContextManager[None]:
    """Know the keyboard's stops from those of a plugin; ours raise none."""
    return nullcontext() if _OURS in who else listening()


def _ground(who: str, code: types.CodeType) -> AbstractContextManager[None]:
    """The ground, but under plugins of this distribution: their tests watch them, and it takes its time."""
    return nullcontext() if _OURS in who else kept(code.co_filename, code.co_firstlineno)


def who_of(plugin: "Called") -> str:
    """A plugin in words: what registered it, its kind and its name."""
    name = getattr(plugin, "name", type(plugin).__name__)
    return f"{plugin.registered_by}: {plugin.kind} {name}".removeprefix(": ")


def is_foreign() -> bool:
    """Whether the call under way is of a plugin that is not of this distribution."""
    return now().startswith("plugin ") and _OURS not in now()


def is_own(plugin: "Called") -> bool:
    """Whether a plugin is of this distribution, or made by hand."""
    return plugin.registered_by.endswith(f" of {OWN}") or not plugin.registered_by


def _at(error: BaseException) -> str:
    frames = traceback.extract_tb(error.__traceback__)
    return f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""


def _said(error: BaseException) -> str:
    try:
        reason = " ".join(str(error).split())
    except Exception:  # words of its own may fail as well
        reason = ""
    return (f"{type(error).__name__}: {reason}" if reason else type(error).__name__) + _at(error)


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
        with suppress(OSError):
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


def _seconds() -> float:
    said = os.environ.get(LIMIT, "")
    try:
        seconds = float(said or SECONDS)
    except ValueError:
        seconds = -1.0
    if not 0 < seconds < 1e9:
        raise DesignError(f"{LIMIT}: {said!r} is no time in seconds above 0; write one, or leave it out")
    return seconds


@contextmanager
def _in_time(seconds: float) -> Iterator[None]:
    """Raise TimeUpError after some seconds, where the system has an alarm and this thread hears it."""
    if (
        not seconds
        or not hasattr(signal, "setitimer")
        or threading.current_thread() is not threading.main_thread()
        or signal.getitimer(signal.ITIMER_REAL)[0]  # a call inside of another one has what that has left
    ):
        yield
        return

    over = []

    def up(*_: object) -> None:
        over.append(True)
        raise TimeUpError(f"takes more than {seconds:g} s")

    before = signal.signal(signal.SIGALRM, up)
    try:
        signal.setitimer(signal.ITIMER_REAL, seconds)
        yield
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        if over:  # a compiled module that it stops while it loads makes an error of its own of it
            raise TimeUpError(f"takes more than {seconds:g} s") from error
        raise
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
