"""Spur gears of one design, or of a table of designs."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mechwright import kept
from mechwright.contracts.design_table import DesignTable
from mechwright.geometry.keyway import Opening
from mechwright.mechanics.gearing.involute import InvolutePair
from mechwright.mechanics.gearing.ring_plate import RingPlate
from mechwright.mechanics.openings import opening_of
from mechwright_spur_gears.pair import pair_of
from mechwright_spur_gears.parameters import SpurGearParams

NAMES: Mapping[str, tuple[str, ...]] = {"external": ("gear-1", "gear-2"), "internal": ("gear-1", "ring")}
"""Arrangement to its toothed parts and bodies: driver and driven gear."""


@dataclass(frozen=True)
class Flank:
    """One gear in one mesh: what a rule is asked of.

    Parameters
    ----------
    mesh, gear
        Places in :attr:`GearTable.meshes` and in that pair.
    words
        The gear in a sentence.
    teeth, shift
        Its keys.
    """

    mesh: int
    gear: int
    words: str
    teeth: str
    shift: str


DRIVER = Flank(0, 0, "gear 1", "teeth", "shift")
FLANKS: Mapping[str, tuple[Flank, ...]] = {
    "external": (DRIVER, Flank(0, 1, "gear 2", "mate_teeth", "mate_shift")),
    "internal": (DRIVER, Flank(0, 1, "the ring", "mate_teeth", "mate_shift")),
}
"""Arrangement to its gears in their meshes."""


class GearTable(DesignTable[SpurGearParams]):
    """The gears of one design, or of designs that differ in their numbers: columns (n, 1)."""

    @cached_property
    def pair(self) -> InvolutePair:
        """Driver and driven gear."""
        return pair_of(self.given)

    @property
    def meshes(self) -> tuple[InvolutePair, ...]:
        """All pairs of gears that mesh."""
        return (self.pair,)

    @property
    def flanks(self) -> tuple[Flank, ...]:
        """Gears in their meshes."""
        return FLANKS[self.given.arrangement]

    @property
    def names(self) -> tuple[str, ...]:
        """Toothed parts."""
        return NAMES[self.given.arrangement]

    @property
    def ring(self) -> bool:
        """Whether the last gear has teeth inside."""
        return self.given.arrangement != "external"

    @property
    def distance(self) -> Any:
        """Of the axes, mm."""
        return abs(self.pair.distance)

    @property
    def ring_plate(self) -> RingPlate:
        """What lies around the teeth of the ring."""
        given, pair = self.given, self.meshes[-1]
        depth = pair.tip(1) - pair.root(1)
        return RingPlate(
            -pair.root(1), given.ring_outside, given.ring_holes, given.ring_hole, pair.module, depth
        )

    @property
    def ratio(self) -> Any:
        """Speed of the driven gear over that of the driver; below 0 if they turn against each other."""
        return -self.pair.teeth[0] / self.pair.teeth[1]

    @property
    def omega(self) -> Any:
        """Of the driver, rad/s."""
        return self.given.speed * math.tau / 60

    @property
    def opening(self) -> Opening | None:
        """Of all gears with a shaft, of one design."""
        return opening_of(self.given)

    def number_of(self, flank: Flank) -> int:
        """Teeth of a gear of one design."""
        return abs(int(np.ravel(self.meshes[flank.mesh].teeth[flank.gear])[0]))


def table_of(params: SpurGearParams, size: int | None = None) -> GearTable:
    """The gears of a design, kept with all that is computed of them; or a table of ``size`` designs."""
    return _of_one(params) if size is None else GearTable(params, size)


@kept
def _of_one(params: SpurGearParams) -> GearTable:
    return GearTable(params)
