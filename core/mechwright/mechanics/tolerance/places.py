"""Where an output is at its worst, and what the first order says there."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.tolerances import Contributor, Output, ToleranceModel
from mechwright.mechanics.tolerance.first_order import Row, farthest, limits, mean, variances

_ZOOMS, _ZOOMED = 3, 41
"""How often the positions about the worst one are drawn together, and to how many: 1e-4 of a step at last."""


@dataclass(frozen=True)
class Band:
    """An output over the period.

    Parameters
    ----------
    nominal
        (n,), of one component; 0 for an error.
    low, high
        Least and greatest value (n,); of a point 0 and the greatest distance.
    mean
        (n,): not the nominal one where zones do not lie evenly; of a point 0.
    sigma
        Standard deviation (n,) to first order; of a point the root of the mean square distance.
    """

    nominal: Array
    low: Array
    high: Array
    mean: Array
    sigma: Array


@dataclass(frozen=True)
class Place:
    """First order of an output, in one position or between two.

    Parameters
    ----------
    at
        Input positions, rad: one, or for a spread that of the greatest and that of the least value.
    nominal
        Value without any deviation; 0 for an error.
    low, high
        Worst case.
    mean
        Mean error, or mean value.
    sigma
        Standard deviation; of a point the root of the mean square distance from its mean.
    sensitivities
        By contributor, in units of the output per unit of the contributor: signed where both are numbers,
        else the size of the greatest of any direction.
    shares
        Of sigma², by contributor; they sum to 1.
    """

    at: tuple[float, ...]
    nominal: float
    low: float
    high: float
    mean: float
    sigma: float
    sensitivities: tuple[float, ...]
    shares: tuple[float, ...]


def band(model: ToleranceModel, output: Output, at: Array) -> Band:
    """First order over positions (n,); NaN where there is none."""
    row = model.sensitivities(output.name, at)
    nominal = np.zeros(at.shape) if output.figure == "at" else model.nominal(output.name, at)[0]
    sigma = np.sqrt(variances(model.contributors, row).sum(axis=0))
    if output.components > 1:
        none = np.zeros(at.shape)
        return Band(nominal, none, farthest(model.contributors, row), none, sigma)
    low, high = limits(model.contributors, row)
    middle = nominal + mean(model.contributors, row)[0]
    return Band(nominal, nominal + low, nominal + high, middle, sigma)


def place_at(model: ToleranceModel, output: Output, at: float) -> Place:
    """First order in one position."""
    where = np.array(at)
    row = model.sensitivities(output.name, where)
    nominal = 0.0 if output.figure == "at" else float(model.nominal(output.name, where)[0])
    return _place(model, output, row, nominal, (at,))


def worst_place(model: ToleranceModel, output: Output) -> Place | None:
    """First order where the worst case is worst; None where no position has a first order."""
    if output.figure == "spread":
        return _spread(model, output)

    def badness(at: Array) -> Array:
        over = band(model, output, at)
        return -over.low if output.stays_above else np.maximum(-over.low, over.high)

    found = _greatest(badness, model.positions)
    return None if found is None else place_at(model, output, found)


def _greatest(badness: Callable[[Array], Array], positions: Array) -> float | None:
    """The position where something is greatest, from ever finer positions about it."""
    at = positions
    for _ in range(_ZOOMS):
        values = badness(at)
        if not np.isfinite(values).any():
            return None
        top = int(np.nanargmax(values))
        best = float(at[top])
        at = np.linspace(at[max(top - 1, 0)], at[min(top + 1, at.size - 1)], _ZOOMED)
    return best


def _spread(model: ToleranceModel, output: Output) -> Place | None:
    """The pair of positions between which the value can differ most."""
    at = model.positions
    row = model.sensitivities(output.name, at)
    nominal = model.nominal(output.name, at)[0]
    differences = [part[..., :, None] - part[..., None, :] for part in row]
    high = nominal[:, None] - nominal[None, :] + limits(model.contributors, differences)[1]
    if not np.isfinite(high).any():
        return None
    i, j = np.unravel_index(int(np.nanargmax(high)), high.shape)
    pair = [part[..., i] - part[..., j] for part in row]
    return _place(model, output, pair, float(nominal[i] - nominal[j]), (float(at[i]), float(at[j])))


def _place(model: ToleranceModel, output: Output, row: Row, nominal: float, at: tuple[float, ...]) -> Place:
    contributors = model.contributors
    parts = variances(contributors, row)
    total = float(parts.sum())
    shift = mean(contributors, row)
    if output.components > 1:
        low, high, off = 0.0, float(farthest(contributors, row)), float(np.sqrt((shift * shift).sum()))
    else:
        low, high = (nominal + float(value) for value in limits(contributors, row))
        off = nominal + float(shift[0])
    return Place(
        at,
        nominal,
        low,
        high,
        off,
        total**0.5,
        tuple(_sensitivity(one, part) for one, part in zip(contributors, row, strict=True)),
        tuple(float(part) / total if total > 0 else 0.0 for part in parts),
    )


def _sensitivity(one: Contributor, part: Array) -> float:
    if part.shape[:2] == (1, 1) and not one.directions:
        return float(part[0, 0])
    return float(np.linalg.norm(part, 2)) if np.isfinite(part).all() else float("nan")


def finite(values: Sequence[float]) -> bool:
    """Whether all are numbers."""
    return bool(np.isfinite(values).all())
