"""Other values for one field of a design, to see whether the field matters."""

import types
from collections.abc import Iterator
from enum import Enum
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from mechwright.contracts.parameters import Parameters
from mechwright.testing.strategies import NAMES, bounds, rules

_FACTORS = (1.02, 0.98, 1.15, 0.85, 1.5, 0.6)
"""Small steps first, since they are the likeliest to give another good design."""


def variations(start: Parameters, name: str) -> Iterator[Any]:
    """Give other values for field ``name``, the likeliest to be accepted first, as a design file says them.

    >>> from mechwright_cam.shop.holding import Hold
    >>> list(variations(Hold(), "method")), next(variations(Hold(), "tabs"))
    (['bore', 'vice', 'none'], 5)
    """
    field = type(start).model_fields[name]
    yield from _others(field.annotation, getattr(start, name), rules(field.metadata), name)


def is_constant(kind: Any) -> bool:
    """Whether a field of this type has one value only, as the name of the one choice of a family.

    >>> is_constant(Literal["dwell-press"]), is_constant(Literal["one", "two"]), is_constant(str)
    (True, False, False)
    """
    return get_origin(kind) is Literal and len(get_args(kind)) == 1


def _others(kind: Any, value: Any, rule: dict[str, Any], where: str) -> Iterator[Any]:
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is Annotated:
        yield from _others(arguments[0], value, rules(arguments[1:]) | rule, where)
    elif origin in (Union, types.UnionType):
        for member in arguments:
            yield from _others(member, value, rule, where)
    elif origin is Literal:
        yield from (other for other in arguments if other != value)
    elif isinstance(kind, type) and issubclass(kind, Enum):
        yield from (other.value for other in kind if other != value)
    elif kind is bool:
        yield not value
    elif isinstance(kind, type) and issubclass(kind, Parameters):
        for name in kind.model_fields:
            for other in variations(value, name):
                yield {**value.model_dump(mode="json", exclude_none=True), name: other}
    elif kind is str:
        yield from (name for name in NAMES if name != value)
    elif kind in (int, float):
        low, high = bounds(rule, where)
        if isinstance(value, int | float):
            steps = (value + 1, value - 1, value + 2, value - 2) if kind is int else ()
            yield from (step for step in steps if low <= step <= high)
        scaled = [value * factor for factor in _FACTORS] if value else []
        shares = [low + (high - low) * share for share in (0.01, 0.05, 0.25, 0.5, 0.75)]
        for other in (*scaled, *shares):
            yield round(other) if kind is int else other
