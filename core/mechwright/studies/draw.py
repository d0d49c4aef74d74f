"""The designs of a study by their numbers: the same whoever asks, and in whatever order."""

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.evaluation import Batch
from mechwright.studies.axis import Axis
from mechwright.studies.study import BITS, Study


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
