"""The least clearances with which wheel and driver as made go together and turn.

A wall keeps what the proof of its program lets pass, D, and the axes stand as far off their places as four
bored holes within tolerance put them, c. The wheel gives way to an axis that is off by turning, but not on
the line of centres: there the roller stands at the bottom of a straight slot, or at the crest of a curved
one, and the disc in its concave arc. So a slot needs D and c on either side of the roller, and disc and arc
need D each, and c.
"""

from mechwright import TOLERANCES
from mechwright.tolerances import OFF_CENTRE

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
