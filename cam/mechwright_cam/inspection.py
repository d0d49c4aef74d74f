"""Whether the chosen cutters can make the parts, what they leave, and whether the mechanism runs as made."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.pipeline import PROGRAMS, Build, Inspection
from mechwright.pipeline.process import MILL


class Machinable(Inspection):
    """What control and cutters say of the parts."""

    name = "machining"
    process = MILL
    stage = Stage.MACHINING
    order = 20
    doing = "drawings and programs"
    share = 20.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """What forbids or hampers machining."""
        from mechwright_cam.machining import Machining

        return build.made(Machining).findings


class Proven(Inspection):
    """Whether each program can be planned, and is proven."""

    name = "proofs"
    process = MILL
    stage = Stage.MACHINING
    needs = frozenset({PROGRAMS})
    order = 35
    limited = False  # programs of large machines are planned and proven in it
    doing = "drawings and programs"
    share = 60.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """Nothing; raises as :attr:`mechwright_cam.machining.Machining.proven_programs` does."""
        from mechwright_cam.machining import Machining

        _ = build.made(Machining).proven_programs
        return ()


class OpenWalls(Inspection):
    """Whether the programs leave each part an outline by which the mechanism can be judged."""

    name = "open-walls"
    process = MILL
    stage = Stage.OUTPUT
    needs = frozenset({PROGRAMS})
    order = 40
    limited = False
    doing = "parts as made"
    share = 20.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """Walls that are not cut."""
        from mechwright_cam.as_made import AsMadeParts

        return build.made(AsMadeParts).open


class InHand(Inspection):
    """Screws and pins of the mechanism that the shop does not keep."""

    name = "in-hand"
    stage = Stage.MACHINING
    order = 25
    doing = "what is in hand"
    share = 1.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """One for each size; nothing without a shop, or where it says nothing of them."""
        from mechwright_cam.shop.bought import not_kept
        from mechwright_cam.shop.shop_table import shop_of

        shop = shop_of(build.design)
        if shop is None:
            return []
        told = f"tools, mill and control are those of {shop.path.name}: {shop.workshop.name}"
        return [Finding("shop.used", Severity.NOTE, "shop", told), *not_kept(build.parts, shop)]
