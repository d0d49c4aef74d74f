"""The drawings of turned parts as files of a build."""

from typing import TYPE_CHECKING

from mechwright.pipeline import Build
from mechwright_cad.sheet.page import PartDrawings

if TYPE_CHECKING:
    from mechwright.contracts.part import Part
    from mechwright_cad.sheet.sheet import Sheet
    from mechwright_cad.sheet.title import TitleBlock


class TurnedDrawings(PartDrawings):
    """``NAME.dxf`` and ``NAME.pdf`` of every turned part."""

    name = "turned-drawings"
    doing = "drawings of turned parts"

    def is_shown(self, part: "Part") -> bool:
        """Turned parts."""
        return part.kind == "turned"

    def sheet(self, part: "Part", build: Build, title: "TitleBlock") -> "Sheet":  # noqa: ARG002
        """Side and cuts."""
        from mechwright_cad.turned_drawing.drawing import turned_sheet

        return turned_sheet(part, title)
