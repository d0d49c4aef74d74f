"""How many points an adjustable linkage can meet exactly, over all its phases.

With so many equations as unknowns: sum of the points = common + phases x own. The pose of setting counts in
every phase, as its first point. The Jacobians of random mechanisms have full rank at these numbers, in the
plane and on the sphere, for one to three phases. A count is no promise of a solution that is real, in order
and on one branch.
"""

from typing import Literal

Moves = Literal["moving", "fixed", "both"]
"""Which pivots are set: those on the coupler, those in the ground, or both; the links keep their lengths."""

_EXACT: dict[tuple[int, Moves, bool], tuple[int, int]] = {
    (4, "moving", False): (6, 3),
    (4, "fixed", False): (5, 4),
    (4, "both", False): (2, 7),
    (5, "moving", True): (7, 4),
    (5, "moving", False): (8, 3),
    (5, "fixed", True): (6, 5),
    (5, "both", True): (3, 8),
}
"""(bars, moves, arm turned at the setting) to (common, own unknowns of a phase)."""


def exact_number(bars: int, moves: Moves, phases: int, arm_turned: bool = False) -> int:
    """The greatest sum of points over all phases that can be met exactly.

    Examples
    --------
    >>> [exact_number(4, "moving", m) for m in (1, 2, 3)]
    [9, 12, 15]
    >>> [exact_number(5, "moving", m, arm_turned=True) for m in (1, 2, 3)]
    [11, 15, 19]
    """
    common, own = _EXACT[bars, moves, arm_turned]
    return common + phases * own
