"""What the CAD room registers beside exporters: solids, the page of the motion, and what collides."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Finding, Stage
from mechwright.pipeline import SOLIDS, Build, FileName, Inspection, Page, Wanted

if TYPE_CHECKING:
    from mechwright_cad.solid_models import Solids


def _solids(build: Build) -> "Solids":
    from mechwright_cad.solid_models import Solids

    return build.made_as_wanted(Solids)


class SolidFiles(Page):
    """Every part and the assembly, in every format that is wanted."""

    name = "solids"
    commands = frozenset({"model", "build"})
    doing = "solids"

    def warm(self, build: Build) -> None:
        """Have the CAD kernel imported beside the programs of a build."""
        if build.wanted.command == "build":
            _solids(build).warm()

    def begin(self, build: Build) -> None:
        """Have the solids made beside the programs."""
        _solids(build).begin()

    def late(self, build: Build) -> bool:
        """Whether a second process makes them."""
        return _solids(build).in_second_process

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:
        """Part by part in each format."""
        from mechwright_cad.solid_models import solid_names

        return solid_names(build, wanted)

    def files(self, build: Build) -> dict[str, bytes]:
        """File name to content."""
        return _solids(build).files()


class MotionPage(Page):
    """``motion.html``, on which the mechanism moves."""

    name = "motion-page"
    commands = frozenset({"solve", "build"})
    doing = "motion"
    share = 15.0

    def late(self, build: Build) -> bool:
        """Whether a second process makes it."""
        return _solids(build).in_second_process

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The page."""
        from mechwright_cad.animation import MOTION

        return [FileName(MOTION, "the moving picture")] if build.design.family.moves else []

    def files(self, build: Build) -> dict[str, bytes]:
        """The page; none of what stands still."""
        if not build.design.family.moves:
            return {}
        return _solids(build).page()


class Interference(Inspection):
    """Bodies that stand in each other while the mechanism moves: plates at once, solids once made."""

    name = "interference"
    limited = False  # solids are made in it
    stage = Stage.ASSEMBLY
    needs = frozenset({SOLIDS})
    order = 10
    doing = "interference"
    share = 15.0

    def late(self, build: Build) -> bool:
        """Whether a second process compares them."""
        return _solids(build).in_second_process

    def outlook(self, build: Build) -> Sequence[Finding]:
        """Which plates meet, and where."""
        from mechwright_cad.solid_models import plate_collisions

        return build.made(plate_collisions)

    def findings(self, build: Build) -> Sequence[Finding]:
        """Which bodies meet, and where."""
        return _solids(build).collisions()
