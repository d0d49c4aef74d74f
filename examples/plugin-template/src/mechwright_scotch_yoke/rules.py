"""What a designer objects to, and a figure worth knowing. Numbers are columns in a table of designs."""

import numpy as np

from mechwright import DesignRule, DesignTable, Note, Severity, all_of
from mechwright_scotch_yoke.family import ScotchYokeParams
from mechwright_scotch_yoke.kinematics import peak_force
from mechwright_scotch_yoke.plates import FILLET, GAP

MIN_WEB = 2.0
"""Least wall between shaft bore and pin hole, mm: a thinner one spreads when the pin is pressed in."""
MAX_PRESSURE = 10.0
"""Pressure of the pin on the slot, MPa: allowed for a slow greased slider on brass."""
MAX_BENDING = 250.0
"""Bending stress of the pin, MPa: a quarter of a hardened dowel pin's strength, since the load alternates."""

Table = DesignTable[ScotchYokeParams]
Rule = DesignRule[Table]


def web(t: Table) -> float:
    """Wall between shaft and pin, mm."""
    return t.params.crank_radius - (t.params.pin_diameter + t.params.shaft_diameter) / 2


def bending(t: Table) -> float:
    """Stress of the pin, MPa, a cantilever from the crank's face to the middle of the yoke: 32 F l/(π d³)."""
    arm = GAP + t.params.yoke_thickness / 2
    return 32 * peak_force(t.params) * arm / (np.pi * t.params.pin_diameter**3)


def pressure(t: Table) -> float:
    """Of the pin on the slot, MPa."""
    return peak_force(t.params) / (t.params.pin_diameter * t.params.yoke_thickness)


def thicker_pin(bending: float, diameter: float) -> float:
    """Diameter of a pin, mm, in tenths, that is bent with no more than is allowed."""
    return float(np.ceil(10 * diameter * (bending / MAX_BENDING) ** (1 / 3)) / 10)


RULES = all_of(
    Rule(
        "scotch-yoke.crank-web",
        "crank_radius",
        "the wall between shaft and pin is {value:.3g} mm thick, the limit is {limit:g} mm",
        value=web,
        limit=MIN_WEB,
        unit="mm",
        remedy="make crank_radius larger, or take a thinner pin_diameter or shaft_diameter",
        proposed=lambda f: [{"parameters.crank_radius": f.m.params.crank_radius + f.limit - f.value}],
    ),
    Rule(
        "scotch-yoke.stem-width",
        "stem_width",
        "a stem of {value:g} mm and its fillets do not fit on the head",
        value=lambda t: t.params.stem_width,
        limit=lambda t: 2 * (t.params.crank_radius - FILLET),
        unit="mm",
        must_be="at most",
        remedy="make stem_width at most {limit:g}, or crank_radius larger",
    ),
    Rule(
        "scotch-yoke.pin-bending",
        "pin_diameter",
        "the load bends the pin with {value:.4g} MPa, the limit is {limit:g} MPa",
        value=bending,
        limit=MAX_BENDING,
        unit="MPa",
        must_be="at most",
        remedy="make pin_diameter larger, or load or speed smaller",
        proposed=lambda f: [{"parameters.pin_diameter": thicker_pin(f.value, f.m.params.pin_diameter)}],
    ),
    Rule(
        "scotch-yoke.slot-pressure",
        "yoke_thickness",
        "the pin presses on the slot with {value:.4g} MPa, the limit is {limit:g} MPa",
        value=pressure,
        limit=MAX_PRESSURE,
        unit="MPa",
        must_be="at most",
        severity=Severity.WARNING,
        remedy="make yoke_thickness or pin_diameter larger",
    ),
    Note[Table](
        "scotch-yoke.lost-motion",
        "the yoke stands still over {value:g} mm at every reversal of the load",
        lambda t: t.params.clearance,
        "mm",
    ),
)
