"""A law through given pairs of angles: a periodic spline of degree five."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from mechwright import Array
from mechwright.mechanics.gearing import RatioLaw


@dataclass(frozen=True)
class TableLaw(RatioLaw):
    """ψ through ``nodes``, pairs (φ, ψ), rad, of one lobe, the first at (0, 0).

    The spline goes through what ψ has beyond its mean, with knots at the nodes: four derivatives are
    continuous, so that the curvature of the pitch curves has no jump.
    """

    lobes: tuple[int, int]
    nodes: tuple[tuple[float, float], ...]

    @cached_property
    def _spline(self) -> BSpline:
        phi, psi = np.array(self.nodes).T
        beyond = psi - self.lobes[0] / self.lobes[1] * phi
        return make_interp_spline(
            np.append(phi, self.period), np.append(beyond, beyond[0]), k=5, bc_type="periodic"
        )

    @property
    def breaks(self) -> tuple[float, ...]:
        """The nodes."""
        return tuple(phi for phi, _ in self.nodes[1:])

    def _at(self, phi: Array, order: int) -> Array:
        values: Array = self._spline(np.mod(np.asarray(phi, dtype=float), self.period), nu=order)
        return values

    def angle(self, phi: Array) -> Array:
        """Mean and spline."""
        result: Array = self.lobes[0] / self.lobes[1] * np.asarray(phi, dtype=float) + self._at(phi, 0)
        return result

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Derivatives of the spline."""
        return self.lobes[0] / self.lobes[1] + self._at(phi, 1), self._at(phi, 2), self._at(phi, 3)
