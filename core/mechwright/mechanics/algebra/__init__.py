"""Exact polynomials of plane curves: elimination, sparse form, exact and certified evaluation.

Glossary
--------
locus
    The path of a point of a mechanism over all positions and both ways to assemble it: an algebraic curve.
sparse form
    A curve that is its own mirror image about an axis through the origin is a polynomial in
    ρ = x² + y² and the coordinate along that axis; that has far fewer terms than x and y.
circular points
    The two points (1 : ±i : 0) at infinity that every circle goes through.

Floating-point numbers are of no use for these curves near their multiple points: in the coupler plane of a
slider-crank, A and B are twelve-fold points, and there the value of the polynomial is smaller than the
rounding of its terms. So coefficients are fractions, and points are evaluated exactly or with a bound.
"""

from mechwright.mechanics.algebra.curve import PlaneCurve
from mechwright.mechanics.algebra.eliminate import eliminate
from mechwright.mechanics.algebra.numbers import exact, rational

__all__ = ["PlaneCurve", "eliminate", "exact", "rational"]
