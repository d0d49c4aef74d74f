"""Forces in the joints, what the drive needs, and their peaks."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mechwright import Channel, kept
from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.planar.efforts import PointLoad, efforts
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.springs import AnySpring, Spring
from mechwright_linkage.kinematics.linkage_table import LinkageTable, table_of
from mechwright_linkage.kinematics.period import period_of
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.parts.design import masses_of

MILLI = 1e-3


def carried(table: LinkageTable, found: Solution, masses: Mapping[str, Mass]) -> Forces:
    """Forces (n,) in N and moments in N mm of all joints."""
    return efforts(table.machine, found, masses, loads_of(table), springs_of(table), gravity_of(table))


def loads_of(table: LinkageTable) -> list[PointLoad]:
    """The loads of a design."""
    found = []
    for load in table.given.loads:
        points = table.linkage.points[load.link]
        place = points[load.point or next(iter(points))]
        found.append(PointLoad(load.link, place, load.force_x + 1j * load.force_y, load.torque / MILLI))
    return found


def springs_of(table: LinkageTable) -> Sequence[AnySpring]:
    """The springs of a design."""
    points = table.linkage.points
    return [
        Spring(
            one.link,
            one.on,
            points[one.link][one.point],
            points[one.on][one.on_point],
            one.rate,
            one.free_length,
        )
        for one in table.given.springs
    ]


def gravity_of(table: LinkageTable) -> complex:
    """The acceleration of free fall, mm/s²."""
    given = table.given
    return complex(given.gravity_x, given.gravity_y) / MILLI


def force_channels(table: LinkageTable, found: Solution, masses: Mapping[str, Mass]) -> dict[str, Channel]:
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


def peaks_of(params: LinkageParams) -> dict[str, tuple[float, str]]:
    """Largest sizes over a period of joint forces and of the drive's effort, with their units."""
    table = table_of(params)
    channels = force_channels(table, period_of(table, PEAK_SAMPLES).solution, masses_of(params))
    return {f"{name}_max": (float(np.abs(one.values).max()), one.unit) for name, one in channels.items()}


@kept
def period_forces(params: LinkageParams) -> tuple[Any, Forces]:
    """The motion over a period as finely as peaks are sought, and the forces."""
    table = table_of(params)
    found = period_of(table, PEAK_SAMPLES)
    return found, carried(table, found.solution, masses_of(params))
