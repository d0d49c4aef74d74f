"""The exporters that are registered. Nothing heavy is imported before one of them writes."""

from typing import TYPE_CHECKING, Literal

from mechwright.output import Exporter

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mechwright.motion import Motion
    from mechwright.part import Part

Curves = Literal["spline", "spline3", "arc", "polyline"]
"""How a drawing holds B-splines.

``spline``: as they are, of any degree. ``spline3``: of degree 3, which every reader knows. ``arc``: one
closed polyline with arcs per loop. ``polyline``: one closed polyline of chords per loop.
"""


class StepExporter(Exporter):
    """Solids as STEP AP214, with names and colours."""

    name = "step"
    suffix = ".step"
    modules = ("mechwright_cam.exporters.step",)

    def part(self, part: "Part") -> bytes:
        """One solid; raises GeometryError if it is not right."""
        from mechwright_cam.exporters import step

        return step.part(part)

    def assembly(self, name: str, parts: "Sequence[Part]", motion: "Motion", sample: int = 0) -> bytes | None:
        """One product per part, one named occurrence per instance."""
        from mechwright_cam.exporters import step

        return step.assembly(name, parts, motion, sample)


class DxfExporter(Exporter):
    """Outlines as DXF R2010 in millimetres."""

    name = "dxf"
    suffix = ".dxf"

    def __init__(self, curves: Curves = "spline") -> None:
        self.curves = curves

    def part(self, part: "Part") -> bytes:
        """One drawing; raises GeometryError for a part that has no outline."""
        from mechwright_cam.exporters import dxf

        return dxf.part(part, self.curves)


class StlExporter(Exporter):
    """Triangles as binary STL in millimetres."""

    name = "stl"
    suffix = ".stl"
    modules = ("mechwright_cam.exporters.mesh",)

    def part(self, part: "Part") -> bytes:
        """One closed mesh."""
        from mechwright_cam.exporters import mesh

        return mesh.stl(part)


class ThreeMfExporter(Exporter):
    """Triangles as 3MF, with names and colours."""

    name = "3mf"
    suffix = ".3mf"
    modules = ("mechwright_cam.exporters.mesh",)

    def part(self, part: "Part") -> bytes:
        """One object."""
        from mechwright_cam.exporters import mesh

        return mesh.threemf(part)


class GlbExporter(Exporter):
    """Triangles as binary glTF, for viewers."""

    name = "glb"
    suffix = ".glb"
    modules = ("mechwright_cam.exporters.mesh",)

    def part(self, part: "Part") -> bytes:
        """One node."""
        from mechwright_cam.exporters import mesh

        return mesh.glb_part(part)

    def assembly(self, name: str, parts: "Sequence[Part]", motion: "Motion", sample: int = 0) -> bytes | None:
        """One mesh per part, one named node per instance."""
        from mechwright_cam.exporters import mesh

        return mesh.glb_assembly(name, parts, motion, sample)
