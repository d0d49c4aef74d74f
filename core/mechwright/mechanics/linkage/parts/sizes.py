"""Sizes of what a linkage is made of."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Sizes:
    """Sizes of plates, pins and slots, mm.

    Parameters
    ----------
    pin_diameter
        Of all pins and of the driven link's shaft.
    bushing_wall
        Wall of the bushings in which pins turn, and of those that run in slots; 0 for none.
    running_fit
        Diameter by which a bore or a slot is larger than what runs in it.
    rim
        Material of the plates around bores and slots.
    web_width
        Width of a link with two eyes between them.
    thickness, ground_thickness
        Of the links and of the ground plates.
    clearance
        Least distance in plan of what moves in one layer; also of a slot's end from what runs in it.
    washer
        Air between the layers.
    guide_length
        Distance of the two pins of a block that is a plate, along its slide.
    screw_hole
        Diameter of the holes in the corners of the ground plates; None for that of the pins.
    screw_offset
        Least distance of these holes from the line along X through the middle of the ground's pivots; None
        for as near as its bores leave room.
    frame
        Ground plates: one below the links, two with links between, or one where that goes.
    material
        Of the plates.
    """

    pin_diameter: float = 6.0
    bushing_wall: float = 1.0
    running_fit: float = 0.03
    rim: float = 4.0
    web_width: float = 10.0
    thickness: float = 6.0
    ground_thickness: float = 8.0
    clearance: float = 1.0
    washer: float = 0.5
    guide_length: float = 30.0
    screw_hole: float | None = None
    screw_offset: float | None = None
    frame: Literal["auto", "one", "two"] = "auto"
    material: str = "aluminium"

    @property
    def turning_bore(self) -> float:
        """Diameter of a bore in which a pin turns, with or without a bushing."""
        return self.pin_diameter + (2 * self.bushing_wall if self.bushing_wall > 0 else self.running_fit)

    @property
    def roller(self) -> float:
        """Diameter of what runs in a slot: a bushing, or the pin itself."""
        return self.pin_diameter + 2 * self.bushing_wall

    @property
    def slot_width(self) -> float:
        """Of a slot for that."""
        return self.roller + self.running_fit

    @property
    def hole(self) -> float:
        """Diameter of the holes in the corners of the ground plates."""
        return self.screw_hole or self.pin_diameter

    @property
    def corner(self) -> float:
        """Radius of those corners."""
        return self.hole / 2 + self.rim

    def thickness_of(self, plate: str) -> float:
        """Of a plate by its name."""
        from mechwright.mechanics.linkage.parts.scheme import GROUND_PLATES

        return self.ground_thickness if plate in GROUND_PLATES else self.thickness
