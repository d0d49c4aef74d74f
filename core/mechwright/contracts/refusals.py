"""Which tables of a batch are refused, and for what, as far as arrays tell it.

Bounds of numbers are compared all at once; of texts and choices each different value is read once. A rule of
the model that looks at nothing varied says the same of all designs, and is asked once
(:mod:`mechwright.contracts.stand_in`); one that does is run for each of them without the rest of validation.
Whatever is not known here - validators of fields, rules that complete a table, values of another kind - is
left to the table itself, design by design.
"""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

from mechwright.contracts.bounds import UnknownRefusalError, beyond, kind_of
from mechwright.contracts.evaluation import PARAMETERS, Batch
from mechwright.contracts.parameters import Parameters, is_fitted, named_table, value_at
from mechwright.contracts.stand_in import Asked, StandIn, Unlike, changed

Bools = NDArray[np.bool_]

FEW = 256
"""Different values of a parameter that are read one by one."""


@dataclass(frozen=True)
class Refusals:
    """What tables say of the designs of a batch.

    Parameters
    ----------
    forbidden
        (n,) of whole numbers: which of ``codes`` refuses the design, 0 for none.
    codes
        ``parameters.KEY``, the first empty.
    known
        (n,) whether ``forbidden`` says it; what is said of the others, only the table itself knows.
    values
        Dotted name of what is varied to its values (n,) as the table reads them, where it is known and
        allowed.
    common
        The table of one allowed design; None where none is known to be allowed.
    """

    forbidden: NDArray[np.int32]
    codes: tuple[str, ...]
    known: Bools
    values: Mapping[str, NDArray[Any]]
    common: Any


def refusals(batch: Batch[Any]) -> Refusals:
    """What the tables say of all designs of a batch."""
    try:
        return _told(batch)
    except UnknownRefusalError:
        size = len(batch)
        return Refusals(np.zeros(size, np.int32), ("",), np.zeros(size, bool), dict(batch.varied), None)


def _told(batch: Batch[Any]) -> Refusals:
    size = len(batch)
    content = _completed(batch)
    found: list[_Refused] = []
    values: dict[str, NDArray[Any]] = {}
    for name, given in batch.varied.items():
        field = _field(batch.model, name)
        values[name], refused = _read(field.info, given)
        found += [_Refused(field.place, f"{PARAMETERS}.{name}{key}", some) for key, some in refused.items()]
    common = _allowed(batch, content, np.flatnonzero(~_any(found, size)))
    for table in sorted({step for name in values for step in _tables(name)}, key=len, reverse=True):
        if not isinstance(_inner(common, table), BaseModel):
            continue  # tables by their names, each of which has its own rules
        place = _field(batch.model, table).place
        beyond = _any([one for one in found if one.place[: len(place)] == place], size)
        refused_too = _ruled(_inner(common, table), _below(values, table), np.flatnonzero(~beyond), size)
        found.append(_Refused(place, f"{PARAMETERS}.{table}", refused_too))
    found.sort(key=lambda one: one.place)
    left = np.flatnonzero(~_any(found, size))
    found.append(_Refused((), PARAMETERS, _ruled(common, values, left, size)))
    forbidden, codes = np.zeros(size, np.int32), {"": 0}
    for one in found:
        forbidden[one.which & (forbidden == 0)] = codes.setdefault(one.code, len(codes))
    return Refusals(forbidden, tuple(codes), np.ones(size, bool), values, common)


def _completed(batch: Batch[Any]) -> Mapping[str, Any]:
    """What all have in common after the rules that complete a table before it is read.

    Raises UnknownRefusalError where such a rule looks at a value that is varied.
    """
    rules = [
        one
        for one in batch.model.__pydantic_decorators__.model_validators.values()
        if one.info.mode == "before"
    ]
    if any("." in name for name in batch.varied) and rules:
        raise UnknownRefusalError
    unlike = {name: Unlike() for name in batch.varied}
    told: Any = {**batch.content, **unlike} if rules else batch.content
    for rule in rules:
        try:
            told = getattr(batch.model, rule.cls_var_name)(told)
        except (Asked, AttributeError, TypeError, ValueError, AssertionError, PydanticCustomError):
            raise UnknownRefusalError from None
        if not isinstance(told, Mapping) or any(told.get(name) is not one for name, one in unlike.items()):
            raise UnknownRefusalError
    return {name: value for name, value in told.items() if name not in unlike} if rules else batch.content


@dataclass(frozen=True)
class _Refused:
    """Which designs (n,) a field refuses, or the rules of a table, and where that stands in the model."""

    place: tuple[int, ...]
    code: str
    which: Bools


def _any(found: list[_Refused], size: int) -> Bools:
    which = np.zeros(size, bool)
    for one in found:
        which |= one.which
    return which


def _allowed(batch: Batch[Any], content: Mapping[str, Any], places: NDArray[np.intp]) -> BaseModel:
    """The table of a design that is allowed; raises UnknownRefusalError where none of the first is."""
    for place in places[:FEW].tolist():
        try:
            found: BaseModel = batch.one(place)
        except ValidationError:
            continue
        if type(found) is batch.model and _as_said(found, content, batch.varied):
            return found
        break  # a rule completes the table
    raise UnknownRefusalError  # what is not varied may be refused


def _as_said(table: BaseModel, content: Mapping[str, Any], varied: Mapping[str, NDArray[Any]]) -> bool:
    """Whether what is not varied is what the content and the defaults say, and no rule has changed it.

    What is fitted is asked for each design by who answers by arrays.
    """
    for name, info in type(table).model_fields.items():
        value = getattr(table, name)
        if isinstance(value, BaseModel):
            if not _as_said(value, content.get(name, {}), _below(varied, name)):
                return False
        elif isinstance(value, dict) and named_table(info.annotation) is not None:
            own = content.get(name, {})
            if not all(
                _as_said(one, own.get(key, {}), _below(varied, f"{name}.{key}")) for key, one in value.items()
            ):
                return False
        elif name not in varied and (name in content or not is_fitted(info)):
            said = (
                _adapter(info).validate_python(content[name])
                if name in content
                else info.get_default(call_default_factory=True)
            )
            if value != said:
                return False
    return True


def _adapter(info: FieldInfo) -> TypeAdapter[Any]:
    """What reads one value of a field."""
    annotated: Any = Annotated[(info.annotation, *info.metadata)] if info.metadata else info.annotation
    return TypeAdapter(annotated)


def _tables(name: str) -> list[str]:
    """The tables that a name lies in, without the whole."""
    steps = name.split(".")[:-1]
    return [".".join(steps[: number + 1]) for number in range(len(steps))]


def _below(values: Mapping[str, NDArray[Any]], table: str) -> dict[str, NDArray[Any]]:
    before = f"{table}."
    return {name.removeprefix(before): column for name, column in values.items() if name.startswith(before)}


@dataclass(frozen=True)
class _Field:
    """A field of a table, and the places of its name in the tables that it lies in."""

    info: FieldInfo
    place: tuple[int, ...]


def _field(model: type[BaseModel], name: str) -> _Field:
    place: list[int] = []
    *tables, key = name.split(".")
    named: type[BaseModel] | None = None
    for step in tables:
        if named is not None:  # the name of a table, whose tables have one place
            model, named = named, None
            continue
        _plain(model, step)
        place.append(list(model.model_fields).index(step))
        inner = model.model_fields[step].annotation
        named = named_table(inner)
        if named is not None:
            continue
        if not (isinstance(inner, type) and issubclass(inner, BaseModel)):
            raise UnknownRefusalError
        model = inner
    _plain(model, key)
    place.append(list(model.model_fields).index(key))
    return _Field(model.model_fields[key], tuple(place))


def _plain(model: type[BaseModel], key: str) -> None:
    """Refuse a field with validators that are not known."""
    own = model.__pydantic_decorators__
    known = Parameters.__pydantic_decorators__.field_validators
    strange = [
        one
        for name, one in own.field_validators.items()
        if name not in known and (key in one.info.fields or "*" in one.info.fields)
    ]
    before = [one for one in own.model_validators.values() if one.info.mode == "wrap"]
    if key not in model.model_fields or strange or before or own.root_validators or own.validators:
        raise UnknownRefusalError


def _read(info: FieldInfo, given: NDArray[Any]) -> tuple[NDArray[Any], dict[str, Bools]]:
    """Values (n,) of a field, and which of them (n,) it refuses, by what follows its name in the code."""
    kind, metadata = kind_of(info)
    if kind in (float, int) and given.dtype.kind in "fiu":
        refused = beyond(metadata, given)
        if kind is int and given.dtype.kind == "f":
            refused |= given != np.floor(given)
        values = given.astype(np.int64) if kind is int and not refused.any() else given.astype(np.float64)
        return values, {"": refused}
    if kind is bool and given.dtype.kind == "b":
        return given, {}
    if given.dtype.kind not in "OUi" or kind is None:
        raise UnknownRefusalError
    return _choices(info, given if given.dtype.kind == "i" else _as_text(given))


def _as_text(given: NDArray[Any]) -> NDArray[Any]:
    if not all(isinstance(one, str) for one in given.tolist()):
        raise UnknownRefusalError
    return given.astype(str)


def _choices(info: FieldInfo, given: NDArray[Any]) -> tuple[NDArray[Any], dict[str, Bools]]:
    """The same of texts and whole numbers to choose from, each different one read once."""
    different, which = np.unique(given, return_inverse=True)
    if different.size > FEW:
        raise UnknownRefusalError
    adapter = _adapter(info)
    read: list[Any] = []
    refused: dict[str, Bools] = {}
    for number, one in enumerate(different.tolist()):
        try:
            read.append(adapter.validate_python(one))
        except ValidationError as error:
            suffix = "".join(f".{step}" for step in error.errors(include_url=False)[0]["loc"])
            refused[suffix] = refused.get(suffix, np.zeros(given.shape, bool)) | (which == number)
            read.append(None)
    known = [one for one in read if one is not None]
    filled = [known[0] if one is None and known else one for one in read]
    return np.array(filled)[which], refused


def _inner(table: BaseModel, name: str) -> BaseModel:
    found: BaseModel = value_at(table, name) if name else table
    return found


def _rules(table: BaseModel) -> list[Callable[[Any], Any]]:
    return [
        getattr(one.func, "__func__", one.func)
        for one in type(table).__pydantic_decorators__.model_validators.values()
        if one.info.mode == "after"
    ]


def _ruled(
    common: BaseModel, values: Mapping[str, NDArray[Any]], asked: NDArray[np.intp], size: int
) -> Bools:
    """Which designs (n,) the rules of a table refuse, of those that are asked about."""
    refused, left = np.zeros(size, bool), asked
    for rule in _rules(common):
        stand_in = StandIn(common, frozenset(values))
        try:
            if rule(stand_in) is not stand_in:
                raise UnknownRefusalError
        except (Asked, AttributeError, TypeError):
            for alike, places in _alike(values, left):
                some = _asked(rule, changed_copy(common, alike), values, alike, places)
                refused[np.asarray(some, dtype=np.intp)] = True
            left = left[~refused[left]]
        except (ValueError, AssertionError, PydanticCustomError):
            refused[left] = True
            break
    return refused


def _alike(
    values: Mapping[str, NDArray[Any]], asked: NDArray[np.intp]
) -> "Iterator[tuple[dict[str, Any], NDArray[np.intp]]]":
    """Places of designs that are asked about with the same texts and choices, and those."""
    names = [name for name, column in values.items() if column.dtype.kind not in "fi"]
    kind = np.zeros(asked.size, np.int64)
    for name in names:
        different, which = np.unique(values[name][asked], return_inverse=True)
        kind = kind * different.size + which.reshape(-1)
    order = np.argsort(kind, kind="stable")
    ends = np.flatnonzero(np.diff(kind[order])) + 1
    for places in np.split(asked[order], ends):
        if places.size:
            yield {name: values[name][places[0]].item() for name in names}, places


def changed_copy(table: BaseModel, values: Mapping[str, Any]) -> BaseModel:
    """A copy of a table with other values, whether they are allowed or not."""
    copied = table.model_copy(deep=True)
    changed(copied, values)
    return copied


def _asked(
    rule: Callable[[Any], Any],
    common: BaseModel,
    values: Mapping[str, NDArray[Any]],
    alike: Collection[str],
    asked: NDArray[np.intp],
) -> Collection[int] | NDArray[np.intp]:
    """Places of designs with some values alike that a rule refuses: all or none if it asks no other value."""
    stand_in = StandIn(common, frozenset(values) - frozenset(alike))
    try:
        if rule(stand_in) is not stand_in:
            raise UnknownRefusalError
    except (Asked, AttributeError, TypeError):
        return _each(rule, common, values, asked)
    except (ValueError, AssertionError, PydanticCustomError):
        return asked
    return ()


def _each(
    rule: Callable[[Any], Any], common: BaseModel, values: Mapping[str, NDArray[Any]], asked: NDArray[np.intp]
) -> list[int]:
    """Places of designs that a rule refuses, asked one by one."""
    table = changed_copy(common, {})
    refused = []
    columns = {name: column.tolist() for name, column in values.items()}
    for place in asked.tolist():
        changed(table, {name: column[place] for name, column in columns.items()})
        before = dict(table.__dict__)
        try:
            if rule(table) is not table or table.__dict__ != before:
                raise UnknownRefusalError
        except (ValueError, AssertionError, PydanticCustomError):
            refused.append(place)
    return refused
