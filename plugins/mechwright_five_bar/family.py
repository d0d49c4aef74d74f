"""The family ``five-bar``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Parameters, refuse
from mechwright_five_bar.defaults.complete_parameters import CompleteParams
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.requirements import AdjustablePathRequirement

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
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure, PartMass
    from mechwright.contracts.rule_list import Rules
    from mechwright_five_bar.table import FiveBarTable


class FiveBars(Family[FiveBarParams]):
    """A crank and an arm that gears turn with it drive a coupler and a rocker."""

    name = "five-bar"
    title = "Geared five-bar linkage"
    summary = "A crank, an arm that gears turn with it, and a coupler that carries a point between them."
    size_keys: ClassVar[Mapping[str, float]] = {
        "crank": 24.0,
        "coupler": 82.0,
        "rocker": 82.0,
        "arm": 24.0,
        "ground": 105.0,
        "coupler_point_x": 40.0,
        "coupler_point_y": 30.0,
    }
    Params = CompleteParams
    batch = 1 << 16
    requirements: ClassVar = {"adjustable-path": AdjustablePathRequirement}

    def rules(self) -> "Rules[FiveBarTable]":
        """Setting, closure, transmission angle, gears, room for holes and slots, layers, loads, clamps."""
        from mechwright_five_bar.rules.rule_table import RULES

        return RULES

    def table(self, params: FiveBarParams, size: int | None = None) -> "FiveBarTable":
        """The linkage with its phases, and with gears that bear their load."""
        from mechwright_five_bar.table import FiveBarTable

        return FiveBarTable.of(params, size)

    def solve(self, params: FiveBarParams, samples: int) -> "Motion":
        """The turns of the crank that bring the linkage back, or its swing there and back."""
        from mechwright_five_bar.kinematics.motion import motion_of

        return motion_of(self.table(params), samples)

    def stretches(self, params: FiveBarParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_five_bar.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, self.table(params)), samples)

    def parts(self, params: FiveBarParams) -> "Sequence[Part]":
        """Ground, gears and links as plates, their shafts, pins, studs, bushings, clamps and posts."""
        from mechwright_five_bar.parts.parts import parts_of

        refuse(self.check(params))
        return parts_of(self.table(params))

    def mounting(self, params: FiveBarParams) -> "GroundPlate":
        """Its ground plate with the crank's shaft."""
        from mechwright_five_bar.parts.mounting import mounting_of

        return mounting_of(self.table(params))

    def transmission(self, params: FiveBarParams) -> "Transmission":
        """Crank in; nothing behind."""
        from mechwright_five_bar.kinematics.transmission import CouplerStage

        return CouplerStage(self.table(params))

    def settings(self, params: FiveBarParams) -> Mapping[str, FiveBarParams]:
        """The other phases that the pivots of the coupler and the arm's gear are set to."""
        from mechwright.mechanics.linkage.other_phases import other_phases

        return other_phases(params)

    def as_made(self, params: FiveBarParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Error of the coupler point, from bores and pins."""
        from mechwright_five_bar.as_made.bores import as_made

        return as_made(self.table(params), made)

    def tolerances(self, params: FiveBarParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the coupler point, from links, pins and the play of the gears."""
        from mechwright_five_bar.as_made.tolerances import FiveBarTolerances

        return FiveBarTolerances(self.table(params), tolerances)

    def figures(self, table: "DesignTable[FiveBarParams]") -> "Mapping[str, Figure]":
        """Transmission, swing or turns, peaks, and masses of bodies."""
        from mechwright_five_bar.kinematics.figures import figures_of
        from mechwright_five_bar.parts.masses import body_masses

        m = cast("FiveBarTable", table)
        return figures_of(m) | body_masses(m)

    def extremes(
        self, table: "DesignTable[FiveBarParams]", names: Collection[str]
    ) -> "Mapping[str, tuple[Array, Array, str]]":
        """Angles, rates and the coupler point; forces need the masses of the parts."""
        from mechwright_five_bar.kinematics.channels import extremes_of

        return extremes_of(cast("FiveBarTable", table), names)

    def masses(self, table: "DesignTable[FiveBarParams]") -> "Mapping[str, PartMass] | None":
        """Plates, gears, pins, bushings and posts of designs of one phase."""
        from mechwright_five_bar.parts.masses import masses_of

        return masses_of(cast("FiveBarTable", table))

    def synthesise(
        self,
        kind: str,  # noqa: ARG002 - there is one
        requirement: Parameters,
        progress: "Progress",
    ) -> "Synthesis[FiveBarParams]":
        """Machines whose coupler point follows a path in each of several phases."""
        from mechwright_five_bar.synthesis.adjustable import through_phases

        return through_phases(AdjustablePathRequirement.model_validate(requirement), progress)
