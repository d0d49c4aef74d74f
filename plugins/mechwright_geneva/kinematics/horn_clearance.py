"""How large a locking disc may be whose ends the wheel's horns do not cut off.

A horn sweeps through the disc's relief while the wheel turns. It has to be outside the disc's circle before
it comes round to the locking arc: with a large disc and a long stroke it is not, and cuts the end of the arc
away. The driver's frame is that of :mod:`mechwright_geneva.parts.locking_disc`.

Glossary
--------
a, l
    Distance of the axes, and the radius of the wheel's rim with the disc's clearance.
h(d)
    Angle at the wheel's axis between the line of centres and a horn at rest, of a disc d:
    d² = a² + l² - 2 a l cos h.
x
    Angle by which the horn is beyond the line of centres: the angle that the wheel has turned, less h.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.design_table import rows_of
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics.geometry import Frame

_SAMPLES = 801
"""Of the stroke."""

SPARE = 1.01
"""A horn is to be so much farther out than the disc."""

ROUNDING = 1e-9
"""Hundredths by which a radius may be off for rounding alone."""

Rows = NDArray[np.intp]

Cut = tuple[Rows, Array, Array]
"""Intervals of radii that are cut: rows of the designs, and both ends (k,), mm, which are not cut."""


def clear(frame: Frame, law: Law, discs: Array, clearance: "float | Array") -> NDArray[np.bool_]:
    """Whether the horns miss the locking arc.

    Parameters
    ----------
    frame, law
        Of one design, or of many as columns (m, 1).
    discs
        (k,) radii of locking discs, mm, that reach the wheel; of many designs one each, (m,).
    clearance
        Of the disc, mm; of many designs a number or (m, 1).
    """
    row, low, high = cut_discs(frame, law, clearance)
    if frame.axes.size == 1:
        return np.asarray(~((discs[:, None] > low) & (discs[:, None] < high)).any(axis=-1))
    missed = np.ones(discs.shape, dtype=bool)
    missed[row[(discs[row] > low) & (discs[row] < high)]] = False
    return missed


def cut_discs(frame: Frame, law: Law, clearance: "float | Array") -> Cut:
    """The discs whose locking arc a horn cuts.

    A horn at x beyond the line of centres is at the angle -β(x) - φ of the driver's frame, with
    tan β = l sin x/(a - l cos x); the locking arc begins at -θd0, and from there the angle falls. So the
    horn is past its beginning where β(x) exceeds the angle t that the crank has turned: between the two
    points where the ray at t from the crank's axis meets the rim, x = σ - t and x = π - σ - t with
    l sin σ = a sin t. It cuts if it is inside the disc's circle there, spare included:
    h(d) + h(1.01 d) > θ, for the wheel at θ. At each θ these are the discs between two radii. Both are steady
    functions of θ, so a run of the stroke in which any discs are cut cuts all between the least and the
    greatest of them.
    """
    axes, rim, half = frame.axes, frame.entry_radius + clearance, frame.crank_half
    share = np.linspace(0, 1, _SAMPLES)
    theta, way = 2 * frame.wheel_half * law.at(share).s, 2 * half * share
    # A symmetric law leaves as it enters, backwards.
    both = ((way, theta), (2 * half - way[..., ::-1], 2 * frame.wheel_half - theta[..., ::-1]))
    runs = [_runs(*_between(axes, rim, *one)) for one in both[: 1 if law.symmetric else 2]]
    row, low, high = (np.concatenate(ends) for ends in zip(*runs, strict=True))
    return row, low, high


def _between(axes: Array, rim: Array, turned: Array, angle: Array) -> tuple[Array, Array]:
    """Least and greatest disc (m, k) that is cut at these angles of crank and wheel.

    None is where they cross, or are no numbers.
    """
    with np.errstate(invalid="ignore"):
        sigma = np.arcsin(axes / rim * np.sin(turned))
    nearer, farther = np.maximum(sigma - turned, 0), np.pi - sigma - turned
    met = (farther > nearer) & (angle > nearer) & (turned < np.pi)
    total, double = axes**2 + rim**2, 2 * axes * rim
    low = total - double * np.cos(np.maximum(angle - farther, 0))
    low = np.sqrt(np.maximum(low, _inside(total, double, angle)))
    high = np.sqrt(total - double * np.cos(angle - nearer))
    return low, np.where(met, high, np.nan)


def _inside(total: Array, double: Array, angle: Array) -> Array:
    """The square of the disc with h(d) + h(1.01 d) = θ, the lesser root of an equation of second degree.

    cos² h + cos² h' - 2 cos h cos h' cos θ = sin² θ, where both cosines are linear in d².
    """
    k, cos = SPARE**2, np.cos(angle)
    square, half = 1 + k * k - 2 * k * cos, total * (1 + k) * (1 - cos)
    rest = 2 * total**2 * (1 - cos) - double**2 * (1 - cos**2)
    found = (half - np.sqrt(np.maximum(half**2 - square * rest, 0))) / square
    # The least disc that reaches the wheel has h = 0, and is met up to h(1.01 d).
    return np.where(total - double * cos > k * (total - double), found, 0)


def _runs(low: Array, high: Array) -> Cut:
    """Least and greatest of each run of samples along which discs are cut, its ends found between samples."""
    low, high = np.atleast_2d(low, high)
    cut = low < high
    edge = np.diff(np.pad(cut, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    row, start = np.nonzero(edge == 1)
    stop = np.nonzero(edge == -1)[1]
    if not row.size:
        return row, np.empty(0), np.empty(0)
    # Each run from its start to its end, then what lies between it and the next one, which is left out.
    size = low.shape[1]
    ends = np.stack([row * size + start, row * size + stop], axis=1).ravel()
    ends = ends[:-1] if ends[-1] == low.size else ends
    first = _crossing(low, high, row, start, np.maximum(start - 1, 0))
    last = _crossing(low, high, row, stop - 1, np.minimum(stop, size - 1))
    least, most = np.minimum.reduceat(low.ravel(), ends)[::2], np.maximum.reduceat(high.ravel(), ends)[::2]
    return row, np.fmin(least, np.fmin(first, last)), np.fmax(most, np.fmax(first, last))


def _crossing(low: Array, high: Array, row: Rows, inside: Rows, outside: Rows) -> Array:
    """Where both ends of an interval meet between two samples; not a number where a sample has none."""
    one, other = (row, inside), (row, outside)
    here, there = (high - low)[one], (high - low)[other]
    with np.errstate(invalid="ignore", divide="ignore"):
        found = low[one] + here / (here - there) * (low[other] - low[one])
    return np.asarray(np.where(there < 0, found, np.nan))


def greatest_discs(frame: Frame, law: Law, least: Array, most: Array, clearance: "float | Array") -> Array:
    """The largest discs (m,) between two radii whose locking arcs the horns miss; ``most`` if none is, mm.

    What is less than ``most`` is a whole number of hundredths, and at most 0.05 % less than the largest:
    ends of intervals are taken between samples as straight lines go.
    """
    found = most.copy()
    rows = np.flatnonzero(least < most)
    if not rows.size:
        return found
    disc, room = most[rows], np.broadcast_to(clearance, (most.size, 1))[rows]
    row, low, high = cut_discs(rows_of(frame, rows, most.size), law, room)
    while (met := (disc[row] > low) & (disc[row] < high)).any():
        below = np.full(rows.size, math.inf)
        np.minimum.at(below, row[met], low[met])
        disc = np.where(np.isfinite(below), np.floor(100 * below - ROUNDING) / 100, disc)
    found[rows] = np.where(disc < least[rows], most[rows], disc)
    return found
