"""The acceleration pole at exact positions: tan(φ/2) rational, the rest over one square root.

An independent way to a point of the locus: numbers u + v √n, no residues and no floating point.
"""

from math import isqrt
from typing import Any, Literal

from flint import fmpq

Plane = Literal["fixed", "coupler"]


class Quadratic:
    """Numbers u + v √n over the rational numbers."""

    __slots__ = ("n", "u", "v")

    def __init__(self, u: fmpq, v: fmpq, n: fmpq) -> None:
        self.u, self.v, self.n = u, v, n

    def __add__(self, other: "Quadratic") -> "Quadratic":
        return Quadratic(self.u + other.u, self.v + other.v, self.n)

    def __sub__(self, other: "Quadratic") -> "Quadratic":
        return Quadratic(self.u - other.u, self.v - other.v, self.n)

    def __mul__(self, other: "Quadratic") -> "Quadratic":
        return Quadratic(
            self.u * other.u + self.v * other.v * self.n, self.u * other.v + self.v * other.u, self.n
        )

    def inverse(self) -> "Quadratic":
        """1 over the number."""
        norm = self.u * self.u - self.v * self.v * self.n
        return Quadratic(self.u / norm, -self.v / norm, self.n)


def exact_poles(lengths: tuple[int, ...], plane: Plane, t: fmpq) -> list[tuple[Quadratic, Quadratic]]:
    """ρ and X of the pole with tan(φ/2) = t: over numbers u + v W, or on both branches if W is rational."""
    a, c, b, f = (fmpq(length) for length in lengths)
    cos = (1 - t * t) / (1 + t * t)
    square = a * a + f * f - 2 * a * f * cos
    k = c * c - b * b + square
    n = 4 * c * c * square - k * k
    root = _rational_root(n)
    if root is None:
        return [_exact_pole(lengths, plane, t, Quadratic(fmpq(0), fmpq(1), n))]
    found = []
    for w in (root, -root):
        number = Quadratic(w, fmpq(0), fmpq(0))
        if not _in_pivot(lengths, t, w):
            found.append(_exact_pole(lengths, plane, t, number))
    return found


def _rational_root(n: fmpq) -> fmpq | None:
    if n < 0:
        return None
    top, bottom = isqrt(int(n.p)), isqrt(int(n.q))
    return fmpq(top, bottom) if top * top == n.p and bottom * bottom == n.q else None


def _in_pivot(lengths: tuple[int, ...], t: fmpq, w: fmpq) -> bool:
    """Whether B is in A0: then W = 2 a f sin φ up to its sign, and crank and coupler lie on each other."""
    a, c, b, f = (fmpq(length) for length in lengths)
    cos, sin = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    dx, dy = f - a * cos, -a * sin
    square = dx * dx + dy * dy
    k = c * c - b * b + square
    x = a * cos + (dx * k - dy * w) / (2 * square)
    y = a * sin + (dy * k + dx * w) / (2 * square)
    return bool(x == 0 and y == 0)


def _exact_pole(lengths: tuple[int, ...], plane: Plane, t: fmpq, w: Quadratic) -> tuple[Quadratic, Quadratic]:
    """ρ and X of the pole with tan(φ/2) = t and this W.

    The formulas are those of :mod:`mechwright_four_bar.kinematics.loop`, real and imaginary parts apart.
    """
    a, c, b, f = (fmpq(length) for length in lengths)
    cos, sin = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    d = (f - a * cos, -a * sin)
    square = d[0] * d[0] + d[1] * d[1]
    k = c * c - b * b + square

    def number(u: fmpq) -> Quadratic:
        return Quadratic(u, fmpq(0), w.n)

    share = 1 / (2 * c * square)
    s = (
        number(d[0] * k * share) - number(d[1] * share) * w,
        number(d[1] * k * share) + number(d[0] * share) * w,
    )
    q = tuple((number(c) * part - number(e)) * number(1 / b) for part, e in zip(s, d, strict=True))
    crank = (number(a * cos), number(a * sin))

    def dot(z: Any, w: Any) -> Quadratic:
        result: Quadratic = z[0] * w[0] + z[1] * w[1]
        return result

    inverse = (s[1] * q[0] - s[0] * q[1]).inverse()
    turned = (crank[1], number(fmpq(0)) - crank[0])
    w1 = number(-1 / c) * inverse * dot(turned, q)
    v1 = number(-1 / b) * inverse * dot(turned, s)
    second = tuple(crank[i] + number(c) * w1 * w1 * s[i] - number(b) * v1 * v1 * q[i] for i in range(2))
    w2 = number(-1 / c) * inverse * dot(second, q)
    real = number(fmpq(0)) - w1 * w1
    scale = (real * real + w2 * w2).inverse()
    # crank / (real + i w2)
    lever = (
        (crank[0] * real + crank[1] * w2) * scale,
        (crank[1] * real - crank[0] * w2) * scale,
    )
    if plane == "coupler":
        x, y = dot(lever, s), lever[1] * s[0] - lever[0] * s[1]
    else:
        x, y = crank[0] + lever[0], crank[1] + lever[1]
    return x * x + y * y, x
