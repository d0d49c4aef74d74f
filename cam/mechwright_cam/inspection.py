"""Whether the chosen cutters can make the parts, and what they leave."""

from collections.abc import Sequence

from mechwright.build import Build, Inspection
from mechwright.contracts.finding import Finding, Stage


class Machinable(Inspection):
    """What control and cutters say of the parts."""

    name = "machining"
    commands = frozenset({"check", "cam", "build"})
    stage = Stage.MACHINING
    order = 20
    doing = "drawings and programs"

    def findings(self, build: Build) -> Sequence[Finding]:
        """What forbids or hampers machining."""
        from mechwright_cam.machining import Machining

        return build.made(Machining).findings
