"""Forces in the joints, what the drive needs, and their peaks."""

from collections.abc import Mapping

import numpy as np

from mechwright.contracts.motion import Channel
from mechwright.mechanics.linkage.kinematics.period import Period, period_of
from mechwright.mechanics.linkage.mass import Mass
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.planar.efforts import efforts
from mechwright.mechanics.planar.positions import Solution

MILLI = 1e-3


def carried(table: AnyPlanarTable, found: Solution, masses: Mapping[str, Mass]) -> Forces:
    """Forces (n,) in N and moments in N mm of all joints."""
    return efforts(table.machine, found, masses, table.loads, table.springs, table.gravity)


def force_channels(table: AnyPlanarTable, found: Solution, masses: Mapping[str, Mass]) -> dict[str, Channel]:
    """The sizes of all joint forces, the force on the ground, and the effort of the drive."""
    forces = carried(table, found, masses)
    channels = {
        f"force_{joint}": Channel(np.asarray(np.abs(force)), "N", f"force in joint {joint}")
        for joint, force in forces.joints.items()
    }
    shaking = Channel(np.asarray(np.abs(forces.shaking)), "N", "force on the ground")
    channels["shaking_force"] = shaking
    if table.driver_slides:
        channels["drive_force"] = Channel(forces.drive, "N", "force of the drive")
    else:
        channels["drive_torque"] = Channel(forces.drive * MILLI, "N*m", "torque of the drive")
    return channels


def peaks_of(table: AnyPlanarTable) -> dict[str, tuple[float, str]]:
    """Largest sizes over a period of joint forces and of the drive's effort, with their units."""
    channels = force_channels(table, period_of(table, PEAK_SAMPLES).solution, table.masses)
    return {f"{name}_max": (float(np.abs(one.values).max()), one.unit) for name, one in channels.items()}


def period_forces(table: AnyPlanarTable) -> tuple[Period, Forces]:
    """The motion over a period as finely as peaks are sought, and the forces."""

    def found() -> tuple[Period, Forces]:
        period = period_of(table, PEAK_SAMPLES)
        return period, carried(table, period.solution, table.masses)

    return table.once("period forces", found)
