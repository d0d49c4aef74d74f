"""The drawings of parts of free form as files of a build."""

from mechwright.pipeline import Build, FileName, Page, Wanted
from mechwright_cad.turned_drawing.page import SUFFIXES


class FormDrawings(Page):
    """``NAME.dxf`` and ``NAME.pdf`` of every part of free form."""

    name = "form-drawings"
    commands = frozenset({"model", "build"})
    doing = "drawings of parts of free form"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Those of every part of free form."""
        found = [part.name for part in build.parts if part.free_form is not None]
        return [
            FileName(name + suffix, f"the drawing of part {name}") for name in found for suffix in SUFFIXES
        ]

    def files(self, build: Build) -> dict[str, bytes]:
        """File name to content; imports the CAD kernel where there is such a part."""
        parts = [part for part in build.parts if part.free_form is not None]
        if not parts:
            return {}
        from mechwright_cad.form_drawing.drawing import form_sheet
        from mechwright_cad.sheet.files import files
        from mechwright_cad.sheet.settings import DrawingTable
        from mechwright_cad.sheet.title import TitleBlock

        made: dict[str, bytes] = {}
        block = TitleBlock(build.design.name, build.design.table(DrawingTable))
        for part in parts:
            first, second = (part.name + suffix for suffix in SUFFIXES)
            made |= files(form_sheet(part, block), (first, second), f"{block.design}: {part.name}", block)
        return made
