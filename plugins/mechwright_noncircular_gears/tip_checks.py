"""Tips of teeth on hollow arcs: where a flank turns back before its tip, or the tip runs into a fillet.

On a hollow arc of radius ρ the flank ends in a cusp at a height η over the rack's pitch line of |ρ| sin²α. A
tip whose flank ends at a height η needs flanks of its mate down to the depth η, where its fillet begins; on a
hollow arc η is more than the height of the tooth. A ring is hollow all round.
"""

import math
from collections.abc import Callable, Iterator

from mechwright import Finding, GeometryError
from mechwright.contracts.finding import Change
from mechwright.mechanics.gearing import Teeth
from mechwright.mechanics.gearing.usual import LEAST_REGULARITY
from mechwright.tolerances import exceeds
from mechwright_noncircular_gears.gear import NAMES, teeth_of
from mechwright_noncircular_gears.law import extremes_of
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.profile import profile_of
from mechwright_noncircular_gears.softer import nearest, said

LEAST_ADDENDUM = 0.3
"""Modules: the least of the design table."""

STEPS = 1000
"""Addenda are sought in thousandths of a module."""


def addendum_of(params: NoncircularParams, gear: int) -> tuple[str, float]:
    """Field and value, modules, of the tooth height of gear 0 or 1."""
    if gear and params.internal:
        return "ring_addendum", params.value("ring_addendum")
    return "addendum", profile_of(params).addendum


def cusp_findings(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    """An error for the first gear with hollow arcs whose flanks turn back before their tips.

    The height that works is sought only to ``advise``.
    """
    for gear, one in enumerate(teeth_of(params)):
        if extremes_of(params).curvatures[gear].value < 0 and not _straight(one, one):
            height = addendum_of(params, gear)[1]
            message = (
                f"flanks of {NAMES[gear].replace('-', ' ')} turn back before they are {height:g} modules high"
            )
            yield _finding(params, gear, "gear.tip-cusp", message, _straight if advise else None)
            return


def fillet_findings(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    """The same for the first gear whose tips would run into the fillets of its mate."""
    teeth = teeth_of(params)
    for gear, one in enumerate(teeth):
        depth = teeth[1 - gear].rack.straight_depth
        if exceeds(one.tip_height, depth):
            message = (
                f"tips of {NAMES[gear].replace('-', ' ')} ask for flanks of their mates down to "
                f"{one.tip_height:.3f} mm, and those end at {depth:.3f} mm: tips would run into fillets"
            )
            yield _finding(params, gear, "gear.tip-fillet", message, _clear if advise else None)
            return


def _straight(own: Teeth, mate: Teeth) -> bool:  # noqa: ARG001 - the same question of every finding
    try:
        return bool(own.least_tip_regularity.min() >= LEAST_REGULARITY)
    except GeometryError:
        return False


def _clear(own: Teeth, mate: Teeth) -> bool:
    return _straight(own, mate) and not exceeds(own.tip_height, mate.rack.straight_depth)


def _finding(
    params: NoncircularParams,
    gear: int,
    code: str,
    message: str,
    works: Callable[[Teeth, Teeth], bool] | None,
) -> Finding:
    field, value = addendum_of(params, gear)
    otherwise = "use more teeth, or a law that changes its ratio less"
    if works is None:
        return Finding.error(code, field, message, value, None, "", otherwise)
    lower = _lower(params, gear, works)
    if lower is None:
        fields = nearest(params, lambda softer: _both(softer, works))
        remedy, changes = said(fields, otherwise)
        return Finding.error(code, field, message, value, None, "", remedy, proposed=changes)
    remedy = "make " + " and ".join(f"{name} at most {most:g}" for name, most in lower.items())
    change: Change = {f"parameters.{name}": most for name, most in lower.items()}
    return Finding.error(code, field, message, value, lower[field], "", remedy, proposed=(change,))


def _both(params: NoncircularParams, works: Callable[[Teeth, Teeth], bool]) -> bool:
    one, two = teeth_of(params)
    return works(one, two) and works(two, one)


def _lower(
    params: NoncircularParams, gear: int, works: Callable[[Teeth, Teeth], bool]
) -> dict[str, float] | None:
    """The greatest tooth heights, modules, that work for both gears; None where none does for one of them."""
    found: dict[str, float] = {}
    for one in (gear, 1 - gear):
        now = params.model_copy(update=found)
        teeth = teeth_of(now)
        if works(teeth[one], teeth[1 - one]):
            continue
        field, value = addendum_of(now, one)
        most = _most(now, one, field, value, works)
        if most is None:
            return None
        found[field] = most
    return found


def _most(
    params: NoncircularParams, gear: int, field: str, value: float, works: Callable[[Teeth, Teeth], bool]
) -> float | None:
    """The greatest tooth height, modules, below ``value`` that works; None where none does."""

    def good(step: int) -> bool:
        teeth = teeth_of(params.model_copy(update={field: step / STEPS}))
        return works(teeth[gear], teeth[1 - gear])

    low, high = math.ceil(LEAST_ADDENDUM * STEPS), math.floor(value * STEPS)
    if low >= high or not good(low):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if good(middle) else (low, middle)
    return low / STEPS
