"""Drawings of the parts of one kind as files of a build."""

from abc import abstractmethod
from typing import TYPE_CHECKING, ClassVar

from mechwright.pipeline import Build, FileName, Page, Wanted

if TYPE_CHECKING:
    from mechwright.contracts.part import Part
    from mechwright_cad.sheet.sheet import Sheet
    from mechwright_cad.sheet.title import TitleBlock


class PartDrawings(Page):
    """A DXF and a PDF of every part that a kind of drawing shows."""

    commands = frozenset({"model", "build"})
    suffixes: ClassVar[tuple[str, str]] = (".dxf", ".pdf")
    """What follows a part's name in the names of both files."""

    @abstractmethod
    def is_shown(self, part: "Part") -> bool:
        """Whether a part has a drawing of this kind."""

    @abstractmethod
    def sheet(self, part: "Part", build: Build, title: "TitleBlock") -> "Sheet":
        """The drawing of a part."""

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Those of every part that is shown."""
        return [
            FileName(part.name + suffix, f"the drawing of part {part.name}")
            for part in build.parts
            if self.is_shown(part)
            for suffix in self.suffixes
        ]

    def files(self, build: Build) -> dict[str, bytes]:
        """File name to content; none where no part is shown."""
        parts = [part for part in build.parts if self.is_shown(part)]
        if not parts:
            return {}
        from mechwright_cad.sheet.files import files
        from mechwright_cad.sheet.settings import DrawingTable
        from mechwright_cad.sheet.title import TitleBlock

        made: dict[str, bytes] = {}
        title = TitleBlock(build.design.name, build.design.table(DrawingTable))
        for part in parts:
            first, second = (part.name + suffix for suffix in self.suffixes)
            made |= files(
                self.sheet(part, build, title), (first, second), f"{title.design}: {part.name}", title
            )
        return made
