"""File formats of parts. This package is light; the modules that write import their libraries."""

from mechwright_cam.exporters.formats import (
    Curves,
    DxfExporter,
    GlbExporter,
    StepExporter,
    StlExporter,
    ThreeMfExporter,
)

__all__ = ["Curves", "DxfExporter", "GlbExporter", "StepExporter", "StlExporter", "ThreeMfExporter"]
