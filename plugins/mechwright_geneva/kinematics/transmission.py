"""The Geneva mechanism as a stage of a chain."""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from mechwright import Array, DesignError, Index, Motion, Port, Stage, Transmission, Turning, refuse
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.motion import DRIVER, WHEEL, at_angle, driven_by
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.rules.feasibility import FEASIBLE


class WheelStage(Transmission):
    """Driver in, by the angle θd that rises clockwise from the first entry; wheel out, counter-clockwise.

    A driver that is turned backwards runs through its strokes the other way.
    """

    own_drive = ("speed", "driver_law", "driver_acceleration", "driver_variation", "driver_direction")
    turns_on = True
    load_field = "load_torque"

    def __init__(self, params: GenevaParams) -> None:
        self.m = m = mechanism_of(params)
        refuse(FEASIBLE.findings(m), Stage.MOTION)
        self.input = Port(DRIVER, (m.axes, 0.0), -1)
        self.output = Port(WHEEL, (0.0, 0.0))
        self.advance = Fraction(params.rollers, params.slots)
        self.speed = m.driver.sense * m.driver.speed
        self.start = m.driver.start

    def move(self, drive: Turning) -> Turning:
        """By the law of a stroke, and at rest between strokes."""
        m = self.m
        turn, moving, run = at_angle(m, drive.theta)
        rates = (np.where(moving, one, 0.0) for one in drive.carried(run.first, run.second, run.third))
        return Turning(2 * m.wheel_half * turn + run.theta, *rates)

    def motion(self, drive: Turning, time: Array) -> Motion:
        """Wheel, driver and rollers, and the contact as this motion loads it."""
        return driven_by(self.m, drive, time)

    def power(self, drive: Turning, motion: Motion) -> Array:
        """Of inertia and torque at the wheel."""
        return np.asarray(motion["crank_torque"] * drive.omega)

    def at(self, angle: Array) -> tuple[Array, Turning]:
        """By the law of its own driver, which has to be the same every turn."""
        driver = self.m.driver
        if driver.law not in {"constant", "harmonic"}:
            raise DesignError(
                f'driver_law: "{driver.law}" is no motion that turns repeat, and a chain runs on; take '
                '"constant" or "harmonic"'
            )
        return driver.time(angle), driver.at(angle)

    def indexes(self) -> Sequence[Index]:
        """One for each roller."""
        m = self.m
        return [
            Index(k * m.pitch, k * m.pitch + 2 * m.crank_half, 2 * m.wheel_half)
            for k in range(m.params.rollers)
        ]
