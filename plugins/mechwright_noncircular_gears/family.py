"""The family ``noncircular-gears``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright_noncircular_gears.fit.requirements import REQUIREMENTS, FitRequirement
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.sized import SizedParams

if TYPE_CHECKING:
    import shapely

    from mechwright import AsMade, MadePart, Motion, Mounting, Part, Progress, Synthesis, Transmission
    from mechwright.contracts.evaluation import Batch, Columns


class NoncircularGears(Family[NoncircularParams]):
    """Two gears whose pitch curves follow from a law of their speeds, or from the pitch curve of one."""

    name = "noncircular-gears"
    title = "Non-circular gears"
    summary = "A pair of gears that turns one shaft by any law of the other, with lobes of any numbers."
    Params = SizedParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = REQUIREMENTS
    batch = 1 << 16

    def check(self, params: NoncircularParams) -> Sequence[Finding]:
        """The law, convexity, undercut, tips, roots, bore, pressure angle at the shaft, the mesh proof."""
        from mechwright_noncircular_gears.checks import findings

        return findings(params)

    def judge(self, params: NoncircularParams) -> Sequence[Finding]:
        """The same without the mesh proof."""
        from mechwright_noncircular_gears.checks import judged

        return judged(params)

    def solve(self, params: NoncircularParams, samples: int) -> "Motion":
        """Turns of the driver at constant speed until both gears are back."""
        from mechwright_noncircular_gears.motion import motion_of

        return motion_of(params, samples)

    def stretches(self, params: NoncircularParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_noncircular_gears.motion import motion_of

        return in_stretches(partial(motion_of, params), samples)

    def parts(self, params: NoncircularParams) -> "Sequence[Part]":
        """Both gears."""
        from mechwright_noncircular_gears.checks import findings
        from mechwright_noncircular_gears.parts import parts_of

        refuse(findings(params), Stage.PARTS)
        return parts_of(params)

    def mounting(self, params: NoncircularParams) -> "Mounting":
        """Both shafts."""
        from mechwright_noncircular_gears.mounting import mounting_of

        return mounting_of(params)

    def transmission(self, params: NoncircularParams) -> "Transmission":
        """Driver in, driven gear out; DesignError for a ring, which has no shaft."""
        from mechwright_noncircular_gears.stage import PairStage

        return PairStage(params)

    def check_cut(self, params: NoncircularParams, cut: "Mapping[str, shapely.Polygon]") -> Sequence[Finding]:
        """Whether the pair as cut still meshes, and its keys go in."""
        from mechwright_noncircular_gears.cut import cut_findings

        return cut_findings(params, cut)

    def as_made(self, params: NoncircularParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Play, transmission error and backlash, and whether the pair jams."""
        from mechwright_noncircular_gears.as_made import as_made

        return as_made(params, made)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[NoncircularParams]":
        """The law that a Geneva wheel, a slider, a quick return or a slow approach asks for."""
        from mechwright_noncircular_gears.fit.synthesis import from_wish

        if not isinstance(requirement, FitRequirement):
            return super().synthesise(kind, requirement, progress)
        return from_wish(requirement, progress)

    def evaluate(
        self, batch: "Batch[NoncircularParams]", columns: Collection[str], stage: Stage = Stage.PARTS
    ) -> "Columns":
        """The motion of many pairs at once, by laws of numbers; their teeth one by one."""
        from mechwright.contracts.by_arrays import by_arrays
        from mechwright_noncircular_gears.evaluation import answer

        return by_arrays(self, batch, columns, stage, answer)
