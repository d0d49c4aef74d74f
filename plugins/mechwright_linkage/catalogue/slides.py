"""Linkages with a slide: Scotch yoke, toggle press and scissor lift."""

from collections.abc import Mapping, Sequence
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from mechwright.mechanics.planar.machine import Joint
from mechwright.units import Degrees
from mechwright_linkage.catalogue.entry import GROUND, Coordinate, Entry, Length, Points, Prismatic, bar, pins


class ScotchYoke(Entry):
    """A block on the pin of a crank slides in the slot of a yoke, which slides on the ground along X.

    With the slot square to X the yoke moves by crank · cos(angle); the stroke is
    2 · crank/sin(slot angle) for any slot.
    """

    title = "Scotch yoke"
    source = "Crank 40"
    output = "yoke"
    pin_links: ClassVar = {"A0": (GROUND, "crank"), "A": ("crank", "block")}

    crank: Length = Field(40.0, description="Crank, from A0 to its pin A.")
    slot_angle: Annotated[Degrees, Field(ge=20, le=160)] = Field(
        90.0, description="Direction of the yoke's slot from its way."
    )
    guide_height: Coordinate = Field(0.0, description="Height of the yoke's guide over A0.")

    def points(self) -> Points:
        """Give the points of every link, mm; the slot of the yoke goes through its point Y on the guide."""
        return {
            GROUND: {"A0": 0j, "Q": 1j * self.guide_height},
            "crank": bar("A0", "A", self.crank),
            "block": {"A": 0j},
            "yoke": {"Y": 0j},
        }

    def slides(self) -> Sequence[Prismatic]:
        """Give the slot of the yoke and its guide."""
        guide = self.points()[GROUND]["Q"]
        return (
            Prismatic("slot", "yoke", "block", 0j, 0j, np.radians(self.slot_angle)),
            Prismatic("guide", GROUND, "yoke", guide, 0j),
        )


class TogglePress(Entry):
    """A crank and a rod straighten two toggle links, which press a ram down on a line under their pivot.

    Near the straight position the ram nearly stands, and a small moment of the crank presses hard.
    """

    title = "Toggle press"
    source = "Crank 25, rod 95, toggle links 100 and 110"
    output = "ram"
    signs: ClassVar = {"B": 1, "D": 1}
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "A": ("crank", "rod"),
        "B0": (GROUND, "upper"),
        "B": ("rod", "upper", "lower"),
        "D": ("lower", "ram"),
    }

    crank: Length = Field(25.0, description="Crank, from A0 to its pin A.")
    rod: Length = Field(95.0, description="Rod, from A to the toggle's knee B.")
    upper: Length = Field(100.0, description="Upper toggle link, from its pivot B0 to the knee B.")
    lower: Length = Field(110.0, description="Lower toggle link, from the knee B to the ram's pin D.")
    a0_x: Coordinate = Field(130.0, description="Pivot A0 of the crank, to the right of B0.")
    a0_y: Coordinate = Field(-70.0, description="Pivot A0 of the crank, over B0.")

    def points(self) -> Points:
        """Give the points of every link, mm; the upper link's pivot B0 is the origin."""
        return {
            GROUND: {"A0": self.a0_x + 1j * self.a0_y, "B0": 0j},
            "crank": bar("A0", "A", self.crank),
            "rod": bar("A", "B", self.rod),
            "upper": bar("B0", "B", self.upper),
            "lower": bar("B", "D", self.lower),
            "ram": {"D": 0j},
        }

    def slides(self) -> Sequence[Prismatic]:
        """Give the ram's guide; the way counts downwards from B0, and the ram's x axis points down."""
        return (Prismatic("guide", GROUND, "ram", 0j, 0j, -np.pi / 2),)


class ScissorLift(Entry):
    """Stages of crossed arms, which a crank opens and shuts through the sliding foot, lift a level platform.

    The left foot is pinned at the origin, the right one slides on X. A platform on n stages stands at
    n √(arm² - s²) over feet that are s apart.
    """

    title = "Scissor lift"
    source = "Arms of 120 mm in two stages, feet 50 to 100 mm apart"
    output = "platform"
    traces: ClassVar = {"platform": ("platform", "P")}

    arm: Length = Field(120.0, description="Arm, from one end pin to the other.")
    stages: Annotated[int, Field(ge=2, le=8)] = Field(2, description="Stages of two crossed arms.")
    crank: Length = Field(25.0, description="Crank, from A0 to its pin A.")
    rod: Length = Field(90.0, description="Rod, from A to the sliding foot S.")
    a0_x: Coordinate = Field(165.0, description="Pivot A0 of the crank, to the right of the pinned foot.")

    @property
    def pin_joints(self) -> Mapping[str, Sequence[str]]:
        """Pin to the links on it: arms ``rising-k`` to the right, ``falling-k`` to the left, of stage k."""
        links = {
            "A0": (GROUND, "crank"),
            "A": ("crank", "rod"),
            "O": (GROUND, "rising-1"),
            "S": ("slider", "rod", "falling-1"),
        }
        for stage in range(1, self.stages + 1):
            links[f"M{stage}"] = (f"rising-{stage}", f"falling-{stage}")
        for stage in range(1, self.stages):
            links[f"L{stage}"] = (f"falling-{stage}", f"rising-{stage + 1}")
            links[f"R{stage}"] = (f"rising-{stage}", f"falling-{stage + 1}")
        links["P"] = (f"falling-{self.stages}", "platform")
        links["T"] = (f"rising-{self.stages}", "top-slider")
        return links

    def points(self) -> Points:
        """Give the points of every link, mm; the pinned foot O is the origin."""
        points: dict[str, dict[str, complex]] = {
            GROUND: {"A0": self.a0_x + 0j, "O": 0j},
            "crank": {"A0": 0j, "A": self.crank + 0j},
            "rod": {"A": 0j, "S": self.rod + 0j},
            "slider": {"S": 0j},
            "platform": {"P": 0j},
            "top-slider": {"T": 0j},
        }
        for stage in range(1, self.stages + 1):
            below, last = stage - 1, stage == self.stages
            left, right = (f"L{below}", f"R{below}") if below else ("O", "S")
            middle, end = self.arm / 2 + 0j, self.arm + 0j
            points[f"rising-{stage}"] = {left: 0j, f"M{stage}": middle, "T" if last else f"R{stage}": end}
            points[f"falling-{stage}"] = {right: 0j, f"M{stage}": middle, "P" if last else f"L{stage}": end}
        return points

    def slides(self) -> Sequence[Prismatic]:
        """Give the way of the sliding foot, and that of the top slider in the platform."""
        return (
            Prismatic("foot-slide", GROUND, "slider", 0j, 0j),
            Prismatic("top-slide", "platform", "top-slider", 0j, 0j),
        )

    def joints(self) -> Sequence[Joint]:
        """Give the pins and slides of all stages."""
        return [*pins(self.points(), **self.pin_joints), *self.slides()]

    def branches(self) -> Mapping[str, int]:
        """Give the branches: the foot is to the left of the crank's pin, the arms cross over their feet."""
        return {"S": -1, "top-slide": 1, **{f"M{stage}": 1 for stage in range(1, self.stages + 1)}}
