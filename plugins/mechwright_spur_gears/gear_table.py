"""A pair of spur gears, or a table of pairs."""

import math
from functools import cached_property
from typing import Any

from mechwright import kept
from mechwright.contracts.design_table import DesignTable
from mechwright.geometry.keyway import Opening
from mechwright.mechanics.gearing.involute import InvolutePair
from mechwright.mechanics.openings import opening_of
from mechwright_spur_gears.pair import pair_of
from mechwright_spur_gears.parameters import SpurGearParams

NAMES = ("gear-1", "gear-2")
"""Bodies and parts: driver and driven gear."""


class GearTable(DesignTable[SpurGearParams]):
    """One pair, or pairs that differ in their numbers; numbers of one, columns (n, 1) of many."""

    @cached_property
    def pair(self) -> InvolutePair:
        """Both gears."""
        return pair_of(self.given)

    @property
    def ratio(self) -> Any:
        """Speed of the driven gear over that of the driver, above 0."""
        return self.pair.teeth[0] / self.pair.teeth[1]

    @property
    def omega(self) -> Any:
        """Of the driver, rad/s."""
        return self.given.speed * math.tau / 60

    @property
    def opening(self) -> Opening | None:
        """Of both gears of one pair."""
        return opening_of(self.given)


def table_of(params: SpurGearParams, size: int | None = None) -> GearTable:
    """The pair of a design, kept with all that is computed of it; or a table of ``size`` pairs."""
    return _of_one(params) if size is None else GearTable(params, size)


@kept
def _of_one(params: SpurGearParams) -> GearTable:
    return GearTable(params)
