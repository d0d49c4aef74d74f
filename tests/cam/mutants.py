"""Programs with a single fault, as slips of the hand, of an editor or of a post make them.

``mutant_traces.py`` says what a machine would do, so that a fault which changes nothing can be told.
``benchmarks/mutations.py`` makes thousands of them.
"""

from dataclasses import dataclass

import line_faults
import word_faults
from program_faults import Rng

FAULTS = word_faults.FAULTS | line_faults.FAULTS


@dataclass(frozen=True)
class Mutant:
    """A program with one fault: its kind, the first line that is wrong (from 1), what was done, its text."""

    kind: str
    line: int
    change: str
    text: str


def mutant(text: str, kind: str, rng: Rng) -> Mutant | None:
    """The program with one fault of a kind at a random place; None if it has none."""
    lines = text.split("\n")
    made = FAULTS[kind](list(lines), rng)
    if made is None or made[2] == lines:
        return None
    line, change, wrong = made
    return Mutant(kind, line + 1, change, "\n".join(wrong))
