"""The drawings of plates as files of a build."""

from mechwright.pipeline import Build, FileName, Page, Wanted

SUFFIXES = ("-drawing.dxf", "-drawing.pdf")
"""Of the files of one drawing; ``NAME.dxf`` is the outline for machines."""


class PlateDrawings(Page):
    """``NAME-drawing.dxf`` and ``NAME-drawing.pdf`` of every plate that is made."""

    name = "plate-drawings"
    commands = frozenset({"model", "build"})
    doing = "drawings of plates"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Those of every plate."""
        plates = [part.name for part in build.parts if part.kind == "plate"]
        return [
            FileName(name + suffix, f"the drawing of part {name}") for name in plates for suffix in SUFFIXES
        ]

    def files(self, build: Build) -> dict[str, bytes]:
        """File name to content; none where nothing is cut from a plate."""
        parts = [part for part in build.parts if part.kind == "plate"]
        if not parts:
            return {}
        from mechwright.pipeline.tolerances import TolerancesTable
        from mechwright_cad.plate_drawing.drawing import PlateDrawing, plate_sheet
        from mechwright_cad.sheet.files import files
        from mechwright_cad.sheet.settings import DrawingTable
        from mechwright_cad.sheet.title import TitleBlock

        made: dict[str, bytes] = {}
        design = build.design
        block, tolerances = TitleBlock(design.name, design.table(DrawingTable)), design.table(TolerancesTable)
        for part in parts:
            sheet = plate_sheet(PlateDrawing(part, tolerances), block)
            first, second = (part.name + suffix for suffix in SUFFIXES)
            made |= files(sheet, (first, second), f"{design.name}: {part.name}", block)
        return made
