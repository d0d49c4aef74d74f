"""One piece of a study's work, as a worker does it: in this process, in another, or on another machine.

The designs of a study by their numbers: the same whoever asks, and in whatever order.
"""

import json
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.evaluation import Batch
from mechwright.errors import PluginError
from mechwright.plugins.host import host
from mechwright.studies.axis import Axis
from mechwright.studies.fingerprint import fingerprint, unlike
from mechwright.studies.portion import Order, Portion, portion, sliced
from mechwright.studies.shard import shard_of
from mechwright.studies.study import BITS, Study, study_of
from mechwright.worker_pool.budget import limit_cores
from mechwright.worker_pool.recorded_warnings import RecordedWarning, record_warnings, take_warnings


def drawn(study: Study, number: int) -> Batch[Any]:
    """A batch of a study.

    Sobol's points are scrambled and go on from batch to batch; a Latin hypercube is one for each batch.
    """
    first = number * study.batch
    size = min(study.batch, study.count - first)
    if study.asked.method == "grid":
        varied = _grid(study.axes, first, size)
    else:
        shares = _shares(study, number, first, size)
        varied = {axis.name: axis.at(shares[:, place]) for place, axis in enumerate(study.axes)}
    return Batch(study.family.Params, study.content, varied)


def _shares(study: Study, number: int, first: int, size: int) -> Array:
    """Points (size, axes) of the unit cube."""
    from scipy.stats import qmc

    count, seed = len(study.axes), study.asked.seed
    if study.asked.method == "random":
        return np.random.default_rng([seed, number]).random((size, count))
    if study.asked.method == "latin-hypercube":
        cube = qmc.LatinHypercube(count, rng=np.random.default_rng([seed, number]))
        return np.asarray(np.minimum(cube.random(size), np.nextafter(1, 0)))
    sobol = qmc.Sobol(count, scramble=True, bits=BITS, rng=np.random.default_rng(seed))
    if first:
        sobol.fast_forward(first)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # a count that is no power of two is the user's choice
        return np.asarray(np.minimum(sobol.random(size), np.nextafter(1, 0)))


def _grid(axes: tuple[Axis, ...], first: int, size: int) -> dict[str, NDArray[Any]]:
    """The last axis goes fastest."""
    numbers = np.arange(first, first + size, dtype=np.int64)
    varied = {}
    for axis in reversed(axes):
        assert axis.levels is not None  # noqa: S101 - a grid with a continuous axis is refused
        numbers, place = np.divmod(numbers, axis.levels.size)
        varied[axis.name] = axis.levels[place]
    return {axis.name: varied[axis.name] for axis in axes}


@dataclass(frozen=True)
class Task:
    """A batch: one that is drawn, by its number, or one whose parameters are given.

    Parameters
    ----------
    name
        Stem of the name of its file.
    first
        Number of its first design.
    drawn
        Which batch of the study; None for one that is given.
    given
        Parameter to values (n,).
    order
        Which slice of it is done; None for all of it at once.
    """

    name: str
    first: int
    drawn: int | None
    given: Mapping[str, NDArray[Any]] = field(default_factory=dict, repr=False)
    order: Order | None = None

    def size(self, study: Study) -> int:
        """How many designs it has."""
        if self.drawn is None:
            return len(next(iter(self.given.values())))
        return min(study.batch, study.count - self.first)


def batch_of(study: Study, task: Task) -> Batch[Any]:
    """The designs of a task."""
    if task.drawn is not None:
        return drawn(study, task.drawn)
    return Batch(study.family.Params, study.content, task.given)


@dataclass(frozen=True)
class Source:
    """A study as it goes to workers: what its file says, as JSON, and the file's name."""

    text: str
    name: str
    family: str

    @classmethod
    def of(cls, study: Study) -> Self:
        """That of a study, without the tables that go into designs, which workers do not need."""
        kept = ("format", "family", "name", "parameters", "study")
        said = {key: study.file[key] for key in kept if key in study.file}
        return cls(json.dumps(said), study.path.name, study.family.name)

    def done(self, task: Task) -> bytes | Portion:
        """The table of a task, or what its order asks for, by a worker that has only this."""
        study = _opened(self)
        if task.order is None:
            return shard_of(study, batch_of(study, task), task.first)
        batch = sliced(batch_of(study, task)) if task.drawn is None else _drawn(self, task.drawn)
        return portion(study, batch, task.first, task.order)

    def alike(self, own: str, task: Task) -> tuple[bytes | Portion, list[RecordedWarning]]:
        """The same with its warnings, by a worker that may have come after the others were asked.

        It takes one core: a worker has as many threads for tasks as cores are meant for it.

        Raises
        ------
        PluginError
            It has something else than ``own``, the fingerprint of the process that asks.
        """
        if (said := fingerprint(self.family)) != own:
            raise PluginError(unlike(said, own))
        limit_cores(1)
        record_warnings()
        return self.done(task), take_warnings()


@lru_cache(maxsize=4)
def _opened(source: Source) -> Study:
    return study_of(json.loads(source.text), Path(source.name), host())


@lru_cache(maxsize=2)
def _drawn(source: Source, number: int) -> Batch[Any]:
    """A batch that a worker is at: slices of it follow each other."""
    return sliced(drawn(_opened(source), number))
