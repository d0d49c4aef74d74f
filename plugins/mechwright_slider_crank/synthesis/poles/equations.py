"""The equations that put a rod's acceleration pole into prescribed places.

In the slide frame, with p = a exp(i φ) the crank pin and t = e - Im p its distance from the slide line, the
pole is at

    G = p (1 + (1 - i k)/z),   z = i α - ω²,   ω = -Re p/w,   α = (Im p + t ω²)/w + k ω,   w = ±√(c² - t²),

ω being the rod's speed over the crank's, α its acceleration over the square of the crank's speed, and k that
of the crank. A crank turns fully if and only if both c - e and c + e are longer than it.
Searched are therefore

    ln a,   ln(c - e - a),   ln(c + e - a),

so that every value of the unknowns is a linkage that turns, and w² = (c - t)(c + t) is a product of sums of
positive numbers: a tiny crank beside a far slide line is as good a place as any other, and nothing cancels.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane

CRANKS = (3e-3, 30.0)
"""Cranks of the starts, over the farthest pole's distance: beyond that nothing can be built."""

EXCESSES = (1e-3, 20.0)
"""c ± e - a of the starts that are drawn freely, over the farthest pole's distance."""

LONGEST_ROD = 1e3
"""Rods of the starts that are drawn through a pole, over the farthest pole's distance."""

DRAWS, ROUNDS = 4, 10
"""How many linkages are drawn through a pole for each that is wanted, as most of them do not turn; how often
at most."""

ANGLES = 90
"""Angles of a turn among which a start chooses."""


@dataclass(frozen=True)
class PoleProblem:
    """Which poles are wanted.

    Parameters
    ----------
    targets
        (n,) places of the pole in the slide frame, from the crank's pivot, not all 0.
    turns
        (n,) crank angles from the first place, rad, the first one 0; None where they are free.
    branch
        +1 with the slider ahead of the crank pin, -1 behind, at all poles.
    ratios
        Acceleration ratios k of the crank at the poles (n,), or one for all.

    The unknowns (m,) are the three logarithms above, and one crank angle if ``turns`` are given, else n.
    """

    targets: Plane
    turns: Array | None
    branch: int
    ratios: Array | float = 0.0

    @property
    def each_ratio(self) -> Array:
        """Acceleration ratios (n,)."""
        return np.broadcast_to(np.asarray(self.ratios, dtype=float), self.targets.shape)

    def angles(self, unknowns: Array) -> Array:
        """Crank angles (..., n), rad, at the poles."""
        return unknowns[..., 3:] if self.turns is None else unknowns[..., 3:] + self.turns

    @staticmethod
    def lengths(unknowns: Array) -> tuple[Array, Array, Array]:
        """Crank a, rod c and offset e (...)."""
        a, below, above = np.moveaxis(np.exp(unknowns[..., :3]), -1, 0)
        return a, a + (above + below) / 2, (above - below) / 2

    def poles(self, unknowns: Array) -> Plane:
        """Acceleration poles (..., n)."""
        return _poles(unknowns, self.angles(unknowns), self.branch, self.ratios)

    def residual(self, unknowns: Array) -> Array:
        """(..., 2n) real and imaginary parts of what the poles miss their places by."""
        miss = self.poles(unknowns) - self.targets
        return np.concatenate((miss.real, miss.imag), axis=-1)

    def slopes(self, unknowns: Array) -> Array:
        """Derivatives (k, 2n, m) of the residuals by the unknowns (k, m)."""
        phi = self.angles(unknowns)
        a, below, above = (np.exp(unknowns[:, [i]]) for i in range(3))
        pin = a * np.exp(1j * phi)
        x, y = pin.real, pin.imag
        minus, plus = below + a + y, above + a - y  # c - t and c + t
        w, t = self.branch * np.sqrt(minus * plus), (plus - minus) / 2
        omega = -x / w
        steady = (y + t * omega**2) / w
        k = self.ratios
        z, drive = 1j * (steady + k * omega) - omega**2, 1 - 1j * k

        def change(pin_: Plane, minus_: Array, plus_: Array) -> Plane:
            """The pole's derivative from those of the pin, of c - t and of c + t: the chain rule."""
            w_, t_ = (minus_ * plus + minus * plus_) / (2 * w), (plus_ - minus_) / 2
            omega_ = -(pin_.real + omega * w_) / w
            alpha_ = (pin_.imag + t_ * omega**2 + 2 * t * omega * omega_ - steady * w_) / w + k * omega_
            pole_: Plane = pin_ * (1 + drive / z) - pin * drive * (1j * alpha_ - 2 * omega * omega_) / z**2
            return pole_

        none = np.zeros_like(y)
        by_lengths = np.stack(
            (change(pin, a + y, a - y), change(none, below + none, none), change(none, none, above + none)),
            axis=-1,
        )
        by_angle = change(1j * pin, x, -x)[:, :, None]
        if self.turns is None:
            by_angle = by_angle * np.eye(phi.shape[1])
        slope = np.concatenate((by_lengths, by_angle), axis=-1)
        return np.concatenate((slope.real, slope.imag), axis=1)

    def starts(self, count: int, rng: np.random.Generator) -> Array:
        """Random unknowns (count, m).

        Half of the linkages meet a pole at once, the others are any that turn; either half alone is slow to
        find some of the solutions.
        """
        through = self._through_a_pole(count // 2, rng)
        rest = count - len(through)
        free = np.column_stack([_logarithms(rng, limits, rest) for limits in (CRANKS, EXCESSES, EXCESSES)])
        lengths = np.concatenate((through, free))
        grid = np.linspace(-math.pi, math.pi, ANGLES, endpoint=False)
        with np.errstate(all="ignore"):
            if self.turns is None:
                places = _poles(lengths[:, None], grid, self.branch, self.each_ratio[:, None])
                miss = np.abs(places - self.targets[:, None])
            else:
                places = _poles(lengths[:, None], grid[:, None] + self.turns, self.branch, self.ratios)
                miss = np.abs(places - self.targets).max(axis=-1)[:, None]
            # The nearest angle, or by chance another near one: a pole's path may come by several times.
            chance = np.exp(rng.standard_exponential(miss.shape))
            nearest = np.argmin(np.nan_to_num(miss * chance, nan=np.inf), axis=-1)
        return np.column_stack((lengths, grid[nearest]))

    def _through_a_pole(self, count: int, rng: np.random.Generator) -> Array:
        """Logarithms (k, 3), k at most ``count``, of linkages that turn and have a pole at some angle.

        Crank and crank angle given, G = p (1 + (1 - i k)/z) says z, thus ω and α, thus w and t, thus rod and
        offset.
        """
        found = np.empty((0, 3))
        for _ in range(ROUNDS):
            size = DRAWS * count
            log_a, phi = _logarithms(rng, CRANKS, size), rng.uniform(-math.pi, math.pi, size)
            pin = np.exp(log_a + 1j * phi)
            with np.errstate(all="ignore"):
                pole = rng.integers(len(self.targets), size=size)
                k = self.each_ratio[pole]
                z = (1 - 1j * k) / (self.targets[pole] / pin - 1)
                w = self.branch * np.abs(pin.real) / np.sqrt(-z.real)
                t = (pin.imag - k * pin.real - z.imag * w) / z.real
                e, c = t + pin.imag, np.hypot(w, t)
                below, above = c - e - np.exp(log_a), c + e - np.exp(log_a)
                good = (np.minimum(below, above) > 0) & (c < LONGEST_ROD)
            rows = np.column_stack((log_a[good], np.log(below[good]), np.log(above[good])))
            found = np.concatenate((found, rows))[:count]
            if len(found) == count:
                break
        return found


def _logarithms(rng: np.random.Generator, limits: tuple[float, float], size: int) -> Array:
    return rng.uniform(math.log(limits[0]), math.log(limits[1]), size)


def _poles(unknowns: Array, phi: Array, branch: int, ratios: Array | float) -> Plane:
    """Acceleration poles (..., n) of unknowns (..., m) at crank angles and acceleration ratios (..., n)."""
    a, below, above = np.moveaxis(np.exp(unknowns[..., :3]), -1, 0)[..., None]
    pin = a * np.exp(1j * phi)
    minus, plus = below + a + pin.imag, above + a - pin.imag
    w, t = branch * np.sqrt(minus * plus), (plus - minus) / 2
    omega = -pin.real / w
    alpha = (pin.imag + t * omega**2) / w + ratios * omega
    pole: Plane = pin * (1 + (1 - 1j * ratios) / (1j * alpha - omega**2))
    return pole
