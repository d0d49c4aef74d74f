"""Milling as a process: what a design says nothing of."""

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

    def correction(self, off: float, walls: str, part: Part, build: Build) -> str:  # noqa: ARG002
        """The wear of the cutter in the control, a radius."""
        of = "" if walls == "all" else f" of the cutters of {walls} walls"
        return f"set the wear of D{of} {-off:+.4f} mm from where it is, as a radius"

    def seconds(self, part: Part, build: Build) -> float | None:
        """The proof's time, where the build has made the program of that plate by itself."""
        from mechwright_cam.machining import Machining

        found = [one for one in build.made(Machining).proven_programs if one.job.part.name == part.name]
        return sum(one.proof.time_estimate_s for one in found) if found else None
