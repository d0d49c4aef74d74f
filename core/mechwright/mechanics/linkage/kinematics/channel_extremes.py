"""Least and greatest values of the channels of a table, compiled."""

from collections.abc import Collection

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.linkage.kinematics.channels import PHI, STROKE, turning_links
from mechwright.mechanics.linkage.kinematics.figures import TRANSMISSION
from mechwright.mechanics.linkage.kinematics.period import drives_at, ways_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.compiled_chain import CompiledChain
from mechwright.mechanics.planar.machine import Prismatic

Row = tuple[int, str]
"""The row of a channel, and its unit."""


def channel_rows(table: AnyPlanarTable, chain: CompiledChain) -> dict[str, Row]:
    """The rows of the channels that a chain has: of input, links, slides, points, and transmission angle."""
    found: dict[str, Row] = {}

    def add(names: Collection[str], units: Collection[str], first: int, apart: int = 1) -> None:
        for place, (name, unit) in enumerate(zip(names, units, strict=True)):
            found[name] = first + apart * place, unit

    turns, lengths = ("rad", "rad/s", "rad/s^2", "rad/s^3"), ("mm", "mm/s", "mm/s^2", "mm/s^3")
    if table.driver_slides:
        add((STROKE, "v_in", "a_in"), lengths[:3], chain.drive)
    else:
        add((PHI, "omega_in", "alpha_in"), turns[:3], chain.drive)
    for link in turning_links(table.machine):
        add((f"theta_{link}",), turns[:1], chain.angle(link))
        add((f"omega_{link}", f"alpha_{link}", f"jerk_{link}"), turns[1:], chain.turning(link) + 2)
    for joint in table.machine.joints:
        if isinstance(joint, Prismatic):
            add([f"{letter}_{joint.name}" for letter in "svaj"], lengths, chain.way(joint))
    for name, (link, point) in table.linkage.traces.items():
        first = chain.point(link, table.linkage.points[link][point])
        for axis, letter in enumerate("xy"):
            add([f"{rate}{letter}{name}" for rate in ("", "v", "a", "j")], lengths, first + axis, 2)
    if chain.dyads:
        add(("transmission_angle",), turns[:1], chain.least_sine())
    return found


def compiled_extremes(table: AnyPlanarTable, names: Collection[str]) -> dict[str, tuple[Array, Array, str]]:
    """Least and greatest values (n,) of those channels of a table that a chain has, with their units."""
    chain = table.chain
    if chain is None:
        return {}
    rows = channel_rows(table, chain)
    chosen = [name for name in names if name in rows]
    found: dict[str, tuple[Array, Array, str]] = {}
    if chosen:
        ends = chain.extremes(drives_of(table), [(rows[name][0], 1) for name in chosen], SAMPLES)
        for place, name in enumerate(chosen):
            low, high = ends[:, place].T
            if name == "transmission_angle" and TRANSMISSION.measure is not None:
                low, high = TRANSMISSION.measure(low), TRANSMISSION.measure(high)
            found[name] = low, high, rows[name][1]
    if "time" in names:
        time, _ = drives_at(table, np.array([0.0, 2 * np.pi]))
        found["time"] = time[:, 0], time[:, 1], "s"
    return found


def drives_of(table: AnyPlanarTable) -> Array:
    """The inputs of a table as a chain takes them (n, 5)."""
    ways, size = ways_of(table), table.size
    parts = (
        ways.start,
        ways.travel,
        ways.rocks,
        ways.acceleration_ratio,
        table.omega,
    )
    return np.concatenate([column(one, size) for one in parts], axis=1)
