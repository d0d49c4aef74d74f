"""The drawings of parts of free form as files of a build."""

from typing import TYPE_CHECKING

from mechwright.pipeline import Build
from mechwright_cad.sheet.page import PartDrawings

if TYPE_CHECKING:
    from mechwright.contracts.part import Part
    from mechwright_cad.sheet.sheet import Sheet
    from mechwright_cad.sheet.title import TitleBlock


class FormDrawings(PartDrawings):
    """``NAME.dxf`` and ``NAME.pdf`` of every part of free form."""

    name = "form-drawings"
    doing = "drawings of parts of free form"

    def is_shown(self, part: "Part") -> bool:
        """Parts of free form."""
        return part.free_form is not None

    def sheet(self, part: "Part", build: Build, title: "TitleBlock") -> "Sheet":  # noqa: ARG002
        """Three views; imports the CAD kernel."""
        from mechwright_cad.form_drawing.drawing import form_sheet

        return form_sheet(part, title)
