"""A pair as a stage of a chain."""

import math

import numpy as np

from mechwright import Array, DesignError, Motion, Port, Transmission, Turning
from mechwright_elliptic_gears.kinematics.equations import driven
from mechwright_elliptic_gears.kinematics.motion import driven_by
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of


class PairStage(Transmission):
    """Gear 2 in, gear 4 out, the other way round.

    Raises DesignError for a train: its coupler passes over its last shaft.
    """

    own_drive = ("speed",)
    load_field = "load_torque"

    def __init__(self, params: EllipticGearParams) -> None:
        if params.stages > 1:
            raise DesignError(
                "stages: a train has no shaft for a next stage, its coupler passes over it; make each pair "
                "a stage of its own, with stages = 1"
            )
        self.params = params
        self.input = Port("gear-2", (0.0, 0.0))
        self.output = Port("gear-4", (2 * ellipse_of(params).semi_major, 0.0))
        self.advance = -self.period
        self.speed = params.speed * math.tau / 60

    def move(self, drive: Turning) -> Turning:
        """By equations (5) to (7)."""
        return driven(drive, self.params.eccentricity)

    def motion(self, drive: Turning, time: Array) -> Motion:
        """Both gears and the coupler's line."""
        return driven_by(self.params, drive, time)

    def power(self, drive: Turning, motion: Motion) -> Array:  # noqa: ARG002 - the ratio has it
        """Of the torque against gear 4."""
        return self.params.load_torque * np.abs(self.move(drive).omega)
