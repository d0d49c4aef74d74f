"""The family ``elliptic-gears``."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.requirements import REQUIREMENTS, TrainRequirement

if TYPE_CHECKING:
    import shapely

    from mechwright import (
        AsMade,
        Channel,
        GroundPlate,
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
    from mechwright.contracts.axial_stack import AxialStack
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure, PartMass
    from mechwright.contracts.rule_list import Rules
    from mechwright_elliptic_gears.table import GearTable


class EllipticGears(Family[EllipticGearParams]):
    """Congruent elliptic gears that turn about their foci: a pair, or a train of two."""

    name = "elliptic-gears"
    title = "Elliptic gears"
    summary = "A pair of congruent elliptic gears, or a train of two whose coupler draws a figure of eight."
    size_keys: ClassVar[Mapping[str, float]] = {"semi_major": 50.0}
    Params = EllipticGearParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = REQUIREMENTS
    batch: ClassVar[int] = 100_000

    block: ClassVar[int] = 1 << 14
    counts: ClassVar[frozenset[str]] = frozenset({"teeth"})
    structure: ClassVar[frozenset[str]] = frozenset(
        {"keyway_width", "keyway_depth", "keyway_relief", "tooth_offset", "clamp_screw"}
    )

    def rules(self) -> "Rules[GearTable]":
        """Rack, undercut, tips, bore, point Q, phase, pressure angle at the shaft, mesh proof, strength."""
        from mechwright_elliptic_gears.rules.rule_table import RULES

        return RULES

    def table(self, params: EllipticGearParams, size: int | None = None) -> "GearTable":
        """The gears with their backlash."""
        from mechwright_elliptic_gears.table import table_of

        return table_of(params, size)

    def solve(self, params: EllipticGearParams, samples: int) -> "Motion":
        """One turn of gear 2 at constant speed."""
        from mechwright_elliptic_gears.kinematics.motion import motion_of

        return motion_of(params, samples)

    def stretches(self, params: EllipticGearParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_elliptic_gears.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, params), samples)

    def parts(self, params: EllipticGearParams) -> "Sequence[Part]":
        """The gears, and of a train all that carries and joins them."""
        from mechwright_elliptic_gears.parts.gear_parts import parts_of

        refuse(self.check(params), Stage.PARTS)
        return parts_of(params)

    def stacks(self, params: EllipticGearParams) -> "Sequence[AxialStack]":
        """Play of the gears of a train on their shafts, and float of its input's shaft."""
        from mechwright_elliptic_gears.parts.gear_parts import stacks_of

        return stacks_of(params)

    def mounting(self, params: EllipticGearParams) -> "Mounting | GroundPlate":
        """The shafts of a pair; of a train its base plate."""
        from mechwright_elliptic_gears.parts.mounting import mounting_of

        return mounting_of(params)

    def transmission(self, params: EllipticGearParams) -> "Transmission":
        """A pair: gear 2 in, gear 4 out."""
        from mechwright_elliptic_gears.kinematics.transmission import PairStage

        return PairStage(params)

    def settings(self, params: EllipticGearParams) -> Mapping[str, EllipticGearParams]:
        """The other phases that the joint of gears 3 and 4 is set to."""
        return {
            f"phase = {phase:g} deg": params.model_copy(update={"phase": phase})
            for phase in (params.set_phases if params.adjustable else ())
            if (phase - params.phase_degrees) % 360 != 0
        }

    def check_cut(
        self, params: EllipticGearParams, cut: "Mapping[str, shapely.Polygon]"
    ) -> Sequence[Finding]:
        """Whether pairs of the gear as cut still mesh, and its key goes in."""
        from mechwright_elliptic_gears.as_made.cut import cut_findings

        return cut_findings(params, cut)

    def as_made(self, params: EllipticGearParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Play, transmission error and backlash of each pair, and whether it jams."""
        from mechwright_elliptic_gears.as_made.pairs import as_made

        return as_made(params, made)

    def tolerances(self, params: EllipticGearParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Play and transmission error, from walls, centre distances and run-out."""
        from mechwright_elliptic_gears.as_made.tolerances import GearTolerances

        return GearTolerances(params, tolerances)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[EllipticGearParams]":
        """Trains with the longest near-constant speed of Q, or with one at the least acceleration or jerk."""
        from mechwright_elliptic_gears.synthesis.trains import synthesise

        return synthesise(kind, REQUIREMENTS[kind].model_validate(requirement.model_dump()), progress)

    def figures(self, table: "DesignTable[EllipticGearParams]") -> "Mapping[str, Figure]":
        """Distance, speeds of the last gear, peaks of Q and its window, pressure angle."""
        from mechwright_elliptic_gears.kinematics.figures import figures_of

        return figures_of(cast("GearTable", table))

    def channels(self, table: "DesignTable[EllipticGearParams]", samples: int) -> "Mapping[str, Channel]":
        """Angles and rates of gears and coupler, motion of Q, pressure angle."""
        from mechwright_elliptic_gears.kinematics.motion import channels_of

        return channels_of(cast("GearTable", table), samples)

    def masses(self, table: "DesignTable[EllipticGearParams]") -> "Mapping[str, PartMass] | None":
        """The two gears of pairs without keys."""
        from mechwright_elliptic_gears.parts.masses import masses_of

        return masses_of(cast("GearTable", table))

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":
        """The end of the figure of eight."""
        from mechwright_elliptic_gears.synthesis.targets import targets_of

        if not isinstance(requirement, TrainRequirement):
            return super().targets(kind, requirement)
        return targets_of(requirement)
