"""From the design table to the law, and how far it is from what teeth can follow."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from mechwright import Array, kept
from mechwright.contracts.design_table import Rows, Rowwise
from mechwright.mechanics.gearing import RatioLaw, Rolling
from mechwright.mechanics.peak import peak
from mechwright_noncircular_gears.kinematics.laws.formula import AngleFormula, RatioFormula, WrittenLaw
from mechwright_noncircular_gears.kinematics.laws.fourier import FourierLaw
from mechwright_noncircular_gears.kinematics.laws.indexing import IndexLaw
from mechwright_noncircular_gears.kinematics.laws.pitch import CircleLaw, EllipseLaw, LimaconLaw
from mechwright_noncircular_gears.kinematics.laws.sector import (
    AngleCourse,
    Course,
    RatioCourse,
    SectorLaw,
    SpiralCourse,
    TableCourse,
)
from mechwright_noncircular_gears.kinematics.laws.slider import SliderLaw
from mechwright_noncircular_gears.kinematics.laws.table import TableLaw
from mechwright_noncircular_gears.kinematics.laws.window import WindowLaw
from mechwright_noncircular_gears.parameters import NoncircularParams

T = TypeVar("T")

LEAST_RATIO = 1e-3
"""Share of the mean ratio below which the driven gear as good as stands."""

GRID = 1440
"""Samples of a lobe at which extremes are sought: sixteen harmonics have ninety of them each."""

ENDS = 1.5
"""Pitches beyond the ends of a sector to where flanks and fillets of its last teeth come from."""

_ROUNDS = 3
"""Grids of a sector, each about the best place of the one before: the last step is 1e-9 of the travel."""

PITCH_LAWS: dict[str, Callable[[tuple[int, int], float, int], RatioLaw]] = {
    "ellipse": EllipseLaw,
    "limacon": LimaconLaw,
    "eccentric-circle": CircleLaw,
}

COLUMN_LAWS = ("window", "ellipse", "limacon")
"""Laws whose formulas take columns (n, 1) for numbers, and that are mirror images of themselves."""

FORMULAS: dict[str, Callable[[tuple[int, int], str], WrittenLaw]] = {
    "ratio": RatioFormula,
    "angle": AngleFormula,
}


def alike(value: T) -> T:
    """The first of equal laws, curves or teeth, with all that has been found of it.

    Designs that differ in bores, loads or plates share them.
    """
    first: T = _first_alike(value)
    return first


@kept
def _first_alike(value: Any) -> Any:
    return value


@kept
def law_of(params: NoncircularParams) -> RatioLaw:
    """The law of a design; whether it can be run, :func:`extremes_of` tells."""
    return alike(stated_law(params))


def stated_law(params: NoncircularParams) -> RatioLaw:
    """The law of a design, or of a table of designs with one of the :data:`COLUMN_LAWS`."""
    lobes = params.lobes, params.mate_lobes

    def angles(*names: str) -> tuple[Any, ...]:
        return tuple(params.value(name) * math.radians(1) for name in names)

    if params.sector is not None:
        return SectorLaw(_course(params, math.radians(params.sector)), math.radians(params.sector))
    if params.law == "fourier":
        sines, cosines = (tuple(map(math.radians, params.value(name))) for name in ("sines", "cosines"))
        return FourierLaw(lobes, sines, cosines)
    if params.law == "window":
        return WindowLaw(lobes, params.value("window_ratio"), *angles("window", "blend"))
    if params.law == "table":
        nodes = params.nodes or ()
        return TableLaw(lobes, tuple((math.radians(one), math.radians(two)) for one, two in nodes))
    if params.law in FORMULAS:
        return FORMULAS[params.law](lobes, params.value(params.law))
    if params.law == "geneva":
        return IndexLaw(lobes, params.value("slots"), params.value("ramp"), *angles("window", "blend"))
    if params.law == "slider":
        return SliderLaw(lobes, params.value("rod_ratio"), *angles("stroke_start", "stroke_end", "window"))
    return PITCH_LAWS[params.law](lobes, params.value("eccentricity"), params.side)


@dataclass(frozen=True)
class LawRows(Rowwise, RatioLaw):
    """The laws of a table, one for each design; rates are (n, k) at angles (k,) or (n, k)."""

    laws: tuple[RatioLaw, ...]

    def rows(self, places: Rows, size: int) -> "LawRows":  # noqa: ARG002 - as of any rows
        """Those of some designs."""
        return LawRows(tuple(self.laws[place] for place in places.tolist()))

    def each(self, value: Callable[[RatioLaw], float]) -> Array:
        """A number (n, 1) of each law."""
        return np.array([[value(law)] for law in self.laws])

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Of each at its angles."""
        angles = np.broadcast_to(phi, (len(self.laws), np.shape(phi)[-1]))
        orders = zip(*(law.rates(own) for law, own in zip(self.laws, angles, strict=True)), strict=True)
        ratio, first, second = (np.stack(one) for one in orders)
        return ratio, first, second


def _course(params: NoncircularParams, travel: float) -> Course:
    if params.law == "ratio":
        return RatioCourse(params.value("ratio"))
    if params.law == "angle":
        return AngleCourse(params.value("angle"))
    if params.law == "spiral":
        return SpiralCourse(params.value("first_ratio"), params.value("last_ratio"), travel)
    return TableCourse(tuple((math.radians(one), math.radians(two)) for one, two in params.nodes or ()))


@dataclass(frozen=True)
class Extreme:
    """The least or greatest value of something over a lobe, and the angle φ, rad, where it is."""

    value: float
    angle: float


@dataclass(frozen=True)
class Extremes:
    """Of a law that can be run.

    Parameters
    ----------
    slowest, fastest
        Ratio.
    steepest
        Greatest size of the slope ν of the pitch curves, rad.
    curvatures
        Least curvature of driver and driven gear, for a centre distance of 1.
    sharpest
        Greatest curvature of both.
    """

    slowest: Extreme
    fastest: Extreme
    steepest: Extreme
    curvatures: tuple[Extreme, Extreme]
    sharpest: tuple[Extreme, Extreme]


def slowest_of(law: RatioLaw) -> Extreme:
    """The least ratio; the pair turns back where it is not above 0."""
    return least(law, lambda phi: law.rates(phi)[0])


def fastest_of(law: RatioLaw) -> Extreme:
    """The greatest ratio; a ring has no centre where it is not below 1."""
    return least(law, lambda phi: -law.rates(phi)[0], -1.0)


def extremes_of(params: NoncircularParams) -> Extremes:
    """Extremes of the pitch curves; the ratio has to be above 0, and of a ring below 1."""
    return _extremes(law_of(params), params.side, _beyond(params))


@kept
def _extremes(law: RatioLaw, side: int, beyond: float) -> Extremes:
    def slope(phi: Array) -> Array:
        return -np.abs(Rolling.of(law, phi, side).tilt)

    def of(name: str, sign: float) -> Extreme:
        return least(law, lambda phi: sign * getattr(Rolling.of(law, phi, side), name), sign, beyond)

    return Extremes(
        slowest_of(law),
        fastest_of(law),
        least(law, slope, -1.0),
        (of("curvature1", 1.0), of("curvature2", 1.0)),
        (of("curvature1", -1.0), of("curvature2", -1.0)),
    )


def _beyond(params: NoncircularParams) -> float:
    """Angle, rad, beyond the ends of a sector up to which its pitch curve makes teeth."""
    return ENDS * math.radians(params.sector) / params.teeth if params.sector else 0.0


def least(
    law: RatioLaw, function: Callable[[Array], Array], sign: float = 1.0, beyond: float = 0.0
) -> Extreme:
    """The least value of a function of φ over a lobe, refined, times ``sign``.

    Of sectors it is that over their travel and an angle, rad, beyond each end.
    """
    if law.travel is not None:
        return _least_between(-beyond, law.travel + beyond, function, sign)
    at = law.grid(GRID)[:-1]
    even = law.period * np.arange(GRID) / GRID
    found = peak(lambda turn: -function(turn / math.tau * law.period), math.tau * even / law.period)
    best = Extreme(sign * -found.value, found.angle / math.tau * law.period)
    values = function(at)
    worst = int(np.argmin(values))
    if values[worst] < sign * best.value:
        return Extreme(sign * float(values[worst]), float(at[worst]))
    return best


def _least_between(low: float, high: float, function: Callable[[Array], Array], sign: float) -> Extreme:
    """The least value between two angles, rad: of a grid, then of a finer one about the least of it."""
    for _ in range(_ROUNDS):
        at = np.linspace(low, high, GRID + 1)
        values = function(at)
        best = int(np.argmin(values))
        low, high = float(at[max(best - 1, 0)]), float(at[min(best + 1, GRID)])
    return Extreme(sign * float(values[best]), float(at[best]))
