"""Slider-cranks whose coupler point runs near prescribed points: what the search knows of them.

With the rod as unit and the crank at the angle φ from the slide the coupler point is

    P = X + s a e^{iφ} + q (w + i t),   t = e - a sin φ,   w = ±√(1 - t²),   s = c e^{iθ},

X being the crank's pivot, θ the direction of the slide and q = s (coupler point in the rod's frame over c).
X, s and q enter linearly. The crank turns fully where abs(e) + a < 1: a = (tanh u₁ - tanh u₂)/2 and
e = (tanh u₁ + tanh u₂)/2 with u₁ = u₂ + exp x, so that any values of x and u₂ give such a linkage.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.tracing.order import one_way
from mechwright.mechanics.tracing.points import in_plane, random_angles
from mechwright.mechanics.tracing.search import MARGIN
from mechwright.mechanics.tracing.similar import two_columns

MOST_RATIO = 100.0
"""Starts have no rod longer than this many cranks, whatever is allowed."""

Rectangle = tuple[float, float, float, float]


@dataclass(frozen=True)
class Limits:
    """What a slider-crank keeps.

    Parameters
    ----------
    shortest, longest
        Of crank and rod, mm; the coupler point is no farther from either joint than ``longest``.
    least_angle
        Least transmission angle, rad.
    frame
        Least x, least y, greatest x and greatest y of the crank's pivot, mm; None for anywhere.
    """

    shortest: float
    longest: float
    least_angle: float
    frame: Rectangle | None = None

    def contradiction(self) -> str:
        """The pair of limits that no linkage keeps, and why; empty where they go together.

        The crank is at most the rod times the cosine of the transmission angle, reached without an offset.
        """
        most = self.longest * math.cos(self.least_angle)
        if most <= self.shortest:
            return (
                f"shortest_link of {self.shortest:g} mm and longest_link of {self.longest:g} mm contradict "
                f"least_transmission_angle of {math.degrees(self.least_angle):g} degrees: with it the crank "
                f"is at most {most:.4g} mm long"
            )
        return ""


@dataclass(frozen=True)
class Sliders:
    """Linkages (...) in sizes of the path: a and e over the rod, X, s, q, and the first angle if timed."""

    a: Array
    e: Array
    pivot: Plane
    s: Plane
    q: Plane
    first: Array


@dataclass(frozen=True)
class SliderRoom:
    """Slider-cranks of one assembly and one sense of the crank; see ``mechwright.mechanics.tracing``.

    Parameters
    ----------
    targets
        (n,) points about their middle, over their size.
    turns
        (n,) crank angles from that at the first point, rad; None where they are free.
    branch
        +1 where the slider is ahead of the crank's pin, -1 behind.
    sense
        +1 or -1; that of ``turns`` where these are given.
    closed
        Whether the first point follows on the last.
    slack
        Crank angle, rad, by which a point may lie before the one before it.
    centre, size
        Middle, mm, and size of the path, mm.
    limits
        In millimetres.
    """

    targets: Plane
    turns: Array | None
    branch: int
    sense: int
    closed: bool
    slack: float
    centre: complex
    size: float
    limits: Limits

    def made(self, x: Array) -> Sliders:
        """The linkages of unknowns (..., 8), or (..., 9) with the first crank angle."""
        low = np.tanh(x[..., 1])
        high = np.tanh(x[..., 1] + np.exp(np.minimum(x[..., 0], 30.0)))
        pivot, s, q = (x[..., k] + 1j * x[..., k + 1] for k in (2, 4, 6))
        return Sliders((high - low) / 2, (high + low) / 2, pivot, s, q, x[..., -1])

    def missed(self, made: Sliders, theta: Array) -> Array:
        """See ``Traced``."""
        first, second = self._columns(made.a, made.e, self._angles(made, theta))
        points = made.pivot[..., None] + made.s[..., None] * first + made.q[..., None] * second
        return in_plane(points - self.targets)

    def _angles(self, made: Sliders, theta: Array) -> Array:
        return theta if self.turns is None else made.first[..., None] + self.turns + 0 * theta

    def _columns(self, a: Array, e: Array, phi: Array) -> tuple[Plane, Plane]:
        u = a[..., None] * np.exp(1j * phi)
        t = e[..., None] - u.imag
        return u, self.branch * np.sqrt(np.maximum(1 - t * t, 0.0)) + 1j * t

    def exceeded(self, made: Sliders, theta: Array) -> Array:  # noqa: ARG002 - the contract has it
        """Logarithms of lengths, shares of ``longest``, cosines and places; 0 or less is kept."""
        limits, rod = self.limits, np.log(np.abs(made.s) + 1e-300)
        least, most = (math.log(one / self.size) for one in (limits.shortest, limits.longest))
        reach = limits.longest / self.size
        cosine = math.cos(limits.least_angle)
        found = [
            least - rod - np.log(made.a + 1e-300), rod - most,
            np.abs(made.q) / reach - 1, np.abs(made.q - made.s) / reach - 1,
            made.a + made.e - cosine, made.a - made.e - cosine,
        ]  # fmt: skip
        if limits.frame is not None:
            x0, y0, x1, y1 = limits.frame
            low, high = ((complex(*one) - self.centre) / self.size for one in ((x0, y0), (x1, y1)))
            x, y = made.pivot.real, made.pivot.imag
            found += [low.real - x, low.imag - y, x - high.real, y - high.imag]
        return np.stack(found, axis=-1) + MARGIN

    def dimensions(self, made: Sliders) -> Array:
        """Crank, rod, offset, and the coupler point's coordinates in the rod's frame, (..., 5) mm."""
        rod = np.abs(made.s) * self.size
        point = made.q / made.s
        return np.stack([made.a, 1 + 0 * made.a, made.e, point.real, point.imag], axis=-1) * rod[..., None]

    def ordered(self, theta: Array, sense: Array) -> Array:
        """See ``Traced``; angles that are given are in order."""
        return theta.copy() if self.turns is not None else one_way(theta, sense, self.slack)

    def starts(self, count: int, rng: np.random.Generator) -> tuple[Array, Array, Array]:
        """See ``Room``: random shapes, each laid on the points by linear least squares."""
        room = math.cos(self.limits.least_angle)
        least = max(self.limits.shortest / self.limits.longest, 1 / MOST_RATIO)
        a = np.exp(rng.uniform(math.log(min(least, room)), math.log(room), count))
        e = (room - a) * rng.uniform(-1, 1, count)
        theta = random_angles(count, in_plane(self.targets), self.turns, self.sense, self.closed, rng)
        pivot, s, q, cost = two_columns(*self._columns(a, e, theta), self.targets)
        low, high = np.arctanh(e - a), np.arctanh(e + a)
        x = np.stack(
            [np.log(high - low), low, pivot.real, pivot.imag, s.real, s.imag, q.real, q.imag], axis=-1
        )
        if self.turns is not None:
            x = np.concatenate([x, theta[:, :1]], axis=1)
        over = np.maximum(self.exceeded(self.made(x), theta), 0.0)
        return x, theta, cost + (over**2).sum(axis=-1)
