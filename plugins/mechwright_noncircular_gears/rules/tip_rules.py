"""Tips of teeth on hollow arcs: where a flank turns back before its tip, or the tip runs into a fillet.

On a hollow arc of radius ρ the flank ends in a cusp at a height η over the rack's pitch line of |ρ| sin²α. A
tip whose flank ends at a height η needs flanks of its mate down to the depth η, where its fillet begins; on a
hollow arc η is more than the height of the tooth. A ring is hollow all round.
"""

import math
from collections.abc import Callable

import numpy as np

from mechwright import Array, GeometryError
from mechwright.contracts.design_rule import DesignRule
from mechwright.mechanics.gearing import Teeth
from mechwright.mechanics.gearing.usual import LEAST_REGULARITY
from mechwright.tolerances import exceeds
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.table import LEAST_ADDENDUM, GearTable, table_of

STEPS = 1000
"""Addenda are sought in thousandths of a module."""

Fits = Callable[[Teeth, Teeth], bool]
"""Whether the tips of a gear are right for its mate."""


def _least_regularity(m: GearTable) -> Array:
    """Of the flanks up to the tips of both gears; infinite of a gear without hollow arcs."""
    found = [math.inf, math.inf]
    for gear, one in enumerate(m.teeth):
        if m.extremes.curvatures[gear].value < 0:
            try:
                found[gear] = float(one.least_tip_regularity.min())
            except GeometryError:
                found[gear] = -math.inf
    return np.array(found)


CUSP = DesignRule[GearTable](
    "gear.tip-cusp",
    lambda f: f.m.addendum(f.item)[0],
    lambda f: (
        f"flanks of gear {f.item + 1} turn back before they are {f.m.addendum(f.item)[1]:g} modules high"
    ),
    value=_least_regularity,
    limit=LEAST_REGULARITY,
    remedy="use more teeth, or a law that changes its ratio less",
    reported=lambda f: (f.m.addendum(f.item)[1], None),
    each=False,
)
"""The first gear with hollow arcs whose flanks turn back before their tips."""

TIP_FILLET = CUSP.but(
    code="gear.tip-fillet",
    message=lambda f: (
        f"tips of gear {f.item + 1} ask for flanks of their mates down to {f.value:.3f} mm, "
        f"and those end at {f.limit:.3f} mm: tips would run into fillets"
    ),
    value=lambda m: np.array([one.tip_height for one in m.teeth]),
    limit=lambda m: np.array([one.rack.straight_depth for one in reversed(m.teeth)]),
    must_be="at most",
)
"""The first gear whose tips would run into the fillets of its mate."""


def straight(own: Teeth, mate: Teeth) -> bool:  # noqa: ARG001 - the same question of every rule
    """Whether flanks go on to their tips."""
    try:
        return bool(own.least_tip_regularity.min() >= LEAST_REGULARITY)
    except GeometryError:
        return False


def clear(own: Teeth, mate: Teeth) -> bool:
    """Whether tips do so, and stay clear of the fillets of their mates."""
    return straight(own, mate) and not exceeds(own.tip_height, mate.rack.straight_depth)


def both(params: NoncircularParams, works: Fits) -> bool:
    """Whether the tips of both gears are right."""
    one, two = table_of(params).teeth
    return works(one, two) and works(two, one)


def lower(params: NoncircularParams, gear: int, works: Fits) -> dict[str, float] | None:
    """The greatest tooth heights, modules, that work for both gears; None where none does for one of them."""
    found: dict[str, float] = {}
    for one in (gear, 1 - gear):
        now = table_of(params).changed(**found)
        teeth = now.teeth
        if works(teeth[one], teeth[1 - one]):
            continue
        field, value = now.addendum(one)
        most = _most(now, one, field, value, works)
        if most is None:
            return None
        found[field] = most
    return found


def _most(m: GearTable, gear: int, field: str, value: float, works: Fits) -> float | None:
    """The greatest tooth height, modules, below ``value`` that works; None where none does."""

    def good(step: int) -> bool:
        teeth = m.changed(**{field: step / STEPS}).teeth
        return works(teeth[gear], teeth[1 - gear])

    low, high = math.ceil(LEAST_ADDENDUM * STEPS), math.floor(value * STEPS)
    if low >= high or not good(low):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if good(middle) else (low, middle)
    return low / STEPS
