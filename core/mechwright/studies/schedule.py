"""The batches of a study as they are worked on: cut into slices of some seconds, kept, and put together.

A batch is *surveyed* first: evaluated from its beginning for some seconds, which is all of most batches. The
rest is *open*: chunks and designs that workers take slice by slice. The seconds of a slice say how large the
next one is. Every slice is a file as soon as it is there. No design is given out twice.
"""

from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mechwright.contracts.evaluation import Batch
from mechwright.contracts.slices import Places, Question, Work
from mechwright.errors import PluginFaultError
from mechwright.studies.folder import SweepFolder
from mechwright.studies.portion import OfChunks, OfPlaces, Order, Portion, Survey, assembled, sliced
from mechwright.studies.slice_file import designs_in
from mechwright.studies.standing import Standing
from mechwright.studies.task import Task, batch_of

SECONDS = 5.0
"""What a slice is to take: as much work as a sweep that is killed loses, times the workers."""

LONGEST = 2 * SECONDS
"""Seconds of a slice whose designs take longer than those before; the rest of it is cut off."""

FIRST = 1.0
"""Seconds of a survey where there are fewer batches than workers: the others wait for it."""

MOST_CHUNKS = 256
"""Chunks of a slice: its file says of each what it holds."""

CHUNKS = "chunks"
"""What the pace of chunks is kept under, beside that of each question."""

GROWTH = 4
"""Times as many designs as in the slice before that the next one has at most: their times differ."""


@dataclass
class _Open:
    """A batch of which something is left.

    Parameters
    ----------
    task, batch
        Which one.
    known
        What is there of it.
    chunks, left
        What is left, and not given out.
    away
        Orders that are given out.
    """

    task: Task
    batch: Batch[Any]
    known: Work
    chunks: list[int] = field(default_factory=list)
    left: dict[Question, Places] = field(default_factory=dict)
    away: int = 0
    saved: int = 0
    number: int = 0
    pace: dict[object, tuple[float, int]] = field(default_factory=dict)
    """Of chunks, or of a question: seconds of one piece, and how many the last slice had."""

    @property
    def idle(self) -> bool:
        """Whether nothing of it can be given out."""
        return not self.chunks and not self.left

    def size_of(self, key: object) -> int:
        """How many pieces the next slice has."""
        seconds, before = self.pace.get(key, (SECONDS, 1))
        return max(1, min(int(SECONDS / max(seconds, 1e-9)), GROWTH * before))

    def order(self) -> Order:
        """The next slice."""
        if self.chunks:
            size = min(self.size_of(CHUNKS), MOST_CHUNKS)
            chunks, self.chunks = tuple(self.chunks[:size]), self.chunks[size:]
            return OfChunks(chunks, LONGEST)
        question, places = next(iter(self.left.items()))
        size = self.size_of(question)
        self.left.pop(question)
        if places.size > size:
            self.left[question] = places[size:]
        return OfPlaces(question, places[:size], LONGEST)

    def back(self, order: Order, done: Work) -> None:
        """Take back what of an order is not done."""
        if isinstance(order, OfChunks):
            self.chunks = [one for one in order.chunks if one not in done.answers] + self.chunks
        elif isinstance(order, OfPlaces):
            found = done.singles.get(order.question)
            places = order.places if found is None else order.places[found.places.size :]
            if places.size:
                rest = self.left.pop(order.question, places[:0])
                self.left = {order.question: np.concatenate([places, rest]), **self.left}

    def learn(self, portion: Portion) -> None:
        """Know how long a piece takes."""
        kinds: list[tuple[object, int]] = [
            (CHUNKS, len(portion.work.answers)),
            *((question, one.places.size) for question, one in portion.work.singles.items()),
        ]
        count = sum(number for _, number in kinds)
        for key, number in kinds:
            if number:
                self.pace[key] = portion.seconds / count, number


class Schedule:
    """The slices of some tasks, for workers: see :class:`~mechwright.studies.workers.Queue`.

    Parameters
    ----------
    place
        Where tables and slices go.
    tasks
        Those that have no table yet.
    standing
        Told that work begins.
    workers
        How many slices are done at once; 0 where nobody knows.
    """

    def __init__(self, place: SweepFolder, standing: Standing, tasks: Sequence[Task], workers: int) -> None:
        self.place, self.study, self.standing = place, place.study, standing
        self._new = deque(tasks)
        self._slices = place.all_slices()
        self._waiting = {
            task.name: sum(place.saved_in(task, path) for path in self._slices.get(task.name, []))
            for task in tasks
        }
        self._open: dict[str, _Open] = {}
        self._survey = LONGEST if 0 < workers <= len(tasks) else FIRST
        self.finished = 0
        """Designs whose tables are written."""

    @property
    def saved(self) -> int:
        """Designs that are in slices of batches that have no table yet."""
        return sum(one.saved for one in self._open.values()) + sum(self._waiting.values())

    def take(self) -> Task | None:
        """The next slice; None where there is none before another one is back."""
        self.standing.begun = True
        for one in self._open.values():
            if not one.idle:
                one.away += 1
                return replace(one.task, order=one.order())
        while self._new:
            task = self._new.popleft()
            self._waiting.pop(task.name, None)
            paths = self._slices.get(task.name, [])
            if not paths:
                return replace(task, order=Survey(self._survey))
            one = self._opened(task)
            for path in paths:
                one.known.update(self.place.work_in(task, path))
            one.saved = designs_in(self.study, one.known)
            self._assemble(one)
            if not one.idle:
                return self.take()
        return None

    def again(self, task: Task) -> None:
        """Take back a slice that nobody does any more."""
        order = task.order
        if order is None or isinstance(order, Survey):
            self._new.appendleft(replace(task, order=None))
            return
        one = self._open[task.name]
        one.away -= 1
        one.back(order, Work())

    def put(self, task: Task, found: bytes | Portion) -> None:
        """Keep what came of a slice."""
        order = task.order
        if isinstance(found, bytes):
            self._finish(task, found)
            return
        one = self._open.get(task.name) or self._opened(replace(task, order=None))
        if found.work:
            self.place.store_slice(task, one.number, found.work)
            one.number += 1
            one.saved += designs_in(self.study, found.work)
            one.known.update(found.work)
            one.learn(found)
        if order is None or isinstance(order, Survey):
            one.chunks, one.left = list(found.chunks), dict(found.left)
        elif not found.work:
            name = self.study.family.name
            raise PluginFaultError(f"family {name}: evaluate() leaves out what it was asked for before")
        else:
            one.away -= 1
            one.back(order, found.work)
        if one.idle and not one.away:
            self._assemble(one)

    def _opened(self, task: Task) -> _Open:
        one = _Open(task, sliced(batch_of(self.study, task)), Work())
        one.number = self.place.next_number(task.name)
        self._open[task.name] = one
        return one

    def _assemble(self, one: _Open) -> None:
        """Write the table of a batch, or know what is left of it."""
        found = assembled(self.study, one.batch, one.task.first, one.known)
        if isinstance(found, bytes):
            self._finish(one.task, found)
        else:
            one.chunks, one.left = list(found.chunks), dict(found.left)

    def _finish(self, task: Task, table: bytes) -> None:
        self.place.store(task.name, table)
        self.finished += task.size(self.study)
        self._open.pop(task.name, None)


def without_tables(place: SweepFolder, tasks: Iterable[Task]) -> list[Task]:
    """The tasks whose tables are missing; slices of the others, whose sweep was killed then, are removed."""
    missing, slices = [], place.all_slices()
    for task in tasks:
        if not place.has(task):
            missing.append(task)
        elif task.name in slices:
            place.drop(slices[task.name])
    return missing
