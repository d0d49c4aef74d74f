"""Rules of a planetary set: common axes, planets that go in and stay apart, and their carrier."""

import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from mechwright import Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note
from mechwright.mechanics.gearing.involute import MOST_SHIFT
from mechwright_spur_gears.gear_table import CARRIER_WALL, GearTable
from mechwright_spur_gears.rules.ring_rules import freed
from mechwright_spur_gears.rules.teeth_rules import reach

LEAST_GAP = 0.3
"""Modules between the tips of neighbouring planets."""

TRIED = 60
"""Numbers of teeth that are looked at for one with which planets go in and stay apart."""

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def _ring_shift(m: GearTable) -> Any:
    """Shift, in modules, that the ring needs; infinite where no flanks meet at the planets' distance."""
    return np.nan_to_num(np.abs(m.meshes[1].shifts[1]), nan=np.inf)


def _plain_ring(m: GearTable) -> int:
    return int(m.given.teeth + 2 * m.given.mate_teeth)


COAXIAL = Rule(
    "gear.coaxial",
    "ring_teeth",
    lambda f: (
        f"a ring of {f.m.dimensions.ring_teeth} teeth is not coaxial with the sun: at the distance of the "
        f"planets, {float(f.m.distance):.3f} mm, "
        + (f"it needs a shift of {f.value:.3f} modules" if math.isfinite(f.value) else "no flanks meet")
    ),
    value=_ring_shift,
    limit=MOST_SHIFT,
    must_be="at most",
    stage=Stage.MOTION,
    remedy=lambda f: f"make ring_teeth {_plain_ring(f.m)}, which is teeth + 2 mate_teeth, or leave it out",
    reported=lambda f: (f.value if math.isfinite(f.value) else None, MOST_SHIFT),
    proposed=lambda _: ({"parameters.ring_teeth": None},),
)


def _remainder(m: GearTable) -> Any:
    return np.asarray((m.given.teeth + m.dimensions.ring_teeth) % m.dimensions.planets)


def _assembling(m: GearTable, key: str) -> list[int]:
    """Numbers of teeth next to what a gear has, below and above, with which planets go in and stay apart."""
    now = int(getattr(m.given, key))
    numbers = np.array([n for n in range(now - TRIED, now + TRIED + 1) if n >= 6 and n != now])[:, None]
    tried = GearTable(
        with_columns(freed(m.given, "ring_teeth", "centre_distance"), {key: numbers}), len(numbers)
    )
    with np.errstate(all="ignore"):
        works = np.ravel((_remainder(tried) == 0) & (tried.gap >= LEAST_GAP))
    good = numbers[works, 0]
    below, above = good[good < now], good[good > now]
    return [*below[-1:].tolist(), *above[:1].tolist()]


def _numbers(f: Fails, keys: Iterable[str]) -> Iterator[tuple[str, list[int]]]:
    yield from ((key, found) for key in keys if (found := _assembling(f.m, key)))


def _said(f: Fails, keys: Iterable[str]) -> str:
    return ", or ".join(
        f"make {key} {' or '.join(map(str, found))} and leave ring_teeth out"
        for key, found in _numbers(f, keys)
    )


def _teeth_changes(f: Fails, keys: Iterable[str]) -> Iterator[Change]:
    free = {"parameters.ring_teeth": None, "parameters.centre_distance": None}
    for key, found in _numbers(f, keys):
        now = int(getattr(f.m.given, key))
        yield from (
            {f"parameters.{key}": one, **free} for one in sorted(found, key=lambda one: abs(one - now))
        )


def _spaced(f: Fails) -> Iterator[Change]:
    yield from _teeth_changes(f, ("mate_teeth",))
    yield {"parameters.planet_spacing": "nearest"}


EQUAL = Rule(
    "gear.assembly",
    "planets",
    lambda f: (
        f"{f.m.dimensions.planets} planets at equal angles do not go in: the teeth of sun and ring, "
        f"{int(f.m.given.teeth + f.m.dimensions.ring_teeth)} together, leave a remainder of {f.value:g} over "
        f"{f.m.dimensions.planets}"
    ),
    value=_remainder,
    limit=0.0,
    must_be="at most",
    remedy=lambda f: ", or ".join(
        [one for one in (_said(f, ("mate_teeth",)),) if one] + ['set planet_spacing = "nearest"']
    ),
    when=lambda m: m.given.planet_spacing != "nearest",
    proposed=_spaced,
)


def _fewer(m: GearTable) -> int | None:
    """The greatest lower number of planets that go in and stay apart."""
    for count in range(m.dimensions.planets - 1, 0, -1):
        tried = GearTable(m.given.model_copy(update={"planets": count}))
        equal = m.given.planet_spacing == "nearest" or not _remainder(tried).any()
        if equal and (tried.gap >= LEAST_GAP).all():
            return count
    return None


def _apart(f: Fails) -> Iterator[Change]:
    if (fewer := _fewer(f.m)) is not None:
        yield {"parameters.planets": fewer}
    yield from _teeth_changes(f, ("teeth",))


def _apart_remedy(f: Fails) -> str:
    fewer = _fewer(f.m)
    planets = [] if fewer is None else [f"make planets {fewer}"]
    return ", or ".join([*planets, *filter(None, [_said(f, ("teeth",))])]) or "use fewer planets"


APART = Rule(
    "gear.planets",
    "planets",
    lambda f: (
        f"{f.m.dimensions.planets} planets touch each other: {f.value:.3f} modules between their tips, below "
        f"{f.limit:g}"
    ),
    value=lambda m: m.gap,
    limit=LEAST_GAP,
    remedy=_apart_remedy,
    when=lambda m: m.dimensions.planets > 1,
    proposed=_apart,
)
CARRIER = Rule(
    "carrier.wall",
    "pin_diameter",
    "{value:.2f} mm of the carrier stay between its opening and its pins",
    value=lambda m: m.distance - m.dimensions.pin_diameter / 2 - reach(m),
    limit=CARRIER_WALL,
    unit="mm",
    remedy="make pin_diameter or bore smaller, or module larger",
)


def _places(m: GearTable) -> str:
    angles = ", ".join(f"{math.degrees(one):.3f}".rstrip("0").rstrip(".") for one in m.places[0].tolist())
    ring = m.meshes[1]
    return (
        f"planets at {angles} degrees; the {m.driven} turns {float(m.ratio):.6g} times as fast as the "
        f"{m.given.driving_member}; a ring of {m.dimensions.ring_teeth} teeth with a profile shift of "
        f"{round(float(ring.shifts[1]), 3) + 0.0:.3f}, contact ratio {float(ring.contact_ratio):.3f}"
    )


PLACES = Note[GearTable]("gear.planet-angles", _places, lambda m: float(m.ratio))
