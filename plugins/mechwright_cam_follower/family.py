"""The family ``cam-follower``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.requirement import SizeRequirement

if TYPE_CHECKING:
    from mechwright import AsMade, MadePart, Motion, Mounting, Part, Progress, Synthesis, Transmission
    from mechwright.contracts.evaluation import Batch, Columns


class CamFollower(Family[CamParams]):
    """A disc cam, alone or with its conjugate, and a slide or lever with a roller or a flat face."""

    name = "cam-follower"
    title = "Cam and follower"
    summary = "A disc cam gives a slide or a lever any motion of rises, dwells and returns."
    Params = CamParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {"size": SizeRequirement}
    batch = 1 << 16

    def check(self, params: CamParams) -> Sequence[Finding]:
        """Closure, undercut, pressure angle, face, walls, spring, contact pressure."""
        from mechwright_cam_follower.checks import findings

        return findings(params)

    def solve(self, params: CamParams, samples: int) -> "Motion":
        """One turn of the cam at constant speed."""
        from mechwright_cam_follower.motion import motion_of

        return motion_of(params, samples)

    def stretches(self, params: CamParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_cam_follower.motion import motion_of

        return in_stretches(partial(motion_of, params), samples)

    def breaks(self, params: CamParams) -> Sequence[float]:
        """Where segments meet, and where their laws are put together."""
        from mechwright_cam_follower.cycle import cycle_of

        return tuple(params.sense * angle for angle in cycle_of(params).breaks)

    def parts(self, params: CamParams) -> "Sequence[Part]":
        """Cams, follower, rollers, rails."""
        from mechwright_cam_follower.checks import findings
        from mechwright_cam_follower.parts import parts_of

        refuse(findings(params), Stage.PARTS)
        return parts_of(params)

    def mounting(self, params: CamParams) -> "Mounting":
        """The shafts of cam and lever."""
        from mechwright_cam_follower.mounting import mounting_of

        return mounting_of(params)

    def transmission(self, params: CamParams) -> "Transmission":
        """Camshaft in, a lever's axis out; behind a slide stands nothing."""
        from mechwright_cam_follower.stage import CamStage

        return CamStage(params)

    def as_made(self, params: CamParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """How far the follower is from its law with the cam as its program leaves it."""
        from mechwright_cam_follower.as_made import as_made

        return as_made(params, made)

    def synthesise(self, kind: str, requirement: Parameters, progress: "Progress") -> "Synthesis[CamParams]":
        """The smallest cam within limits of pressure angle and curvature."""
        if not isinstance(requirement, SizeRequirement):
            return super().synthesise(kind, requirement, progress)
        from mechwright_cam_follower.synthesis import smallest

        return smallest(requirement, progress)

    def evaluate(
        self, batch: "Batch[CamParams]", columns: Collection[str], stage: Stage = Stage.PARTS
    ) -> "Columns":
        """Many cams at once; those with keyways, and pairs of cams, one by one."""
        from mechwright.contracts.by_arrays import by_arrays
        from mechwright_cam_follower.evaluation import CHUNK, answer

        return by_arrays(self, batch, columns, stage, answer, CHUNK)
