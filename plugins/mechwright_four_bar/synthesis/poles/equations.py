"""The equations that put a coupler's acceleration pole into prescribed places.

With the ground line as unit (A0 = 0, B0 = 1) and the crank at angle φ from it, the pole is at

    γ(a, b, c, φ) = a e^{iφ} (1 + (1 - i k)/(i α - w²)),

w being the coupler's speed over the crank's, α its acceleration over the square of the crank's speed, and k
that of the crank: α = α₀ + k w with the coupler's second derivative by the crank angle. The true pole is s γ
with s = f e^{iθ}: length and direction of the ground enter linearly. They are eliminated where they are not
prescribed, by the least squares of s γ_j - t_j.

The dyad of c and b must span the diagonal D between A and B0. Searched are therefore

    ln a,   x = ln((b + c)/D_max - 1),   y = artanh((b - c)/D_min),

so that no value of the unknowns leaves the loop open, and solutions near a toggle, where lengths decide by
their fifth digit, are no needles in a haystack. D_max and D_min are those of a full turn, 1 + a and
abs(1 - a), or those of the prescribed positions only.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.kinematics.dimensions import FourBar

SPREAD = 100.0
"""Starts have cranks and dyads between 1/SPREAD and SPREAD ground lines: beyond that nothing can be built."""

LEAST_EXCESS = 1e-4
"""Least share by which the dyads of the starts are longer than the diagonal; the search goes below."""

STRETCH = 4.0
"""Largest y in the starts: tanh(4) leaves a thousandth of the diagonal."""


def random_shapes(count: int, rng: np.random.Generator) -> Array:
    """Random ln a, x and y (count, 3)."""
    most, least = math.log(SPREAD), math.log(LEAST_EXCESS)
    ranges = (-most, most), (least, most), (-STRETCH, STRETCH)
    return np.column_stack([rng.uniform(low, high, count) for low, high in ranges])


def unit_pole(a: Array, b: Array, c: Array, phi: Array, branch: int, ratio: Array | float = 0.0) -> Plane:
    """Acceleration pole of the coupler over a ground of length 1 along X, for arrays that broadcast.

    Lengths are positive, in ground lengths; ``phi`` in rad; ``ratio`` is the crank's acceleration ratio; the
    result is NaN where the loop is open.
    """
    crank = np.exp(1j * phi)
    d = 1 - a * crank
    distance = np.abs(d)
    k = (c - b) * (c + b) + distance**2
    room = (c + distance + b) * (c + distance - b) * (b + c - distance) * (b - c + distance)
    s = d * (k + 1j * branch * np.sqrt(room)) / (2 * c * distance**2)
    p = (c * s - d) / b
    lever = -1 / (s * np.conj(p)).imag
    r = -1j * a * crank
    w, v = lever * (r * np.conj(p)).real / c, lever * (r * np.conj(s)).real / b
    r = a * crank + c * w**2 * s - b * v**2 * p
    alpha = lever * (r * np.conj(p)).real / c + ratio * w
    pole: Plane = a * crank * (1 + (1 - 1j * ratio) / (1j * alpha - w**2))
    return pole


@dataclass(frozen=True)
class PoleProblem:
    """Which poles are wanted, and what is prescribed besides.

    Parameters
    ----------
    targets
        (n,) places of the pole, mm from A0, not all 0.
    turns
        (n,) crank angles from the first place, rad, the first one 0; None where they are free.
    ground_angle
        rad, None where it is free.
    ground
        mm, None where it is free; prescribed only together with the angle.
    branch
        +1 or -1 at all poles.
    full_turn
        Whether only linkages whose crank turns fully are searched, or all that reach the positions.
    ratios
        Acceleration ratios of the crank at the poles (n,), or one for all.

    The unknowns (m,) are ln a, x and y, and the crank angles from the ground line: one if ``turns`` are
    given, else n.
    """

    targets: Plane
    turns: Array | None
    ground_angle: float | None
    ground: float | None
    branch: int
    full_turn: bool
    ratios: Array | float = 0.0

    @property
    def each_ratio(self) -> Array:
        """Acceleration ratios (n,)."""
        return np.broadcast_to(np.asarray(self.ratios, dtype=float), self.targets.shape)

    @property
    def unknowns(self) -> int:
        """Number m of the unknowns that are searched."""
        return 3 + (1 if self.turns is not None else self.targets.size)

    @property
    def freedom(self) -> int:
        """Unknowns, the eliminated ones too, less equations; above 0 there are infinitely many solutions."""
        eliminated = (self.ground_angle is None) + (self.ground is None)
        return self.unknowns + eliminated - 2 * self.targets.size

    def angles(self, unknowns: Array) -> Array:
        """Crank angles (..., n), rad, from the ground line at the poles."""
        return unknowns[..., 3:] if self.turns is None else unknowns[..., 3:] + self.turns

    def lengths(self, unknowns: Array) -> tuple[Array, Array, Array]:
        """Crank, follower and coupler (...) in ground lengths."""
        a = np.exp(unknowns[..., 0])
        if self.full_turn:
            most, least = 1 + a, np.abs(1 - a)
        else:
            diagonal = np.abs(1 - a[..., None] * np.exp(1j * self.angles(unknowns)))
            most, least = diagonal.max(axis=-1), diagonal.min(axis=-1)
        total, difference = most * (1 + np.exp(unknowns[..., 1])), least * np.tanh(unknowns[..., 2])
        return a, (total + difference) / 2, (total - difference) / 2

    def _poles(self, unknowns: Array) -> tuple[Plane, Plane]:
        """γ (..., n) and s (..., 1)."""
        a, b, c = (length[..., None] for length in self.lengths(unknowns))
        gamma = unit_pole(a, b, c, self.angles(unknowns), self.branch, self.ratios)
        if self.ground_angle is None:
            size = np.sum(np.abs(gamma) ** 2, axis=-1, keepdims=True)
            return gamma, np.sum(np.conj(gamma) * self.targets, axis=-1, keepdims=True) / size
        unit = np.exp(1j * self.ground_angle)
        if self.ground is not None:
            return gamma, np.full(gamma[..., :1].shape, self.ground * unit)
        size = np.sum(np.abs(gamma) ** 2, axis=-1, keepdims=True)
        length = np.sum((np.conj(gamma * unit) * self.targets).real, axis=-1, keepdims=True) / size
        return gamma, length * unit

    def residual(self, unknowns: Array) -> Array:
        """(..., 2n) real and imaginary parts of s γ - t, over the farthest target."""
        gamma, scale = self._poles(unknowns)
        error = (scale * gamma - self.targets) / np.abs(self.targets).max()
        return np.concatenate((error.real, error.imag), axis=-1)

    def starts(self, count: int, rng: np.random.Generator) -> Array:
        """Random unknowns (count, m), crank angles all around."""
        shapes = random_shapes(count, rng)
        return np.column_stack((shapes, rng.uniform(0, math.tau, (count, self.unknowns - 3))))

    def bar(self, unknowns: Array) -> tuple[FourBar, Array] | None:
        """The linkage of unknowns (m,), and its crank angles (n,) from X, rad; None if turned inside out."""
        _, scale = self._poles(unknowns)
        s = complex(scale[0])
        if self.ground_angle is not None and (s * np.exp(-1j * self.ground_angle)).real <= 0:
            return None
        a, b, c = (float(length) * abs(s) for length in self.lengths(unknowns))
        theta = float(np.angle(s)) if self.ground_angle is None else self.ground_angle
        angles: Array = self.angles(unknowns) + theta
        return FourBar(a, c, b, abs(s), theta, self.branch), angles
