"""How the mechanism runs with its parts as measured: the family's analysis with what was measured.

Walls stand off as measured, and a joint has the plays of the pairs that make it; all else is as designed.
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


@dataclass(frozen=True)
class MeasuredTolerances(Tolerances):
    """The tolerances of a design with what was measured.

    Parameters
    ----------
    plays
        Name of the motion's joint to least and greatest play of the pairs that make it, mm.
    wall
        Least and greatest stock on a wall, mm; None where none was measured.
    """

    plays: dict[str, tuple[float, float]] = field(default_factory=dict)
    off: tuple[float, float] | None = None

    def pin(
        self, name: str, diameter: float, own: float | str, *, member: bool = False, joint: str = ""
    ) -> Contributor:
        """A joint with the plays that were measured of it."""
        found = super().pin(name, diameter, own, member=member, joint=joint)
        plays = self.plays.get(joint or name)
        if plays is None:
            return found
        zone = Zone(*plays, self.settings.distribution)
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
    build: Build, pairs: Sequence[Pairing], found: Sequence[Correction]
) -> MeasuredTolerances:
    """What was measured as tolerances."""
    plays: dict[str, tuple[float, float]] = {}
    for pair in pairs:
        own = [max(float(pair.plays[i, j]), 0.0) for i, j in pair.chosen]
        for joint in pair.joints:
            known = plays.get(joint, (own[0], own[0]))
            plays[joint] = (min(*own, known[0]), max(*own, known[1]))
    ends = [one.off + sign * SIGMAS * one.error for one in found for sign in (-1, 1)]
    asked = build.design.table(TolerancesTable)
    return MeasuredTolerances(asked.settings, asked.own, plays, (min(ends), max(ends)) if ends else None)


def as_measured(build: Build, pairs: Sequence[Pairing], found: Sequence[Correction]) -> list[ComparedOutput]:
    """The outputs of the family's analysis; none where it has none."""
    return compared(build, measured_tolerances(build, pairs, found))
