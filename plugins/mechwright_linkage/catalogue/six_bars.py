"""Six-bars that are chains of two dyads from their crank: Watt I and II, Stephenson I and III.

The first four-bar loop is A0, A, B, B0. Each dyad has a sign: +1 where its inner pin is to the left of the
way from the outer pin of the first bar to that of the second, -1 where it is to the right.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, Literal

from pydantic import Field

from mechwright_linkage.catalogue.entry import GROUND, Coordinate, Entry, Length, Points, bar

Side = Literal[1, -1]
"""+1: to the left; -1: to the right."""


class _SixBar(Entry):
    """A four-bar loop, and a dyad of link5 and link6 on two of its links."""

    second_pin: ClassVar[str]
    """The pin of link5 and link6."""

    first_side: Side = Field(1, description="Side of A to B0 on which the pin B is: 1 left, -1 right.")
    second_side: Side = Field(1, description="Side on which the pin of link5 and link6 is: 1 left, -1 right.")

    def branches(self) -> Mapping[str, Any]:
        """Give the signs of both dyads, which the design states."""
        return {"B": self.first_side, self.second_pin: self.second_side}


class WattOne(_SixBar):
    """Coupler and rocker of a four-bar carry a dyad; only link5 and link6 are not joined to the ground."""

    title = "Watt I six-bar"
    source = "Crank 35, base 100, coupler 110, rocker 70"
    output = "link5"
    traces: ClassVar = {"F": ("link5", "F")}
    second_pin = "E"
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "coupler"),
        "B": ("coupler", "rocker"),
        "B0": (GROUND, "rocker"),
        "C": ("coupler", "link5"),
        "D": ("rocker", "link6"),
        "E": ("link5", "link6"),
    }

    base: Length = Field(100.0, description="Ground, from A0 to B0 along X.")
    crank: Length = Field(35.0, description="Crank, from A0 to A.")
    coupler: Length = Field(110.0, description="Coupler, from A to B.")
    c_x: Coordinate = Field(70.0, description="Pin C in the coupler, along A to B.")
    c_y: Coordinate = Field(45.0, description="Pin C in the coupler, to the left of A to B.")
    rocker: Length = Field(70.0, description="Rocker, from B0 to B.")
    d_x: Coordinate = Field(60.0, description="Pin D in the rocker, along B0 to B.")
    d_y: Coordinate = Field(-45.0, description="Pin D in the rocker, to the left of B0 to B.")
    link5: Length = Field(85.0, description="Link5, from C to E.")
    link6: Length = Field(90.0, description="Link6, from D to E.")
    f_x: Coordinate = Field(60.0, description="Traced point F in link5, along C to E.")
    f_y: Coordinate = Field(40.0, description="Traced point F in link5, to the left of C to E.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: bar("A0", "B0", self.base),
            "crank": bar("A0", "A", self.crank),
            "coupler": {**bar("A", "B", self.coupler), "C": self.c_x + 1j * self.c_y},
            "rocker": {**bar("B0", "B", self.rocker), "D": self.d_x + 1j * self.d_y},
            "link5": {**bar("C", "E", self.link5), "F": self.f_x + 1j * self.f_y},
            "link6": bar("D", "E", self.link6),
        }


class WattTwo(_SixBar):
    """Two four-bars in a row: the rocker of the first is the input of the second."""

    title = "Watt II six-bar"
    source = "Crank 30, base 110, coupler 100, rocker 65"
    output = "link6"
    traces: ClassVar = {"F": ("link5", "F")}
    second_pin = "E"
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "coupler"),
        "B": ("coupler", "rocker"),
        "B0": (GROUND, "rocker"),
        "D": ("rocker", "link5"),
        "E": ("link5", "link6"),
        "C0": (GROUND, "link6"),
    }

    base: Length = Field(110.0, description="Ground, from A0 to B0 along X.")
    c0_x: Coordinate = Field(200.0, description="Pivot C0 of link6, along A0 to B0.")
    c0_y: Coordinate = Field(-10.0, description="Pivot C0 of link6, to the left of A0 to B0.")
    crank: Length = Field(30.0, description="Crank, from A0 to A.")
    coupler: Length = Field(100.0, description="Coupler, from A to B.")
    rocker: Length = Field(65.0, description="Rocker, from B0 to B.")
    d_x: Coordinate = Field(45.0, description="Pin D in the rocker, along B0 to B.")
    d_y: Coordinate = Field(-40.0, description="Pin D in the rocker, to the left of B0 to B.")
    link5: Length = Field(95.0, description="Link5, from D to E.")
    link6: Length = Field(70.0, description="Link6, from C0 to E.")
    f_x: Coordinate = Field(40.0, description="Traced point F in link5, along D to E.")
    f_y: Coordinate = Field(30.0, description="Traced point F in link5, to the left of D to E.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: {**bar("A0", "B0", self.base), "C0": self.c0_x + 1j * self.c0_y},
            "crank": bar("A0", "A", self.crank),
            "coupler": bar("A", "B", self.coupler),
            "rocker": {**bar("B0", "B", self.rocker), "D": self.d_x + 1j * self.d_y},
            "link5": {**bar("D", "E", self.link5), "F": self.f_x + 1j * self.f_y},
            "link6": bar("C0", "E", self.link6),
        }


class StephensonOne(_SixBar):
    """Crank and rocker of a four-bar, which both are on the ground, carry a dyad."""

    title = "Stephenson I six-bar"
    source = "Crank 35, base 100, coupler 110, rocker 75"
    output = "link5"
    traces: ClassVar = {"K": ("link5", "K")}
    second_pin = "H"
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "coupler"),
        "B": ("coupler", "rocker"),
        "B0": (GROUND, "rocker"),
        "F": ("crank", "link5"),
        "G": ("rocker", "link6"),
        "H": ("link5", "link6"),
    }

    base: Length = Field(100.0, description="Ground, from A0 to B0 along X.")
    crank: Length = Field(35.0, description="Crank, from A0 to A.")
    f_x: Coordinate = Field(25.0, description="Pin F in the crank, along A0 to A.")
    f_y: Coordinate = Field(30.0, description="Pin F in the crank, to the left of A0 to A.")
    coupler: Length = Field(110.0, description="Coupler, from A to B.")
    rocker: Length = Field(75.0, description="Rocker, from B0 to B.")
    g_x: Coordinate = Field(78.0, description="Pin G in the rocker, along B0 to B.")
    g_y: Coordinate = Field(40.0, description="Pin G in the rocker, to the left of B0 to B.")
    link5: Length = Field(110.0, description="Link5, from F to H.")
    link6: Length = Field(95.0, description="Link6, from G to H.")
    k_x: Coordinate = Field(55.0, description="Traced point K in link5, along F to H.")
    k_y: Coordinate = Field(25.0, description="Traced point K in link5, to the left of F to H.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: bar("A0", "B0", self.base),
            "crank": {**bar("A0", "A", self.crank), "F": self.f_x + 1j * self.f_y},
            "coupler": bar("A", "B", self.coupler),
            "rocker": {**bar("B0", "B", self.rocker), "G": self.g_x + 1j * self.g_y},
            "link5": {**bar("F", "H", self.link5), "K": self.k_x + 1j * self.k_y},
            "link6": bar("G", "H", self.link6),
        }


class StephensonThree(_SixBar):
    """A point of the coupler of a four-bar drives link6, which turns about a third pivot, through link5."""

    title = "Stephenson III six-bar"
    source = "Crank 30, base 100, coupler 100, rocker 60"
    output = "link6"
    traces: ClassVar = {"K": ("link5", "K"), "C": ("coupler", "C")}
    second_pin = "Q"
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "coupler"),
        "B": ("coupler", "rocker"),
        "B0": (GROUND, "rocker"),
        "C": ("coupler", "link5"),
        "C0": (GROUND, "link6"),
        "Q": ("link5", "link6"),
    }

    base: Length = Field(100.0, description="Ground, from A0 to B0 along X.")
    c0_x: Coordinate = Field(60.0, description="Pivot C0 of link6, along A0 to B0.")
    c0_y: Coordinate = Field(133.0, description="Pivot C0 of link6, to the left of A0 to B0.")
    crank: Length = Field(30.0, description="Crank, from A0 to A.")
    coupler: Length = Field(100.0, description="Coupler, from A to B.")
    c_x: Coordinate = Field(60.0, description="Pin C in the coupler, along A to B.")
    c_y: Coordinate = Field(50.0, description="Pin C in the coupler, to the left of A to B.")
    rocker: Length = Field(60.0, description="Rocker, from B0 to B.")
    link5: Length = Field(75.0, description="Link5, from C to Q.")
    link6: Length = Field(65.0, description="Link6, from C0 to Q.")
    k_x: Coordinate = Field(30.0, description="Traced point K in link5, along C to Q.")
    k_y: Coordinate = Field(20.0, description="Traced point K in link5, to the left of C to Q.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: {**bar("A0", "B0", self.base), "C0": self.c0_x + 1j * self.c0_y},
            "crank": bar("A0", "A", self.crank),
            "coupler": {**bar("A", "B", self.coupler), "C": self.c_x + 1j * self.c_y},
            "rocker": bar("B0", "B", self.rocker),
            "link5": {**bar("C", "Q", self.link5), "K": self.k_x + 1j * self.k_y},
            "link6": bar("C0", "Q", self.link6),
        }
