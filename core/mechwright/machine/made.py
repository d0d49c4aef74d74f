"""Drive and motor of a build; made once, by ``build.made``."""

from mechwright.contracts.motion import Motion
from mechwright.machine.drive import SAMPLES, Drive, drive_of
from mechwright.machine.electrics import electrics_of
from mechwright.machine.motors import Choice, motor_of
from mechwright.machine.settings import MachineSettings
from mechwright.machine.table import MachineTable
from mechwright.pipeline.build import Build
from mechwright.standards.supply import Supply


def settings_of(build: Build) -> MachineSettings:
    """What the design says of its machine."""
    value: MachineSettings = build.design.tables.get(MachineTable.name, MachineSettings())
    return value


def wanted_of(build: Build) -> bool:
    """Whether the design says anything of a machine."""
    return settings_of(build) != MachineSettings()


def motion_for(build: Build) -> Motion:
    """The motion as finely as a drive is judged, however many samples are wanted in tables."""
    return build.design.solve(SAMPLES)


def drive_for(build: Build) -> Drive:
    """The drive of a build; raises as :func:`drive_of` does, and as parts do."""
    return drive_of(build.made(motion_for), build.parts, settings_of(build))


def electrics_for(build: Build) -> list[Supply]:
    """What its motor takes beside itself; nothing without a motor that is enough."""
    choice = build.made(motor_for) if wanted_of(build) else None
    if choice is None or not choice.enough:
        return []
    return electrics_of(build.made(drive_for), settings_of(build), choice)


def motor_for(build: Build) -> Choice | None:
    """Its motor."""
    return motor_of(build.made(drive_for), settings_of(build))
