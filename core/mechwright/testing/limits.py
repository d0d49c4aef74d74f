"""Whether what a synthesis gives keeps the limits that it was asked for."""

from typing import Any

from mechwright.contracts.parameters import Parameters
from mechwright.contracts.synthesis import Candidate

LEAST, MOST = ("least_", "shortest_"), ("greatest_", "longest_", "most_")
"""How the names of limits begin, below and above."""

ROUNDING = 1e-12
"""Share of a limit that radians lose on their way to degrees."""


def limits_broken(requirement: Parameters, candidate: Candidate[Any]) -> list[str]:
    """What a candidate's figures break of a requirement, in words.

    A figure that has the name of a key of the requirement is held by it: from below where the name begins
    with ``least_`` or ``shortest_``, from above with ``greatest_``, ``longest_`` or ``most_``. A key that
    asks for nothing (None) holds nothing.
    """
    said = []
    for name, figure in candidate.shown.items():
        asked = getattr(requirement, name, None)
        if not isinstance(asked, (int, float)):
            continue
        room = ROUNDING * abs(asked)
        below = name.startswith(LEAST) and figure.value < asked - room
        if below or (name.startswith(MOST) and figure.value > asked + room):
            said.append(f"{name}: {asked:.15g} asked, {figure.value:.15g} given")
    return said
