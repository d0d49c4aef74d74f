"""Periods of many four-bars, and the extremes of their channels."""

import math
from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright_four_bar.kinematics import period_kernels as kernels
from mechwright_four_bar.kinematics.dimensions import FourBar

STEP = (PEAK_SAMPLES - 1) // (SAMPLES - 1)
"""Of so many samples among which peaks are sought, one is a sample of the channels."""

_TURN = math.tau * np.linspace(0.0, 1.0, PEAK_SAMPLES)
CIRCLE = np.ascontiguousarray([np.cos(_TURN), np.sin(_TURN), np.linspace(0.0, 1.0, PEAK_SAMPLES)])

_CHANNELS = {
    "omega_a": kernels.OMEGA_A, "alpha_a": kernels.ALPHA_A, "jerk_a": kernels.JERK_A,
    "omega_c": kernels.OMEGA_C, "alpha_c": kernels.ALPHA_C, "jerk_c": kernels.JERK_C,
    "omega_b": kernels.OMEGA_B, "alpha_b": kernels.ALPHA_B, "jerk_b": kernels.JERK_B,
    "sigma": kernels.SIGMA, "psi": kernels.PSI,
    "xP": kernels.X, "yP": kernels.Y, "vxP": kernels.VX, "vyP": kernels.VY,
    "axP": kernels.AX, "ayP": kernels.AY, "jxP": kernels.JX, "jyP": kernels.JY,
}  # fmt: skip
_ANGLES = {"sigma", "psi"}
_OF_POINT = {"xP", "yP", "vxP", "vyP", "axP", "ayP", "jxP", "jyP"}
_THIRD = {"jerk_c", "jerk_b", *_OF_POINT}
_PEAKS = {"omega_b_max": kernels.OMEGA_B, "alpha_b_max": kernels.ALPHA_B}


@dataclass(frozen=True)
class Period:
    """Periods (n,): start and travel, rad, which of them rock, acceleration ratio, and speed, rad/s."""

    start: Array
    travel: Array
    rocks: NDArray[np.bool_]
    ratio: Array
    speed: Array

    @property
    def time(self) -> Array:
        """S."""
        k = self.ratio
        spent = np.where(k == 0, self.travel, -np.expm1(-k * self.travel) / np.where(k == 0, 1.0, k))
        return np.asarray(np.where(self.rocks, math.tau, np.abs(spent)) / self.speed)

    @property
    def rows(self) -> Array:
        """(n, 5), for the kernels."""
        return np.stack([self.start, self.travel, self.rocks, self.ratio, self.speed], axis=1).astype(float)

    def some(self, places: NDArray[Any]) -> "Period":
        """Those at these places."""
        parts = (self.start, self.travel, self.rocks, self.ratio, self.speed)
        return Period(*(np.broadcast_to(one, self.rocks.shape)[places] for one in parts))


def bars_of(bar: FourBar, count: int) -> Array:
    """Dimensions (n, 6), for the kernels."""
    parts = (*bar.lengths, bar.ground_angle, bar.branch)
    return np.stack([np.broadcast_to(one, count) for one in parts], axis=1).astype(float)


def give_extremes(
    found: Answer, columns: Collection[str], designs: Designs, bar: FourBar, period: Period
) -> None:
    """Extremes of channels, and peaks, of the designs that are open."""
    pointed = designs.common.coupler_point is not None
    rows: dict[str, tuple[int, int, int]] = {}
    for name in columns:
        channel, _, end = name.rpartition(".")
        if name in _PEAKS:
            rows[name] = _PEAKS[name], 1, 2
        elif channel in _CHANNELS and (pointed or channel not in _OF_POINT):
            rows[name] = _CHANNELS[channel], STEP, int(end == "greatest")
        elif channel == "transmission_angle":
            rows[name] = kernels.COSINE, STEP, int(end == "least")
        elif name == "swing":
            rows[name] = kernels.PSI, 1, 3
    if not rows:
        return
    wanted = sorted({(row, step) for row, step, _ in rows.values()})
    left = found.left
    channels = {name.rpartition(".")[0] for name in rows}
    angles = period.rocks[left] & ("swing" in rows) | bool(channels & _ANGLES)
    told = kernels.extremes(
        bars_of(bar, found.size)[left],
        period.rows[left],
        _points(designs, pointed)[left],
        CIRCLE,
        np.array(wanted, dtype=np.int64),
        bool(channels & _THIRD),
        angles,
        bool(channels & _OF_POINT),
    )
    varies = period.rocks[left] | (period.ratio[left] != 0)
    for name, (row, step, way) in rows.items():
        least, greatest = told[:, wanted.index((row, step))].T
        value = (least, greatest, np.maximum(np.abs(least), np.abs(greatest)), greatest - least)[way]
        if row == kernels.COSINE:
            value = np.arccos(np.minimum(1.0, value))
        if row in {kernels.COSINE, kernels.SIGMA, kernels.PSI}:
            value = np.degrees(value)
        if row in {kernels.ALPHA_A, kernels.JERK_A}:
            value = np.where(varies, value, np.nan)
        if name == "swing":
            value = np.where(period.rocks[left], value, found.values["swing"][left])
        found.give(name, value, left)


def _points(designs: Designs, pointed: bool) -> Array:
    names = ("coupler_point_x", "coupler_point_y") if pointed else ()
    place = [designs.full(name) for name in names] or [np.zeros(len(designs))] * 2
    parts = [*place, designs.full("pivot_x"), designs.full("pivot_y")]
    return np.stack(parts, axis=1).astype(float)
