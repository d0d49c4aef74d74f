"""How evenly a motor turns the input: its least, mean and greatest speed over the turn."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.machine.drive import Drive
from mechwright.mechanics.strength.motor_speed import Line, steady_run
from mechwright.standards.motors import NOMINAL_VOLTAGE, GearMotor, Stepper


@dataclass(frozen=True, eq=False)
class InputSpeed:
    """The speed of the input with a motor, in the run in which it strays farther.

    Parameters
    ----------
    run
        ``"forwards"`` or ``"backwards"``.
    angle, speed
        (n,) rad of the course and rad/s, in the order of the running, both ends of the period included; empty
        if the motor stalls.
    requested
        Mean over time, rad/s: that of the drive.
    voltage
        At which the motor has that mean, V.
    """

    run: str
    angle: Array
    speed: Array
    requested: float
    voltage: float

    @property
    def stalls(self) -> bool:
        """Whether the motor stops within the turn at every voltage at which its mean were so low."""
        return self.speed.size == 0

    @property
    def least(self) -> float:
        """rad/s."""
        return 0.0 if self.stalls else float(self.speed.min())

    @property
    def greatest(self) -> float:
        """rad/s."""
        return math.inf if self.stalls else float(self.speed.max())

    @property
    def deviation(self) -> float:
        """Greatest difference from the speed that is requested, as a share of it."""
        return max(self.greatest - self.requested, self.requested - self.least) / self.requested


def input_speed(
    drive: Drive, motor: Stepper | GearMotor, gear: float, efficiency: float, voltage: float
) -> InputSpeed | None:
    """The speed of the input of a drive with a motor that is enough for it.

    A stepper keeps its steps. A gear motor runs on its line, driving and braking, at the constant voltage
    that gives the mean speed. The inertia that the input feels evens the speed out. That of the motor's rotor
    is not in the table and not counted; it would even the speed out further. Loads count without the margin.

    None for an input that swings, or does not turn at one speed: what drives it follows a law. ``voltage``,
    V, is that of a stepper's driver.
    """
    if not drive.uniform:
        return None
    course, requested = drive.course, drive.mean_speed
    if isinstance(motor, Stepper):
        ends = course.angle[[0, -1]]
        return InputSpeed(drive.runs[0].name, ends, np.full(2, requested), requested, voltage)
    line = Line(motor.no_load * math.tau / 60 / gear, motor.stall_torque * gear, efficiency)
    found = [_of_run(drive, number, line) for number in range(len(drive.runs))]
    return max(found, key=lambda one: one.deviation)


def _of_run(drive: Drive, number: int, line: Line) -> InputSpeed:
    run, angle = drive.runs[number], drive.course.angle
    way = np.abs(angle - angle[0])
    step = float(way[-1]) / (way.size - 1)
    even = step * np.arange(way.size - 1)
    load = np.interp(even, way, run.torque - drive.inertia_of(number))
    inertia = np.interp(even, way, drive.reflected)
    places = np.interp(even, way, angle)
    if run.name == "backwards":
        load, inertia, places = load[::-1], inertia[::-1], places[::-1]
    found = steady_run(inertia, load, step, drive.mean_speed, line)
    if found is None:
        return InputSpeed(run.name, places[:0], places[:0], drive.mean_speed, math.nan)
    # The start comes back at the end: in front where the run goes back from there.
    if run.name == "backwards":
        places, speed = np.append(angle[-1], places), np.append(found.speed[-1], found.speed)
    else:
        places, speed = np.append(places, angle[-1]), np.append(found.speed, found.speed[0])
    return InputSpeed(run.name, places, speed, drive.mean_speed, found.share * NOMINAL_VOLTAGE)
