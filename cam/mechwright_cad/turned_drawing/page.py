"""The drawings of turned parts as files of a build."""

from mechwright.pipeline import Build, FileName, Page, Wanted

SUFFIXES = (".dxf", ".pdf")
"""Of the files of one drawing."""


class TurnedDrawings(Page):
    """``NAME.dxf`` and ``NAME.pdf`` of every turned part."""

    name = "turned-drawings"
    commands = frozenset({"model", "build"})
    doing = "drawings of turned parts"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Those of every turned part."""
        turned = [part.name for part in build.parts if part.kind == "turned"]
        return [
            FileName(name + suffix, f"the drawing of part {name}") for name in turned for suffix in SUFFIXES
        ]

    def files(self, build: Build) -> dict[str, bytes]:
        """File name to content; none where nothing is turned."""
        parts = [part for part in build.parts if part.kind == "turned"]
        if not parts:
            return {}
        from mechwright_cad.sheet.files import files
        from mechwright_cad.sheet.settings import DrawingTable
        from mechwright_cad.sheet.title import TitleBlock
        from mechwright_cad.turned_drawing.drawing import turned_sheet

        made: dict[str, bytes] = {}
        block = TitleBlock(build.design.name, build.design.table(DrawingTable))
        for part in parts:
            sheet = turned_sheet(part, block)
            first, second = (part.name + suffix for suffix in SUFFIXES)
            made |= files(sheet, (first, second), f"{build.design.name}: {part.name}", block)
        return made
