"""States of a control that outlive a program: each is set before it is read, refused, or told to people."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum


class Then(Enum):
    """What becomes of a program that reads a state which it has not set."""

    REFUSED = "refused"
    TOLD = "told: the control begins with it"
    RESET = "the control begins every program with it"
    SHEET = "no program shows it: sheet and `verify` tell it"


@dataclass(frozen=True, slots=True)
class Kept:
    """One state that an earlier program may leave."""

    name: str
    words: str
    """Words that set it."""
    then: Then
    rule: str = ""
    """The check that refuses or tells; empty for the reader itself."""


def everywhere(*, compensation: bool = True, lengths: bool = True, cycles: bool = True) -> tuple[Kept, ...]:
    """States that every control keeps, and that a program has to set before it reads them."""
    return (
        Kept("units", "G20, G21", Then.REFUSED, "modes"),
        Kept("distance", "G90, G91", Then.REFUSED, "modes"),
        Kept("plane", "G17, G18, G19", Then.REFUSED, "modes"),
        *([Kept("cutter compensation", "G40, G41, G42", Then.REFUSED, "modes")] if compensation else []),
        *([Kept("return", "G98, G99", Then.REFUSED, "modes")] if cycles else []),
        Kept("motion", "G0 to G3, cycles", Then.REFUSED),
        Kept("feed, speed", "F, S", Then.REFUSED),
        Kept("work offset", "G54", Then.REFUSED, "work-offset"),
        Kept("tool", "T, M6", Then.REFUSED, "tools"),
        Kept("length offset", "G43, G49" if lengths else "G43.1, G49", Then.REFUSED, "length-offset"),
        Kept("spindle", "M3, M4, M5", Then.REFUSED, "spindle"),
        Kept("coolant", "M7, M8, M9", Then.REFUSED, "coolant"),
    )


def feed_mode(then: Then) -> Kept:
    """Feeds by minute, which an earlier program may have changed."""
    return Kept("feed mode", "G94", then, "modes")


def centres(then: Then) -> Kept:
    """Centres of arcs by distance."""
    return Kept("centres", "G91.1, G90.1", then, "modes")


def shown_by_none(**states: str) -> tuple[Kept, ...]:
    """States that no program shows: name, with _ for blanks, to their words."""
    return tuple(Kept(name.replace("_", " "), words, Then.SHEET) for name, words in states.items())


def left_over(kept: Sequence[Kept]) -> str:
    """The states that no program shows, with their words.

    >>> left_over([Kept("a turn", "G68", Then.SHEET), Kept("units", "G21", Then.REFUSED)])
    'a turn (G68)'
    """
    return ", ".join(f"{one.name} ({one.words})" for one in kept if one.then is Then.SHEET)
