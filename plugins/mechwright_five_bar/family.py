"""The family ``five-bar``."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright.contracts.finding import errors
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.requirements import AdjustablePathRequirement
from mechwright_five_bar.sized import SizedParams

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


class FiveBars(Family[FiveBarParams]):
    """A crank and an arm that gears turn with it drive a coupler and a rocker."""

    name = "five-bar"
    title = "Geared five-bar linkage"
    summary = "A crank, an arm that gears turn with it, and a coupler that carries a point between them."
    Params = SizedParams
    batch = 1 << 16
    requirements: ClassVar = {"adjustable-path": AdjustablePathRequirement}

    def check(self, params: FiveBarParams) -> Sequence[Finding]:
        """Closure, transmission angle, gears, room for holes and slots, layers, clamps, order of setting."""
        from mechwright_five_bar.checks import findings

        return _with_settings(params, findings)

    def judge(self, params: FiveBarParams) -> Sequence[Finding]:
        """The same without the sizes that would bear a load."""
        from mechwright_five_bar.checks import judged

        return _with_settings(params, judged)

    def solve(self, params: FiveBarParams, samples: int) -> "Motion":
        """The turns of the crank that bring the linkage back, or its swing there and back."""
        from mechwright_five_bar.motion import motion_of
        from mechwright_five_bar.phases import in_phase

        return motion_of(in_phase(params), samples)

    def stretches(self, params: FiveBarParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_five_bar.motion import motion_of
        from mechwright_five_bar.phases import in_phase

        return in_stretches(partial(motion_of, in_phase(params)), samples)

    def parts(self, params: FiveBarParams) -> "Sequence[Part]":
        """Ground, gears and links as plates, their shafts, pins, studs, bushings, clamps and posts."""
        from mechwright_five_bar.phases import in_phase
        from mechwright_five_bar.plates import parts_of

        refuse(self.check(params))
        return parts_of(in_phase(params))

    def mounting(self, params: FiveBarParams) -> "GroundPlate":
        """Its ground plate with the crank's shaft."""
        from mechwright_five_bar.mounting import mounting_of
        from mechwright_five_bar.phases import in_phase

        return mounting_of(in_phase(params))

    def transmission(self, params: FiveBarParams) -> "Transmission":
        """Crank in; nothing behind."""
        from mechwright_five_bar.stage import CouplerStage

        return CouplerStage(params)

    def settings(self, params: FiveBarParams) -> Mapping[str, FiveBarParams]:
        """The other phases that the pivots of the coupler and the arm's gear are set to."""
        from mechwright.mechanics.linkage.other_phases import other_phases

        return other_phases(params)

    def as_made(self, params: FiveBarParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Error of the coupler point, from bores and pins."""
        from mechwright_five_bar.as_made import as_made
        from mechwright_five_bar.phases import in_phase

        return as_made(in_phase(params), made)

    def tolerances(self, params: FiveBarParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the coupler point, from links, pins and the play of the gears."""
        from mechwright_five_bar.phases import in_phase
        from mechwright_five_bar.tolerances import FiveBarTolerances

        return FiveBarTolerances(in_phase(params), tolerances)

    def evaluate(
        self, batch: "Batch[FiveBarParams]", columns: Collection[str], stage: Stage = Stage.PARTS
    ) -> "Columns":
        """Many at once, where the crank turns fully and gears stand in line; forces one by one."""
        from mechwright.contracts.by_arrays import by_arrays
        from mechwright_five_bar.evaluation import answer

        return by_arrays(self, batch, columns, stage, answer)

    def synthesise(
        self,
        kind: str,  # noqa: ARG002 - there is one
        requirement: Parameters,
        progress: "Progress",
    ) -> "Synthesis[FiveBarParams]":
        """Machines whose coupler point follows a path in each of several phases."""
        from mechwright_five_bar.adjustable_synthesis import through_phases

        return through_phases(AdjustablePathRequirement.model_validate(requirement), progress)


def _with_settings(
    params: FiveBarParams, findings: Callable[[FiveBarParams], Sequence[Finding]]
) -> Sequence[Finding]:
    """What is found of a design, unless it cannot be set to its phases."""
    from mechwright_five_bar.clamp_checks import setting_findings
    from mechwright_five_bar.phases import in_phase

    own = tuple(setting_findings(params))
    return own if errors(own) else (*findings(in_phase(params)), *own)
