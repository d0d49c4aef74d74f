"""Straight-line linkages: Peaucellier's is exact, those of Hoecken, Chebyshev, Roberts and Watt are near."""

from typing import ClassVar, Self

import numpy as np
from pydantic import Field, model_validator

from mechwright_linkage.catalogue.entry import GROUND, Entry, Length, Points, bar

_FOUR_BAR = {
    "A0": (GROUND, "crank"),
    "A": ("crank", "coupler"),
    "B": ("coupler", "rocker"),
    "B0": (GROUND, "rocker"),
}


class Peaucellier(Entry):
    """Two arms and a rhombus invert the circle of the crank's pin B into the straight line of D.

    OB · OD = arm² - side². The crank's pivot Q is as far from O as the crank is long, so D stays on the line
    x = (arm² - side²)/(2 crank). The crank swings to where OB = 2 crank cos(angle/2) is arm - side.
    """

    title = "Peaucellier-Lipkin inversor"
    source = "Arms 100, rhombus 45, crank 38"
    output = "AD"
    traces: ClassVar = {"D": ("AD", "D")}
    swing = (-60.0, 60.0)
    straight = (-60.0, 60.0)
    signs: ClassVar = {"A": 1, "C": -1, "D": 1}
    pin_links: ClassVar = {
        "Q": (GROUND, "crank"),
        "O": (GROUND, "OA", "OC"),
        "B": ("crank", "AB", "CB"),
        "A": ("OA", "AB", "AD"),
        "C": ("OC", "CB", "CD"),
        "D": ("AD", "CD"),
    }

    arm: Length = Field(100.0, description="Arms, from O to A and C.")
    side: Length = Field(45.0, description="Sides of the rhombus A, B, C, D.")
    crank: Length = Field(38.0, description="Crank, from Q to B, and the distance from O to Q.")

    @model_validator(mode="after")
    def _closes_at_start(self) -> Self:
        arm, side, reach = self.arm, self.side, 2 * self.crank
        if not arm - side < reach < arm + side or side >= arm:
            raise ValueError(
                f"arm {arm:g} and side {side:g} mm reach a pin B that is from arm - side = {arm - side:g} to "
                f"arm + side = {arm + side:g} mm away, and side has to be below arm; 2 crank is {reach:g} mm"
            )
        folds = np.sqrt(arm**2 - side**2)
        if reach >= folds:
            raise ValueError(
                f"2 crank = {reach:g} mm has to be below √(arm² - side²) = {folds:g} mm: "
                "there B meets D and the rhombus folds"
            )
        return self

    def points(self) -> Points:
        """Give the points of every link, mm; the pivot O of the arms is the origin, Q on X."""
        return {
            GROUND: bar("O", "Q", self.crank),
            "crank": bar("Q", "B", self.crank),
            "OA": bar("O", "A", self.arm),
            "OC": bar("O", "C", self.arm),
            "AB": bar("A", "B", self.side),
            "CB": bar("C", "B", self.side),
            "AD": bar("A", "D", self.side),
            "CD": bar("C", "D", self.side),
        }


class Hoecken(Entry):
    """A crank-rocker whose coupler point draws nearly a straight line at 90° to 270° of the crank.

    Crank, base, rocker and both halves of the coupler are as 1 : 2 : 2.5 : 2.5. The line is 4 cranks long;
    its band is 0.00975373 cranks.
    """

    title = "Hoecken straight-line linkage"
    source = "Chebyshev's lambda linkage: 1, 2, 2.5, 2.5 + 2.5"
    output = "coupler"
    traces: ClassVar = {"C": ("coupler", "C")}
    start = 180.0
    straight = (90.0, 270.0)
    signs: ClassVar = {"B": 1}
    pin_links: ClassVar = _FOUR_BAR

    crank: Length = Field(20.0, description="Crank, from A0 to A; all others follow from it.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: bar("A0", "B0", 2 * self.crank),
            "crank": bar("A0", "A", self.crank),
            "coupler": {**bar("A", "B", 2.5 * self.crank), "C": 5 * self.crank + 0j},
            "rocker": bar("B0", "B", 2.5 * self.crank),
        }


class Chebyshev(Entry):
    """Two crossed rockers whose coupler draws nearly a straight line with its middle.

    Coupler, rockers and base are as 2 : 5 : 4. The crank swings from acos(4/5) to acos(-1/5).
    """

    title = "Chebyshev straight-line linkage"
    source = "Chebyshev: coupler 1 + 1, rockers 5, base 4"
    output = "coupler"
    traces: ClassVar = {"C": ("coupler", "C")}
    start = 60.0
    swing = (45.0, 83.0)
    straight = (53.13010235415598, 90.0)
    signs: ClassVar = {"B": -1}
    pin_links: ClassVar = _FOUR_BAR

    base: Length = Field(80.0, description="Ground, from A0 to B0 along X; all others follow from it.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X."""
        return {
            GROUND: bar("A0", "B0", self.base),
            "crank": bar("A0", "A", 1.25 * self.base),
            "coupler": {**bar("A", "B", 0.5 * self.base), "C": 0.25 * self.base + 0j},
            "rocker": bar("B0", "B", 1.25 * self.base),
        }


class Roberts(Entry):
    """Two equal rockers carry a coupler of half the base, whose apex comes near the line of the pivots.

    The coupler is a triangle with sides as long as the rockers.
    """

    title = "Roberts straight-line linkage"
    source = "Roberts: coupler half the base, sides of the triangle as long as the arms"
    output = "coupler"
    traces: ClassVar = {"C": ("coupler", "C")}
    start = 65.0
    swing = (49.0, 78.0)
    straight = (49.0, 78.0)
    signs: ClassVar = {"B": 1}
    pin_links: ClassVar = _FOUR_BAR

    base: Length = Field(100.0, description="Ground, from A0 to B0 along X; the coupler is half as long.")
    arm: Length = Field(60.0, description="Both rockers, and the sides of the coupler's triangle.")

    @model_validator(mode="after")
    def _closes_at_start(self) -> Self:
        # At the start angle the second rocker reaches from the coupler's end if both are within these bounds.
        if not 0.55 * self.base <= self.arm <= 1.5 * self.base:
            raise ValueError(
                f"arm = {self.arm:g} mm has to be 0.55 to 1.5 times base = {self.base:g} mm, that is "
                f"{0.55 * self.base:g} to {1.5 * self.base:g} mm"
            )
        return self

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 on X, the apex C under the coupler."""
        half = self.base / 4
        return {
            GROUND: bar("A0", "B0", self.base),
            "crank": bar("A0", "A", self.arm),
            "coupler": {**bar("A", "B", self.base / 2), "C": half - 1j * np.sqrt(self.arm**2 - half**2)},
            "rocker": bar("B0", "B", self.arm),
        }


class WattLine(Entry):
    """Two equal arms on opposite sides, joined by a coupler whose middle draws a long figure of eight.

    In the middle position both arms are along X and the coupler is square to them; there the path is nearly
    straight. The middle of the coupler is on Watt's curve: with the pivots 2 a apart, the arms b, the coupler
    2 c, and polar coordinates about the middle of the pivots, r² = b² - (a sin φ ± √(c² - a² cos² φ))².
    """

    title = "Watt straight-line linkage"
    source = "Watt's parallel motion, patent of 1784"
    output = "coupler"
    traces: ClassVar = {"C": ("coupler", "C")}
    swing = (-15.0, 15.0)
    straight = (-15.0, 15.0)
    signs: ClassVar = {"B": -1}
    pin_links: ClassVar = _FOUR_BAR

    arm: Length = Field(80.0, description="Both arms, from A0 to A and from B0 to B.")
    coupler: Length = Field(40.0, description="Coupler, from A to B.")

    def points(self) -> Points:
        """Give the points of every link, mm; A0 is the origin, B0 two arms right and a coupler below."""
        return {
            GROUND: {"A0": 0j, "B0": 2 * self.arm - 1j * self.coupler},
            "crank": bar("A0", "A", self.arm),
            "coupler": {**bar("A", "B", self.coupler), "C": self.coupler / 2 + 0j},
            "rocker": bar("B0", "B", self.arm),
        }
