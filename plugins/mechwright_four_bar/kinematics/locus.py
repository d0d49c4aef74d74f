"""The exact locus of the coupler's acceleration pole, for both branches and a crank at constant speed.

The mirror image of the linkage about the ground line turns the other way and is on the other branch; its pole
is the mirror image too. So the locus is symmetric, and is a polynomial F in ρ and X (ρ and x in the coupler).

How it is found. Modulo a prime p, positions of the linkage are points over the field of p elements: with
tan(φ/2) = t any residue, sin φ and cos φ are residues, and so is W for every other t. The pole follows by the
formulas of the plane, with i as a symbol. F is the polynomial of least degree D in ρ and X, counting both
alike, that vanishes at more such points than it has coefficients: one null vector of a matrix over the field.
The null vectors of many primes are put together by the Chinese remainder theorem, and their fractions follow
by rational reconstruction, and hold when the null vector of one more prime is theirs.

Nothing here depends on the dimensions: degree and circular points of the special cases (equal links, kites,
links that line up) come out by themselves.
"""

from collections.abc import Iterator
from fractions import Fraction
from math import isqrt, lcm
from typing import Any, Literal

import numpy as np
from flint import fmpz, nmod_mat
from numpy.typing import NDArray

from mechwright import GeometryError, kept
from mechwright.mechanics.algebra import PlaneCurve

Plane = Literal["fixed", "coupler"]
Residues = NDArray[np.int64]

HIGHEST = 15
"""Degree in ρ and X of the generic curve; no special one has more."""

SPARE = 12
"""Points beyond the number of coefficients: a chance vector would have to vanish at all of them."""

FIRST_PRIME = 2**31 - 1
"""Primes go downwards from here; products of two residues fit 64 bits."""

MOST_PRIMES = 1000
"""Primes after which the search ends: coefficients of 15,000 bits, from lengths of some 25 digits."""


@kept
def locus(
    crank: Fraction, coupler: Fraction, follower: Fraction, ground: Fraction, plane: Plane
) -> PlaneCurve:
    """The curve of the acceleration pole on the ground or in the coupler.

    Parameters
    ----------
    crank, coupler, follower, ground
        Lengths a, c, b and f, above 0.
    plane
        ``"fixed"``: X from A0 to B0, origin in A0; ``"coupler"``: x from A to B, origin in A.

    Raises
    ------
    GeometryError
        The links cannot be joined; or the linkage is a parallelogram, whose coupler has no acceleration pole
        on one of its branches.

    Examples
    --------
    >>> curve = locus(Fraction(3), Fraction(6), Fraction(5), Fraction(8), "fixed")
    >>> curve.degree, curve.circularity
    (18, 9)
    """
    lengths = (crank, coupler, follower, ground)
    if min(lengths) <= 0 or 2 * max(lengths) > sum(lengths):
        raise GeometryError(
            f"the locus is no curve: links of {', '.join(map(str, lengths))} cannot be joined to a loop"
        )
    if crank == follower and coupler == ground:
        raise GeometryError(
            "the locus is no curve: a parallelogram's coupler does not turn, and has no acceleration pole"
        )
    # In whole numbers the coefficients are shortest; the curve is scaled back at the end.
    unit = lcm(*(length.denominator for length in lengths))
    whole = tuple(int(length * unit) for length in lengths)
    terms = _reconstructed(whole, plane)
    scaled = {(i, j): value * Fraction(unit) ** (2 * i + j) for (i, j), value in terms.items()}
    return PlaneCurve.of(scaled, "X" if plane == "fixed" else "x")


def _reconstructed(lengths: tuple[int, ...], plane: Plane) -> dict[tuple[int, int], Fraction]:
    degree: int | None = None
    modulus, found, wanted = 1, [], 4
    count = 0
    keys: list[tuple[int, int]] = []
    fractions: list[Fraction | None] = [None]
    for prime in _primes():
        if any(length % prime == 0 for length in lengths):
            continue
        if degree is None:
            degree = _least_degree(lengths, plane, prime)
            keys = _monomials(degree)
            found = [0] * len(keys)
        vector = _null_vector(lengths, plane, prime, degree)
        if vector is None:
            continue
        if all(
            value is not None and (value.numerator - residue * value.denominator) % prime == 0
            for value, residue in zip(fractions, vector, strict=False)
        ):
            return {key: value for key, value in zip(keys, fractions, strict=True) if value}
        inverse = pow(modulus, -1, prime)
        found = [
            old + modulus * ((new - old) * inverse % prime) for old, new in zip(found, vector, strict=True)
        ]
        modulus *= prime
        count += 1
        if count > MOST_PRIMES:
            break
        fractions = [None]
        if count >= wanted:
            wanted = count + max(2, count // 4)
            fractions = [_fraction(value, modulus) for value in found]
    raise GeometryError(
        "the locus is no single curve, or its lengths have too many digits; round them to fewer"
    )


def _primes() -> Iterator[int]:
    """Primes p = 3 (mod 4), downwards: there -1 is no square, so that i is a symbol of its own."""
    candidate = FIRST_PRIME
    while True:
        if candidate % 4 == 3 and fmpz(candidate).is_prime():
            yield candidate
        candidate -= 2


def _monomials(degree: int) -> list[tuple[int, int]]:
    """Powers (i, j) of ρ and X with i + j up to ``degree``, in the order of the columns."""
    return [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]


def _least_degree(lengths: tuple[int, ...], plane: Plane, prime: int) -> int:
    """Least D for which a polynomial vanishes on all positions; a multiple of it does for every larger D."""
    low, high = 0, HIGHEST
    while high - low > 1:
        middle = (low + high) // 2
        if _kernel(lengths, plane, prime, middle)[1] > 0:
            high = middle
        else:
            low = middle
    return high


def _null_vector(lengths: tuple[int, ...], plane: Plane, prime: int, degree: int) -> list[int] | None:
    """Coefficients modulo the prime, the last of them that is not 0 made one; None for an unlucky prime."""
    basis, nullity = _kernel(lengths, plane, prime, degree)
    if nullity != 1:
        return None
    values = [int(basis[row, 0]) for row in range(basis.nrows())]
    last = next(value for value in reversed(values) if value)
    scale = pow(last, -1, prime)
    return [value * scale % prime for value in values]


def _kernel(lengths: tuple[int, ...], plane: Plane, prime: int, degree: int) -> tuple[Any, int]:
    """Null space of the monomials' values at many positions."""
    keys = _monomials(degree)
    rho, along = _positions(lengths, plane, prime, len(keys) + SPARE)
    powers_rho, powers_along = _powers(rho, degree, prime), _powers(along, degree, prime)
    rows = np.stack([powers_rho[i] * powers_along[j] % prime for i, j in keys], axis=1)
    matrix = nmod_mat(len(rho), len(keys), rows.ravel().tolist(), prime)
    basis, nullity = matrix.nullspace()
    return basis, int(nullity)


def _powers(values: Residues, degree: int, prime: int) -> list[Residues]:
    powers = [np.ones_like(values)]
    for _ in range(degree):
        powers.append(powers[-1] * values % prime)
    return powers


class _Field:
    """Residues modulo a prime, and pairs of them as plane numbers, in arrays."""

    def __init__(self, prime: int) -> None:
        self.p = prime

    def power(self, base: Residues, exponent: int) -> Residues:
        result, square = np.ones_like(base), base % self.p
        while exponent:
            if exponent & 1:
                result = result * square % self.p
            square = square * square % self.p
            exponent >>= 1
        return result

    def inverse(self, value: Residues) -> Residues:
        return self.power(value, self.p - 2)

    def root(self, value: Residues) -> Residues:
        """A square root where there is one."""
        return self.power(value, (self.p + 1) // 4)

    def times(self, z: tuple[Residues, Residues], w: tuple[Residues, Residues]) -> tuple[Residues, Residues]:
        real = (z[0] * w[0] % self.p - z[1] * w[1] % self.p) % self.p
        return real, (z[0] * w[1] % self.p + z[1] * w[0] % self.p) % self.p


def _positions(lengths: tuple[int, ...], plane: Plane, prime: int, count: int) -> tuple[Residues, Residues]:
    """ρ and X (count,) of the pole at positions over the field; see the module."""
    field = _Field(prime)
    p = prime
    a, c, b, f = (np.int64(length % p) for length in lengths)
    # Half of the t give a W in the field, and some are singular.
    t = np.arange(2, 2 + 3 * count + 40, dtype=np.int64)
    unit = field.inverse((1 + t * t) % p)
    cos, sin = (1 - t * t % p) * unit % p, 2 * t * unit % p
    ax, ay = a * cos % p, a * sin % p
    dx, dy = (f - ax) % p, (-ay) % p
    square = (dx * dx % p + dy * dy % p) % p
    k = (c * c % p - b * b % p + square) % p
    room = (4 * (c * c % p) % p * square % p - k * k % p) % p
    w = field.root(room)
    share = field.inverse(2 * c % p * square % p)
    s = field.times((dx, dy), (k * share % p, w * share % p))
    inverse_b = field.inverse(np.asarray([b]))
    q = ((c * s[0] - dx) % p * inverse_b % p, (c * s[1] - dy) % p * inverse_b % p)
    conj_q, conj_s = (q[0], -q[1] % p), (s[0], -s[1] % p)
    sine = field.times(s, conj_q)[1]
    lever_c, lever_b = (-field.inverse(x * sine % p) % p for x in (c, b))
    crank = (ax, ay)
    first = (ay, -ax % p)  # -i a exp(iφ)
    w1 = lever_c * field.times(first, conj_q)[0] % p
    v1 = lever_b * field.times(first, conj_s)[0] % p
    cw, bv = c * (w1 * w1 % p) % p, b * (v1 * v1 % p) % p
    second = (
        (ax + cw * s[0] % p - bv * q[0] % p) % p,
        (ay + cw * s[1] % p - bv * q[1] % p) % p,
    )
    w2 = lever_c * field.times(second, conj_q)[0] % p
    # 1 / (i α - w²) is (-w² - i α) over its square.
    real, imaginary = -(w1 * w1) % p, w2
    norm = (real * real % p + imaginary * imaginary % p) % p
    scale = field.inverse(norm)
    lever = field.times(crank, (real * scale % p, -imaginary * scale % p % p))
    point = field.times(lever, conj_s) if plane == "coupler" else ((ax + lever[0]) % p, (ay + lever[1]) % p)
    good = (w * w % p == room) & (room != 0) & (square != 0) & (sine != 0) & (norm != 0)
    good &= (1 + t * t) % p != 0
    # Where B is in A0 all along, crank and coupler turn as one: no part of the locus (a = c, b = f).
    good &= ((ax + c * s[0]) % p != 0) | ((ay + c * s[1]) % p != 0)
    x, y = point[0][good][:count], point[1][good][:count]
    if x.size < count:
        raise AssertionError("half of the residues are squares")  # pragma: no cover
    return (x * x % p + y * y % p) % p, x


def _fraction(value: int, modulus: int) -> Fraction | None:
    """The fraction n/d = value (mod modulus) with the least n and d (Wang 1981); None where there is none."""
    bound = isqrt(modulus // 2)
    before, now = (modulus, 0), (value % modulus, 1)
    while now[0] > bound:
        quotient = before[0] // now[0]
        before, now = now, (before[0] - quotient * now[0], before[1] - quotient * now[1])
    if now[1] == 0 or abs(now[1]) > bound:
        return None
    return Fraction(now[0], now[1])
