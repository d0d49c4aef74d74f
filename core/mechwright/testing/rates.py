"""Rates of a motion against difference quotients, between the breaks that its family declares."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion
from mechwright.testing import rules
from mechwright.testing.compare import STENCIL, assert_derivative

ON_A_BREAK = 1e-9
"""Part of the whole motion within which a sample lies on a break."""


def assert_rates(
    motion: Motion, pairs: Sequence[tuple[str, str]], input_rate: str, breaks: Sequence[float]
) -> None:
    """Check that channels are the rates over time of others, and have units of rates.

    Parameters
    ----------
    motion
        Sampled smoothly between the breaks.
    pairs
        Names of a channel and of that of its rate.
    input_rate
        Name of the channel of the input's own rate; not used where the time is what goes on.
    breaks
        What :meth:`~mechwright.contracts.family.Family.breaks` gives.
    """
    drive = motion.channels[motion.over].values
    one_way = input_rate and motion.over == motion.input_name
    factor = motion.channels[input_rate].values if one_way else np.ones(drive.size)
    pieces = between(drive, breaks)
    for name, rate in pairs:
        one, two = motion.channels[name], motion.channels[rate]
        largest = float(np.abs(two.values).max())
        for piece in pieces:
            what = f"channel {rate}" + (f" from sample {piece.start} on" if len(pieces) > 1 else "")
            assert_derivative(
                two.values[piece], one.values[piece], drive[piece], factor[piece], what=what, largest=largest
            )
        assert rules.is_rate(two.unit, one.unit), f"{rate} [{two.unit}] is no rate of {name} [{one.unit}]"


def between(variable: Array, breaks: Sequence[float]) -> list[slice]:
    """The samples between breaks, where they are as many as a difference quotient needs.

    Parameters
    ----------
    variable
        (n,) float, rising or falling: where the samples are.
    breaks
        Where something is not smooth; a sample on one belongs to neither side.

    Raises
    ------
    AssertionError
        A break lies outside of the samples, or they leave less than half of the samples to compare.

    Examples
    --------
    >>> between(np.linspace(0, 10, 101), [5.0])
    [slice(0, 50, None), slice(51, 101, None)]
    """
    low, high = sorted((float(variable[0]), float(variable[-1])))
    near = ON_A_BREAK * (high - low)
    outside = [one for one in breaks if not low - near <= one <= high + near]
    if outside:
        raise AssertionError(f"breaks: {outside[0]:g} is not in the motion, which is {low:g} to {high:g}")
    sides, on_one = np.zeros((2, variable.size), dtype=np.int64)
    for one in breaks:
        on_one |= np.abs(variable - one) <= near
        sides += variable > one
    ends = [0, *(np.flatnonzero(np.diff(2 * sides + on_one)) + 1), variable.size]
    pieces = [
        slice(int(first), int(last))
        for first, last in pairwise(ends)
        if last - first >= STENCIL + 2 and not on_one[first]
    ]
    if 2 * sum(piece.stop - piece.start for piece in pieces) < variable.size:
        raise AssertionError(f"breaks: {len(breaks)} of them leave less than half of the samples to compare")
    return pieces
