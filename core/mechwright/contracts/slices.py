"""A batch that is evaluated in slices: what is known of it, what is left, and how long to go on.

A batch is answered by two kinds of work. Its *chunks* are the designs that one call of arrays answers, always
the same ones; all other designs are asked *singly*. Neither depends on what else is evaluated with it.

A family is divided without knowing it.
"""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")
Places = NDArray[np.intp]


class Question(NamedTuple):
    """What designs are asked for singly: these columns, and whether they are judged before."""

    judged: bool
    columns: tuple[str, ...]


@dataclass(frozen=True)
class Singles:
    """What designs gave that were asked singly.

    Parameters
    ----------
    places
        (n,) of the designs in their batch.
    codes
        (n,) texts: what forbids each; empty where nothing does.
    values
        Column to its values (n,).
    """

    places: Places
    codes: NDArray[Any]
    values: Mapping[str, NDArray[np.float64]]

    def plus(self, other: "Singles") -> "Singles":
        """Both together."""
        return Singles(
            np.concatenate([self.places, other.places]),
            np.concatenate([self.codes, other.codes]),
            {name: np.concatenate([one, other.values[name]]) for name, one in self.values.items()},
        )

    def at(self, places: Places) -> "Singles":
        """Of those that are asked at ``places``, in that order, what is known."""
        order = np.argsort(self.places, kind="stable")
        found = np.searchsorted(self.places[order], places)
        found = order[np.minimum(found, order.size - 1)] if order.size else np.zeros(0, np.intp)
        known = found[self.places[found] == places] if order.size else found
        return Singles(self.places[known], self.codes[known], {k: v[known] for k, v in self.values.items()})


class Answered(NamedTuple):
    """A chunk's places (n,) in its batch, and its ``Answer``."""

    places: Places
    answer: Any


@dataclass
class Work:
    """Work on a batch, done or left: answers of chunks and of designs asked singly.

    Parameters
    ----------
    answers, singles
        What is there: answers of chunks, by where each starts among the designs that arrays answer.
    """

    answers: dict[int, Answered] = field(default_factory=dict)
    singles: dict[Question, Singles] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self.answers or self.singles)

    def add(self, question: Question, found: Singles) -> None:
        """Take answers of designs into it."""
        known = self.singles.get(question)
        self.singles[question] = found if known is None else known.plus(found)

    def update(self, other: "Work") -> None:
        """Take other work into it."""
        self.answers.update(other.answers)
        for question, found in other.singles.items():
            self.add(question, found)


@dataclass
class Slices:
    """How far the evaluation of a batch goes, and what has come of it.

    Parameters
    ----------
    known
        What need not be evaluated any more.
    until
        Reading of ``time.perf_counter`` from which on nothing more is begun; the first piece is in any case,
        unless it is 0: then nothing is.
    only
        The chunks that are evaluated, and nothing else; None for all.
    """

    known: Work = field(default_factory=Work)
    until: float = math.inf
    only: frozenset[int] | None = None
    fresh: Work = field(default_factory=Work, init=False)
    """What was evaluated."""
    chunks: list[int] = field(default_factory=list, init=False)
    """Chunks that are left."""
    left: dict[Question, Places] = field(default_factory=dict, init=False)
    """Designs that are left to be asked singly."""
    _memo: Any = field(default=None, init=False)

    def begin(self, known: Work, until: float, only: frozenset[int] | None = None) -> None:
        """Start anew with the same batch."""
        self.known, self.until, self.only = known, until, only
        self.fresh, self.chunks, self.left = Work(), [], {}

    @property
    def complete(self) -> bool:
        """Whether nothing is left."""
        return not self.chunks and not self.left

    def memo(self, find: Callable[[], T]) -> T:
        """What is the same in every evaluation of the batch."""
        if self._memo is None:
            self._memo = find()
        found: T = self._memo
        return found

    def answer(self, chunk: int, places: Places, find: Callable[[], T]) -> T | None:
        """The answer of a chunk, known or found; None where it is left."""
        known = self.known.answers.get(chunk)
        if known is not None and np.array_equal(known.places, places):
            found: T = known.answer
            return found
        if (self.only is not None and chunk not in self.only) or not self._goes_on:
            if self.only is None or chunk in self.only:
                self.chunks.append(chunk)
            return None
        answer = find()
        self.fresh.answers[chunk] = Answered(places, answer)
        return answer

    def singly(self, question: Question, places: Places, find: Callable[[Places, float], Singles]) -> Singles:
        """What is known and found of the designs at ``places``; ``find`` takes the time at which it ends."""
        if self.only is not None or not places.size:
            return Singles(np.zeros(0, np.intp), np.zeros(0, object), {})
        known = self.known.singles.get(question)
        there = None if known is None else known.at(places)
        left = places if there is None else np.setdiff1d(places, there.places, assume_unique=True)
        if left.size and self._goes_on:
            found = find(left, self.until)
            self.fresh.add(question, found)
            there = found if there is None else there.plus(found)
            left = left[found.places.size :]
        if left.size:
            before = self.left.get(question, np.zeros(0, np.intp))
            self.left[question] = np.concatenate([before, left])
        return there or Singles(np.zeros(0, np.intp), np.zeros(0, object), {})

    @property
    def _goes_on(self) -> bool:
        return self.until > 0 and (not self.fresh or time.perf_counter() < self.until)
