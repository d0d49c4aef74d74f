"""From a mechanism to a machine: what drives it.

Glossary
--------
input
    The shaft that the motion's input turns.
forwards
    The sense in which the motion runs; backwards is the same motion with time reversed.
"""

from mechwright.machine.drive import Drive, Run, drive_of
from mechwright.machine.inspection import MachineDrive
from mechwright.machine.made import drive_for, motor_for
from mechwright.machine.motors import Choice, motor_of
from mechwright.machine.settings import MachineSettings
from mechwright.machine.table import MachineTable

__all__ = [
    "Choice",
    "Drive",
    "MachineDrive",
    "MachineSettings",
    "MachineTable",
    "Run",
    "drive_for",
    "drive_of",
    "motor_for",
    "motor_of",
]
