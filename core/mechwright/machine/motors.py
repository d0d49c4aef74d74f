"""The motor of a drive: what it is asked for at its own shaft, and whether it can."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.machine.drive import Drive
from mechwright.machine.settings import MachineSettings
from mechwright.mechanics.strength.motor import (
    INERTIA_RATIO,
    MARGIN,
    PEAK,
    RESONANCE,
    Demand,
    corner_speed,
    dc_torque,
    gear_motor_margin,
    inertia_ratio,
    stepper_margin,
    stepper_torque,
)
from mechwright.standards.motors import GearMotor, Stepper, motor, motors
from mechwright.tolerances import exceeds

if TYPE_CHECKING:
    from mechwright.machine.speeds import InputSpeed

EFFICIENCY = 0.9
"""Of a belt or gears between motor and input; a handbook figure."""

ENDLESS = 1e6
"""Cover of a demand that is next to nothing."""

STEPS = 200
"""Full steps of a turn of a stepper."""

Motor = Stepper | GearMotor


@dataclass(frozen=True)
class Choice:
    """A motor and how it stands to its drive.

    Parameters
    ----------
    motor
        As the standards know it.
    demand
        At its shaft, the margin of the design included.
    cover
        How often what it may give covers that; at least 1 is enough.
    ratio
        Of the greatest inertia that it feels to its rotor's; None of a gear motor, which has one of its own
        inside.
    resonant
        Whether a stepper runs at speeds at which it resonates without microsteps.
    voltage
        That a stepper's driver is fed with, V.
    speed
        Of the input with this motor; None where it is not enough, or not to turn at one speed.
    variation
        Share of the requested speed by which that of the input may differ from it within the turn.
    """

    motor: Motor
    demand: Demand
    cover: float
    ratio: float | None = None
    resonant: bool = False
    voltage: float = 24.0
    speed: "InputSpeed | None" = None
    variation: float = math.inf

    @property
    def even(self) -> bool:
        """Whether the input stays near the requested speed all along, as far as that can be said."""
        return self.speed is None or not exceeds(self.speed.deviation, self.variation)

    @property
    def enough(self) -> bool:
        """Whether it runs the machine."""
        return self.cover >= 1

    @property
    def given(self) -> float:
        """The part of the demand's peak that it covers, N m."""
        return self.cover * self.demand.peak


def demand_of(drive: Drive, settings: MachineSettings, rotor: float = 0.0, slower: float = 1.0) -> Demand:
    """What a drive asks at the shaft of a motor with that rotor, kg m², margin included.

    ``slower`` is the share of the speed at which it runs: torques of inertia go with its square.
    """
    course, gear, efficiency = drive.course, settings.gear, efficiency_of(settings)
    accelerating = rotor * gear * course.acceleration * slower**2
    if not course.rocks:
        accelerating = accelerating * np.sign(course.angle[-1] - course.angle[0])
    peak = rms = 0.0
    for number, run in enumerate(drive.runs):
        own = accelerating * (1 if course.rocks or run.name == "forwards" else -1)
        fast = drive.inertia_of(number) * slower**2
        torque = run.torque - drive.inertia_of(number) + fast
        sense = np.where(run.power * run.torque < 0, -1.0, 1.0)  # in which the input runs about its angle
        driving = torque * np.where(torque * sense >= 0, 1 / efficiency, efficiency) / gear + own
        peak = max(peak, float(np.abs(driving).max()))
        rms = max(rms, math.sqrt(drive.mean_of(driving**2)))
    speed = drive.speed * slower * gear * 60 / math.tau
    return Demand(speed, settings.margin * peak, settings.margin * rms)


def efficiency_of(settings: MachineSettings) -> float:
    """Of what stands between motor and input."""
    return 1.0 if settings.gear == 1 else EFFICIENCY


def with_speed(drive: Drive, settings: MachineSettings, choice: Choice) -> Choice:
    """The same with the speed of the input over the turn, where the motor is enough."""
    if not choice.enough:
        return choice
    from mechwright.machine.speeds import input_speed

    seen = input_speed(drive, choice.motor, settings.gear, efficiency_of(settings), settings.voltage)
    return replace(choice, speed=seen, variation=settings.variation)


def judged(drive: Drive, settings: MachineSettings, one: Motor, slower: float = 1.0) -> Choice:
    """How a motor stands to a drive that runs at that share of its speed."""
    if isinstance(one, GearMotor):
        demand = demand_of(drive, settings, slower=slower)
        return Choice(one, demand, min(gear_motor_margin(one, demand), ENDLESS))
    demand = demand_of(drive, settings, one.rotor, slower)
    felt = inertia_ratio(one.rotor, float(drive.reflected.max()), settings.gear)
    low, high = (rate / STEPS * 60 for rate in RESONANCE)
    resonant = low <= demand.speed <= high
    cover = min(stepper_margin(one, demand, settings.voltage), ENDLESS)
    return Choice(one, demand, cover, felt, resonant, settings.voltage)


def motor_of(drive: Drive, settings: MachineSettings) -> Choice | None:
    """The motor that is named, or the lightest that is enough and turns evenly; None where none is wanted.

    Where none turns evenly that which does so most, and where none is enough, the one that covers most.
    """
    if settings.motor == "none":
        return None
    if settings.motor != "auto":
        return with_speed(drive, settings, judged(drive, settings, motor(settings.motor)))
    found = [judged(drive, settings, one) for one in motors()]
    steady = [one for one in found if one.enough and _steady(one)]
    seen = []
    for one in steady or [one for one in found if one.enough]:
        seen.append(with_speed(drive, settings, one))
        if seen[-1].even:
            return seen[-1]
    if seen:
        return min(seen, key=lambda one: one.speed.deviation if one.speed else 0.0)
    return max(found, key=lambda one: one.cover)


def _steady(one: Choice) -> bool:
    """Whether a stepper's rotor holds the inertia that it feels."""
    return one.ratio is None or one.ratio <= INERTIA_RATIO


def curve_of(choice: Choice) -> tuple[Array, Array]:
    """Speeds (k,), rev/min, and what the motor may be asked for a moment at each, N m."""
    one = choice.motor
    if isinstance(one, GearMotor):
        speeds = np.linspace(0.0, one.no_load, _POINTS)
        line = [dc_torque(one.no_load, one.stall_torque, float(speed)) for speed in speeds]
        return speeds, np.minimum(line, min(PEAK * one.stall_torque, one.peak))
    corner = corner_speed(choice.voltage, one.inductance / 1000, one.current)
    speeds = np.linspace(0.0, max(2 * corner, 1.2 * choice.demand.speed), _POINTS)
    return speeds, np.array([stepper_torque(one.hold, float(speed), corner) / MARGIN for speed in speeds])


_POINTS = 121
"""Of the line that is drawn of a motor."""


def able_at(drive: Drive, settings: MachineSettings, one: Motor) -> float | None:
    """The greatest share of the speed at which a motor is enough; None if it is at none, however slow."""
    if not judged(drive, settings, one, _SLOWEST).enough:
        return None
    return _greatest(lambda share: judged(drive, settings, one, share).enough)


GEARS = (1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0, 10.0, 12.5, 16.0, 20.0, 25.0, 31.5, 40.0, 50.0)
"""Ratios that are proposed: preferred numbers R10."""


def geared_down(drive: Drive, settings: MachineSettings) -> float | None:
    """The least ratio above the present one with which the design's motor is enough and turns evenly.

    None if there is no such ratio, or the frame leaves no place for a gear.
    """
    if settings.couples:
        return None
    for gear in GEARS:
        if gear > settings.gear:
            choice = motor_of(drive, settings.model_copy(update={"gear": gear}))
            if choice is not None and choice.enough and _steady(choice) and choice.even:
                return gear
    return None


def carried(drive: Drive, settings: MachineSettings, one: Motor) -> float | None:
    """The greatest share of the load of ``[machine]`` at which a motor is enough; None if of none."""
    if settings.load == 0:
        return None

    def enough(share: float) -> bool:
        return judged(drive.lightened(share), settings, one).enough

    return _greatest(enough) if enough(0.0) else None


def _greatest(passes: Callable[[float], bool]) -> float | None:
    """The greatest share that passes, where all smaller ones do; None if it is 0."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if passes(middle) else (low, middle)
    return low or None


_SLOWEST = 1e-3
"""Share of the speed at which the torque of inertia is a millionth."""

_HALVINGS = 24


def stronger(drive: Drive, settings: MachineSettings) -> Sequence[Choice]:
    """All motors that are enough, the lightest first."""
    return [one for one in (judged(drive, settings, each) for each in motors()) if one.enough]


def more_even(
    drive: Drive, settings: MachineSettings, fits: Callable[[Motor], bool] = lambda _: True
) -> Choice | None:
    """The lightest motor that is enough, turns evenly and fits; None if none does."""
    seen = (with_speed(drive, settings, one) for one in stronger(drive, settings) if _steady(one))
    return next((one for one in seen if one.even and fits(one.motor)), None)


SHARES = (0.8, 0.63, 0.5, 0.4, 0.315, 0.25, 0.2, 0.16, 0.125, 0.1)
"""Shares of the speed or the load that are proposed: preferred numbers R10."""


def even_on(drive: Drive, settings: MachineSettings) -> bool:
    """Whether the design's motor is enough for a drive and turns it evenly."""
    choice = motor_of(drive, settings)
    return choice is not None and choice.enough and _steady(choice) and choice.even
