"""Elimination of the position of a mechanism from the equations of a locus."""

from fractions import Fraction
from functools import reduce
from itertools import count

from flint import fmpq, fmpq_mat, fmpq_mpoly, fmpq_poly

from mechwright.errors import GeometryError
from mechwright.mechanics.algebra.curve import PlaneCurve
from mechwright.mechanics.algebra.numbers import fraction

_ByPowers = dict[tuple[int, int], fmpq_poly]
"""A polynomial of three variables: powers of the second and third to a polynomial in the first."""


def eliminate(first: fmpq_mpoly, second: fmpq_mpoly, axis: str) -> tuple[PlaneCurve, int]:
    """Eliminate the first of three variables; the others are ρ and the coordinate along ``axis``.

    Factors that hold the eliminated variable alone are divided out before: at their roots both equations
    hold for every point, and the resultant would vanish. The resultant of equations that are met twice in
    every point of the curve is a square; its root is the curve.

    Parameters
    ----------
    first, second
        Polynomials in one context of three variables: position, ρ, coordinate.
    axis
        Name of the coordinate along the axis of symmetry (``"Y"``).

    Returns
    -------
    curve
        The reduced curve, with the coefficient of the highest power of ρ made 1.
    power
        How many times the elimination found it.

    Raises
    ------
    GeometryError
        The resultant vanishes, or is no power of one square-free polynomial: the mechanism is degenerate.
    """
    eliminant = _resultant(_by_powers(first), _by_powers(second), first)
    if eliminant.is_zero():
        raise GeometryError("the locus is no curve: the two equations have a factor in common")
    _, factors = eliminant.factor_squarefree()
    powers = {int(power) for _, power in factors}
    if len(powers) != 1:
        raise GeometryError("the locus falls into parts that are run through unequally often")
    base = reduce(lambda one, two: one * two, (factor for factor, _ in factors))
    terms: dict[tuple[int, int], Fraction] = {}
    for exponents, coefficient in base.to_dict().items():
        _, i, j = (int(exponent) for exponent in exponents)
        terms[i, j] = fraction(coefficient)
    return PlaneCurve.of(terms, axis), powers.pop()


def _by_powers(polynomial: fmpq_mpoly) -> _ByPowers:
    """The polynomial, without the factor that depends on its first variable alone."""
    coefficients: dict[tuple[int, int], dict[int, fmpq]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        k, i, j = (int(exponent) for exponent in exponents)
        coefficients.setdefault((i, j), {})[k] = coefficient
    found = {
        key: fmpq_poly([row.get(k, fmpq(0)) for k in range(max(row) + 1)])
        for key, row in coefficients.items()
    }
    content = reduce(lambda one, two: one.gcd(two), found.values(), fmpq_poly())
    return {key: row // content for key, row in found.items()}


def _resultant(first: _ByPowers, second: _ByPowers, like: fmpq_mpoly) -> fmpq_mpoly:
    """The resultant with respect to the first variable, interpolated from resultants of numbers.

    With the 17 digits of a measured length that takes a seventh of the time of flint's own, which computes
    with polynomials throughout.
    """
    one, two = _degree(first), _degree(second)
    rows, columns = (_highest(first, v) * two + _highest(second, v) * one for v in (0, 1))
    # Where a leading coefficient vanishes the resultant of numbers is another one: go on to the next place.
    # An algebraic curve cannot follow the powers of 2, so that the search ends.
    for start in count(1):
        rhos = [fmpq(start + number) for number in range(rows + 1)]
        alongs = [fmpq(2**start + number) for number in range(columns + 1)]
        grid = [[(_at(first, x, y), _at(second, x, y)) for y in alongs] for x in rhos]
        if all(f.degree() == one and g.degree() == two for line in grid for f, g in line):
            break
    values = fmpq_mat([[f.resultant(g) for f, g in line] for line in grid])
    table = _powers(rhos).inv() * values * _powers(alongs).inv().transpose()
    context = like.context()
    return context.from_dict(
        {(0, i, j): table[i, j] for i in range(rows + 1) for j in range(columns + 1) if table[i, j] != 0}
    )


def _degree(polynomial: _ByPowers) -> int:
    return max(int(row.degree()) for row in polynomial.values())


def _highest(polynomial: _ByPowers, variable: int) -> int:
    return max(key[variable] for key in polynomial)


def _at(polynomial: _ByPowers, x: fmpq, y: fmpq) -> fmpq_poly:
    total = fmpq_poly()
    for (i, j), row in polynomial.items():
        total += row * (x**i * y**j)
    return total


def _powers(nodes: list[fmpq]) -> fmpq_mat:
    """The matrix that turns coefficients into values at the nodes."""
    return fmpq_mat([[node**power for power in range(len(nodes))] for node in nodes])
