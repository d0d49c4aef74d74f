"""Quick returns: a crank whose pin slides in a lever, and a ram."""

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from pydantic import Field

from mechwright_linkage.catalogue.entry import (
    GROUND,
    Angle,
    Coordinate,
    Entry,
    Length,
    Points,
    Prismatic,
    bar,
)


class _QuickReturn(Entry):
    """A crank, a block on its pin, a lever in which the block slides, a rod and a ram."""

    output = "ram"
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "block"),
        "B0": (GROUND, "lever"),
        "D": ("lever", "rod"),
        "E": ("rod", "ram"),
    }

    rod: Length
    ram_height: Coordinate
    ram_angle: Angle

    def slides(self) -> Sequence[Prismatic]:
        """Give the slot of the lever, through its pivot, and the line of the ram."""
        height = self.points()[GROUND]["R"]
        return (
            Prismatic("lever-slide", "lever", "block", 0j, 0j),
            Prismatic("ram-slide", GROUND, "ram", height, 0j, np.radians(self.ram_angle)),
        )


class CrankShaper(_QuickReturn):
    """A crank swings a slotted lever, and the lever drives a ram through a rod: the shaper's quick return.

    The lever swings if the crank is shorter than the distance of the centres. With a = asin(crank/distance)
    the time ratio of the lever is (180° + 2 a)/(180° - 2 a), and its swing 2 a.
    """

    title = "Crank-shaper quick return"
    source = "Campbell and Nestinger, Computer-Aided Design of Mechanisms, UC Davis 2004; twice the size"
    signs: ClassVar = {"lever-slide": 1, "E": -1}

    crank: Length = Field(20.0, description="Crank, from A0 to its pin A.")
    centre_distance: Length = Field(50.0, description="From the lever's pivot B0 up to the crank's A0.")
    lever: Length = Field(130.0, description="Lever, from B0 to the rod's pin D.")
    rod: Length = Field(60.0, description="Rod, from D to the ram's pin E.")
    ram_height: Coordinate = Field(100.0, description="Height of the ram's line over B0.")
    ram_angle: Angle = Field(0.0, description="Direction of the ram's line from X.")

    def points(self) -> Points:
        """Give the points of every link, mm; the lever's pivot B0 is the origin."""
        return {
            GROUND: {"A0": 1j * self.centre_distance, "B0": 0j, "R": 1j * self.ram_height},
            "crank": bar("A0", "A", self.crank),
            "block": {"A": 0j},
            "lever": bar("B0", "D", self.lever),
            "rod": bar("D", "E", self.rod),
            "ram": {"E": 0j},
        }


class Whitworth(_QuickReturn):
    """A crank turns a slotted lever fully, and the lever's other arm drives a ram through a rod.

    The lever turns fully if the crank is longer than the offset. With a = asin(offset/crank) and the ram's
    line through the lever's pivot the time ratio is (180° + 2 a)/(180° - 2 a), and the stroke is twice the
    lever's arm.
    """

    title = "Whitworth quick return"
    source = "Proportions of textbooks: offset 20, crank 50"
    signs: ClassVar = {"lever-slide": 1, "E": 1}

    crank: Length = Field(50.0, description="Crank, from A0 to its pin A.")
    offset: Length = Field(20.0, description="From the crank's pivot A0 down to the lever's B0.")
    lever: Length = Field(40.0, description="Lever's arm away from the block, from B0 to the rod's pin D.")
    rod: Length = Field(160.0, description="Rod, from D to the ram's pin E.")
    ram_height: Coordinate = Field(0.0, description="Height of the ram's line over B0.")
    ram_angle: Angle = Field(0.0, description="Direction of the ram's line from X.")

    def points(self) -> Points:
        """Give the points of every link, mm; the crank's pivot A0 is the origin."""
        return {
            GROUND: {"A0": 0j, "B0": -1j * self.offset, "R": 1j * (self.ram_height - self.offset)},
            "crank": bar("A0", "A", self.crank),
            "block": {"A": 0j},
            "lever": {"B0": 0j, "D": -self.lever + 0j},
            "rod": bar("D", "E", self.rod),
            "ram": {"E": 0j},
        }
