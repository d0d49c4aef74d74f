"""What an interference check says."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from mechwright.contracts.finding import Finding, Severity, Stage, of_stage

MOST = 5
"""Collisions that are printed one by one, the deepest ones: a design with more has one cause for many."""

MOST_NAMES = 24
"""Bodies that are named of those that were not compared: a machine has dozens of screws."""


@dataclass(frozen=True, slots=True)
class Instant:
    """A value of the input channel."""

    name: str
    value: float
    unit: str

    def __str__(self) -> str:
        if self.unit == "rad":
            return f"{self.name} = {math.degrees(self.value):.3f} deg"
        return f"{self.name} = {self.value:.4f} {self.unit}".rstrip()


@dataclass(frozen=True, slots=True)
class Collision:
    """Two bodies that stand in each other.

    Parameters
    ----------
    first, second
        Their names in the assembly.
    instant
        Where in the motion the overlap is deepest.
    depth
        The greatest distance, mm, of a point of one body's surface, inside the other one, from its surface;
        of two plates at most the height that they have in common.
    at
        The place, mm, in the frame of the mechanism.
    """

    first: str
    second: str
    instant: Instant
    depth: float
    at: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Gap:
    """The smallest gap that was seen between two bodies that move past each other, mm."""

    first: str
    second: str
    instant: Instant
    distance: float


@dataclass(frozen=True, slots=True)
class Report:
    """The result of a check over a whole motion.

    Parameters
    ----------
    pairs
        Number of pairs of bodies compared.
    collisions
        The deepest one first; none if the mechanism is clear.
    closest
        The smallest gap above contact among plates, where one was looked at in detail.
    skipped
        Names of bodies that were not compared with all others because solids were not asked for.
    """

    pairs: int
    collisions: tuple[Collision, ...]
    closest: Gap | None = None
    skipped: tuple[str, ...] = ()

    @property
    def clear(self) -> bool:
        """Whether nothing that was compared collides."""
        return not self.collisions

    @of_stage(Stage.ASSEMBLY)
    def findings(self) -> Iterator[Finding]:
        """An error for each of the deepest collisions, or a note that there is none."""
        for place, hit in enumerate(self.collisions[:MOST]):
            rest = len(self.collisions) - MOST
            more = f"; {rest} more pairs collide" if place == MOST - 1 and rest > 0 else ""
            x, y, z = hit.at
            message = (
                f"{hit.first} and {hit.second} stand in each other, {hit.depth:.3f} mm deep at "
                f"{hit.instant}, near X{x:.2f} Y{y:.2f} Z{z:.2f}{more}"
            )
            remedy = "give them heights of their own, or change the sizes that bring them together"
            yield Finding.error("interference.collision", "", message, hit.depth, 0.0, "mm", remedy)
        if self.skipped:
            names = ", ".join(self.skipped[:MOST_NAMES])
            if len(self.skipped) > MOST_NAMES:
                names += f" and {len(self.skipped) - MOST_NAMES} more"
            message = f"{names}: no plates in parallel planes; the commands model and build compare them"
            yield Finding.note("interference.solids", message)
        if self.clear and self.pairs:
            compared = "one pair" if self.pairs == 1 else f"{self.pairs} pairs"
            message = f"no two bodies collide over the whole motion ({compared} compared)"
            gap = self.closest
            if gap is None:
                yield Finding.note("interference.clear", message)
            else:
                message += f"; the smallest gap seen is {gap.distance:.3f} mm, between {gap.first} and "
                message += f"{gap.second} at {gap.instant}"
                yield Finding.note("interference.clear", message, gap.distance, "mm")


@of_stage(Stage.ASSEMBLY)
def settings_findings(reports: "Mapping[str, Report | list[Finding]]") -> Iterator[Finding]:
    """An error for each of the deepest collisions of other settings of a machine, or one note for all.

    ``reports`` has what is set to the report of that setting, or to the errors that forbid its parts.
    """
    wrong = False
    for name, report in reports.items():
        found = report.findings() if isinstance(report, Report) else report
        for finding in found:
            if finding.severity is Severity.ERROR:
                wrong = True
                yield replace(finding, message=f"set to {name}: {finding.message}", proposed=())
    if reports and not wrong:
        gaps = [
            (report.closest.distance, name)
            for name, report in reports.items()
            if isinstance(report, Report) and report.closest is not None
        ]
        message = f"nor do any collide with the machine set to {', '.join(reports)}"
        if gaps:
            message += f"; the smallest gap seen is {min(gaps)[0]:.3f} mm, at {min(gaps)[1]}"
        yield Finding.note(
            "interference.settings", message, min(gaps)[0] if gaps else None, "mm" if gaps else ""
        )
