"""What is found of the motor of a machine, with changes that are tried."""

import math
from collections.abc import Callable, Iterator

from mechwright.contracts.finding import Change, Finding, Severity
from mechwright.errors import MechwrightError
from mechwright.machine.drive import Drive
from mechwright.machine.motors import (
    SHARES,
    Choice,
    Motor,
    able_at,
    carried,
    even_on,
    geared_down,
    more_even,
    stronger,
)
from mechwright.machine.settings import MachineSettings
from mechwright.mechanics.strength.motor import INERTIA_RATIO
from mechwright.pipeline.build import Build
from mechwright.standards.motors import NOMINAL_VOLTAGE, GearMotor


def motor_findings(
    build: Build, drive: Drive, settings: MachineSettings, choice: Choice | None
) -> Iterator[Finding]:
    """What is found of a motor; nothing without one."""
    if choice is None:
        return
    name, asked = choice.motor.name, choice.demand
    if not choice.enough:
        yield _too_weak(build, drive, settings, choice)
        return
    yield Finding.note(
        "machine.motor",
        f"{name} may give {choice.cover:.3g} times the {asked.peak:.4g} N·m (peak) and {asked.rms:.4g} N·m "
        f"(rms) that are asked at {asked.speed:.4g} rev/min, a margin of {settings.margin:g} in them",
        choice.cover,
    )
    if choice.ratio is not None and choice.ratio > INERTIA_RATIO:
        yield _inertia(build, drive, settings, choice.ratio, choice.motor.name)
    yield from _speeds(build, drive, settings, choice)
    yield from _manners(drive, choice)


def _inertia(build: Build, drive: Drive, settings: MachineSettings, ratio: float, name: str) -> Finding:
    """A stepper that feels too much inertia, with a gear and a motor that were judged."""
    words: list[str] = []
    proposed: list[Change] = []
    geared = geared_down(drive, settings)
    if geared is not None:
        words.append(f"gear it down to {geared:g}")
        proposed.append({"machine.gear": geared})
    better = more_even(drive, settings, _fits(build, settings))
    if better is not None:
        words.append(f"take {better.motor.name}")
        proposed.append({"machine.motor": better.motor.name})
    return Finding.warning(
        "machine.inertia",
        "machine.motor",
        f"{name} feels {ratio:.3g} times the inertia of its rotor; steppers lose steps above "
        f"{INERTIA_RATIO:g}",
        ratio,
        INERTIA_RATIO,
        remedy=", or ".join(words) or "lighten what it turns",
        proposed=tuple(proposed),
    )


def speed_said(choice: Choice) -> str:
    """How evenly a motor turns the input, at which voltage; empty where that cannot be said."""
    seen, name = choice.speed, choice.motor.name
    if seen is None:
        return ""
    mean = seen.requested * 60 / math.tau
    if not isinstance(choice.motor, GearMotor):
        return (
            f"{name} at {seen.voltage:g} V keeps its steps: the input turns at a constant {mean:.4g} rev/min"
        )
    if seen.stalls:
        return f"{name} stalls within the turn, {seen.run}: no voltage gives it a mean of {mean:.4g} rev/min"
    least, most = (one * 60 / math.tau for one in (seen.least, seen.greatest))
    return (
        f"{name} at {seen.voltage:.3g} V (nominal {NOMINAL_VOLTAGE:g} V) turns the input at {least:.4g} to "
        f"{most:.4g} rev/min, {seen.run}; the mean is {mean:.4g} rev/min"
    )


def _speeds(build: Build, drive: Drive, settings: MachineSettings, choice: Choice) -> Iterator[Finding]:
    """How evenly the motor turns the input."""
    seen = choice.speed
    if seen is None:
        return
    if choice.even:
        yield Finding.note("machine.speed", speed_said(choice), seen.deviation)
        return
    words: list[str] = []
    proposed: list[Change] = []
    better = more_even(drive, settings, _fits(build, settings))
    if better is not None:
        words.append(f"take {better.motor.name}")
        proposed.append({"machine.motor": better.motor.name})
    elif (geared := geared_down(drive, settings)) is not None:
        words.append(f"gear it down to {geared:g}")
        proposed.append({"machine.gear": geared})
    if better is None:
        key, now = _speed(build, drive, settings)
        slower = _shares(now, lambda speed: even_on(drive.slowed(speed / now), settings))
        if slower is not None:
            words.append(f"run it at {slower:g} rev/min")
            proposed.append({key: slower})
        load = settings.load
        lighter = (
            _shares(load, lambda part: even_on(drive.lightened(part / load), settings)) if load else None
        )
        if lighter is not None:
            words.append(f"load it by no more than {lighter:g} N·m")
            proposed.append({"machine.load": lighter})
    if not seen.stalls and 100 * seen.deviation < MOST_VARIATION:
        allowed = _above(100 * seen.deviation)
        words.append(f"allow speed_variation = {allowed:g}")
        proposed.append({"machine.speed_variation": allowed})
    off = (
        f"; it is up to {100 * seen.deviation:.3g} % off the mean, and speed_variation allows "
        f"{settings.speed_variation:g} %"
    )
    yield Finding.error(
        "machine.speed",
        "machine.motor",
        speed_said(choice) + ("" if seen.stalls else off),
        None if seen.stalls else seen.deviation,
        settings.variation,
        remedy=", or ".join(words) or "lessen the load or what swings",
        proposed=tuple(proposed),
    )


MOST_VARIATION = 100.0
"""%: as much as ``speed_variation`` may be."""


def _fits(build: Build, settings: MachineSettings) -> Callable[[Motor], bool]:
    """Whether the frame takes a motor; each does where no frame carries one."""

    def fits(one: Motor) -> bool:
        try:
            around = build.design.changed({"machine.motor": one.name}).surroundings
        except MechwrightError:
            return False
        return not any(said.severity is Severity.ERROR for some in around for said in some.findings)

    return fits if settings.couples else lambda _: True


def _shares(now: float, passes: Callable[[float], bool]) -> float | None:
    """The greatest of the shares of a value that passes; None if none does."""
    return next((value for value in (_below(share * now) for share in SHARES) if passes(value)), None)


def _manners(drive: Drive, choice: Choice) -> Iterator[Finding]:
    """How the motor takes it: braking, resonance."""
    least = min(float(run.power.min()) for run in drive.runs)
    if least < 0:
        what = (
            "a gear motor on a drive of one quadrant coasts there, and its worm, if it has one, locks"
            if isinstance(choice.motor, GearMotor)
            else "a stepper brakes there, and its driver takes the power up"
        )
        yield Finding.note(
            "machine.braking",
            f"the mechanism drives the motor with up to {-least:.4g} W; {what}",
            -least,
            "W",
        )
    if choice.resonant:
        yield Finding.note(
            "machine.resonance",
            f"at {choice.demand.speed:.4g} rev/min a stepper resonates in full steps; run it in microsteps",
            choice.demand.speed,
            "rev/min",
        )


def _too_weak(build: Build, drive: Drive, settings: MachineSettings, choice: Choice) -> Finding:
    asked = choice.demand
    words: list[str] = []
    proposed: list[Change] = []

    def advise(what: str, change: Change) -> None:
        words.append(what)
        proposed.append(change)

    geared = geared_down(drive, settings)
    if geared is not None:
        advise(f"gear it down to {geared:g}", {"machine.gear": geared})
    share = able_at(drive, settings, choice.motor)
    if share is not None:
        key, now = _speed(build, drive, settings)
        advise(f"run it at {_below(share * now):g} rev/min", {key: _below(share * now)})
    elif (part := carried(drive, settings, choice.motor)) is not None:
        load = _below(part * settings.load)
        advise(f"load it by no more than {load:g} N·m", {"machine.load": load})
    # The motor that is named is at hand, so another one comes last: one that turns evenly if there is any.
    fits = _fits(build, settings)
    able = (one for one in stronger(drive, settings) if fits(one.motor))
    other = more_even(drive, settings, fits) or next(able, None)
    if other is not None:
        advise(f"take {other.motor.name}", {"machine.motor": other.motor.name})
    if not words:
        words.append("lighten what it carries, or take a motor that is not in these tables")
    return Finding.error(
        "machine.motor",
        "machine.motor",
        f"{choice.motor.name} may give {choice.given:.3g} N·m of the {asked.peak:.3g} N·m that are asked at "
        f"{asked.speed:.4g} rev/min, a margin of {settings.margin:g} in them: "
        f"{asked.peak - choice.given:.3g} N·m are missing",
        choice.given,
        asked.peak,
        "N*m",
        ", or ".join(words),
        proposed=tuple(proposed),
    )


def _speed(build: Build, drive: Drive, settings: MachineSettings) -> tuple[str, float]:
    """The key that sets the speed, and its value, rev/min."""
    own = getattr(build.design.params, "speed", None)
    if settings.speed is None and isinstance(own, float):
        return "parameters.speed", own
    return "machine.speed", settings.speed or drive.mean_speed * 60 / math.tau


def _above(value: float) -> float:
    """A number of two digits that is above.

    >>> _above(12.34), _above(5.01)
    (13.0, 5.1)
    """
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{(math.floor(value / step) + 1) * step:.2g}")


def _below(value: float) -> float:
    """A round number of three digits that is not above.

    >>> _below(123.987), _below(0.045678)
    (123.0, 0.0456)
    """
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.floor(value / step * (1 + 1e-12)) * step:.3g}")
