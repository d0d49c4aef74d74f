"""What is tried with every change, what in CI besides, and what only by night: MECHWRIGHT_CI, MECHWRIGHT_NIGHT."""

import os
from collections.abc import Sequence
from itertools import product
from typing import Any

import pytest

NIGHT = bool(os.environ.get("MECHWRIGHT_NIGHT"))
IN_CI = NIGHT or bool(os.environ.get("MECHWRIGHT_CI"))

by_night = pytest.mark.skipif(not NIGHT, reason="by night, with MECHWRIGHT_NIGHT=1")
"""For a test that shows on more cases what another shows on a few."""

in_ci = pytest.mark.skipif(not IN_CI, reason="in CI besides, with MECHWRIGHT_CI=1")
"""For tests with whole programs around ours, as an installed plugin or another one's planner, and for those that
compile many kernels: CI runs their files besides the README's command."""


def examples(day: int, night: int) -> int:
    """Random examples of a property whose examples take up to seconds each."""
    return night if NIGHT else day


def thinned(step: int, *axes: Sequence[Any], first: int = 0) -> list[Any]:
    """Every combination of the axes as cases: by day one in ``step``, of all values alike; the rest by night.

    By day are those whose places along the axes add up to ``first`` and a multiple of ``step``, as on a diagonal:
    tests with one axis and another ``first`` each take all its values between them.
    """
    return [
        pytest.param(
            *(one for _, one in case), marks=() if sum(n for n, _ in case) % step == first else by_night
        )
        for case in product(*map(enumerate, axes))
    ]
