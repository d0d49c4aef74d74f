"""What is found of a machine: torque of its drive, flywheel, motor.

Keys of ``[machine]`` that the design file states and that change nothing.
"""

import math
from collections.abc import Iterator, Sequence

from mechwright.contracts.finding import Finding, Severity, Stage, at_stage
from mechwright.contracts.materials import material
from mechwright.errors import DesignError
from mechwright.machine.drive import Drive
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.made import drive_for, motor_for, settings_of, wanted_of
from mechwright.machine.motor_findings import motor_findings
from mechwright.machine.settings import MachineSettings
from mechwright.machine.shaft_findings import shaft_findings
from mechwright.mechanics.strength.drive import disc_inertia
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection
from mechwright.standards.motors import GearMotor, motor

AMBIENT = frozenset({"frame", "plates"})
"""Keys of a frame that are not warned of: the choice itself, and the plates that are in hand."""


def ineffective_keys(build: Build, drive: Drive, settings: MachineSettings) -> Iterator[Finding]:
    """A warning for each key that the file itself states, with another value than its default.

    Keys that a shop file lends are not warned of.
    """
    stated = build.design.content.get("machine", {})
    for key, why in _reasons(drive, settings):
        if key in stated and getattr(settings, key) != MachineSettings.model_fields[key].default:
            yield Finding.warning(
                "machine.key",
                f"machine.{key}",
                f"{key} changes nothing: {why}",
                remedy=f"leave {key} out",
                stage=Stage.PARTS,
                proposed=({f"machine.{key}": None},),
            )


def _reasons(drive: Drive, settings: MachineSettings) -> Iterator[tuple[str, str]]:
    """Each key that changes nothing here, and why."""
    if settings.frame == "none":
        for key in FrameKeys.model_fields.keys() - AMBIENT:
            yield key, 'it is a key of frames, and frame is "none"'
    if settings.motor == "none":
        yield "gear", 'the gear stands between motor and input, and motor is "none"'
        yield "voltage", 'it feeds the driver of a stepper, and motor is "none"'
    elif settings.motor != "auto" and isinstance(motor(settings.motor), GearMotor):
        yield "voltage", f"it feeds the driver of a stepper, and {settings.motor} is a DC gear motor"
    if settings.load == 0:
        yield "output", "it names the body that bears load, and load is 0"
    if drive.swing is None:
        yield "speed_variation", "the speed of this input does not come back, so there is no flywheel"


KEYS = "machine.key"
"""Code of the finding that a key of ``[machine]`` cannot be obeyed."""


class MachineDrive(Inspection):
    """Torque of the drive, and whether its motor is enough."""

    name = "machine-drive"
    stage = Stage.ASSEMBLY
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
        motor = motor_findings(build, drive, settings, build.made(motor_for))
        found = [*_torque(drive, settings), *motor, *ineffective_keys(build, drive, settings)]
        if settings.frame == "none":  # the frame judges its own shafts
            found += shaft_findings(build, drive, settings, build.made(motor_for))
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
    wheel = drive.flywheel(settings.variation)
    if wheel is not None and drive.swing is not None:
        disc = disc_of(wheel)
        yield Finding.note(
            "machine.flywheel",
            f"work swings by {1e3 * drive.swing:.4g} mJ about its mean; a flywheel of {wheel:.4g} kg·m^2 at "
            f"the input, such as a steel disc of {disc:.0f} x {disc * DISC:.0f} mm, keeps its speed within "
            f"{settings.speed_variation:g} %, up or down",
            wheel,
            "kg*m^2",
        )


DISC = 0.1
"""Thickness of a flywheel over its diameter."""


def disc_of(inertia: float) -> float:
    """Diameter, mm, of the steel disc of usual shape that has an inertia, kg m².

    >>> round(disc_of(0.0019178), 1)  # 120 x 12 mm
    120.0
    """
    one = disc_inertia(1.0, DISC, 1000 * material("steel").density)
    return float((inertia / one) ** 0.2)
