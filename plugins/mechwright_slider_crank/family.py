"""The family ``slider-crank``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.requirements import (
    PathRequirement,
    PolesRequirement,
    StrokeRequirement,
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
        Target,
        ToleranceModel,
        Tolerances,
        Transmission,
    )
    from mechwright.contracts.evaluation import Batch, Columns


class SliderCrankFamily(Family[SliderCrankParams]):
    """A turning crank moves a slider to and fro by a rod."""

    name = "slider-crank"
    title = "Slider-crank"
    summary = "A crank and a rod move a slider on a straight guide, central or offset, with a quick return."
    Params = SliderCrankParams
    batch = 1 << 16
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {
        "stroke": StrokeRequirement,
        "poles": PolesRequirement,
        "path": PathRequirement,
    }

    def check(self, params: SliderCrankParams) -> Sequence[Finding]:
        """Full turn, transmission angle, walls, widths, layers, pins, and the figures worth knowing."""
        from mechwright_slider_crank.checks import findings

        return findings(params)

    def judge(self, params: SliderCrankParams) -> Sequence[Finding]:
        """The same without the sizes that would bear a load."""
        from mechwright_slider_crank.checks import judged

        return judged(params)

    def solve(self, params: SliderCrankParams, samples: int) -> "Motion":
        """One turn of the crank at constant speed."""
        from mechwright_slider_crank.motion import motion_of

        return motion_of(params, samples)

    def stretches(self, params: SliderCrankParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_slider_crank.motion import motion_of

        return in_stretches(partial(motion_of, params), samples)

    def parts(self, params: SliderCrankParams) -> "Sequence[Part]":
        """Base, rails, crank, rod, slider, and the turned parts that join them."""
        from mechwright_slider_crank.checks import findings
        from mechwright_slider_crank.plates import parts_of

        refuse(findings(params))
        return parts_of(params)

    def mounting(self, params: SliderCrankParams) -> "GroundPlate":
        """The base, if it has holes for the screws of legs."""
        from mechwright_slider_crank.mounting import mounting_of

        return mounting_of(params)

    def transmission(self, params: SliderCrankParams) -> "Transmission":
        """Crank in; the slider is no shaft."""
        from mechwright_slider_crank.stage import SliderStage

        return SliderStage(params)

    def as_made(self, params: SliderCrankParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Error of the slider, and its play in the guide."""
        from mechwright_slider_crank.as_made import as_made

        return as_made(params, made)

    def tolerances(self, params: SliderCrankParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the slider's position and of the coupler point, from links, pins and guide."""
        from mechwright_slider_crank.tolerances import SliderCrankTolerances

        return SliderCrankTolerances(params, tolerances)

    def evaluate(
        self, batch: "Batch[SliderCrankParams]", columns: Collection[str], stage: Stage = Stage.PARTS
    ) -> "Columns":
        """Many at once, where they have a disc and a straight rod; forces one by one."""
        from mechwright.contracts.by_arrays import by_arrays
        from mechwright_slider_crank.evaluation import answer

        return by_arrays(self, batch, columns, stage, answer)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[SliderCrankParams]":
        """From stroke and time ratio, from acceleration poles, or from a path of the rod's point."""
        from mechwright_slider_crank.synthesis import from_poles, from_stroke

        if isinstance(requirement, StrokeRequirement):
            return from_stroke(requirement)
        if isinstance(requirement, PolesRequirement):
            return from_poles(requirement, progress)
        if isinstance(requirement, PathRequirement):
            from mechwright_slider_crank.paths.synthesis import through_points

            return through_points(requirement, progress)
        return super().synthesise(kind, requirement, progress)

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":
        """The ends of the stroke, or the poles."""
        if not isinstance(requirement, StrokeRequirement):
            return super().targets(kind, requirement)
        from mechwright_slider_crank.targets import ends_of

        return ends_of(requirement)
