"""Heat-set inserts of brass for threads in printed parts.

The figures are those of one maker's range (ruthex), from its packets and unchecked: the packet in hand
counts.
"""

from dataclasses import dataclass

WALL = 1.6
"""Plastic that stays around an insert, mm: four lines of a 0.4 mm nozzle."""


@dataclass(frozen=True, slots=True)
class Insert:
    """An insert for a metric coarse thread: hole and length, mm."""

    thread: float
    hole: float
    length: float

    @property
    def name(self) -> str:
        """As it is ordered.

        >>> INSERTS[3.0].name
        'heat-set insert M3 x 5.7'
        """
        return f"heat-set insert M{self.thread:g} x {self.length:g}"


INSERTS = {
    one.thread: one
    for one in (
        Insert(2.0, 3.2, 4.0),
        Insert(2.5, 4.0, 5.7),
        Insert(3.0, 4.0, 5.7),
        Insert(4.0, 5.6, 8.1),
        Insert(5.0, 6.4, 9.5),
        Insert(6.0, 8.0, 12.7),
        Insert(8.0, 9.7, 12.7),
    )
}
"""By the diameter of the thread, mm."""
