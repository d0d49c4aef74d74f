"""Worst case and statistics of a stack of lengths.

The gap is g = Σ s (N + d), with the sign s, the nominal length N and the deviation d of each length. In
the worst case all d stand at their limits. By statistics, with half zones t, the gap lies within
√(Σ t²) of its middle: right for four or more independent lengths that are centred in their limits. Where one
is bought, half as much again is taken (Bender). The standard deviation is a third of that.
"""

import math
from dataclasses import dataclass

from mechwright.contracts.axial_stack import AxialStack

BOUGHT = 1.5
"""By how much the statistical zone widens where a part is bought; handbook."""

SIGMAS = 3.0
"""Standard deviations in half a tolerance."""


@dataclass(frozen=True)
class StackResult:
    """What a stack does.

    Parameters
    ----------
    worst
        Least and greatest gap, mm, in the worst case.
    half
        Root of the sum of the squared half zones, mm.
    statistical
        Least and greatest gap by statistics, mm: the middle ± ``half``, 1.5 times that with a bought part.
    shares
        Share of each length in the variance.
    below_zero
        Probability of a gap below 0, of a normal distribution whose sigma is ``half``/3.
    """

    worst: tuple[float, float]
    half: float
    statistical: tuple[float, float]
    shares: tuple[float, ...]
    below_zero: float


def stack_result(stack: AxialStack) -> StackResult:
    """Worst case, statistics and shares of a stack.

    >>> from mechwright.contracts.axial_stack import StackLength
    >>> two = (StackLength("hole", 1, 8.1, 0.0, 0.05), StackLength("roller", -1, 8.0, -0.05, 0.0))
    >>> found = stack_result(AxialStack("roller on its stud", two))
    >>> tuple(round(one, 6) for one in found.worst), round(found.half, 6), found.shares
    ((0.1, 0.2), 0.035355, (0.5, 0.5))
    """
    squares = [one.half**2 for one in stack.lengths]
    half, middle = math.sqrt(sum(squares)), stack.middle
    wide = BOUGHT * half if any(one.bought for one in stack.lengths) else half
    shares = tuple(one / sum(squares) for one in squares) if half else (0.0,) * len(squares)
    sigma = half / SIGMAS
    below = 0.5 * math.erfc(middle / sigma / math.sqrt(2)) if sigma else float(middle < 0)
    return StackResult(stack.worst, half, (middle - wide, middle + wide), shares, below)


def nearest_nominal(stack: AxialStack) -> float | None:
    """Nominal length to change, mm, nearest to its own, with which the stack closes.

    None where no length does: all tolerances together are wider than the play that is meant.
    """
    low, high = stack.play
    if high - low > stack.greatest - stack.least:
        return None
    one = stack.changed
    more = max(stack.least - low, 0.0) or min(stack.greatest - high, 0.0)
    return one.nominal + one.sign * more
