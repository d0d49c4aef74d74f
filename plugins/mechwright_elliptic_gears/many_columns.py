"""Figures and extremes of channels of many pairs, as far as formulas tell them."""

import math
from collections.abc import Collection
from typing import Any

import numpy as np
from scipy.special import ellipe

from mechwright import Array
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.evaluation import told
from mechwright.contracts.sampling import SAMPLES
from mechwright.contracts.stretch import travelled
from mechwright_elliptic_gears.kinematics.equations import Turning, alpha_peak, jerk_peak
from mechwright_elliptic_gears.kinematics.motion import pair_channels
from mechwright_elliptic_gears.kinematics.point import place

BLOCK = 64
"""Designs whose motion is sampled at once: arrays of a third of a megabyte."""


def columns_of(designs: Designs, columns: Collection[str]) -> dict[str, Array] | None:
    """Columns (n,) of designs; None where one of them has to be sought design by design."""
    size = len(designs)

    def full(name: str) -> Array:
        return np.asarray(designs.full(name), dtype=float)

    e, alpha, omega = full("eccentricity"), np.radians(full("pressure_angle")), full("speed") * math.tau / 60
    if designs.common.semi_major is not None:
        a = full("semi_major")
    else:
        a = math.pi * full("module") * full("teeth") / (4 * ellipe(e**2))
    ratio = (1 + e) / (1 - e)
    figures: dict[str, tuple[Any, str]] = {
        "centre_distance": (2 * a, "mm"),
        "ratio_max": (ratio, ""),
        "ratio_min": (1 / ratio, ""),
        "omega4_max": (ratio * omega, "rad/s"),
        "alpha4_max": (alpha_peak(e) * omega**2, "rad/s^2"),
        "jerk4_max": (jerk_peak(e) * omega**3, "rad/s^3"),
        "pressure_angle_max": (alpha + np.arcsin(e), "rad"),
    }
    found = {name: told(*figures[name]) for name in columns if name in figures}
    extremes = [name.rpartition(".") for name in columns if name not in found]
    if not extremes or not size:
        return found | {name: np.full(size, np.nan) for name in columns if name not in found}
    sizes = (a, e, omega, alpha, place(full("point_along"), full("point_across"), a))
    known = pair_channels(TURN, *(values[:1, None] for values in sizes))
    if any(
        name not in known or name == "theta2" or end not in ("least", "greatest") for name, _, end in extremes
    ):
        return None
    for name, _, end in extremes:
        found[f"{name}.{end}"] = np.empty(size)
    for start in range(0, size, BLOCK):
        rows = slice(start, start + BLOCK)
        channels = pair_channels(TURN, *(values[rows, None] for values in sizes))
        for name, _, end in extremes:
            values = channels[name].values
            most = values.min(axis=-1) if end == "least" else values.max(axis=-1)
            found[f"{name}.{end}"][rows] = told(np.asarray(most), channels[name].unit)
    return found


TURN = Turning.of(travelled(math.tau, SAMPLES)).theta
"""Angles of gear 2, rad."""
