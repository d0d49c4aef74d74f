"""A table that stands for many designs: what a validator says of it, it says of each of them.

A value that differs from design to design may be handed on and compared with None, for it is none; whoever
asks for more of it gets :class:`Asked`. A validator that ends without has not looked at it.
"""

from collections.abc import Mapping
from typing import Any, NoReturn

from pydantic import BaseModel


class Asked(BaseException):
    """What a validator says depends on a value that differs from design to design; none catches it."""


def _asked(*_: object, **__: object) -> NoReturn:
    raise Asked


_OPERATIONS = (
    "lt le gt ge eq ne add sub mul truediv floordiv mod pow radd rsub rmul rtruediv rfloordiv rmod rpow neg "
    "pos abs bool int float complex index round trunc floor ceil hash str repr format len iter next contains "
    "getitem call getattr and or xor invert divmod rdivmod matmul lshift rshift"
)

Unlike: Any = type(
    "Unlike",
    (),
    {"__class__": property(_asked), **{f"__{name}__": _asked for name in _OPERATIONS.split()}},
)
"""A value of which nothing is known but that it is not None."""


class StandIn:
    """A table some of whose values differ from design to design.

    Parameters
    ----------
    one
        One of the designs' tables.
    unlike
        Names of what differs; those of tables within it are dotted.
    """

    def __init__(self, one: BaseModel, unlike: frozenset[str]) -> None:
        object.__setattr__(self, "_one", one)
        object.__setattr__(self, "_unlike", unlike)

    def __getattribute__(self, name: str) -> Any:
        one: BaseModel = object.__getattribute__(self, "_one")
        unlike: frozenset[str] = object.__getattribute__(self, "_unlike")
        if name == "__class__":
            return type(one)
        if name in unlike:
            return Unlike()
        inner = frozenset(key.removeprefix(f"{name}.") for key in unlike if key.startswith(f"{name}."))
        if inner:
            return StandIn(getattr(one, name), inner)
        if name in type(one).model_fields:
            return getattr(one, name)
        found = next((vars(kind)[name] for kind in type(one).__mro__ if name in vars(kind)), None)
        if isinstance(found, property) and found.fget is not None:
            return found.fget(self)
        if callable(found) and hasattr(found, "__get__") and not hasattr(BaseModel, name):
            return found.__get__(self)
        if name.startswith("__pydantic_") and found is not None:  # what isinstance asks of older pydantics
            return found
        raise Asked

    __eq__ = __ne__ = __hash__ = __iter__ = __repr__ = __str__ = _asked
    __setattr__ = __delattr__ = _asked


def changed(table: BaseModel, values: Mapping[str, Any]) -> None:
    """Give a table other values without validation; dotted names lie in tables that are its own alone."""
    for name, value in values.items():
        *steps, key = name.split(".")
        inner = table
        for step in steps:
            inner = getattr(inner, step)
        inner.__dict__[key] = value
