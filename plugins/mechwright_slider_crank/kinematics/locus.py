"""Exact loci of the coupler's acceleration pole, for both assemblies, with a crank at constant speed.

With S = sin φ', C² = 1 - S², t = e - a S, w² = c² - t², V = C² w² and q = C w (slide frame, crank pivot in
the origin, slide along X):

* N = a (a e S² + (c² - a² - e²) S + a e), M = a⁴ C⁴ w² + N², so that ωc⁴ + αc² = M / w⁶;
* ground: ρ M = a² (M + w⁴ (w² - 2 a² C²)), Y M = A + B q, A = a S (M - a² C² w⁴), B = -a N w²;
* coupler: ρ M = a² w⁶, x M = A + B q, A = (a²/c) S² w⁶, B = -(a/c) w² (a² c² C² + a S t w²).

The first equation holds ρ and S alone; the second, squared as (Y M - A)² = B² V, loses the sign of q and with
it the assembly. Their resultant with respect to S is the locus.
"""

from fractions import Fraction
from typing import Literal

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx

from mechwright import GeometryError, kept
from mechwright.mechanics.algebra import PlaneCurve, eliminate, rational

Plane = Literal["fixed", "coupler"]


@kept
def locus(crank: Fraction, rod: Fraction, offset: Fraction, plane: Plane) -> tuple[PlaneCurve, int]:
    """The curve of the acceleration pole on the ground or in the coupler.

    Parameters
    ----------
    crank, rod
        Lengths a and c, above 0.
    offset
        Of the slide line to the left of its direction, e.
    plane
        ``"fixed"``: X along the slide, origin in the crank's pivot; ``"coupler"``: x from A to B, origin
        in A.

    Returns
    -------
    curve, power
        The reduced curve, and how many times the coupler runs through it: twice in the coupler plane where
        e = 0, since the two halves of a turn are mirror images there.

    Raises
    ------
    GeometryError
        A length is not above 0; or c = a and e = 0: the crank can turn while the slider stands still.

    Examples
    --------
    >>> curve, _ = locus(Fraction(1), Fraction(3), Fraction(1, 2), "fixed")
    >>> curve.degree, curve.circularity, len(curve.terms)
    (24, 12, 91)
    """
    if not (crank > 0 and rod > 0):
        raise GeometryError(f"crank {crank} and rod {rod} make no slider-crank: both must be above 0")
    if crank == rod and offset == 0:
        raise GeometryError(
            "the locus is no curve: with c = a and e = 0 the crank can turn with the slider at rest"
        )
    first, second = _equations(crank, rod, offset, plane)
    return eliminate(first, second, "Y" if plane == "fixed" else "x")


def _equations(
    crank: Fraction, rod: Fraction, offset: Fraction, plane: Plane
) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    a, c, e = rational(crank), rational(rod), rational(offset)
    s, rho, along = fmpq_mpoly_ctx.get(("S", "rho", "l"), Ordering.lex).gens()
    cos2, t = 1 - s**2, e - a * s
    w2 = c**2 - t**2
    n = a * (a * e * s**2 + (c**2 - a**2 - e**2) * s + a * e)
    m = a**4 * cos2**2 * w2 + n**2
    if plane == "fixed":
        square = a**2 * (m + w2**2 * (w2 - 2 * a**2 * cos2))
        even, odd = a * s * (m - a**2 * cos2 * w2**2), -a * n * w2
    else:
        square = a**2 * w2**3
        even, odd = (a**2 / c) * s**2 * w2**3, -(a / c) * w2 * (a**2 * c**2 * cos2 + a * s * t * w2)
    return rho * m - square, (along * m - even) ** 2 - odd**2 * cos2 * w2
