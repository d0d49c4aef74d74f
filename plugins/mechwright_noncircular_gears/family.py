"""The family ``noncircular-gears``."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.requirements import REQUIREMENTS, FitRequirement
from mechwright_noncircular_gears.sized import SizedParams

if TYPE_CHECKING:
    import shapely

    from mechwright import (
        AsMade,
        Channel,
        MadePart,
        Motion,
        Mounting,
        Part,
        Progress,
        Synthesis,
        Transmission,
    )
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure
    from mechwright.contracts.rule_list import Rules
    from mechwright_noncircular_gears.table import GearTable


class NoncircularGears(Family[NoncircularParams]):
    """Two gears whose pitch curves follow from a law of their speeds, or from the pitch curve of one."""

    name = "noncircular-gears"
    title = "Non-circular gears"
    summary = "A pair of gears that turns one shaft by any law of the other, with lobes of any numbers."
    size_keys: ClassVar[Mapping[str, float]] = {"module": 2.0}
    Params = SizedParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = REQUIREMENTS
    batch = 1 << 16
    structure: ClassVar[frozenset[str]] = frozenset({"keyway_width", "keyway_depth", "keyway_relief"})

    def rules(self) -> "Rules[GearTable]":
        """The law, pitch curves, bore, undercut, tips, rims, pressure angle at the shaft, mesh, strength."""
        from mechwright_noncircular_gears.rules.rule_table import RULES

        return RULES

    def table(self, params: NoncircularParams, size: int | None = None) -> "GearTable":
        """The pair with its law."""
        from mechwright_noncircular_gears.table import GearTable, table_of

        return table_of(params) if size is None else GearTable(params, size)

    def remedy(self, params: NoncircularParams, finding: Finding) -> Finding:
        """A softer law, more teeth or lower tips that have been tried."""
        from mechwright_noncircular_gears.rules.remedies import with_remedy

        return with_remedy(params, finding)

    def solve(self, params: NoncircularParams, samples: int) -> "Motion":
        """Turns of the driver at constant speed until both gears are back."""
        from mechwright_noncircular_gears.kinematics.motion import motion_of

        return motion_of(self.table(params), samples)

    def stretches(self, params: NoncircularParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_noncircular_gears.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, self.table(params)), samples)

    def parts(self, params: NoncircularParams) -> "Sequence[Part]":
        """Both gears."""
        from mechwright_noncircular_gears.parts.parts import parts_of

        refuse(self.check(params), Stage.PARTS)
        return parts_of(self.table(params))

    def mounting(self, params: NoncircularParams) -> "Mounting":
        """Both shafts."""
        from mechwright_noncircular_gears.parts.mounting import mounting_of

        return mounting_of(self.table(params))

    def transmission(self, params: NoncircularParams) -> "Transmission":
        """Driver in, driven gear out; DesignError for a ring, which has no shaft."""
        from mechwright_noncircular_gears.kinematics.transmission import PairStage

        return PairStage(self.table(params))

    def check_cut(self, params: NoncircularParams, cut: "Mapping[str, shapely.Polygon]") -> Sequence[Finding]:
        """Whether the pair as cut still meshes, and its keys go in."""
        from mechwright_noncircular_gears.parts.made import cut_findings

        return cut_findings(self.table(params), cut)

    def as_made(self, params: NoncircularParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Play, transmission error and backlash, and whether the pair jams."""
        from mechwright_noncircular_gears.parts.made import as_made

        return as_made(self.table(params), made)

    def figures(self, table: "DesignTable[NoncircularParams]") -> "Mapping[str, Figure]":
        """Ratios, peaks of the driven gear, pressure angle, centre distance."""
        from mechwright_noncircular_gears.kinematics.figures import figures

        return figures(cast("GearTable", table))

    def channels(self, table: "DesignTable[NoncircularParams]", samples: int) -> "Mapping[str, Channel]":
        """Angles of both gears and their rates, ratio, pitch radii, pressure angle."""
        from mechwright_noncircular_gears.kinematics.motion import channels

        return channels(cast("GearTable", table), samples)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[NoncircularParams]":
        """The law that a Geneva wheel, a slider, a quick return or a slow approach asks for."""
        from mechwright_noncircular_gears.synthesis.fitted_pair import from_wish

        if not isinstance(requirement, FitRequirement):
            return super().synthesise(kind, requirement, progress)
        return from_wish(requirement, progress)
