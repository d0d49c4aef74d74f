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
from mechwright.mechanics.linkage.kinematics.path_figures import (
    Gait,
    Path,
    Straightness,
    Stroke,
    gait,
    output_curve,
    path_length,
    stance,
    straightness,
    stroke,
)
from mechwright.mechanics.linkage.kinematics.period import inputs_at, over_phases, ways_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.assembly_order import Dyad
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.rigid import PointMotion

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
        found[f"{name}_length"] = Figure(partial(_path_length, table, name), "mm")
    if table.linkage.straight is not None:
        found["straight_length"] = Figure(lambda: _of_row(table, _straight(table).length), "mm")
        found["straight_band"] = Figure(lambda: _of_row(table, _straight(table).band), "mm")
    if table.linkage.walks:
        found["stride"] = Figure(lambda: _of_row(table, _gait(table).stride), "mm")
        found["lift"] = Figure(lambda: _of_row(table, _gait(table).lift), "mm")
        found["stance_share"] = Figure(lambda: _of_row(table, _stance_share(table)))
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


def _path_length(table: AnyPlanarTable, name: str) -> Array:
    """Once along: of an input that goes there and back half of the way over the period."""
    phases, motion = _motion(table)
    length = path_length(Path.of(phases, _traced(table, motion, name)))
    return _of_row(table, np.where(ways_of(table).rocks[:, 0], length / 2, length))


def _traced(table: AnyPlanarTable, motion: Solution, name: str) -> PointMotion:
    link, point = table.linkage.traces[name]
    return motion.bodies[link].point(table.linkage.points[link][point])


def _first_path(table: AnyPlanarTable) -> str:
    return next(iter(table.linkage.traces))


def _straight(table: AnyPlanarTable) -> Straightness:
    """How straight the path is along its chord, where it is meant to be straight."""

    def found() -> Straightness:
        begin, end = np.radians(table.linkage.straight or (0.0, 0.0))
        at = np.linspace(begin, end, SAMPLES)
        point = _traced(table, table.solved_at(np.atleast_2d(at)), _first_path(table))
        chord = np.angle(point.position[..., -1:] - point.position[..., :1])
        return straightness(Path.of(at, point, chord), begin, end)

    return table.once("straight", found)


def _foot(table: AnyPlanarTable) -> Path:
    """The path of the foot over a turn of the driver; NaN of drivers that do not turn."""
    at = table.drawn_at + np.linspace(0.0, math.tau, 2 * SAMPLES - 1)
    point = _traced(table, table.solved_at(np.atleast_2d(at)), _first_path(table))
    return Path.of(at, point)


def _gait(table: AnyPlanarTable) -> Gait:
    return table.once("gait", lambda: gait(_foot(table)))


def _stance_share(table: AnyPlanarTable) -> Array:
    """Share of the turn in which the foot is lower than a tenth of its lift."""
    return table.once("stance", lambda: stance(_foot(table), _gait(table).lift / 10).share)


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
