"""The digest of what an object holds: equal for equal content, in every process."""

import functools
import hashlib
import struct
import types
from collections.abc import Mapping, Set
from dataclasses import fields, is_dataclass
from enum import Enum
from pathlib import PurePath
from typing import Any

import numpy as np

OURS = "mechwright"
"""How the packages of the program begin: the stamp of a store has their code."""

KNOWN = {
    *("_io", "builtins", "collections", "copyreg", "datetime", "decimal", "enum", "fractions", "functools"),
    *("math", "numpy", "operator", "pathlib", "pydantic", "pydantic_core", "scipy", "shapely", "types"),
}
"""Python's own packages, and libraries whose versions a store has in its stamp."""

_SIZE = 20
"""Bytes of a digest."""


class NoContentError(Exception):
    """Something has no content that could be told: a local function, an open file."""


def content_digest(*things: object) -> bytes:
    """The digest of things: numbers, texts, arrays, shapes, containers, dataclasses and what can be pickled.

    Of a dataclass the fields count, and not what is kept beside them; of a table of a file the values, and
    which of them it states. A function and a class count by their
    names, if they are ours or a library's: nothing says what code of somebody else does under the same name
    tomorrow. Raises NoContentError for what has neither.

    Examples
    --------
    >>> content_digest({"a": 1, "b": {2, 3}}) == content_digest({"b": {3, 2}, "a": 1})
    True
    >>> content_digest(1) == content_digest(1.0)
    False
    """
    return _Reader().of(things)


class _Reader:
    def __init__(self) -> None:
        self._known: dict[int, tuple[object, bytes]] = {}
        self._under_way: set[int] = set()

    def of(self, thing: object) -> bytes:
        """The digest of a thing; one that holds itself has no content."""
        known = self._known.get(id(thing))
        if known is not None:
            return known[1]
        if id(thing) in self._under_way:
            raise NoContentError(f"a {type(thing).__name__} holds itself")
        self._under_way.add(id(thing))
        found = hashlib.blake2b(self._bytes(thing), digest_size=_SIZE).digest()
        self._under_way.discard(id(thing))
        self._known[id(thing)] = thing, found  # an id is that of the thing as long as the thing lives
        return found

    def _all(self, kind: str, things: Any) -> bytes:
        return b"".join([kind.encode(), b"\0", *map(self.of, things)])

    def _bytes(self, thing: Any) -> bytes:
        match thing:
            case None | bool() | Enum() | int() | str():
                return f"{type(thing).__qualname__} {thing!r}".encode("utf-8", "surrogatepass")
            case float():
                return b"float" + struct.pack("<d", thing)
            case bytes():
                return b"bytes" + thing
            case tuple() | list() if type(thing) in {tuple, list}:
                return self._all(type(thing).__name__, thing)
            case Mapping():
                pairs = sorted(self.of(key) + self.of(value) for key, value in thing.items())
                return b"".join([_named(type(thing)), *pairs])
            case Set():
                return b"".join([b"set", *sorted(map(self.of, thing))])
            case np.ndarray() if not thing.dtype.hasobject:
                head = f"array {thing.dtype.str} {thing.shape} "
                return head.encode() + np.ascontiguousarray(thing).tobytes()
            case PurePath():
                return f"path {thing}".encode("utf-8", "surrogatepass")
            case type() | types.FunctionType() | types.BuiltinFunctionType():
                return _named(thing)
            case functools.partial():
                return self._all("partial", (thing.func, thing.args, thing.keywords))
            case types.MethodType():
                return self._all("method", (thing.__self__, thing.__func__))
        return self._object(thing)

    def _object(self, thing: Any) -> bytes:
        kind = type(thing)
        if is_dataclass(thing) and not _reduces(kind):
            return _named(kind) + self._all("", (getattr(thing, one.name) for one in fields(thing)))
        if hasattr(kind, "model_fields"):
            values = (getattr(thing, name) for name in kind.model_fields)
            return _named(kind) + self._all("", (thing.model_fields_set, *values))
        try:
            reduced = thing.__reduce_ex__(4)
        except Exception as error:  # what cannot be pickled says so in many ways
            raise NoContentError(str(error)) from None
        if isinstance(reduced, str):
            return f"global {thing.__module__} {reduced}".encode()
        function, arguments, *rest = reduced
        return self._all("reduced", (function, arguments, *(list(one) for one in rest[1:] if one), *rest[:1]))


def _reduces(kind: type) -> bool:
    """Whether a class says itself what is pickled of it."""
    return any("__reduce__" in one.__dict__ for one in kind.__mro__[:-1])


def _named(thing: Any) -> bytes:
    """A function or a class by its name, if it has one of its own and is none of somebody else."""
    place = f"{thing.__module__}.{thing.__qualname__}"
    top = str(thing.__module__).partition(".")[0]
    if "<" in place or not (top in KNOWN or top.partition("_")[0] == OURS):
        raise NoContentError(f"{place} has no name that tells what it does")
    return f"named {place} ".encode()
