"""Tolerance analysis: first order, worst case, and mechanisms made at random."""

from mechwright.mechanics.tolerance.analysis import Analysis, Result, analyse
from mechwright.mechanics.tolerance.proportion import Share, share_of
from mechwright.mechanics.tolerance.trials import Trial

__all__ = ["Analysis", "Result", "Share", "Trial", "analyse", "share_of"]
