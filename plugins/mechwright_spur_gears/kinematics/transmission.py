"""The pair as a stage of a chain."""

from fractions import Fraction

import numpy as np

from mechwright import Array, DesignError, Motion, Port, Transmission, Turning
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.kinematics.motion import driven, motion_over


class PairStage(Transmission):
    """Driver in, driven gear out, the other way round."""

    own_drive = ("speed",)
    load_field = "load_torque"

    def __init__(self, m: GearTable) -> None:
        if m.straight:
            raise DesignError(
                'arrangement: a rack slides and has no shaft for the next stage; set arrangement = "external"'
            )
        if m.ring:
            raise DesignError(
                "arrangement: a ring is screwed to what turns with it and has no shaft for the next stage; "
                'set arrangement = "external"'
            )
        self.m = m
        self.input = Port(m.names[0], (0.0, 0.0))
        self.output = Port(m.names[1], (float(m.distance), 0.0))
        ratio = Fraction(int(m.pair.teeth[0]), int(m.pair.teeth[1]))
        self.period = Fraction(ratio.denominator)
        self.advance = -self.period * ratio
        self.speed = float(m.omega)

    def move(self, drive: Turning) -> Turning:
        """By the ratio."""
        return driven(self.m, drive)

    def motion(self, drive: Turning, time: Array) -> Motion:
        """Both gears."""
        return motion_over(self.m, drive, time)

    def power(self, drive: Turning, motion: Motion) -> Array:  # noqa: ARG002 - the ratio has it
        """Of the torque against the driven gear."""
        return np.asarray(self.m.given.load_torque * np.abs(self.move(drive).omega))
