"""A planar linkage as a stage of a chain."""

import math
from fractions import Fraction
from typing import ClassVar

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion
from mechwright.contracts.transmission import Port
from mechwright.contracts.turning import Turning
from mechwright.errors import DesignError, KinematicsError
from mechwright.mechanics.linkage.kinematics.motion import motion_over
from mechwright.mechanics.linkage.kinematics.period import Period, is_lever
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.crank_stage import CrankStage
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.input_range import period_turns
from mechwright.mechanics.planar.machine import Revolute


class OutputStage(CrankStage):
    """Driver in, output out, if the output turns about a pivot of the ground.

    Raises DesignError for a driver that does not turn all the way, or not about a pivot of the ground.
    """

    own_drive: ClassVar[tuple[str, ...]] = ("speed", "direction")
    acceleration_ratio = 0.0

    def __init__(self, table: AnyPlanarTable) -> None:
        self.table = table
        driver, on = table.driver
        pivot = _pivot(self.table, driver)
        if is_lever(self.table) or on != GROUND or pivot is None:
            raise DesignError(
                f"driver: {driver} does not turn all the way about a pivot of the ground, and a stage of a "
                "chain follows a shaft that does; change a length, and leave swing_from and swing_to out"
            )
        self.input = Port(driver, (pivot.real, pivot.imag))
        self.period = Fraction(period_turns(self.table.machine))
        self.speed = table.sense * table.omega
        self.start = self.table.drawn_at
        output = table.output
        out = _pivot(self.table, output)
        if out is not None and output != driver:
            self.output = Port(output, (out.real, out.imag))
            turn = self._output(np.linspace(0.0, math.tau, 721))
            self.advance = Fraction(round(float(turn[-1] - turn[0]) / math.tau))

    def _output(self, phi: Array) -> Array:
        found = self.table.solved_at(phi).bodies[self.table.output].turning.theta
        return np.unwrap(found)

    def move(self, drive: Turning) -> Turning:
        """The output's angle goes on over whole turns; raises KinematicsError where it has no fixed pivot."""
        if self.output is None:
            raise KinematicsError(
                f"output: {self.table.output} does not turn about a pivot of the ground; nothing can "
                "stand behind it"
            )
        found = self.table.solved(drive).bodies[self.table.output].turning
        return Turning(np.unwrap(found.theta), found.omega, found.alpha, found.jerk)

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All links, and forces with the masses of the real parts."""
        return motion_over(self.table, Period(time, drive, self.table.solved(drive)))


def _pivot(table: AnyPlanarTable, link: str) -> complex | None:
    """Where a link is pinned to the ground; None where it is not."""
    for joint in table.machine.between(link, GROUND):
        if isinstance(joint, Revolute):
            return complex(joint.place(GROUND))
    return None
