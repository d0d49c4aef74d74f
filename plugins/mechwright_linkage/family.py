"""The family ``linkage``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Parameters, Stage, refuse
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.requirements import DwellRequirement, FunctionRequirement, PathRequirement

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
    from mechwright.contracts.figure import Figure
    from mechwright.contracts.motion import Channel
    from mechwright.contracts.rule_list import Rules
    from mechwright_linkage.table import LinkageTable


class Linkages(Family[LinkageParams]):
    """Any links, pins and slides in a plane that one input moves."""

    name = "linkage"
    title = "Planar linkage"
    summary = "Six-bars, quick returns, straight lines, walking legs, or any linkage as it is drawn."
    Params: type[LinkageParams] = LinkageParams
    batch: ClassVar[int] = 1 << 16
    block: ClassVar[int] = 4096
    sampled: ClassVar[int] = 16
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {
        "function": FunctionRequirement,
        "dwell": DwellRequirement,
        "path": PathRequirement,
    }

    def rules(self) -> "Rules[LinkageTable]":
        """Joints, range of the input, transmission angles, bores, layers, strength."""
        from mechwright_linkage.rules.rule_table import RULES

        return RULES

    def table(self, params: LinkageParams, size: int | None = None) -> "LinkageTable":
        """The linkage with its machine and its motion."""
        from mechwright_linkage.table import LinkageTable

        return LinkageTable.of(params, size)

    def solve(self, params: LinkageParams, samples: int) -> "Motion":
        """One turn of the driver at constant speed, or its way there and back."""
        from mechwright.mechanics.linkage.kinematics.motion import motion_of
        from mechwright_linkage.rules.motion_rules import moving

        return motion_of(moving(self.table(params)), samples)

    def stretches(self, params: LinkageParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright.mechanics.linkage.kinematics.motion import motion_of
        from mechwright_linkage.rules.motion_rules import moving

        return in_stretches(partial(motion_of, moving(self.table(params))), samples)

    def parts(self, params: LinkageParams) -> "Sequence[Part]":
        """Links and ground as plates, their pins and bushings."""
        from mechwright.mechanics.linkage.parts.parts import parts_of

        refuse(self.check(params), Stage.PARTS)
        return parts_of(self.table(params).layout)

    def stacks(self, params: LinkageParams) -> "Sequence[AxialStack]":
        """The float of the driven link's shaft, where a circlip holds it."""
        from mechwright.mechanics.linkage.parts.retention import stacks_of

        return tuple(stacks_of(self.table(params).layout))

    def mounting(self, params: LinkageParams) -> "GroundPlate":
        """Its ground plate with the driver's shaft."""
        from mechwright.mechanics.linkage.parts.mounting import mounting_of

        return mounting_of(self.table(params).layout)

    def draft(self, source: str, text: str) -> LinkageParams:
        """A linkage of the catalogue, or one that a file or an address of another program draws."""
        from mechwright_linkage.drafts import draft_of

        return draft_of(source, text, self.Params)

    def design_targets(self, params: LinkageParams) -> "Sequence[Target]":
        """The points of a drawn linkage in its drawn position."""
        from mechwright_linkage.sketch.drag import point_handles

        return point_handles(params)

    def transmission(self, params: LinkageParams) -> "Transmission":
        """Driver in, output out."""
        from mechwright.mechanics.linkage.kinematics.transmission import OutputStage
        from mechwright_linkage.rules.motion_rules import moving

        return OutputStage(moving(self.table(params)))

    def tolerances(self, params: LinkageParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the output and of traced points."""
        from mechwright.mechanics.linkage.tolerance.model import LinkageTolerances

        return LinkageTolerances(self.table(params), tolerances)

    def as_made(self, params: LinkageParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Errors and play with bores and slots as the programs leave them."""
        from mechwright.mechanics.linkage.tolerance.as_made import as_made

        return as_made(self.table(params), made)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[LinkageParams]":
        """Linkages of the catalogue that answer angles, dwell, or lead a point along a path."""
        from mechwright_linkage.synthesis.designs import answering, dwelling, leading

        if isinstance(requirement, FunctionRequirement):
            return answering(requirement, progress)
        if isinstance(requirement, DwellRequirement):
            return dwelling(requirement, progress)
        if isinstance(requirement, PathRequirement):
            return leading(requirement, progress)
        return super().synthesise(kind, requirement, progress)

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":
        """The end of a dwell and a stroke, the outputs of a function, or the points of a path."""
        from mechwright_linkage.synthesis.targets import dwell_targets, function_targets

        if isinstance(requirement, DwellRequirement):
            return dwell_targets(requirement)
        if isinstance(requirement, FunctionRequirement):
            return function_targets(requirement)
        return super().targets(kind, requirement)

    def figures(self, table: "DesignTable[LinkageParams]") -> "Mapping[str, Figure]":
        """Transmission angles, output and paths."""
        from mechwright.mechanics.linkage.kinematics.figures import figures_of

        return figures_of(cast("LinkageTable", table))

    def channels(self, table: "DesignTable[LinkageParams]", samples: int) -> "Mapping[str, Channel]":
        """What input, links, slides and points do."""
        from mechwright.mechanics.linkage.kinematics.motion import channels_over

        return channels_over(cast("LinkageTable", table), samples)

    def extremes(
        self, table: "DesignTable[LinkageParams]", names: Collection[str]
    ) -> "Mapping[str, tuple[Array, Array, str]]":
        """Those of compiled motion, and of the channels of blocks for what that does not have."""
        from mechwright.mechanics.linkage.kinematics.channel_extremes import compiled_extremes

        found = compiled_extremes(cast("LinkageTable", table), names)
        rest = [name for name in names if name not in found]
        return {**found, **super().extremes(table, rest)} if rest else found
