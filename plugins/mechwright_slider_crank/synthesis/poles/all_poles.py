"""Every slider-crank through two poles with the crank's rotation between them, at constant speed.

All complex solutions are followed from those of one set of complex poles, which are kept in
``start.npz``; :mod:`mechwright_slider_crank.synthesis.poles.make_start` makes that file again.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from flint import acb, ctx

from mechwright.mechanics.continuation import Balls, Proven, Solutions, all_solutions, read
from mechwright.mechanics.continuation.certificate import BITS, first_pair_conjugate, place, turned
from mechwright_slider_crank.kinematics.limits import crank_turns
from mechwright_slider_crank.synthesis.poles.system import TWO_POLES, any_parameters, lengths, rates

FILE = Path(__file__).with_name("start.npz")
"""``parameters`` (5,) and ``solutions`` (41, 4), of :mod:`mechwright_slider_crank.synthesis.poles.system`."""

CUT = Path(__file__).with_name("cut.npz")
"""The points whose sums prove that these are all, see :mod:`mechwright.mechanics.continuation.trace`."""

SOLUTIONS = 41
"""Solutions of two poles in general position: what loops from two linkages drawn by lot closed at, and the
slope of the cut's sums."""


@dataclass(frozen=True)
class Linkage:
    """A real solution.

    Parameters
    ----------
    crank, rod, offset
        a, c, e, mm.
    branch
        +1 with the slider ahead of the crank pin at both poles, -1 behind, 0 where it changes.
    angle
        Crank angle at the first pole from the slide's direction, rad.
    """

    crank: float
    rod: float
    offset: float
    branch: int
    angle: float

    @property
    def turns(self) -> bool:
        """Whether the crank turns fully, with both poles on one assembly."""
        return self.branch != 0 and crank_turns(self.crank, self.rod, self.offset)


@dataclass(frozen=True)
class AllPoles:
    """What is known of the slider-cranks through two poles.

    Parameters
    ----------
    solutions
        The complex ones.
    linkages
        The real ones among them.
    """

    solutions: Solutions
    linkages: tuple[Linkage, ...]

    @property
    def turning(self) -> tuple[Linkage, ...]:
        """Those whose crank turns fully, with both poles on one assembly."""
        return tuple(one for one in self.linkages if one.turns)

    @property
    def count(self) -> str:
        """A part of a sentence that says how many there are."""
        kept = sum(one.branch != 0 for one in self.linkages)
        return (
            f"{self.solutions.count}; {len(self.linkages)} of them are real, {kept} with both poles on one "
            f"assembly, {len(self.turning)} of these with a crank that turns"
        )


@lru_cache(maxsize=8)
def all_linkages(poles: tuple[tuple[float, float], ...], rotation: float, direction: float) -> AllPoles:
    """All slider-cranks whose rod has its acceleration pole in two places.

    Parameters
    ----------
    poles
        Two places [x, y], mm, that stand for the decimal numbers that they are written as.
    rotation
        Of the crank from the first to the second, degrees.
    direction
        Of the slide, degrees.
    """
    size = max(math.hypot(*pole) for pole in poles)
    with ctx.workprec(BITS):
        back = turned(-direction)
        places = [place(pole) * back / size for pole in poles]
        parameters = np.array([*places, *(one.conjugate() for one in places), turned(rotation)], dtype=object)
    found = all_solutions(TWO_POLES, read(FILE, TWO_POLES), parameters, first_pair_conjugate, any_parameters)
    return AllPoles(found, tuple(_linkage(one, parameters, size) for one in found.real))


def _linkage(one: Proven, parameters: Balls, size: float) -> Linkage:
    with ctx.workprec(BITS):
        pin, pin_, *omegas = one.box
        pairs: Sequence[tuple[acb, acb]] = ((pin, pin_), (pin * parameters[4], pin_ / parameters[4]))
        signs = set()
        for number, (p, p_) in enumerate(pairs):
            square, alpha = rates(p, p_, parameters[number], parameters[2 + number])
            w, t, e = lengths(p, p_, omegas[number], square, alpha)
            signs.add(1 if w.real > 0 else -1 if w.real < 0 else 0)
        rod = (w.real * w.real + t.real * t.real).sqrt()
        branch = signs.pop() if len(signs) == 1 else 0
        middle = complex(pin)
        return Linkage(
            size * abs(middle),
            size * float(rod.mid()),
            size * float(e.real.mid()),
            branch,
            float(np.angle(middle)),
        )
