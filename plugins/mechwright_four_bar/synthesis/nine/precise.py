"""Nine points in ball arithmetic: certificates, and paths of which doubles lose sight.

Every number is a ball, a midpoint with a radius that holds the true value (Arb); the equations are those of
:mod:`mechwright_four_bar.synthesis.nine.equations`, run on balls.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, ctx

from mechwright.mechanics.continuation import Balls
from mechwright.mechanics.continuation.certificate import (
    BITS,
    SETTLED,
    balls,
    column,
    is_own,
    krawczyk,
    middle,
    newton_in_balls,
    refined,
)
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.synthesis.nine import equations
from mechwright_four_bar.synthesis.nine.triples import fingerprints

PREDICTED = 1e-3
"""Error of a prediction that is good, as a share of each unknown or of 1."""

SHORTEST, LONGEST = 1e-10, 0.05
"""Steps of a path, as shares of the way."""

MOST_STEPS = 1500
"""Steps of a path, tried ones included: some seconds."""

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


def _at(z: Balls, points: Balls, way: Balls) -> tuple[Balls, acb_mat, Balls]:
    """Values (8,), slopes, and rate (8,) along the way of the points."""
    values, along = np.empty(8, object), np.empty(8, object)
    slopes = np.empty((8, 8), object)
    _evaluate(z, points, way, values, slopes, along)
    return values, acb_mat(8, 8, slopes.ravel().tolist()), along


def _newton(z: Balls, points: Balls) -> tuple[Balls, float]:
    """The next approximation and the size of the step, infinite where there is none."""
    return newton_in_balls(z, lambda here: _at(here, points, points)[:2])


def certificate(z: Plane | Balls, points: Balls) -> Certified | None:
    """The solution near ``z`` (8,) at points (2, 8), proven; None where that cannot be done."""
    with ctx.workprec(BITS):
        exact = np.array([middle(row) for row in points])
        here = refined(balls(z), lambda one: _at(one, exact, exact)[:2])
        proof = None if here is None else krawczyk(here, lambda one: _at(one, points, points)[:2])
        if proof is None:
            return None
        box, image = proof
        # At real points the conjugate of a solution is one, too.
        turned = np.array([image[i ^ 1].conjugate() for i in range(8)], dtype=object)
        return Certified(image, is_own(box, image, turned))


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
        return middle(-one for one in slopes.solve(column(along)).entries())

    try:
        k1 = rate(z, t)
        k2 = rate(middle(z + k1 * (h / 2)), t + h / 2)
        k3 = rate(middle(z + k2 * (h / 2)), t + h / 2)
        k4 = rate(middle(z + k3 * h), t + h)
    except ZeroDivisionError:
        return None
    return middle(z + (k1 + 2 * k2 + 2 * k3 + k4) * (h / 6))
