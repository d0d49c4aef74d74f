"""The best designs of a study: kept while its tables are read, searched around, and told one by one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.scripting.pareto import front_of
from mechwright.studies.axis import Axis
from mechwright.studies.shard import NUMBER
from mechwright.studies.study import Study

AROUND = 64
"""Designs that a round of refinement draws around each design of the front."""

WIDTH, NARROWER = 0.1, 0.6
"""Share of its range that a parameter is changed by in the first round at most, and in each round of the one
before."""

MOST = 512
"""Designs of the front that a round searches around, at most; a round has no more designs than the study."""


class Front:
    """The designs of the tables so far that no other dominates."""

    def __init__(self, study: Study) -> None:
        self.study = study
        self.columns: dict[str, NDArray[Any]] = {}

    def __len__(self) -> int:
        return self.columns[NUMBER].size if self.columns else 0

    @property
    def costs(self) -> Array:
        """(n, k), the less the better, in the order of the objectives."""
        return costs_of(self.columns, self.study.objectives)

    def take(self, table: Mapping[str, NDArray[Any]]) -> None:
        """Take the designs of a table into account; the order of the tables does not matter."""
        mine = {name: table[name] for name in (NUMBER, *self.study.units)}
        both = {
            name: np.concatenate([self.columns[name], mine[name]]) if self.columns else mine[name]
            for name in mine
        }
        kept = front_of(costs_of(both, self.study.objectives))
        kept = kept[np.argsort(both[NUMBER][kept], kind="stable")]
        self.columns = {name: values[kept] for name, values in both.items()}

    def design(self, place: int) -> dict[str, Any]:
        """Parameters of a design of the front, dotted name to value."""
        return {axis.name: self.columns[axis.name][place].item() for axis in self.study.axes}


@dataclass(frozen=True)
class Chosen:
    """A design of the front that was checked up to the programs.

    Parameters
    ----------
    design
        Its number.
    name
        Of its design file; empty where it does not build.
    figures
        Column to value.
    refused
        What forbids it, as the check says it.
    """

    design: int
    name: str
    figures: Mapping[str, Any]
    refused: str = ""


def costs_of(table: Mapping[str, NDArray[Any]], objectives: Mapping[str, int]) -> Array:
    """(n, k), the less the better."""
    columns = [sign * table[name].astype(float) for name, sign in objectives.items()]
    return np.column_stack(columns) if columns else np.empty((len(table[NUMBER]), 0))


def around(front: Front, number: int, places: Sequence[int]) -> dict[str, NDArray[Any]]:
    """Designs around some of a front, in the round of this number: parameter to values (n,).

    Each parameter is changed with even chance, by up to a share of its range that gets smaller with every
    round. The same front gives the same designs.
    """
    study = front.study
    rng = np.random.default_rng([study.asked.seed, 1 + number])
    size, width = len(places) * AROUND, WIDTH * NARROWER**number
    change = rng.uniform(-width, width, (size, len(study.axes)))
    change *= rng.random((size, len(study.axes))) < max(0.5, 1 / len(study.axes))
    found = {}
    for column, axis in enumerate(study.axes):
        now = np.repeat(front.columns[axis.name][list(places)], AROUND)
        found[axis.name] = _moved(axis, now, change[:, column])
    kept = _new(front, found)
    return {name: values[kept] for name, values in found.items()}


def _new(front: Front, found: Mapping[str, NDArray[Any]]) -> list[int]:
    """Places of designs that neither the front has nor another one before them."""
    seen = set(zip(*(front.columns[name].tolist() for name in found), strict=True))
    kept = []
    for place, design in enumerate(zip(*(values.tolist() for values in found.values()), strict=True)):
        if design not in seen:
            seen.add(design)
            kept.append(place)
    return kept


def _moved(axis: Axis, now: NDArray[Any], share: Array) -> NDArray[Any]:
    """Values moved by shares of a range, within it."""
    if axis.levels is not None:
        at = {value: place for place, value in enumerate(axis.levels.tolist())}
        places = np.array([at[value] for value in now.tolist()])
        # A step at least, where there is a change at all.
        steps = np.sign(share) * np.ceil(np.abs(share) * (axis.levels.size - 1))
        moved_to: NDArray[Any] = axis.levels[
            np.clip(places + steps.astype(np.int64), 0, axis.levels.size - 1)
        ]
        return moved_to
    if axis.log:
        moved = now * (axis.greatest / axis.least) ** share
    else:
        moved = now + share * (axis.greatest - axis.least)
    return np.clip(moved, axis.least, axis.greatest)
