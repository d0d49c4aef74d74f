"""Whether a formula is a law: finite everywhere, without a corner, and back where it began after a lobe."""

import math
from typing import Protocol

import numpy as np

from mechwright import Array, Finding, GeometryError, kept
from mechwright_noncircular_gears.kinematics.law import LEAST_RATIO
from mechwright_noncircular_gears.kinematics.laws.formula import AngleFormula, RatioFormula, WrittenLaw

CLOSED = 1e-9
"""Share of the mean ratio by which both ends of a lobe may differ: rounding of a formula that closes."""

JUMP = 1e-6
"""Share of the greatest ratio by which ratio or slope may change within rounding of a place."""

_HALVINGS = 36
"""From a step of the grid to 1e-13 of a turn."""

GRID = 2881
"""Places of a lobe at which a formula has to be finite."""


FORMULA_CODES = ("law.formula", "law.closure", "law.corner", "law.turns-back")
"""Codes of what is found of a formula."""


@kept
def formula_finding(key: str, law: RatioFormula | AngleFormula) -> Finding | None:
    """What keeps a formula from being a law; None where nothing does."""
    phi = law.grid(GRID)
    wrong = finite_finding(key, law, phi, "lobe")
    if wrong is not None:
        return wrong
    if isinstance(law, AngleFormula):
        return _closure(key, law) or _closing(key, law) or corner_finding(key, law, phi)
    corner = _closing(key, law) or corner_finding(key, law, phi)
    return corner or _positive(key, law, phi) or _bounded(key, law)


class Shaped(Protocol):
    """What has a ratio as it is written."""

    def shape(self, phi: Array) -> tuple[Array, Array, Array]:
        """The ratio and its derivatives at φ (...)."""


def finite_finding(key: str, law: Shaped, phi: Array, whole: str) -> Finding | None:
    """An error at the first of angles φ (n,), rad, where a formula has no value; ``whole`` is their way."""
    finite = np.all([np.isfinite(one) for one in law.shape(phi)], axis=0)
    if finite.all():
        return None
    at = math.degrees(float(phi[~finite][0]))
    return Finding.error(
        "law.formula",
        key,
        f"the formula has no value, or no slope, at {at:.1f} degrees of the driver",
        at,
        unit="deg",
        remedy=f"write one that is smooth over the whole {whole}, or give a table",
    )


def _closure(key: str, law: AngleFormula) -> Finding | None:
    wanted = math.tau / law.lobes[1]
    if abs(law.turned - wanted) <= CLOSED * wanted:
        return None
    lacking = (wanted - law.turned) / law.period
    sign = "+" if lacking > 0 else "-"
    return Finding.error(
        "law.closure",
        key,
        f"over a lobe of the driver, {math.degrees(law.period):g} degrees, the formula turns the driven gear "
        f"by {math.degrees(law.turned):.6g} degrees, and its lobe has {math.degrees(wanted):g}",
        math.degrees(law.turned),
        math.degrees(wanted),
        "deg",
        f"add {lacking:.6g}*phi to it, or write the law as a ratio, which is scaled to close",
        proposed=({f"parameters.{key}": f"{law.text} {sign} {abs(lacking):.13g}*phi"},),
    )


def _positive(key: str, law: RatioFormula, phi: Array) -> Finding | None:
    values = law.shape(phi)[0]
    worst = int(np.argmin(values))
    least = float(values[worst])
    if least > 0:
        return None
    # The constant with which the least ratio is LEAST_RATIO of the mean one, upwards to four digits.
    lacking = (LEAST_RATIO * float(values.mean()) - least) / (1 - LEAST_RATIO)
    step = 10.0 ** (math.floor(math.log10(abs(lacking) or 1.0)) - 3)
    better = f"{law.text} + {math.ceil(lacking / step + 1) * step:.6g}"
    return Finding.error(
        "law.turns-back",
        key,
        f"the formula is {least:.4g} at {math.degrees(float(phi[worst])):.1f} degrees of the driver, and a "
        "ratio is above 0: teeth only push on",
        least,
        0.0,
        remedy=f'the nearest that turns on is {key} = "{better}"',
        proposed=({f"parameters.{key}": better},),
    )


def _bounded(key: str, law: RatioFormula) -> Finding | None:
    try:
        _ = law.factor
    except GeometryError:
        return Finding.error(
            "law.formula",
            key,
            "the formula has no bound, or swings too often for teeth",
            remedy="write one that is smooth over the whole lobe, or give a table",
        )
    return None


ORDERS = ("ratio", "slope of the ratio")
"""Both have to be continuous."""


def _closing(key: str, law: WrittenLaw) -> Finding | None:
    """An error where ratio or slope is another one at the end of a lobe."""
    size = np.abs(law.shape(law.grid(GRID))[0]).max()
    ends = law.shape(np.array([0.0, law.period]))
    wave = "cos(phi)" if law.lobes[0] == 1 else f"cos({law.lobes[0]}*phi)"
    for what, (begin, end) in zip(ORDERS, ends, strict=False):
        if abs(end - begin) > CLOSED * size:
            where = f"is {begin:.9g} where a lobe begins and {end:.9g} where it ends"
            remedy = f"use terms of period {math.degrees(law.period):g} degrees, such as {wave}"
            return _cornered(key, what, where, float(begin), float(end), remedy)
    return None


def corner_finding(key: str, law: Shaped, phi: Array) -> Finding | None:
    """An error where ratio or slope jumps between some angles φ (n,), rad, in rising order."""
    size = np.abs(law.shape(phi)[0]).max()
    for order, what in enumerate(ORDERS):
        at, begin, end = _widest_step(law, phi, order)
        if abs(end - begin) > JUMP * size:
            where = f"jumps from {begin:.6g} to {end:.6g} at {math.degrees(at):.1f} degrees of the driver"
            remedy = "write one that is smooth all the way, or give a table"
            return _cornered(key, what, where, begin, end, remedy)
    return None


def _cornered(key: str, what: str, where: str, begin: float, end: float, remedy: str) -> Finding:
    message = f"the {what} {where}: the pitch curves have a corner there"
    return Finding.error("law.corner", key, message, end, begin, remedy=remedy)


def _widest_step(law: Shaped, phi: Array, order: int) -> tuple[float, float, float]:
    """Where ratio or slope changes most within rounding of a place, and from what to what."""
    low, high = phi[:-1], phi[1:]
    before, after = law.shape(low)[order], law.shape(high)[order]
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        value = law.shape(middle)[order]
        first = ~(np.abs(value - before) < np.abs(after - value))  # what is not finite counts as a step
        low, before = np.where(first, low, middle), np.where(first, before, value)
        high, after = np.where(first, middle, high), np.where(first, value, after)
    step = np.nan_to_num(np.abs(after - before), nan=np.inf)
    widest = int(np.argmax(step))
    return float(low[widest]), float(before[widest]), float(after[widest])
