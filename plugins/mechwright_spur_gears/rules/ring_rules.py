"""Rules of a ring: its teeth, its cutter, tips that pass each other, and how it is assembled."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.parameters import SpurGearParams
from mechwright_spur_gears.rules.teeth_rules import LAND

LEAST_DIFFERENCE = 4
"""Teeth that a ring has more than its pinion: with fewer, tips of full height cannot pass each other."""

TRIED_RINGS = 40
"""Numbers of teeth of a ring that are looked at for one whose tips pass."""

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def _most_height(f: Fails) -> float:
    pair = f.m.meshes[-1]
    return math.floor(100 * float(-(f.limit + pair.reference(1)) / pair.module - pair.shifts[1])) / 100


RING_TIP = Rule(
    "gear.ring-tip",
    "ring_addendum",
    "teeth of the ring reach {value:.3f} mm to the axis, and their involutes begin at {limit:.3f} mm",
    value=lambda m: -m.meshes[-1].tip(1),
    limit=lambda m: -m.meshes[-1].base(1),
    unit="mm",
    remedy=lambda f: f"make ring_addendum at most {_most_height(f):g}, or {f.m.flanks[-1].teeth} larger",
    must_be="above",
    proposed=lambda _: ({"parameters.ring_addendum": None},),
)
CUTTER_LAND = LAND.but(
    parameter="dedendum",
    message="teeth of the ring's cutter are pointed: fillets merge and no root is left",
    value=lambda m: m.meshes[-1].cutter_land(m.meshes[-1].cutter_radius),
    remedy="make dedendum, pressure_angle or the pinion's shift smaller",
)


def freed(given: SpurGearParams, *names: str) -> SpurGearParams:
    """The same design without some keys; what they leave out follows anew."""
    free = given.model_copy(update=dict.fromkeys(names))
    free.__pydantic_fields_set__.difference_update(names)
    return free


def _passing(m: GearTable) -> Any:
    return m.meshes[-1].tip_passing


def _more_teeth(m: GearTable) -> int | None:
    """The least number of teeth of a ring past which tips pass; None up to a limit."""
    now = m.number_of(m.flanks[-1])
    numbers = np.arange(now + 1, now + 1 + TRIED_RINGS)[:, None]
    tried = GearTable(
        with_columns(freed(m.given, "centre_distance"), {m.flanks[-1].teeth: numbers}), TRIED_RINGS
    )
    works = np.flatnonzero(np.ravel(_passing(tried)) >= 0)
    return int(numbers[works[0], 0]) if works.size else None


def _fouling_changes(f: Fails) -> Iterator[Change]:
    number = _more_teeth(f.m)
    if number is not None:
        yield {f"parameters.{f.m.flanks[-1].teeth}": number, "parameters.centre_distance": None}


def _fouling_remedy(f: Fails) -> str:
    number = _more_teeth(f.m)
    more = "" if number is None else f"make {f.m.flanks[-1].teeth} at least {number}, or "
    return more + "make addendum and ring_addendum smaller"


FOULING = Rule(
    "gear.fouling",
    lambda f: f.m.flanks[-1].teeth,
    lambda f: (
        f"tips of {f.m.flanks[-2].words} run into tips of the ring beside the mesh: they pass each other by "
        f"{f.value:.3f} mm"
    ),
    value=_passing,
    limit=0.0,
    unit="mm",
    remedy=_fouling_remedy,
    proposed=_fouling_changes,
)
AXIAL = Note[GearTable](
    "gear.assembly",
    "the pinion goes into the ring along its axis alone: on the way along the line of centres tips meet",
    when=lambda m: m.given.arrangement == "internal" and bool(np.all(m.pair.goes_in < 0)),
)
RING_TEETH = Rule(
    "gear.ring-teeth",
    lambda f: f.m.flanks[-1].teeth,
    lambda f: f"the ring has {f.value:g} teeth more than the gear that runs in it, below {f.limit:g}",
    value=lambda m: -m.meshes[-1].teeth[0] - m.meshes[-1].teeth[1],
    limit=LEAST_DIFFERENCE,
    remedy=lambda f: (
        f"make {f.m.flanks[-1].teeth} at least {f.m.number_of(f.m.flanks[-2]) + LEAST_DIFFERENCE:g}"
    ),
    stage=Stage.MOTION,
    proposed=lambda f: (
        {
            f"parameters.{f.m.flanks[-1].teeth}": f.m.number_of(f.m.flanks[-2]) + LEAST_DIFFERENCE,
            "parameters.centre_distance": None,
        },
    ),
)
