"""The figures that decide whether a curved slot can be made, for many designs at once.

Glossary
--------
island
    The material inside the U of a slot, between its two ways.
neck
    The narrowest place of the island on its way from the mouths to its widest place.
web
    The material between neighbouring slots.

For a symmetric law the two ways of a slot are mirror images about its axis, so half a stroke tells all:

* island and its own image touch where the island wall meets the axis: half its width is the distance;
* a web is twice the distance of a way from the axis between two slots, less the slot's width, since the
  shortest line between a curve and its mirror image crosses the mirror at the curve's nearest place.

Other laws are compared point by point, both ways and both neighbours.
"""

from dataclasses import dataclass, fields, replace

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import Rowwise, rows_of
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics.geometry import Frame, Points, Stroke, regime, stroke

SWEEP_SAMPLES = 65
"""Samples of half a stroke in a sweep; with the parabola through the largest three, critical radii come out
within 0.1 % and lengths within 0.01 mm of those of a thousand samples."""

FINE_SAMPLES = 385
"""Samples of half a stroke for one design: critical radii within 1e-9 of their limit."""

_COARSE, _CLOSER, _ZOOMS = 65, 17, 5
"""Samples that find the sharpest bend, those between its neighbours, and how often they are drawn together:
1e-6 of the stroke, where a parabola about the bend is flat to rounding."""

_CROSSED = 1e-3
"""Share of the roller's radius by which a wall may seem nearer to the way than it is: rounding at a cusp."""

_BLOCK = 64
"""Designs taken together in a sweep, so that its arrays stay in the processor's cache."""


@dataclass(frozen=True, slots=True)
class Measures(Rowwise):
    """Figures of m designs, (m, 1) each; mm unless it says otherwise.

    Parameters
    ----------
    side
        -1 in regime A, +1 in B, see :func:`mechwright_geneva.kinematics.geometry.regime`.
    mouth
        Half the island's width at the mouths: l sin|θoff| - r sin(θw0 + θd0), negative for an offset angle of
        the wrong sign.
    island_limit, hub_limit
        Largest roller radius without undercut on the island's wall and on the opposite one; inf if any.
    neck
        Half the width of the island's neck, mouths included.
    width
        Least half width of the island but at its tip; the slot crosses itself where it is not above 0.
    web
        Least web.
    nearest
        Least distance of the roller's way from the crank's axis, wheel at rest.
    """

    side: Array
    mouth: Array
    island_limit: Array
    hub_limit: Array
    neck: Array
    width: Array
    web: Array
    nearest: Array


def measure(frame: Frame, law: Law, radius: Array, samples: int = SWEEP_SAMPLES) -> Measures:
    """Measure designs.

    Parameters
    ----------
    frame
        Of columns (m, 1).
    law
        Any but the straight slot's.
    radius
        (m, 1), mm: half the slot's width.
    samples
        Of half a stroke.
    """
    count = frame.crank_half.shape[0]
    u = samples_of(law, samples)
    blocks = []
    for start in range(0, count, _BLOCK):
        rows = np.arange(start, min(start + _BLOCK, count))
        blocks.append(_measure(rows_of(frame, rows, count), law, radius[rows], u))
    return Measures(*(np.concatenate([getattr(b, f.name) for b in blocks]) for f in fields(Measures)))


LEAST_TIP = 0.5
"""Least radius of the island's tip, mm: a sharper one chips, and cannot be measured."""

NEXT = 0.01
"""Share of a critical radius by which its samples are surely nearer to it: they are within 1e-9."""


def sharpened(found: Measures, frame: Frame, law: Law, radius: Array, *, always: bool) -> Measures:
    """The same with critical radii to rounding where one is next to what it is compared with.

    Parameters
    ----------
    found
        Of designs whose slots have this half width, (m, 1).
    frame, law
        Theirs.
    always
        Whether those of the island are in any case, because people read them.
    """
    island, hub = found.island_limit, found.hub_limit
    close = (np.abs(island - radius) < NEXT * island) | (np.abs(island - radius - LEAST_TIP) < NEXT * island)
    limits = []
    for limit, sign, next_to in ((island, 1, close | always), (hub, -1, hub - radius < NEXT * hub)):
        rows = np.flatnonzero(next_to)
        if rows.size:
            limit, part = limit.copy(), rows_of(frame, rows, radius.size)
            limit[rows, 0] = _critical(part, law, sign * found.side[rows], limit[rows, 0])
        limits.append(limit)
    return replace(found, island_limit=limits[0], hub_limit=limits[1])


def sharpest_bend(frame: Frame, law: Law) -> Array:
    """Greatest curvature (m, 1), 1/mm, of the way to either side, among some samples."""
    values = stroke(frame, law, samples_of(law, _COARSE)).curvature
    sharpest: Array = np.abs(values).max(axis=-1, keepdims=True)
    return sharpest


def _critical(frame: Frame, law: Law, side: Array, sampled: Array) -> Array:
    """The critical radii (m,) on one side, from ever finer samples about the sharpest bend."""
    limits = np.full(sampled.shape, np.inf)
    asked = np.isfinite(sampled)
    part, side = rows_of(frame, np.flatnonzero(asked), asked.size), side[asked]
    row = np.arange(side.size)
    # A law that is not its own mirror image is looked at over the whole stroke.
    start = samples_of(law, _COARSE)
    u, bend = np.broadcast_to(start, (side.size, start.size)), side * stroke(part, law, start).curvature
    best = np.zeros(side.size)
    for zoom in range(_ZOOMS + 1):
        top = np.argmax(bend, axis=-1)
        best = np.maximum(best, bend[row, top])
        if zoom == _ZOOMS:
            break
        low, high = u[row, np.maximum(top - 1, 0)], u[row, np.minimum(top + 1, u.shape[-1] - 1)]
        u = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, _CLOSER)
        bend = side * stroke(part, law, u).curvature
    limits[asked] = np.where(best > 0, 1 / np.where(best > 0, best, 1.0), np.inf)
    return limits


def samples_of(law: Law, samples: int) -> Array:
    """Shares u, dense about mid stroke, where curvatures change fastest; half a stroke of a symmetric law."""
    half = np.sin(np.linspace(0, np.pi / 2, samples)) / 2
    return half if law.symmetric else np.concatenate((half, 1 - half[-2::-1]))


def _measure(frame: Frame, law: Law, radius: Array, u: Array) -> Measures:
    side = np.broadcast_to(regime(frame, law).astype(float), radius.shape)
    run = stroke(frame, law, u)
    kappa = run.curvature
    island = _limit(kappa * side)
    hub = _limit(-kappa * side)
    wall = (run.centre + side * radius * run.normal) * run.to_wheel
    way = run.track
    neck, width, web = _mirrored(run, wall, way, side) if law.symmetric else _compared(run, wall, way)
    # The crank's axis, seen from the wheel at rest before and after the stroke.
    places = (frame.axes, frame.axes * np.exp(-2j * frame.wheel_half))
    nearest = -np.maximum(*(_largest(-np.abs(way - place)) for place in places))
    mouth = -side * frame.entry_radius * np.sin(frame.offset)
    mouth = mouth - radius * np.sin(frame.wheel_half + frame.crank_half)
    mouth, wide = (np.broadcast_to(values, side.shape)[:, 0] for values in (mouth, 2 * radius))
    found = (side[:, 0], mouth, island, hub, neck, width, web - wide, nearest)
    return Measures(*(one[:, None] for one in found))


def _limit(kappa: Array) -> Array:
    """1 / the largest κ (m,) of (m, k); inf where it is not above 0."""
    top = _largest(kappa)
    limit: Array = np.where(top > 0, 1 / np.where(top > 0, top, 1.0), np.inf)
    return limit


def _largest(values: Array) -> Array:
    """The largest (m,) of (m, k): of the samples, or the vertex of the parabola through the three largest."""
    highest = np.argmax(values, axis=-1)
    k = np.clip(highest, 1, values.shape[-1] - 2)
    row = np.arange(values.shape[0])
    before, at, after = values[row, k - 1], values[row, k], values[row, k + 1]
    bend = before - 2 * at + after
    turns = (highest == k) & (bend < 0)
    vertex = at - (before - after) ** 2 / (8 * np.where(turns, bend, 1.0))
    top: Array = np.where(turns, vertex, values[row, highest])
    return top


def _mirrored(run: Stroke, wall: Points, way: Points, side: Array) -> tuple[Array, Array, Array]:
    """Neck and width of the island, halved, and the distance of neighbouring ways."""
    half = side * (wall * np.exp(1j * run.frame.wheel_half)).imag
    inner = half[:, :-1]  # the last sample is mid stroke, on the axis
    index = np.arange(inner.shape[1])
    before = index <= np.argmax(inner, axis=-1)[:, None]
    neck = np.where(before, inner, np.inf).min(axis=-1)
    # The way in is as far from the middle between this slot and the one before as the way out is from the
    # middle between this slot and the next.
    before_it = (way * np.exp(2j * run.frame.wheel_half)).imag
    web = -2 * np.maximum(_largest(-before_it), _largest(way.imag))
    return neck, inner.min(axis=-1), web


def _compared(run: Stroke, wall: Points, way: Points) -> tuple[Array, Array, Array]:
    """The same figures without a mirror: walls on the way in against walls on the way out, slot by slot."""
    middle = way.shape[-1] // 2
    # A wall that crosses itself comes nearer to some other place of the way than to its own.
    own = np.abs(wall - way)[:, :, None]
    nearer = (np.abs(wall[:, :, None] - way[:, None, :]) / np.where(own > 0, own, np.inf)).min(axis=(-1, -2))
    gap = np.abs(wall[:, :middle, None] - wall[:, None, middle + 1 :])
    half = np.minimum(gap.min(axis=-1), gap.min(axis=-2)[:, ::-1]) / 2
    before = np.arange(middle) <= np.argmax(half, axis=-1)[:, None]
    neck = np.where(before, half, np.inf).min(axis=-1)
    crossed = nearer < 1 - _CROSSED
    neck, width = np.where(crossed, -neck, neck), np.where(crossed, nearer - 1, half.min(axis=-1))
    turn = np.exp(2j * run.frame.wheel_half)
    web = np.abs((way * turn)[:, :, None] - way[:, None, :]).min(axis=(-1, -2))
    return neck, width, web
