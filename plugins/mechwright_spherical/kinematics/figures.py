"""Figures and extremes of a table of four-bars, for a study."""

import math
from collections.abc import Collection

import numpy as np

from mechwright import Array
from mechwright.contracts.figure import Figure
from mechwright.contracts.sampling import SAMPLES
from mechwright_spherical.kinematics import kernels
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.mobility import mobility
from mechwright_spherical.table import SphericalTable

_CIRCLE = kernels.circle_of(SAMPLES)

_RATES = {"omega": "rad/s", "alpha": "rad/s^2", "jerk": "rad/s^3"}
_RATES |= {f"{name}_psi": unit for name, unit in _RATES.items()}
"""In the order of the rows of the kernel."""

Ends = tuple[Array, Array, str]


def figures_of(t: SphericalTable) -> dict[str, Figure]:
    """Transmission angles and sums of arcs of a table; each other linkage has those of its motion."""
    low, high = np.hsplit(t.courses.transmission, 2)
    found = {"transmission_min": Figure(low, "rad"), "transmission_max": Figure(high, "rad")}
    return found | {f"T{one}": Figure(value, "rad") for one, value in enumerate(mobility(*t.bars).t, start=1)}


def extremes_of(t: SphericalTable, names: Collection[str]) -> dict[str, Ends]:
    """Least and greatest values (n,) of input, output and transmission angle, with their units."""
    found: dict[str, Ends] = {"transmission_angle": (*t.courses.transmission.T, "rad")}
    bars, drives = t.rows_of_bars
    found["time"] = np.zeros(t.size), math.tau / drives[:, 3], "s"
    if _RATES.keys() & set(names):
        rates = kernels.extremes(bars, drives, _CIRCLE)
        found |= {name: (*rates[:, row].T, unit) for row, (name, unit) in enumerate(_RATES.items())}
    if "psi" in names:
        start, travel, rocks, _ = drives.T[:, :, None]
        theta = np.where(rocks > 0, start + travel / 2 * (1 - _CIRCLE[0]), math.tau * _CIRCLE[2])
        psi = FourBar(*bars.T[:, :, None]).output_angle(theta)
        turns = math.tau * np.round(psi[:, 0] / math.tau)
        found["psi"] = psi.min(axis=1) - turns, psi.max(axis=1) - turns, "rad"
    return found
