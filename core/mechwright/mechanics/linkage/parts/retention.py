"""What keeps the driven link's shaft from lifting out of the ground plate: a circlip on it under the plate.

A design that says where the screws of its ground plate stand is one for a frame, in which a coupling must not
carry the shaft. Its shaft has a groove where a circlip of its diameter is sold.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from mechwright.contracts.axial_stack import AxialStack, StackLength
from mechwright.contracts.general_tolerances import general_length
from mechwright.contracts.turned import Groove, Length, Step, Turned
from mechwright.errors import DesignError
from mechwright.mechanics.linkage.mass import Mass, cylinder_mass
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.pins import Pin
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT, LENGTH, LIMIT, PIN_MATERIAL
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.standards.circlips import Circlip, shaft_circlip

UNDER = 0.4
"""Between the ground plate and the circlip, mm."""

WALL = (0.0, 0.1)
"""Limits of the length from the shaft's upper end to the loaded wall of the groove, mm."""

LOADED = "upper end of the shaft to the loaded wall of the groove"
"""Name of that length."""

PLAY = (0.1, 1.5)
"""Float of the shaft that is meant, mm, as links have it between them."""


@dataclass(frozen=True)
class Retention:
    """A circlip on the shaft: the pin, and the heights of its ends and of the groove's lower wall, mm."""

    pin: Pin
    low: float
    high: float
    wall: float
    ring: Circlip

    @property
    def neck(self) -> float:
        """How far groove and ring reach down from the ground plate, with the edge under the groove, mm."""
        return UNDER + self.ring.thickness + self.ring.edge

    @property
    def form(self) -> Turned:
        """The shaft with its groove."""
        at = self.wall - self.low
        groove = Groove(at, self.ring.width, self.ring.groove, self.ring.tolerance)
        length = Length(LOADED, at, self.high - self.low, *WALL)
        steps = [Step(self.ring.size, self.high - self.low)]
        if self.pin.head:
            steps.append(Step(HEAD * self.ring.size, HEAD_HEIGHT * self.ring.size))
        return Turned(tuple(steps), grooves=(groove,), lengths=(length,))

    def masses(self) -> Iterator[Mass]:
        """The ring, and what the groove takes away."""
        cut = cylinder_mass(self.ring.size, self.ring.width, PIN_MATERIAL, self.pin.place, self.ring.groove)
        yield Mass(-cut.mass, cut.centre, -cut.inertia)
        mass = self.ring.mass / 1000
        yield Mass(mass, self.pin.place, mass * (self.ring.groove**2 + self.ring.room**2) / 8)


def retention_of(layout: Layout) -> Retention | None:
    """The circlip of the driven link's shaft; None where the shaft has none."""
    sizes = layout.sizes
    pin = next((one for one in layout.pins if one.below), None)
    if pin is None or (sizes.screw_hole is None and sizes.screw_offset is None):
        return None
    try:
        ring = shaft_circlip(sizes.pin_diameter)
    except DesignError:
        return None
    low, high = layout.stack.spans[pin.name]
    bottom = layout.stack.bottom(GROUND)
    end = low - pin.below * sizes.pin_diameter
    wall = bottom - UNDER - ring.thickness
    return Retention(pin, end, high + pin.above * sizes.pin_diameter, wall, ring)


def stacks_of(layout: Layout) -> Iterator[AxialStack]:
    """The float of the shaft between the driven link and its circlip, where the link lies on the ground."""
    held = retention_of(layout)
    if held is None or len(held.pin.pressed) != 1 or held.pin.above:
        return
    link, sizes, ring = held.pin.pressed[0], layout.sizes, held.ring
    top = layout.stack.bottom(GROUND) + sizes.ground_thickness
    if abs(layout.bottom(link) - top - sizes.washer) > UNDER:
        return
    under, size = sizes.ground_thickness, sizes.thickness_of(link)
    off = general_length(size, "medium")
    if sizes.bushing_wall > 0:
        name = "bushing-ground" if under != sizes.thickness else "bushing"
        ground = StackLength(LENGTH, -1, under + sizes.washer, -LIMIT, LIMIT, part=name)
    else:
        loose = general_length(under, "medium")
        ground = StackLength(f"{GROUND}, ISO 2768-m", -1, under, -loose, loose, part=GROUND.lower())
    yield AxialStack(
        "float of the shaft",
        (
            StackLength.of(held.form.length_of(LOADED), 1, held.pin.name),
            StackLength(f"{link}, ISO 2768-m", -1, size, -off, off, part=link.lower()),
            ground,
            StackLength("circlip", -1, ring.thickness, -ring.thinner, 0.0, True, ring.part_name),
        ),
        PLAY[0],
        PLAY[1],
        adjustable=LOADED,
    )
