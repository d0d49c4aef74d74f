"""Whether a law can be run: the driven gear has to turn on all the way."""

import math
from collections.abc import Iterator

from mechwright import Finding
from mechwright_noncircular_gears.formula_checks import formula_finding
from mechwright_noncircular_gears.law import LEAST_RATIO, fastest_of, law_of, slowest_of
from mechwright_noncircular_gears.laws.formula import AngleFormula, RatioFormula
from mechwright_noncircular_gears.laws.sector import SectorLaw
from mechwright_noncircular_gears.laws.window import WindowLaw
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.sector_checks import sector_law_finding
from mechwright_noncircular_gears.softer import nearest, said

MOST_RING_RATIO = 0.95
"""Of a ring and the gear in it: pitch radii r = a i/(1 - i) have no bound towards 1."""


def law_findings(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    """Room for the blends of a window, a ratio above 0, and below 1 in a ring.

    A softer law is sought only to ``advise``.
    """
    law = law_of(params)
    if isinstance(law, WindowLaw):
        taken, period = law.width + 2 * law.blend, law.period
        if taken >= period:
            most = math.floor(math.degrees(period - law.width) / 2 * 0.98)
            yield Finding.error(
                "law.window",
                "blend",
                f"the window and its blends take {math.degrees(taken):g} degrees, and a lobe of the "
                f"driver has {math.degrees(period):g}",
                math.degrees(taken),
                math.degrees(period),
                "deg",
                f"make blend {most}, or window smaller" if most > 0 else "make window smaller",
                proposed=({"parameters.blend": most},) if most > 0 else (),
            )
            return
    if isinstance(law, RatioFormula | AngleFormula):
        wrong = formula_finding(params.law, law)
        if wrong is not None:
            yield wrong
            return
    if isinstance(law, SectorLaw):
        wrong = sector_law_finding(params, law)
        if wrong is not None:
            yield wrong
            return
    if params.internal and not outruns(params):
        fastest = fastest_of(law)
        words, changes = said(
            nearest(params, outruns) if advise else None, "draw the law nearer to a constant ratio"
        )
        yield Finding.error(
            "law.ring",
            "law",
            f"the ring turns {fastest.value:.4g} times as fast as the gear in it at "
            f"{math.degrees(fastest.angle):.1f} degrees of the driver, and no ring catches up: its ratio is "
            f"to stay below {MOST_RING_RATIO:g}",
            fastest.value,
            MOST_RING_RATIO,
            remedy=words,
            proposed=changes,
        )
        return
    if runs(params):
        return
    slowest = slowest_of(law)
    words, changes = said(nearest(params, runs) if advise else None, _wider(params))
    yield Finding.error(
        "law.turns-back",
        "law",
        f"the driven gear stands or turns back at {math.degrees(slowest.angle):.1f} degrees of the driver, "
        f"where its ratio is {slowest.value:.4g}: teeth only push on",
        slowest.value,
        0.0,
        remedy=words,
        proposed=changes,
    )


def outruns(params: NoncircularParams) -> bool:
    """Whether the driver is faster than the ring about it, all the way round."""
    return fastest_of(law_of(params)).value < MOST_RING_RATIO


def runs(params: NoncircularParams) -> bool:
    """Whether the ratio stays above 0."""
    return slowest_of(law_of(params)).value > LEAST_RATIO * params.lobes / params.mate_lobes


def _wider(params: NoncircularParams) -> str:
    return (
        "make the window of the stroke smaller, or the stroke shorter"
        if params.law == "slider"
        else "make the window of the index wider, or ramp larger"
        if params.law == "geneva"
        else ("draw the law nearer to a constant ratio")
    )
