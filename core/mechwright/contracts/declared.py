"""Whether a value is what an annotation declares, a dataclass field by field.

Python keeps nobody from building a ``Part`` with a text where a height is wanted. Whoever reads that height
fails much later, and looks guilty. So the guard asks here of all that a plugin gives, before it is read.
"""

import ast
import inspect
import math
import sys
import types
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from functools import cache
from importlib import import_module
from itertools import takewhile
from textwrap import dedent
from typing import (
    Annotated,
    Any,
    ClassVar,
    Literal,
    Self,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)
from weakref import WeakValueDictionary

import numpy as np

from mechwright.contracts.guard import UnsoundError
from mechwright.contracts.parameters import Parameters
from mechwright.geometry import Loop, Outline

SHOWN = 80
"""Characters that are shown of what is none."""

_WANTED = " is wanted"

_SOUND: dict[bool, WeakValueDictionary[int, Any]] = {
    True: WeakValueDictionary(),
    False: WeakValueDictionary(),
}
"""Outlines that have been looked through, whether for finite numbers too or not: they never change, are given
again and again, and have thousands of segments."""

Fault = tuple[str, str]
"""Where in the value, as ``.instances[0].z``, and what is wrong there."""


@dataclass(frozen=True)
class Declared:
    """What is asked of values.

    Parameters
    ----------
    leave
        Classes whose values are not looked into.
    finite
        Whether numbers have to be finite.
    nan
        Whether numbers may be NaN, for what there is not.
    """

    leave: tuple[type, ...] = ()
    finite: bool = True
    nan: bool = False

    def fault(self, value: Any, kind: Any) -> Fault | None:
        """The first thing in a value that is not what its annotation says; None if there is none.

        What an annotation names that cannot be found, as it is imported for type checkers alone, may be
        anything.

        >>> Declared().fault((1.0, "a"), tuple[float, ...])
        ('[1]', "is 'a'; a number is wanted")
        >>> Declared().fault({"a": 1.0}, Mapping[str, float])
        """
        return next(_Walk(self).faults(value, kind), None)


def declared(contract: Any, method: str, answer: Any, arguments: tuple[Any, ...] | None = None) -> Any:
    """The answer of a contract's method, if it is what the method's annotation declares.

    An annotation says all that is asked: ``Annotated[Sequence[Part], Declared(), hold_parts]`` is held to the
    kind, to that :class:`Declared`, and by the function, which takes the answer and the arguments. It raises
    UnsoundError, or gives what stands for the answer; None leaves it. Where ``arguments`` is None, the answer
    is one of those that a method gives one by one.

    Raises
    ------
    UnsoundError
        What is wrong with it; the guard says whose it is.
    """
    kind = gives(contract, method)
    if arguments is None and get_origin(kind) is Iterator:
        (kind,) = get_args(kind)
    more = getattr(kind, "__metadata__", ())
    asked = next((one for one in more if isinstance(one, Declared)), Declared(finite=contract.finite))
    refuse(asked.fault(answer, kind))
    for hold in more:
        if not isinstance(hold, Declared) and (other := hold(answer, *(arguments or ()))) is not None:
            answer = other
    return answer


@cache
def gives(contract: Any, method: str) -> Any:
    """What a method or property of a contract gives, as its annotation declares it."""
    own = vars(contract)[method]
    function = getattr(own, "fget", own)
    return _of_contract(function.__annotations__["return"], function.__module__, contract)


def unstated(contract: Any, cls: Any) -> str:
    """What is wrong with the attributes that a class states of its contract, in words that follow its name.

    Those are the ones that the contract annotates, and its properties where a class has a value instead.
    """
    annotated = inspect.get_annotations(contract)
    plain = [name for name, own in vars(contract).items() if isinstance(own, property)]
    for name in (*annotated, *plain):
        value = inspect.getattr_static(cls, name, None)
        if not hasattr(cls, name):
            return f"has no {name}"
        if name in plain and hasattr(value, "__get__"):
            continue  # asked for, and held, call by call
        kind = (
            _of_contract(annotated[name], contract.__module__, contract)
            if name in annotated
            else gives(contract, name)
        )
        found = Declared(finite=False).fault(getattr(cls, name), kind)
        if found is not None:
            return f"{name}{found[0]} {found[1]}"
    return ""


def refuse(found: Fault | None) -> None:
    """Raise UnsoundError where a fault was found."""
    if found is not None:
        where, said = found
        if not where and said.startswith("is "):
            raise UnsoundError(f"gives {said.removeprefix('is ')}")
        raise UnsoundError(f"{where.lstrip('.')} of what it gives {said}".removeprefix(" of "))


def shown(value: Any) -> str:
    """A value in few characters, whatever its own words do."""
    try:
        return " ".join(repr(value).split())[:SHOWN]
    except Exception:  # words of a plugin's own may fail in any way
        return f"a {type(value).__name__}"


_PLAIN = {int: "a whole number", str: "a text", bool: "True or False", bytes: "bytes"}


class _Walk:
    """One way through a value, on which no dataclass is looked into twice."""

    def __init__(self, asked: Declared) -> None:
        self._asked = asked
        self._seen: dict[int, Any] = {}

    def faults(self, value: Any, kind: Any) -> Iterator[Fault]:
        origin, arguments = get_origin(kind), get_args(kind)
        if type(whole := origin or kind).__name__ == "TypeAliasType":  # from Python 3.12 on, as NDArray is
            yield from self.faults(value, whole.__value__[arguments] if arguments else whole.__value__)
        elif origin in {Union, types.UnionType}:
            yield from self._any(value, arguments)
        elif origin is Annotated:
            yield from self.faults(value, arguments[0])
        elif origin is Literal:
            if not any(type(value) is type(one) and value == one for one in arguments):
                yield _wrong(value, f"one of {', '.join(map(repr, arguments))}")
        elif origin is np.ndarray:
            yield from self._array(value, arguments)
        elif origin is type:
            yield from self._type(value, arguments[0])
        elif origin is not None and not is_dataclass(origin):
            yield from self._many(value, origin, arguments)
        elif isinstance(kind, TypeVar):
            yield from self.faults(value, kind.__bound__ or Any)
        elif kind is float:
            yield from self._number(value)
        elif kind in _PLAIN:
            # A class of somebody's own may do anything where it is compared or printed.
            if type(value) is not kind and not (isinstance(value, kind) and isinstance(value, Enum)):
                yield _wrong(value, _PLAIN[kind])
        elif kind is not Any and isinstance(whole, type):
            yield from self._class(value, whole)

    def _number(self, value: Any) -> Iterator[Fault]:
        if not isinstance(value, (int, float)) or (math.isnan(value) and not self._asked.nan):
            yield _wrong(value, "a number")
        elif self._asked.finite and math.isinf(value):
            yield _wrong(value, "a finite number")

    def _any(self, value: Any, kinds: Sequence[Any]) -> Iterator[Fault]:
        found = []
        for kind in kinds:
            first = next(self.faults(value, kind), None)
            if first is None:
                return
            found.append(first)
        # It may be of one of the kinds, but for something in it.
        inner = next((one for one in found if one[0] or not one[1].endswith(_WANTED)), None)
        wanted = (one[1].rpartition("; ")[2].removesuffix(_WANTED) for one in found)
        yield inner or _wrong(value, " or ".join(dict.fromkeys(wanted)))

    def _many(self, value: Any, origin: Any, kinds: Sequence[Any]) -> Iterator[Fault]:
        if not isinstance(value, origin) or isinstance(value, (str, bytes)):
            one = kinds[0] if kinds[1:] in ((), (...,)) and kinds else None
            of = f" of {one.__name__}" if isinstance(one, type) and one.__module__ != "builtins" else ""
            yield _wrong(value, "something to call" if origin is Callable else _a(origin) + of)
        elif origin is Callable:
            pass
        elif issubclass(origin, Mapping):
            for key, one in value.items():
                yield from self._within(f"[{shown(key)}]", key, kinds[0])
                yield from self._within(f"[{shown(key)}]", one, kinds[1])
        elif origin is tuple and Ellipsis not in kinds:
            if len(value) != len(kinds):
                yield _wrong(value, f"a tuple of {len(kinds)}")
            for place, (one, kind) in enumerate(zip(value, kinds, strict=False)):
                yield from self._within(f"[{place}]", one, kind)
        elif issubclass(origin, Collection):
            for place, one in enumerate(value):
                yield from self._within(f"[{place}]", one, kinds[0])

    def _type(self, value: Any, kind: Any) -> Iterator[Fault]:
        if isinstance(kind, TypeVar):
            kind = kind.__bound__ or object
        if isinstance(kind, type) and not (isinstance(value, type) and issubclass(value, kind)):
            yield _wrong(value, f"a class of the kind {kind.__name__}")

    def _array(self, value: Any, kinds: Sequence[Any]) -> Iterator[Fault]:
        held, wanted = _numbers_of(kinds)
        if type(value) is not np.ndarray:
            yield _wrong(value, "an array of numpy")
        elif value.dtype.kind not in held:
            yield "", f"is of the type {value.dtype}; {wanted} are wanted"
        elif value.dtype.kind == "f" and (self._asked.finite or not self._asked.nan):
            bad = np.isnan(value) & (not self._asked.nan) | np.isinf(value) & self._asked.finite
            if bad.any():
                place = int(np.argmax(bad))
                yield "", f"is {np.ravel(value)[place]} at sample {place}; finite numbers are wanted"

    def _class(self, value: Any, kind: Any) -> Iterator[Fault]:
        if not isinstance(value, kind):
            yield _wrong(value, "None" if kind is types.NoneType else _a(kind))
        elif _has_fields(value) and not isinstance(value, self._asked.leave) and not self._known(value):
            self._seen[id(value)] = value
            own: Any = type(value)
            for name, kind in _fields(own):
                yield from self._within(f".{name}", getattr(value, name), kind)
            if isinstance(value, Loop | Outline):
                _SOUND[self._asked.finite][id(value)] = value
        elif type(value).__module__.partition(".")[0] == "shapely":
            yield from _shape(value)

    def _known(self, value: Any) -> bool:
        return (
            id(value) in self._seen
            or _SOUND[True].get(id(value)) is value
            or (not self._asked.finite and _SOUND[False].get(id(value)) is value)
        )

    def _within(self, where: str, value: Any, kind: Any) -> Iterator[Fault]:
        for further, said in self.faults(value, kind):
            yield where + further, said


def _a(kind: Any) -> str:
    name = kind.__name__ if kind.__module__.partition(".")[0] != "collections" else kind.__name__.lower()
    return f"an {name}" if name[0] in "AEIOUaeiou" else f"a {name}"


def _wrong(value: Any, wanted: str) -> Fault:
    own = " of Python" if isinstance(value, np.generic) else ""  # float32 and int64 are in no JSON
    return "", f"is {shown(value)}; {wanted}{own}{_WANTED}"


def _shape(value: Any) -> Iterator[Fault]:
    import shapely  # whoever gives shapes has it loaded

    if not np.isfinite(shapely.get_coordinates(value)).all():
        yield "", "has a corner that is at no place; finite numbers are wanted"


_NUMBERS = {"b": ("b", "True and False"), "i": ("iu", "whole numbers"), "u": ("iu", "whole numbers")}


@cache
def _numbers_of(kinds: tuple[Any, ...]) -> tuple[str, str]:
    """The kinds of number that an array may have whose annotation has these arguments, and their name."""
    (number,) = get_args(kinds[-1])[:1] or (Any,)
    kind = np.dtype(number).kind if isinstance(number, type) and issubclass(number, np.generic) else "f"
    return _NUMBERS.get(kind, ("fiu", "real numbers"))


def _has_fields(value: Any) -> bool:
    return is_dataclass(value) or isinstance(value, Parameters) or _is_named(type(value))


def _is_named(cls: Any) -> bool:
    return issubclass(cls, tuple) and hasattr(cls, "_fields")


@cache
def _fields(cls: Any) -> tuple[tuple[str, Any], ...]:
    """The fields of a class and their kinds, without those whose kind cannot be found."""
    found = {}
    for base in reversed(cls.__mro__):
        for name, annotation in inspect.get_annotations(base).items():
            with suppress(NameError):
                found[name] = _resolved(annotation, base.__module__)
    names: Collection[str]
    if is_dataclass(cls):
        names = [one.name for one in fields(cls)]
    else:
        names = cls._fields if _is_named(cls) else cls.model_fields
    return tuple((name, found[name]) for name in names if name in found)


def _of_contract(annotation: Any, module: str, contract: Any) -> Any:
    """What an annotation of a contract says, with names that its module imports for type checkers alone."""
    names = {"Self": contract}
    while True:
        try:
            kind = _resolved(annotation, module, names)
            return contract if kind is Self else kind
        except NameError as error:
            name = str(error.name)
            if name not in (known := _imports_for_types(module)):
                raise
            names[name] = getattr(import_module(known[name]), name)


@cache
def _imports_for_types(module: str) -> Mapping[str, str]:
    """Names that a module imports for type checkers alone, to the modules that have them."""
    block = inspect.getsource(sys.modules[module]).partition("\nif TYPE_CHECKING:\n")[2]
    lines = takewhile(lambda line: line[:1] in {"", " "}, block.splitlines())
    found = ast.parse(dedent("\n".join(lines))).body
    return {
        one.name: str(line.module) for line in found if isinstance(line, ast.ImportFrom) for one in line.names
    }


def _resolved(annotation: Any, module: str, names: Mapping[str, Any] | None = None) -> Any:
    """What an annotation of a module says."""
    # Of classes ClassVar is known as well.
    holder = type("Holder", (), {"__annotations__": {"it": annotation}})
    scope = {**vars(sys.modules[module]), **(names or {})}
    kind = get_type_hints(holder, scope, include_extras=True)["it"]
    while get_origin(kind) is ClassVar:
        (kind,) = get_args(kind)
    return kind
