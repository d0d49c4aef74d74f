"""The family ``elliptic-gears``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.requirements import REQUIREMENTS, TrainRequirement

if TYPE_CHECKING:
    import shapely

    from mechwright import (
        AsMade,
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
    from mechwright.contracts.evaluation import Batch, Columns


class EllipticGears(Family[EllipticGearParams]):
    """Congruent elliptic gears that turn about their foci: a pair, or a train of two."""

    name = "elliptic-gears"
    title = "Elliptic gears"
    summary = "A pair of congruent elliptic gears, or a train of two whose coupler draws a figure of eight."
    Params = EllipticGearParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = REQUIREMENTS
    batch: ClassVar[int] = 100_000

    def check(self, params: EllipticGearParams) -> Sequence[Finding]:
        """Undercut, tips, roots, bore, phase, pressure angle at the shaft, and the mesh proof."""
        from mechwright_elliptic_gears.rules.checks import findings

        return findings(params)

    def judge(self, params: EllipticGearParams) -> Sequence[Finding]:
        """The same without the mesh proof."""
        from mechwright_elliptic_gears.rules.checks import judged

        return judged(params)

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
        from mechwright_elliptic_gears.rules.checks import findings

        refuse(findings(params), Stage.PARTS)
        return parts_of(params)

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

    def evaluate(
        self, batch: "Batch[EllipticGearParams]", columns: Collection[str], stage: Stage = Stage.PARTS
    ) -> "Columns":
        """Teeth, rims and figures of many pairs by formulas."""
        from mechwright.contracts.by_arrays import by_arrays
        from mechwright_elliptic_gears.evaluation import answer

        return by_arrays(self, batch, columns, stage, answer, chunk=self.batch)

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":
        """The end of the figure of eight."""
        from mechwright_elliptic_gears.synthesis.targets import targets_of

        if not isinstance(requirement, TrainRequirement):
            return super().targets(kind, requirement)
        return targets_of(requirement)
