"""Designs of one structure: a table in which one design is one row.

Texts, switches and whole numbers are common to all designs of a table; its other numbers are columns. A
formula is written once, with numpy's functions, and gives a number for a number and a column for a column::

    def reach(table: DesignTable[YokeParams]) -> Array:
        return table.params.crank * np.sin(np.radians(table.params.swing))

Glossary
--------
column
    An array (n, 1) over n designs. What a formula gives of items or samples of each design is (n, k).
row
    One design. A table of one design may have plain numbers in place of columns.
"""

import copy
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any, Generic, Self, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from mechwright.arrays import Array
from mechwright.contracts.parameters import Parameters

P = TypeVar("P", bound=Parameters)
R = TypeVar("R")
T = TypeVar("T", bound="DesignTable[Any]")
Rows = NDArray[np.intp]


class Rowwise:
    """A dataclass of columns: :meth:`DesignTable.rows` takes its rows."""

    def rows(self, places: Rows, size: int) -> Self:
        """Give some of ``size`` designs."""
        taken = {one.name: rows_of(getattr(self, one.name), places, size) for one in fields(self)}  # type: ignore[arg-type]
        return replace(self, **taken)  # type: ignore[type-var]


class DesignTable(Generic[P]):
    """Designs of one structure, and what is computed of them.

    A family derives from it where formulas share something that takes long. What a subclass computes is kept,
    and goes along to the rows that are taken: arrays with two axes or more have the designs first, arrays
    with one axis are common to all designs.

    Parameters
    ----------
    given
        The parameters as the designs state them. Those that differ between the designs are columns (n, 1).
    size
        The number n of designs; None for one design with plain numbers in place of columns.
    """

    def __init__(self, given: P, size: int | None = None) -> None:
        self.given = given
        self.single = size is None
        self.size = 1 if size is None else size
        self._computed: dict[Hashable, Any] = {}

    @property
    def params(self) -> P:
        """The parameters with all dimensions; a subclass completes what the designs leave open."""
        return self.given

    def __len__(self) -> int:
        return self.size

    def once(self, name: Hashable, compute: Callable[[], R]) -> R:
        """Give what is computed of the designs under a name; it is kept, and goes along with rows."""
        if name not in self._computed:
            self._computed[name] = compute()
        found: R = self._computed[name]
        return found

    def rows(self, places: Rows) -> Self:
        """Give some of the designs, with all that has been computed of them."""
        if self.single:
            return self
        taken = copy.copy(self)
        taken.__dict__.update({name: rows_of(one, places, self.size) for name, one in self.__dict__.items()})
        taken.size = places.size
        return taken

    def row(self, place: int) -> Self:
        """Give one design, with plain numbers in place of columns; nothing that was computed goes along."""
        return self if self.single else type(self)(plain(self.given, place, self.size))

    def each(self, function: "Callable[[Self], Any]", block: int) -> NDArray[Any]:
        """Give what a function says (b, ...) of blocks of designs, so that its samples stay in the cache."""
        if self.size <= block:
            return np.asarray(function(self))
        return np.concatenate([function(some) for some in self.blocks(block)])

    def blocks(self, block: int) -> Iterator[Self]:
        """Give the designs in their order, ``block`` of them at once."""
        for start in range(0, self.size, block):
            yield self.rows(np.arange(start, min(start + block, self.size)))


def rows_of(value: Any, places: Rows, size: int) -> Any:
    """Give the rows at ``places`` of what has been computed of ``size`` designs."""
    if isinstance(value, np.ndarray):
        return value[places] if value.ndim > 1 and value.shape[0] == size else value
    if isinstance(value, Rowwise):
        return value.rows(places, size)
    if isinstance(value, DesignTable):
        return value.rows(places)
    if isinstance(value, BaseModel):
        return _with(value, lambda one: rows_of(one, places, size))
    if type(value) in (tuple, list):
        return type(value)(rows_of(one, places, size) for one in value)
    if type(value) is dict:
        return {key: rows_of(one, places, size) for key, one in value.items()}
    return value


def with_columns(params: P, columns: Mapping[str, Any]) -> P:
    """Give parameters with columns (n, 1), or other values, in place of some numbers; nothing is validated.

    Parameters
    ----------
    params
        One of the designs.
    columns
        Dotted name of a parameter to its column.
    """
    own = {name: value for name, value in columns.items() if "." not in name}
    inner: dict[str, dict[str, Any]] = {}
    for name, value in columns.items():
        table, dot, rest = name.partition(".")
        if dot:
            inner.setdefault(table, {})[rest] = value
    for table, some in inner.items():
        value = getattr(params, table)
        own[table] = _named_columns(value, some) if isinstance(value, Mapping) else with_columns(value, some)
    changed = params.model_copy(update=own)
    changed.__dict__.update(changed.fitted())
    return changed


def _named_columns(tables: Mapping[str, Any], columns: Mapping[str, Any]) -> dict[str, Any]:
    """The same of tables by their names."""
    inner: dict[str, dict[str, Any]] = {}
    for name, value in columns.items():
        table, _, rest = name.partition(".")
        inner.setdefault(table, {})[rest] = value
    changed = {name: with_columns(tables[name], some) for name, some in inner.items()}
    return {name: changed.get(name, table) for name, table in tables.items()}


def plain(params: P, place: int, size: int) -> P:
    """Give the parameters of one design of a table, with plain numbers in place of columns."""

    def plain_number(value: Any) -> Any:
        if isinstance(value, np.ndarray) and value.ndim > 1:
            return value[place if value.shape[0] == size else 0].item()
        return value.item() if isinstance(value, np.ndarray | np.generic) else value

    found: P = _with(params, plain_number)
    return found


def _with(model: Any, change: Callable[[Any], Any]) -> Any:
    """Give a model with its arrays changed, those of its tables too; it is itself where it has none."""
    update = {}
    for name, value in model.__dict__.items():
        if isinstance(value, np.ndarray | np.generic):
            update[name] = change(value)
        elif isinstance(value, BaseModel) and (inner := _with(value, change)) is not value:
            update[name] = inner
        elif type(value) is dict and any(isinstance(one, BaseModel) for one in value.values()):
            update[name] = {key: _with(one, change) for key, one in value.items()}
        elif type(value) is tuple and any(isinstance(one, BaseModel) for one in value):
            tables = tuple(_with(one, change) if isinstance(one, BaseModel) else one for one in value)
            if any(new is not old for new, old in zip(tables, value, strict=True)):
                update[name] = tables
    if not update:
        return model
    changed = model.model_copy(update=update)
    changed.__pydantic_fields_set__.intersection_update(model.model_fields_set)
    return changed


def number(value: Any) -> float:
    """Give an array without axes as a plain number; a column stays a column.

    Where formulas are the same, a column passes for the number that it is of each design.
    """
    found: float = value.item() if isinstance(value, np.ndarray | np.generic) and value.ndim == 0 else value
    return found


def column(value: Any, size: int) -> Array:
    """Give a number or column as a column (n, 1).

    >>> column(2.5, 3).ravel().tolist()
    [2.5, 2.5, 2.5]
    """
    return np.broadcast_to(np.asarray(value, dtype=float), (size, 1))


def items(values: Sequence[Any], size: int) -> Array:
    """Give numbers or columns of k items as one array (n, k).

    >>> items([1, np.array([[2], [3]])], 2).tolist()
    [[1.0, 2.0], [1.0, 3.0]]
    """
    return np.concatenate([column(one, size) for one in values], axis=1)


def by_row(function: Callable[[T], float]) -> Callable[[T], Any]:
    """Make a formula of a function that takes one design: it is called for each row of a table.

    For what no array tells, such as a search: a cheap bound of the rule decides most rows before.
    """

    def formula(table: T) -> Any:
        if table.single:
            return function(table)
        return np.array([[function(table.row(place))] for place in range(table.size)])

    return formula
