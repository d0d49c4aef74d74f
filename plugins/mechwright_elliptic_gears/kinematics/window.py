"""The longest stretch of a period on which a speed stays within a band.

Glossary
--------
block
    ``_BLOCK`` consecutive samples. Extremes of 2^k blocks come from tables, those of the rest of a block from
    running ones; together they give those of any stretch, in a time that grows as the number of samples.
reach
    The last argument up to which the band holds for a given start.
"""

from collections.abc import Callable
from dataclasses import dataclass
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from mechwright import Array

Ints = NDArray[np.int64]

_SAMPLES = 8192
"""Grid over a period. It decides which stretch is the longest; extremes inside are known to half its step."""

_BLOCK = 16
"""Samples per block: 512 blocks, whose tables are no larger than the samples."""

_STARTS = 65
"""Starts tried on each of the finer grids around the best one."""

_HILLS = 8
"""Most hills that are looked at: mirror images make two."""

_EQUAL = 1e-9
"""Windows whose lengths differ by less, rad, are equally long."""

_ZOOMS = 2
"""Finer grids; each has 1/32 of the step of the one before."""

_SECTIONS, _COARSE, _FINE = 16, 2, 10
"""An end is sought among so many parts of a step, then among those of that part, and so on: twice to choose
between starts, ten times for the last digit of the best one."""


@dataclass(frozen=True, slots=True)
class Window:
    """A stretch of near-constant speed.

    Parameters
    ----------
    start, length
        rad, ``start`` in [0, period).
    low
        Least speed on it.
    """

    start: float
    length: float
    low: float


def near_constant(speed: Callable[[Array], Array], band: float, period: float = 2 * np.pi) -> Window:
    """Find the longest interval, taken cyclically, on which max - min of ``speed`` is at most ``band``.

    Parameters
    ----------
    speed
        Values (n,) at arguments (n,); continuous, of the given period.
    band
        Above 0, in the unit of ``speed``.
    period
        The whole period is the answer where the band holds everywhere.

    Examples
    --------
    >>> round(near_constant(np.cos, 1.0).length, 9)
    3.141592654
    """
    step = period / _SAMPLES
    values = np.asarray(speed(step * np.arange(_SAMPLES, dtype=np.float64)), dtype=np.float64)
    if values.max() - values.min() <= band:
        return Window(0.0, period, float(values.min()))
    found = _Search(speed, band, step, _Extremes.of(values))
    windows = [found.refined(starts) for starts in found.likely_starts()]
    longest = max(window.length for window in windows)
    # Mirror images are equally long; the first one is the answer.
    equal = [window for window in windows if window.length > longest - _EQUAL]
    best = min(equal, key=lambda window: window.start % period)
    return Window(best.start % period, min(best.length, period), best.low)


_length = attrgetter("length")


@dataclass(frozen=True, slots=True)
class _Extremes:
    """Least and greatest samples of 2^k blocks from each on, and of a block from each of its samples on."""

    samples: Array
    low_runs: list[Array]
    high_runs: list[Array]
    low_from: Array
    high_from: Array

    @classmethod
    def of(cls, values: Array) -> "_Extremes":
        blocks = values.reshape(-1, _BLOCK)
        low_from = np.minimum.accumulate(blocks[:, ::-1], axis=1)[:, ::-1]
        high_from = np.maximum.accumulate(blocks[:, ::-1], axis=1)[:, ::-1]
        lows, highs = [low_from[:, 0]], [high_from[:, 0]]
        while 2 ** len(lows) <= len(blocks):
            reach = 2 ** (len(lows) - 1)
            lows.append(np.minimum(lows[-1], np.roll(lows[-1], -reach)))
            highs.append(np.maximum(highs[-1], np.roll(highs[-1], -reach)))
        return cls(blocks, lows, highs, low_from, high_from)

    def runs(self, block: Ints, low: Array, high: Array, band: float) -> tuple[Ints, Array, Array]:
        """Whole blocks from ``block`` (k,) on that fit with ``low`` and ``high``; the new extremes."""
        count = len(self.samples)
        length = np.zeros(block.size, dtype=np.int64)
        for k in range(len(self.low_runs) - 1, -1, -1):
            there = (block + length) % count
            new_low = np.minimum(low, self.low_runs[k][there])
            new_high = np.maximum(high, self.high_runs[k][there])
            fits = (new_high - new_low <= band) & (length + 2**k <= count)
            length = np.where(fits, length + 2**k, length)
            low, high = np.where(fits, new_low, low), np.where(fits, new_high, high)
        return length, low, high


@dataclass(frozen=True, slots=True)
class _Search:
    speed: Callable[[Array], Array]
    band: float
    step: float
    extremes: _Extremes

    def best(self, starts: Array) -> Window:
        """The longest window that begins at one of the starts."""
        ends, lows, _ = self.reach(starts)
        top = int(np.argmax(ends - starts))
        return Window(float(starts[top]), float(ends[top] - starts[top]), float(lows[top]))

    def refined(self, starts: Array) -> Window:
        """The longest window that begins near one of the starts, which are a step or more apart."""
        best = self.best(starts)
        half = float(np.diff(starts).max(initial=self.step))
        for _ in range(_ZOOMS):
            # Where the speed rises or falls through the window, a later start is paid back by a later end.
            best = max(best, self.best(best.start + half * np.linspace(-1, 1, _STARTS)), key=_length)
            half *= 2 / (_STARTS - 1)
        return self.stretched(best, half)

    def likely_starts(self) -> list[Array]:
        """Samples from which the longest window may start: one array for each hill of its length."""
        count = len(self.extremes.samples)
        nothing = np.full(count, np.inf)
        length = self.extremes.runs(np.arange(count), nothing, -nothing, self.band)[0]
        # The longest window holds at most one block less than the longest run, and starts within the block
        # before its first one.
        blocks = np.flatnonzero(length >= max(int(length.max()) - 1, 0))
        sample = (blocks[:, None] * _BLOCK - np.arange(_BLOCK)).ravel()
        sample = np.unique(sample % (count * _BLOCK))
        starts: Array = (self.step * sample).astype(np.float64)
        ends = self.reach(starts, 0)[0]
        good = np.flatnonzero(ends - starts >= (ends - starts).max() - self.step)
        hills = np.split(good, np.flatnonzero(np.diff(sample[good]) > _BLOCK) + 1)
        # Of a flat hill a few samples tell where it is highest.
        return [starts[hill[:: -(-hill.size // _STARTS)]] for hill in hills[:_HILLS]]

    def stretched(self, window: Window, most: float) -> Window:
        """A window with its start up to ``most`` earlier where the band allows it, and its end as late."""
        end = window.start + window.length
        start: Array = np.array([window.start], dtype=np.float64)
        _, low, high = self.reach(start, 0)
        at_end = self.speed(np.array([end]))
        low, high = np.minimum(low, at_end), np.maximum(high, at_end)
        start = self._last(start, start - most, low, high, _FINE)
        ends, low, _ = self.reach(start, _FINE)
        return max(window, Window(float(start[0]), float(ends[0] - start[0]), float(low[0])), key=_length)

    def reach(self, starts: Array, rounds: int = _COARSE) -> tuple[Array, Array, Array]:
        """End of the band for each start (k,), and the least and greatest speed before it."""
        ext, step = self.extremes, self.step
        count = len(ext.samples)
        at_start = self.speed(starts)
        first = np.ceil(starts / step).astype(np.int64)
        block, offset = np.divmod(first, _BLOCK)
        block %= count
        low = np.minimum(at_start, ext.low_from[block, offset])
        high = np.maximum(at_start, ext.high_from[block, offset])
        whole = high - low <= self.band
        # Where the block of the start does not fit, nothing but its own samples are counted.
        own = self._within(block, np.where(whole, _BLOCK, offset), at_start, at_start)
        runs, low, high = ext.runs(
            (block + 1) % count, np.where(whole, low, np.inf), np.where(whole, high, -np.inf), self.band
        )
        runs = np.where(whole, runs, 0)
        last_block = (block + 1 + runs) % count
        rest, rest_low, rest_high = self._within(last_block, np.zeros_like(offset), low, high)
        taken = np.where(whole, _BLOCK - offset + runs * _BLOCK + rest, own[0])
        low, high = np.where(whole, rest_low, own[1]), np.where(whole, rest_high, own[2])
        taken = np.minimum(taken, count * _BLOCK - 1)
        good = np.maximum((first + taken - 1) * step, starts)
        bad: Array = (first + taken).astype(np.float64) * step
        good = self._last(good, bad, low, high, rounds)
        at_end = self.speed(good)
        return good, np.minimum(low, at_end), np.maximum(high, at_end)

    def _last(self, good: Array, bad: Array, low: Array, high: Array, rounds: int) -> Array:
        """The last argument (k,) from ``good`` towards ``bad`` whose speed fits the extremes."""
        part = np.arange(1, _SECTIONS + 1) / _SECTIONS
        for _ in range(rounds):
            step = bad - good
            values = self.speed(good[:, None] + step[:, None] * part)
            fits = (values <= low[:, None] + self.band) & (values >= high[:, None] - self.band)
            number = np.logical_and.accumulate(fits, axis=1).sum(axis=1)
            bad = good + step * np.minimum(number + 1, _SECTIONS) / _SECTIONS
            good = good + step * number / _SECTIONS
        return good

    def _within(self, block: Ints, offset: Ints, low: Array, high: Array) -> tuple[Ints, Array, Array]:
        """Samples of ``block`` (k,) from ``offset`` on that fit, and the extremes with them."""
        ext = self.extremes
        column = np.arange(_BLOCK)
        samples = np.where(column >= offset[:, None], ext.samples[block], np.nan)
        lows = np.fmin.accumulate(np.column_stack((low, samples)), axis=1)
        highs = np.fmax.accumulate(np.column_stack((high, samples)), axis=1)
        fits = (highs - lows <= self.band)[:, 1:] & (column >= offset[:, None])
        number = fits.sum(axis=1)
        at = np.where(number > 0, offset + number, 0)
        row = np.arange(block.size)
        return number, lows[row, at], highs[row, at]
