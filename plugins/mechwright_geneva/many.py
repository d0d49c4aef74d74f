"""Many designs as one: the table and the mechanism, whose numbers are columns (m, 1) over the designs.

All that is said of one :class:`Mechanism` by formulas is said of many by the same formulas.
"""

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.laws import Law
from mechwright_geneva.horns import greatest_discs
from mechwright_geneva.kinematics import Frame, regime
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.params import GenevaParams, Sizes

BLOCK = 64
"""Designs whose strokes are sampled at once: some arrays of half a megabyte."""


class Table:
    """A design table: what differs as columns (m, 1), the rest as it is.

    Parameters
    ----------
    common
        One of the designs.
    columns
        Key to its column.
    """

    def __init__(self, common: GenevaParams, columns: Mapping[str, Any]) -> None:
        self.common = common
        self.columns = dict(columns)

    def __getattr__(self, name: str) -> Any:
        if name in self.columns:
            return self.columns[name]
        derived = getattr(GenevaParams, name, None)
        if isinstance(derived, property) and derived.fget is not None:
            return derived.fget(self)
        return getattr(self.common, name)

    def rows(self, chosen: NDArray[Any]) -> "Table":
        """Some of the designs."""
        return Table(self.common, {key: column[chosen] for key, column in self.columns.items()})


class Mechanisms(Mechanism):
    """The mechanisms of many designs with one number of slots, one law, and drivers of constant speed."""

    @classmethod
    def of(cls, table: Table, law: Law, frame: Frame) -> "Mechanisms":
        """Of a table that leaves no dimension open, and a frame of columns but for θw0."""
        return cls(cast(Sizes, table), law, frame)

    @property
    def table(self) -> Table:
        """Its table."""
        return cast(Table, self.params)

    def rows(self, chosen: NDArray[Any]) -> "Mechanisms":
        """Some of them."""
        return type(self).of(self.table.rows(chosen), self.law, self.frame.rows(chosen))

    def __len__(self) -> int:
        return int(self.frame.crank_half.shape[0])

    @cached_property
    def axes(self) -> Any:
        """Distances of the axes a."""
        return self.frame.axes

    @cached_property
    def crank(self) -> Any:
        """Crank radii b."""
        return self.frame.crank

    @cached_property
    def bottom(self) -> Any:
        """A - b."""
        return self.frame.bottom

    @property
    def crank_half(self) -> Any:
        """θd0."""
        return self.frame.crank_half

    @cached_property
    def side(self) -> Any:
        """As of one."""
        return regime(self.frame, self.law)

    @cached_property
    def measures(self) -> Any:
        """They are made where they are asked for."""
        raise NotImplementedError

    @property
    def nearest(self) -> Any:
        """Of curved slots it is a column of the table, put there by whoever has measured them."""
        return self.crank if self.straight else self.table.columns["nearest"]

    @property
    def greatest_lock(self) -> Any:
        """A column of the table, put there once by :meth:`locked`."""
        return self.table.columns["greatest_lock"]

    def locked(self) -> Array:
        """The greatest locking discs (m, 1)."""
        most = self.nearest - self.groove - self.params.lock_clearance - self.params.least_wall
        clearance: Any = self.params.lock_clearance
        return greatest_discs(self.frame, self.law, np.ravel(self.least_lock), np.ravel(most), clearance)[
            :, None
        ]

    @cached_property
    def lock(self) -> Any:
        """Radii of the locking discs."""
        given: Any = self.params.lock_radius
        return self.greatest_lock if given is None else given

    def with_columns(self, **columns: Array) -> "Mechanisms":
        """The same, with more columns (m, 1) of the table."""
        return type(self).of(Table(self.table.common, self.table.columns | columns), self.law, self.frame)

    def blocks(self) -> "Iterator[Mechanisms]":
        """A few at a time, so that the samples of their strokes stay in the cache."""
        for start in range(0, len(self), BLOCK):
            yield self.rows(np.arange(start, min(start + BLOCK, len(self))))

    def each(self, function: "Callable[[Mechanisms], NDArray[Any]]") -> NDArray[Any]:
        """What a function says (b, ...) of blocks of them, together."""
        return np.concatenate([function(block) for block in self.blocks()])
