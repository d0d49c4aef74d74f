"""Figures of the motion; extremes are refined, so that they do not depend on the samples."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from mechwright.contracts.figure import Figure
from mechwright_cam_follower.kinematics.extremes import (
    innermost,
    load_peak,
    outermost,
    pressure_peak,
    sharpest,
    weakest,
)
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.turn import Extreme, greatest

_OF_CAM: dict[str, tuple[Callable[[Mechanism, int], Extreme], str]] = {
    "pressure_angle_max": (pressure_peak, "rad"),
    "cam_radius_min": (innermost, "mm"),
    "cam_radius_max": (outermost, "mm"),
    "curvature_radius_min": (sharpest, "mm"),
}
"""Figure of a cam, with its angle; those of the second of a pair have a 2 behind."""

_RATES = {"velocity": "v", "acceleration": "a", "jerk": "j"}

_LOADS = {"contact_force_max": "N", "contact_pressure_max": "MPa", "torque_max": "N*m"}


def figures_of(m: Mechanism) -> dict[str, Figure]:
    """Give the figures by name."""
    found: dict[str, Figure] = {}
    for cam in m.cams:
        end = "2" if cam else ""
        for name, (extreme, unit) in _OF_CAM.items():
            found[f"{name}{end}"] = Figure(partial(_finite, m, extreme, cam, "value"), unit)
            found[f"{name}{end}.theta"] = Figure(partial(_finite, m, extreme, cam, "angle"), "rad")
    unit = "mm" if m.slides else "rad"
    for power, name in enumerate(_RATES, start=1):
        of = f"{unit}/s" + (f"^{power}" if power > 1 else "")
        found[f"{name}_max"] = Figure(partial(_rate_peak, m, _RATES[name], power), of)
    for name, unit in _LOADS.items():
        found[name] = Figure(partial(_load_peak, m, name), unit)
    if not m.given.conjugate:
        found["press_min"] = Figure(lambda: weakest(m).value, "N" if m.slides else "N*m")
    return found


def _load_peak(m: Mechanism, name: str) -> Any:
    return load_peak(m, name).value


def _finite(m: Mechanism, extreme: Callable[[Mechanism, int], Extreme], cam: int, what: str) -> Any:
    """Give a value or an angle; no number where there is no such place."""
    found = extreme(m, cam)
    return np.where(np.isfinite(found.value), getattr(found, what), np.nan)


def _rate_peak(m: Mechanism, order: str, power: int) -> Any:
    """Give the greatest size of a rate of the follower: per radian one for all designs."""
    one = m.once("first", lambda: m.row(0))
    return greatest(one, order, lambda found: np.abs(getattr(found.rates, order))).value * m.omega**power
