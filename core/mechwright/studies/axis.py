"""One parameter that a study varies."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, Field, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from mechwright.arrays import Array
from mechwright.contracts.parameters import Parameters, named_table
from mechwright.designs.tables import unknown
from mechwright.errors import DesignError
from mechwright.units import Unit, convert

MOST_LEVELS = 1_000_000
"""Of one parameter: as many as a step can make of a range before it was meant to be continuous."""

DIGITS = 12
"""Significant digits of a level: 0.1 + 2 * 0.1 is 0.3."""

Value = float | str | bool


class Range(Parameters):
    """Which values a parameter takes: from ``least`` to ``greatest``, or ``values``."""

    least: float | str | None = Field(None, description="Smallest value, with or without a unit.")
    greatest: float | str | None = Field(None, description="Greatest value.")
    step: float | str | None = Field(None, description="Between two values; without one all are possible.")
    count: int | None = Field(None, ge=1, le=MOST_LEVELS, description="How many values, in equal steps.")
    log: bool = Field(False, description="Equal ratios in place of equal steps.")
    values: tuple[Value, ...] = Field((), description="The values themselves.")


@dataclass(frozen=True)
class Axis:
    """A parameter and its values.

    Parameters
    ----------
    name
        Dotted, below ``[parameters]``.
    least, greatest
        Ends of a continuous one.
    log
        Whether equal shares are equal ratios.
    levels
        All values; None for a continuous one.
    """

    name: str
    least: float = 0.0
    greatest: float = 0.0
    log: bool = False
    levels: NDArray[Any] | None = None

    @property
    def is_text(self) -> bool:
        """Whether its values are no numbers."""
        return self.levels is not None and self.levels.dtype.kind not in "biuf"

    def at(self, share: Array) -> NDArray[Any]:
        """The values (n,) at shares of the range, from 0 up to but not including 1."""
        if self.levels is not None:
            return self.levels[(share * self.levels.size).astype(np.int64)]
        if self.log:
            low, high = math.log(self.least), math.log(self.greatest)
            return np.clip(np.exp(low + share * (high - low)), self.least, self.greatest)
        return np.asarray(self.least + share * (self.greatest - self.least))


def axis_of(model: type[Parameters], name: str, asked: Range, where: str) -> Axis:
    """The axis that a study file asks for.

    Raises
    ------
    DesignError
        The parameter is not known, a value is outside of its bounds, or the range is none.
    """
    field = _field(model, name, where)
    reader = _reader(field, field.annotation)

    def read(value: Value, key: str) -> Any:
        try:
            return reader.validate_python(value)
        except ValidationError as error:
            said = error.errors(include_url=False)[0]["msg"]
            raise DesignError(f"{where}.{key}: {value!r}: {said[0].lower()}{said[1:]}") from None

    if asked.values:
        if asked.least is not None or asked.greatest is not None or asked.step is not None or asked.count:
            raise DesignError(f"{where}: has values, and a range besides; leave one of them out")
        return Axis(name, levels=np.array([read(value, "values") for value in asked.values]))
    if asked.least is None or asked.greatest is None:
        raise DesignError(f"{where}: needs least and greatest, or values")
    least, greatest = read(asked.least, "least"), read(asked.greatest, "greatest")
    if isinstance(least, (str, bool)):
        raise DesignError(f"{where}: is no number; give its values, as values = [...]")
    if not least < greatest:
        raise DesignError(f"{where}: least is {least:g} and greatest {greatest:g}; least has to be smaller")
    if asked.log and not least > 0:
        raise DesignError(f"{where}.least: is {least:g}; equal ratios need more than 0")
    return Axis(name, float(least), float(greatest), asked.log, _levels(field, least, greatest, asked, where))


def _levels(field: FieldInfo, least: float, greatest: float, asked: Range, where: str) -> NDArray[Any] | None:
    whole = int in (field.annotation, *get_args(field.annotation)) and float not in get_args(field.annotation)
    if asked.count and asked.step is not None:
        raise DesignError(f"{where}: has a step and a count; leave one of them out")
    if asked.count:
        spaced = np.geomspace if asked.log else np.linspace
        found: NDArray[Any] = spaced(least, greatest, asked.count)
    elif asked.step is not None or whole:
        width = 1.0 if asked.step is None else _width(asked.step, field, where)
        number = int((greatest - least) / width * (1 + 1e-12)) + 1
        if number > MOST_LEVELS:
            raise DesignError(f"{where}.step: makes {number:,} values; at most {MOST_LEVELS:,}")
        found = least + width * np.arange(number)
    else:
        return None
    if whole:
        return np.unique(np.round(found).astype(np.int64))
    return np.array([float(f"{value:.{DIGITS}g}") for value in found])


def _width(step: float | str, field: FieldInfo, where: str) -> float:
    """A step in the unit of its parameter, whose bounds are not the step's."""
    units = [one for one in field.metadata if isinstance(one, Unit)]
    try:
        width = convert(step, units[0].symbol if units else "") if isinstance(step, str) else step
    except ValueError as error:
        raise DesignError(f"{where}.step: {error}") from None
    if not width > 0:
        raise DesignError(f"{where}.step: is {width:g}; it has to be more than 0")
    return width


def _reader(field: FieldInfo, kind: Any) -> TypeAdapter[Any]:
    """What reads one value of a field, with its unit and bounds."""
    return TypeAdapter(Annotated[(kind, *field.metadata)] if field.metadata else kind)


def _field(model: type[BaseModel], name: str, where: str) -> FieldInfo:
    *tables, key = name.split(".")
    named: type[BaseModel] | None = None
    for step in tables:
        if named is not None:  # the name of a table, such as of a point
            model, named = named, None
            continue
        field = model.model_fields.get(step)
        named = None if field is None else named_table(field.annotation)
        model = model if named is not None else _inner(model, step, where)
    if named is not None or key not in model.model_fields:
        raise DesignError(f"{where}: {unknown(key, tuple(model.model_fields), 'parameter')}")
    return model.model_fields[key]


def _inner(model: type[BaseModel], step: str, where: str) -> type[BaseModel]:
    field = model.model_fields.get(step)
    kinds = () if field is None else (field.annotation, *get_args(field.annotation))
    for kind in kinds:
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            return kind
    raise DesignError(f"{where}: {unknown(step, tuple(model.model_fields), 'table of parameters')}")


def flat(table: Mapping[str, Any], leaf: frozenset[str] | None, before: str = "") -> dict[str, Any]:
    """A table whose names may be dotted as a plain one; ``leaf`` are the keys of an inline table at an end.

    >>> flat({"bore": {"least": 1}, "Q": {"x": {"least": 2}}}, frozenset({"least"}))
    {'bore': {'least': 1}, 'Q.x': {'least': 2}}
    """
    found: dict[str, Any] = {}
    for key, value in table.items():
        name = f"{before}{key}"
        ends = not isinstance(value, Mapping) or (leaf is not None and (not value or set(value) & leaf))
        found |= {name: value} if ends else flat(value, leaf, f"{name}.")
    return found
