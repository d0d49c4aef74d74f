"""Rules of the bodies: driver, locking disc, horns, hub, dowels, pins."""

import math
from typing import Any

import numpy as np

from mechwright import GeometryError
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import by_row
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.laws import LAWS
from mechwright.mechanics.opening_rules import keyway_rules, size_rules
from mechwright_geneva.kinematics.mechanism import BLOCK, LEAST_BITE, Mechanism
from mechwright_geneva.parts.counterbore import counterbore_findings
from mechwright_geneva.parts.crank_outline import boss_radius
from mechwright_geneva.parts.dowels import greatest_island_dowel, island_places, web_place
from mechwright_geneva.parts.locking_disc import drawn, lock_loop
from mechwright_geneva.parts.openings import needed_radius
from mechwright_geneva.rules.slots import LOOSE_ISLANDS, NO_ISLANDS, rounded_down

SIZING = ("entry_radius", "centre_distance", "crank_half_angle", "offset_angle")
"""Keys that say how much room the driver has."""

ROLLER_WALL = 0.1
"""Least wall of a roller about its pin, in roller radii: what the smallest needle rollers have."""

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]


def _wall(m: Mechanism) -> float:
    return m.params.least_wall


def _ring(m: Mechanism) -> Any:
    """Width of a ring about an opening, mm, that walls and dowels need."""
    return needed_radius(0.0, m.params.least_wall, m.params.fixing)


def _driver_room(f: Fails) -> float:
    return f.m.driver_radius - f.m.driver_opening


def _driver_key(f: Fails) -> str:
    params, left_out = f.m.params, f.m.params.left_out
    bored = params.fixing == 0 or _driver_room(f) < params.least_wall
    blame = "driver_bore" if bored else "fixing"
    given = [key for key in SIZING if key not in left_out]
    return given[0] if blame in left_out and given else blame


def _driver_remedy(f: Fails) -> str:
    params, room = f.m.params, _driver_room(f)
    cures, dowel = [], room - 2 * params.least_wall
    if params.fixing > 0 and dowel >= 1:
        cures.append(f"make fixing at most {math.floor(dowel * 10) / 10:g}")
    elif params.fixing > 0 and room >= params.least_wall:
        cures.append("set fixing to 0")
    bore = 2 * (f.m.driver_radius - float(_ring(f.m)))
    if bore >= 1 and params.driver_keyway_width == 0 and "driver_bore" not in params.left_out:
        cures.append(f"make driver_bore at most {math.floor(bore * 10) / 10:g}")
    return ", or ".join(cures)


DRIVER = Rule(
    "geneva.driver",
    _driver_key,
    lambda f: (
        f"the relief leaves {max(0.0, f.m.driver_radius):.3f} mm of the locking disc about the crank's "
        f"axis: with an opening that reaches {f.m.driver_opening:.3f} mm, {_driver_room(f):.3f} mm stay for "
        "walls and dowels"
    ),
    value=lambda m: m.driver_radius,
    limit=lambda m: m.needed_driver_radius,
    unit="mm",
    remedy=_driver_remedy,
    reported=lambda f: (_driver_room(f), float(_ring(f.m))),
)


def _overhang(m: Mechanism) -> float:
    """How far the crank passes over the wheel's bore, mm."""
    return m.crank + boss_radius(m) - (m.axes - m.opening)


SHAFT = Note(
    "geneva.shaft",
    lambda m: (
        f"the crank passes {_overhang(m):.2f} mm over the wheel's bore: its shaft ends below "
        f"{m.params.thickness + m.params.axial_gap:g} mm"
    ),
    _overhang,
    "mm",
    when=lambda m: _overhang(m) > 0,
)
LOCK_ROOM = Rule(
    "geneva.lock",
    lambda f: "lock_radius" if f.m.params.lock_radius else "least_wall",
    lambda f: (
        f"a locking disc needs {f.limit:.3f} mm to reach {LEAST_BITE:g} mm into the wheel, and at most "
        f"{f.value:.3f} mm leave horns of {f.m.params.least_wall:g} mm beside the slots"
    ),
    value=lambda m: m.most_lock,
    limit=lambda m: m.least_lock,
    unit="mm",
)
HORN = Rule(
    "geneva.horn",
    "lock_radius",
    "the horns between concave arcs and slots are {value:.3f} mm thick",
    value=lambda m: m.nearest - m.groove - m.arc,
    limit=_wall,
    unit="mm",
    remedy=lambda f: f"make lock_radius at most {rounded_down(f.m.greatest_lock)}, or leave it out",
)
LOCK_REACH = Rule(
    "geneva.lock",
    "lock_radius",
    lambda f: (
        f"a locking disc of {f.value:g} mm reaches {f.value - f.m.axes + f.m.rim:.3f} mm into the wheel"
    ),
    value=lambda m: m.lock,
    limit=lambda m: m.least_lock,
    unit="mm",
    remedy=lambda f: f"make lock_radius at least {math.ceil(f.limit * 100) / 100:g}, or leave it out",
)
RIM = Rule(
    "geneva.horn",
    "lock_radius",
    "neighbouring concave arcs leave no rim between them",
    value=lambda m: (m.wheel_half - m.horn_angle) * m.rim,
    limit=lambda m: m.params.least_wall / 2,
    unit="mm",
    remedy=lambda f: "leave lock_radius out" if f.m.params.lock_radius else "",
    reported=lambda f: (2 * f.value, f.m.params.least_wall),
)


def _lock_fault(m: Mechanism) -> str:
    """Why the locking disc cannot be drawn; empty if it can."""
    try:
        lock_loop(m)
    except GeometryError as error:
        return str(error)
    return ""


def _drawn(m: Mechanism) -> Any:
    """1 where the disc surely can be drawn, -1 where not; of other laws only drawing tells it, 0."""
    if not m.straight and m.given.law not in LAWS:
        return 0
    return m.once("drawn", lambda: m.each(drawn, BLOCK)[:, None])


LOCK_LOOP = Rule(
    "geneva.lock",
    "lock_radius",
    lambda f: f"no locking disc: {_lock_fault(f.m)}",
    value=by_row(lambda m: not _lock_fault(m)),
    limit=1,
    unit="mm",
    remedy=lambda f: (
        ""
        if f.m.greatest_lock >= f.m.lock
        else f"make lock_radius at most {rounded_down(f.m.greatest_lock)}, or leave it out"
    ),
    best=lambda m: _drawn(m) >= 0,
    worst=lambda m: _drawn(m) > 0,
    reported=lambda f: (f.m.lock, f.m.greatest_lock),
)
HUB_ROOM = Rule(
    "geneva.hub",
    lambda f: "bore" if f.m.params.hub_diameter / 2 <= f.m.opening else "hub_diameter",
    "{value:.3f} mm stay between hub or bore and the concave arcs",
    value=lambda m: m.axes - m.arc - m.hub,
    limit=_wall,
    unit="mm",
    remedy="make bore and hub smaller, or lock_radius smaller",
)
HUB_RING = Rule(
    "geneva.hub",
    "hub_diameter",
    "the hub plate is a ring of {value:.3f} mm; its dowels and walls need {limit:.3f} mm",
    value=lambda m: m.params.hub_diameter / 2 - m.opening,
    limit=_ring,
    unit="mm",
    remedy=lambda f: (
        "make hub_diameter at least "
        f"{math.ceil((f.m.params.hub_diameter + 2 * (f.limit - f.value)) * 10) / 10:g}, or 0 for none"
    ),
    when=lambda m: np.asarray(m.params.hub_diameter) > 0,
)
ISLAND_DOWELS = Rule(
    "geneva.fixing",
    "fixing",
    lambda f: f"an island has no room for two dowels of {f.m.params.fixing:g} mm",
    value=by_row(lambda m: len(island_places(m, m.params.fixing))),
    limit=2,
    unit="mm",
    remedy=lambda f: (
        f"make fixing at most {most:g}"
        if (most := greatest_island_dowel(f.m))
        else 'make least_wall smaller, or use construction = "blind"'
    ),
    reported=lambda f: (f.m.params.fixing, greatest_island_dowel(f.m)),
)
WEB_DOWELS = Rule(
    "geneva.fixing",
    "fixing",
    lambda f: f"the webs between slots have no room for dowels of {f.m.params.fixing:g} mm",
    value=by_row(lambda m: web_place(m)[1]),
    limit=lambda m: m.params.fixing / 2 + m.params.least_wall,
    unit="mm",
    remedy=lambda f: (
        f"make fixing at most {max(0.0, math.floor(20 * (f.value - f.m.params.least_wall)) / 10):g}"
    ),
    reported=lambda f: (f.m.params.fixing, max(0.0, 2 * (f.value - f.m.params.least_wall))),
)
PIN = Rule(
    "geneva.pin",
    "pin_diameter",
    lambda f: f"a pin of {f.value:g} mm leaves nothing of a roller of {2 * f.m.roller:g} mm",
    value=lambda m: m.params.pin_diameter,
    limit=lambda m: 2 * m.roller * (1 - ROLLER_WALL),
    unit="mm",
    remedy=lambda f: f"make pin_diameter at most {rounded_down(f.limit)}",
    must_be="at most",
)
DISC = Rule(
    "geneva.disc",
    "disc_thickness",
    lambda f: (
        f"a locking disc of {f.value:g} mm locks less than half of a wheel of {f.m.params.thickness:g} mm"
    ),
    value=lambda m: m.params.disc_thickness,
    limit=lambda m: m.params.axial_gap + np.asarray(m.params.thickness) / 2,
    unit="mm",
    remedy=lambda f: f"make disc_thickness at least {math.ceil(10 * f.limit - 1e-6) / 10:g}, or leave it out",
)


def _has_dowels(m: Mechanism) -> Any:
    return np.asarray(m.params.fixing) > 0


BODY = in_turn(
    all_of(
        LOOSE_ISLANDS,
        NO_ISLANDS,
        keyway_rules("bore", "keyway_width", "keyway_relief"),
        keyway_rules("driver_bore", "driver_keyway_width", "keyway_relief"),
        *size_rules("keyway_relief", "fixing"),
    ),
    all_of(DRIVER, SHAFT),
    all_of(
        in_turn(LOCK_ROOM, HORN, LOCK_REACH, RIM, LOCK_LOOP),
        HUB_ROOM,
        HUB_RING,
        all_of(
            ISLAND_DOWELS.but(when=_has_dowels),
            WEB_DOWELS.but(when=_has_dowels),
            when=lambda m: m.given.slots_made == "backed",
        ),
        PIN,
        DISC,
        Procedure[Mechanism](
            ("geneva.counterbore",),
            counterbore_findings,
            when=lambda m: np.asarray(m.params.counterbore_diameter) > 0,
        ),
    ),
)
"""Of all bodies, in order."""
