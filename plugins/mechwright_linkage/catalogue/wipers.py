"""Tandem wipers: two blades on levers that one motor swings."""

from typing import ClassVar

from pydantic import Field

from mechwright_linkage.catalogue.entry import GROUND, Coordinate, Entry, Length, Points, bar


class Wiper(Entry):
    """A crank swings the first lever through a rod, and that one the second lever through a second rod.

    The linkage is a Watt II six-bar. Look at the reversals of both levers: one that reverses in mid-stroke
    still closes over the whole turn.
    """

    title = "Tandem wiper"
    source = "A car's wiper of crank 40 and blades of 420 mm, at half the size"
    output = "lever2"
    traces: ClassVar = {"T": ("lever1", "T"), "U": ("lever2", "U")}
    signs: ClassVar = {"B": 1, "E": -1}
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "rod1"),
        "B0": (GROUND, "lever1"),
        "B": ("rod1", "lever1"),
        "D": ("lever1", "rod2"),
        "E": ("rod2", "lever2"),
        "C0": (GROUND, "lever2"),
    }

    b0_x: Coordinate = Field(75.0, description="Pivot B0 of the first lever, to the right of the crank's A0.")
    b0_y: Coordinate = Field(10.0, description="Pivot B0 of the first lever, over A0.")
    c0_x: Coordinate = Field(310.0, description="Pivot C0 of the second lever, to the right of A0.")
    c0_y: Coordinate = Field(15.0, description="Pivot C0 of the second lever, over A0.")
    crank: Length = Field(20.0, description="Motor's crank, from A0 to A.")
    rod1: Length = Field(77.0, description="First rod, from A to B.")
    b_x: Coordinate = Field(-15.0, description="Pin B in the first lever, X from B0.")
    b_y: Coordinate = Field(25.0, description="Pin B in the first lever, Y from B0.")
    d_x: Coordinate = Field(13.5, description="Pin D of the second rod in the first lever, X from B0.")
    d_y: Coordinate = Field(-24.0, description="Pin D of the second rod in the first lever, Y from B0.")
    t_x: Coordinate = Field(-97.0, description="Tip T of the first blade, X from B0 in the lever's frame.")
    t_y: Coordinate = Field(186.5, description="Tip T of the first blade, Y from B0 in the lever's frame.")
    rod2: Length = Field(234.0, description="Second rod, from D to E.")
    lever2: Length = Field(29.0, description="Second lever, from C0 to E.")
    u_x: Coordinate = Field(-215.0, description="Tip U of the second blade, along C0 to E.")
    u_y: Coordinate = Field(-10.0, description="Tip U of the second blade, to the left of C0 to E.")

    def points(self) -> Points:
        """Give the points of every link, mm; the crank's pivot A0 is the origin."""
        return {
            GROUND: {
                "A0": 0j,
                "B0": self.b0_x + 1j * self.b0_y,
                "C0": self.c0_x + 1j * self.c0_y,
            },
            "crank": bar("A0", "A", self.crank),
            "rod1": bar("A", "B", self.rod1),
            "lever1": {
                "B0": 0j,
                "B": self.b_x + 1j * self.b_y,
                "D": self.d_x + 1j * self.d_y,
                "T": self.t_x + 1j * self.t_y,
            },
            "rod2": bar("D", "E", self.rod2),
            "lever2": {**bar("C0", "E", self.lever2), "U": self.u_x + 1j * self.u_y},
        }
