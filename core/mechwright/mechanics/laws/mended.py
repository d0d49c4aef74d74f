"""Laws that are near to rows or coefficients that are none: what a law that is refused proposes instead.

The nearest law that goes through all rows has the least change of its acceleration: a quintic spline at rest
at both ends. Where it would fall, or the rows do, they are joined by the monotone cubic of Fritsch and
Carlson, which is averaged over a sliding window: standing still before its start and after its end it stays
monotone, and comes to rest at both, the more softly the wider the window is.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.laws import LAWS
from mechwright.mechanics.laws.faults import ENDS, table_faults
from mechwright.mechanics.laws.polynomial import Polynomial

Rows = tuple[tuple[float, float], ...]

ROWS = 41
"""Of a table that is proposed: four times the least number."""

LEAST = 3
"""Rows below which there is nothing to go by."""

_DIGITS = 5
"""Of its s: finer than any cam is cut."""

_FINE = 4001
"""Places between which a window slides."""

_WINDOWS = (0.02, 0.05, 0.1, 0.2, 0.35)
"""Half widths, in shares of the way, that are tried one after the other."""

_DEGREE = 5

NAMED = 3
"""Named laws that are proposed."""


def mended_rows(rows: Sequence[tuple[float, float]]) -> Rows | None:
    """The nearest table of a law, tried, for one that has faults; None where there is nothing to go by.

    >>> mended = mended_rows([(0, 0), (0.25, 0.1), (0.5, 0.5), (0.75, 0.9), (1, 1)])
    >>> len(mended), mended[10], mended[20]
    (41, (0.25, 0.1), (0.5, 0.5))
    """
    given = _ordered(rows)
    if given is None:
        return None
    even = np.linspace(0.0, 1.0, ROWS)
    for s in _curves(*given, even):
        found = tuple(zip(even.round(_DIGITS).tolist(), (s.round(_DIGITS) + 0.0).tolist(), strict=True))
        if not any(table_faults(found)):
            return found
    return None


def _ordered(rows: Sequence[tuple[float, float]]) -> tuple[Array, Array] | None:
    """Both columns (n,) from 0 to 1, each u once, in order."""
    if len(rows) < LEAST:
        return None
    u, s = np.asarray(sorted(rows), dtype=float).T
    first = np.append(True, np.diff(u) > ENDS)
    u, s = u[first], s[first]
    if u.size < LEAST or s[-1] - s[0] <= 0:
        return None
    return (u - u[0]) / (u[-1] - u[0]), (s - s[0]) / (s[-1] - s[0])


def _curves(u: Array, s: Array, even: Array) -> Iterator[Array]:
    """Curves (m,) at places (m,), the nearest first."""
    from scipy.interpolate import PchipInterpolator, make_interp_spline

    rest: list[tuple[int, float]] = [(1, 0.0), (2, 0.0)]
    yield make_interp_spline(u, s, _DEGREE, bc_type=(rest, rest))(even)
    rising = np.clip(np.maximum.accumulate(s), 0.0, 1.0)
    joined = PchipInterpolator(u, rising)
    for half in _WINDOWS:
        # The share of the way goes from -half to 1 + half, where the curve stands still beyond its ends.
        place = np.linspace(-2 * half, 1 + 2 * half, _FINE)
        area = np.concatenate(([0.0], np.cumsum(joined(np.clip(place, 0.0, 1.0))))) * (place[1] - place[0])
        edges = np.append(place, 2 * place[-1] - place[-2]) - (place[1] - place[0]) / 2
        middle = (1 + 2 * half) * even - half
        high, low = (np.interp(middle + side * half, edges, area) for side in (1, -1))
        window = (high - low) / (2 * half)
        yield (window - window[0]) / (window[-1] - window[0])


def nearest_laws(rows: Sequence[tuple[float, float]]) -> tuple[str, ...]:
    """The named laws that come nearest to rows, the nearest first.

    >>> nearest_laws([(0, 0), (0.25, 0.1035), (0.5, 0.5), (1, 1)])[0]
    '3-4-5'
    """
    given = _ordered(rows)
    if given is None:
        return tuple(LAWS)
    u, s = given
    off = {name: float(np.square(law().at(u).s - s).sum()) for name, law in LAWS.items()}
    return tuple(sorted(off, key=off.__getitem__))


def instead(rows: Sequence[tuple[float, float]]) -> Iterator[tuple[str, Rows | None]]:
    """Laws to take instead of rows that are none, the nearest first: a table, then names."""
    found = mended_rows(rows)
    if found is not None:
        yield "table", found
    yield from ((name, None) for name in nearest_laws(rows)[:NAMED])


def rows_of(coefficients: Sequence[float]) -> Rows:
    """Rows of a polynomial."""
    u = np.linspace(0.0, 1.0, ROWS)
    return tuple(zip(u.tolist(), Polynomial(coefficients).at(u).s.tolist(), strict=True))
