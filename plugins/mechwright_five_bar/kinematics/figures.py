"""Figures of five-bars."""

import math
from functools import lru_cache, partial
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.figure import Figure
from mechwright.mechanics.linkage.kinematics.channel_extremes import drives_of
from mechwright.mechanics.linkage.kinematics.period import period_of
from mechwright_five_bar.kinematics.loads import peak_samples, rate_peaks
from mechwright_five_bar.table import FiveBarTable

UNITS = {"omega_c": "rad/s", "alpha_c": "rad/s^2"}
"""Rates of the coupler whose peaks are figures."""


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
    peaks = {f"{name}_max": Figure(partial(_peak, m, name), UNITS[name]) for name in UNITS}
    return figures | peaks


def _peak(m: FiveBarTable, name: str) -> Any:
    """Greatest size of a rate of the coupler."""
    if m.single:
        return rate_peaks(period_of(m, int(peak_samples(m))).solution.bodies)[name].value
    found, counts = np.empty((m.size, 1)), np.broadcast_to(peak_samples(m), (m.size, 1))[:, 0]
    for count, lever in {*zip(counts.tolist(), m.levers.tolist(), strict=True)}:
        places = np.flatnonzero((counts == count) & (m.levers == lever))
        found[places, 0] = (_lever_peaks if lever else _crank_peaks)(m.rows(places), name, count)
    return found


def _lever_peaks(m: FiveBarTable, name: str, samples: int) -> Array:
    assert m.chain is not None  # noqa: S101 - of a table
    row = m.chain.turning("coupler") + (2 if name == "omega_c" else 3)
    found: Array = np.abs(m.chain.extremes(drives_of(m), [(row, 1)], samples)[:, 0]).max(axis=1)
    return found


def _crank_peaks(m: FiveBarTable, name: str, samples: int) -> Array:
    from mechwright_five_bar.kinematics.coupler_peaks import coupler_peaks

    bar = m.bar
    rows = (*bar.lengths, bar.ground_angle, bar.offset, bar.branch)
    bars = np.concatenate([column(one, m.size) for one in rows], axis=1)
    omega = np.ascontiguousarray(column(m.sense * m.omega, m.size)[:, 0])
    found: Array = coupler_peaks(
        bars, bar.ratio, omega, _circles(bar.ratio, bar.turns, samples), 1 + (name == "alpha_c")
    )
    return found


@lru_cache(8)
def _circles(ratio: float, turns: int, samples: int) -> Array:
    """Cosine and sine of the angles of crank and arm over a period, (4, samples)."""
    theta = np.linspace(0.0, math.tau * turns, samples)
    return np.ascontiguousarray([np.cos(theta), np.sin(theta), np.cos(ratio * theta), np.sin(ratio * theta)])
