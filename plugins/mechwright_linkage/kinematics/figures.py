"""Figures of a linkage, or of a table of linkages: transmission angles, output, paths."""

import math
from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from mechwright import Array
from mechwright.contracts.figure import Figure
from mechwright.mechanics.planar.positions import Solution
from mechwright_linkage.kinematics.channels import slide_of, transmission_angle, turning_links
from mechwright_linkage.kinematics.extremes import Extreme, greatest, least
from mechwright_linkage.kinematics.linkage_table import LinkageTable
from mechwright_linkage.kinematics.period import inputs_at, ways_of


def least_transmission(table: LinkageTable) -> Array:
    """The least transmission angle over a period, rad; a number or a column."""
    return _single(table, _extreme(table, "transmission", transmission_angle, least).value)


def worst_joint(table: LinkageTable) -> str:
    """Of one linkage the inner joint of the group whose transmission angle is the least."""
    phase = _extreme(table, "transmission", transmission_angle, least).phase
    sines = table.solved_at(inputs_at(table, phase), 0).sines
    return min(sines, key=lambda joint: float(np.ravel(sines[joint])[0]), default="")


def figures_of(table: LinkageTable) -> Mapping[str, Figure]:
    """The figures by their names."""
    found = {
        "least_transmission_angle": Figure(lambda: least_transmission(table), "rad"),
        "input_range": Figure(lambda: _single(table, np.abs(ways_of(table).travel)), _input_unit(table)),
    }
    output = table.given.output_link
    if output in turning_links(table.machine):
        found["output_swing"] = Figure(lambda: _single(table, _range(table, "output", _angle(output))), "rad")
    else:
        found["output_stroke"] = Figure(lambda: _single(table, _range(table, "output", _along(table))), "mm")
    value = _angle(output) if "output_swing" in found else _along(table)
    found["time_ratio"] = Figure(lambda: _single(table, _time_ratio(table, value)))
    for name, (link, point) in table.linkage.traces.items():
        place = partial(_place, link=link, at=table.linkage.points[link][point])
        for axis, part in (("x", np.real), ("y", np.imag)):
            of_axis = partial(_part, part, place)
            found[f"{axis}{name}_range"] = Figure(
                lambda key=f"{axis}{name}", of=of_axis: _single(table, _range(table, key, of)), "mm"
            )
    return found


def _input_unit(table: LinkageTable) -> str:
    return "mm" if table.driver_slides else "rad"


def _angle(link: str) -> Callable[[Solution], Array]:
    """The angle of a link, counted on over the samples; of one that turns all the way it has no extremes."""
    return lambda found: np.unwrap(found.bodies[link].turning.theta)


def _along(table: LinkageTable) -> Callable[[Solution], Array]:
    """The way of the output along its slide on the ground."""
    joint = slide_of(table.machine, table.given.output_link)

    def along(found: Solution) -> Array:
        point = found.bodies[joint.block].point(joint.point).position
        return np.asarray((point * np.exp(-1j * np.asarray(joint.line_angle))).real)

    return along


def _place(found: Solution, link: str, at: complex) -> Array:
    return found.bodies[link].point(at).position


def _part(part: Callable[[Array], Array], place: Callable[[Solution], Array], found: Solution) -> Array:
    return part(place(found))


def _extreme(
    table: LinkageTable, key: str, value: Callable[[Solution], Array], which: Callable[..., Extreme]
) -> Extreme:
    found: Extreme = table.once((key, which.__name__), lambda: which(table, value))
    return found


def _range(table: LinkageTable, key: str, value: Callable[[Solution], Array]) -> Array:
    ends = (_extreme(table, key, value, which).value for which in (greatest, least))
    high, low = ends
    return np.asarray(high - low)


def _time_ratio(table: LinkageTable, value: Callable[[Solution], Array]) -> Array:
    """Longer over shorter part of a turn between both ends of the output; NaN of levers."""
    high, low = (_extreme(table, "output", value, which).phase for which in (greatest, least))
    way = np.mod(high - low, math.tau)
    ratio = np.maximum(way, math.tau - way) / np.maximum(np.minimum(way, math.tau - way), 1e-300)
    return np.where(ways_of(table).rocks, math.nan, ratio)


def _single(table: LinkageTable, column: Array) -> Array:
    """A number of one linkage, the column of a table."""
    return np.asarray(column.item()) if table.single else column
