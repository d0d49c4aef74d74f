"""A joint that is clamped in a slot: a stud in the plate with the slot, held by a cap screw from above.

The stud turns in the bore of the other link, below the plate: its head carries that link, its upper end bears
on the plate, and the screw draws both together over a washer. The slot is as wide as the screw's clearance
hole, and narrower than the stud, so that the stud's end has a face to bear on.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from mechwright.contracts.part import Instance, Part
from mechwright.contracts.turned import Step, Turned
from mechwright.mechanics.linkage.turned import PIN_MATERIAL, STEEL
from mechwright.mechanics.strength.bolts import FRICTION, preload, stress_area, tightening_torque
from mechwright.standards.screws import (
    ENGAGEMENT,
    Screw,
    ScrewSize,
    lengths,
    screw,
    screw_sizes,
    washer,
)

FACE = 0.7
"""Widest slot, in diameters of the stud: half of its end's area is left to bear."""

SPARE = 0.5
"""Of land beside a washer, mm."""


@dataclass(frozen=True)
class Clamp:
    """A screw with the washer and the slot that belong to it; lengths in mm, forces in N."""

    screw: Screw

    @property
    def size(self) -> ScrewSize:
        """Of the thread."""
        return self.screw.of

    @property
    def width(self) -> float:
        """Of the slot: the screw's clearance hole, ISO 273 medium."""
        return self.size.clearance()

    @property
    def washer(self) -> tuple[float, float]:
        """Diameter and height of the washer."""
        return self.size.washer[1], self.size.washer[2]

    @property
    def reach(self) -> float:
        """From the centre line of the slot to the edge of the least land: the washer lies on it."""
        return self.washer[0] / 2 + SPARE

    @property
    def preload(self) -> float:
        """What the screw is tightened to."""
        return preload(stress_area(self.size.size, self.size.pitch))

    @property
    def tightening(self) -> float:
        """Torque for it, N m."""
        of = self.size
        return tightening_torque(self.preload, of.size, of.pitch, of.head, self.width)

    @property
    def holds(self) -> float:
        """Force along the slot at which it slips: one face, as the screw may give in its hole."""
        return FRICTION * self.preload


def clamps(
    stud: float, plate: float, length: float, engaged: float = ENGAGEMENT[PIN_MATERIAL]
) -> list[Clamp]:
    """Clamps for a stud of a diameter and length, through a plate so thick, mm, the largest first.

    The screw goes ``engaged`` diameters deep at least, and not through. Empty where there is none.

    >>> [one.screw.bought.designation for one in clamps(8.0, 6.0, 8.0)]
    ['ISO 4762 - M5 x 12 - 8.8', 'ISO 4762 - M4 x 12 - 8.8', 'ISO 4762 - M3 x 10 - 8.8']
    """
    found = []
    for size in sorted(_sizes(), key=lambda one: -one.size):
        under = (size.washer[2] if size.washer else 0.0) + plate
        least, most = under + engaged * size.size, under + length
        fitting = [one for one in lengths(size.size) if least <= one <= most]
        if fitting and size.clearance() <= FACE * stud:
            found.append(Clamp(screw(size.size, fitting[0])))
    return found


def least_stud(force: float = 0.0) -> float:
    """Diameter, mm, of the least stud with a screw whose clamp holds a force, N; infinite where none does.

    >>> least_stud(), least_stud(1e6)
    (4.9, inf)
    """
    able = [one for one in _sizes() if Clamp(Screw("cap", one, 0.0)).holds >= force]
    least = min((one.clearance() / FACE for one in able), default=math.inf)
    return least if math.isinf(least) else math.ceil(10 * least - 1e-9) / 10


def _sizes() -> list[ScrewSize]:
    return [one for one in screw_sizes() if one.head and one.washer]


def stud_part(
    name: str, diameter: float, length: float, head: tuple[float, float], clamp: Clamp, at: Instance
) -> Part:
    """A stud on its head (diameter and height, mm), threaded through; ``length`` is that over the head."""
    steps = (Step(head[0], head[1]), Step(diameter, length))
    size = clamp.size.size
    note = f"M{size:g} through, tapping drill {clamp.size.tap_drill:g} mm"
    turned = Turned(steps, bore=size, note=note, tapped=True)
    return Part(name, None, 0.0, PIN_MATERIAL, (at,), STEEL, turned=turned)


def screw_parts(name: str, clamp: Clamp, seats: Sequence[Instance], *, upwards: bool = False) -> list[Part]:
    """Washers and screws of clamps on plates' faces: each seat is an instance at the face.

    Screws point down from an upper face, or ``upwards`` from a lower one.
    """
    ring, bought = washer(clamp.size.size), clamp.screw.bought
    if upwards:
        seats = [replace(seat, z=seat.z - ring.height) for seat in seats]
        if bought.shape is not None:
            bought = replace(bought, shape=bought.shape.turned_over())
    heads = tuple(replace(seat, z=seat.z + (0.0 if upwards else ring.height)) for seat in seats)
    return [
        Part(f"{name}-washer", None, 0.0, PIN_MATERIAL, tuple(seats), STEEL, bought=ring.bought),
        Part(f"{name}-screw", None, 0.0, PIN_MATERIAL, heads, STEEL, bought=bought),
    ]
