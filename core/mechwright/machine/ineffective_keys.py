"""Keys of ``[machine]`` that the design file states and that change nothing."""

from collections.abc import Iterator

from mechwright.contracts.finding import Finding, Stage
from mechwright.machine.drive import Drive
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.settings import MachineSettings
from mechwright.pipeline.build import Build
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
        yield "irregularity", "the speed of this input does not come back, so there is no flywheel"
