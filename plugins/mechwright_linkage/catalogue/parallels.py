"""Linkages of parallelograms: pantograph and parallel guide.

The other assembly of a parallelogram, the crossed one, closes as well. Where the four pins are in line, the
motion itself can change from one to the other: a change point, at which the sine of the dyad is 0.
"""

from typing import Annotated, ClassVar

from pydantic import Field

from mechwright.units import Ratio
from mechwright_linkage.catalogue.entry import GROUND, Coordinate, Entry, Length, Points, bar


class Pantograph(Entry):
    """A parallelogram B, C, E, D that enlarges the circle of a crank about the pivot O: OF = ratio · OD."""

    title = "Pantograph"
    source = "Enlarges 2.5 times the circle of a crank of 15"
    output = "long-side"
    traces: ClassVar = {"F": ("long-side", "F"), "D": ("short-side", "D")}
    signs: ClassVar = {"B": 1, "E": 1}
    pin_links: ClassVar = {
        "O": (GROUND, "arm"),
        "M": (GROUND, "crank"),
        "D": ("crank", "short-side", "tie"),
        "B": ("arm", "short-side"),
        "C": ("arm", "long-side"),
        "E": ("long-side", "tie"),
    }

    ratio: Annotated[Ratio, Field(ge=1.05, le=20)] = Field(2.5, description="Path of F over that of D.")
    arm: Length = Field(60.0, description="On the arm, from the pivot O to B; to C it is ratio times as far.")
    side: Length = Field(55.0, description="Side of the parallelogram, from B to D and from C to E.")
    crank: Length = Field(15.0, description="Crank, from M to D.")
    m_x: Coordinate = Field(90.0, description="Pivot M of the crank, to the right of O.")
    m_y: Coordinate = Field(30.0, description="Pivot M of the crank, over O.")

    def points(self) -> Points:
        """Give the points of every link, mm; the pivot O is the origin."""
        return {
            GROUND: {"O": 0j, "M": self.m_x + 1j * self.m_y},
            "crank": bar("M", "D", self.crank),
            "arm": {**bar("O", "B", self.arm), "C": self.ratio * self.arm + 0j},
            "short-side": bar("B", "D", self.side),
            "tie": bar("D", "E", (self.ratio - 1) * self.arm),
            "long-side": {**bar("C", "E", self.side), "F": self.ratio * self.side + 0j},
        }


class ParallelGuide(Entry):
    """Two equal parallel links carry a platform without turning it; its points draw the crank's circle.

    Change points are at 0° and 180°, with the links in line with the base. The crank swings between them.
    """

    title = "Parallel guide"
    source = "Links of 60 on a base of 80"
    output = "platform"
    traces: ClassVar = {"P": ("platform", "P")}
    start = 90.0
    swing = (40.0, 140.0)
    signs: ClassVar = {"B": 1}
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "B0": (GROUND, "follower"),
        "A": ("crank", "platform"),
        "B": ("platform", "follower"),
    }

    crank: Length = Field(60.0, description="Both links, from A0 to A and from B0 to B.")
    base: Length = Field(80.0, description="From A0 to B0 along X, and from A to B on the platform.")
    p_x: Coordinate = Field(40.0, description="Traced point P in the platform, along A to B.")
    p_y: Coordinate = Field(30.0, description="Traced point P in the platform, over A to B.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: bar("A0", "B0", self.base),
            "crank": bar("A0", "A", self.crank),
            "follower": bar("B0", "B", self.crank),
            "platform": {**bar("A", "B", self.base), "P": self.p_x + 1j * self.p_y},
        }
