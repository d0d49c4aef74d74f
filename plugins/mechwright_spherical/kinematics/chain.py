"""The closed form at the heart of every spherical linkage with one loop.

Two pins A and B move as they are driven. The third pin C keeps its arcs to both::

    C.A = ca,   C.B = cb,   |C| = 1

In the orthonormal frame u along A + B, v along A - B, w = u x v these are (ca + cb)/|A + B| and (ca - cb)/|A
- B| and a square root. Against the usual combination of A, B and A x B this loses no digits when A and B are
close, as they are for long projection lengths. Rates come from differentiating the three conditions: one
matrix with the rows A, B, C serves all orders, and its inverse is three vector products.
"""

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright_spherical.kinematics.jets import Jet, combination, product, total
from mechwright_spherical.kinematics.vectors import cross, dot, norm

EDGE = 1e-12
"""A radicand above minus this is a stretched-out linkage (0), not one that cannot be assembled: rounding."""


def third_pin(a: Jet, b: Jet, ca: ArrayLike, cb: ArrayLike, side: ArrayLike) -> Jet:
    """The jet of pin C, seen from the jets of A and B.

    Parameters
    ----------
    a, b
        Jets of the driven pins, vectors (3, ...), all of one order.
    ca, cb
        Cosines of the arcs A to C and B to C, (...).
    side
        +1 where C lies to the left of the arc from A to B seen from outside, that is C.(A x B) > 0; else -1.

    Returns
    -------
    c
        NaN where the linkage cannot be assembled. Where A, B and C lie on one great circle the rates are
        infinite or NaN: the linkage is in a dead centre.
    """
    position = third_position(a[0], b[0], np.asarray(ca), np.asarray(cb), np.asarray(side))
    if len(a) == 1:
        return (position,)
    with np.errstate(divide="ignore", invalid="ignore"):
        return _rates(a, b, position)


def third_position(a: Array, b: Array, ca: Array, cb: Array, side: Array) -> Array:
    """Pin C (3, ...), NaN where it cannot be."""
    total, gap = a + b, a - b
    p, q = norm(total), norm(gap)
    with np.errstate(divide="ignore", invalid="ignore"):
        along, across = (ca + cb) / p, (ca - cb) / q
        rest = 1 - along**2 - across**2
        # A x B = -p q/2 u x v: the side changes its sign.
        height = -side * np.sqrt(np.where(rest > 0, rest, np.where(rest > -EDGE, 0.0, np.nan)))
        u, v = total / p, gap / q
    found: Array = along * u + across * v + height * cross(u, v)
    return found


def radicand(a: Array, b: Array, ca: ArrayLike, cb: ArrayLike) -> Array:
    """Square of C's height over the plane of A and B, (...): below 0 the linkage cannot be assembled.

    It is 1 where the link to C stands square to both, 0 in a dead centre.
    """
    ca, cb = np.asarray(ca), np.asarray(cb)
    total, gap = a + b, a - b
    with np.errstate(divide="ignore", invalid="ignore"):
        found = 1 - (ca + cb) ** 2 / dot(total, total) - (ca - cb) ** 2 / dot(gap, gap)
    return np.asarray(np.where(np.isfinite(found), found, -np.inf))


def _rates(a: Jet, b: Jet, position: Array) -> Jet:
    c = [position]
    dual = (cross(b[0], position), cross(position, a[0]), cross(a[0], b[0]))
    inverse = 1 / dot(position, dual[2])
    for n in range(1, len(a)):
        # The n-th derivatives of C.A, C.B and C.C / 2 vanish; everything but C's own n-th rate is known.
        on_a, on_b = dot(position, a[n]), dot(position, b[n])
        on_c = np.zeros_like(inverse)
        if n == 2:
            on_a, on_b = on_a + 2 * dot(c[1], a[1]), on_b + 2 * dot(c[1], b[1])
            on_c = dot(c[1], c[1])
        elif n == 3:
            on_a = on_a + 3 * (dot(c[1], a[2]) + dot(c[2], a[1]))
            on_b = on_b + 3 * (dot(c[1], b[2]) + dot(c[2], b[1]))
            on_c = 3 * dot(c[1], c[2])
        c.append(-inverse * (on_a * dual[0] + on_b * dual[1] + on_c * dual[2]))
    return tuple(c)


def coordinates(a: Array, c: Array, p: Array) -> tuple[Array, Array, Array]:
    """Factors (...) of A, C and A x C that make up a point of the body that carries A and C.

    By way of the orthonormal frame A, M x A, M: the direct formulae lose the square of the digits when A and
    C are close.
    """
    m = cross(a, c)
    sine = norm(m)
    across = dot(p, cross(m, a)) / sine**2
    return dot(p, a) - across * dot(a, c), across, dot(p, m) / sine**2


def body_point(a: Jet, c: Jet, factors: tuple[Array | float, Array | float, Array | float]) -> Jet:
    """The jet of a point of the body that carries A and C, from its constant ``coordinates``."""
    return combination([(factors[0], a), (factors[1], c), (factors[2], product(a, c))])


def frame(a: Jet, c: Jet) -> tuple[Jet, Jet, Jet]:
    """Orthonormal vectors A, M x A, M with M = A x C / |A x C| of a body that carries A and C, as jets."""
    k = dot(a[0], c[0])
    sine = norm(cross(a[0], c[0]))
    third = combination([(1 / sine, product(a, c))])
    second = combination([(1 / sine, c), (-k / sine, a)])
    return a, second, third


def orientation(a: Array, c: Array) -> Array:
    """The frame as matrices (3, 3, ...), its vectors the columns."""
    return np.stack([vectors[0] for vectors in frame((a,), (c,))], axis=1)


def spin(axes: tuple[Jet, Jet, Jet]) -> Jet:
    """Angular velocity, acceleration, jerk (3, ...) of a body, from the jets of its frame.

    ω = ½ Σ e x e', and its rates by differentiating that.
    """
    order = len(axes[0]) - 1
    found = []
    if order > 0:
        found.append(0.5 * total([cross(e[0], e[1]) for e in axes]))
    if order > 1:
        found.append(0.5 * total([cross(e[0], e[2]) for e in axes]))
    if order > 2:
        found.append(0.5 * total([cross(e[1], e[2]) + cross(e[0], e[3]) for e in axes]))
    return tuple(found)
