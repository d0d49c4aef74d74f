"""Moves from rest to rest of a stage, as the chain drives it.

Ca = |α|max T²/Δ of a move by the angle Δ in the time T compares moves whatever their time and way: 4 is the
least that any law can have, 2π has a cycloidal one.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Scalar
from mechwright.contracts.parameters import kept
from mechwright.contracts.transmission import Index
from mechwright.mechanics.chain.links import Link, links_of
from mechwright.mechanics.chain.params import ChainParams, Families
from mechwright.mechanics.chain.running import finely, over

_SAMPLES = 4001
"""Of a move: between two of them an acceleration is off by a share of 1e-7 at its top."""

_HALVINGS = 60
"""Of a step of the input, to the last digit of an angle."""


@dataclass(frozen=True)
class Move:
    """A move of a stage.

    Parameters
    ----------
    number
        Of the stage.
    begin, end
        Angles of the chain's input, rad.
    time
        s.
    acceleration
        Ca.
    """

    number: int
    begin: float
    end: float
    time: float
    acceleration: float


@kept
def moves_of(params: ChainParams, families: Families) -> tuple[Move, ...]:
    """All moves that begin within a period of the chain, stage by stage."""
    return tuple(_moves(params, families))


def _moves(params: ChainParams, families: Families) -> Iterator[Move]:
    links, one = links_of(params, families), finely(params, families).inputs[0].theta
    first = np.concatenate((one, one[1:] + (one[-1] - one[0])))  # a move may go on beyond the period
    run = over(links, first)
    for place, link in enumerate(links):
        own, angle = link.transmission, run.inputs[place].theta
        period = math.tau * float(own.period)
        low, high = float(angle.min()), float(angle.max())
        for index in own.indexes():
            count = range(math.floor((low - index.begin) / period), math.ceil((high - index.begin) / period))
            for k in count:
                ends = index.begin + k * period, index.end + k * period
                if ends[0] < low - _NEAR or ends[1] > high + _NEAR:
                    continue
                when = sorted(_when(links, place, first, end) for end in ends)
                if min(abs(end - one[0]) for end in when) < abs(one[-1] - one[0]) - _NEAR:
                    yield _move(links, place, index, when)


_NEAR = 1e-9
"""rad. A move that begins at the end of a period is that at its beginning."""


def _when(links: tuple[Link, ...], place: int, first: Array, goal: float) -> float:
    """The angle of the chain's input at which that of a stage is ``goal``, by halving."""
    angle = over(links, first).inputs[place].theta
    side = np.sign(angle - goal)
    nearest = int(np.argmin(np.abs(angle - goal)))
    if abs(angle[nearest] - goal) < _NEAR:
        return float(first[nearest])
    change = int(np.flatnonzero(side[1:] != side[:-1])[0])
    low, high = float(first[change]), float(first[change + 1])
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if np.sign(over(links, np.array([middle])).inputs[place].theta[0] - goal) == side[change]:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _move(links: tuple[Link, ...], place: int, index: Index, ends: list[float]) -> Move:
    run = over(links, np.linspace(ends[0], ends[1], _SAMPLES))
    out = links[place].transmission.move(run.inputs[place])
    time = float(abs(run.time[-1] - run.time[0]))
    most = float(np.abs(out.alpha).max())
    return Move(links[place].number, ends[0], ends[1], time, most * time**2 / abs(index.way))


def index_figures(params: ChainParams, families: Families) -> dict[str, Scalar]:
    """Of each stage that indexes: the time of a move and its Ca, both the greatest."""
    found: dict[str, Scalar] = {}
    for move in moves_of(params, families):
        for name, value, unit in (("index_time", move.time, "s"), ("Ca", move.acceleration, "")):
            key = f"{move.number}.{name}"
            before = found[key].value if key in found else 0.0
            found[key] = Scalar(max(before, value), unit)
    return found
