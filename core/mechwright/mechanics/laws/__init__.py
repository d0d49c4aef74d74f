"""Motion laws: how an output goes from rest to rest, in shares of its way over shares of the time."""

from collections.abc import Callable

from mechwright.mechanics.laws.harmonic import (
    HarmonicPieces,
    cycloidal,
    modified_sine,
    modified_trapezoid,
    simple_harmonic,
)
from mechwright.mechanics.laws.law import Law, Peaks, Rates
from mechwright.mechanics.laws.polynomial import Polynomial, poly345, poly4567

LAWS: dict[str, Callable[[], Law]] = {
    "cycloidal": cycloidal,
    "modified-sine": modified_sine,
    "modified-trapezoid": modified_trapezoid,
    "3-4-5": poly345,
    "4-5-6-7": poly4567,
    "simple-harmonic": simple_harmonic,
}
"""The named laws, as design files say them."""

__all__ = ["LAWS", "HarmonicPieces", "Law", "Peaks", "Polynomial", "Rates"]
