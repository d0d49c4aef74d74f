"""What a mechanism does whose parts are as the machine leaves them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mechwright.arrays import Array
from mechwright.contracts.finding import Finding


@dataclass(frozen=True, slots=True)
class MadeFigure:
    """One figure of a mechanism: what was asked for, what the design does, and what the made parts do.

    Parameters
    ----------
    name
        Stable, dotted, lower-case name (``"pair.play.least"``).
    title
        A few words.
    unit
        Of all values.
    asked
        The value that was asked for, or the limit; None where nothing was.
    design
        With the parts as drawn; None where the drawing has none.
    made
        With the parts as made.
    low, high
        Over the corridor and the tolerances.
    rule
        The equation or rule, with its source.
    """

    name: str
    title: str
    unit: str
    asked: float | None
    design: float | None
    made: float
    low: float
    high: float
    rule: str = ""

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        values = {key: getattr(self, key) for key in ("asked", "design", "made", "low", "high")}
        tidy = {key: None if value is None else float(f"{value:.9g}") for key, value in values.items()}
        return {"name": self.name, "title": self.title, "unit": self.unit, **tidy, "rule": self.rule}


@dataclass(frozen=True, eq=False)
class MadeCurve:
    """A figure over the motion: lines (n,) over ``x`` (n,), such as the play over a turn."""

    title: str
    x_title: str
    unit: str
    x: Array
    lines: Mapping[str, Array]


@dataclass(frozen=True, eq=False)
class AsMade:
    """What a family says of its mechanism with parts as made.

    An error among the findings says that it cannot be put together, or does not turn, and what to change.
    """

    figures: tuple[MadeFigure, ...] = ()
    curves: tuple[MadeCurve, ...] = ()
    findings: tuple[Finding, ...] = ()
