"""Extremes of channels over the periods of a table of four-bars, by compiled kernels."""

import math
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright_four_bar.kinematics import period_kernels as kernels
from mechwright_four_bar.table import FourBarTable

STEP = (PEAK_SAMPLES - 1) // (SAMPLES - 1)
"""Of so many samples among which peaks are sought, one is a sample of the channels."""

NEAR_TOGGLE = 1e-2
"""Transmission angle, rad, below which rounding tells in the rates of the kernels."""

_TURN = math.tau * np.linspace(0.0, 1.0, PEAK_SAMPLES)
CIRCLE = np.ascontiguousarray([np.cos(_TURN), np.sin(_TURN), np.linspace(0.0, 1.0, PEAK_SAMPLES)])

CHANNELS = {
    "omega_a": (kernels.OMEGA_A, "rad/s"), "alpha_a": (kernels.ALPHA_A, "rad/s^2"),
    "jerk_a": (kernels.JERK_A, "rad/s^3"), "omega_c": (kernels.OMEGA_C, "rad/s"),
    "alpha_c": (kernels.ALPHA_C, "rad/s^2"), "jerk_c": (kernels.JERK_C, "rad/s^3"),
    "omega_b": (kernels.OMEGA_B, "rad/s"), "alpha_b": (kernels.ALPHA_B, "rad/s^2"),
    "jerk_b": (kernels.JERK_B, "rad/s^3"), "sigma": (kernels.SIGMA, "rad"), "psi": (kernels.PSI, "rad"),
}  # fmt: skip
"""Channel to its row and unit."""

OF_POINT = {
    "xP": (kernels.X, "mm"), "yP": (kernels.Y, "mm"), "vxP": (kernels.VX, "mm/s"), "vyP": (kernels.VY, "mm/s"),
    "axP": (kernels.AX, "mm/s^2"), "ayP": (kernels.AY, "mm/s^2"), "jxP": (kernels.JX, "mm/s^3"),
    "jyP": (kernels.JY, "mm/s^3"),
}  # fmt: skip


def bars_of(table: FourBarTable) -> Array:
    """Dimensions (n, 6), for the kernels."""
    return _rows(table, *table.bar.lengths, table.bar.ground_angle, table.bar.branch)


def drives_of(table: FourBarTable) -> Array:
    """Start, travel, rad, whether the crank rocks, acceleration ratio, and speed, rad/s: (n, 5)."""
    ways = table.closed_ways
    return _rows(table, ways.start, ways.travel, ways.rocks, ways.acceleration_ratio, table.omega)


def extremes(table: FourBarTable, row: int, step: int) -> tuple[Array, Array]:
    """Least and greatest value (n,) of a row of the kernels over a period, of every so many samples."""
    traced = row >= kernels.X
    point: Any = table.params.coupler_point if traced else 0j
    found = kernels.extremes(
        bars_of(table),
        drives_of(table),
        _rows(table, *(part(one) for one in (point, table.pivot) for part in (np.real, np.imag))),
        CIRCLE,
        np.array([(row, step)], dtype=np.int64),
        traced or row in {kernels.JERK_C, kernels.JERK_B},
        np.full(table.size, row in {kernels.SIGMA, kernels.PSI}),
        traced,
    )
    return found[:, 0, 0], found[:, 0, 1]


def _rows(table: FourBarTable, *parts: Any) -> Array:
    return np.concatenate([column(one, table.size) for one in parts], axis=1)
