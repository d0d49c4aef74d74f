"""Figures of five-bars, and extremes of channels; compiled code finds those of cranks that turn fully."""

import math
from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.figure import Figure
from mechwright.contracts.sampling import SAMPLES
from mechwright.contracts.table_evaluation import ENDS
from mechwright.mechanics.linkage.kinematics.period import period_of
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright_five_bar.kinematics.channels import channels_of
from mechwright_five_bar.kinematics.loads import peak_samples, rate_peaks
from mechwright_five_bar.table import FiveBarTable

BLOCK = 64
"""Levers whose periods are sampled at once: arrays stay in the cache."""

UNITS = {
    "omega_c": "rad/s",
    "alpha_c": "rad/s^2",
    "omega_r": "rad/s",
    "alpha_r": "rad/s^2",
    "xP": "mm",
    "yP": "mm",
}
"""Channels whose extremes compiled code finds, in its order."""


def figures_of(m: FiveBarTable) -> dict[str, Figure]:
    """Transmission, ratio, turns or swing, and peaks of the coupler; NaN of those that a linkage has not."""
    lever = np.asarray(m.is_lever)
    found: dict[str, tuple[Any, str]] = {
        "least_transmission_angle": (m.transmission[0], "rad"),
        "greatest_transmission_angle": (m.transmission[1], "rad"),
        "ratio": (m.params.ratio, ""),
    }
    if lever.any():
        ends = [np.where(lever, np.degrees(one), math.nan) for one in m.ends]
        found |= {"swing_from": (np.minimum(*ends), "deg"), "swing_to": (np.maximum(*ends), "deg")}
    if not lever.all():
        found["turns"] = np.where(lever, math.nan, float(m.bar.turns)), ""
    figures = {name: Figure(value, unit) for name, (value, unit) in found.items()}
    peaks = {f"{name}_max": Figure(partial(_peak, m, name), UNITS[name]) for name in ("omega_c", "alpha_c")}
    return figures | peaks


def extremes_of(m: FiveBarTable) -> dict[str, Figure]:
    """Extremes of the channels that compiled code finds, of a table of linkages."""
    return {
        f"{name}.{end}": Figure(partial(_extreme, m, name, end), unit)
        for name, unit in UNITS.items()
        for end in ENDS
    }


def _peak(m: FiveBarTable, name: str) -> Any:
    """Greatest size of a rate of the coupler; of levers, which differ in their samples, one by one."""
    if m.single:
        return rate_peaks(period_of(m, peak_samples(m)).solution.bodies)[name].value
    samples = math.ceil(PEAK_SAMPLES * m.bar.turns)
    return _of_kinds(
        m,
        lambda some: np.abs(_bounds(some, name, samples)).max(axis=1, keepdims=True),
        lambda some: np.array([[_peak(some.row(place), name)] for place in range(some.size)]),
    )


def _extreme(m: FiveBarTable, name: str, end: str) -> Array:
    def of_levers(some: FiveBarTable) -> Array:
        return some.each(lambda few: ENDS[end](channels_of(few, SAMPLES)[name].values)[:, None], BLOCK)

    place = list(ENDS).index(end)
    return _of_kinds(m, lambda some: _bounds(some, name, SAMPLES)[:, [place]], of_levers)


def _of_kinds(
    m: FiveBarTable, of_cranks: Callable[[FiveBarTable], Array], of_levers: Callable[[FiveBarTable], Array]
) -> Array:
    """What is found (n, 1) of cranks that turn fully, and of levers."""
    found = np.empty((m.size, 1))
    for function, where in ((of_cranks, ~m.levers), (of_levers, m.levers)):
        if where.any():
            found[where] = function(m.rows(np.flatnonzero(where)))
    return found


@lru_cache(8)
def _table(ratio: float, turns: int, samples: int) -> Array:
    """Cosine and sine of the angles of crank and arm over a period, (4, samples)."""
    theta = np.linspace(0.0, math.tau * turns, samples)
    return np.ascontiguousarray([np.cos(theta), np.sin(theta), np.cos(ratio * theta), np.sin(ratio * theta)])


def _bounds(m: FiveBarTable, name: str, samples: int) -> Array:
    """Least and greatest value (n, 2)."""
    from mechwright_five_bar.kinematics.rate_extremes import extremes

    bar, params = m.bar, m.params
    rows = (*bar.lengths, bar.ground_angle, bar.offset, bar.branch)
    place = (params.coupler_point_x, params.coupler_point_y, params.pivot_x, params.pivot_y)
    sense = 1.0 if params.direction == "ccw" else -1.0
    omega = np.ascontiguousarray(column(sense * params.speed * math.tau / 60, m.size)[:, 0])
    bars, points = (np.concatenate([column(one, m.size) for one in some], axis=1) for some in (rows, place))
    table = _table(bar.ratio, bar.turns, samples)
    found: Array = extremes(bars, bar.ratio, omega, points, table, list(UNITS).index(name))
    return found
