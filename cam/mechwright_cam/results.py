"""What a build can be asked for in the CAM room: its programs, and the minutes that they take."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from mechwright.contracts.named import Named
from mechwright.contracts.result import Result
from mechwright.pipeline import WORK, Build, Run

if TYPE_CHECKING:
    from mechwright_cam.machining import Machined


class Programs(Result[Build]):
    """``build.programs``."""

    name = "programs"
    of = "build"

    def make(self, subject: Build) -> "Named[Machined]":
        """Every program with its proof; raises as :attr:`mechwright.pipeline.Build.programs` says."""
        from mechwright_cam.machining import Machining

        Run(subject.asking(command="cam"), WORK["cam"]).make()
        return Named(subject.made(Machining).proven_programs)


class Minutes(Result[Build]):
    """``build.result("minutes")``: on the mill, for all parts of the mechanism."""

    name = "minutes"
    of = "build"

    def make(self, subject: Build) -> float:
        """The proofs' times, of parts that are needed several times as often; raises as programs do."""
        made: Iterable[Machined] = subject.result(Programs.name)
        times = [len(one.job.part.instances or (None,)) * one.proof.time_estimate_s for one in made]
        return sum(times) / 60
