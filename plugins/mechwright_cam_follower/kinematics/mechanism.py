"""The table of cams with their followers: what all formulas take.

Every quantity is a number for one design and a column (n, 1) for many, which have segments, laws and kinds in
common; lengths in mm, angles in rad.
"""

import math
from functools import cached_property
from typing import Any

import numpy as np

from mechwright import kept
from mechwright.contracts.design_table import DesignTable, number
from mechwright_cam_follower.kinematics.cycle import Cycle, cycle_of
from mechwright_cam_follower.parameters import CamParams


class Mechanism(DesignTable[CamParams]):
    """A cam with its follower, or cams that have their segments and laws in common."""

    def value(self, name: str) -> Any:
        """Give a field that belongs to one kind of follower, or its default."""
        return self.once(name, lambda: self.given.value(name))

    @cached_property
    def cycle(self) -> Cycle:
        """The segments of a turn; its laws have no fault."""
        return cycle_of(self.given)

    @property
    def slides(self) -> bool:
        """Whether the follower slides; else it is a lever."""
        return self.given.translating

    @property
    def railed(self) -> bool:
        """Whether rails that are cut from plate guide the follower."""
        return self.slides and self.given.linear_guide is None

    @property
    def flat(self) -> bool:
        """Whether the follower has a flat face; else it has a roller."""
        return self.given.contact == "flat"

    @property
    def cams(self) -> range:
        """The numbers of the cams, from 0: two of a conjugate pair."""
        return range(1 + self.given.conjugate)

    @property
    def sense(self) -> int:
        """1 where the cam turns counter-clockwise, -1 where it turns clockwise."""
        return self.given.sense

    @property
    def omega(self) -> Any:
        """Speed of the cam, rad/s."""
        return self.given.omega

    @property
    def face(self) -> Any:
        """From a lever's axis to its flat face."""
        return self.given.face

    @property
    def roller(self) -> Any:
        """Radius of the rollers; 0 of a flat face."""
        return 0.0 if self.flat else self.value("roller_radius")

    @property
    def offset(self) -> Any:
        """How far the way of a slide's roller, or the middle of its face, is off the cam's axis."""
        return 0.0 if self.flat else self.value("offset")

    @property
    def axis(self) -> Any:
        """From the cam's axis to the lever's."""
        return self.value("centre_distance")

    @property
    def arm(self) -> Any:
        """From the lever's axis to its roller."""
        return self.value("arm_length")

    @property
    def stroke(self) -> float:
        """Greatest lift, mm, or swing, rad."""
        return self.given.stroke if self.slides else math.radians(self.given.stroke)

    @property
    def prime(self) -> Any:
        """Radius of the prime circle; of a flat face that of the base circle."""
        return self.given.base_radius + self.roller

    @cached_property
    def start(self) -> Any:
        """Height of the follower over the cam's axis where it is lowest; of a lever the angle γ0 or ν0.

        It is no number where a design does not close.
        """
        if self.slides:
            return self.prime if self.flat else number(np.sqrt(self.prime**2 - self.offset**2))
        if self.flat:
            return number(np.arccos((self.prime + self.face) / self.axis))
        axis, arm = self.axis, self.arm
        return number(np.arccos((axis**2 + arm**2 - self.prime**2) / (2 * axis * arm)))

    @property
    def apart(self) -> Any:
        """From the first roller to the second of a conjugate pair, downwards; of a lever between its arms.

        Both cams then have one base circle.
        """
        return 2 * self.start + self.stroke


@kept
def mechanism_of(params: CamParams) -> Mechanism:
    """Give the mechanism of one design."""
    return Mechanism(params)
