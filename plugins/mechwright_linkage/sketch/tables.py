"""Tables of a drawn linkage: points, slides, gears."""

from typing import Annotated, Any, ClassVar

from pydantic import Field

from mechwright import FIRST, Parameters
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.units import Degrees, Millimetres, Ratio

NAME = r"[A-Za-z0-9][A-Za-z0-9_-]{0,39}"
"""What a name of a link, a point or a joint is."""

Word = Annotated[str, Field(max_length=40, pattern=rf"^{NAME}$|^$")]
"""The name of a link, a point or a joint."""

Coordinate = Annotated[Millimetres, Field(ge=-10000, le=10000)]


class PointTable(Parameters):
    """A point in the drawn position."""

    x: Coordinate = Field(0.0, description="X of the point.", json_schema_extra=FIRST)
    y: Coordinate = Field(0.0, description="Y of the point.", json_schema_extra=FIRST)

    @property
    def place(self) -> Any:
        """X + i y, mm, or a column of them."""
        return self.x + 1j * self.y


class SlideTable(Parameters):
    """A slide: the point of ``block`` moves on a line of ``guide``, and the block does not turn in it."""

    what: ClassVar[str] = "slides"

    name: Word = Field("", description="Of the slide. Default: slide-1, slide-2, ...")
    block: Word = Field("", description="The link that slides.")
    guide: Word = Field(GROUND, description="The link on whose line it slides.")
    point: Word = Field("", description="The point of the block that stays on the line.")
    angle: Degrees = Field(
        0.0, ge=-360, le=360, description="Direction of the line in the drawn position, from X."
    )

    @property
    def links(self) -> tuple[str, ...]:
        """Both links."""
        return self.block, self.guide


class GearTable(Parameters):
    """Two links that are geared with each other."""

    what: ClassVar[str] = "gears"

    name: Word = Field("", description="Of the pair. Default: gears-1, gears-2, ...")
    one: Word = Field("", description="The first link.")
    two: Word = Field("", description="The second link, which turns ratio times as far.")
    carrier: Word = Field(GROUND, description="The link that holds both centres.")
    ratio: Ratio = Field(
        -1.0,
        ge=-50,
        le=50,
        description="Turns of two for one turn of one, as seen from the carrier; below 0 if external.",
    )

    @property
    def links(self) -> tuple[str, ...]:
        """Both gears and their carrier."""
        return self.one, self.two, self.carrier
