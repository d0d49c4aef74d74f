"""Figures of a table of four-bars for a study: those of one design, and the extremes of its channels."""

import math
from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Motion, material
from mechwright.contracts.design_table import column
from mechwright.contracts.figure import Figure, PartMass, SomeMasses
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.linkage.areas import circle_area, hull_area, straight_area
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright_four_bar.kinematics.compiled import NEAR_TOGGLE, compiled, rows_of
from mechwright_four_bar.kinematics.figures import figures_of
from mechwright_four_bar.kinematics.motion import motion_of
from mechwright_four_bar.parts.usual import turning_bore
from mechwright_four_bar.table import FourBarTable


def study_figures(table: FourBarTable) -> Mapping[str, Figure]:
    """Figures as the motion of each design has them."""
    found = dict(figures_of(table))
    found["swing"] = Figure(partial(_swing, table, found["swing"]), "rad")
    found["omega_b_max"] = Figure(partial(_peak, table, 0), "rad/s")
    found["alpha_b_max"] = Figure(partial(_peak, table, 1), "rad/s^2")
    return found


def extremes(table: FourBarTable, names: Collection[str]) -> dict[str, tuple[Array, Array, str]]:
    """Least and greatest values (n,) of channels of links, point and crank, with their units."""
    found: dict[str, tuple[Array, Array, str]] = {}
    if "time" in names:
        found["time"] = np.zeros(table.size), column(_time(table), table.size)[:, 0], "s"
    rows = rows_of(table)
    chosen = [name for name in names if name in rows]
    if not chosen:
        return found
    ends = _sampled(table, chosen, SAMPLES, _of_channel)
    for place, name in enumerate(chosen):
        low, high = ends[:, place].T
        if name in {"alpha_a", "jerk_a"}:  # a channel of cranks whose speed varies
            varies = column(_varies(table), table.size)[:, 0] > 0
            low, high = np.where(varies, low, math.nan), np.where(varies, high, math.nan)
        found[name] = low, high, rows[name][1]
    return found


def _sampled(
    table: FourBarTable, names: list[str], samples: int, own: Callable[[Motion, str], tuple[float, float]]
) -> Array:
    """Least and greatest values (n, k, 2) of channels; of doubtful designs by their own motions."""
    doubtful = column(np.asarray(table.transmission[0] < NEAR_TOGGLE) | table.through, table.size)[:, 0] > 0
    found = np.empty((table.size, len(names), 2))
    if not doubtful.any():
        found[:] = compiled(table, names, samples)
    elif not doubtful.all():
        found[~doubtful] = compiled(table.rows(np.flatnonzero(~doubtful)), names, samples)
    for place in np.flatnonzero(doubtful).tolist():
        motion = table.once(("motion", place), partial(motion_of, table.row(place), SAMPLES))
        found[place] = [own(motion, name) for name in names]
    return found


def _of_channel(motion: Motion, name: str) -> tuple[float, float]:
    if name not in motion.channels:
        return math.nan, math.nan
    values = motion.channels[name].values
    return float(values.min()), float(values.max())


def _of_peak(motion: Motion, name: str) -> tuple[float, float]:
    """Of a rate its greatest size; of the follower's angle its swing."""
    return 0.0, motion.scalars["swing" if name == "psi" else f"{name}_max"].value


def _peaks(table: FourBarTable, *, lever: bool) -> tuple[NDArray[np.bool_], Array]:
    """Which designs (n,) are levers, or are not, and the extremes (m, k, 2) of the follower of these."""

    def found() -> tuple[NDArray[np.bool_], Array]:
        own = (column(table.lever, table.size)[:, 0] > 0) == lever
        names = ["omega_b", "alpha_b", "psi"] if lever else ["omega_b", "alpha_b"]
        if not own.any():
            return own, np.empty((0, len(names), 2))
        some = table if own.all() else table.rows(np.flatnonzero(own))
        return own, _sampled(some, names, PEAK_SAMPLES, _of_peak)

    return table.once(("peaks", lever), found)


def _peak(table: FourBarTable, place: int) -> Array:
    found = np.empty((table.size, 1))
    for lever in (False, True):
        own, ends = _peaks(table, lever=lever)
        found[own] = np.abs(ends[:, place]).max(axis=1)[:, None]
    return found


def _swing(table: FourBarTable, of_rockers: Figure) -> Array:
    """With that of levers."""
    found = column(of_rockers(), table.size).copy()
    own, ends = _peaks(table, lever=True)
    found[own] = np.diff(ends[:, 2])
    return found


def _varies(table: FourBarTable) -> Any:
    """Whether the crank's speed does."""
    return table.lever | (np.asarray(table.params.acceleration_ratio) != 0)


def _time(table: FourBarTable) -> Any:
    """Of a period, s."""
    ways, k = table.closed_ways, np.asarray(table.params.acceleration_ratio)
    spent = np.where(k == 0, ways.travel, -np.expm1(-k * ways.travel) / np.where(k == 0, 1.0, k))
    return np.where(ways.rocks, math.tau, np.abs(spent)) / table.omega


def masses_of(table: FourBarTable) -> SomeMasses:
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

    found = SomeMasses(crank=PartMass(lambda: straight(params.crank, small, pin)))
    if np.all(np.asarray(params.coupler_bend) == 0):
        found["coupler"] = PartMass(coupler)
    if params.frame == "two":
        found["follower"] = PartMass(lambda: straight(params.follower, small, pin))
    return found
