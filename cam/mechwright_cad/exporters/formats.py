"""The exporters that are registered. Nothing heavy is imported before one of them writes."""

from copy import copy
from importlib import import_module
from typing import TYPE_CHECKING, Any, Self

from mechwright.contracts.exporter import Exporter
from mechwright_cad.exporters.curve_kinds import Curves

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from mechwright.contracts.motion import Motion
    from mechwright.contracts.part import Part
    from mechwright_cad.exporters.simulation.settings import Options


class StepExporter(Exporter):
    """Solids as STEP AP214, with names and colours."""

    name = "step"
    suffix = ".step"
    modules = ("mechwright_cad.exporters.step",)

    def part(self, part: "Part") -> bytes:
        """One solid; raises GeometryError if it is not right."""
        from mechwright_cad.exporters import step

        return step.part(part)

    def assembly(self, name: str, parts: "Sequence[Part]", motion: "Motion", sample: int = 0) -> bytes | None:
        """One product per part, one named occurrence per instance."""
        from mechwright_cad.exporters import step

        return step.assembly(name, parts, motion, sample)


class DxfExporter(Exporter):
    """Outlines as DXF R2010 in millimetres."""

    name = "dxf"
    suffix = ".dxf"

    def __init__(self, curves: Curves = "spline") -> None:
        self.curves = curves

    def takes(self, part: "Part") -> bool:
        """All but what is turned, which has a drawing of its own, or bought."""
        return part.outline is not None or part.kind not in {"turned", "bought"}

    def part(self, part: "Part") -> bytes | None:
        """One drawing; None where it takes none, and GeometryError for another part that has no outline."""
        if not self.takes(part):
            return None
        from mechwright_cad.exporters import dxf

        return dxf.part(part, self.curves)


class StlExporter(Exporter):
    """Triangles as binary STL in millimetres."""

    name = "stl"
    suffix = ".stl"
    modules = ("mechwright_cad.exporters.mesh",)

    def part(self, part: "Part") -> bytes:
        """One closed mesh."""
        from mechwright_cad.exporters import mesh

        return mesh.stl(part)


class ThreeMfExporter(Exporter):
    """Triangles as 3MF, with names and colours."""

    name = "3mf"
    suffix = ".3mf"
    modules = ("mechwright_cad.exporters.mesh",)

    def part(self, part: "Part") -> bytes:
        """One object."""
        from mechwright_cad.exporters import mesh

        return mesh.threemf(part)


class GlbExporter(Exporter):
    """Triangles as binary glTF, for viewers."""

    name = "glb"
    suffix = ".glb"
    modules = ("mechwright_cad.exporters.glb",)
    samples = 361

    def part(self, part: "Part") -> bytes:
        """One node."""
        from mechwright_cad.exporters import glb

        return glb.glb_part(part)

    def assembly(self, name: str, parts: "Sequence[Part]", motion: "Motion", sample: int = 0) -> bytes | None:
        """One mesh per part, one named node per instance; what moves is animated."""
        from mechwright_cad.exporters import glb

        return glb.glb_assembly(name, parts, motion, sample)


class SimulationExporter(Exporter):
    """The mechanism for a simulator, with gravity, friction and play as ``[simulation]`` has them."""

    samples = 361
    options: "Options | None" = None
    """Of a design; None for masses and joints alone."""

    def takes(self, part: "Part") -> bool:  # noqa: ARG002
        """None by itself."""
        return False

    def part(self, part: "Part") -> None:
        """Nothing: a part by itself does not move."""

    def configured(self, tables: "Mapping[str, Any]") -> Self:
        """With the options of a design; raises DesignError for gravity where nothing says which way is up."""
        from mechwright_cad.exporters.simulation.settings import Options

        found = copy(self)
        found.options = Options.of(tables)
        return found

    def assembly(self, name: str, parts: "Sequence[Part]", motion: "Motion", sample: int = 0) -> bytes:
        """One body or link per body of the motion, with its parts."""
        from mechwright_cad.exporters.simulation.settings import PLAIN

        module = import_module(self.modules[0])
        found: bytes = module.assembly(name, parts, motion, sample, self.options or PLAIN)
        return found


class MjcfExporter(SimulationExporter):
    """The mechanism as MJCF, for simulation with MuJoCo: masses, joints, closed loops, contacts."""

    name = "mjcf"
    suffix = ".mjcf.xml"
    modules = ("mechwright_cad.exporters.simulation.mjcf",)


class UrdfExporter(SimulationExporter):
    """The mechanism as URDF, for robots: a tree of links, cut at the pins that close loops. It shows STL."""

    name = "urdf"
    suffix = ".urdf"
    modules = ("mechwright_cad.exporters.simulation.urdf",)


class SdfExporter(SimulationExporter):
    """The mechanism as SDF, for Gazebo: links and all joints, those that close loops too. It shows STL."""

    name = "sdf"
    suffix = ".sdf"
    modules = ("mechwright_cad.exporters.simulation.sdf",)
