"""Figures of a table of four-bars for a study: those of one design, and the extremes of its channels."""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from mechwright import Array, Motion, material
from mechwright.contracts.design_table import column
from mechwright.contracts.figure import Figure, PartMass
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.linkage.areas import circle_area, hull_area, straight_area
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright_four_bar.kinematics import period_kernels as kernels
from mechwright_four_bar.kinematics.extremes import CHANNELS, NEAR_TOGGLE, OF_POINT, STEP, extremes
from mechwright_four_bar.kinematics.figures import figures_of
from mechwright_four_bar.kinematics.motion import motion_of
from mechwright_four_bar.parts.usual import turning_bore
from mechwright_four_bar.table import FourBarTable


def study_figures(table: FourBarTable) -> Mapping[str, Figure]:
    """Figures, and the extremes of the channels of links and point, as the motion of each design has them."""

    def greatest_size(least: Array, greatest: Array) -> Array:
        return np.maximum(np.abs(least), np.abs(greatest))

    def one(name: str, row: int, unit: str, way: Callable[[Array, Array], Array], step: int = STEP) -> None:
        found[name] = Figure(partial(_sampled, table, name, row, step, way), unit)

    found = dict(figures_of(table))
    found["swing"] = Figure(partial(_swing, table, found["swing"]), "rad")
    found["time.least"] = Figure(0.0, "s")
    found["time.greatest"] = Figure(lambda: _time(table), "s")
    pointed = table.params.coupler_point is not None
    for name, (row, unit) in (CHANNELS | (OF_POINT if pointed else {})).items():
        if name not in {"alpha_a", "jerk_a"} or np.any(_varies(table)):
            one(f"{name}.least", row, unit, lambda least, _: least)
            one(f"{name}.greatest", row, unit, lambda _, greatest: greatest)
    one("transmission_angle.least", kernels.COSINE, "rad", lambda _, most: np.arccos(np.minimum(1.0, most)))
    one(
        "transmission_angle.greatest",
        kernels.COSINE,
        "rad",
        lambda least, _: np.arccos(np.minimum(1.0, least)),
    )
    one("omega_b_max", kernels.OMEGA_B, "rad/s", greatest_size, 1)
    one("alpha_b_max", kernels.ALPHA_B, "rad/s^2", greatest_size, 1)
    return found


def _swing(table: FourBarTable, of_rockers: Figure) -> Array:
    """With that of levers."""
    found, lever = column(of_rockers(), table.size).copy(), column(table.lever, table.size)[:, 0] > 0
    if lever.any():
        some = table.rows(np.flatnonzero(lever))
        found[lever] = _sampled(some, "swing", kernels.PSI, 1, lambda least, greatest: greatest - least)
    return found


def _varies(table: FourBarTable) -> Any:
    """Whether the crank's speed does."""
    return table.lever | (np.asarray(table.params.acceleration_ratio) != 0)


def _time(table: FourBarTable) -> Any:
    """Of a period, s."""
    ways, k = table.closed_ways, np.asarray(table.params.acceleration_ratio)
    spent = np.where(k == 0, ways.travel, -np.expm1(-k * ways.travel) / np.where(k == 0, 1.0, k))
    return np.where(ways.rocks, math.tau, np.abs(spent)) / table.omega


def _sampled(
    table: FourBarTable, name: str, row: int, step: int, way: Callable[[Array, Array], Array]
) -> Array:
    """A figure (n, 1) by the kernels; of designs in which these round too much by their own motions."""
    found = way(*extremes(table, row, step))[:, None]
    if name.startswith(("alpha_a.", "jerk_a.")):
        found = np.where(_varies(table), found, math.nan)
    doubtful = np.asarray(table.transmission[0]) < NEAR_TOGGLE
    for place in np.flatnonzero(column(doubtful | table.through, table.size)).tolist():
        found[place] = _of_motion(_own_motion(table, place), name)
    return found


def _own_motion(table: FourBarTable, place: int) -> Motion:
    return table.once(("motion", place), lambda: motion_of(table.row(place), SAMPLES))


def _of_motion(motion: Motion, name: str) -> float:
    if name in motion.scalars:
        return motion.scalars[name].value
    channel, _, end = name.rpartition(".")
    if channel not in motion.channels:
        return math.nan
    values = motion.channels[channel].values
    return float(values.min() if end == "least" else values.max())


def masses_of(table: FourBarTable) -> dict[str, PartMass]:
    """Masses of the plates that no layer decides, kg: of the follower where it has a shaft of its own."""
    params = table.params
    pin, turning = params.pin_diameter, turning_bore(params)
    small, large = pin / 2 + params.rim, turning / 2 + params.rim
    sheet = KILOGRAMS * material(params.material).density * params.thickness

    def straight(length: Any, radius: Any, bore: Any) -> Any:
        area = straight_area(length, radius, radius, params.web_width, FILLET)
        return sheet * (area - 2 * circle_area(bore))

    def coupler() -> Any:
        if params.coupler_point is None:
            return straight(params.coupler, large, turning)
        flat = [np.ravel(one) for one in (params.coupler, params.coupler_point, large, small)]
        area = hull_area([0j, flat[0], flat[1]], [flat[2], flat[2], flat[3]], table.size)
        return sheet * (area[:, None] - 2 * circle_area(turning) - circle_area(pin))

    found = {"crank": PartMass(lambda: straight(params.crank, small, pin))}
    if np.all(np.asarray(params.coupler_bend) == 0):
        found["coupler"] = PartMass(coupler)
    if params.frame == "two":
        found["follower"] = PartMass(lambda: straight(params.follower, small, pin))
    return found
