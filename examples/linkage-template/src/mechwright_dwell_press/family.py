"""The family: a linkage by its dimensions and joints, its table of parameters, and its names."""

import math
from collections.abc import Mapping, Sequence
from typing import ClassVar, Literal

from pydantic import Field

from mechwright import FIRST, Parameters
from mechwright_linkage.catalogue.entry import (
    GROUND,
    Coordinate,
    Entry,
    Length,
    Points,
    Prismatic,
    bar,
)
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import LinkageParams, dimensions
from mechwright_linkage.poles_page import LinkagePoles


class DwellPress(Entry):
    """A point of the coupler of a four-bar moves a ram through a rod.

    The ram dwells where the path of the point is nearly an arc about the ram's pin, with the rod as radius.
    """

    title = "Dwell press"
    source = "Found by the search for a dwell of 70° and a stroke of 50 mm; whole mm"
    output = "ram"
    traces: ClassVar = {"C": ("coupler", "C")}
    signs: ClassVar = {"B": 1, "D": 1}
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "coupler"),
        "B": ("coupler", "rocker"),
        "B0": (GROUND, "rocker"),
        "C": ("coupler", "rod"),
        "D": ("rod", "ram"),
    }

    base: Length = Field(83.0, description="Ground, from A0 to B0 along X.")
    crank: Length = Field(30.0, description="Crank, from A0 to A.")
    coupler: Length = Field(87.0, description="Coupler, from A to B.")
    c_x: Coordinate = Field(145.0, description="Pin C in the coupler, along A to B.")
    c_y: Coordinate = Field(48.0, description="Pin C in the coupler, to the left of A to B.")
    rocker: Length = Field(56.0, description="Rocker, from B0 to B.")
    rod: Length = Field(90.0, description="Rod, from C to the ram's pin D.")
    ram_x: Coordinate = Field(66.0, description="Line of the ram, to the right of A0.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: {**bar("A0", "B0", self.base), "R": self.ram_x + 0j},
            "crank": bar("A0", "A", self.crank),
            "coupler": {**bar("A", "B", self.coupler), "C": self.c_x + 1j * self.c_y},
            "rocker": bar("B0", "B", self.rocker),
            "rod": bar("C", "D", self.rod),
            "ram": {"D": 0j},
        }

    def slides(self) -> Sequence[Prismatic]:
        """Give the ram's guide; its way counts upwards from X."""
        return (Prismatic("guide", GROUND, "ram", self.points()[GROUND]["R"], 0j, math.pi / 2),)


class DwellPressParams(LinkageParams):
    """The table ``[parameters]``: the dimensions of the press; all else is that of any linkage."""

    linkage: Literal["dwell-press"] = Field(  # type: ignore[assignment]  # instead of the catalogue
        "dwell-press", description="The one linkage of this family.", json_schema_extra=FIRST
    )
    dwell_press: DwellPress = dimensions(DwellPress, "dwell-press")


class DwellPresses(Linkages):
    """Presses whose ram dwells."""

    name = "dwell-press"
    title = "Dwell press"
    summary = "A six-bar press whose ram stands still for a part of the turn."
    Params = DwellPressParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {}


class DwellPressPoles(LinkagePoles):
    """The pages of the poles."""

    name = "dwell-press-poles"
    family = "dwell-press"
