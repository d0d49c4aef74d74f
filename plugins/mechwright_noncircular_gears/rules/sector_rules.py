"""Whether a law over less than a turn can be run, and whether the blanks of both sectors hold their teeth."""

import math
from collections.abc import Callable

import numpy as np

from mechwright import Array, Finding
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import in_turn
from mechwright.mechanics.gearing import Rolling, SectorTeeth
from mechwright.tolerances import exceeds
from mechwright_noncircular_gears.fields import MOST_SECTOR
from mechwright_noncircular_gears.kinematics.laws.sector import SectorLaw
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.rules.formula_rules import GRID, corner_finding, finite_finding
from mechwright_noncircular_gears.table import GearTable, table_of

LEAST_GAP = 5.0
"""Degrees that stay of a turn between both ends of a sector: an end mill comes in, and the blank is seen."""

HUB_CLEARANCE = 0.25
"""Modules between the hub and the roots: tips of the mate run a quarter of a module above those."""


SECTOR_CODES = ("law.formula", "law.corner", "law.sector")
"""Codes of what is found of the law of sectors."""

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def sector_law_finding(params: NoncircularParams, law: SectorLaw) -> Finding | None:
    """What keeps a formula from being the law of sectors, or a travel of the driven gear of too much."""
    if params.law in {"ratio", "angle"}:
        phi = law.grid(GRID)
        wrong = finite_finding(params.law, law, phi, "travel")
        wrong = wrong or corner_finding(params.law, law, phi)
        if wrong is not None:
            return wrong
    turned = math.degrees(law.turned)
    if not exceeds(turned, MOST_SECTOR):
        return None
    shorter = _travel(law, math.radians(MOST_SECTOR))
    changes = () if params.law == "table" else ({"parameters.sector": shorter},)
    return Finding.error(
        "law.sector",
        "sector",
        f"the driven gear turns by {turned:.4g} degrees over the travel, and at most {MOST_SECTOR:g} are "
        "left to it: of more than a turn it is no plane gear, for its own body stands in the way of its mate",
        turned,
        MOST_SECTOR,
        "deg",
        f"make sector at most {shorter:g}",
        proposed=changes,
    )


def _travel(law: SectorLaw, most: float) -> float:
    """The longest travel, whole degrees, over which the driven gear turns by so much, rad, at most."""
    low, high = 0.0, law.end
    for _ in range(20):
        middle = (low + high) / 2
        if SectorLaw(law.course, middle).turned > most:
            high = middle
        else:
            low = middle
    return float(math.floor(math.degrees(low)))


def _extents(m: GearTable) -> Array:
    return np.degrees([one.extent for one in m.sectors])


def _spread(f: Fails) -> int | None:
    return _more(f.m.given, lambda found: math.degrees(found.extent) <= 360 - LEAST_GAP)


EXTENT = Rule(
    "sector.extent",
    "sector",
    lambda f: (
        f"gear {f.item + 1} with the teeth beyond its ends reaches over {f.value:.1f} "
        f"degrees, and {LEAST_GAP:g} of a turn stay free"
    ),
    value=_extents,
    limit=360 - LEAST_GAP,
    unit="deg",
    remedy=lambda f: (
        "make sector smaller" if (more := _spread(f)) is None else f"use {more} teeth, or make sector smaller"
    ),
    must_be="at most",
    proposed=lambda f: () if (more := _spread(f)) is None else ({"parameters.teeth": more},),
    each=False,
)


def _hub_room(m: GearTable) -> Array:
    return np.array([one.least_root - HUB_CLEARANCE * one.rack.module for one in m.sectors])


def _hub(f: Fails) -> float:
    return math.floor(2 * f.limit * 10) / 10


HUB = Rule(
    "sector.hub",
    "sector_hub",
    lambda f: (
        f"the hub of gear {f.item + 1} has a radius of {f.value:.3f} mm, and its nearest "
        f"root lies {f.m.sectors[f.item].least_root:.3f} mm from the axis: tips of the mate would run into it"
    ),
    value=lambda m: np.array([one.hub for one in m.sectors]),
    limit=_hub_room,
    unit="mm",
    remedy=lambda f: (
        f"make sector_hub at most {_hub(f):g}, or the gear larger"
        if _hub(f) >= f.m.given.bore
        else "make the gear larger"
    ),
    must_be="at most",
    reported=lambda f: (2 * f.value, 2 * f.limit),
    proposed=lambda f: ({"parameters.sector_hub": _hub(f)},) if _hub(f) > f.m.given.bore + 2 else (),
    each=False,
)


def _least_hub(f: Fails) -> int:
    return math.ceil(f.m.given.bore + 2 * f.m.rack.module)


HUB_WALL = Rule(
    "sector.hub",
    "sector_hub",
    "{value:.2f} modules of the hubs stay around their bores, below 1",
    value=lambda m: (m.sectors[0].hub - m.given.bore / 2) / m.sectors[0].rack.module,
    limit=1.0,
    remedy=lambda f: f"make sector_hub at least {_least_hub(f)}",
    proposed=lambda f: ({"parameters.sector_hub": float(_least_hub(f))},),
)
SECTORS = in_turn(EXTENT, HUB, HUB_WALL, when=lambda m: m.given.sector is not None)
"""Whether a sector with its last teeth reaches all round, and its hub leaves its roots and its bore alone."""


def _beyond(m: GearTable) -> Array:
    """How far, degrees, sectors may pass both ends of their travel: half a pitch."""
    ends = np.array([0.0, math.radians(m.given.sector or 0.0)])
    rate = m.pair.distance * Rolling.of(m.law, ends, m.given.side).speed
    return np.degrees(m.pair.pitch(m.given.teeth) / 2 / rate)


def _stops(m: GearTable) -> str:
    one, two = _beyond(m)
    return (
        f"no stops are made at the ends of the travel, 0 and {m.given.sector:g} degrees of gear 1: what "
        f"swings it keeps to them, or stops that let it pass them by less than {one:.1f} and {two:.1f} "
        "degrees, half a pitch"
    )


STOPS = Note[GearTable](
    "sector.stops",
    _stops,
    lambda m: float(_beyond(m).min()),
    "deg",
    when=lambda m: m.given.sector is not None,
)


def _more(params: NoncircularParams, works: Callable[[SectorTeeth], bool]) -> int | None:
    """The least of a few greater numbers of teeth with which both sectors work: their ends are shorter."""
    for factor in np.geomspace(1.2, 6, 8):
        more = math.ceil(params.teeth * float(factor))
        try:
            found = table_of(type(params).model_validate({**params.model_dump(), "teeth": more}))
        except ValueError:
            return None
        if all(map(works, found.sectors)):
            return more
    return None
