"""What is found of the motor of a machine, with changes that are tried."""

import math
from collections.abc import Iterator

from mechwright.build.build import Build
from mechwright.contracts.finding import Change, Finding
from mechwright.machine.drive import Drive
from mechwright.machine.motors import Choice, able_at, carried, geared_down, stronger
from mechwright.machine.settings import MachineSettings
from mechwright.mechanics.strength.motor import INERTIA_RATIO
from mechwright.standards.motors import GearMotor


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
        gear = math.ceil(10 * settings.gear * math.sqrt(choice.ratio / INERTIA_RATIO)) / 10
        heavier = [
            one for one in stronger(drive, settings) if one.ratio is None or one.ratio <= INERTIA_RATIO
        ]
        proposed: list[Change] = [{"machine.gear": gear}]
        proposed += [{"machine.motor": one.motor.name} for one in heavier[:1]]
        yield Finding.warning(
            "machine.inertia",
            "machine.motor",
            f"{name} feels {choice.ratio:.3g} times the inertia of its rotor; steppers lose steps above "
            f"{INERTIA_RATIO:g}",
            choice.ratio,
            INERTIA_RATIO,
            remedy=f"gear it down to {gear:g}, or take a motor with a heavier rotor",
            proposed=tuple(proposed),
        )
    yield from _manners(drive, choice)


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
    for one in stronger(drive, settings)[:1]:  # the motor that is named is at hand
        advise(f"take {one.motor.name}", {"machine.motor": one.motor.name})
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


def _below(value: float) -> float:
    """A round number of three digits that is not above.

    >>> _below(123.987), _below(0.045678)
    (123.0, 0.0456)
    """
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.floor(value / step * (1 + 1e-12)) * step:.3g}")
