"""Shafts in their holes as measured: the play of each pair, and which copies to put together.

Copies are put together so that the greatest play is least, and of all such choices the sum of plays is least:
the bottleneck assignment of both lists of copies. Source: Burkard, Dell'Amico and Martello, Assignment
Problems, section 6.2.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.bodies import placed
from mechwright.mechanics.mating.choice import Assembled
from mechwright.mechanics.mating.rounds import Match
from mechwright.pipeline.build import Build
from mechwright.pipeline.measured.readings import Reading

JAMS = 1e3
"""Cost of a pair that does not go together, mm: it is chosen where there is no other."""
SAME = 1e-9
"""Plays that differ by less are one, mm."""


@dataclass(frozen=True, eq=False)
class Pairing:
    """Copies of a shaft and of a plate.

    Parameters
    ----------
    shaft, hole
        Part and feature of both, such as ``"pin-a.step-1"``.
    moves
        Whether the shaft turns in the hole.
    shafts, holes
        Names of their copies, in the order of the table.
    plays
        (n, m) float, play of each shaft in each hole, mm; below 0 it does not go in.
    chosen
        For each of the first copies, which shaft goes into which hole: pairs of numbers.
    joints
        Names of the motion's joints that they make.
    """

    shaft: str
    hole: str
    moves: bool
    shafts: tuple[str, ...]
    holes: tuple[str, ...]
    plays: Array
    chosen: tuple[tuple[int, int], ...]
    joints: tuple[str, ...] = ()

    @property
    def as_numbered(self) -> float:
        """Greatest play where each copy goes with that of the same number, mm."""
        return float(max(self.plays[k, k] for k in range(min(self.plays.shape))))

    @property
    def as_chosen(self) -> float:
        """The same of the chosen pairs, mm."""
        return float(max(self.plays[i, j] for i, j in self.chosen))


def pairings(build: Build, readings: Sequence[Reading]) -> list[Pairing]:
    """All pairs of faces of which both were measured."""
    motion = build.design.solve(2)
    whole = Assembled(placed(build.parts, motion), motion)
    sizes: dict[tuple[str, str], list[Reading]] = {}
    for one in readings:
        sizes.setdefault((one.part.name, one.dimension.name), []).append(one)
    found: dict[tuple[tuple[str, str], tuple[str, str]], Pairing] = {}
    for match in whole.matches:
        shaft, hole = _faces(whole, match)
        if shaft not in sizes or hole not in sizes:
            continue
        if (shaft, hole) not in found:
            found[shaft, hole] = _pairing(
                shaft, hole, sizes[shaft], sizes[hole], moves=not whole.same_group(match)
            )
        known = found[shaft, hole]
        joints = dict.fromkeys((*known.joints, *whole.joints_of(match)))
        found[shaft, hole] = replace(known, joints=tuple(joints))
    return list(found.values())


def _faces(whole: Assembled, match: Match) -> tuple[tuple[str, str], tuple[str, str]]:
    pin, hole = whole.bodies[match.pin].part.name, whole.bodies[match.hole].part.name
    return (pin, match.outside.face), (hole, match.inside.face)


def _pairing(
    shaft: tuple[str, str],
    hole: tuple[str, str],
    shafts: Sequence[Reading],
    holes: Sequence[Reading],
    *,
    moves: bool,
) -> Pairing:
    plays = np.subtract.outer([one.value for one in shafts], [one.value for one in holes])
    return Pairing(
        ".".join(shaft),
        ".".join(hole),
        moves,
        tuple(one.copy for one in shafts),
        tuple(one.copy for one in holes),
        -plays,
        least_greatest(-plays),
    )


def least_greatest(plays: Array) -> tuple[tuple[int, int], ...]:
    """Pairs of rows and columns whose greatest play is least; plays below 0 are avoided.

    >>> least_greatest(np.array([[0.03, 0.01], [0.04, 0.02]]))
    ((0, 0), (1, 1))
    >>> least_greatest(np.array([[0.01, 0.03], [0.02, 0.05]]))
    ((0, 1), (1, 0))
    """
    from scipy.optimize import linear_sum_assignment

    costs = np.where(plays < 0, JAMS - plays, plays)
    levels = np.unique(costs)
    low, high = 0, len(levels) - 1
    while low < high:
        middle = (low + high) // 2
        rows, columns = linear_sum_assignment(costs > levels[middle] + SAME)
        if (costs[rows, columns] <= levels[middle] + SAME).all():
            high = middle
        else:
            low = middle + 1
    allowed = np.where(costs <= levels[low] + SAME, costs, costs + len(costs) * (JAMS + levels[-1]))
    rows, columns = linear_sum_assignment(allowed)
    return tuple(zip(rows.tolist(), columns.tolist(), strict=True))
