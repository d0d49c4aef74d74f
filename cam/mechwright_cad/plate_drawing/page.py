"""The drawings of plates as files of a build."""

from typing import TYPE_CHECKING

from mechwright.pipeline import Build
from mechwright_cad.sheet.page import PartDrawings

if TYPE_CHECKING:
    from mechwright.contracts.part import Part
    from mechwright_cad.sheet.sheet import Sheet
    from mechwright_cad.sheet.title import TitleBlock


class PlateDrawings(PartDrawings):
    """``NAME-drawing.dxf`` and ``NAME-drawing.pdf`` of every plate that is made."""

    name = "plate-drawings"
    doing = "drawings of plates"
    suffixes = ("-drawing.dxf", "-drawing.pdf")  # NAME.dxf is the outline for machines

    def is_shown(self, part: "Part") -> bool:
        """Plates."""
        return part.kind == "plate"

    def sheet(self, part: "Part", build: Build, title: "TitleBlock") -> "Sheet":
        """Plan, edge and tables, with the tolerances of the design, or of the process of the plate."""
        from mechwright.pipeline.tolerances.by_process import tolerances_for
        from mechwright_cad.plate_drawing.drawing import PlateDrawing, plate_sheet

        return plate_sheet(PlateDrawing(part, tolerances_for(build, [part])), title)
