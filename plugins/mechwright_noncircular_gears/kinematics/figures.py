"""Figures of a pair, or of a table of pairs."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.figure import Figure
from mechwright.mechanics.gearing import RatioLaw, Rolling
from mechwright.mechanics.peaks import greatest
from mechwright_noncircular_gears.kinematics.law import LawRows, least
from mechwright_noncircular_gears.kinematics.laws.sector import swung
from mechwright_noncircular_gears.kinematics.laws.window import WindowLaw
from mechwright_noncircular_gears.table import GearTable

GRID = 129
"""Samples of half a lobe, or of a blend, at which peaks of column laws are sought."""

UNITS = {
    "centre_distance": "mm",
    "ratio_max": "",
    "ratio_max.theta1": "rad",
    "ratio_min": "",
    "ratio_min.theta1": "rad",
    "omega2_max": "rad/s",
    "alpha2_max": "rad/s^2",
    "jerk2_max": "rad/s^3",
    "pressure_angle_max": "rad",
}
"""Name to unit."""


def figures(m: GearTable) -> Mapping[str, Figure]:
    """Extremes are refined, so that they do not depend on samples."""
    return {name: Figure(lambda name=name: _figure(m, name), unit) for name, unit in UNITS.items()}


def _figure(m: GearTable, name: str) -> Any:
    if name == "centre_distance":
        return m.distance
    if m.shares_law:
        return _of_shared_law(m, name)
    found = None if isinstance(m.law, LawRows) else _of_column_law(m, name)
    if found is None:
        return m.of_rows(lambda one: float(_of_shared_law(one, name)))
    value, sure = found
    if not sure.all():
        unsure = np.flatnonzero(~sure)
        value[unsure] = m.rows(unsure).of_rows(lambda one: float(_of_shared_law(one, name)))
    return value


def _of_shared_law(m: GearTable, name: str) -> Any:
    found, omega = m.extremes, m.omega
    if name == "pressure_angle_max":
        return found.steepest.value + m.given.pressure_angle * math.radians(1)
    if name in _ORDERS:
        order = _ORDERS[name]
        return _greatest(m.law, m.given.sector, order) * omega ** (order + 1)
    end = found.fastest if name.startswith("ratio_max") else found.slowest
    return end.angle if name.endswith("theta1") else end.value


_ORDERS = {"omega2_max": 0, "alpha2_max": 1, "jerk2_max": 2}
"""Name to the derivative of the ratio."""


def _greatest(law: RatioLaw, sector: float | None, order: int) -> float:
    """The greatest size of a derivative of ψ at unit speed: of the ratio over φ, or over a swing's phase."""

    def size(phi: Array) -> Array:
        if sector is None:
            return -np.abs(law.rates(phi)[order])
        return -np.abs(swung(law, phi, math.radians(sector))[order])

    return -least(law, size).value


def _of_column_law(m: GearTable, name: str) -> tuple[Array, NDArray[np.bool_]] | None:
    """A column (n, 1), and for which designs (n,) it is certain; None for what each design has by itself."""
    sure = np.ones(m.size, dtype=bool)
    if name in {"ratio_max", "omega2_max"}:
        return m.fastest * (m.omega if name == "omega2_max" else 1.0), sure
    if name == "ratio_min":
        return m.slowest, sure
    if name in _ORDERS:
        order = _ORDERS[name]
        value, sure = _peak(m, lambda law, phi: np.abs(law.rates(phi)[order]))
        return value * m.omega ** (order + 1), sure
    if name == "pressure_angle_max":
        side = m.given.side
        value, sure = _peak(m, lambda law, phi: np.abs(Rolling.of(law, phi, side).tilt))
        return value + m.given.pressure_angle * math.radians(1), sure
    return None


def _peak(m: GearTable, measure: Callable[[RatioLaw, Array], Array]) -> tuple[Array, NDArray[np.bool_]]:
    """Over a blend, or over half a lobe: laws are mirror images of themselves in both of its ends."""

    def at(which: NDArray[np.intp], share: Array) -> Array:
        law = m.rows(which).law
        begin, way = (law.width / 2, law.blend) if isinstance(law, WindowLaw) else (0.0, law.period / 2)
        phi = np.broadcast_to(begin + way * share, (which.size, share.shape[1]))
        return np.asarray(measure(law, phi))

    value, sure = greatest(at, m.size, 0.0, 1.0, GRID)
    return value[:, None], sure
