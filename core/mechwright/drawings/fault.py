"""What is wrong with a drawing, and what was done to it: both told with their places."""

from collections import Counter
from dataclasses import dataclass, field

from mechwright.geometry.segments import Point

MOST = 12
"""Faults that are told of one drawing: whoever has mended a dozen reads it again."""


FAULTS = ("file", "units", "entity", "layer", "contour", "feature")
"""Codes of faults."""


@dataclass(frozen=True)
class Fault:
    """One thing that keeps a drawing from being a part.

    ``code`` is one of ``FAULTS``; ``key`` the setting that may help: ``drawing``, ``units``, ``join`` ...
    """

    code: str
    message: str
    remedy: str
    key: str = "drawing"


@dataclass
class Told:
    """What is collected while a drawing is read: faults, and what was mended or left out."""

    faults: list[Fault] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)
    likely: dict[str, str] = field(default_factory=dict)
    """Layers without a meaning, and what they are likely to mean."""

    def fault(self, code: str, message: str, remedy: str, key: str = "drawing") -> None:
        """Note a fault; those beyond the most that are told are dropped, and so are repetitions."""
        found = Fault(code, message, remedy, key)
        if len(self.faults) < MOST and found not in self.faults:
            self.faults.append(found)

    def note(self, text: str) -> None:
        """Note what was done, once."""
        if text not in self.notes:
            self.notes.append(text)


def at(point: Point) -> str:
    """A place, mm, as messages say it.

    >>> at((9.0, -0.00001))
    'X9.000 Y0.000'
    """
    x, y = (round(value, 3) + 0.0 for value in point)
    return f"X{x:.3f} Y{y:.3f}"
