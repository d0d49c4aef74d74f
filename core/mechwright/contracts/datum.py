"""From which hole a part is measured, and its lengths between holes over pins."""

import math

from mechwright.contracts.measure import Measure
from mechwright.contracts.part import Bore, Part
from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.errors import DesignError

SAME = 1e-6
"""Axes that are nearer, mm, are one."""


def datum_bore(part: Part) -> Bore | None:
    """The hole from which a part is measured; None of a part without one.

    It is the largest hole on the part's own axis, else the largest with a fit, else the largest, the nearest
    to the axis of those that are alike.
    """
    bores = [feature for feature in part.features if isinstance(feature, Bore)]
    central = [bore for bore in bores if math.hypot(*bore.centre) <= SAME]
    return max(
        central or bores,
        key=lambda bore: (bore.fit is not None, bore.diameter, -math.hypot(*bore.centre)),
        default=None,
    )


def length_zone(part: Part, length: float, tolerances: Tolerances) -> tuple[float, float] | None:
    """Limit deviations of a length of a part, mm; None where the general tolerances end before it."""
    try:
        found = tolerances.length(part.name, length)
    except DesignError:
        return None
    return found.lower, found.upper


def over_pins(part: Part, tolerances: Tolerances) -> tuple[Measure, ...]:
    """Distances from the datum to each other hole with a fit, over pins of both basic sizes, mm.

    Over pins p and q the distance C of two axes reads C + (p + q)/2. Its limits are those of a length.

    >>> from mechwright import Instance
    >>> from mechwright.contracts.fits import hole_fit
    >>> one, other = hole_fit(8, "H7"), hole_fit(6, "H7")
    >>> holes = (Bore("a", (0, 0), 8, 0, 6, one), Bore("b", (30, 0), 6, 0, 6, other))
    >>> from mechwright.geometry import Loop, Outline
    >>> square = Outline(Loop.polygon([(-9, -9), (39, -9), (39, 9), (-9, 9)]))
    >>> (found,) = over_pins(Part("link", square, 6, "steel", machined=holes), Tolerances())
    >>> found.what, found.nominal, found.least, found.greatest
    ('over pins ⌀8 in a and ⌀6 in b', 37.0, 36.985, 37.015)
    """
    base = datum_bore(part)
    if base is None or base.fit is None:
        return ()
    found, known = [], [base.centre]
    for bore in part.features:
        if not isinstance(bore, Bore) or bore.fit is None:
            continue
        if any(math.dist(bore.centre, other) <= SAME for other in known):
            continue
        known.append(bore.centre)
        length = math.dist(base.centre, bore.centre)
        nominal = round(length + (base.fit.size + bore.fit.size) / 2, 4)
        zone = length_zone(part, length, tolerances)
        least, greatest = (None, None) if zone is None else (round(nominal + off, 4) for off in zone)
        what = f"over pins ⌀{base.fit.size:g} in {base.name} and ⌀{bore.fit.size:g} in {bore.name}"
        found.append(Measure(what, nominal, least, greatest, "pins without shake"))
    return tuple(found)
