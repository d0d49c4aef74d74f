"""Harmonics of one turn as columns, and functions of a law with their slopes by its amplitudes.

ψ = φ + Σ A_j sin jφ + B_j (1 - cos jφ). A law that is even about φ = 0 has no B. What is asked of a law is a
function f(ψ, i, i', i'', y) at places φ, with unknowns y of its own; ψ, i, i' and i'' are linear in the
amplitudes, and partial derivatives of f are taken by a step along the imaginary axis, which loses no digits.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mechwright import Array

_STEP = 1e-30

Complex = NDArray[np.complex128]


@dataclass(frozen=True, slots=True)
class Point:
    """A law at places: ψ, i, i' and i'' (n,) each, and the goal's unknowns y (k,)."""

    psi: Complex
    i: Complex
    first: Complex
    second: Complex
    y: Complex

    @property
    def slope(self) -> Complex:
        """Tan ν = i'/(i (1 + i)) of both pitch curves."""
        return self.first / (self.i * (1 + self.i))

    @property
    def curvatures(self) -> tuple[Complex, Complex]:
        """Those of both pitch curves for a centre distance of 1, as `Rolling` has them."""
        i, w = self.i, 1 + self.i
        g = np.sqrt((i * w) ** 2 + self.first**2)
        one = w**3 * (i * i * w + 2 * self.first**2 - i * self.second) / g**3
        return one, w**3 / g - one


Pointwise = Callable[[Point], Complex]
"""A function (n,) of a point, real for real ones."""


@dataclass(frozen=True)
class Waves:
    """The amplitudes of a law, and how ψ and its derivatives hang on them at places φ (n,).

    Parameters
    ----------
    phi
        Places, rad.
    orders
        Numbers j of the harmonics (m,).
    even
        Whether the law is even about φ = 0, so that there are no cosines.
    """

    phi: Array
    orders: Array
    even: bool

    @property
    def count(self) -> int:
        """Number of amplitudes: sines, then cosines."""
        return self.orders.size * (1 if self.even else 2)

    def columns(self) -> tuple[Array, ...]:
        """Matrices (n, count) of ψ, i, i' and i'' over the amplitudes."""
        turned = self.phi[:, None] * self.orders
        sin, cos, k = np.sin(turned), np.cos(turned), self.orders
        sines = (sin, k * cos, -(k**2) * sin, -(k**3) * cos)
        if self.even:
            return sines
        cosines = (1 - cos, k * sin, k**2 * cos, -(k**3) * sin)
        return tuple(np.hstack(pair) for pair in zip(sines, cosines, strict=True))


@dataclass(frozen=True)
class Asked:
    """A function that is asked of a law at places, with its values and slopes."""

    waves: Waves
    function: Pointwise

    @cached_property
    def _columns(self) -> tuple[Array, ...]:
        return self.waves.columns()

    def _at(self, z: Array) -> Point:
        count = self.waves.count
        psi, i, first, second = (column @ z[:count] for column in self._columns)
        given = (psi + self.waves.phi, i + 1, first, second, z[count:])
        return Point(*(one.astype(np.complex128) for one in given))

    def values(self, z: Array) -> Array:
        """F (n,) for unknowns z: amplitudes, then y."""
        return np.asarray(np.real(self.function(self._at(z))))

    def slopes(self, z: Array) -> Array:
        """Derivatives (n, z) of f."""
        here, count = self._at(z), self.waves.count
        found = np.zeros((self.waves.phi.size, z.size))

        def partial(name: str, step: Complex) -> Array:
            moved = replace(here, **{name: getattr(here, name) + 1j * _STEP * step})
            return np.asarray(np.imag(self.function(moved)) / _STEP)

        for name, column in zip(("psi", "i", "first", "second"), self._columns, strict=True):
            found[:, :count] += partial(name, np.ones(1, dtype=np.complex128))[:, None] * column
        for place, unit in enumerate(np.eye(z.size - count, dtype=np.complex128)):
            found[:, count + place] = partial("y", unit)
        return found
