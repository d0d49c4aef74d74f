"""Compiled rooms between what shares a height in a slider-crank with a disc, for many one after the other.

A room is the least distance over the samples less half of what both move to the next sample, as
:class:`mechwright.mechanics.linkage.closeness.Closeness` takes it. That class measures polygons whose corners
lie on the outlines, and whose corners' steps count: a room here is a lower and an upper bound, a chord's
error and what a rod's end boss turns apart.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled

(
    SHAFT_ROD, SHAFT_SLIDER, SHAFT_RAIL, PIN_SLIDER, PIN_RAIL, WRIST_CRANK, WRIST_RAIL, DOWEL_CRANK,
    DOWEL_ROD, DOWEL_SLIDER, CRANK_SLIDER, CRANK_RAIL, ROOMS,
) = range(13)  # fmt: skip
"""Spindle and plate, or two plates."""

HEAD_SLIDER, HEAD_RAIL, HEAD_CRANK, ALL_ROOMS = range(ROOMS, ROOMS + 4)
"""Of the heads of pins."""

BEND = 1.1
"""A path between two samples is at most so much longer than its chord, as for the layers."""


@compiled
def _beside(x: float, y: float, wide: float, high: float, corner: float) -> float:
    """Distance from a point to a rounded rectangle about the origin; half its sizes are given."""
    x, y = max(abs(x) - wide + corner, 0.0), max(abs(y) - high + corner, 0.0)
    return max(math.sqrt(x * x + y * y) - corner, 0.0)


@compiled
def _along(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Distance from a point to a segment."""
    dx, dy = bx - ax, by - ay
    share = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
    share = min(max(share, 0.0), 1.0)
    dx, dy = x - ax - share * dx, y - ay - share * dy
    return math.sqrt(dx * dx + dy * dy)


@compiled
def _polygon(
    x: float, y: float, ax: float, ay: float, bx: float, by: float, boss: float, turn: float
) -> float:
    """What a point is at most away from the polygon of a straight rod: from a side, or from a corner.

    The corners of a boss are ``turn`` apart, seen from its middle, and the first are the ends of the sides.
    """
    dx, dy = bx - ax, by - ay
    share = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
    if 0.0 < share < 1.0:
        return _along(x, y, ax, ay, bx, by) - boss
    if share >= 1.0:
        ax, ay, dx, dy = bx, by, -dx, -dy
    x, y = x - ax, y - ay
    beyond = math.atan2(-(dx * x + dy * y), abs(dx * y - dy * x)) / turn
    off = turn * abs(beyond - round(beyond))
    return math.hypot(math.hypot(x, y) * math.cos(off) - boss, math.hypot(x, y) * math.sin(off))


@compiled
def _keep(found: Array, room: int, low: float, high: float) -> None:
    found[room, 0], found[room, 1] = min(found[room, 0], low), min(found[room, 1], high)


@compiled
def rooms(bars: Array, ways: Array, sizes: Array, circle: Array, chord: float, rods: bool) -> Array:
    """Lower and upper bounds (n, ROOMS, 2), mm, radii of spindles not taken off.

    Parameters
    ----------
    bars
        (n, 5): crank a, rod c and offset e, mm, direction of the slide, rad, and the branch.
    ways
        (n, 2): start and travel of the crank, rad.
    sizes
        (n, 11): radii of the rod's bosses and of the disc; half the slider's length and width, and its
        corner's radius; half a rail's length and width, and its corner's radius; the rails' middle along the
        slide, and how far each is from the slide; a dowel's distance from the middle.
    circle
        (3, m): cosine and sine of the samples' shares of a turn, and the shares.
    chord
        Error of the polygons' chords, mm.
    rods
        Whether those of the rod are wanted, which take the longest.
    """
    samples = circle.shape[1]
    found = np.full((len(bars), ROOMS, 2), math.inf)
    ax, ay, s, extent = np.empty(samples), np.empty(samples), np.empty(samples), np.empty(samples)
    for one in range(len(bars)):
        a, c, e, branch = bars[one, 0], bars[one, 1], bars[one, 2], bars[one, 4]
        boss, disc, long, wide, corner = (
            sizes[one, 0],
            sizes[one, 1],
            sizes[one, 2],
            sizes[one, 3],
            sizes[one, 4],
        )
        rail, thick, round_, middle, apart, dowel = sizes[one, 5:]
        out = found[one]
        cos, sin = a * math.cos(bars[one, 3]), a * math.sin(bars[one, 3])
        whole, sense = abs(ways[one, 1]) == math.tau and ways[one, 0] == 0, math.copysign(1.0, ways[one, 1])
        for i in range(samples):
            if whole:
                across = sense * circle[1, i]
                ax[i], ay[i] = circle[0, i] * cos + across * sin, across * cos - circle[0, i] * sin
            else:
                theta = ways[one, 0] + ways[one, 1] * circle[2, i] - bars[one, 3]
                ax[i], ay[i] = a * math.cos(theta), a * math.sin(theta)
            extent[i] = math.sqrt(c * c - (e - ay[i]) ** 2)
            s[i] = ax[i] + branch * extent[i]
        corners = math.pi / max(
            3, math.ceil(math.pi / (4 * math.asin(math.sqrt(min(chord / (2 * boss), 0.5)))))
        )
        turn = 2 * math.sin(abs(ways[one, 1]) / (samples - 1) / 2)
        pin_step, disc_step = BEND * a * turn, BEND * disc * turn
        for y in (e - apart, e + apart):
            gap = _beside(middle, y, rail, thick, round_)
            _keep(out, SHAFT_RAIL, gap, gap + chord)
            away = max(gap - disc, 0.0) - disc_step / 2
            _keep(out, CRANK_RAIL, away, away + 2 * chord)
            for x in (middle - dowel, middle + dowel):
                away = max(math.hypot(x, y) - disc, 0.0) - disc_step / 2
                _keep(out, DOWEL_CRANK, away, away + chord)
        for i in range(samples):
            slid = turned = 0.0
            for k in (max(i - 1, 0), min(i + 1, samples - 1)):
                slid = max(slid, abs(s[k] - s[i]))
                turned = max(turned, abs(ay[k] - ay[i]) / min(extent[k], extent[i]))
            slid *= BEND
            gap = _beside(s[i], e, long, wide, corner)
            _keep(out, SHAFT_SLIDER, gap - slid / 2, gap + chord - slid / 2)
            away = max(gap - disc, 0.0) - (disc_step + slid) / 2
            _keep(out, CRANK_SLIDER, away, away + 2 * chord)
            gap = _beside(ax[i] - s[i], ay[i] - e, long, wide, corner) - (pin_step + slid) / 2
            _keep(out, PIN_SLIDER, gap, gap + chord)
            away = max(math.sqrt(s[i] * s[i] + e * e) - disc, 0.0) - (disc_step + slid) / 2
            _keep(out, WRIST_CRANK, away, away + chord)
            _keep(out, WRIST_RAIL, apart - thick - slid / 2, apart - thick - slid / 2)
            for y in (e - apart, e + apart):
                gap = _beside(ax[i] - middle, ay[i] - y, rail, thick, round_) - pin_step / 2
                _keep(out, PIN_RAIL, gap, gap + chord)
            gap = _beside(dowel - abs(s[i] - middle), apart, long, wide, corner) - slid / 2
            _keep(out, DOWEL_SLIDER, gap, gap + chord)
            if not rods:
                continue
            # What a boss of the rod moves, at least and at most.
            little = max(pin_step, slid)
            much = little + BEND * boss * turned
            gap = max(_along(0.0, 0.0, ax[i], ay[i], s[i], e) - boss, 0.0)
            _keep(out, SHAFT_ROD, gap - much / 2, gap + chord - little / 2)
            for y in (e - apart, e + apart):
                for x in (middle - dowel, middle + dowel):
                    gap = max(_along(x, y, ax[i], ay[i], s[i], e) - boss, 0.0)
                    most = gap + chord
                    if gap - little / 2 < out[DOWEL_ROD, 1]:
                        most = min(most, _polygon(x, y, ax[i], ay[i], s[i], e, boss, corners))
                    _keep(out, DOWEL_ROD, gap - much / 2, max(most, 0.0) - little / 2)
        if not rods:
            out[SHAFT_ROD], out[DOWEL_ROD] = (-math.inf, math.inf), (-math.inf, math.inf)
    return found
