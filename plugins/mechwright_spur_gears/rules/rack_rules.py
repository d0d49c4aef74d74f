"""Rules of a rack: its fillets and its travel, and a note of how its pinion stands above it."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.rules.ring_rules import freed

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def _enough(m: GearTable) -> int:
    return int(m.rack_pair.rack_teeth(m.dimensions.travel))


def _less(f: Fails) -> float:
    return math.floor(100 * f.limit) / 100


def _changes(f: Fails) -> Iterator[Change]:
    yield {"parameters.rack_teeth": _enough(f.m)}
    if _less(f) > 0:
        yield {"parameters.travel": _less(f)}


TRAVEL = Rule(
    "rack.travel",
    "travel",
    lambda f: (
        f"the rack goes {f.value:g} mm, and its {int(f.m.dimensions.rack_teeth)} teeth allow "
        f"{max(f.limit, 0.0):.2f} mm: beyond that a tooth is missing whose flank would touch"
    ),
    value=lambda m: m.dimensions.travel,
    limit=lambda m: m.rack_pair.travel(m.dimensions.rack_teeth),
    unit="mm",
    must_be="at most",
    remedy=lambda f: (
        f"make rack_teeth at least {_enough(f.m)}"
        + (f", or travel at most {_less(f):g}" if _less(f) > 0 else "")
    ),
    stage=Stage.PARTS,
    proposed=_changes,
)


def _smaller_arc(m: GearTable) -> float | None:
    """The greatest smaller radius at the tip of the rack that keeps tips off fillets; None without one."""
    now = float(m.given.tip_radius)
    radii = np.arange(math.ceil(100 * now) - 1, -1, -1)[:, None] / 100
    if not radii.size:
        return None
    tried = GearTable(with_columns(freed(m.given, "rack_addendum"), {"tip_radius": radii}), len(radii))
    works = np.flatnonzero(np.ravel(tried.rack_pair.fillet_room) >= 0)
    return float(radii[works[0], 0]) if works.size else None


def _rounder(f: Fails) -> Iterator[Change]:
    if (radius := _smaller_arc(f.m)) is not None:
        yield {"parameters.tip_radius": radius, "parameters.rack_addendum": None}


def _rounder_remedy(f: Fails) -> str:
    radius = _smaller_arc(f.m)
    less = "" if radius is None else f"make tip_radius at most {radius:g} and leave rack_addendum out, or "
    return less + "make addendum smaller, or dedendum larger"


FILLET = Rule(
    "rack.fillet",
    "tip_radius",
    lambda f: f"tips of the pinion run {-f.value:.4f} mm into the fillets of the rack",
    value=lambda m: m.rack_pair.fillet_room,
    limit=0.0,
    unit="mm",
    remedy=_rounder_remedy,
    proposed=_rounder,
)


def _size(m: GearTable) -> str:
    pair, plate = m.rack_pair, m.rack_plate
    return (
        f"the pinion's axis stands {float(m.distance):.4f} mm above the rack's reference line and "
        f"{float(m.distance + plate.back):.4f} mm above its back, profile shift "
        f"{float(pair.shifts[0]):.3f}; a rack of {int(plate.count)} teeth is {float(plate.length):.3f} mm "
        f"long, contact ratio {float(pair.contact_ratio):.3f}; the pinion swings by "
        f"{math.degrees(float(m.swing)):.2f} degrees"
    )


SIZE = Note[GearTable]("gear.size", _size, lambda m: float(m.distance), "mm")
