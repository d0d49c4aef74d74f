"""Rules of the clearances: whether they leave room for what programs leave on the walls.

A wall keeps what the proof of its program lets pass, D, and the axes stand as far off their places as four
bored holes within tolerance put them, c. The wheel gives way to an axis that is off by turning, but not on
the line of centres: there the roller stands at the bottom of a straight slot, or at the crest of a curved
one, and the disc in its concave arc. So a slot needs D and c on either side of the roller, and disc and arc
need D each, and c.
"""

from mechwright import TOLERANCES, Severity, Stage
from mechwright.contracts.design_rule import DesignRule
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.tolerances import OFF_CENTRE
from mechwright_geneva.kinematics.mechanism import Mechanism

LEFT = TOLERANCES.leftover
"""D, mm: what the proof of a program lets pass on a wall."""
PLANNED = TOLERANCES.arc_fit + TOLERANCES.flatten
"""mm: what a path that keeps its own tolerance may leave on a wall."""

LEAST_GROOVE = round(2 * (LEFT + OFF_CENTRE), 6)
"""Groove clearance, mm, with which every roller runs."""
LEAST_LOCK = round(2 * LEFT + OFF_CENTRE, 6)
"""Lock clearance, mm, with which every disc turns."""
BINDING = round(2 * PLANNED, 6)
"""Clearance, mm, below which walls as they are planned are sure to bind: roller in slot, or disc in arc."""

Rule = DesignRule[Mechanism]


def _clearance(key: str, least: float, binds: str, may_bind: str) -> tuple[Rule, Rule]:
    """An error where walls as planned bind, else a warning where walls within tolerance may."""
    may = Rule(
        "geneva.clearance",
        key,
        f"as made {may_bind}: walls and axes within tolerance take up to {least:g} mm of the clearance",
        value=lambda m: getattr(m.params, key),
        limit=least,
        unit="mm",
        remedy=f"make {key} at least {least:g}",
        stage=Stage.MACHINING,
        severity=Severity.WARNING,
    )
    does = may.but(
        message=f"as made {binds}: walls as they are planned take up to {BINDING:g} mm of the clearance",
        limit=BINDING,
        severity=Severity.ERROR,
        reported=lambda f: (f.value, least),
    )
    return does, may


CLEARANCES = all_of(
    in_turn(
        *_clearance(
            "groove_clearance",
            LEAST_GROOVE,
            "the roller binds in its slot",
            "the roller may bind in its slot",
        )
    ),
    in_turn(
        *_clearance(
            "lock_clearance",
            LEAST_LOCK,
            "the locking disc seizes in the wheel",
            "the locking disc may seize in the wheel",
        )
    ),
)
"""Of slot and lock."""
