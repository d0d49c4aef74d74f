"""The title block (ISO 7200), and the sign of the projection (ISO 5456-2)."""

from collections.abc import Sequence

from mechwright.contracts.masses import OF_PART, TOTAL, masses_of
from mechwright.contracts.part import Part
from mechwright_cad.sheet.circles import ring
from mechwright_cad.sheet.frame import MARGIN, TITLE, Fields, ratio
from mechwright_cad.sheet.settings import DrawingSettings
from mechwright_cad.sheet.sheet import Sheet


class TitleBlock:
    """The title block of the drawings of a design."""

    def __init__(self, design: str, settings: DrawingSettings) -> None:
        self.design = design
        self.settings = settings

    @property
    def third_angle(self) -> bool:
        """Whether views stand as in America."""
        return self.settings.projection == "third"

    def fields(self, part: str, *, of: tuple[str, str], mass: str, count: str, scale: str) -> Fields:
        """Rows of the block: names, values, widths in tenths; ``of`` is what else is said, with its name."""
        said = self.settings
        title = said.title or self.design
        number = " / ".join(filter(None, (said.number, part))) if said.number else ""
        return (
            (("Owner", said.owner, 5), ("Number", number, 5)),
            (("Title", title, 5), ("Revision", said.revision, 2.5), ("Date", said.date, 2.5)),
            (("Part", part, 5), ("Drawn", said.author, 2.5), ("Approved", said.approved, 2.5)),
            ((*of, 4), ("Mass", mass, 2), ("Make", count, 1), ("Scale", scale, 1.7), ("Sheet", "1 / 1", 1.3)),
        )

    def of_part(self, part: Part, stock: str, scale: float) -> Fields:
        """The rows for a part that is made of some stock."""
        mass = masses_of([part]).get(OF_PART + part.name)
        return self.fields(
            part.name,
            of=("Material", stock),
            mass="" if mass is None else f"{1000 * mass:.4g} g",
            count=f"{max(1, len(part.instances))}",
            scale=ratio(scale),
        )

    def of_assembly(self, parts: Sequence[Part], items: int, scale: float) -> Fields:
        """The rows for the exploded view of a machine."""
        mass, bodies = masses_of(parts).get(TOTAL), sum(len(part.instances) for part in parts)
        return self.fields(
            "assembly, exploded",
            of=("Items and bodies", f"{items}, {bodies}"),
            mass="" if mass is None else f"{mass:.4g} kg",
            count="1",
            scale=ratio(scale),
        )


def projection_sign(sheet: Sheet, *, third_angle: bool) -> None:
    """The sign of ISO 5456-2 above the title block: a cone from the side, and its end beside it."""
    x, y = sheet.width - MARGIN - 26.0, MARGIN + TITLE[1] + 6.0
    side, end = (x + 12.0, x + 4.0) if third_angle else (x, x + 14.0)
    sheet.lines(
        [(side, y - 1.5), (side + 7, y - 3), (side + 7, y + 3), (side, y + 1.5), (side, y - 1.5)], "DIM"
    )
    sheet.lines([(side - 1.5, y), (side + 8.5, y)], "CENTRE")
    for radius in (1.5, 3.0):
        sheet.lines(ring((end, y), radius), "DIM")
    sheet.lines([(end - 4, y), (end + 4, y)], "CENTRE")
    sheet.lines([(end, y - 4), (end, y + 4)], "CENTRE")
