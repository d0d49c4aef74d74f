"""What is measured on the coupon: the features of its pieces, and where each stands.

Glossary
--------
row
    One size of the coupon, measured once: a line of its table.
axis
    Along which a size lies on the bed: x or y; round holes are measured by pins, all round.
trial
    A hole into which the gauge pin is put: it tells what a clearance does.
"""

from dataclasses import dataclass
from typing import Literal

Kind = Literal["length", "bed", "hole", "slot", "pin", "wall"]
"""What a row is of: a length above the first layer, the same on the bed, a hole, a slot, a pin, a wall."""
Axis = Literal["x", "y", "round"]

ROUND = (3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0)
"""Diameters of holes and pins, mm."""
SLOTS = (2.0, 4.0, 8.0)
"""Widths of slots along each axis, mm."""
WALLS = (1.2, 2.0, 4.0)
"""Thicknesses of walls along each axis, mm."""
SHORT, LONG = 20.0, 100.0
"""Lengths along each axis, mm."""
GAPS = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30, 0.40)
"""Clearances on each side of the gauge pin in its trials, mm."""
GAUGE_PIN = 6.0
"""Diameter of the gauge pin, mm."""
THICK = 4.0
"""Thickness of the plates, mm."""
TALL = 10.0
"""Height of pins and walls above their base, mm."""
BASE = 3.0
"""Thickness of that base, mm."""
UP = 2.0
"""Lengths are measured so far above the bed, mm: the first layer is not met there."""


@dataclass(frozen=True)
class Row:
    """A size of the coupon: its name in the table, what it is of, its axis, its nominal size, mm, and how."""

    name: str
    kind: Kind
    axis: Axis
    nominal: float
    how: str


def _rows() -> list[Row]:
    rows: list[Row] = []
    axes: tuple[Axis, ...] = ("x", "y")
    for axis in axes:
        for size in (SHORT, LONG):
            up = f"calliper along {axis.upper()}, {UP:g} mm above the bed"
            rows.append(Row(f"length-{axis}-{size:g}", "length", axis, size, up))
            bed = f"calliper along {axis.upper()}, on the lowest layer"
            rows.append(Row(f"bed-{axis}-{size:g}", "bed", axis, size, bed))
    rows += [
        Row(f"hole-{size:g}", "hole", "round", size, "the thickest pin or drill shank that goes in by hand")
        for size in ROUND
    ]
    rows += [
        Row(f"slot-{axis}-{size:g}", "slot", axis, size, f"calliper inside, along {axis.upper()}")
        for axis in axes
        for size in SLOTS
    ]
    rows += [
        Row(f"pin-{axis}-{size:g}", "pin", axis, size, f"calliper along {axis.upper()}, at half height")
        for axis in axes
        for size in ROUND
    ]
    rows += [
        Row(f"wall-{axis}-{size:g}", "wall", axis, size, f"calliper along {axis.upper()}, at half height")
        for axis in axes
        for size in WALLS
    ]
    return rows


ROWS = tuple(_rows())
"""All rows, in the order of the table."""

WORDS = ("stuck", "pushed", "slides", "turns")
"""What the gauge pin does in a trial, from tight to free."""


def trial_name(gap: float) -> str:
    """The name of a trial in the table.

    >>> trial_name(0.1)
    'gap-0.10'
    """
    return f"gap-{gap:.2f}"
