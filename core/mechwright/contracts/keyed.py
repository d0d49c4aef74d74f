"""What design tables say of a bore with a keyway, and what its fields say together."""

from typing import Annotated, Protocol

from pydantic import Field

from mechwright.units import Millimetres, Unit

KeywayWidth = Annotated[Millimetres, Field(ge=0, le=60)]
KeywayDepth = Annotated[
    Annotated[float, Field(ge=0.1, le=30), Unit("mm")] | None,
    Field(description="Hub depth t2 over the bore (DIN 6885). Default: the standard one of this width."),
]
KeywayRelief = Annotated[
    Millimetres,
    Field(
        ge=0,
        le=20,
        description="Diameter of the reliefs in the corners of keyways, for a round cutter; 0 for none.",
    ),
]


class Keyed(Protocol):
    """What a design table says of a bore with a keyway, mm; 0 for none, None for the standard depth."""

    @property
    def bore(self) -> float:
        """Diameter."""

    @property
    def keyway_width(self) -> float:
        """Width of the hub keyway."""

    @property
    def keyway_depth(self) -> float | None:
        """Hub depth t2 over the bore (DIN 6885)."""

    @property
    def keyway_relief(self) -> float:
        """Diameter of the reliefs in its corners."""


def keyed_together(table: Keyed) -> None:
    """Raise ValueError for a keyway without a bore, and for sizes of a keyway that there is not."""
    if table.keyway_width > 0 and table.bore == 0:
        raise ValueError("keyway_width needs a bore; set bore, or keyway_width = 0")
    if table.keyway_width == 0 and (table.keyway_depth is not None or table.keyway_relief > 0):
        raise ValueError("keyway_depth and keyway_relief need a keyway; set keyway_width")
