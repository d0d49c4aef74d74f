"""The family ``geneva``."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import DesignError, Family, Finding, Parameters, Stage, refuse
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.requirements import IndexingRequirement

if TYPE_CHECKING:
    from mechwright import (
        AsMade,
        Channel,
        MadePart,
        Motion,
        Mounting,
        Part,
        Progress,
        Synthesis,
        Target,
        ToleranceModel,
        Tolerances,
        Transmission,
    )
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure, PartMass
    from mechwright.contracts.rule_list import Rules
    from mechwright_geneva.kinematics.mechanism import Mechanism


class Geneva(Family[GenevaParams]):
    """A driver with rollers that turns a slotted wheel from rest to rest."""

    name = "geneva"
    title = "Geneva mechanism"
    summary = "An indexing wheel whose straight or curved slots give it a motion law, with its driver."
    size_keys: ClassVar[Mapping[str, float]] = {"entry_radius": 100.0}
    Params = GenevaParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {"indexing": IndexingRequirement}
    batch: ClassVar[int] = 100_000

    structure: ClassVar[frozenset[str]] = frozenset({"keyway_width", "driver_keyway_width", "keyway_relief"})

    def rules(self) -> "Rules[Mechanism]":
        """Law, angles, slots, islands, locking, driver, motion against the straight slot, contact."""
        from mechwright_geneva.rules.rule_table import RULES

        return RULES

    def table(self, params: GenevaParams, size: int | None = None) -> "Mechanism":
        """The mechanism with the dimensions that a design leaves open."""
        from mechwright_geneva.defaults.dimensions import table_of

        return table_of(params, size)

    def draft(self, source: str, text: str) -> GenevaParams:  # noqa: ARG002 - it reads no file
        """Straight slots through the plate, or the law that is named."""
        from typing import get_args

        from mechwright_geneva.parameters import LawName

        laws = [law for law in get_args(LawName) if law not in {"polynomial", "table"}]
        law = source or "straight"
        if law not in laws:
            raise DesignError(
                f"--from: {source!r} is not known; a Geneva wheel begins with: {', '.join(laws)}"
            )
        return GenevaParams(law=law)

    def remedy(self, params: GenevaParams, finding: Finding) -> Finding:
        """Another offset angle or roller, or sizes to leave out, that have been tried."""
        from mechwright_geneva.rules.remedies import with_remedy

        return with_remedy(params, finding)

    def solve(self, params: GenevaParams, samples: int) -> "Motion":
        """One turn of the driver, from the first entry."""
        from mechwright_geneva.kinematics.motion import motion_of

        return motion_of(params, samples)

    def stretches(self, params: GenevaParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_geneva.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, params), samples)

    def parts(self, params: GenevaParams) -> "Sequence[Part]":
        """Wheel, driver and rollers."""
        from mechwright_geneva.parts.parts import parts_of

        refuse(self.check(params), Stage.PARTS)
        return parts_of(params)

    def mounting(self, params: GenevaParams) -> "Mounting":
        """The shafts of wheel and driver."""
        from mechwright_geneva.parts.mounting import mounting_of

        return mounting_of(params)

    def transmission(self, params: GenevaParams) -> "Transmission":
        """Driver in, wheel out."""
        from mechwright_geneva.kinematics.transmission import WheelStage

        return WheelStage(params)

    def as_made(self, params: GenevaParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Roller in its slot, error of the wheel in motion, and the lock."""
        from mechwright_geneva.as_made.slot import as_made

        return as_made(params, made)

    def tolerances(self, params: GenevaParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the wheel's angle, and its plays in the slot and in the lock."""
        from mechwright_geneva.as_made.tolerances import GenevaTolerances

        return GenevaTolerances(params, tolerances)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[GenevaParams]":
        """Law, angles and roller for a number of stops, a time, a space and a load."""
        from mechwright_geneva.synthesis.indexing import from_indexing

        if not isinstance(requirement, IndexingRequirement):
            return super().synthesise(kind, requirement, progress)
        return from_indexing(requirement, progress)

    def figures(self, table: "DesignTable[GenevaParams]") -> "Mapping[str, Figure]":
        """Sizes, times, peaks of the law and of the contact."""
        from mechwright_geneva.kinematics.figures import figures

        return figures(cast("Mechanism", table))

    def channels(self, table: "DesignTable[GenevaParams]", samples: int) -> "Mapping[str, Channel]":
        """Angles, rates, and what the contact bears."""
        from mechwright_geneva.kinematics.motion import channels_of, turn_of

        m = cast("Mechanism", table)
        return channels_of(m, turn_of(m, samples))

    def masses(self, table: "DesignTable[GenevaParams]") -> "Mapping[str, PartMass] | None":
        """Wheel, hub, locking disc, crank and rollers."""
        from mechwright_geneva.parts.masses import masses_of

        return masses_of(cast("Mechanism", table))

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":
        """The size that is given, and the angle of the driver that the time of a move comes to."""
        from mechwright_geneva.synthesis.targets import targets_of

        if not isinstance(requirement, IndexingRequirement):
            return super().targets(kind, requirement)
        return targets_of(requirement)
