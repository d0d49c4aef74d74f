"""The least clearances with which wheel and driver as made go together and turn.

A wall keeps what the proof of its program lets pass, D, and the axes stand as far off their places as four
bored holes within tolerance put them, c. The wheel gives way to an axis that is off by turning, but not on
the line of centres: there the roller stands at the bottom of a straight slot, or at the crest of a curved
one, and the disc in its concave arc. So a slot needs D and c on either side of the roller, and disc and arc
need D each, and c.
"""

from mechwright import TOLERANCES

LEFT = TOLERANCES.leftover
"""D, mm: what the proof of a program lets pass on a wall."""
OFF_CENTRE = 4 * (TOLERANCES.gouge + TOLERANCES.leftover) / 2
"""c, mm. A hole that keeps the leftover limit on one side and is cut too deep by the gouge limit on the other
has its middle off by half of both; wheel, driver and the two holes that carry them are four."""
PLANNED = TOLERANCES.arc_fit + TOLERANCES.flatten
"""mm: what a path that keeps its own tolerance may leave on a wall."""

LEAST_GROOVE = round(2 * (LEFT + OFF_CENTRE), 6)
"""Groove clearance, mm, with which every roller runs."""
LEAST_LOCK = round(2 * LEFT + OFF_CENTRE, 6)
"""Lock clearance, mm, with which every disc turns."""
BINDING = round(2 * PLANNED, 6)
"""Clearance, mm, below which walls as they are planned are sure to bind: roller in slot, or disc in arc."""
