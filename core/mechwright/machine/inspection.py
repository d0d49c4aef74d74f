"""What is found of a machine: torque of its drive, flywheel, motor."""

import math
from collections.abc import Iterator, Sequence

from mechwright.build.build import Build
from mechwright.build.inspection import Inspection
from mechwright.contracts.finding import Change, Finding, Severity, Stage, at_stage
from mechwright.errors import DesignError
from mechwright.machine.drive import Drive
from mechwright.machine.made import drive_for, motor_for, settings_of, wanted_of
from mechwright.machine.motors import Choice, able_at, stronger
from mechwright.machine.settings import MachineSettings
from mechwright.mechanics.strength.motor import INERTIA_RATIO
from mechwright.standards.motors import GearMotor

KEYS = "machine.key"
"""Code of the finding that a key of ``[machine]`` cannot be obeyed."""


class MachineDrive(Inspection):
    """Torque of the drive, and whether its motor is enough."""

    name = "machine-drive"
    commands = frozenset({"check", "model", "build"})
    stage = Stage.PARTS
    order = 40
    doing = "the drive"

    def findings(self, build: Build) -> Sequence[Finding]:
        """Nothing where the design says nothing of a machine."""
        if not wanted_of(build):
            return ()
        try:
            drive = build.made(drive_for)
        except DesignError as error:
            key, _, rest = str(error).partition(": ")
            message, _, remedy = rest.partition("; ")
            if not key.startswith("machine"):
                raise
            return [Finding(KEYS, Severity.ERROR, key, message, remedy=remedy, stage=self.stage)]
        settings = settings_of(build)
        found = [*_torque(drive, settings)]
        choice = build.made(motor_for)
        if choice is not None:
            found += _motor(build, drive, settings, choice)
        return at_stage(self.stage, found)


def _torque(drive: Drive, settings: MachineSettings) -> Iterator[Finding]:
    peak, at, run = drive.peak()
    most, mean = drive.power
    yield Finding.note(
        "machine.torque",
        f"the drive needs up to {peak:.4g} N·m, {run} at {math.degrees(at):.1f} degrees of the input, "
        f"{drive.rms:.4g} N·m rms at {drive.speed * 60 / math.tau:.4g} rev/min; power up to {most:.4g} W, "
        f"{mean:.4g} W in the mean",
        abs(peak),
        "N*m",
    )
    wheel = drive.flywheel(settings.irregularity)
    if wheel is not None and drive.swing is not None:
        yield Finding.note(
            "machine.flywheel",
            f"work swings by {1e3 * drive.swing:.4g} mJ about its mean; a flywheel of {wheel:.4g} kg·m^2 at "
            f"the input keeps its speed within {100 * settings.irregularity:g} %",
            wheel,
            "kg*m^2",
        )


def _motor(build: Build, drive: Drive, settings: MachineSettings, choice: Choice) -> Iterator[Finding]:
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
        proposed: list[Change] = [{"machine.motor": one.motor.name} for one in heavier[:1]]
        proposed.append({"machine.gear": gear})
        yield Finding.warning(
            "machine.inertia",
            "machine.motor",
            f"{name} feels {choice.ratio:.3g} times the inertia of its rotor; steppers lose steps above "
            f"{INERTIA_RATIO:g}",
            choice.ratio,
            INERTIA_RATIO,
            remedy=f"take a motor with a heavier rotor, or gear it down to {gear:g}",
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
    enough = stronger(drive, settings)
    share = able_at(drive, settings, choice.motor)
    words: list[str] = []
    proposed: list[Change] = []
    if enough:
        words.append(f"take {enough[0].motor.name}")
        proposed.append({"machine.motor": enough[0].motor.name})
    if share is not None:
        key, now = _speed(build, drive, settings)
        able = _below(share * now)
        words.append(f"run it at {able:g} rev/min")
        proposed.append({key: able})
    if not words:
        words.append("gear it down")
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
