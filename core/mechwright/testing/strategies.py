"""Hypothesis strategies for design files, made from the bounds that the fields declare."""

import math
import re
import types
from collections.abc import Iterable, Mapping
from datetime import date
from enum import Enum
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin

from hypothesis import strategies as st
from pydantic import ValidationError
from pydantic.fields import FieldInfo

from mechwright.contracts.inputs import InputFile
from mechwright.contracts.materials import MATERIALS
from mechwright.contracts.parameters import Parameters

P = TypeVar("P", bound=Parameters)

_RULES = ("ge", "gt", "le", "lt", "multiple_of", "min_length", "max_length", "pattern")
NAMES = sorted(MATERIALS)
"""Texts that mean something in a design file."""

_LONG = 100
"""Characters of a text without a limit of its own."""

_MANY = 3
"""Most entries of a list or table: more finds nothing that three do not."""


def tables(params: type[Parameters]) -> st.SearchStrategy[dict[str, Any]]:
    """Tables as a design file could hold them: every value inside its own field's bounds.

    What several fields together must obey is not looked at, so ``params.model_validate`` may still refuse
    the table. A number is drawn near its default as often as from all of its range, since most of the
    designs that can be built lie there.
    """
    required: dict[str, st.SearchStrategy[Any]] = {}
    optional: dict[str, st.SearchStrategy[Any]] = {}
    for name, field in params.model_fields.items():
        strategy = _values(
            field.annotation, rules(field.metadata), f"{params.__name__}.{name}", field.default
        )
        (required if field.is_required() else optional)[name] = strategy
    return st.fixed_dictionaries(required, optional=optional)


def parameters(params: type[P]) -> st.SearchStrategy[P]:
    """Parameter objects that pass validation.

    >>> from mechwright_cam.shop.holding import Hold
    >>> from hypothesis import find
    >>> find(parameters(Hold), lambda hold: hold.tabs > 4).tabs
    5
    """

    def build(table: dict[str, Any]) -> P | None:
        try:
            return params.model_validate(table)
        except ValidationError:
            return None

    def is_valid(found: P | None) -> bool:
        return found is not None

    strategy: st.SearchStrategy[Any] = tables(params).map(build).filter(is_valid)
    return strategy


def rules(metadata: Iterable[Any]) -> dict[str, Any]:
    """The bounds in the metadata of a field, named as pydantic names them (``ge``, ``pattern``)."""
    found: dict[str, Any] = {}
    for item in metadata:
        if isinstance(item, FieldInfo):
            found |= rules(item.metadata)
        found |= {rule: value for rule in _RULES if (value := getattr(item, rule, None)) is not None}
    return found


def bounds(rule: Mapping[str, Any], where: str) -> tuple[float, float]:
    """Least and greatest value that the rules allow; raises TypeError where there is none."""
    low, high = rule.get("ge", rule.get("gt")), rule.get("le", rule.get("lt"))
    if low is None or high is None:
        raise TypeError(f"{where} has no bounds; give it a least and a greatest value")
    return low, high


def _values(kind: Any, rule: dict[str, Any], where: str, default: Any) -> st.SearchStrategy[Any]:
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _values(arguments[0], rules(arguments[1:]) | rule, where, default)
    if origin in (Union, types.UnionType):
        return st.one_of([_values(member, rule, where, default) for member in arguments])
    if kind is None or kind is types.NoneType:
        return st.none()
    if origin is Literal:
        return st.sampled_from(arguments)
    if origin in (tuple, list, set, frozenset) and (origin is not tuple or arguments[-1] is Ellipsis):
        size = {"min_size": rule.get("min_length", 0), "max_size": min(rule.get("max_length", _MANY), _MANY)}
        return st.lists(_values(arguments[0], {}, where, None), **size)
    if origin is tuple:
        return st.tuples(*(_values(member, {}, where, None) for member in arguments)).map(list)
    if origin is dict:
        keys, values = (_values(member, {}, where, None) for member in arguments)
        return st.dictionaries(keys, values, max_size=_MANY)
    if isinstance(kind, type):
        return _plain(kind, rule, where, default)
    raise TypeError(f"{where}: no strategy for {kind!r}; give the contract a strategy of its own")


def _plain(kind: type, rule: dict[str, Any], where: str, default: Any) -> st.SearchStrategy[Any]:
    if issubclass(kind, Parameters):
        return tables(kind)
    if issubclass(kind, InputFile):
        return st.just(str(default))
    if issubclass(kind, Enum):
        return st.sampled_from([member.value for member in kind])
    if issubclass(kind, bool):
        return st.booleans()
    if issubclass(kind, int):
        return _integers(rule, where, default)
    if issubclass(kind, float):
        return _floats(rule, where, default)
    if issubclass(kind, str):
        return _texts(rule, default)
    if issubclass(kind, date):
        return st.dates().map(str)
    raise TypeError(f"{where}: no strategy for {kind!r}; give the contract a strategy of its own")


def _texts(rule: dict[str, Any], default: Any) -> st.SearchStrategy[str]:
    least, most = rule.get("min_length", 0), rule.get("max_length", _LONG)
    if "pattern" in rule:
        texts = st.from_regex(rule["pattern"], fullmatch=True)
        texts = texts.filter(lambda text: least <= len(text) <= most)
    else:
        texts = st.text(min_size=least, max_size=most)
    # Most texts of a design are names of materials, which neither lengths nor patterns tell.
    fits = [name for name in NAMES if least <= len(name) <= most and re.search(rule.get("pattern", ""), name)]
    likely = ([default] if isinstance(default, str) else []) + fits
    return st.one_of(st.sampled_from(likely), texts) if likely else texts


def _near(low: float, high: float, default: Any) -> tuple[float, float] | None:
    """Half to twice the default, inside the bounds; None where there is no number to be near to."""
    if isinstance(default, bool) or not isinstance(default, int | float):
        return None
    ends = sorted((default / 2, default * 2))
    return max(low, ends[0]), min(high, ends[1])


def _integers(rule: dict[str, Any], where: str, default: Any) -> st.SearchStrategy[int]:
    low, high = bounds(rule, where)
    # An open bound at a whole number leaves that number out.
    least = math.floor(low) + 1 if "ge" not in rule else math.ceil(low)
    most = math.ceil(high) - 1 if "le" not in rule else math.floor(high)
    step = rule.get("multiple_of", 1)
    strategy = st.integers(-(-least // step), most // step).map(lambda count: count * step)
    near = _near(least, most, default)
    if near is None or step != 1:
        return strategy
    return st.one_of(st.just(default), st.integers(math.ceil(near[0]), math.floor(near[1])), strategy)


def _floats(rule: dict[str, Any], where: str, default: Any) -> st.SearchStrategy[float]:
    low, high = bounds(rule, where)
    strategy = st.floats(low, high, exclude_min="ge" not in rule, exclude_max="le" not in rule)
    near = _near(low, high, default)
    if near is None or not near[0] < near[1]:
        return strategy
    return st.one_of(
        st.just(float(default)), st.floats(*near).filter(lambda x: low < x < high or x == default), strategy
    )
