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
        from mechwright_cad.sheet.to_dxf import dxf
        from mechwright_cad.sheet.to_pdf import pdf

        made = {}
        for part in parts:
            sheet = form_sheet(part, build.design.name)
            title = f"{build.design.name}: {part.name}"
            for suffix, content in zip(SUFFIXES, (dxf(sheet), pdf(sheet, title)), strict=True):
                made[part.name + suffix] = content
        return made
