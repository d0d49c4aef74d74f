"""Which motor runs a drive: steppers by their falling torque, DC gear motors by a straight line.

Sources: reflected inertia through a gear; a stepper's corner speed from the time that the voltage takes to
turn the current of a phase over; the straight line of a DC motor between no load and stall.
"""

import math
from dataclasses import dataclass

from mechwright.standards.motors import GearMotor, Stepper

MARGIN = 2.0
"""Of a stepper's torque at its speed over the peak that is asked: it loses steps where it is overtaken."""

SUSTAINED, PEAK = 0.25, 0.5
"""Of a gear motor's stall torque that it may give for long, and for a moment."""

HOLD_SHARE = 0.7
"""Of the holding torque up to the corner speed; makers print 0.7 to 0.8."""

INERTIA_RATIO = 10.0
"""Greatest inertia of the load, seen by a stepper, in its rotor's."""

RESONANCE = (60.0, 120.0)
"""Full steps in a second at which steppers resonate without microsteps."""


@dataclass(frozen=True)
class Demand:
    """What a drive asks at the motor's shaft: greatest speed, rev/min, peak and rms torque, N m."""

    speed: float
    peak: float
    rms: float


def best_ratio(load: float, rotor: float) -> float:
    """Gear ratio that accelerates an inertia quickest: √(J_L/J_M)."""
    return math.sqrt(load / rotor)


def geared_torque(
    rotor: float, load: float, acceleration: float, torque: float, ratio: float, efficiency: float
) -> float:
    """N m at the motor: J_M i α + (J_L α + T_L)/(i η), α rad/s² of the load."""
    return rotor * ratio * acceleration + (load * acceleration + torque) / (ratio * efficiency)


def inertia_ratio(rotor: float, load: float, ratio: float) -> float:
    """J_L/(i² J_M)."""
    return load / (ratio**2 * rotor)


def corner_speed(voltage: float, inductance: float, current: float, steps: int = 200) -> float:
    """Rev/min from which a stepper's torque falls: 60 V/(2 L I steps); inductance in H.

    >>> round(corner_speed(24, 2.8e-3, 1.7))
    756
    """
    return 60 * voltage / (2 * inductance * current * steps)


def stepper_torque(hold: float, speed: float, corner: float, share: float = HOLD_SHARE) -> float:
    """N m at a speed: the share of the holding torque up to the corner, then falling with 1/n."""
    return share * hold * min(1.0, corner / speed) if speed > 0 else share * hold


def dc_speed(no_load: float, stall: float, torque: float) -> float:
    """Rev/min at a torque."""
    return no_load * (1 - torque / stall)


def dc_torque(no_load: float, stall: float, speed: float) -> float:
    """N m at a speed."""
    return stall * (1 - speed / no_load)


def dc_power(no_load: float, stall: float) -> float:
    """Greatest power, W, at half the speed and half the torque."""
    return no_load / 2 * math.tau / 60 * stall / 2


def stepper_margin(motor: Stepper, demand: Demand, voltage: float = 24.0) -> float:
    """How often what may be asked of it covers the demand; at least 1 is enough."""
    corner = corner_speed(voltage, motor.inductance / 1000, motor.current)
    given = stepper_torque(motor.hold, demand.speed, corner)
    return given / MARGIN / demand.peak if demand.peak > 0 else math.inf


def gear_motor_margin(motor: GearMotor, demand: Demand) -> float:
    """The same: the least of what its line, its peak and its sustained torque cover; 0 where it never turns.

    Its gearbox bears less than the shares of the stall torque where the ratio is high.

    >>> from mechwright.standards.motors import motor
    >>> gear_motor_margin(motor("37D 150:1"), Demand(70, 0.0, 0.0))  # 67 rev/min without load
    0.0
    """
    if demand.speed >= motor.no_load:
        return 0.0
    stall = motor.stall_torque
    line = dc_torque(motor.no_load, stall, demand.speed)
    covers = [
        (line, demand.peak),
        (min(PEAK * stall, motor.peak), demand.peak),
        (min(SUSTAINED * stall, motor.continuous), demand.rms),
    ]
    return min(given / asked if asked > 0 else math.inf for given, asked in covers)
