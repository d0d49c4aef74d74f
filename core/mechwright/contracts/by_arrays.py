"""Evaluation of many designs by arrays, for families that have formulas for it.

A family writes one function of :class:`Designs`, and calls :func:`by_arrays` from its ``evaluate``::

    def evaluate(self, batch, columns, stage=Stage.PARTS):
        from mechwright_scotch_yoke.evaluation import answer

        return by_arrays(self, batch, columns, stage, answer)

``answer(designs, columns, stage)`` gets designs whose tables are allowed, some thousand at once, so that
arrays stay in the cache. ``designs["crank"]`` is an array (n,) where the crank is varied and a plain number
where it is not; :meth:`Designs.full` is an array in any case. It gives an :class:`Answer`, or None where it
has no way for what is varied: it is then asked once for each set of texts and switches among the designs, as
if these were not varied, and then for each set of whole numbers, if they are few. It may leave any design
undecided, and any column out: what it does not decide is checked and solved one by one, and columns that it
leaves out are taken from the motion of each design that is allowed.
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
from mechwright.contracts.parameters import value_at
from mechwright.contracts.refusals import refusals
from mechwright.contracts.singly import Asked, singly
from mechwright.contracts.slices import Chunk, Skipped, Slices

CHUNK = 4096
"""Designs that are answered at once: some dozens of arrays of them stay in the cache."""

OF_A_KIND = 8
"""Designs of a kind, on average, from which on each kind is asked for by itself: so many of them one by one
take longer than calls of numpy."""


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

    def __getitem__(self, name: str) -> Any:
        """The values (n,) of a parameter that is varied, the one value of another."""
        if name in self.varied:
            return self.varied[name]
        return value_at(self.common, name)

    def full(self, name: str) -> NDArray[Any]:
        """The values (n,) of a parameter, varied or not."""
        return np.broadcast_to(self[name], len(self)) if name not in self.varied else self.varied[name]

    def figures(self, name: str, figure: Callable[[str], float]) -> Array:
        """A figure (n,) of what the texts of a parameter name, such as the density of a material."""
        texts, which = np.unique(self.full(name).astype(str), return_inverse=True)
        return np.array([figure(text) for text in texts.tolist()])[which]

    def some(self, places: "NDArray[Any] | slice") -> "Designs":
        """Those at these places, or where a mask is true."""
        return Designs(self.common, {name: values[places] for name, values in self.varied.items()})


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
    answer: Callable[[Designs, Collection[str], Stage], Answer | None],
    chunk: int = CHUNK,
) -> Columns:
    """What :meth:`Family.evaluate` says, by arrays where ``answer`` has a way, design by design where not."""
    slices = batch.slices or Slices()
    told = slices.memo(refusals, lambda: refusals(batch))
    found = _Found(batch, columns, told.codes, told.forbidden.copy())
    slow = ~told.known
    left = np.flatnonzero(told.known & (told.forbidden == 0))
    root: tuple[int, ...] = (slices.call(),)
    kinds = [(root, left, Designs(told.common, told.values))]
    while kinds:
        kind, places, designs = kinds.pop()
        for start in range(0, places.size, chunk):
            some = places[start : start + chunk]
            hang_on_it = places.size if start == 0 else some.size
            find = partial(_answered, answer, designs.some(some), columns, stage)
            said = slices.answer(Chunk(kind, start), some, hang_on_it, find)
            if isinstance(said, Skipped):
                if start == 0 and slices.only is None:
                    break  # it tells whether arrays have a way
                continue
            if said is None:
                more = _alike(batch, designs, places[start:])
                kinds += [((*kind, number), *one) for number, one in enumerate(more)]
                slow[places[start:]] = not more
                break
            slow[some[said.undecided]] = True
            found.take(some, said)
            if missing := [name for name in columns if name not in said.values]:
                solved = some[said.open]
                found.merge(solved, singly(family, batch, missing, stage, solved, judged=False))
    if slow.any():
        rest = np.flatnonzero(slow)
        found.merge(rest, singly(family, batch, columns, stage, rest))
    return Columns(found.values, found.forbidden, tuple(found.codes))


def _alike(
    batch: Batch[Any], designs: Designs, places: NDArray[np.intp]
) -> list[tuple[NDArray[np.intp], Designs]]:
    """Places of designs with the same texts and switches, or with none of these the same whole numbers.

    What is the same is not varied among them. Nothing where there are too many such sets, or no such values.
    """
    texts = [name for name, values in designs.varied.items() if values.dtype.kind not in "fi"]
    names = texts or [name for name, values in designs.varied.items() if values.dtype.kind == "i"]
    if not 0 < len(names) < len(designs.varied):
        return []
    kind = np.zeros(places.size, np.int64)
    for name in names:
        _, which = np.unique(designs.varied[name][places], return_inverse=True)
        _, kind = np.unique(kind * (which.max() + 1) + which.reshape(-1), return_inverse=True)
    if (kind.max() + 1) * OF_A_KIND > places.size:
        return []
    rest = {name: values for name, values in designs.varied.items() if name not in names}
    order = np.argsort(kind, kind="stable")
    groups = np.split(places[order], np.flatnonzero(np.diff(kind[order])) + 1)
    return [(group, Designs(batch.one(int(group[0])), rest)) for group in groups]


def _answered(
    answer: Callable[[Designs, Collection[str], Stage], Answer | None],
    designs: Designs,
    columns: Collection[str],
    stage: Stage,
) -> Answer | None:
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
