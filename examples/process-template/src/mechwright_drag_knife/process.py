"""The process: what the knife can make, and the file of its program."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from pydantic import Field

import mechwright as mw
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines
from mechwright.pipeline.process import Spread, plates_by

NAME, FILE = "drag-knife", "drag-knife.nc"


class Knife(mw.Parameters):
    """The table ``[drag-knife]``; lengths in mm."""

    offset: float = Field(0.5, gt=0.05, le=5, description="From the axis of the holder to the tip.")
    thickest: float = Field(1.5, gt=0, le=10, description="The thickest sheet that it goes through.")
    feed: float = Field(1200.0, gt=0, le=20000, description="Feed, mm/min.")
    gap: float = Field(6.0, gt=0, le=100, description="Between parts, and from the edge of the sheet.")
    length: float = Field(600.0, gt=0, le=5000, description="Size of the sheet in X.")


class KnifeTable(mw.Table[Knife]):
    """Reads and writes ``[drag-knife]``."""

    name = NAME
    settings = Knife

    def read(self, content: object, path: Path) -> Knife:
        """The settings."""
        return read_table(Knife, content, str(path), self.name)

    def text(self, value: Knife | None = None) -> list[str]:
        """The lines of the table; none where a design says nothing of it."""
        return [] if value is None or not value.model_fields_set else table_lines(Knife, self.name, value)


class DragKnife(mw.Process):
    """A blade that trails behind the axis of its holder: gaskets, and mechanisms of card."""

    name = NAME
    title = "the drag knife"

    def refuses(self, part: mw.Part, build: mw.Build) -> str | None:
        """Metals, and sheets that are too thick."""
        knife = build.design.table(KnifeTable)
        if not mw.material(part.material).soft:
            return f"no blade goes through {part.material}"
        if part.thickness > knife.thickest:
            return f"it is {part.thickness:g} mm thick, and the blade cuts {knife.thickest:g} mm"
        return None

    def loses(self, part: mw.Part, build: mw.Build) -> Sequence[str]:  # noqa: ARG002
        """Fits."""
        return [f"{one.name}: ± 0.2 mm" for one in part.features if getattr(one, "fit", None)]

    def spread(self, part: mw.Part, build: mw.Build) -> Spread:  # noqa: ARG002
        """How far lengths stray."""
        return Spread(0.2)

    def seconds(self, part: mw.Part, build: mw.Build) -> float | None:
        """The way around all contours at the feed."""
        way = 0.0 if part.outline is None else float(part.outline.polygon().length)
        return 60 * way / build.design.table(KnifeTable).feed


class KnifeProgram(mw.Page):
    """The program of all plates that the knife cuts, proven from its text."""

    name = NAME
    commands = frozenset({"build"})

    def files(self, build: mw.Build) -> Mapping[str, str]:
        """The program; raises ProofError where the tip would leave the contours."""
        from mechwright_drag_knife.program import laid_out, program
        from mechwright_drag_knife.proof import faults

        plates = plates_by(build.design, build.parts, NAME)
        knife = build.design.table(KnifeTable)
        pieces, length = laid_out(plates, knife.gap)
        if length > knife.length:
            raise mw.DesignError(f"drag-knife.length: the parts are longer; set length = {length:.0f}")
        text = program(pieces, knife.offset, knife.feed)
        if said := faults(text, pieces, knife.offset):
            raise mw.ProofError(f"{FILE}: {'; '.join(said[:3])}")
        return {FILE: text} if plates else {}


@mw.hookimpl
def mechwright_register() -> list[type[mw.Plugin]]:
    """The table, the process, and the page that writes its program."""
    return [KnifeTable, DragKnife, KnifeProgram]
