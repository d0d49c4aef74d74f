"""What is tried with every change, and what only by night, when MECHWRIGHT_NIGHT is set."""

import os

import pytest

NIGHT = bool(os.environ.get("MECHWRIGHT_NIGHT"))

by_night = pytest.mark.skipif(not NIGHT, reason="by night, with MECHWRIGHT_NIGHT=1")
"""For a test that shows on more cases what another shows on a few."""


def examples(day: int, night: int) -> int:
    """Random examples of a property whose examples take up to seconds each."""
    return night if NIGHT else day
