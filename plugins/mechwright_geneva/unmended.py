"""Everything that is to be said about a design, but for the remedies that change several sizes at once.

Each group needs what the groups before it have found to be sound, so the first group with an error ends the
list.
"""

import math
from collections.abc import Iterator

from mechwright import Finding, Stage, kept, of_stage, until_error
from mechwright_geneva.body_checks import body_findings
from mechwright_geneva.clearance_checks import clearance_findings
from mechwright_geneva.feasible import feasibility
from mechwright_geneva.figures import dwell_share, peaks_of
from mechwright_geneva.load_checks import load_findings, load_judged
from mechwright_geneva.mechanism import Mechanism, mechanism_of
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.slot_checks import REGIMES, slot_findings
from mechwright_geneva.wheel import Wheel


@kept
def unmended(params: GenevaParams) -> tuple[Finding, ...]:
    """The findings. The remedy of an error is empty where no change of one size is one."""
    return until_error(params, feasibility, _mechanism_findings, clearance_findings)


@kept
def judged(params: GenevaParams) -> tuple[Finding, ...]:
    """The same without the sizes that would bear a load, and without the figures."""
    return until_error(params, feasibility, _mechanism_judged, clearance_findings)


@of_stage(Stage.PARTS)
def _mechanism_judged(params: GenevaParams) -> tuple[Finding, ...]:
    return until_error(mechanism_of(params), slot_findings, body_findings, load_judged)


@of_stage(Stage.PARTS)
def _mechanism_findings(params: GenevaParams) -> tuple[Finding, ...]:
    return until_error(mechanism_of(params), slot_findings, body_findings, load_findings, _figures)


def _figures(m: Mechanism) -> Iterator[Finding]:
    if m.params.left_out:
        said = ", ".join(f"{key} {getattr(m.params, key):.6g}" for key in m.params.left_out)
        yield Finding.note("geneva.left-out", f"what the design leaves out is {said}")
    yield Finding.note(
        "geneva.size",
        f"centre distance {m.axes:.4f} mm, crank radius {m.crank:.4f} mm, slot bottom {m.bottom:.4f} "
        f"mm from the wheel's axis, locking disc {m.lock:.3f} mm",
        m.axes,
        "mm",
    )
    peaks = peaks_of(m)
    yield Finding.note(
        "geneva.motion",
        f"per crank speed: velocity {peaks.v:.5g}, acceleration {peaks.a:.5g}, jerk {peaks.j:.5g}; the "
        f"wheel rests for {100 * dwell_share(m):.1f} % of the time",
        peaks.a,
    )
    wheel = Wheel(m)
    play = math.degrees(wheel.free_play)
    yield Finding.note(
        "geneva.play",
        f"in the middle of the dwell the locked wheel can turn by {play:.4f} degrees either way; within "
        f"{math.degrees(wheel.arc_half):.1f} degrees of its ends the disc covers one horn only, and it is "
        "more",
        play,
        "deg",
    )
    if m.straight:
        return
    found = m.measures
    limit = float(found.island_limit[0])
    yield Finding.note(
        "geneva.slot",
        f"regime {REGIMES[m.side]}: critical roller radius {limit:.4f} mm, tip of the island "
        f"{limit - m.groove:.3f} mm, neck {2 * float(found.neck[0]):.3f} mm, web "
        f"{float(found.web[0]):.3f} mm; cutters up to {2 * m.groove:.3f} mm cut the groove",
        limit,
        "mm",
    )
