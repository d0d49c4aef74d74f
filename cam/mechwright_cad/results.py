"""What parts and builds can be asked for in the CAD room: solids, assemblies, pictures."""

from typing import TYPE_CHECKING

from mechwright.contracts.result import Result
from mechwright.pipeline import Build

if TYPE_CHECKING:
    import cadquery as cq

    from mechwright.contracts.part import Part


class PartSolid(Result["Part"]):
    """``part.solid``."""

    name = "solid"
    of = "part"

    def make(self, subject: "Part") -> "cq.Solid":
        """The checked solid, recesses cut; imports the CAD kernel."""
        from mechwright_cad.solids.solid import part_solid

        return part_solid(subject)


class PartPicture(Result["Part"]):
    """``part.picture``."""

    name = "picture"
    of = "part"

    def make(self, subject: "Part") -> str:
        """The plate from above with its features, or the solid in three views, as SVG."""
        from mechwright_cad.part_picture import part_picture

        return part_picture(subject)


class Assembled(Result[Build]):
    """``build.assembly``."""

    name = "assembly"
    of = "build"

    def make(self, subject: Build) -> "cq.Assembly":
        """All instances in their poses; imports the CAD kernel."""
        from mechwright_cad.solids.solid import assembly

        motion, sample = subject.pose
        return assembly(subject.design.name, subject.parts, motion, sample)
