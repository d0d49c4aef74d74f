"""Evaluation of a study by tables: what rules forbid, and figures, extremes and masses of the rest.

Designs of one structure make a table (:mod:`mechwright.contracts.design_table`), which the formulas of the
family take as they take one design.
"""

import warnings
from collections.abc import Collection, Iterator, Mapping
from functools import partial
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.by_arrays import Answer, Designs, by_arrays
from mechwright.contracts.design_table import DesignTable, column, rows_of, with_columns
from mechwright.contracts.evaluation import Batch, Columns, told
from mechwright.contracts.figure import Figure, PartMass, SomeMasses
from mechwright.contracts.finding import Stage
from mechwright.contracts.masses import OF_PART, TOTAL, is_mass
from mechwright.contracts.motion import Channel
from mechwright.contracts.parameters import value_at
from mechwright.contracts.rule_list import Rules
from mechwright.contracts.sampling import SAMPLES
from mechwright.contracts.singly import Asked, singly

FAULT = "fault"
"""What forbids a design for which a formula of its family fails, before the code of the rule."""

ENDS = ("least", "greatest")
"""Ends of the names of columns that are extremes of a channel."""


class Evaluated(Asked, Protocol):
    """A family whose designs are evaluated as tables."""

    batch: ClassVar[int]
    structure: ClassVar[frozenset[str]]
    counts: ClassVar[frozenset[str]]
    block: ClassVar[int]
    sampled: ClassVar[int]

    def rules(self) -> Rules[Any]:
        """What forbids designs."""
        ...

    def table(self, params: Any, size: int | None = None) -> DesignTable[Any]:
        """A table of them."""
        ...

    def figures(self, table: DesignTable[Any]) -> Mapping[str, Figure]:
        """Their figures."""
        ...

    def channels(self, table: DesignTable[Any], samples: int) -> Mapping[str, Channel]:
        """The channels of their motions."""
        ...

    def extremes(
        self, table: DesignTable[Any], names: Collection[str]
    ) -> Mapping[str, tuple[Array, Array, str]]:
        """Their least and greatest values."""
        ...

    def masses(self, table: DesignTable[Any]) -> Mapping[str, PartMass] | None:
        """The masses of their parts."""
        ...


def evaluated(family: Evaluated, batch: Batch[Any], columns: Collection[str], stage: Stage) -> Columns:
    """Give what :meth:`Family.evaluate` says: by tables, or design by design if a family lists no rules."""
    if family.rules().every:
        return by_arrays(family, batch, columns, stage, partial(answer, family), chunk=family.batch)
    return singly(family, batch, columns, stage, np.arange(len(batch)))


def answer(family: Evaluated, designs: Designs, columns: Collection[str], stage: Stage) -> Answer:
    """Give what forbids designs, and their columns; see :mod:`mechwright.contracts.by_arrays`."""
    found = Answer(len(designs))
    for places, params in tables(designs, family.structure, family.counts):
        table = family.table(params, places.size)
        for start in range(0, places.size, family.block):
            some = np.arange(start, min(start + family.block, places.size))
            part = table if some.size == places.size else table.rows(some)
            _Judge(family, designs, places[some], found).take(part, columns, stage)
    found.drop_incomplete()
    return found


def tables(
    designs: Designs, structure: Collection[str], counts: Collection[str]
) -> Iterator[tuple[NDArray[np.intp], Any]]:
    """Give designs of one structure after the other: their places, and parameters with columns (n, 1).

    Parameters
    ----------
    designs
        Designs that may differ in everything.
    structure
        Keys of numbers in which the designs of a table are alike, besides texts, switches and whole numbers.
    counts
        Keys of whole numbers in which they may differ.
    """
    names = [
        name
        for name in designs.varied
        if name in structure or not (name in counts or isinstance(value_at(designs.common, name), float))
    ]
    kind = np.zeros(len(designs), np.int64)
    for name in names:
        _, which = np.unique(designs.varied[name], return_inverse=True)
        _, kind = np.unique(kind * (int(which.max()) + 1) + which.reshape(-1), return_inverse=True)
    for one in range(int(kind.max()) + 1):
        places = np.flatnonzero(kind == one)
        values: dict[str, Any] = {name: _same(designs, name, places[0]) for name in names}
        for name in designs.varied.keys() - values.keys():
            values[name] = designs.varied[name][places, None].astype(float)
        yield from _alike(places, with_columns(designs.common, values))


def _alike(places: NDArray[np.intp], params: Any) -> Iterator[tuple[NDArray[np.intp], Any]]:
    """Give designs of a table that are alike in the whole numbers that follow from what they leave out."""
    names = [
        name
        for name, value in params.__dict__.items()
        if isinstance(value, np.ndarray) and value.dtype.kind == "i"
    ]
    if not names:
        yield places, params
        return
    rows = np.concatenate([getattr(params, name) for name in names], axis=1)
    kinds, kind = np.unique(rows, axis=0, return_inverse=True)
    for number, row in enumerate(kinds.tolist()):
        some = np.flatnonzero(kind.reshape(-1) == number)
        alike = rows_of(params, some, places.size)
        alike.__dict__.update(zip(names, row, strict=True))
        yield places[some], alike


def _same(designs: Designs, name: str, place: int) -> Any:
    """What designs are alike in; a count may come as a float."""
    value = designs.varied[name][place].item()
    return (
        round(value)
        if isinstance(value, float) and isinstance(value_at(designs.common, name), int)
        else value
    )


class _Judge:
    """Takes the answer on the designs of one table.

    Parameters
    ----------
    family
        Theirs.
    designs
        All designs of the call.
    places
        (n,) where those of the table are.
    """

    def __init__(self, family: Evaluated, designs: Designs, places: NDArray[np.intp], found: Answer) -> None:
        self.family, self.designs, self.places, self.found = family, designs, places, found
        self._seen: set[str] = set()

    def forbid(self, code: str, which: NDArray[np.intp]) -> None:
        """Take what forbids some of them."""
        self.found.forbid(code, np.ones(which.size, bool), self.places[which])

    def fail(self, code: str, place: int, reason: Exception) -> None:
        """Take a design for which a formula fails; the first of each rule is a warning."""
        self.forbid(f"{FAULT}.{code}", np.array([place]))
        if code not in self._seen:
            self._seen.add(code)
            row = int(self.places[place])
            design = ", ".join(f"{name} = {values[row]}" for name, values in self.designs.varied.items())
            said = f"{type(reason).__name__}: {reason}".removeprefix("RuleError: ")
            warnings.warn(f"{code} fails for the design {design} (row {row + 1}): {said}", stacklevel=2)

    def leave(self, which: NDArray[np.intp]) -> None:
        """Leave some of them to be asked one by one."""
        self.found.doubt(np.ones(which.size, bool), self.places[which])

    def take(self, table: DesignTable[Any], columns: Collection[str], stage: Stage) -> None:
        """Take what rules forbid, and the columns of the rest."""
        table, left = self.family.rules().allowed(table, stage, self.forbid, self.fail, self.leave)
        if left.size:
            self._give(table, left, columns, stage)

    def _give(
        self, table: DesignTable[Any], places: NDArray[np.intp], columns: Collection[str], stage: Stage
    ) -> None:
        try:
            values = columns_of(self.family, table, columns, stage)
        except MemoryError:
            raise
        except Exception as error:  # whatever a formula raises of one of them, the others stand
            if table.size == 1:
                self.fail("figures", int(places[0]), error)
                return
            for half in np.array_split(np.arange(table.size), 2):
                self._give(table.rows(half), places[half], columns, stage)
            return
        for name, some in values.items():
            self.found.give(name, some, self.places[places])


def columns_of(
    family: Evaluated, table: DesignTable[Any], columns: Collection[str], stage: Stage
) -> dict[str, Array]:
    """Give those columns (n,) of allowed designs that are figures, extremes of channels or masses."""
    figures = family.figures(table)
    found = {
        name: told(column(figures[name](), table.size)[:, 0], figures[name].unit)
        for name in columns
        if name in figures
    }
    rest = [name for name in columns if name not in found and not is_mass(name)]
    ends = {name: name.rpartition(".")[::2] for name in rest}
    if sampled := {channel: None for channel, end in ends.values() if end in ENDS}:
        extremes = family.extremes(table, list(sampled))
        for name, (channel, end) in ends.items():
            if end in ENDS and channel in extremes:
                *values, unit = extremes[channel]
                found[name] = told(np.broadcast_to(values[ENDS.index(end)], table.size), unit)
    if stage is not Stage.MOTION and any(map(is_mass, columns)):
        found |= _masses(family, table, columns)
    return found


def extremes_of_samples(
    family: Evaluated, table: DesignTable[Any], names: Collection[str]
) -> dict[str, tuple[Array, Array, str]]:
    """Give what :meth:`Family.extremes` says, from the channels of blocks of designs."""
    found: dict[str, tuple[list[Array], list[Array], str]] = {}
    for some in table.blocks(family.sampled):
        channels = family.channels(some, SAMPLES)
        for name in names:
            if name in channels:
                values = np.atleast_2d(channels[name].values)
                low, high, _ = found.setdefault(name, ([], [], channels[name].unit))
                low.append(np.broadcast_to(values.min(axis=-1), some.size))
                high.append(np.broadcast_to(values.max(axis=-1), some.size))
    return {
        name: (np.concatenate(low), np.concatenate(high), unit) for name, (low, high, unit) in found.items()
    }


def _masses(family: Evaluated, table: DesignTable[Any], columns: Collection[str]) -> dict[str, Array]:
    weights = family.masses(table)
    if weights is None:
        return {}
    found = {
        name: column(weights[part](), table.size)[:, 0]
        for name in columns
        if (part := name.removeprefix(OF_PART)) in weights and name != TOTAL
    }
    if TOTAL in columns and not isinstance(weights, SomeMasses):
        every = sum(one.copies * np.nan_to_num(one()) for one in weights.values())
        found[TOTAL] = column(every, table.size)[:, 0]
    return found
