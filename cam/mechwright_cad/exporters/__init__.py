"""File formats of parts. This package is light; the modules that write import their libraries."""

from mechwright_cad.exporters.curve_kinds import Curves
from mechwright_cad.exporters.formats import (
    DxfExporter,
    GlbExporter,
    MjcfExporter,
    SdfExporter,
    StepExporter,
    StlExporter,
    ThreeMfExporter,
    UrdfExporter,
)

__all__ = [
    "Curves",
    "DxfExporter",
    "GlbExporter",
    "MjcfExporter",
    "SdfExporter",
    "StepExporter",
    "StlExporter",
    "ThreeMfExporter",
    "UrdfExporter",
]
