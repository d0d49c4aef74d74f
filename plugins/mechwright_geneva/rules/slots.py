"""Rules of the slots: bottom, mouths, undercut, loop, island, web.

Glossary
--------
tip, neck
    Of an island: its sharp end at the slot's bottom, and its narrowest place towards the mouths.
web
    Between neighbouring slots.
"""

import math
from typing import Any

import numpy as np

from mechwright.contracts.design_rule import DesignRule, Failure, no_figures
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright_geneva.kinematics.mechanism import BLOCK, Mechanism
from mechwright_geneva.kinematics.slot_limits import FINE_SAMPLES, LEAST_TIP, sharpest_bend

LEAST_ROLLER = 0.5
"""Smallest roller radius of the design table, mm."""

REGIMES = {-1: "A", 1: "B"}

SURE = 1e-9
"""Share by which a wall is undercut beyond rounding."""

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]


def rounded_down(length: float) -> str:
    """A length in hundredths, not rounded up."""
    return f"{math.floor(length * 100) / 100:g}"


def _roller_at_bottom(f: Fails) -> float:
    return f.m.bottom - f.limit - f.m.params.groove_clearance / 2


def _smaller_roller(f: Fails) -> str:
    most, given = _roller_at_bottom(f), "roller_radius" not in f.m.params.left_out
    return f"make roller_radius at most {rounded_down(most)}" if given and most >= LEAST_ROLLER else ""


def _web_message(f: Fails) -> str:
    return "neighbouring slots run into each other" if f.value <= 0 else "the web between slots is too thin"


def _narrower_slot(f: Fails) -> str:
    clearance = f.m.params.groove_clearance
    most = f.m.bottom * math.sin(f.m.wheel_half) - (f.limit + clearance) / 2
    return f"make roller_radius at most {rounded_down(most)}" if most >= LEAST_ROLLER else ""


def speed_ratio(m: Mechanism) -> Any:
    """θw' at mid stroke: how much faster than the crank the wheel turns."""
    return m.wheel_half / m.crank_half * float(m.law.at(0.5).v)


def _sign_message(f: Fails) -> str:
    side, regime = f.m.side, REGIMES.get(f.m.side)
    return (
        f"the wheel turns {speed_ratio(f.m):.4g} times as fast as the crank at mid stroke, b/(a - b) is "
        f"{float(f.m.frame.turning_ratio):.4g}: in this regime {regime or '(a cusp)'} the two ways "
        f"of a slot cross unless the offset angle is {'above 0' if side <= 0 else 'below 0'}"
    )


def _mouth(m: Mechanism) -> Any:
    """Half the island's width between its mouths."""
    half = m.wheel_half + m.crank_half
    return -m.side * m.rim * np.sin(m.frame.offset) - m.groove * np.sin(half)


def _least_offset(f: Fails) -> tuple[float, float]:
    """The offset angle and that at which the two mouths touch, degrees: sin θoff = (r/l) sin(θw0 + θd0)."""
    sine = f.m.groove / f.m.rim * math.sin(f.m.wheel_half + f.m.crank_half)
    return math.degrees(abs(f.m.frame.offset)), math.degrees(math.asin(min(1.0, sine)))


def _critical_radii(m: Mechanism) -> Any:
    """(n, 2) of the island's wall and of the hub's."""
    return np.concatenate((m.measures.island_limit, m.measures.hub_limit), axis=1)


def _critical_radius_at_best(m: Mechanism) -> Any:
    """That of some samples; few samples of half a stroke cost no more than these."""
    if m.samples < FINE_SAMPLES:
        return np.inf
    return (1 + SURE) / m.each(lambda some: sharpest_bend(some.frame.columns(some.size), some.law), BLOCK)


def _undercut_message(f: Fails) -> str:
    side = ("island's", "hub's")[f.item]
    return (
        f"the wall on the {side} side is undercut: its way is curved more sharply than the roller, "
        f"whose critical radius M b is {f.value:.4f} mm with M = {f.value / f.m.crank:.6f}"
    )


BOTTOM = Rule(
    "geneva.slot-bottom",
    "roller_radius",
    "the slots come within {value:.3f} mm of the wheel's axis; hub and wall need {limit:.3f} mm",
    value=lambda m: m.bottom - m.groove,
    limit=lambda m: m.hub + m.params.least_wall,
    unit="mm",
    remedy=_smaller_roller,
    reported=lambda f: (f.m.roller, _roller_at_bottom(f)),
)
STRAIGHT_WEB = Rule(
    "geneva.web",
    "roller_radius",
    _web_message,
    value=lambda m: 2 * (m.bottom * np.sin(m.wheel_half) - m.groove),
    limit=lambda m: m.params.least_wall,
    unit="mm",
    remedy=_narrower_slot,
)
OFFSET_SIGN = Rule(
    "geneva.offset-sign",
    "offset_angle",
    _sign_message,
    value=lambda m: -np.sign(m.frame.offset) * m.side,
    limit=0.0,
    unit="deg",
    must_be="above",
    reported=lambda f: (math.degrees(f.m.frame.offset), 0.0),
)
MOUTH = Rule(
    "geneva.mouth",
    "offset_angle",
    "the two mouths of a slot overlap",
    value=_mouth,
    limit=0.0,
    unit="deg",
    must_be="above",
    reported=_least_offset,
)
UNDERCUT = Rule(
    "geneva.undercut",
    "roller_radius",
    _undercut_message,
    value=_critical_radii,
    limit=lambda m: m.groove,
    unit="mm",
    must_be="above",
    reported=lambda f: (f.m.roller, f.value - f.m.params.groove_clearance / 2),
    best=_critical_radius_at_best,
    each=False,
)
LOOP = Rule(
    "geneva.loop",
    "offset_angle",
    "the island's wall crosses itself in a loop: the roller's ways in and out are too close together",
    value=lambda m: 2 * m.measures.width,
    limit=0.0,
    unit="mm",
    must_be="above",
)
TIP = Rule(
    "geneva.island-tip",
    "roller_radius",
    "the island's tip has a radius of {value:.3f} mm",
    value=lambda m: m.measures.island_limit - m.groove,
    limit=LEAST_TIP,
    unit="mm",
)
NECK = Rule(
    "geneva.island",
    "offset_angle",
    "the island is {value:.3f} mm wide at its neck",
    value=lambda m: 2 * m.measures.neck,
    limit=lambda m: m.params.least_wall,
    unit="mm",
)
WEB = Rule(
    "geneva.web",
    "roller_radius",
    _web_message,
    value=lambda m: m.measures.web,
    limit=lambda m: m.params.least_wall,
    unit="mm",
)
LOOSE_ISLANDS = Rule(
    "geneva.islands-loose",
    "construction",
    "slots that are cut through set their islands free: {m.slots} pieces fall out of the wheel",
    value=lambda m: m.params.slots_made == "through",
    limit=0,
    must_be="at most",
    remedy='use construction = "blind" for grooves with a floor, or "backed" for islands on a plate',
    reported=no_figures,
    when=lambda m: not m.straight,
)
NO_ISLANDS = Rule(
    "geneva.islands-loose",
    "construction",
    "straight slots have no islands that a backing plate could carry",
    value=lambda m: m.params.slots_made == "backed",
    limit=0,
    must_be="at most",
    remedy='use construction = "through" or "blind"',
    reported=no_figures,
    when=lambda m: m.straight,
)

CURVED = in_turn(OFFSET_SIGN, MOUTH, UNDERCUT, LOOP, all_of(TIP, NECK, WEB), when=lambda m: not m.straight)
"""Of curved slots."""

SLOTS = in_turn(BOTTOM, all_of(STRAIGHT_WEB, when=lambda m: m.straight), CURVED)
"""Of all slots, in order."""
