"""Nine points in ball arithmetic: certificates, and paths of which doubles lose sight.

Every number is a ball, a midpoint with a radius that holds the true value (Arb); the equations are those of
:mod:`mechwright_four_bar.nine.equations`, run on balls.

A box about a solution is certified by Krawczyk's operator: where

    K = z - Y F(z) + (1 - Y J(X)) (X - z)

lies inside of the box X and the second term contracts, X holds one solution, one alone, and K holds it too.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, ctx
from numpy.typing import NDArray

from mechwright.mechanics.planar import Plane
from mechwright_four_bar.nine import equations
from mechwright_four_bar.nine.triples import fingerprints

BITS = 160
"""Working precision: some 48 digits. A solution 1e5 sizes away takes half of them."""

BOX = 1e-22
"""Half the side of a box, as a share of an unknown or of 1."""

SETTLED = 1e-32
"""Last step of Newton before a certificate, in the same measure."""

STEPS = 12
"""Most steps of Newton before one."""

PREDICTED = 1e-3
"""Error of a prediction that is good, as a share of each unknown or of 1."""

SHORTEST, LONGEST = 1e-10, 0.05
"""Steps of a path, as shares of the way."""

MOST_STEPS = 1500
"""Steps of a path, tried ones included: some seconds."""

Balls = NDArray[np.object_]

_evaluate: Any = getattr(equations.evaluate, "py_func", equations.evaluate)


@dataclass(frozen=True)
class Certified:
    """A solution that is proven.

    Parameters
    ----------
    box
        (8,) balls that hold it, and no other solution.
    real
        Whether it is a real four-bar: every barred unknown is the conjugate. None where that is not decided.
    """

    box: Balls
    real: bool | None

    @property
    def z(self) -> Plane:
        """(8,) the solution, rounded."""
        return np.array([complex(one) for one in self.box])

    @property
    def fingerprint(self) -> Balls:
        """(6,) balls for the fingerprint of its triple."""
        with ctx.workprec(BITS):
            answer: Balls = fingerprints(self.box[None])[0]
        return answer


def points_of(texts: Sequence[tuple[str, str]], size: float) -> Balls:
    """(2, n - 1) balls for δ and δ̄ over ``size`` of points whose coordinates are decimal numbers."""
    with ctx.workprec(BITS):
        places = [acb(arb(x), arb(y)) for x, y in texts]
        deltas = [(place - places[0]) / size for place in places[1:]]
        return np.array([deltas, [one.conjugate() for one in deltas]], dtype=object)


def balls(numbers: Plane | Balls) -> Balls:
    """Doubles of any shape as exact balls; balls as they are."""
    flat = [one if isinstance(one, acb) else acb(one.real, one.imag) for one in numbers.ravel().tolist()]
    return np.array(flat, dtype=object).reshape(numbers.shape)


def _middle(values: Iterable[acb]) -> Balls:
    return np.array([one.mid() for one in values], dtype=object)


def _at(z: Balls, points: Balls, way: Balls) -> tuple[Balls, acb_mat, Balls]:
    """Values (8,), slopes, and rate (8,) along the way of the points."""
    values, along = np.empty(8, object), np.empty(8, object)
    slopes = np.empty((8, 8), object)
    _evaluate(z, points, way, values, slopes, along)
    return values, acb_mat(8, 8, slopes.ravel().tolist()), along


def _column(values: Balls) -> acb_mat:
    return acb_mat(8, 1, values.tolist())


def _size(step: Balls, z: Balls) -> float:
    shares = [float(abs(complex(a)) / max(1.0, abs(complex(b)))) for a, b in zip(step, z, strict=True)]
    return max(shares) if all(math.isfinite(share) for share in shares) else math.inf


def _newton(z: Balls, points: Balls) -> tuple[Balls, float]:
    """The next approximation and the size of the step, infinite where there is none."""
    values, slopes, _ = _at(z, points, points)
    try:
        step = np.array(slopes.solve(_column(values)).entries(), dtype=object)
    except ZeroDivisionError:
        return z, math.inf
    return _middle(z - step), _size(step, z)


def certificate(z: Plane | Balls, points: Balls) -> Certified | None:
    """The solution near ``z`` (8,) at points (2, 8), proven; None where that cannot be done."""
    with ctx.workprec(BITS):
        here = balls(z)
        middle = np.array([[one.mid() for one in row] for row in points], dtype=object)
        for _ in range(STEPS):
            here, step = _newton(here, middle)
            if step < SETTLED:
                break
            if not step < 1:
                return None
        else:
            return None
        return _krawczyk(here, points)


def _krawczyk(z: Balls, points: Balls) -> Certified | None:
    radii = [BOX * max(1.0, abs(complex(one))) for one in z]
    about = np.array([acb(arb(0, radius), arb(0, radius)) for radius in radii], dtype=object)
    values, slopes, _ = _at(z, points, points)
    box = z + about
    over = _at(box, points, points)[1]
    try:
        inverse = slopes.mid().inv().mid()
    except ZeroDivisionError:
        return None
    one = acb_mat(8, 8, [acb(i == k) for i in range(8) for k in range(8)])
    rest = one - inverse * over
    if not _contracts(rest, radii):
        return None
    moved = _column(z) - inverse * _column(values) + rest * _column(about)
    image = np.array(moved.entries(), dtype=object)
    for ball, middle, radius in zip(image, z, radii, strict=True):
        off = ball - middle
        if not (abs(off.real) < radius and abs(off.imag) < radius):
            return None
    return Certified(image, _real(image, box))


def _contracts(rest: acb_mat, radii: Sequence[float]) -> bool:
    """Whether √2 ‖1 - Y J(X)‖ is below 1, each unknown measured by the side of its box: then one solution."""
    rows = rest.table()
    return all(
        sum((abs(entry) * side for entry, side in zip(row, radii, strict=True)), arb(0)) * arb(2).sqrt()
        < radius
        for row, radius in zip(rows, radii, strict=True)
    )


def _real(image: Balls, box: Balls) -> bool | None:
    """Whether the solution is its own conjugate: at real points the conjugate of a solution is one, too."""
    turned = [image[i ^ 1].conjugate() for i in range(8)]
    if all(outer.contains(inner) for outer, inner in zip(box, turned, strict=True)):
        return True
    if not all(one.overlaps(other) for one, other in zip(image, turned, strict=True)):
        return False
    return None


def followed(z: Plane, begin: Plane, end: Balls, reached: float) -> Balls | None:
    """The solution at ``end`` that a path leads to, followed in :data:`BITS` bits; None where it does not.

    Parameters
    ----------
    z
        (8,) where it is after the share ``reached`` of the way.
    begin, end
        (2, 8) points at the ends of the way.
    """
    with ctx.workprec(BITS):
        first = balls(begin)
        last = np.array([[one.mid() for one in row] for row in end], dtype=object)
        way = last - first
        here, t, h, good = balls(z), arb(reached), arb(LONGEST), 0
        for _ in range(5):
            here, step = _newton(here, first + t * way)
        if not step < SETTLED:
            return None
        for _ in range(MOST_STEPS):
            left = 1 - t
            if not left > 0:
                return here
            if not h > SHORTEST:
                return None
            stride = h if h < left else left
            guess = _predicted(here, first, way, t, stride)
            fine = guess is not None
            if guess is not None:
                found, size = _newton(guess, first + (t + stride) * way)
                fine = size < PREDICTED
            if not fine:
                h, good = stride / 2, 0
                continue
            here, _ = _newton(found, first + (t + stride) * way)
            t, good = (t + stride).mid() if stride is not left else arb(1), good + 1
            if good > 2 and h < LONGEST:
                h, good = 2 * h, 0
        return None


def _predicted(z: Balls, first: Balls, way: Balls, t: arb, h: arb) -> Balls | None:
    """The classical method of Runge and Kutta over one step."""

    def rate(at: Balls, time: arb) -> Balls:
        _, slopes, along = _at(at, first + time * way, way)
        return _middle(-one for one in slopes.solve(_column(along)).entries())

    try:
        k1 = rate(z, t)
        k2 = rate(_middle(z + k1 * (h / 2)), t + h / 2)
        k3 = rate(_middle(z + k2 * (h / 2)), t + h / 2)
        k4 = rate(_middle(z + k3 * h), t + h)
    except ZeroDivisionError:
        return None
    return _middle(z + (k1 + 2 * k2 + 2 * k3 + k4) * (h / 6))
