"""The family ``spur-gears``."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Finding, Stage, refuse
from mechwright_spur_gears.parameters import SpurGearParams

if TYPE_CHECKING:
    import shapely

    from mechwright import AsMade, Channel, MadePart, Motion, Mounting, Part, Transmission
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure
    from mechwright.contracts.rule_list import Rules
    from mechwright_spur_gears.gear_table import GearTable


class SpurGears(Family[SpurGearParams]):
    """Involute gears: two of them, one in a ring, a planetary set, or a rack and pinion."""

    name = "spur-gears"
    title = "Spur gears"
    summary = (
        "Involute gears with profile shift, at the centre distance that you have; rings, planetary sets, "
        "racks."
    )
    size_keys: ClassVar[Mapping[str, float]] = {"module": 2.0}
    Params = SpurGearParams
    batch: ClassVar[int] = 1 << 16
    counts: ClassVar[frozenset[str]] = frozenset({"teeth", "mate_teeth", "ring_teeth", "rack_teeth"})
    structure: ClassVar[frozenset[str]] = frozenset({"keyway_width", "keyway_depth", "keyway_relief"})

    def rules(self) -> "Rules[GearTable]":
        """Distance, assembly, shifts, undercut, tips, contact, interference, bores, mesh proofs, strength."""
        from mechwright_spur_gears.rules.rule_table import RULES

        return RULES

    def table(self, params: SpurGearParams, size: int | None = None) -> "GearTable":
        """The gears with their shifts and their backlash."""
        from mechwright_spur_gears.gear_table import table_of

        return table_of(params, size)

    def solve(self, params: SpurGearParams, samples: int) -> "Motion":
        """One turn of the driver at constant speed, or a rack there and back."""
        from mechwright_spur_gears.kinematics.motion import motion_of

        refuse(self.judge(params), Stage.MOTION)
        return motion_of(self.table(params), samples)

    def stretches(self, params: SpurGearParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_spur_gears.kinematics.motion import motion_of

        refuse(self.judge(params), Stage.MOTION)
        return in_stretches(partial(motion_of, self.table(params)), samples)

    def parts(self, params: SpurGearParams) -> "Sequence[Part]":
        """The gears, a rack, and of a planetary set its carrier and pins."""
        from mechwright_spur_gears.parts.parts import parts_of

        refuse(self.check(params), Stage.PARTS)
        return parts_of(self.table(params))

    def mounting(self, params: SpurGearParams) -> "Mounting":
        """Both shafts."""
        from mechwright_spur_gears.parts.mounting import mounting_of

        return mounting_of(self.table(params))

    def transmission(self, params: SpurGearParams) -> "Transmission":
        """Driver in, driven gear out."""
        from mechwright_spur_gears.kinematics.transmission import PairStage

        return PairStage(self.table(params))

    def check_cut(self, params: SpurGearParams, cut: "Mapping[str, shapely.Polygon]") -> Sequence[Finding]:
        """Whether the gears as cut still mesh, and their keys go in."""
        from mechwright_spur_gears.parts.as_made import cut_findings

        return cut_findings(self.table(params), cut)

    def as_made(self, params: SpurGearParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Play, transmission error and backlash of every pair, and whether it jams."""
        from mechwright_spur_gears.parts.as_made import as_made

        return as_made(self.table(params), made)

    def figures(self, table: "DesignTable[SpurGearParams]") -> "Mapping[str, Figure]":
        """Sizes, contact ratio, sliding."""
        from mechwright_spur_gears.kinematics.motion import figures_of

        return figures_of(cast("GearTable", table))

    def channels(self, table: "DesignTable[SpurGearParams]", samples: int) -> "Mapping[str, Channel]":
        """Angles of driver and driven gear, and of planets, with their rates."""
        from mechwright_spur_gears.kinematics.motion import table_channels

        return table_channels(cast("GearTable", table), samples)
