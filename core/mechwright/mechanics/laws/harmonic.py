"""Laws whose acceleration is a constant and a sine wave, piece by piece."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright.arrays import Array
from mechwright.mechanics.laws.law import Law, Peaks, Rates, largest


@dataclass(frozen=True, slots=True)
class Piece:
    """s'' = constant + amplitude sin(frequency u + phase) up to u = ``end``; frequency above 0, rad."""

    end: float
    constant: float
    amplitude: float
    frequency: float = 1.0
    phase: float = 0.0


class HarmonicPieces(Law):
    """A law that starts at rest with the given accelerations, scaled to reach s = 1 at u = 1.

    Parameters
    ----------
    name
        As a design file says it.
    pieces
        In order; the last ends at 1.

    Examples
    --------
    >>> law = HarmonicPieces("parabolic", [Piece(0.5, 1, 0), Piece(1, -1, 0)])
    >>> float(law.at(0.5).s), law.peaks.v, law.peaks.a
    (0.5, 2.0, 4.0)
    """

    def __init__(self, name: str, pieces: Sequence[Piece]) -> None:
        self.name = name
        self._ends = np.array([piece.end for piece in pieces])
        table = np.array([(p.constant, p.amplitude, p.frequency, p.phase) for p in pieces]).T
        constant, amplitude, self._w, self._p = table
        c1, c0 = np.zeros(len(pieces)), np.zeros(len(pieces))
        s = v = start = 0.0
        for k in range(len(pieces)):  # velocity and way go on without a step
            w, p, a0, amp = self._w[k], self._p[k], constant[k], amplitude[k]
            c1[k] = v - a0 * start + amp / w * np.cos(w * start + p)
            c0[k] = s - c1[k] * start - a0 * start**2 / 2 + amp / w**2 * np.sin(w * start + p)
            start = self._ends[k]
            v = c1[k] + a0 * start - amp / w * np.cos(w * start + p)
            s = c0[k] + c1[k] * start + a0 * start**2 / 2 - amp / w**2 * np.sin(w * start + p)
        self._c0, self._c1, self._a0, self._amp = c0 / s, c1 / s, constant / s, amplitude / s

    @property
    def breaks(self) -> tuple[float, ...]:
        """The ends of the pieces but the last."""
        return tuple(self._ends[:-1].tolist())

    def at(self, u: ArrayLike) -> Rates:
        """The rates at u (...)."""
        u = np.asarray(u, dtype=float)
        k = np.minimum(np.searchsorted(self._ends, u, side="right"), self._ends.size - 1)
        return self._rates(k, u)

    def _rates(self, k: NDArray[np.intp], u: Array) -> Rates:
        """The rates of pieces k, which may be asked for at their very ends."""
        w, a0 = self._w[k], self._a0[k]
        sin, cos = np.sin(w * u + self._p[k]), np.cos(w * u + self._p[k])
        amp = self._amp[k]
        return Rates(
            self._c0[k] + (self._c1[k] + a0 * u / 2) * u - amp / w**2 * sin,
            self._c1[k] + a0 * u - amp / w * cos,
            a0 + amp * sin,
            amp * w * cos,
        )

    @cached_property
    def _extremes(self) -> tuple[Rates, Rates]:
        """Rates at both sides of every break, and where v, a or j may be largest inside a piece."""
        starts = np.concatenate(([0.0], self._ends[:-1]))
        pieces = np.arange(self._ends.size)
        ends = self._rates(np.tile(pieces, 2), np.concatenate((starts, self._ends)))
        where, which = [], []
        for k in pieces:
            w, p, amp = self._w[k], self._p[k], self._amp[k]
            if amp == 0:
                continue
            turns = np.arange(
                np.floor((w * starts[k] + p) / pi) - 1, np.ceil((w * self._ends[k] + p) / pi) + 2
            )
            # s'' = 0 makes the velocity largest; sin = ±1 the acceleration, sin = 0 the jerk.
            zero = np.arcsin(np.clip(-self._a0[k] / amp, -1, 1))
            phases = np.concatenate((turns * pi + zero, turns * pi - zero, turns * pi, turns * pi + pi / 2))
            u = (phases - p) / w
            u = u[(u > starts[k]) & (u < self._ends[k])]
            where.append(u)
            which.append(np.full(u.size, k))
        if not where:
            return ends, ends
        return ends, self._rates(np.concatenate(which), np.concatenate(where))

    @cached_property
    def peaks(self) -> Peaks:
        """Largest velocity, acceleration and jerk, from the phases at which they turn."""
        one, two = self._extremes
        return Peaks(
            *(largest(np.concatenate((getattr(one, name), getattr(two, name)))) for name in ("v", "a", "j"))
        )

    @cached_property
    def least_velocity(self) -> float:
        """The least ds/du."""
        one, two = self._extremes
        return float(min(one.v.min(), two.v.min()))


@cache
def cycloidal() -> HarmonicPieces:
    """S = u - sin(2πu)/2π: the acceleration is one full sine wave."""
    return HarmonicPieces("cycloidal", [Piece(1, 0, 1, 2 * pi)])


@cache
def simple_harmonic() -> HarmonicPieces:
    """S = (1 - cos πu)/2: half a cosine wave, so the acceleration jumps at both ends."""
    return HarmonicPieces("simple-harmonic", [Piece(1, 0, 1, pi, pi / 2)])


@cache
def modified_sine() -> HarmonicPieces:
    """A quick sine wave to the largest acceleration, a slow one through the middle, and the quick one back.

    >>> round(modified_sine().peaks.a, 6)
    5.527957
    """
    return HarmonicPieces(
        "modified-sine",
        [Piece(1 / 8, 0, 1, 4 * pi), Piece(7 / 8, 0, 1, 4 * pi / 3, pi / 3), Piece(1, 0, 1, 4 * pi)],
    )


@cache
def modified_trapezoid() -> HarmonicPieces:
    """A trapezoid of acceleration with sine waves for its slopes: least peak acceleration of the named laws.

    >>> round(modified_trapezoid().peaks.a, 6)
    4.888124
    """
    w = 4 * pi
    return HarmonicPieces(
        "modified-trapezoid",
        [
            Piece(1 / 8, 0, 1, w),
            Piece(3 / 8, 1, 0),
            Piece(5 / 8, 0, 1, w, -pi),  # cos 4π(u - 3/8)
            Piece(7 / 8, -1, 0),
            Piece(1, 0, 1, w),
        ],
    )
