"""Areas of toothed outlines as columns over designs, in squares of their semi-major axes.

Green's theorem in the moving frame r, t, n (outward), ρ at arc s of the pitch ellipse, origin in its centre,
with p = r n, q = r t and what the rack's module says of the curves: 2 dA is

* of tip and root, at the height h: (p + h) (1 + h/ρ) ds, whose integral is 2 b Δ(u/2) + 2 h Δs - h Δq + h² Δφ
  with the eccentric angle u and the tangent's direction φ, for ∫ p dφ = s - q of any curve;
* of a flank, v = s - s_f: (sin²α + σ v sin α cos α/ρ) (p + σ cot α (v - q)) ds;
* of a fillet, a = x - s, L² = a² + c²: ((a q - c p)/L + L + r_f) ((L + r_f)/ρ + r_f c/L²) ds.

The last two are integrated by Gauss' quadrature over u. A cell of the outline goes from the middle of one
space to that of the next one; what mirrors and turns the gear onto itself gives cells of the same area.

What a cell adds is an analytic function of where it stands on the ellipse, so the sum over many teeth is that
of as many cells of a mean. In the mean over all places, those of p, 1/ρ and p/ρ are 2 A/P, 2 π/P and 1, with
area and perimeter A and P of the ellipse, and those of q and q/ρ are 0; only where flanks end at tips has to
be followed, at a few places.
"""

from collections.abc import Callable

import numpy as np

from mechwright import Array
from mechwright_elliptic_gears.parts.teeth import Arcs, Gears, flank_end

FLANK, FILLET = 6, 10
"""Nodes of a flank and of a fillet: both within 1e-10 of a gear's area."""

SMOOTH = 1e-8
"""What is left, in proportion, of the waves of a cell's area that teeth or places are too few to tell."""

MOST_PLACES = 32
"""Of half a perimeter: enough up to an eccentricity of 0.95."""


def areas_of(gears: Gears) -> Array:
    """Areas (m,) inside of the outlines, without bores."""
    fall = _decay(gears)
    few = 0.5 * gears.teeth[:, 0] * fall < -np.log(SMOOTH)
    places = np.ceil(-np.log(SMOOTH) / fall)
    area = np.empty(fall.size)
    for rows, of in ((np.flatnonzero(~few), by_mean), (np.flatnonzero(few), by_teeth)):
        rows = rows[np.argsort(places[rows], kind="stable")]
        for start in range(0, rows.size, BLOCK):
            some = rows[start : start + BLOCK]
            area[some] = of(gears.rows(some, fall.size), int(min(places[some].max(initial=4), MOST_PLACES)))
    return area


BLOCK = 512
"""Gears that are worked on at once: their arrays stay in the cache."""


def _decay(gears: Gears) -> Array:
    """By how much (m,) the logarithm of a wave's size falls to the next: twice arcosh 1/e."""
    return np.asarray(2 * np.arccosh(1 / np.maximum(gears.eccentricity[:, 0], _ROUND)))


_ROUND = 1e-3
"""An eccentricity below which an ellipse is as good as a circle here."""


def by_mean(gears: Gears, places: int) -> Array:
    """Areas (m,) from the mean of a cell, followed at so many places of half a perimeter."""
    arcs = Arcs(gears.eccentricity)
    b, perimeter = arcs.semi_minor, 2 * np.pi * arcs.mean
    sin, cos = np.sin(gears.angle), np.cos(gears.angle)
    mean, turn = 2 * np.pi * b / perimeter, 2 * np.pi / perimeter
    high, low = gears.addendum * gears.module, -gears.dedendum * gears.module

    def level(height: Array, length: Array) -> Array:
        """Of so long a piece of the curve at a height."""
        return length * (mean / 2 + height + turn * height**2 / 2)

    reach = gears.straight_depth * gears.module / (sin * cos)
    below = (sin**2 * mean * reach - sin * cos * reach**2 + turn * cos**2 * reach**3 / 3) / 2
    u = np.broadcast_to(np.pi * np.arange(places) / places, (b.size, places))
    sine, cosine = np.sin(u), np.cos(u)
    crossing = arcs.arc(sine, cosine, u)
    weight = np.sqrt(1 - (arcs.eccentricity * cosine) ** 2)
    weight = weight / weight.sum(axis=1, keepdims=True)
    half = gears.pitch / 2 - gears.half_space
    end = flank_end(gears, arcs, crossing - half, 1.0)
    above = _integral(arcs, _flank(gears, crossing, 1.0), end.top, u, FLANK)
    tip = _parallel(arcs, high, u, end.below)
    followed = ((above + tip) * weight).sum(axis=1, keepdims=True)
    cell = (
        followed + below + _mean_fillet(gears, mean, turn) + level(low, gears.half_land) + level(high, half)
    )
    area: Array = (2 * gears.teeth * cell)[:, 0]
    return area


def _mean_fillet(gears: Gears, mean: Array, turn: Array) -> Array:
    """From the flank's end to the root (m, 1)."""
    nodes, weights, _ = _RULES[FILLET]
    c, r = gears.module * (gears.dedendum - gears.tip_radius), gears.module * gears.tip_radius
    course = np.arcsinh(1 / np.tan(gears.angle))
    wide = np.cosh(course * (1 + nodes) / 2)
    reach = c * wide
    inside = (reach + r) * (turn * (reach + r) - c / reach) + r * c / reach**2 * (
        reach + r - c / reach * mean
    )
    found: Array = -(inside * c * wide * weights).sum(axis=1, keepdims=True) * course / 4
    return found


def by_teeth(gears: Gears, _places: int = 0) -> Array:
    """Areas (m,) tooth by tooth."""
    arcs, (middles, there) = Arcs(gears.eccentricity), gears.half
    number = np.arange(middles.shape[1])
    alone = (gears.teeth % 2 == 1) & (number == 0)
    ends, cells = [], np.zeros_like(middles)
    for side in (-1.0, 1.0):
        end = flank_end(gears, arcs, middles, side)
        ends.append(end)
        cells += side * _down(gears, arcs, middles, side, end.top)
    cells += _parallel(arcs, gears.addendum * gears.module, ends[0].below, ends[1].below)
    weight = np.where(there, np.where(alone, 1.0, 2.0), 0.0)
    area: Array = np.where(there, weight * cells, 0.0).sum(axis=1)
    return area


def _flank(gears: Gears, crossing: Array, side: float) -> "Callable[[_Frame], Array]":
    wide, tall = np.sin(gears.angle)[..., None], np.cos(gears.angle)[..., None]

    def flank(at: _Frame) -> Array:
        way = at.arc - crossing[..., None]
        regular = wide**2 - side * way * wide * tall / at.radius
        return np.asarray(regular * (at.p - side * tall / wide * (way - at.q)))

    return flank


def _down(gears: Gears, arcs: Arcs, middles: Array, side: float, top: Array) -> Array:
    """From the tip of a tooth down to the middle of the space beside it, on one side (m, k)."""
    sin, cos = np.sin(gears.angle), np.cos(gears.angle)
    depth, radius = gears.module * (gears.dedendum - gears.tip_radius), gears.module * gears.tip_radius
    crossing = middles + side * (gears.pitch / 2 - gears.half_space)
    centre = middles + side * (gears.pitch / 2 - gears.half_land)
    foot, low, middle = (
        arcs.parameter(arc, _STEPS)
        for arc in (centre + side * depth * cos / sin, centre, middles + side * gears.pitch / 2)
    )

    def fillet(at: _Frame) -> Array:
        along, c, r = centre[..., None] - at.arc, depth[..., None], radius[..., None]
        reach = np.hypot(along, c)
        out = (along * at.q - c * at.p) / reach + reach + r
        return np.asarray(out * ((reach + r) / at.radius + r * c / reach**2))

    found = _integral(arcs, _flank(gears, crossing, side), top, foot, FLANK)
    found += _integral(arcs, fillet, foot, low, FILLET)
    return found + _parallel(arcs, -gears.dedendum * gears.module, low, middle)


_STEPS = 9
"""Of Newton's method on the arc, at most."""


class _Frame:
    """The moving frame at eccentric angles (m, k, nodes)."""

    def __init__(self, arcs: Arcs, u: Array, first: Array) -> None:
        """``first`` gives the arc at nodes from the speed there."""
        e, b = arcs.eccentricity[..., None], arcs.semi_minor[..., None]
        sine, cosine = np.sin(u), np.cos(u)
        self.speed = np.sqrt(1 - (e * cosine) ** 2)
        self.p, self.q = b / self.speed, -(e**2) * sine * cosine / self.speed
        self.radius = self.speed**3 / b
        self.arc = first


def _integral(arcs: Arcs, inside: Callable[[_Frame], Array], start: Array, end: Array, nodes: int) -> Array:
    """Half the integral (m, k) of 2 dA/ds over the arc between two eccentric angles (m, k)."""
    places, weights, running = _RULES[nodes]
    half = ((end - start) / 2)[..., None]
    u = start[..., None] + half * (1 + places)
    sine, cosine = np.sin(start), np.cos(start)
    at = _Frame(arcs, u, u)
    at.arc = arcs.arc(sine, cosine, start)[..., None] + half * (at.speed @ running.T)
    found: Array = (inside(at) * at.speed * weights).sum(axis=-1) * half[..., 0] / 2
    return found


def _rule(count: int) -> tuple[Array, Array, Array]:
    """Nodes and weights of Gauss in -1 to 1, and weights (count, count) of integrals from -1 to each node."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    powers = np.arange(count)
    to_node = (nodes[:, None] ** (powers + 1) - (-1.0) ** (powers + 1)) / (powers + 1)
    return nodes, weights, to_node @ np.linalg.inv(nodes[:, None] ** powers)


_RULES = {count: _rule(count) for count in (FLANK, FILLET)}


def _parallel(arcs: Arcs, height: Array, start: Array, end: Array) -> Array:
    """Half the integral (m, k) of 2 dA along the curve at a height over the ellipse."""
    e, b = arcs.eccentricity, arcs.semi_minor
    found, tangents = b * (end - start) / 2, []
    for u, sign in ((start, -1.0), (end, 1.0)):
        sine, cosine = np.sin(u), np.cos(u)
        speed = np.sqrt(1 - (e * cosine) ** 2)
        q = -(e**2) * sine * cosine / speed
        found = found + sign * height * (arcs.arc(sine, cosine, u) - q / 2)
        tangents.append(-sine + 1j * b * cosine)
    turn = np.angle(np.conj(tangents[0]) * tangents[1])
    area: Array = found + height**2 * turn / 2
    return area
