"""What a motor takes beside itself: supply, driver, controller, switch, stop, fuse, cable.

Glossary
--------
limit
    The current above which the driver of a gear motor gives no more: what its gearbox bears, or its stall.
"""

import math
from collections.abc import Iterator

from mechwright.machine.drive import Drive
from mechwright.machine.motors import STEPS, Choice
from mechwright.machine.settings import MachineSettings
from mechwright.standards.couplings import sold_bore
from mechwright.standards.motors import NOMINAL_VOLTAGE, STALL_CURRENT, GearMotor, Stepper
from mechwright.standards.ordering import order_of
from mechwright.standards.supply import Supply, next_above

SUPPLY_SPARE = 1.25
"""Of the current of a power supply over what the driver takes; handbook."""

PHASES = 0.7 * 2
"""Of the current of a phase that a stepper's driver takes: two phases, of which never both have all."""

FUSE = 1.5
"""Of the current of a fuse over the motor's rms current; a slow one bears the start."""

CURRENTS = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.5, 15.0, 20.0)
"""Of power supplies that are sold, A; handbook."""

FUSES = (0.25, 0.5, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 10.0, 16.0)
"""Slow fuses 5 x 20 mm that are sold, A (IEC 60127)."""

THIN, WIRES = 3.0, (0.5, 0.75)
"""Current up to which the thinner wire does, A, and cross sections of both, mm²; handbook."""

MICROSTEPS = 8
"""Of a full step at the least, so that a stepper does not ring."""


def current_of(choice: Choice) -> tuple[float, float]:
    """Greatest current that the driver gives and the rms current of the motor, A."""
    one = choice.motor
    if isinstance(one, Stepper):
        return PHASES * one.current, PHASES * one.current
    return one.current_limit or STALL_CURRENT, one.current(choice.demand.rms)


def supply_of(choice: Choice) -> tuple[float, float]:
    """Voltage and least current of the power supply, V and A."""
    volts = NOMINAL_VOLTAGE if isinstance(choice.motor, GearMotor) else choice.voltage
    return volts, SUPPLY_SPARE * current_of(choice)[0]


def electrics_of(drive: Drive, settings: MachineSettings, choice: Choice) -> list[Supply]:
    """All of it; the motor and what couples it first where no frame carries them."""
    return [*_loose(settings, choice), _supply(choice), *_driver(drive, settings, choice), *_safety(choice)]


def _loose(settings: MachineSettings, choice: Choice) -> Iterator[Supply]:
    if settings.couples:
        return
    what = choice.motor.bought
    yield Supply(
        "motor",
        what.designation,
        "no frame carries it; it is no body of the assembly",
        standard=what.standard,
        inch=order_of(what).inch,
    )
    shaft = choice.motor.face.shaft
    if settings.gear == 1:
        order = f"flexible coupling for a shaft of {shaft:g} mm and that of the input"
        yield Supply(
            "coupling",
            order,
            f"it carries {choice.demand.peak:.3g} N·m; motor and input never stand in line",
            inch=f"bore {sold_bore(shaft)} for the motor",
        )
    else:
        order = f"toothed belt, two pulleys, {settings.gear:g} to 1, for {shaft:g} mm and the input's shaft"
        yield Supply(
            "belt drive", order, f"it carries {settings.gear * choice.demand.peak:.3g} N·m at the input"
        )


def _supply(choice: Choice) -> Supply:
    volts, least = supply_of(choice)
    sold = next_above(CURRENTS, least)
    order = f"power supply {volts:g} V DC, {sold:g} A or more, closed case, with mains lead"
    taken = current_of(choice)[0]
    note = f"{least:.3g} A at least: {SUPPLY_SPARE:g} times the {taken:.3g} A that the driver takes"
    return Supply("power supply", order, note)


def _driver(drive: Drive, settings: MachineSettings, choice: Choice) -> Iterator[Supply]:
    one = choice.motor
    if isinstance(one, Stepper):
        phase = f"{one.current:g} A a phase"
        order = f"stepper driver, {phase}, {choice.voltage:g} V, {MICROSTEPS} microsteps or more"
        yield Supply("driver", order, f"set its current to {phase}, as the motor is rated")
        rate = choice.demand.speed / 60 * STEPS * MICROSTEPS
        order = f"pulse generator or microcontroller, {rate:.0f} pulses/s, with a ramp"
        note = f"{choice.demand.speed:.4g} rev/min in {MICROSTEPS} microsteps"
        yield Supply("controller", f"{order}{_ways(settings)}", note)
        return
    limit, _ = current_of(choice)
    order = f"DC motor driver, H bridge with PWM, {NOMINAL_VOLTAGE:g} V, {limit:.1f} A or more"
    note = f"the motor takes {STALL_CURRENT:g} A when it stalls"
    if one.current_limit is not None:
        order += ", current limit"
        note = (
            f"set the limit to {math.floor(10 * limit) / 10:g} A: the motor stalls at "
            f"{one.stall_torque:.3g} N·m, and its gearbox bears {one.peak:.3g} N·m"
        )
    if min(float(run.power.min()) for run in drive.runs) < 0:
        order += ", braking (four quadrants)"
        note += "; the mechanism drives the motor in part of the turn"
    yield Supply("driver", order, note)
    seen = choice.speed
    if seen is None or seen.stalls:
        order, note = "microcontroller with encoder", "the input follows a law, which a knob does not"
    else:
        share, mean = seen.voltage / NOMINAL_VOLTAGE, seen.requested * 60 / math.tau
        order = "PWM signal with a speed knob"
        note = f"{100 * share:.0f} % of the voltage, {seen.voltage:.3g} V, for {mean:.4g} rev/min in the mean"
    yield Supply("controller", f"{order}{_ways(settings)}", note)


def _ways(settings: MachineSettings) -> str:
    return ", and a direction switch" if settings.direction == "both" else ""


def _safety(choice: Choice) -> Iterator[Supply]:
    volts, _ = supply_of(choice)
    most, rms = current_of(choice)
    fuse = next_above(FUSES, FUSE * rms)
    yield Supply(
        "main switch",
        f"switch, on and off, {volts:g} V DC, {math.ceil(most):g} A",
        "between supply and driver",
    )
    yield Supply(
        "emergency stop",
        f"push button, latching, break contact, {volts:g} V DC, {math.ceil(most):g} A",
        "it opens the line to the driver, within reach of the operator",
    )
    order = f"fuse 5 x 20, slow, {fuse:g} A, with holder"
    yield Supply("fuse", order, f"in the line to the driver: {FUSE:g} times the {rms:.2g} A rms")
    wire, cores = WIRES[most > THIN], 4 if isinstance(choice.motor, Stepper) else 2
    yield Supply(
        "cable",
        f"stranded wire, {cores} x {wire:g} mm²",
        "motor to driver, and supply to driver",
        2,
        "m",
        inch=f"AWG {_AWG[wire]}",
    )
    yield Supply(
        "connectors", f"plug and socket, {cores} poles, {math.ceil(most):g} A", "so that the motor comes off"
    )


_AWG = {0.5: 20, 0.75: 18}
"""Gauge of wires of a cross section, mm²."""
