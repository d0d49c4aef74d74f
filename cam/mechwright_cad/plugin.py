"""What the CAD stage registers: exporters."""

from mechwright.contracts.exporter import Exporter
from mechwright.plugins.hookspecs import hookimpl
from mechwright_cad.exporters import DxfExporter, GlbExporter, StepExporter, StlExporter, ThreeMfExporter


@hookimpl
def mechwright_register_exporters() -> list[type[Exporter]]:
    """The file formats that parts can be written in."""
    return [StepExporter, DxfExporter, StlExporter, ThreeMfExporter, GlbExporter]
