"""Figures of a linkage, or of a table of linkages: transmission angles, output, paths."""

import math
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.figure import Figure
from mechwright.mechanics.linkage.kinematics.channels import transmission_angle
from mechwright.mechanics.linkage.kinematics.extremes import SAMPLES, Extreme, Quantity, extent, least
from mechwright.mechanics.linkage.kinematics.path_figures import Stroke, output_curve, stroke
from mechwright.mechanics.linkage.kinematics.period import inputs_at, over_phases, ways_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.assembly_order import Dyad
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic
from mechwright.mechanics.planar.positions import Solution

if TYPE_CHECKING:
    from mechwright.mechanics.planar.compiled_chain import CompiledChain


def least_transmission(table: AnyPlanarTable) -> Array:
    """The least transmission angle over a period, rad; a number or a column."""
    return _number(table, _least_angle(table).value)


def worst_joint(table: AnyPlanarTable) -> str:
    """Of one linkage the inner joint of the group whose transmission angle is the least."""
    sines = table.solved_at(inputs_at(table, _least_angle(table).phase), 0).sines
    return min(sines, key=lambda joint: float(np.ravel(sines[joint])[0]), default="")


def figures_of(table: AnyPlanarTable) -> Mapping[str, Figure]:
    """The figures by their names."""
    slides = _slides(table)
    found = {
        "least_transmission_angle": Figure(lambda: least_transmission(table), "rad"),
        "input_range": Figure(
            lambda: _number(table, np.abs(ways_of(table).travel)), "mm" if table.driver_slides else "rad"
        ),
        "output_stroke" if slides else "output_swing": Figure(
            lambda: _number(table, _extent(table, output_value(table), 0.0 if slides else math.tau)),
            "mm" if slides else "rad",
        ),
        "time_ratio": Figure(lambda: _of_row(table, _time_ratio(table))),
    }
    for name in table.linkage.traces:
        for axis, letter in enumerate("xy"):
            found[f"{letter}{name}_range"] = Figure(partial(_path_range, table, name, axis), "mm")
    return found


TRANSMISSION = Quantity(
    transmission_angle, lambda chain: chain.least_sine(), lambda sines: np.arcsin(np.minimum(sines, 1.0))
)
"""The least transmission angle of all dyads, rad."""


def output_value(table: AnyPlanarTable) -> Quantity:
    """The output: its way along its slide on the ground, mm, or its angle, rad."""
    return table.once("output", lambda: _output_value(table))


def _output_value(table: AnyPlanarTable) -> Quantity:
    output = table.output
    for joint in table.machine.between(output, GROUND):
        if isinstance(joint, Prismatic):
            return Quantity(partial(_along, joint), partial(_way_row, joint))
    return Quantity(lambda found: found.bodies[output].turning.theta, lambda chain: chain.angle(output))


def _way_row(joint: Prismatic, chain: "CompiledChain") -> int:
    return chain.way(joint)


def _along(joint: Prismatic, found: Solution) -> Array:
    seen = found.bodies[joint.block].point(joint.point, 0).position
    guide = found.bodies[joint.guide].point(joint.line, 0).position
    direction = found.bodies[joint.guide].turning.theta + joint.line_angle
    return np.asarray(((seen - guide) * np.exp(-1j * direction)).real)


def _path_range(table: AnyPlanarTable, name: str, axis: int) -> Array:
    link, point = table.linkage.traces[name]
    place = table.linkage.points[link][point]

    def coordinate(found: Solution) -> Array:
        position = found.bodies[link].point(place, 0).position
        return np.asarray(position.imag if axis else position.real)

    return _number(table, _extent(table, Quantity(coordinate, lambda chain: chain.point(link, place) + axis)))


def _extent(table: AnyPlanarTable, quantity: Quantity, turn: float = 0.0) -> Array:
    return np.broadcast_to(extent(table, quantity, turn), (table.size, 1))


def _least_angle(table: AnyPlanarTable) -> Extreme:
    if not any(isinstance(group, Dyad) for group in table.order):
        return Extreme(np.full((table.size, 1), math.pi / 2), np.zeros((table.size, 1)))
    return table.once("least transmission angle", lambda: least(table, TRANSMISSION))


def _slides(table: AnyPlanarTable) -> bool:
    """Whether the output slides on the ground."""
    between = table.machine.between(table.output, GROUND)
    return any(isinstance(joint, Prismatic) for joint in between)


def _motion(table: AnyPlanarTable) -> tuple[Array, Solution]:
    """Phases (m,), and the motion with rates by the phase."""
    return table.once("motion by phase", lambda: over_phases(table, SAMPLES))


def _stroke(table: AnyPlanarTable) -> Stroke:
    def found() -> Stroke:
        phases, motion = _motion(table)
        return stroke(output_curve(table.machine, motion, phases, table.output))

    return table.once("stroke", found)


def _time_ratio(table: AnyPlanarTable) -> Array:
    """NaN of an input that goes there and back, which has no forward and return of its own."""
    rocks = ways_of(table).rocks[:, 0]
    return np.where(rocks, math.nan, _stroke(table).time_ratio)


def _of_row(table: AnyPlanarTable, values: Array) -> Array:
    """Values (n,), or one of all, as a number of one linkage or a column (n, 1)."""
    return _number(table, np.broadcast_to(np.reshape(values, (-1, 1)), (table.size, 1)))


def _number(table: AnyPlanarTable, column: Array) -> Array:
    """A number of one linkage, the column of a table."""
    return np.asarray(column.item()) if table.single else column
