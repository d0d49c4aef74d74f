"""A plane curve in sparse form: F = Σ k_ij ρ^i l^j = 0, ρ = x² + y², l the coordinate along its axis."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import Any

import numpy as np
from flint import arb, fmpq, fmpz
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.mechanics.algebra.numbers import exact, fraction, rational

_AXES = {"X": 0, "x": 0, "Y": 1, "y": 1}
"""Name of a coordinate to its place in a point; capitals are the ground's, small letters a body's."""


@dataclass(frozen=True)
class PlaneCurve:
    """An algebraic curve that is its own mirror image about an axis through the origin.

    Parameters
    ----------
    terms
        (i, j) to the coefficient of ρ^i l^j, none of them 0, sorted.
    axis
        The coordinate l: ``"X"`` or ``"Y"`` on the ground, ``"x"`` or ``"y"`` in a body.

    Examples
    --------
    The unit circle goes once through each circular point:

    >>> circle = PlaneCurve.of({(1, 0): 1, (0, 0): -1}, "X")
    >>> circle.degree, circle.circularity, circle.at("3/5", "4/5")
    (2, 1, Fraction(0, 1))
    """

    terms: Mapping[tuple[int, int], Fraction]
    axis: str

    @classmethod
    def of(cls, terms: Mapping[tuple[int, int], Fraction | int], axis: str) -> "PlaneCurve":
        """Sort the terms, drop zeros, and make the coefficient of the highest power of ρ one.

        Where no pure power of ρ is highest, the coefficient of the last term is made one. Raises
        GeometryError where no term is left, or there is no such axis.
        """
        kept = {key: Fraction(value) for key, value in sorted(terms.items()) if value != 0}
        if not kept:
            raise GeometryError("a curve needs a polynomial that is not 0")
        if axis not in _AXES:
            raise GeometryError(f"axis {axis!r} is not known; one of: {', '.join(_AXES)}")
        leading = kept[max(kept)]
        return cls({key: value / leading for key, value in kept.items()}, axis)

    @property
    def degree(self) -> int:
        """Degree in x and y.

        It is the largest 2 i + j: the leading forms (x² + y²)^i l^j of that degree are linearly independent.
        """
        return max(2 * i + j for i, j in self.terms)

    @property
    def circularity(self) -> int:
        """Multiplicity of the circular points.

        At (1 : i : 0), with the line at infinity w = 0 and the distance η from the point along it, a term
        becomes η^i w^(degree - 2 i - j) to first order: it vanishes to the order degree - i - j, and terms of
        the same order are independent. So the multiplicity is the degree less the largest i + j.
        """
        return self.degree - max(i + j for i, j in self.terms)

    def at(self, x: float | str | Fraction, y: float | str | Fraction) -> Fraction:
        """The exact value at an exact point; a float stands for the decimal it is written as."""
        rho, along = self._sparse(rational(exact(x)), rational(exact(y)))
        return fraction(self._horner(rho, along))

    def values(self, points: ArrayLike) -> Array:
        """Values (...) at floating-point points (..., 2), each exact for that point and rounded once.

        The points themselves are rounded: near a multiple point that alone changes the value by far more than
        its size. :meth:`ratio` judges points of more digits.
        """
        points = np.asarray(points, dtype=float)
        flat = points.reshape(-1, 2)
        found = [
            float(fraction(self._horner(*self._sparse(_binary(x), _binary(y))))) for x, y in flat.tolist()
        ]
        return np.array(found, dtype=float).reshape(points.shape[:-1])

    def ratio(self, x: arb, y: arb) -> float:
        """Upper bound of the value's size over the sum of the sizes of its terms, at a point of many digits.

        Call it inside ``flint.ctx.workdps(digits)`` with coordinates made there. A point on the curve gives
        about 10^-digits, any other about 1: the bound is certified, rounding included.
        """
        rho, along = self._sparse(x, y)
        value, size = arb(0), arb(0)
        for (i, j), coefficient in self.terms.items():
            term = arb(rational(coefficient)) * rho**i * along**j
            value += term
            size += abs(term)
        return float((abs(value) / size).abs_upper())

    def _sparse(self, x: Any, y: Any) -> tuple[Any, Any]:
        return x * x + y * y, (x, y)[_AXES[self.axis]]

    @cached_property
    def _rows(self) -> tuple[tuple[fmpz, ...], ...]:
        """Integer coefficients by powers of ρ, then of l, highest first, over :attr:`_denominator`."""
        highest, widest = max(i for i, _ in self.terms), max(j for _, j in self.terms)
        return tuple(
            tuple(fmpz(int(self.terms.get((i, j), 0) * self._denominator)) for j in range(widest, -1, -1))
            for i in range(highest, -1, -1)
        )

    @cached_property
    def _denominator(self) -> int:
        return lcm(*(value.denominator for value in self.terms.values()))

    def _horner(self, rho: fmpq, along: fmpq) -> fmpq:
        value = fmpq(0)
        for row in self._rows:
            inner = fmpq(0)
            for coefficient in row:
                inner = inner * along + coefficient
            value = value * rho + inner
        return value / self._denominator

    def table(self) -> str:
        """The terms as text, one line each: power of ρ, power of l, coefficient.

        >>> print(PlaneCurve.of({(1, 0): 2, (0, 1): -1}, "Y").table())
        rho^i Y^j, degree 2, 1-fold circular points, 2 terms
          i   j  coefficient
          0   1  -1/2
          1   0  1
        """
        head = (
            f"rho^i {self.axis}^j, degree {self.degree}, {self.circularity}-fold circular points, "
            f"{len(self.terms)} terms"
        )
        rows = (f"{i:3d} {j:3d}  {value}" for (i, j), value in self.terms.items())
        return "\n".join((head, "  i   j  coefficient", *rows))

    def to_json(self) -> str:
        """The curve as JSON; coefficients are texts, since no number of JSON holds them.

        >>> PlaneCurve.from_json(PlaneCurve.of({(1, 0): 3, (0, 0): -1}, "x").to_json()).terms[0, 0]
        Fraction(-1, 3)
        """
        rows = [[i, j, str(value)] for (i, j), value in self.terms.items()]
        facts = {
            "polynomial": f"sum of k (x^2 + y^2)^i {self.axis}^j over the terms [i, j, k]",
            "axis": self.axis,
            "degree": self.degree,
            "circularity": self.circularity,
        }
        lines = ",\n".join(f"    {json.dumps(row)}" for row in rows)
        body = "".join(f"  {json.dumps(key)}: {json.dumps(value)},\n" for key, value in facts.items())
        return f'{{\n{body}  "terms": [\n{lines}\n  ]\n}}\n'

    @classmethod
    def from_json(cls, text: str) -> "PlaneCurve":
        """Read what :meth:`to_json` wrote; raises GeometryError if it is something else."""
        try:
            data = json.loads(text)
            rows: Sequence[Sequence[Any]] = data["terms"]
            return cls.of({(int(i), int(j)): Fraction(value) for i, j, value in rows}, str(data["axis"]))
        except (ValueError, KeyError, TypeError) as error:
            raise GeometryError(f"this is no curve of ours: {error}") from error


def _binary(number: float) -> fmpq:
    """A floating-point number without any rounding."""
    return fmpq(*number.as_integer_ratio())
