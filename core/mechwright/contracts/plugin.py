"""What every class that a plugin registers has in common, and how the host tells their kinds apart.

Glossary
--------
contract
    A class that derives from :class:`Plugin` itself: ``Family``, ``Exporter``, ``Control`` ... It says what
    its subclasses give.
kind
    What people call the subclasses of one contract: a family, a control. The host files each class that is
    registered under the contract it derives from, so a new kind of plugin changes nothing in the host.
"""

import functools
import inspect
import types
from abc import ABC
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, ClassVar

from mechwright.contracts.guard import UnsoundError, time_limit, watched

HOOK_API = 3
"""Version of the contracts of this program; a class states the one that it was written for."""

HOOK_API_SINCE = "0.9"
"""The minor version of this program that brought it, and the only one that reads the version before, too."""

MOVING = "docs/plugins/moving.md"
"""The page that tells how a plugin moves from the version before."""


class Plugin(ABC):
    """The base of all contracts.

    A contract states ``kind`` and ``plural``; its subclasses state ``api`` (by inheritance), ``name``, and
    what the contract annotates. A class is registered by the hook ``mechwright_register``; the host makes one
    instance of it without arguments.
    """

    api: ClassVar[int] = HOOK_API
    name: ClassVar[str]
    """Lower-case name with hyphens, as design files and the command line say it."""

    kind: ClassVar[str] = "plugin"
    """What one of this contract is called, for messages."""
    plural: ClassVar[str] = "plugins"
    """What all of them are called, for listings."""

    guarded: ClassVar[bool] = True
    """Whether calls of its methods go through the guard; of commands they do not, which may print and end."""
    limited: ClassVar[bool] = False
    """Whether a call has a time."""
    steady: ClassVar[bool] = False
    """Whether a call works on parameters, its first argument, that stay as they are."""
    unlimited: ClassVar[frozenset[str]] = frozenset()
    """Methods whose calls have none all the same."""
    piecewise: ClassVar[frozenset[str]] = frozenset()
    """Methods that give one thing after the other; what others give so is gathered by the guard."""
    derived: ClassVar[frozenset[str]] = frozenset()
    """Methods of the contract itself that put together what a class gives: they are guarded as its own."""
    inner: ClassVar[frozenset[str]] = frozenset()
    """Methods that those alone call, inside of their guard."""
    finite: ClassVar[bool] = False
    """Whether all numbers that its methods give have to be finite."""
    registered_by: str = ""
    """What registered it, in words, where the host did: ``"plugin geneva of mechwright"``."""

    def __init_subclass__(cls, **named: Any) -> None:
        super().__init_subclass__(**named)
        contract = contract_of(cls)
        if contract is not None and contract.guarded:
            _guard(cls, contract)

    @classmethod
    def fault(cls) -> str:
        """What else keeps a class from being used, in words that follow its name; nothing if it is sound."""
        contract = contract_of(cls) or cls
        for name in sorted(contract.derived):
            own = getattr(cls, name)
            while getattr(own, _MARK, False):
                own = own.__wrapped__
            if own is not vars(contract)[name]:
                return f"overrides {name}, which is derived since hook API 3; {MOVING} says how to move"
        old = [name for name in _EARLIER if name in vars(contract)]
        return f"its contract has {old[0]}; annotations of its methods say what they give" if old else ""


_EARLIER = ("sound", "named", "texts")
"""Attributes by which contracts of an earlier version checked what methods give."""


def contract_of(cls: type[Plugin]) -> type[Plugin] | None:
    """The contract that a class derives from; None for :class:`Plugin` and for a contract itself."""
    for base in cls.__mro__[1:]:
        if Plugin in base.__bases__:
            return base
    return None


def methods_of(contract: type[Plugin]) -> list[str]:
    """What is called, or asked for as a property, of the plugins of a contract."""
    return [
        name
        for name, one in vars(contract).items()
        if isinstance(one, (types.FunctionType, property)) and not name.startswith("_")
    ]


def who_of(plugin: Plugin) -> str:
    """A plugin in words: what registered it, its kind and its name."""
    name = getattr(plugin, "name", type(plugin).__name__)
    return f"{plugin.registered_by}: {plugin.kind} {name}".removeprefix(": ")


def _guard(cls: type[Plugin], contract: type[Plugin]) -> None:
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
            setattr(cls, name, property(_wrapped(_getter(own), name, contract)))


_MARK = "_goes_through_the_guard"


def _getter(own: Any) -> Callable[[Any], Any]:
    """A function that gives what a property gives, cached or not."""

    def get(self: Any) -> Any:
        return own.__get__(self, type(self))

    getter = getattr(own, "fget", getattr(own, "func", None))
    return functools.wraps(getter)(get) if getter else get


def _wrapped(own: Any, method: str, contract: type[Plugin]) -> Callable[..., Any]:
    code = getattr(inspect.unwrap(own) if callable(own) else own, "__code__", _wrapped.__code__)
    said = method if isinstance(vars(contract)[method], property) else f"{method}()"
    limited = contract.limited and method not in contract.unlimited

    @contextmanager
    def guarded(plugin: Plugin, arguments: tuple[Any, ...] = ()) -> Iterator[None]:
        seconds = time_limit() if limited and plugin.limited else 0.0
        with watched(f"{who_of(plugin)}: {said}", seconds, code) as outermost:
            before = repr(arguments[0]) if contract.steady and arguments and outermost else ""
            yield
            if before and repr(arguments[0]) != before:
                raise UnsoundError("changes the parameters, which are everybody's; work on a copy")

    def one_by_one(plugin: Plugin, found: Iterator[Any]) -> Iterator[Any]:
        while True:
            with guarded(plugin):
                try:
                    one = next(found)
                except StopIteration:
                    return
                one = _declared(contract, method, one)
            yield one

    @functools.wraps(own, updated=("__dict__",) if isinstance(own, types.FunctionType) else ())
    def called(self: Plugin, *arguments: Any, **named: Any) -> Any:
        with guarded(self, arguments):
            function = own.__get__(self, type(self)) if hasattr(own, "__get__") else own
            found = function(*arguments, **named)
            if not isinstance(found, Iterator):
                return _declared(contract, method, found, (*arguments, *named.values()))
            if method not in contract.piecewise:
                return _declared(contract, method, tuple(found), (*arguments, *named.values()))
        return one_by_one(self, found)

    setattr(called, _MARK, True)
    return called


def _declared(
    contract: type[Plugin], method: str, answer: Any, arguments: tuple[Any, ...] | None = None
) -> Any:
    from mechwright.contracts.declared import declared  # it needs numpy, which listings do not

    return declared(contract, method, answer, arguments)
