"""The family ``slider-crank``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Parameters, refuse
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.requirements import (
    PathRequirement,
    PolesRequirement,
    StrokeRequirement,
)

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
        Target,
        ToleranceModel,
        Tolerances,
        Transmission,
    )
    from mechwright.contracts.axial_stack import AxialStack
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure, PartMass
    from mechwright.contracts.motion import Channel
    from mechwright.contracts.rule_list import Rules
    from mechwright_slider_crank.kinematics.mechanism import Mechanism
    from mechwright_slider_crank.table import SliderCrankTable


class SliderCrankFamily(Family[SliderCrankParams]):
    """A turning crank moves a slider to and fro by a rod."""

    name = "slider-crank"
    title = "Slider-crank"
    summary = "A crank and a rod move a slider on a straight guide, central or offset, with a quick return."
    size_keys: ClassVar[Mapping[str, float]] = {"crank": 30.0, "rod": 100.0, "offset": 10.0}
    Params = SliderCrankParams
    batch = 1 << 16
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {
        "stroke": StrokeRequirement,
        "poles": PolesRequirement,
        "path": PathRequirement,
    }

    def rules(self) -> "Rules[Mechanism]":
        """Closure, full turn, transmission angle, walls, layers, strength, and the figures worth knowing."""
        from mechwright_slider_crank.rules.rule_table import RULES

        return RULES

    def table(self, params: SliderCrankParams, size: int | None = None) -> "SliderCrankTable":
        """The linkage with its machine and its sizes."""
        from mechwright_slider_crank.table import SliderCrankTable

        return SliderCrankTable.of(params, size)

    def solve(self, params: SliderCrankParams, samples: int) -> "Motion":
        """One turn of the crank at constant speed."""
        from mechwright_slider_crank.kinematics.motion import motion_of

        return motion_of(self.table(params), samples)

    def stretches(self, params: SliderCrankParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_slider_crank.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, self.table(params)), samples)

    def parts(self, params: SliderCrankParams) -> "Sequence[Part]":
        """Base, rails, crank, rod, slider, and the turned parts that join them."""
        from mechwright_slider_crank.parts.parts import parts_of

        refuse(self.check(params))
        return parts_of(self.table(params))

    def stacks(self, params: SliderCrankParams) -> "Sequence[AxialStack]":
        """The float of the crank's shaft, where a circlip holds it."""
        from mechwright_slider_crank.parts.base import shaft_stacks
        from mechwright_slider_crank.parts.plates import layout_of

        table = self.table(params)
        low, high = layout_of(table).stack.spans["shaft"]
        return tuple(shaft_stacks(table, high - low))

    def mounting(self, params: SliderCrankParams) -> "GroundPlate":
        """The base, if it has holes for the screws of legs."""
        from mechwright_slider_crank.parts.mounting import mounting_of

        return mounting_of(self.table(params))

    def transmission(self, params: SliderCrankParams) -> "Transmission":
        """Crank in; the slider is no shaft."""
        from mechwright_slider_crank.kinematics.stage import SliderStage

        return SliderStage(self.table(params))

    def as_made(self, params: SliderCrankParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Error of the slider, and its play in the guide."""
        from mechwright_slider_crank.as_made.plates import as_made

        return as_made(self.table(params), made)

    def tolerances(self, params: SliderCrankParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the slider's position and of the coupler point, from links, pins and guide."""
        from mechwright_slider_crank.as_made.tolerances import SliderCrankTolerances

        return SliderCrankTolerances(self.table(params), tolerances)

    def figures(self, table: "DesignTable[SliderCrankParams]") -> "Mapping[str, Figure]":
        """Ends of the stroke, transmission angle, peaks, masses and balance."""
        from mechwright_slider_crank.kinematics.figures import figures

        return figures(cast("Mechanism", table))

    def channels(self, table: "DesignTable[SliderCrankParams]", samples: int) -> "Mapping[str, Channel]":
        """What crank, rod, slider and the rod's point do."""
        from mechwright_slider_crank.kinematics.motion import channels_over

        return channels_over(cast("Mechanism", table), samples)

    def extremes(
        self, table: "DesignTable[SliderCrankParams]", names: Collection[str]
    ) -> "Mapping[str, tuple[Array, Array, str]]":
        """Those of compiled motion; of linkages at their limits those of samples."""
        from mechwright_slider_crank.kinematics.extremes import extremes

        found = extremes(cast("Mechanism", table), names)
        rest = [name for name in names if name not in found]
        return {**found, **super().extremes(table, rest)} if rest else found

    def masses(self, table: "DesignTable[SliderCrankParams]") -> "Mapping[str, PartMass] | None":
        """Of designs with a disc and a straight rod."""
        from mechwright_slider_crank.parts.masses import masses_of

        return masses_of(cast("Mechanism", table))

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[SliderCrankParams]":
        """From stroke and time ratio, from acceleration poles, or from a path of the rod's point."""
        from mechwright_slider_crank.synthesis.designs import from_poles, from_stroke

        if isinstance(requirement, StrokeRequirement):
            return from_stroke(requirement)
        if isinstance(requirement, PolesRequirement):
            return from_poles(requirement, progress)
        if isinstance(requirement, PathRequirement):
            from mechwright_slider_crank.synthesis.paths.synthesis import through_points

            return through_points(requirement, progress)
        return super().synthesise(kind, requirement, progress)

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":
        """The ends of the stroke, or the poles."""
        if not isinstance(requirement, StrokeRequirement):
            return super().targets(kind, requirement)
        from mechwright_slider_crank.synthesis.targets import ends_of

        return ends_of(requirement)
