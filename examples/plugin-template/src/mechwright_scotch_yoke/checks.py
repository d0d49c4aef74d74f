"""What a designer would object to, and the figures worth knowing."""

import math
from typing import TYPE_CHECKING

from mechwright import Finding, Severity, Stage, at_stage
from mechwright_scotch_yoke.plates import FILLET, GAP, yoke_mass

if TYPE_CHECKING:
    from mechwright_scotch_yoke.family import ScotchYokeParams

MIN_WEB = 2.0
"""Least wall between shaft bore and pin hole, mm: a thinner one spreads when the pin is pressed in."""
MAX_PRESSURE = 10.0
"""Pressure of the pin on the slot, MPa: usual for a slow greased slider on brass."""
MAX_BENDING = 250.0
"""Bending stress of the pin, MPa: a quarter of a hardened dowel pin's strength, since the load alternates."""


def peak_force(params: "ScotchYokeParams", omega: float) -> float:
    """Largest force between pin and slot, N: the load and, at the dead centres, the yoke's inertia m r ω²."""
    return params.load + yoke_mass(params) * params.crank_radius / 1000 * omega**2


def check(params: "ScotchYokeParams") -> list[Finding]:
    """All findings, errors first. The crank always turns: what can be wrong is about the parts."""
    found = at_stage(Stage.PARTS, [*_room(params), *_strength(params)])
    found.append(
        Finding(
            "scotch-yoke.lost-motion",
            Severity.NOTE,
            "clearance",
            f"the yoke stands still over {params.clearance:g} mm at every reversal of the load",
            value=params.clearance,
            unit="mm",
        )
    )
    return found


def _room(params: "ScotchYokeParams") -> list[Finding]:
    found = []
    bores = (params.pin_diameter + params.shaft_diameter) / 2
    web = params.crank_radius - bores
    if web < MIN_WEB:
        found.append(
            Finding(
                "scotch-yoke.crank-web",
                Severity.ERROR,
                "crank_radius",
                f"the wall between shaft and pin is {web:.3g} mm thick, the limit is {MIN_WEB:g} mm",
                value=web,
                limit=MIN_WEB,
                unit="mm",
                remedy=f"make it {bores + MIN_WEB:g} mm at least, or take a thinner pin or shaft",
                proposed=({"parameters.crank_radius": round(bores + MIN_WEB, 6)},),
            )
        )
    widest = 2 * (params.crank_radius - FILLET)
    if params.stem_width > widest:
        found.append(
            Finding(
                "scotch-yoke.stem-width",
                Severity.ERROR,
                "stem_width",
                f"a stem of {params.stem_width:g} mm and its fillets do not fit on the head",
                value=params.stem_width,
                limit=widest,
                unit="mm",
                remedy=f"use at most {widest:g} mm, or a larger crank_radius",
            )
        )
    return found


def _strength(params: "ScotchYokeParams") -> list[Finding]:
    found = []
    d, t = params.pin_diameter, params.yoke_thickness
    force = peak_force(params, params.speed * math.tau / 60)
    # The pin is a cantilever from the crank's face to the middle of the yoke: σ = 32 F l / (π d³).
    bending = 32 * force * (GAP + t / 2) / (math.pi * d**3)
    if bending > MAX_BENDING:
        needed = d * (bending / MAX_BENDING) ** (1 / 3)
        found.append(
            Finding(
                "scotch-yoke.pin-bending",
                Severity.ERROR,
                "pin_diameter",
                f"{force:.4g} N bend the pin with {bending:.4g} MPa, the limit is {MAX_BENDING:g} MPa",
                value=bending,
                limit=MAX_BENDING,
                unit="MPa",
                remedy=f"use about {needed:.3g} mm, or a lighter load or speed",
                proposed=({"parameters.pin_diameter": math.ceil(10 * needed) / 10},),
            )
        )
    pressure = force / (d * t)
    if pressure > MAX_PRESSURE:
        found.append(
            Finding(
                "scotch-yoke.slot-pressure",
                Severity.WARNING,
                "yoke_thickness",
                f"the pin presses on the slot with {pressure:.4g} MPa, the limit is {MAX_PRESSURE:g} MPa",
                value=pressure,
                limit=MAX_PRESSURE,
                unit="MPa",
                remedy=f"use {force / (d * MAX_PRESSURE):.3g} mm or more, or a thicker pin",
            )
        )
    return found
