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
from mechwright.mechanics.gearing.rack_pair import RackPair
from mechwright.mechanics.gearing.rack_plate import RackPlate
from mechwright.mechanics.gearing.ring_plate import RingPlate
from mechwright.mechanics.openings import opening_of
from mechwright_spur_gears.pair import pair_of, ring_pair_of
from mechwright_spur_gears.parameters import SpurGearParams

NAMES: Mapping[str, tuple[str, ...]] = {
    "external": ("gear-1", "gear-2"),
    "internal": ("gear-1", "ring"),
    "planetary": ("sun", "planet", "ring"),
    "rack": ("gear-1", "rack"),
}
"""Arrangement to its toothed parts."""


MEMBERS = ("sun", "ring", "carrier")
"""Of a planetary set: one is fixed, one drives, and one is driven."""

AXIAL_GAP, CARRIER_WALL = 0.5, 3.0
"""mm: between carrier, planets and the heads of their pins; and what stays about holes of a carrier."""

UNEVEN = 1.2
"""Load of the planet that carries most, over the mean."""


@dataclass(frozen=True)
class Flank:
    """One gear in one mesh: what a rule is asked of.

    Parameters
    ----------
    mesh, gear
        Places in :attr:`GearTable.meshes` and in that pair.
    words
        The gear in a sentence.
    teeth, shift, bore
        Its keys.
    again
        Whether it is in a mesh before.
    """

    mesh: int
    gear: int
    words: str
    teeth: str
    shift: str
    bore: str = "bore"
    again: bool = False


DRIVER = Flank(0, 0, "gear 1", "teeth", "shift")
FLANKS: Mapping[str, tuple[Flank, ...]] = {
    "external": (DRIVER, Flank(0, 1, "gear 2", "mate_teeth", "mate_shift")),
    "internal": (DRIVER, Flank(0, 1, "the ring", "mate_teeth", "mate_shift")),
    "planetary": (
        Flank(0, 0, "the sun", "teeth", "shift"),
        Flank(0, 1, "a planet", "mate_teeth", "mate_shift", "pin_diameter"),
        Flank(1, 0, "a planet", "mate_teeth", "mate_shift", "pin_diameter", again=True),
        Flank(1, 1, "the ring", "ring_teeth", "centre_distance"),
    ),
    "rack": (DRIVER, Flank(0, 1, "the rack", "rack_teeth", "shift")),
}
"""Arrangement to its gears in their meshes."""


class GearTable(DesignTable[SpurGearParams]):
    """The gears of one design, or of designs that differ in their numbers: columns (n, 1)."""

    @cached_property
    def pair(self) -> InvolutePair:
        """Driver and driven gear."""
        return pair_of(self.given)

    @cached_property
    def meshes(self) -> tuple[InvolutePair, ...]:
        """All pairs of gears that mesh."""
        return (self.pair, ring_pair_of(self.given, self.pair)) if self.planetary else (self.pair,)

    @property
    def profile(self) -> SpurGearParams:
        """The rack, in modules and degrees."""
        return self.given

    @property
    def dimensions(self) -> Any:
        """The parameters; those of the arrangement are set, and have no None in their types."""
        return self.given

    @property
    def planetary(self) -> bool:
        """Whether planets run between a sun and a ring."""
        return self.given.arrangement == "planetary"

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
        return self.given.arrangement in ("internal", "planetary")

    @property
    def straight(self) -> bool:
        """Whether a pinion drives a rack."""
        return self.given.arrangement == "rack"

    @property
    def rack_pair(self) -> RackPair:
        """Pinion and rack."""
        assert isinstance(self.pair, RackPair)  # noqa: S101 - asked of racks alone
        return self.pair

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
    def rack_plate(self) -> RackPlate:
        """The rack as a plate."""
        given, pair = self.dimensions, self.rack_pair
        return RackPlate(
            pair.module,
            pair.angle,
            given.rack_teeth,
            pair.module * math.pi / 2 - pair.backlash / 2,
            pair.module * pair.addendum[1],
            pair.module * pair.dedendum,
            pair.module * pair.tip_radius,
            given.rack_height,
            given.rack_holes,
            given.rack_hole,
        )

    @property
    def swing(self) -> Any:
        """Angle, rad, of a rack's pinion over the travel."""
        return self.dimensions.travel / self.pair.operating(0)

    @property
    def pinion_start(self) -> float:
        """Angle, rad, of the pinion of one rack in the middle of the travel: tooth 0 is next to +x."""
        pitch = math.tau / int(self.given.teeth)
        below = -math.pi / 2 + (pitch / 2 if int(self.dimensions.rack_teeth) % 2 else 0.0)
        return math.remainder(below, pitch)

    @property
    def ratio(self) -> Any:
        """Speed of the driven gear over that of the driver; below 0 if they turn against each other."""
        return self.rate(self.driven) if self.planetary else -self.pair.teeth[0] / self.pair.teeth[1]

    @property
    def driven(self) -> str:
        """The driven body."""
        if not self.planetary:
            return self.names[1]
        (found,) = {*MEMBERS} - {self.given.fixed_member, self.given.driving_member}
        return found

    def rate(self, member: str) -> Any:
        """Speed of sun, ring, carrier or planets over that of the driver.

        z_s ω_s + z_r ω_r = (z_s + z_r) ω_c, with one of them at rest (Willis).
        """
        sun, ring, given = self.given.teeth, self.dimensions.ring_teeth, self.dimensions
        weights = {"sun": sun, "ring": ring, "carrier": -(sun + ring)}
        if member == "planet":
            carrier = self.rate("carrier")
            return carrier - (self.rate("sun") - carrier) * sun / given.mate_teeth
        if member == given.fixed_member:
            return 0.0 * sun
        return (
            1.0 + 0.0 * sun
            if member == given.driving_member
            else -weights[given.driving_member] / weights[member]
        )

    def lever(self, member: str) -> Any:
        """Of the forces between teeth about a member's axis, mm: its torque over what one mesh carries."""
        sun, ring = self.pair.base(0), abs(self.meshes[-1].base(1))
        return {"sun": sun, "ring": ring, "carrier": sun + ring}[member]

    @property
    def normal_force(self) -> Any:
        """Between flanks by the load, N; planets share it."""
        given, driven = self.dimensions, self.driven
        if self.straight:
            return given.load_force / np.cos(self.pair.angle)
        if self.planetary:
            return 1000 * UNEVEN * given.load_torque / (given.planets * self.lever(driven))
        return 1000 * given.load_torque / abs(self.pair.base(1))

    @property
    def places(self) -> Any:
        """Angles (n, planets), rad, of the planets: those where they mesh nearest to equal spaces."""
        whole = np.reshape(self.given.teeth + self.dimensions.ring_teeth, (-1, 1))
        steps = np.arange(self.dimensions.planets) / self.dimensions.planets
        return math.tau * np.floor(whole * steps + 0.5) / whole

    @property
    def gap(self) -> Any:
        """Between the tips of the two planets that are nearest to each other, modules."""
        places = self.places
        between = np.diff(places, axis=1, append=places[:, :1] + math.tau).min(axis=1, keepdims=True)
        chord = 2 * np.reshape(self.distance, (-1, 1)) * np.sin(np.minimum(between, math.pi) / 2)
        return (chord - 2 * np.reshape(self.pair.tip(1), (-1, 1))) / np.reshape(self.pair.module, (-1, 1))

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
        if self.straight and flank.gear:
            return int(self.dimensions.rack_teeth)
        return abs(int(np.ravel(self.meshes[flank.mesh].teeth[flank.gear])[0]))


def table_of(params: SpurGearParams, size: int | None = None) -> GearTable:
    """The gears of a design, kept with all that is computed of them; or a table of ``size`` designs."""
    return _of_one(params) if size is None else GearTable(params, size)


@kept
def _of_one(params: SpurGearParams) -> GearTable:
    return GearTable(params)
