"""A law in closed form: the ratio or the angle of the driven gear as a formula of φ."""

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright import Array
from mechwright.mechanics.formula import Formula
from mechwright.mechanics.gearing import RatioLaw
from mechwright.mechanics.gearing.primitive import Primitive


@dataclass(frozen=True)
class WrittenLaw(RatioLaw):
    """A law of which a formula of phi, ``text``, says something."""

    lobes: tuple[int, int]
    text: str

    @cached_property
    def _formula(self) -> Formula:
        return Formula(self.text, "phi")

    @abstractmethod
    def shape(self, phi: Array) -> tuple[Array, Array, Array]:
        """The ratio and its first two derivatives as written, at φ (...) of the first lobe."""


class RatioFormula(WrittenLaw):
    """I = c f(φ): only the shape of ``text`` counts, since c closes the turn, ∫ i dφ = 2π/N2 over a lobe."""

    @cached_property
    def factor(self) -> float:
        """c, by which the formula is multiplied."""
        total = Primitive.of(lambda phi: self._formula(phi)[0], self.period).total
        return 2 * np.pi / self.lobes[1] / total

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Derivatives of the formula, exact."""
        i, first, second, _ = self._formula(np.mod(np.asarray(phi, dtype=float), self.period))
        return self.factor * i, self.factor * first, self.factor * second

    def shape(self, phi: Array) -> tuple[Array, Array, Array]:
        """The ratio and its derivatives as written, before they are multiplied."""
        return self._formula(phi)[:3]


class AngleFormula(WrittenLaw):
    """Ψ = f(φ) - f(0); over a lobe it has to grow by 2π/N2."""

    @cached_property
    def _begin(self) -> float:
        return float(self._formula(np.array(0.0))[0])

    def angle(self, phi: Array) -> Array:
        """The formula itself, lobe after lobe."""
        lobe, within = np.divmod(np.asarray(phi, dtype=float), self.period)
        result: Array = self._formula(within)[0] - self._begin + lobe * (2 * np.pi / self.lobes[1])
        return result

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Derivatives of the formula, exact."""
        _, i, first, second = self._formula(np.mod(np.asarray(phi, dtype=float), self.period))
        return i, first, second

    @property
    def turned(self) -> float:
        """What the driven gear turns over a lobe of the driver, rad."""
        return float(self._formula(np.array(self.period))[0]) - self._begin

    def shape(self, phi: Array) -> tuple[Array, Array, Array]:
        """The ratio and its derivatives as written."""
        return self._formula(phi)[1:]
