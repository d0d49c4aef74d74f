"""Milling as a process: what a design says nothing of."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding
from mechwright.contracts.made_part import MadePart
from mechwright.contracts.part import Part
from mechwright.pipeline import Build
from mechwright.pipeline.process import MILL, Process


class Milling(Process):
    """Programs of the mill; whether its cutters reach everything is a finding of the machining."""

    name = MILL
    title = "milling"

    def refuses(self, part: Part, build: Build) -> str | None:  # noqa: ARG002
        """Nothing: what no cutter makes is told by its own rules."""
        return None

    def objections(self, part: Part, build: Build) -> Sequence[Finding]:
        """What cutters and control find of it; also of a plate that another process makes."""
        from mechwright_cam.milling_trial import MillingTrial

        return build.made(MillingTrial).findings(part.name)

    def produced(self, part: Part, build: Build) -> Sequence[MadePart]:
        """The walls of the posted text; nothing where one is not cut."""
        from mechwright_cam.as_made import AsMadeParts

        made = build.made(AsMadeParts)
        return () if made.open else [one for one in made.parts if one.name == part.name]

    def correction(self, off: float, walls: str, part: Part, build: Build) -> str:  # noqa: ARG002
        """The wear of the cutter in the control, a radius."""
        of = "" if walls == "all" else f" of the cutters of {walls} walls"
        return f"set the wear of D{of} {-off:+.4f} mm from where it is, as a radius"

    def seconds(self, part: Part, build: Build) -> float | None:
        """The proof's time where the run has made programs, else the planner's estimate."""
        from mechwright_cam.machining import Machining
        from mechwright_cam.milling_trial import MillingTrial

        machining = build.made(Machining)
        if "proven_programs" in vars(machining):  # a check that makes nothing makes none for a time
            found = [one for one in machining.proven_programs if one.job.part.name == part.name]
            if found:
                return sum(one.proof.time_estimate_s for one in found)
        return build.made(MillingTrial).seconds(part.name)
