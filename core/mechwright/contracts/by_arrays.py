"""Many designs by arrays: tables that are allowed, some thousand at once, and what is found of them.

What the arrays do not decide is checked and solved design by design. Columns that they leave out are taken
from the motion of each design that is allowed.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.evaluation import Batch, Columns
from mechwright.contracts.finding import Stage
from mechwright.contracts.refusals import refusals
from mechwright.contracts.singly import Asked, singly
from mechwright.contracts.slices import Slices

CHUNK = 4096
"""Designs that are answered at once: some dozens of arrays of them stay in the cache."""


@dataclass(frozen=True)
class Designs:
    """Designs whose tables are allowed.

    Parameters
    ----------
    common
        One of them; of what is varied it says nothing of the others.
    varied
        Dotted name of a parameter to its values (n,), as the table reads them.
    """

    common: Any
    varied: Mapping[str, NDArray[Any]]

    def __len__(self) -> int:
        return min(values.size for values in self.varied.values())


@dataclass
class Answer:
    """What is found of designs (n,), decided step by step, in the order in which a check goes.

    Parameters
    ----------
    size
        How many there are.
    """

    size: int
    forbidden: NDArray[np.int32] = field(init=False)
    """Which of ``codes`` forbids the design; 0 as long as nothing does."""
    undecided: NDArray[np.bool_] = field(init=False)
    """Whether the design has to be looked at by itself."""
    codes: list[str] = field(default_factory=lambda: [""])
    values: dict[str, Array] = field(default_factory=dict)
    """Column to its values (n,), NaN where there is none; those of forbidden designs do not matter."""
    _given: dict[str, NDArray[np.bool_]] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        self.forbidden = np.zeros(self.size, np.int32)
        self.undecided = np.zeros(self.size, bool)

    @property
    def open(self) -> NDArray[np.bool_]:
        """Which designs nothing has been said of so far."""
        return np.asarray((self.forbidden == 0) & ~self.undecided)

    @property
    def left(self) -> NDArray[np.intp]:
        """The places of the designs that nothing has been said of so far."""
        return np.flatnonzero(self.open)

    def forbid(self, code: str, which: NDArray[Any], places: "NDArray[np.intp] | None" = None) -> None:
        """Say what forbids designs that are open so far: a mask of all, or of those at ``places``."""
        self.forbidden[self._open(which, places)] = self._number(code)

    def doubt(self, which: NDArray[Any], places: "NDArray[np.intp] | None" = None) -> None:
        """Leave designs undecided, of those that are open so far."""
        self.undecided[self._open(which, places)] = True

    def give(self, column: str, values: Array, places: "NDArray[np.intp] | None" = None) -> None:
        """Give values of a column, of all or of those at ``places``."""
        if column not in self.values:
            self.values[column] = np.full(self.size, np.nan)
            self._given[column] = np.zeros(self.size, bool)
        own = slice(None) if places is None else places
        self.values[column][own], self._given[column][own] = values, True

    def drop_incomplete(self) -> None:
        """Leave out columns that some of the allowed designs lack: all are asked for them one by one."""
        for name, given in self._given.items():
            if (self.open & ~given).any():
                del self.values[name]

    def _open(self, which: NDArray[Any], places: "NDArray[np.intp] | None") -> NDArray[np.intp]:
        asked = np.flatnonzero(np.broadcast_to(which, self.size)) if places is None else places[which]
        return np.asarray(asked[(self.forbidden[asked] == 0) & ~self.undecided[asked]])

    def _number(self, code: str) -> int:
        if code not in self.codes:
            self.codes.append(code)
        return self.codes.index(code)


def by_arrays(
    family: Asked,
    batch: Batch[Any],
    columns: Collection[str],
    stage: Stage,
    answer: Callable[[Designs, Collection[str], Stage], Answer],
    chunk: int = CHUNK,
) -> Columns:
    """What :meth:`Family.evaluate` says: by ``answer``, and design by design what that leaves undecided.

    Parameters
    ----------
    answer
        Gives what arrays find of designs, ``chunk`` of them at most: it may leave designs undecided, and
        columns out.
    """
    slices = batch.slices or Slices()
    told = slices.memo(lambda: refusals(batch))
    found = _Found(batch, columns, told.codes, told.forbidden.copy())
    slow = ~told.known
    places = np.flatnonzero(told.known & (told.forbidden == 0))
    for start in range(0, places.size, chunk):
        some = places[start : start + chunk]
        designs = Designs(told.common, {name: values[some] for name, values in told.values.items()})
        said = slices.answer(start, some, partial(_answered, answer, designs, columns, stage))
        if said is None:
            continue
        slow[some[said.undecided]] = True
        found.take(some, said)
        if missing := [name for name in columns if name not in said.values]:
            solved = some[said.open]
            found.merge(solved, singly(family, batch, missing, stage, solved, judged=False))
    if slow.any():
        rest = np.flatnonzero(slow)
        found.merge(rest, singly(family, batch, columns, stage, rest))
    return Columns(found.values, found.forbidden, tuple(found.codes))


def _answered(
    answer: Callable[[Designs, Collection[str], Stage], Answer],
    designs: Designs,
    columns: Collection[str],
    stage: Stage,
) -> Answer:
    with np.errstate(all="ignore"):
        return answer(designs, columns, stage)


@dataclass
class _Found:
    """Columns as they come together."""

    batch: Batch[Any]
    columns: Collection[str]
    first: tuple[str, ...]
    forbidden: NDArray[np.int32]

    @cached_property
    def codes(self) -> dict[str, int]:
        return {code: number for number, code in enumerate(self.first)}

    @cached_property
    def values(self) -> dict[str, Array]:
        return {name: np.full(len(self.batch), np.nan) for name in self.columns}

    def take(self, places: NDArray[np.intp], said: Answer) -> None:
        free = said.open
        for name in self.values.keys() & said.values.keys():
            self.values[name][places[free]] = said.values[name][free]
        self.forbidden[places] = self._numbers(tuple(said.codes))[said.forbidden]

    def merge(self, places: NDArray[np.intp], said: Columns) -> None:
        for name in self.values.keys() & said.values.keys():
            self.values[name][places] = said.values[name]
        self.forbidden[places] = self._numbers(said.codes)[said.forbidden]
        for values in self.values.values():
            values[places[said.forbidden != 0]] = np.nan

    def _numbers(self, codes: tuple[str, ...]) -> NDArray[np.int32]:
        return np.array([self.codes.setdefault(code, len(self.codes)) for code in codes], dtype=np.int32)
