"""Tolerance analysis: first order, worst case, and mechanisms made at random."""

from mechwright.mechanics.tolerance.analysis import Analysis, Result, analyse, check_keys
from mechwright.mechanics.tolerance.axial_stacks import StackResult, stack_result
from mechwright.mechanics.tolerance.places import Band, Place
from mechwright.mechanics.tolerance.proportion import Share, share_of
from mechwright.mechanics.tolerance.trials import Trial

__all__ = [
    "Analysis",
    "Band",
    "Place",
    "Result",
    "Share",
    "StackResult",
    "Trial",
    "analyse",
    "check_keys",
    "share_of",
    "stack_result",
]
