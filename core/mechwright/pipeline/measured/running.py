"""How the mechanism runs with its parts as measured: the family's analysis with what was measured.

Walls stand off as measured, joints have the plays of the pairs that were measured; all else is as designed.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.contracts.tolerances import Contributor, Zone
from mechwright.pipeline.build import Build
from mechwright.pipeline.measured.corrections import SIGMAS, Correction
from mechwright.pipeline.measured.pairing import Pairing
from mechwright.pipeline.tolerances.compared import ComparedOutput, compared
from mechwright.pipeline.tolerances.table import TolerancesTable

ALIKE = 0.5
"""A joint is that of a measured pair if their diameters differ by less, mm."""


@dataclass(frozen=True)
class MeasuredTolerances(Tolerances):
    """The tolerances of a design with what was measured.

    Parameters
    ----------
    plays
        Diameter of a joint to least and greatest play of the pairs that are put together, mm.
    wall
        Least and greatest stock on a wall, mm; None where none was measured.
    """

    plays: dict[float, tuple[float, float]] = field(default_factory=dict)
    off: tuple[float, float] | None = None

    def pin(self, name: str, diameter: float, own: float | str, *, member: bool = False) -> Contributor:
        """A joint with the plays that were measured of its diameter."""
        found = super().pin(name, diameter, own, member=member)
        near = min(self.plays, key=lambda one: abs(one - diameter), default=None)
        if near is None or abs(near - diameter) > ALIKE:
            return found
        zone = Zone(*self.plays[near], self.settings.distribution)
        return Contributor(found.name, found.key, found.unit, 0.0, (zone,), found.directions)

    def wall(self, name: str) -> Contributor:
        """A wall that stands off as measured."""
        found = super().wall(name)
        if self.off is None:
            return found
        return Contributor(
            found.name, found.key, found.unit, 0.0, (Zone(*self.off, self.settings.distribution),)
        )


def measured_tolerances(
    build: Build, pairs: Sequence[Pairing], found: Sequence[Correction], diameters: Sequence[float]
) -> MeasuredTolerances:
    """What was measured as tolerances; ``diameters`` are those of the pairs, mm."""
    plays: dict[float, tuple[float, float]] = {}
    for pair, diameter in zip(pairs, diameters, strict=True):
        if pair.moves:
            own = [max(float(pair.plays[i, j]), 0.0) for i, j in pair.chosen]
            known = plays.get(diameter, (own[0], own[0]))
            plays[diameter] = (min(*own, known[0]), max(*own, known[1]))
    ends = [one.off + sign * SIGMAS * one.error for one in found for sign in (-1, 1)]
    asked = build.design.table(TolerancesTable)
    return MeasuredTolerances(asked.settings, asked.own, plays, (min(ends), max(ends)) if ends else None)


def as_measured(
    build: Build, pairs: Sequence[Pairing], found: Sequence[Correction], diameters: Sequence[float]
) -> list[ComparedOutput]:
    """The outputs of the family's analysis; none where it has none."""
    return compared(build, measured_tolerances(build, pairs, found, diameters))
