"""Whether the solutions that are known are all: the trace test.

Parameters that move on a line, p + t w, lead the solutions on a curve; where p and w are in general position
the curve is as irreducible as the set of all solutions is (Bertini), or as that of the solutions at one place
of those parameters that stand still. With z one of the unknowns and U = (b + c z)/(d + e z) the curve is cut
by

    a/t + U = s.

As s grows a point of the cut runs to t = 0, where the known solutions are, or to the pole of U. Nothing of it
runs away at any other s, so the sum of a/t over *all* points of the cut is a polynomial in s, and as it grows
like s it is linear. Its slope is the number of the solutions. A sum over a part of them is not linear, as
loops of s change any two points about (Sommese, Verschelde and Wampler 2002; Leykin, Rodriguez and Sottile
2018).

So loops bring points of the cut to others until the sum is linear. The sums at three places are then taken in
balls, each point certified: its second difference and the slope are known to some 20 digits.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from flint import acb, ctx

from mechwright.mechanics.continuation.certificate import BITS, balls, krawczyk, refined
from mechwright.mechanics.continuation.complete import Start
from mechwright.mechanics.continuation.loops import new_ones, settled
from mechwright.mechanics.continuation.paths import tracked
from mechwright.mechanics.continuation.system import System
from mechwright.mechanics.planar import Plane

STEP = 0.25
"""Between the values of s; all numbers are of the order of 1."""

STRAIGHT = 1e-8
"""Second difference in doubles, for each point, of a linear sum; of another it is 0.01 or so."""

EXACT = 1e-15
"""Radius of balls that say what a sum of some hundred points is; certificates leave 1e-18 and less."""

NUMBERS = 6
"""s, a, b, c, d and e."""

GRID = 2.0**20
"""Parts of 1 that these are whole multiples of, so that s with some steps is a double."""


@dataclass(frozen=True)
class Cut:
    """All points in which a curve of solutions is cut.

    Parameters
    ----------
    base, way
        (k,) p and w.
    unknown
        Number of the unknown z; of solutions at one t no two have the same.
    numbers
        (6,) s, a, b, c, d, e.
    points
        (n, m + 1) unknowns, t the last of them.
    """

    base: Plane
    way: Plane
    unknown: int
    numbers: Plane
    points: Plane

    def system(self, of: System) -> System:
        """The equations of its points, with the numbers as parameters."""
        base, way = (list(map(complex, one)) for one in (self.base, self.way))

        def equations(unknowns: Sequence[Any], numbers: Sequence[Any]) -> list[Any]:
            *unknown, t = unknowns
            s, a, b, c, d, e = numbers
            z = unknown[self.unknown]
            over, under = z * c + b, z * e + d
            places = [t * rate + place for place, rate in zip(base, way, strict=True)]
            return [*of.equations(unknown, places), t * (under * s - over) - under * a]

        return System(equations)

    def moved(self, steps: int) -> Plane:
        """The numbers with another s."""
        numbers = self.numbers.copy()
        numbers[0] += steps * STEP
        return numbers


@dataclass(frozen=True)
class Trace:
    """What the sums of a cut say.

    Parameters
    ----------
    slope
        Of the sum by s: the number of solutions, if the cut is whole.
    bend
        Second difference of the sums, 0 if it is.
    points
        How many points are cut.
    """

    slope: acb
    bend: acb
    points: int

    def proves(self, solutions: int, within: float) -> bool:
        """Whether the balls hold that number and no bend, and are smaller than ``within``."""
        small = all(
            abs(one).rad() < within and abs(one).mid() < within for one in (self.slope - solutions, self.bend)
        )
        return small and self.slope.contains(acb(solutions)) and self.bend.contains(acb(0))


def whole_cut(
    system: System,
    start: Start,
    unknown: int,
    moving: int,
    rng: np.random.Generator,
    heard: Callable[[int], None],
) -> Cut:
    """The cut through the solutions of a start, its points multiplied by loops until their sum is linear.

    Parameters
    ----------
    unknown
        Number of the unknown z.
    moving
        How many of the parameters move on the line, the first ones.
    rng
        Draws the line and the numbers.
    heard
        Told the number of points after each loop.
    """
    way: Plane = np.zeros(start.parameters.size, dtype=np.complex128)
    way[:moving] = _any(rng, moving)
    first = _any(rng, NUMBERS)
    first[1] = 0
    numbers: Plane = _any(rng, NUMBERS)
    on_base: Plane = np.concatenate((start.solutions, np.zeros((len(start.solutions), 1))), axis=1)
    cut = Cut(start.parameters, way, unknown, numbers, on_base)
    equations = cut.system(system)
    points: Plane = tracked(equations, on_base, first, numbers).arrived
    while True:
        cut = Cut(start.parameters, way, unknown, numbers, points)
        heard(len(points))
        if _straight(equations, cut):
            return cut
        found = points
        for begin, end in pairwise((numbers, _any(rng, NUMBERS), _any(rng, NUMBERS), numbers)):
            found = tracked(equations, found, begin, end).arrived
        points = np.concatenate((points, new_ones(settled(equations, found, numbers), points)))


def read_cut(file: Path) -> Cut:
    """A cut that is kept as data, its fields by their names."""
    with np.load(file) as kept:
        return Cut(kept["base"], kept["way"], int(kept["unknown"]), kept["numbers"], kept["points"])


def keep_cut(cut: Cut, file: Path) -> None:
    """Write a cut as data."""
    np.savez_compressed(
        file, base=cut.base, way=cut.way, unknown=cut.unknown, numbers=cut.numbers, points=cut.points
    )


def trace(system: System, cut: Cut) -> Trace | None:
    """The sums of a cut in balls; None where a point has no certificate, or two may be one."""
    equations = cut.system(system)
    sums = []
    with ctx.workprec(BITS):
        for steps in range(3):
            numbers = balls(cut.moved(steps))
            places = tracked(equations, cut.points, cut.numbers, cut.moved(steps)).arrived
            boxes = []
            for place in places:
                near = refined(balls(place), lambda one: equations.in_balls(one, numbers))  # noqa: B023
                proof = None if near is None else krawczyk(near, lambda one: equations.in_balls(one, numbers))  # noqa: B023
                if proof is None:
                    return None
                boxes.append(proof[1])
            if len(boxes) < len(cut.points) or _meet(boxes):
                return None
            sums.append(sum((numbers[1] / box[-1] for box in boxes), acb(0)))
        bend = sums[2] - 2 * sums[1] + sums[0]
        return Trace((sums[1] - sums[0]) / STEP, bend, len(cut.points))


def _any(rng: np.random.Generator, count: int) -> Plane:
    numbers = np.exp(2j * np.pi * rng.random(count)) * rng.uniform(0.6, 1.4, count)
    rounded: Plane = np.round(numbers * GRID) / GRID
    return rounded


def _straight(equations: System, cut: Cut) -> bool:
    """Whether the sum is linear, in doubles; not, where a point is lost."""
    sums = []
    for steps in range(4):
        numbers = cut.moved(steps)
        places = settled(equations, tracked(equations, cut.points, cut.numbers, numbers).arrived, numbers)
        if len(places) < len(cut.points):
            return False
        sums.append((numbers[1] / places[:, -1]).sum())
    return bool(np.abs(np.diff(sums, 2)).max() < STRAIGHT * len(cut.points))


def _meet(boxes: Sequence[Any]) -> bool:
    """Whether two boxes may hold one point."""
    middles = np.array([[complex(one) for one in box] for box in boxes])
    order = np.argsort(middles[:, -1].real)
    near = [(i, k) for i, k in pairwise(order.tolist()) if np.abs(middles[i] - middles[k]).max() < 1e-6]
    return any(
        all(one.overlaps(other) for one, other in zip(boxes[i], boxes[k], strict=True)) for i, k in near
    )
