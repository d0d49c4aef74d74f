"""Whether a law can be run: the driven gear has to turn on all the way."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Finding, Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import by_design, in_turn
from mechwright_noncircular_gears.kinematics.law import LEAST_RATIO, Extreme, fastest_of, slowest_of
from mechwright_noncircular_gears.kinematics.laws.formula import AngleFormula, RatioFormula
from mechwright_noncircular_gears.kinematics.laws.sector import SectorLaw
from mechwright_noncircular_gears.kinematics.laws.window import WindowLaw
from mechwright_noncircular_gears.rules.formula_rules import FORMULA_CODES, formula_finding
from mechwright_noncircular_gears.rules.sector_rules import SECTOR_CODES, sector_law_finding
from mechwright_noncircular_gears.table import GearTable

MOST_RING_RATIO = 0.95
"""Of a ring and the gear in it: pitch radii r = a i/(1 - i) have no bound towards 1."""

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def _window(m: GearTable) -> WindowLaw:
    law = m.law
    assert isinstance(law, WindowLaw)  # noqa: S101 - of a window
    return law


def _taken(m: GearTable) -> Any:
    return _window(m).width + 2 * _window(m).blend


def _greatest_blend(f: Fails) -> int:
    return math.floor(math.degrees(f.limit - _window(f.m).width) / 2 * 0.98)


def _shorter_blend(f: Fails) -> Iterator[Change]:
    if _greatest_blend(f) > 0:
        yield {"parameters.blend": _greatest_blend(f)}


WINDOW = Rule(
    "law.window",
    "blend",
    lambda f: (
        f"the window and its blends take {math.degrees(f.value):g} degrees, and a lobe of the driver has "
        f"{math.degrees(f.limit):g}"
    ),
    value=_taken,
    limit=lambda m: _window(m).period,
    unit="deg",
    remedy=lambda f: (
        f"make blend {most}, or window smaller" if (most := _greatest_blend(f)) > 0 else "make window smaller"
    ),
    must_be="below",
    stage=Stage.MOTION,
    when=lambda m: m.given.law == "window",
    reported=lambda f: (math.degrees(f.value), math.degrees(f.limit)),
    proposed=_shorter_blend,
)


def _formula(m: GearTable) -> Iterator[Finding]:
    law = m.law
    if isinstance(law, RatioFormula | AngleFormula) and (found := formula_finding(m.given.law, law)):
        yield found


def _sector(m: GearTable) -> Iterator[Finding]:
    law = m.law
    if isinstance(law, SectorLaw) and (found := sector_law_finding(m.given, law)):
        yield found


def _fastest(f: Fails) -> Extreme:
    return fastest_of(f.m.law)


RING = Rule(
    "law.ring",
    "law",
    lambda f: (
        f"the ring turns {_fastest(f).value:.4g} times as fast as the gear in it at "
        f"{math.degrees(_fastest(f).angle):.1f} degrees of the driver, and no ring catches up: its ratio is "
        f"to stay below {MOST_RING_RATIO:g}"
    ),
    value=lambda m: np.nan_to_num(m.fastest, nan=np.inf),
    limit=MOST_RING_RATIO,
    remedy="draw the law nearer to a constant ratio",
    must_be="below",
    stage=Stage.MOTION,
    when=lambda m: m.given.internal,
    reported=lambda f: (_fastest(f).value, MOST_RING_RATIO),
)


def _slowest(f: Fails) -> Extreme:
    return slowest_of(f.m.law)


def _wider(f: Fails) -> str:
    if f.m.given.law == "slider":
        return "make the window of the stroke smaller, or the stroke shorter"
    if f.m.given.law == "geneva":
        return "make the window of the index wider, or ramp larger"
    return "draw the law nearer to a constant ratio"


TURNS_BACK = Rule(
    "law.turns-back",
    "law",
    lambda f: (
        f"the driven gear stands or turns back at {math.degrees(_slowest(f).angle):.1f} degrees of the "
        f"driver, where its ratio is {_slowest(f).value:.4g}: teeth only push on"
    ),
    value=lambda m: np.nan_to_num(m.slowest, nan=-np.inf),
    limit=lambda m: LEAST_RATIO * m.given.lobes / m.given.mate_lobes,
    remedy=_wider,
    must_be="above",
    stage=Stage.MOTION,
    reported=lambda f: (_slowest(f).value, 0.0),
)

LAW = in_turn(
    WINDOW,
    in_turn(
        by_design(Procedure[GearTable](FORMULA_CODES, _formula)),
        when=lambda m: m.given.law in {"ratio", "angle"} and m.given.sector is None,
    ),
    in_turn(
        by_design(Procedure[GearTable](SECTOR_CODES, _sector)), when=lambda m: m.given.sector is not None
    ),
    RING,
    TURNS_BACK,
)
"""Room for the blends of a window, a smooth formula, a ratio above 0, and below 1 in a ring."""
