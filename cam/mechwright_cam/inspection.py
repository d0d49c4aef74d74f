"""Whether the chosen cutters can make the parts, what they leave, and whether the mechanism runs as made."""

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
    share = 20.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """What forbids or hampers machining."""
        from mechwright_cam.machining import Machining

        return build.made(Machining).findings


class Running(Inspection):
    """What the family says of the mechanism with its parts as the programs leave them."""

    name = "as-made"
    commands = frozenset({"build"})
    stage = Stage.MACHINING
    order = 40
    doing = "parts as made"
    share = 50.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """What keeps it from being put together, or from turning."""
        from mechwright_cam.as_made import MadeParts

        return build.made(MadeParts).said.findings
