"""Figures of designs: ends of the stroke, transmission angle, peaks over a period, masses and balance."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column, number
from mechwright.contracts.figure import Figure
from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.planar.dynamics import Forces
from mechwright_slider_crank.kinematics.course import (
    LEVER_SAMPLES,
    course_of,
    drives,
    ends_of,
    is_lever,
    least_of,
    some,
    toggles,
)
from mechwright_slider_crank.kinematics.extremes import rate_peak
from mechwright_slider_crank.kinematics.forces import MILLI, Balance, balance, joint_forces
from mechwright_slider_crank.kinematics.limits import limits
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.kinematics.peak_kernel import GRID, NEAR, ROUNDS
from mechwright_slider_crank.parts.layers import has_bounds
from mechwright_slider_crank.parts.masses import bodies_of
from mechwright_slider_crank.rules.rule_table import buildable

_NEAR = np.linspace(-1, 1, NEAR)


def figures(table: Mechanism) -> dict[str, Figure]:
    """The figures by name; of one design those of its forces too."""
    ends = ends_of(table)
    found = {
        "stroke": Figure(ends.stroke, "mm"),
        "time_ratio": Figure(ends.time_ratio),
        "phi_far": Figure(ends.far, "rad"),
        "phi_near": Figure(ends.near, "rad"),
        "s_far": Figure(ends.far_position, "mm"),
        "s_near": Figure(ends.near_position, "mm"),
        "least_transmission_angle": Figure(lambda: least_of(table), "rad"),
    }
    if not table.single or is_lever(table):
        found |= {name: Figure(partial(_lever, table, name), "deg") for name in _LEVER}
    if table.single and table.closed.at_limit:
        # Of a linkage at its limit that something keeps in its assembly.
        clamped = limits(table.closed)
        found["assembly_stroke"] = Figure(clamped.stroke, "mm")
        found["assembly_time_ratio"] = Figure(clamped.time_ratio)
    found["v_max"] = Figure(partial(_rate_peak, table, 1), "mm/s")
    found["a_max"] = Figure(partial(_rate_peak, table, 2), "mm/s^2")
    if table.single and buildable(table):
        peaks = force_peaks(table)
        found |= {name: Figure(value, _UNITS.get(name, "N")) for name, value in peaks.items()}
    if buildable(table) if table.single else has_bounds(table):
        found |= {name: Figure(partial(_mass, table, value), unit) for name, value, unit in _MASSES}
    return found


_UNITS = {"drive_torque_max": "N*m"}

_LEVER = ("swing_from", "swing_to", "input_range", "toggle_low", "toggle_high")
"""Where a lever turns back, and where the rod would stand across the slide: crank angles."""


def _lever(table: Mechanism, name: str) -> Any:
    start, travel = drives(table)
    low, high = np.minimum(start, start + travel), np.maximum(start, start + travel)
    values = dict(zip(_LEVER, (low, high, high - low, *toggles(table)), strict=True))
    return np.where(is_lever(table), np.degrees(values[name]), math.nan)


_MASSES: tuple[tuple[str, Callable[[dict[str, Mass], Balance], Any], str], ...] = (
    ("mass_crank", lambda masses, _: masses["crank"].mass, "kg"),
    ("mass_rod", lambda masses, _: masses["rod"].mass, "kg"),
    ("mass_slider", lambda masses, _: masses["slider"].mass, "kg"),
    ("balance_rod_x", lambda _, weights: np.real(weights.rod), "kg*mm"),
    ("balance_rod_y", lambda _, weights: np.imag(weights.rod), "kg*mm"),
    ("balance_crank_x", lambda _, weights: np.real(weights.crank), "kg*mm"),
    ("balance_crank_y", lambda _, weights: np.imag(weights.crank), "kg*mm"),
    ("balance_rod_weight", lambda _, weights: weights.rod_weight, "kg"),
)


def _mass(table: Mechanism, value: Callable[[dict[str, Mass], Balance], Any]) -> Any:
    """A mass, or a counterweight; NaN for designs that cannot be made."""
    stands = np.asarray(buildable(table))
    places, given = np.flatnonzero(column(stands, table.size)), table
    if not table.single and places.size < table.size:
        given = table.rows(places)
    masses = bodies_of(given)
    own = value(masses, balance(given.given.crank, given.given.rod, masses))
    if table.single or given is table:
        return number(own)
    found = np.full((table.size, 1), math.nan)
    found[places] = column(own, places.size)
    return found


def _rate_peak(table: Mechanism, rate: int) -> Any:
    """The greatest size of the slider's velocity or acceleration, at the limit through both assemblies."""
    limit = some(table, table.closed.at_limit)
    if not limit.size:
        return rate_peak(table, rate)
    others = some(table, ~np.asarray(table.closed.at_limit))
    found = np.zeros((table.size, 1))
    if others.size:
        found[others] = rate_peak(table.rows(others), rate)
    for place in limit.tolist():
        found[place] = most(table.row(place), lambda bodies: {"": np.abs(bodies.along[rate])})[""]
    return found.item() if table.single else found


def force_peaks(table: Mechanism) -> dict[str, float]:
    """The greatest torque, N m, and the greatest forces of one design, N."""
    masses, load = bodies_of(table), table.given.load

    def sizes(bodies: Any) -> dict[str, Array]:
        carried = joint_forces(bodies, masses, load)
        forces = {f"{name}_max": size for name, size in force_sizes(carried).items()}
        return {"drive_torque_max": np.abs(carried.drive) * MILLI, **forces}

    return most(table, sizes)


def force_sizes(carried: Forces) -> dict[str, Array]:
    """Sizes of the forces of joints and of the force on the ground, N."""
    found = {f"force_{name.replace('-', '_')}": np.abs(force) for name, force in carried.joints.items()}
    return found | {"shaking_force": np.abs(carried.shaking)}


def most(table: Mechanism, sizes: Callable[[Any], dict[str, Array]]) -> dict[str, float]:
    """Greatest values over a period; of a lever among as many samples as its ends are sought in."""
    course, speed, link = course_of(table), table.omega, table.closed
    if course.rocks:
        _, drive = course.period(LEVER_SAMPLES, speed)
        return {name: float(size.max()) for name, size in sizes(link.bodies(drive.theta, drive)).items()}
    turned = course.travel / math.tau

    def values(angle: Array) -> dict[str, Array]:
        drive = course.turning(course.start + turned * angle, speed)
        return sizes(link.bodies(drive.theta, drive))

    # A crank that accelerates does not end as it has begun.
    return peaks(values, math.inf if table.given.acceleration_ratio == 0 else math.tau)


def peaks(functions: Callable[[Array], dict[str, Array]], end: float = math.inf) -> dict[str, float]:
    """Greatest values of functions from 0 to 2π, independent of any sampling of the motion.

    They have that period, or end there: then no value beyond ``end`` or before 0 is asked for.

    >>> found = peaks(lambda t: {"sine": 3 + np.sin(t - 1), "cosine": np.cos(t)})
    >>> round(found["sine"], 12), round(found["cosine"], 12)
    (4.0, 1.0)
    """
    grid = np.linspace(0, math.tau, GRID + 1)
    begin = -math.inf if math.isinf(end) else 0.0
    found = {}
    for name, values in functions(grid).items():
        centre, half = float(grid[np.argmax(values)]), math.tau / GRID
        best = float(values.max())
        for _ in range(ROUNDS):
            at = np.clip(centre + half * _NEAR, begin, end)
            near = functions(at)[name]
            best, centre = max(best, float(near.max())), float(at[np.argmax(near)])
            half /= 8
        found[name] = best
    return found
