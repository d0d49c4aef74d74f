"""ψ = (N1/N2) φ + Σ A_j sin(j N1 φ) + B_j (1 - cos(j N1 φ)): the law as a sum of harmonics."""

from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.gearing import RatioLaw


@dataclass(frozen=True)
class FourierLaw(RatioLaw):
    """Harmonics of a lobe: amplitudes A_j of the sines and B_j of the cosines, rad."""

    lobes: tuple[int, int]
    sines: tuple[float, ...]
    cosines: tuple[float, ...] = ()

    def _terms(self, phi: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Angles j N1 φ (..., k), orders (k,), and both amplitudes (k,)."""
        count = max(len(self.sines), len(self.cosines), 1)
        orders = self.lobes[0] * np.arange(1.0, count + 1)
        sines, cosines = np.zeros(count), np.zeros(count)
        sines[: len(self.sines)], cosines[: len(self.cosines)] = self.sines, self.cosines
        turned = np.asarray(phi, dtype=float)[..., None] * orders
        return np.sin(turned), np.cos(turned), orders, sines, cosines

    def angle(self, phi: Array) -> Array:
        """The sum itself."""
        sin, cos, _, a, b = self._terms(phi)
        mean = self.lobes[0] / self.lobes[1]
        result: Array = mean * np.asarray(phi, dtype=float) + sin @ a + (1 - cos) @ b
        return result

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Its derivatives."""
        sin, cos, k, a, b = self._terms(phi)
        mean = self.lobes[0] / self.lobes[1]
        return (
            mean + cos @ (k * a) + sin @ (k * b),
            cos @ (k**2 * b) - sin @ (k**2 * a),
            -(cos @ (k**3 * a)) - sin @ (k**3 * b),
        )
