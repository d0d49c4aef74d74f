"""Least and greatest of what changes over a turn, between the places where rates jump.

A turn is sampled once for all that is measured. Of each smooth piece of it that may hold the greatest value,
parabolas through three samples lead to its top (:mod:`mechwright.mechanics.peaks`), or ever finer grids where
they do not settle.
"""

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import Rows, Rowwise
from mechwright.mechanics.laws import Rates
from mechwright.mechanics.peaks import NEARER, ROUNDING, Tops, climbed
from mechwright_cam_follower.kinematics.contact import Contact, contact_of
from mechwright_cam_follower.kinematics.cycle import Cycle, Segment
from mechwright_cam_follower.kinematics.forces import Loads, loads_at
from mechwright_cam_follower.kinematics.mechanism import Mechanism

GRID, _ROUNDS = 65, 4
"""Samples of a smooth piece, and how often those about the best are drawn together where parabolas do not
settle: each time 32 times."""

HAIR = 1e-12
"""Share of a segment by which its samples stay before a break."""

SPARE = 2.0
"""How often the rise that a parabola through three samples of the grid promises is reckoned with."""

LEVEL = 1e-5
"""Share by which the end of a piece may lie below the greatest sample of all, and have a hill beside it that
is the greatest: such a hill is narrower than a step, and as low."""

EQUAL = 1e-10
"""Share by which tops differ that are one value: the first of them counts."""

BLOCK = 256
"""Designs that are sampled at once, so that arrays stay in the cache."""

RESAMPLED = 0.75
"""Share of the sampled designs below which the rest is sampled anew: nothing is measured of the others."""


@dataclass(frozen=True)
class Extreme(Rowwise):
    """A value and the angle of the cam, rad, where it is, counted about +z as the channel ``theta1`` is."""

    value: Any
    angle: Any


@dataclass(frozen=True)
class Samples:
    """Designs at some angles of the cam, with rates (k,), (1, k) or (n, k)."""

    m: Mechanism
    rates: Rates

    @cached_property
    def contacts(self) -> tuple[Contact, ...]:
        """The contact of each cam."""
        return tuple(contact_of(self.m, self.rates, cam) for cam in self.m.cams)

    @cached_property
    def loads(self) -> Loads:
        """Forces, pressures, torque."""
        return loads_at(self.m, self.rates, self.contacts)


Measure = Callable[[Samples], Array]
"""What is looked at, (k,), (1, k) or (n, k); ``nan`` where there is nothing."""


class Pieces:
    """The smooth pieces of a turn: those of laws, in their order, and then the dwells."""

    def __init__(self, cycle: Cycle) -> None:
        moves = [(one, low, high) for one in cycle.segments if one.law for low, high in pairwise(one.cuts)]
        self.segments: list[Segment] = [one for one, _, _ in moves]
        self.dwells = [one for one in cycle.segments if one.law is None]
        self.low, self.high = (np.array([one[end] for one in moves]) for end in (1, 2))
        shares = [self.inside(np.full(1, p), np.linspace(self.low[p], self.high[p], GRID)[None])[0]
                  for p in range(len(moves))]  # fmt: skip
        rates = [one.at(u) for one, u in zip(self.segments, shares, strict=True)]
        rates += [one.at(np.zeros(1)) for one in self.dwells]
        self.rates = Rates(*(np.concatenate([getattr(one, name) for one in rates]) for name in "svaj"))
        starts = [one.start + one.width * low for one, low, _ in moves] + [one.start for one in self.dwells]
        self.order = np.argsort(starts, kind="stable")

    def inside(self, which: Rows, u: Array) -> Array:
        """Give shares (m, k) of the pieces (m,), none of them beyond its piece."""
        low, high = self.low[which, None], self.high[which, None]
        return np.clip(u, low + HAIR * (low > 0), high - HAIR)

    def at(self, which: Rows, u: Array) -> Rates:
        """Give the rates (m, k) at shares of the pieces (m,)."""
        found = np.empty((4, *u.shape))
        inside = self.inside(which, u)
        for piece in np.unique(which).tolist():
            own = which == piece
            rates = self.segments[piece].at(inside[own])
            found[:, own] = rates.s, rates.v, rates.a, rates.j
        return Rates(*found)

    def angle(self, which: Rows, u: Array) -> Array:
        """Give the angles (m,) of the cam at shares of the pieces (m,)."""
        start, width = (np.array([getattr(one, key) for one in self.segments]) for key in ("start", "width"))
        return np.asarray(start[which] + width[which] * self.inside(which, u[:, None])[:, 0])


class Turn(Rowwise):
    """A turn of a table of designs, sampled once for all that is measured.

    Parameters
    ----------
    m
        The designs, of which nothing has been computed.
    sampled
        A turn of more designs, these among them, and their places in it.
    """

    def __init__(self, m: Mechanism, sampled: "Turn | None" = None, places: Rows | None = None) -> None:
        self.m = m
        self.sampled = self if sampled is None else sampled
        self.places = np.arange(m.size) if places is None else places

    def rows(self, places: Rows, size: int) -> "Turn":  # noqa: ARG002 - of the contract
        """Give the turn of some of the designs."""
        some = self.m.rows(places)
        if places.size < RESAMPLED * self.sampled.m.size:
            return Turn(some)
        return Turn(some, self.sampled, self.places[places])

    @cached_property
    def pieces(self) -> Pieces:
        """Where samples are."""
        return Pieces(self.m.cycle)

    @cached_property
    def blocks(self) -> list[Samples]:
        """The samples of some designs after the other."""
        return [Samples(some, self.pieces.rates) for some in self.m.blocks(BLOCK)]

    def tops(self, measure: Measure) -> tuple[Tops, Array]:
        """Give the greatest samples (n, p) of the moves, and the values (n, d) in the dwells."""
        moves, size = len(self.pieces.segments), self.m.size
        tops, still = [], []
        for block in self.blocks:
            values = np.atleast_2d(measure(block))
            if values.shape[1] == 1:
                values = np.repeat(values, self.pieces.rates.s.size, axis=1)
            grids = values[:, : moves * GRID].reshape(-1, GRID)
            one = Tops.of(grids, len(grids))
            tops.append(np.reshape((one.value, one.sample, one.place, one.rise), (4, -1, moves)))
            still.append(values[:, moves * GRID :])
        found, dwells = np.concatenate(tops, axis=1), np.concatenate(still)
        if found.shape[1] < size:  # all designs have it in common
            found, dwells = np.repeat(found[:, :1], size, axis=1), np.repeat(dwells[:1], size, axis=0)
        return Tops(*found), np.where(np.isnan(dwells), -np.inf, dwells)

    def greatest(self, measure: Measure) -> Extreme:
        """Give the greatest value over the turn, and where it is; of equal ones the first."""
        with np.errstate(all="ignore"):
            value, angle = self._greatest(measure)
        angle = self.m.sense * angle + 0.0  # never -0
        if self.m.single:
            return Extreme(value.item(), angle.item())
        return Extreme(value[:, None], angle[:, None])

    def _greatest(self, measure: Measure) -> tuple[Array, Array]:
        pieces, moves = self.sampled.pieces, len(self.sampled.pieces.segments)
        every, still = self.sampled.tops(measure)
        some = (every.value, every.sample, every.place, every.rise)
        tops = Tops(*(one[self.places].ravel() for one in some))
        still = still[self.places]
        value = tops.value.reshape(-1, moves)
        best = np.max(np.concatenate((value, still), axis=1), axis=1)
        piece = np.tile(np.arange(moves), len(best))
        share = pieces.low[piece] + (pieces.high - pieces.low)[piece] * tops.sample / (GRID - 1)
        values_at = _PieceValues(self.m, measure, pieces, moves)
        near = _near(tops, np.repeat(best, moves), piece, values_at)
        if near.size:
            low, high = pieces.low[piece[near]], pieces.high[piece[near]]
            found, place, settled = climbed(values_at, tops, near, low, high, GRID)
            if not settled.all():
                rest = np.flatnonzero(~settled)
                found[rest], place[rest] = _drawn_together(values_at, near[rest], low[rest], high[rest])
            value.reshape(-1)[near], share[near] = found, place
        angle = pieces.angle(piece, share).reshape(-1, moves)
        starts = np.broadcast_to([one.start for one in pieces.dwells], still.shape)
        values, angles = (
            np.concatenate(pair, axis=1)[:, pieces.order] for pair in ((value, still), (angle, starts))
        )
        best = values.max(axis=1)
        first = np.argmax(values >= (best - EQUAL * np.abs(best))[:, None], axis=1)
        return best, np.where(np.isfinite(best), angles[np.arange(len(best)), first], 0.0)


class _PieceValues:
    """Values of a measure at shares of pieces: function k is about piece k % p of design k // p."""

    def __init__(self, m: Mechanism, measure: Measure, pieces: Pieces, moves: int) -> None:
        self.m, self.measure, self.pieces, self.moves = m, measure, pieces, moves
        self._last: tuple[Rows, Mechanism] | None = None

    def __call__(self, which: Rows, u: Array) -> Array:
        if self._last is None or self._last[0] is not which:
            self._last = which, self.m.rows(which // self.moves)
        rates = self.pieces.at(which % self.moves, u)
        return np.broadcast_to(self.measure(Samples(self._last[1], rates)), u.shape)


def _near(tops: Tops, best: Array, piece: Rows, values_at: _PieceValues) -> Rows:
    """Give the moves of designs that may hold a value above the greatest sample of all.

    Where the greatest sample of a move is at its end, the next value tells: no parabola tells of a flat end.
    """
    size = np.abs(best)
    high = tops.value + SPARE * tops.rise > best + ROUNDING * size
    end = (tops.sample == 0) | (tops.sample == GRID - 1)
    ends = np.flatnonzero(end & (high | (tops.value >= best - LEVEL * size)))
    if ends.size:
        low, up = values_at.pieces.low[piece[ends]], values_at.pieces.high[piece[ends]]
        step = NEARER[-1] * (up - low) / (GRID - 1)
        beside = np.where(tops.sample[ends] == 0, low + step, up - step)
        high[ends] = values_at(ends, beside[:, None])[:, 0] > tops.value[ends]
    return np.flatnonzero(high)


def _drawn_together(values_at: _PieceValues, which: Rows, low: Array, high: Array) -> tuple[Array, Array]:
    """Give the greatest values (m,) and their shares by grids drawn together about the best sample."""
    a, b, row = low, high, np.arange(which.size)
    best, place = np.full(which.size, -np.inf), low.copy()
    for _ in range(_ROUNDS):
        u = a[:, None] + (b - a)[:, None] * np.linspace(0.0, 1.0, GRID)
        values = values_at(which, u)
        values = np.where(np.isnan(values), -np.inf, values)
        top = np.argmax(values, axis=1)
        more = values[row, top] > best
        best, place = np.where(more, values[row, top], best), np.where(more, u[row, top], place)
        a, b = u[row, np.maximum(top - 1, 0)], u[row, np.minimum(top + 1, GRID - 1)]
    return best, place


def turn_of(m: Mechanism) -> Turn:
    """Give the turn of designs that close."""
    return m.once("turn", lambda: Turn(Mechanism(m.given, None if m.single else m.size)))


def greatest(m: Mechanism, name: Hashable, measure: Measure) -> Extreme:
    """Give the greatest value of a measure over the turn; it is kept under its name."""
    return m.once(name, lambda: turn_of(m).greatest(measure))


def least(m: Mechanism, name: Hashable, measure: Measure) -> Extreme:
    """Give the least value of a measure over the turn; it is kept under its name."""

    def turned() -> Extreme:
        found = turn_of(m).greatest(lambda one: -measure(one))
        return Extreme(-found.value, found.angle)

    return m.once(("least", name), turned)
