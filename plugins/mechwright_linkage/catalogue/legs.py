"""Walking legs: Jansen's and Klann's, each driven by one crank."""

from typing import ClassVar, Self

from pydantic import Field, model_validator

from mechwright_linkage.catalogue.entry import (
    GROUND,
    Coordinate,
    Entry,
    Length,
    Points,
    apex,
    bar,
    reject_open_triangle,
)


class Jansen(Entry):
    """Theo Jansen's leg by its letters a to m: two triangles, b d e and g h i, on a crank m.

    The leg walks in the direction of -X from its frame; its foot F is below.
    """

    title = "Jansen leg"
    source = "Theo Jansen's holy numbers"
    output = "foot"
    traces: ClassVar = {"F": ("foot", "F")}
    walks = True
    signs: ClassVar = {"X": -1, "Z": 1, "W": -1}
    pin_links: ClassVar = {
        "O": (GROUND, "crank"),
        "M": ("crank", "j", "k"),
        "B0": (GROUND, "shoulder", "c"),
        "X": ("j", "shoulder"),
        "Y": ("shoulder", "f"),
        "W": ("f", "foot"),
        "Z": ("k", "c", "foot"),
    }

    a: Length = Field(38.0, description="From the crank's pivot O to the frame's pivot B0, along -X.")
    b: Length = Field(41.5, description="Shoulder, from B0 to X.")
    c: Length = Field(39.3, description="Link c, from B0 to Z.")
    d: Length = Field(40.1, description="Shoulder, from B0 to Y.")
    e: Length = Field(55.8, description="Shoulder, from X to Y.")
    f: Length = Field(39.4, description="Link f, from Y to W.")
    g: Length = Field(36.7, description="Foot, from Z to W.")
    h: Length = Field(65.7, description="Foot, from W to the tip F.")
    i: Length = Field(49.0, description="Foot, from Z to the tip F.")
    j: Length = Field(50.0, description="Link j, from the crank's pin M to X.")
    k: Length = Field(61.9, description="Link k, from the crank's pin M to Z.")
    l: Coordinate = Field(7.8, description="From the crank's pivot O to the frame's pivot B0, along -Y.")
    m: Length = Field(15.0, description="Crank, from O to M.")

    @model_validator(mode="after")
    def _triangles_close(self) -> Self:
        reject_open_triangle(b=self.b, d=self.d, e=self.e)
        reject_open_triangle(g=self.g, h=self.h, i=self.i)
        return self

    def points(self) -> Points:
        """Give the points of every link, mm; the crank's pivot O is the origin.

        Y is to the left of B0 to X, F to the left of Z to W.
        """
        return {
            GROUND: {"O": 0j, "B0": -self.a - 1j * self.l},
            "crank": bar("O", "M", self.m),
            "j": bar("M", "X", self.j),
            "k": bar("M", "Z", self.k),
            "shoulder": {**bar("B0", "X", self.b), "Y": apex(self.b, self.d, self.e)},
            "c": bar("B0", "Z", self.c),
            "f": bar("Y", "W", self.f),
            "foot": {**bar("Z", "W", self.g), "F": apex(self.g, self.i, self.h)},
        }


class Klann(Entry):
    """Joe Klann's leg: a crank and two rockers carry a rod and a leg.

    The names of the joints are the patent's. Pivots are given from the foot's middle position on the ground.
    The rod goes from the crank's pin J29 over J27, which the lower rocker holds, to the leg's J35. The upper
    rocker holds the leg's hip J37.
    """

    title = "Klann leg"
    source = "US patent 6260862, stride scaled to 100 mm"
    output = "leg"
    traces: ClassVar = {"F": ("leg", "F")}
    walks = True
    signs: ClassVar = {"J27": -1, "J37": 1}
    pin_links: ClassVar = {
        "J15": (GROUND, "crank"),
        "J29": ("crank", "rod"),
        "J11": (GROUND, "lower"),
        "J27": ("rod", "lower"),
        "J35": ("rod", "leg"),
        "J9": (GROUND, "upper"),
        "J37": ("leg", "upper"),
    }

    j15_x: Coordinate = Field(159.9, description="Pivot J15 of the crank, X.")
    j15_y: Coordinate = Field(75.0, description="Pivot J15 of the crank, Y.")
    j11_x: Coordinate = Field(100.9, description="Pivot J11 of the lower rocker, X.")
    j11_y: Coordinate = Field(57.4, description="Pivot J11 of the lower rocker, Y.")
    j9_x: Coordinate = Field(136.6, description="Pivot J9 of the upper rocker, X.")
    j9_y: Coordinate = Field(136.6, description="Pivot J9 of the upper rocker, Y.")
    crank: Length = Field(26.8, description="Crank, from J15 to J29.")
    rod: Length = Field(59.0, description="Rod, from J29 to J27.")
    j35_x: Coordinate = Field(109.9, description="Pin J35 in the rod, along J29 to J27.")
    j35_y: Coordinate = Field(-11.6, description="Pin J35 in the rod, to the left of J29 to J27.")
    lower: Length = Field(32.062, description="Lower rocker, from J11 to J27.")
    upper: Length = Field(51.764, description="Upper rocker, from J9 to J37.")
    j37_x: Coordinate = Field(63.4, description="Hip J37 in the leg, to the right of J35.")
    j37_y: Coordinate = Field(63.4, description="Hip J37 in the leg, over J35.")
    f_x: Coordinate = Field(-23.2, description="Foot F in the leg, to the right of J35.")
    f_y: Coordinate = Field(-86.6, description="Foot F in the leg, over J35.")

    def points(self) -> Points:
        """Give the points of every link, mm; the leg's frame stands upright as the leg is drawn."""
        return {
            GROUND: {
                "J15": self.j15_x + 1j * self.j15_y,
                "J11": self.j11_x + 1j * self.j11_y,
                "J9": self.j9_x + 1j * self.j9_y,
            },
            "crank": bar("J15", "J29", self.crank),
            "rod": {**bar("J29", "J27", self.rod), "J35": self.j35_x + 1j * self.j35_y},
            "lower": bar("J11", "J27", self.lower),
            "leg": {
                "J35": 0j,
                "J37": self.j37_x + 1j * self.j37_y,
                "F": self.f_x + 1j * self.f_y,
            },
            "upper": bar("J9", "J37", self.upper),
        }
