"""Linkages near a requirement: random ones are ranked, and the best are led on by least squares.

What has to be met are residuals of the order of one. Limits are residuals too, 0 where they are kept: that
the driver turns fully, the least transmission angle, and the lengths of links.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Progress
from mechwright.mechanics.linkage.kinematics.channels import transmission_angle
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.multistart import distinct, least_squares
from mechwright.mechanics.planar.positions import Solution
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.requirements import LinkageSearch
from mechwright_linkage.synthesis.unknowns import Unknowns, joint_distances

TURN = np.linspace(0.0, math.tau, 37)[:-1]
"""Inputs at which the limits of the whole turn are looked at."""

BATCH = 2_000
"""Random linkages that are ranked together."""

LED_ON, STEPS = 64, 60
"""How many of the best random linkages are led on, and for how many steps."""

HARD = 4.0
"""Weight of the limits among the residuals."""

INSIDE = 1.02
"""Share by which a search stays inside of a limit, so that no sample between its own breaks one."""

SPARE = 4
"""Linkages that are good enough for each design that is wanted, with which no further kind is tried: some
of them are alike, or have no room for their layers."""

SAME = 0.02
"""Unknowns that agree so far are one linkage."""


class Task(ABC):
    """What a linkage is to do.

    Parameters
    ----------
    unknowns
        The linkage.
    wanted
        Limits.
    """

    extra = 1
    """Unknowns behind the dimensions: the input of the first position, and others."""

    def __init__(self, unknowns: Unknowns, wanted: LinkageSearch) -> None:
        self.unknowns, self.wanted = unknowns, wanted

    @abstractmethod
    def miss(self, x: Array) -> Array:
        """By how much rows (n, m) miss what is wanted, (n, k), of the order of one."""

    def start(self, count: int, rng: np.random.Generator) -> Array:
        """Random unknowns (n, m)."""
        first = rng.uniform(0.0, math.tau, (count, 1))
        rest = np.zeros((count, self.extra - 1))
        return np.hstack([self.unknowns.random(count, rng), first, rest])

    def split(self, x: Array) -> tuple[Array, Array]:
        """Dimensions, and the other unknowns."""
        count = len(self.unknowns.names)
        return x[:, :count], x[:, count:]

    def residuals(self, x: Array) -> Array:
        """What is missed, and what breaks limits."""
        linkage, turn = self.unknowns.moved(self.split(x)[0], TURN)
        return np.hstack([self.miss(x), HARD * self._beyond(linkage, turn, len(x))])

    def _beyond(self, linkage: Linkage, turn: Solution, count: int) -> Array:
        """How far limits are passed, 0 where they are kept; NaN where the driver does not turn fully."""
        least = math.sin(min(INSIDE * math.radians(self.wanted.least_transmission_angle), math.pi / 2))
        flat = np.maximum(least - np.sin(transmission_angle(turn)), 0.0)
        lengths = joint_distances(linkage) * self.scale
        short = np.maximum(np.log(INSIDE * self.wanted.shortest_link / lengths), 0.0)
        long = np.maximum(np.log(INSIDE * lengths / self.wanted.longest_link), 0.0)
        return np.hstack([np.broadcast_to(one, (count, one.shape[-1])) for one in (flat, short, long)])

    scale: Array | float = 1.0
    """Of the lengths of a linkage whose size follows from the task, (n, 1)."""


@dataclass(frozen=True)
class Found:
    """A linkage that was led on: its task, unknowns (m,), and the root mean square of what it misses."""

    task: Task
    x: Array
    miss: float


def search(
    wanted: LinkageSearch, task_of: Callable[[Unknowns], Task], met: float, progress: Progress
) -> list[Found]:
    """Linkages that keep all limits, the best first.

    Parameters
    ----------
    met
        Root mean square of the misses at which a linkage is good enough. A kind of linkage that has as many
        of them as designs are wanted is not searched further; further kinds are tried while there are few.
    """
    found: list[Found] = []
    for number, name in enumerate(wanted.linkages):
        rng = np.random.default_rng([wanted.seed, number])
        task = task_of(Unknowns(ENTRIES[name]()))
        done = 0
        while done < wanted.starts:
            count = min(BATCH * 5, wanted.starts - done)
            found += _round(task, count, rng)
            done += count
            progress((number + done / wanted.starts) / len(wanted.linkages), f"linkages of the kind {name}")
            if sum(one.miss <= met for one in found if one.task is task) >= wanted.designs:
                break
        if sum(one.miss <= met for one in found) >= SPARE * wanted.designs:
            break
    return _distinct(sorted(found, key=lambda one: one.miss))


def _round(task: Task, count: int, rng: np.random.Generator) -> list[Found]:
    starts, costs = [], []
    for begin in range(0, count, BATCH):
        x = task.start(min(BATCH, count - begin), rng)
        with np.errstate(all="ignore"):
            cost = np.square(task.residuals(x)).sum(axis=1)
        best = np.argsort(np.where(np.isfinite(cost), cost, np.inf))[:LED_ON]
        best = best[np.isfinite(cost[best])]
        starts.append(x[best])
        costs.append(cost[best])
    x, cost = np.concatenate(starts), np.concatenate(costs)
    if not len(x):
        return []
    x = x[np.argsort(cost, kind="stable")[:LED_ON]]
    ends, _ = least_squares(task.residuals, x, STEPS, 1e-20)
    found = []
    with np.errstate(all="ignore"):
        residuals, misses = task.residuals(ends), task.miss(ends)
    for row, residual, miss in zip(ends, residuals, misses, strict=True):
        limits = residual[miss.size :]
        if np.isfinite(residual).all() and np.abs(limits).max(initial=0.0) < HARD * (1 - 1 / INSIDE) / 2:
            found.append(Found(task, row, float(np.sqrt(np.mean(miss**2)))))
    return found


def _distinct(found: list[Found]) -> list[Found]:
    kept: list[Found] = []
    for task in dict.fromkeys(one.task for one in found):
        own = [one for one in found if one.task is task]
        rows = np.array([one.task.split(one.x[None])[0][0] for one in own])
        kept += [own[place] for place in distinct(rows, SAME)]
    return sorted(kept, key=lambda one: one.miss)
