"""Quick returns: a crank whose pin slides in a lever, and a ram."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

from pydantic import Field

from mechwright_linkage.catalogue.entry import GROUND, Angle, Coordinate, Entry, Length, Prismatic, pins
from mechwright_linkage.linkage import Place
from mechwright.mechanics.planar.machine import Joint


class CrankShaper(Entry):
    """A crank drives a slotted lever that swings, and the lever a ram through a rod: the shaper's quick return."""

    title: ClassVar[str] = "Crank-shaper quick return"
    source: ClassVar[str] = "M. I. Campbell and S. S. Nestinger, Computer-Aided Design of Mechanisms, UC Davis 2004"
    output: ClassVar[str] = "ram"
    start: ClassVar[float] = 0.0

    crank: Length = Field(10.0, description="Crank, from A0 to its pin A.")
    centre_distance: Length = Field(25.0, description="From the lever's pivot B0 up to the crank's A0.")
    lever: Length = Field(65.0, description="Lever, from B0 to the rod's pin D.")
    rod: Length = Field(30.0, description="Rod, from D to the ram's pin E.")
    ram_height: Coordinate = Field(50.0, description="Height of the ram's line over B0.")
    ram_angle: Angle = Field(0.0, description="Direction of the ram's line from X.")

    def points(self) -> Mapping[str, Mapping[str, Place]]:
        return {
            GROUND: {"A0": 1j * self.centre_distance, "B0": 0j, "R": 1j * self.ram_height},
            "crank": {"A0": 0j, "A": self.crank + 0j},
            "block": {"A": 0j},
            "lever": {"B0": 0j, "D": self.lever + 0j},
            "rod": {"D": 0j, "E": self.rod + 0j},
            "ram": {"E": 0j},
        }

    def joints(self) -> Sequence[Joint]:
        import numpy as np

        p = self.points()
        slides = [
            Prismatic("lever-slide", "lever", "block", 0j, 0j),
            Prismatic("ram-slide", GROUND, "ram", p[GROUND]["R"], 0j, np.radians(self.ram_angle)),
        ]
        return [
            *pins(p, A0=(GROUND, "crank"), A=("crank", "block"), B0=(GROUND, "lever"), D=("lever", "rod")),
            *pins(p, E=("rod", "ram")),
            *slides,
        ]

    def branches(self) -> Mapping[str, int]:
        return {"lever-slide": 1, "E": -1}
