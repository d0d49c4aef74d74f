"""What keeps the pin of a dividing circle down: a stepped washer beside it, screwed to gear 4.

Its lower step is as high as the pin's head, its upper one reaches over the head. With two circles one keeper
stands between both pins' places and reaches over either.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Bore, Turned
from mechwright.contracts.details import Thread
from mechwright.contracts.turned import Step
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.standards.screws import Screw, least_engaged, lengths, screw
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.dividing import START, Dividing
from mechwright_elliptic_gears.parts.gear import rack_of, room

SIZE = 3.0
"""Of its screw, M."""

WALL, OVER, PLAY = 1.3, 1.5, 0.25
"""Of its lower step around the screw, overlap with the head, and air beside and over the head, mm."""

PLATE = 2.0
"""Height of its upper step, mm."""

HEAD_GAP = 0.5
"""Between the screw's head and the coupler, mm."""


@dataclass(frozen=True)
class Keeper:
    """Sizes, mm.

    Parameters
    ----------
    screw
        From above into gear 4.
    place
        Of its axis in the frame of gear 4, x + i y.
    low, foot, top
        Height and diameter of the lower step, diameter of the upper one.
    """

    screw: Screw
    place: complex
    low: float
    foot: float
    top: float

    @property
    def crown(self) -> float:
        """From gear 4 to the coupler, which passes over the screw."""
        return self.low + PLATE + self.screw.of.head_height + HEAD_GAP

    @property
    def turned(self) -> Turned:
        """The stepped washer, on its lower step."""
        steps = (Step(self.foot, self.low), Step(self.top, PLATE))
        return Turned(steps, bore=self.screw.of.clearance())

    @property
    def core(self) -> float:
        """Diameter of the hole in gear 4 before it is threaded."""
        return round(Thread("thread", (0.0, 0.0), SIZE, self.screw.of.pitch, 1.0).core, 6)

    def hole(self, thickness: float) -> Bore:
        """The hole of gear 4."""
        return Bore("keeper", (self.place.real, self.place.imag), self.core, 0, thickness)

    def thread(self, thickness: float) -> Thread:
        """The thread of gear 4, a pitch deeper than the screw comes."""
        deep = min(thickness, self.screw.length - self.low - PLATE + self.screw.of.pitch)
        return Thread("thread-keeper", (self.place.real, self.place.imag), SIZE, self.screw.of.pitch, deep)


def keeper_for(params: EllipticGearParams, dividing: Dividing, head: tuple[float, float]) -> Keeper | None:
    """The keeper of a pin with a head of that diameter and height, mm; None where there is no room."""
    low = head[1] + PLAY
    under, most = low + PLATE, low + PLATE + params.thickness - PLAY
    wanted = [one for one in lengths(SIZE) if under + least_engaged(params.material) * SIZE <= one <= most]
    if not wanted:
        return None
    chosen = screw(SIZE, wanted[0])
    foot = chosen.of.clearance() + 2 * WALL
    apart = (foot + head[0]) / 2 + PLAY
    rings = dividing.rings
    middle, half = (rings[0] + rings[-1]) / 2, (rings[-1] - rings[0]) / 2
    if half >= apart:
        return None
    # Beside the pins, on the side away from the joint of gear 4.
    place = complex(middle, -math.sqrt(apart**2 - half**2)) * complex(math.cos(START), math.sin(START))
    keeper = Keeper(chosen, place, low, foot, 2 * (apart - head[0] / 2 + OVER))
    rim = float(room(params, np.array([[place.real, place.imag]])) - keeper.core / 2)
    return keeper if rim >= LEAST_RIM * rack_of(params).module else None
