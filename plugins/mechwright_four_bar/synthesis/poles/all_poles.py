"""Every four-bar through two poles with the crank's turn between them and a given ground, at constant speed.

All complex solutions are followed from those of one set of complex poles, which are kept in
``start.npz``; :mod:`mechwright_four_bar.synthesis.poles.make_start` makes that file again.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from flint import acb, arb, ctx

from mechwright import Array
from mechwright.mechanics.continuation import Balls, Proven, Solutions, all_solutions, read
from mechwright.mechanics.continuation.certificate import BITS, first_pair_conjugate, place, turned
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.poles.system import TWO_POLES, any_parameters, links

FILE = Path(__file__).with_name("start.npz")
"""``parameters`` (7,) and ``solutions`` (141, 6), of :mod:`mechwright_four_bar.synthesis.poles.system`."""

CUT = Path(__file__).with_name("cut.npz")
"""The points whose sums prove that these are all, see :mod:`mechwright.mechanics.continuation.trace`."""

SOLUTIONS = 141
"""Solutions of two poles in general position: what loops from two linkages drawn by lot closed at, and the
slope of the cut's sums."""


@dataclass(frozen=True)
class Linkage:
    """A real solution.

    Parameters
    ----------
    bar
        Its dimensions, on the branch of the first pole.
    phi
        (2,) crank angles from X, rad.
    one_branch
        Whether both poles are on one branch.
    """

    bar: FourBar
    phi: Array
    one_branch: bool

    @property
    def turns(self) -> bool:
        """Whether the crank turns fully, with both poles on one branch."""
        return self.one_branch and self.bar.kind.full_turn


@dataclass(frozen=True)
class AllPoles:
    """What is known of the four-bars through two poles.

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
        """Those whose crank turns fully, with both poles on one branch."""
        return tuple(one for one in self.linkages if one.turns)

    @property
    def count(self) -> str:
        """A part of a sentence that says how many there are."""
        kept = sum(one.one_branch for one in self.linkages)
        return (
            f"{self.solutions.count}; {len(self.linkages)} of them are real, {kept} with both poles on one "
            f"branch, {len(self.turning)} of these with a full turn"
        )


@lru_cache(maxsize=8)
def all_linkages(
    poles: tuple[tuple[float, float], ...], turn: float, ground_angle: float, ground: float
) -> AllPoles:
    """All four-bars whose coupler has its acceleration pole in two places.

    Parameters
    ----------
    poles
        Two places [x, y], mm from A0, that stand for the decimal numbers that they are written as.
    turn
        Of the crank from the first to the second, degrees.
    ground_angle, ground
        Direction of B0 from A0, degrees, and its distance, mm.
    """
    size = max(math.hypot(*pole) for pole in poles)
    with ctx.workprec(BITS):
        places = [place(pole) / size for pole in poles]
        pivot = turned(ground_angle) * arb(repr(float(ground))) / size
        conjugates = [one.conjugate() for one in places]
        parameters = np.array([*places, *conjugates, turned(turn), pivot, pivot.conjugate()], dtype=object)
    found = all_solutions(TWO_POLES, read(FILE, TWO_POLES), parameters, first_pair_conjugate, any_parameters)
    theta = math.radians(ground_angle)
    return AllPoles(
        found, tuple(_linkage(one, parameters, size, theta, ground, math.radians(turn)) for one in found.real)
    )


def _linkage(
    one: Proven, parameters: Balls, size: float, theta: float, ground: float, turn: float
) -> Linkage:
    with ctx.workprec(BITS):
        pin, pin_, *speeds = one.box
        step, pivot, pivot_ = parameters[4:]
        sides: list[int] = []
        for number in range(2):
            p, p_ = (pin * step, pin_ / step) if number else (pin, pin_)
            c, c_, d, d_ = links(p, p_, pivot, pivot_, speeds[number], speeds[2 + number])
            sides.append(_side(c * (pivot_ - p_)))
            coupler, follower = (float(abs((x * x_).mid()).sqrt()) * size for x, x_ in ((c, c_), (d, d_)))
        middle = complex(pin)
    angle = float(np.angle(middle))
    bar = FourBar(size * abs(middle), coupler, follower, ground, theta, sides[0] or 1)
    return Linkage(bar, np.array([angle, angle + turn]), sides[0] == sides[1] != 0)


def _side(product: acb) -> int:
    """The certain sign of the imaginary part, 0 where there is none."""
    return 1 if product.imag > 0 else -1 if product.imag < 0 else 0
