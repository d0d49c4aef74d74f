"""A slice of a batch: what a worker is given to do of it, and what it gives."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from mechwright.contracts.evaluation import Batch
from mechwright.contracts.singly import singles_of
from mechwright.contracts.slices import Places, Question, Slices, Work
from mechwright.studies.shard import table_of
from mechwright.studies.study import Study


class Survey(NamedTuple):
    """The batch from its beginning, for so many seconds."""

    seconds: float


class OfChunks(NamedTuple):
    """Some chunks of it, as many as take so many seconds."""

    chunks: tuple[int, ...]
    seconds: float


class OfPlaces(NamedTuple):
    """Some designs of it that are asked singly, as many as are done in so many seconds."""

    question: Question
    places: Places
    seconds: float


Order = Survey | OfChunks | OfPlaces


@dataclass(frozen=True)
class Portion:
    """What came of an order.

    Parameters
    ----------
    work
        What was evaluated.
    chunks, left
        What is left of the whole batch, as far as a survey tells: chunks, and designs that are asked singly.
    seconds
        How long it took.
    """

    work: Work
    chunks: Sequence[int] = ()
    left: dict[Question, Places] = field(default_factory=dict)
    seconds: float = 0.0


def sliced(batch: Batch[Any]) -> Batch[Any]:
    """A batch whose evaluation can be divided."""
    return Batch(batch.model, batch.content, batch.varied, Slices())


def portion(study: Study, batch: Batch[Any], first: int, order: Order) -> bytes | Portion:
    """Do an order on a batch that is :func:`sliced`: its table, if that is all of it, or else a part."""
    begun = time.perf_counter()
    if isinstance(order, OfPlaces):
        found = singles_of(
            study.family, order.question, batch, study.stage, order.places, begun + order.seconds
        )
        work = Work()
        work.add(order.question, found)
        return Portion(work, seconds=time.perf_counter() - begun)
    only = frozenset(order.chunks) if isinstance(order, OfChunks) else None
    return _evaluated(study, batch, first, Work(), begun + order.seconds, only)


def assembled(study: Study, batch: Batch[Any], first: int, known: Work) -> bytes | Portion:
    """The table of a batch from work that was done, with nothing evaluated; if that is not all, the rest."""
    return _evaluated(study, batch, first, known, 0.0, None)


def _evaluated(
    study: Study,
    batch: Batch[Any],
    first: int,
    known: Work,
    until: float,
    only: frozenset[int] | None,
) -> bytes | Portion:
    begun, slices = time.perf_counter(), batch.slices
    assert slices is not None  # noqa: S101 - it is sliced
    slices.begin(known, until, only)
    found = study.family.evaluate(batch, study.measured, study.stage)
    if only is None and slices.complete:
        return table_of(study, batch, first, found)
    return Portion(slices.fresh, slices.chunks, slices.left, time.perf_counter() - begun)
