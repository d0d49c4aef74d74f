"""What a build can be asked for in the CAM room: its programs, and the minutes that they take."""

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from mechwright.build import Build, Inspection
from mechwright.contracts.finding import Stage
from mechwright.contracts.named import Named
from mechwright.contracts.result import Result

if TYPE_CHECKING:
    from mechwright_cam.machining import Machined


class Programs(Result[Build]):
    """``build.programs``."""

    name = "programs"
    of = "build"

    def make(self, subject: Build) -> "Named[Machined]":
        """Every program with its proof; raises as :attr:`mechwright.build.Build.programs` says."""
        from mechwright_cam.machining import Machining

        subject.require()
        # What `cam` asks before anything is planned; it compares plates, for which no CAD kernel is needed.
        with Build(subject.design, subject.host, replace(subject.wanted, command="cam")) as cam:
            earlier = [one for one in subject.host.all(Inspection) if one.stage is not Stage.MACHINING]
            for one in sorted(earlier, key=lambda one: one.order):
                if "cam" in one.commands:
                    subject.require(one.findings(cam))
        machining = subject.made(Machining)
        subject.require(machining.findings)
        return Named(machining.made)


class Minutes(Result[Build]):
    """``build.result("minutes")``: on the mill, for all parts of the mechanism."""

    name = "minutes"
    of = "build"

    def make(self, subject: Build) -> float:
        """The proofs' times, of parts that are needed several times as often; raises as programs do."""
        made: Iterable[Machined] = subject.result(Programs.name)
        times = [len(one.job.part.instances or (None,)) * one.proof.time_estimate_s for one in made]
        return sum(times) / 60
