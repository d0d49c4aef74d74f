"""The family ``four-bar``."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright.contracts.finding import errors
from mechwright_four_bar.burmester.requirements import FunctionRequirement, PosesRequirement
from mechwright_four_bar.nine.requirement import NinePointsRequirement
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.requirements import (
    AdjustablePathRequirement,
    PathRequirement,
    PolesRequirement,
    SwingRequirement,
)

if TYPE_CHECKING:
    from mechwright import (
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
    from mechwright.contracts.evaluation import Batch, Columns


class FourBars(Family[FourBarParams]):
    """A crank, or a lever that rocks, drives a follower through a coupler."""

    name = "four-bar"
    title = "Four-bar linkage"
    summary = "A turning crank, a coupler and a rocking or turning follower on a ground plate."
    Params = FourBarParams
    batch = 1 << 16
    requirements: ClassVar = {
        "path": PathRequirement,
        "nine-points": NinePointsRequirement,
        "adjustable-path": AdjustablePathRequirement,
        "poles": PolesRequirement,
        "poses": PosesRequirement,
        "function": FunctionRequirement,
        "swing": SwingRequirement,
    }

    def check(self, params: FourBarParams) -> Sequence[Finding]:
        """Closure, rotation of the crank, transmission angle, room for bores and webs, layers."""
        from mechwright_four_bar.checks import findings

        return _with_settings(params, findings)

    def judge(self, params: FourBarParams) -> Sequence[Finding]:
        """The same without the sizes that would bear a load."""
        from mechwright_four_bar.checks import judged

        return _with_settings(params, judged)

    def solve(self, params: FourBarParams, samples: int) -> "Motion":
        """One turn of the crank at constant speed, or its swing there and back."""
        from mechwright_four_bar.kinematics.motion import motion_of
        from mechwright_four_bar.parts.phases import in_phase

        return motion_of(in_phase(params), samples)

    def stretches(self, params: FourBarParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_four_bar.kinematics.motion import motion_of
        from mechwright_four_bar.parts.phases import in_phase

        return in_stretches(partial(motion_of, in_phase(params)), samples)

    def parts(self, params: FourBarParams) -> "Sequence[Part]":
        """Ground, crank, coupler and follower as plates, their pins and bushings."""
        from mechwright_four_bar.parts.phases import in_phase
        from mechwright_four_bar.parts.plates import parts_of

        refuse(self.check(params))
        return parts_of(in_phase(params))

    def mounting(self, params: FourBarParams) -> "GroundPlate":
        """Its one ground plate with the crank's shaft."""
        from mechwright_four_bar.mounting import mounting_of
        from mechwright_four_bar.parts.phases import in_phase

        return mounting_of(in_phase(params))

    def transmission(self, params: FourBarParams) -> "Transmission":
        """Crank in, follower out."""
        from mechwright_four_bar.kinematics.stage import FollowerStage

        return FollowerStage(params)

    def settings(self, params: FourBarParams) -> Mapping[str, FourBarParams]:
        """The other phases that the pivots of the coupler are set to."""
        from mechwright.mechanics.linkage.other_phases import other_phases

        return other_phases(params)

    def as_made(self, params: FourBarParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Error of the follower and of the coupler point, from bores and pins."""
        from mechwright_four_bar.as_made import as_made
        from mechwright_four_bar.parts.phases import in_phase

        return as_made(in_phase(params), made)

    def tolerances(self, params: FourBarParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the follower's angle and of the coupler point, from links and pins."""
        from mechwright_four_bar.parts.phases import in_phase
        from mechwright_four_bar.tolerances import FourBarTolerances

        return FourBarTolerances(in_phase(params), tolerances)

    def evaluate(
        self, batch: "Batch[FourBarParams]", columns: Collection[str], stage: Stage = Stage.PARTS
    ) -> "Columns":
        """Many at once, where they are plain and may have two ground plates; forces and masses one by one."""
        from mechwright.contracts.by_arrays import by_arrays
        from mechwright_four_bar.evaluation import answer

        return by_arrays(self, batch, columns, stage, answer)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[FourBarParams]":
        """Linkages with wanted paths, poses, answers of the follower, or acceleration poles."""
        if kind == "path":
            from mechwright_four_bar.paths.synthesis import through_points

            return through_points(PathRequirement.model_validate(requirement), progress)
        if kind == "nine-points":
            from mechwright_four_bar.nine.synthesis import through_nine

            return through_nine(NinePointsRequirement.model_validate(requirement), progress)
        if kind == "adjustable-path":
            from mechwright_four_bar.adjustable_synthesis import through_phases

            return through_phases(AdjustablePathRequirement.model_validate(requirement), progress)
        if kind == "poses":
            from mechwright_four_bar.burmester.guiding import through_poses

            return through_poses(PosesRequirement.model_validate(requirement), progress)
        if kind == "function":
            from mechwright_four_bar.burmester.answering import through_angles

            return through_angles(FunctionRequirement.model_validate(requirement), progress)
        if kind == "swing":
            from mechwright_four_bar.swing import swinging

            return swinging(SwingRequirement.model_validate(requirement), progress)
        from mechwright_four_bar.pole_synthesis import through_poles

        return through_poles(PolesRequirement.model_validate(requirement), progress)


def _with_settings(
    params: FourBarParams, findings: Callable[[FourBarParams], Sequence[Finding]]
) -> Sequence[Finding]:
    """What is found of the machine as it is set now, and of how it is set to other phases."""
    from mechwright_four_bar.parts.phases import in_phase
    from mechwright_four_bar.phase_checks import setting_findings

    own = tuple(setting_findings(params))
    if errors(own):
        return own
    return (*findings(in_phase(params)), *own)
