"""Whether a law over less than a turn can be run, and whether the blanks of both sectors hold their teeth."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from mechwright import Finding
from mechwright.mechanics.gearing import Rolling, SectorTeeth
from mechwright.tolerances import exceeds, falls_short
from mechwright_noncircular_gears.fields import MOST_SECTOR
from mechwright_noncircular_gears.formula_checks import GRID, corner_finding, finite_finding
from mechwright_noncircular_gears.gear import NAMES, pair_of, teeth_of
from mechwright_noncircular_gears.laws.sector import SectorLaw
from mechwright_noncircular_gears.params import NoncircularParams

LEAST_GAP = 5.0
"""Degrees that stay of a turn between both ends of a sector: an end mill comes in, and the blank is seen."""

HUB_CLEARANCE = 0.25
"""Modules between the hub and the roots: tips of the mate run a quarter of a module above those."""


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


def sector_findings(params: NoncircularParams) -> Iterator[Finding]:
    """An error where a sector with its last teeth reaches all round, or its hub comes to its roots."""
    if params.sector is None:
        return
    teeth = [one for one in teeth_of(params) if isinstance(one, SectorTeeth)]
    for name, one in zip(NAMES, teeth, strict=True):
        extent = math.degrees(one.extent)
        if exceeds(extent, 360 - LEAST_GAP):
            more = _more(params, lambda found: math.degrees(found.extent) <= 360 - LEAST_GAP)
            yield Finding.error(
                "sector.extent",
                "sector",
                f"{name.replace('-', ' ')} with the teeth beyond its ends reaches over {extent:.1f} degrees, "
                f"and {LEAST_GAP:g} of a turn stay free",
                extent,
                360 - LEAST_GAP,
                "deg",
                "make sector smaller" if more is None else f"use {more} teeth, or make sector smaller",
                proposed=() if more is None else ({"parameters.teeth": more},),
            )
            return
    for name, one in zip(NAMES, teeth, strict=True):
        most = one.least_root - HUB_CLEARANCE * one.rack.module
        if exceeds(one.hub, most):
            wanted = math.floor(2 * most * 10) / 10
            yield Finding.error(
                "sector.hub",
                "sector_hub",
                f"the hub of {name.replace('-', ' ')} has a radius of {one.hub:.3f} mm, and its nearest root "
                f"lies {one.least_root:.3f} mm from the axis: tips of the mate would run into it",
                2 * one.hub,
                2 * most,
                "mm",
                f"make sector_hub at most {wanted:g}, or the gear larger"
                if wanted >= params.bore
                else "make the gear larger",
                proposed=({"parameters.sector_hub": wanted},) if wanted > params.bore + 2 else (),
            )
            return
    wall = (teeth[0].hub - params.bore / 2) / teeth[0].rack.module
    if falls_short(wall, 1.0):
        least = math.ceil(params.bore + 2 * teeth[0].rack.module)
        yield Finding.error(
            "sector.hub",
            "sector_hub",
            f"{wall:.2f} modules of the hubs stay around their bores, below 1",
            wall,
            1.0,
            remedy=f"make sector_hub at least {least}",
            proposed=({"parameters.sector_hub": float(least)},),
        )


def stop_notes(params: NoncircularParams) -> Iterator[Finding]:
    """That nothing stops sectors, and how far they may pass the ends of their travel: half a pitch."""
    if params.sector is None:
        return
    pair = pair_of(params)
    ends = np.array([0.0, math.radians(params.sector)])
    rate = pair.distance * Rolling.of(pair.ratio, ends, params.side).speed
    beyond = np.degrees(pair.pitch(params.teeth) / 2 / rate)
    yield Finding.note(
        "sector.stops",
        f"no stops are made at the ends of the travel, 0 and {params.sector:g} degrees of gear 1: what "
        "swings it keeps to them, or stops that let it pass them by less than "
        f"{beyond[0]:.1f} and {beyond[1]:.1f} degrees, half a pitch",
        float(beyond.min()),
        "deg",
    )


def _more(params: NoncircularParams, works: Callable[[SectorTeeth], bool]) -> int | None:
    """The least of a few greater numbers of teeth with which both sectors work: their ends are shorter."""
    for factor in np.geomspace(1.2, 6, 8):
        more = math.ceil(params.teeth * float(factor))
        try:
            found = teeth_of(type(params).model_validate({**params.model_dump(), "teeth": more}))
        except ValueError:
            return None
        if all(works(one) for one in found if isinstance(one, SectorTeeth)):
            return more
    return None
