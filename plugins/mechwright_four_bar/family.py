"""The family ``four-bar``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Parameters, refuse
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.requirements import (
    AdjustablePathRequirement,
    PathRequirement,
    PolesRequirement,
    SwingRequirement,
)
from mechwright_four_bar.synthesis.burmester.requirements import FunctionRequirement, PosesRequirement
from mechwright_four_bar.synthesis.nine.requirement import NinePointsRequirement

if TYPE_CHECKING:
    from mechwright import (
        Array,
        AsMade,
        GroundPlate,
        MadePart,
        Motion,
        Part,
        Progress,
        Synthesis,
        ToleranceModel,
        Tolerances,
        Transmission,
    )
    from mechwright.contracts.axial_stack import AxialStack
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure, PartMass
    from mechwright.contracts.rule_list import Rules
    from mechwright_four_bar.table import FourBarTable


class FourBars(Family[FourBarParams]):
    """A crank, or a lever that rocks, drives a follower through a coupler."""

    name = "four-bar"
    title = "Four-bar linkage"
    summary = "A turning crank, a coupler and a rocking or turning follower on a ground plate."
    size_keys: ClassVar[Mapping[str, float]] = {
        "crank": 30.0,
        "coupler": 80.0,
        "follower": 70.0,
        "ground": 90.0,
    }
    Params = FourBarParams
    batch = 1 << 16
    block = 1 << 14
    requirements: ClassVar = {
        "path": PathRequirement,
        "nine-points": NinePointsRequirement,
        "adjustable-path": AdjustablePathRequirement,
        "poles": PolesRequirement,
        "poses": PosesRequirement,
        "function": FunctionRequirement,
        "swing": SwingRequirement,
    }

    def rules(self) -> "Rules[FourBarTable]":
        """Closure, rotation of the crank, transmission angle, room for bores and webs, layers, strength."""
        from mechwright_four_bar.rules.rule_table import RULES

        return RULES

    def table(self, params: FourBarParams, size: int | None = None) -> "FourBarTable":
        """The machine with its dimensions and its motion."""
        from mechwright_four_bar.table import FourBarTable

        return FourBarTable.of(params, size)

    def solve(self, params: FourBarParams, samples: int) -> "Motion":
        """One turn of the crank at constant speed, or its swing there and back."""
        from mechwright_four_bar.kinematics.motion import motion_of

        return motion_of(self.table(params), samples)

    def stretches(self, params: FourBarParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_four_bar.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, self.table(params)), samples)

    def parts(self, params: FourBarParams) -> "Sequence[Part]":
        """Ground, crank, coupler and follower as plates, their pins and bushings."""
        from mechwright.mechanics.linkage.parts.parts import parts_of
        from mechwright_four_bar.parts.marks import COLOURS, scales

        refuse(self.check(params))
        table = self.table(params)
        return parts_of(table.layout, COLOURS, scales(table.params))

    def stacks(self, params: FourBarParams) -> "Sequence[AxialStack]":
        """The float of the driven link's shaft, where a circlip holds it."""
        from mechwright.mechanics.linkage.parts.retention import stacks_of

        return tuple(stacks_of(self.table(params).layout))

    def mounting(self, params: FourBarParams) -> "GroundPlate":
        """Its one ground plate with the crank's shaft."""
        from mechwright.mechanics.linkage.parts.mounting import mounting_of

        return replace(mounting_of(self.table(params).layout), offset=None)

    def transmission(self, params: FourBarParams) -> "Transmission":
        """Crank in, follower out."""
        from mechwright_four_bar.kinematics.transmission import FollowerStage

        return FollowerStage(self.table(params))

    def settings(self, params: FourBarParams) -> Mapping[str, FourBarParams]:
        """The other phases that the pivots of the coupler are set to."""
        from mechwright.mechanics.linkage.other_phases import other_phases

        return other_phases(params)

    def as_made(self, params: FourBarParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Error of the follower and of the coupler point, from bores and pins."""
        from mechwright_four_bar.parts.tolerances import as_made

        return as_made(self.table(params), made)

    def tolerances(self, params: FourBarParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the follower's angle and of the coupler point, from links and pins."""
        from mechwright_four_bar.parts.tolerances import FourBarTolerances

        return FourBarTolerances(self.table(params), tolerances)

    def figures(self, table: "DesignTable[FourBarParams]") -> "Mapping[str, Figure]":
        """Transmission angles, limits, swings, peaks of the follower."""
        from mechwright_four_bar.kinematics.study import study_figures

        return study_figures(cast("FourBarTable", table))

    def extremes(
        self, table: "DesignTable[FourBarParams]", names: Collection[str]
    ) -> "Mapping[str, tuple[Array, Array, str]]":
        """Those of links and point, by compiled chains."""
        from mechwright_four_bar.kinematics.study import extremes

        return extremes(cast("FourBarTable", table), names)

    def masses(self, table: "DesignTable[FourBarParams]") -> "Mapping[str, PartMass]":
        """Those of the plates that no layer decides."""
        from mechwright_four_bar.kinematics.study import masses_of

        return masses_of(cast("FourBarTable", table))

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[FourBarParams]":
        """Linkages with wanted paths, poses, answers of the follower, or acceleration poles."""
        if kind == "path":
            from mechwright_four_bar.synthesis.paths.synthesis import through_points

            return through_points(PathRequirement.model_validate(requirement), progress)
        if kind == "nine-points":
            from mechwright_four_bar.synthesis.nine.synthesis import through_nine

            return through_nine(NinePointsRequirement.model_validate(requirement), progress)
        if kind == "adjustable-path":
            from mechwright_four_bar.synthesis.adjustable import through_phases

            return through_phases(AdjustablePathRequirement.model_validate(requirement), progress)
        if kind == "poses":
            from mechwright_four_bar.synthesis.burmester.guiding import through_poses

            return through_poses(PosesRequirement.model_validate(requirement), progress)
        if kind == "function":
            from mechwright_four_bar.synthesis.burmester.answering import through_angles

            return through_angles(FunctionRequirement.model_validate(requirement), progress)
        if kind == "swing":
            from mechwright_four_bar.synthesis.swing import swinging

            return swinging(SwingRequirement.model_validate(requirement), progress)
        from mechwright_four_bar.synthesis.poles.synthesis import through_poles

        return through_poles(PolesRequirement.model_validate(requirement), progress)
