"""The rules of a Geneva mechanism, in the order in which they are asked, and the figures worth knowing."""

import math

import numpy as np

from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright_geneva.kinematics.figures import dwell_share, peaks_of
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.rules.body import BODY
from mechwright_geneva.rules.clearances import CLEARANCES
from mechwright_geneva.rules.feasibility import FEASIBLE
from mechwright_geneva.rules.slots import REGIMES, SLOTS
from mechwright_geneva.rules.strength import STRENGTH


def _motion_message(m: Mechanism) -> str:
    peaks = peaks_of(m)
    return (
        f"per crank speed: velocity {peaks.v:.5g}, acceleration {peaks.a:.5g}, jerk {peaks.j:.5g}; the "
        f"wheel rests for {100 * dwell_share(m):.1f} % of the time"
    )


def _play_message(m: Mechanism) -> str:
    return (
        f"in the middle of the dwell the locked wheel can turn by {_play(m):.4f} degrees either way; within "
        f"{math.degrees(m.arc_half):.1f} degrees of its ends the disc covers one horn only, and it is "
        "more"
    )


def _play(m: Mechanism) -> float:
    return math.degrees(m.lock_play(m.arc, m.lock))


def _island_limit(m: Mechanism) -> float:
    return np.asarray(m.measures.island_limit).item()


def _slot_message(m: Mechanism) -> str:
    found, limit = m.measures, _island_limit(m)
    return (
        f"regime {REGIMES[m.side]}: critical roller radius {limit:.4f} mm, tip of the island "
        f"{limit - m.groove:.3f} mm, neck {2 * found.neck.item():.3f} mm, web "
        f"{found.web.item():.3f} mm; cutters up to {2 * m.groove:.3f} mm cut the groove"
    )


NOTES = all_of(
    Note[Mechanism](
        "geneva.left-out",
        lambda m: (
            "what the design leaves out is "
            + ", ".join(f"{key} {getattr(m.params, key):.6g}" for key in m.params.left_out)
        ),
        when=lambda m: m.params.left_out,
    ),
    Note[Mechanism](
        "geneva.size",
        "centre distance {m.axes:.4f} mm, crank radius {m.crank:.4f} mm, slot bottom {m.bottom:.4f} "
        "mm from the wheel's axis, locking disc {m.lock:.3f} mm",
        lambda m: m.axes,
        "mm",
    ),
    Note[Mechanism]("geneva.motion", _motion_message, lambda m: peaks_of(m).a),
    Note[Mechanism]("geneva.play", _play_message, _play, "deg"),
    Note[Mechanism]("geneva.slot", _slot_message, _island_limit, "mm", when=lambda m: not m.straight),
)

RULES = in_turn(FEASIBLE, SLOTS, BODY, STRENGTH, NOTES, CLEARANCES)
