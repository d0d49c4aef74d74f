"""Designs of a batch that are asked one after the other, in slices where it is divided."""

import math
from collections.abc import Callable, Collection, Sequence
from typing import Any, Protocol

import numpy as np

from mechwright.contracts.evaluation import Batch, Columns, one_by_one
from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.contracts.slices import Places, Question, Singles


class Asked(Protocol):
    """A family: who is asked."""

    @property
    def judge(self) -> Callable[[Any], Sequence[Finding]]:
        """What it finds of a design."""
        ...

    @property
    def solve(self) -> Callable[[Any, int], Motion]:
        """The motion of one."""
        ...

    @property
    def parts(self) -> Callable[[Any], Sequence[Part]]:
        """The parts of one."""
        ...


def singly(
    family: Asked,
    batch: Batch[Any],
    columns: Collection[str],
    stage: Stage,
    places: Places,
    *,
    judged: bool = True,
) -> Columns:
    """What a family says of the designs of a batch at ``places``, from ``judge``, ``solve`` and ``parts``.

    What is left for another slice is allowed, and has no values. Without ``judged`` nothing is asked but the
    columns, of designs that are allowed.
    """
    question = Question(judged, tuple(columns))
    slices = batch.slices
    if slices is None:
        return _columns(family, question, batch, stage, places, math.inf)
    found = slices.singly(
        question, places, lambda left, until: singles_of(family, question, batch, stage, left, until)
    )
    codes, which = np.unique(np.append(found.codes.astype(object), ""), return_inverse=True)
    here = np.searchsorted(places, found.places)
    forbidden = np.zeros(places.size, np.int32)
    forbidden[here] = which[:-1]  # the empty code is the first of them
    values = {name: np.full(places.size, np.nan) for name in columns}
    for name, some in found.values.items():
        values[name][here] = some
    return Columns(values, forbidden, tuple(codes.tolist()))


def singles_of(
    family: Asked, question: Question, batch: Batch[Any], stage: Stage, places: Places, until: float
) -> Singles:
    """The same of the first of them, one at least, that are begun before the time ``until``."""
    found = _columns(family, question, batch, stage, places, until)
    codes = np.array(found.codes, dtype=object)[found.forbidden]
    return Singles(places[: codes.size], codes, found.values)


def _columns(
    family: Asked, question: Question, batch: Batch[Any], stage: Stage, places: Places, until: float
) -> Columns:
    judge = family.judge if question.judged else _allowed
    some = batch.at(places)
    return one_by_one(judge, family.solve, some, question.columns, stage, family.parts, until)


def _allowed(params: Any) -> Sequence[Finding]:  # noqa: ARG001 - what is asked has been judged
    return ()
