"""The shim rings of a frame, as they are drawn."""

from mechwright.contracts.axial_stack import Shimming
from mechwright.machine.frame.kit import Kit
from mechwright.standards.shims import THICKNESSES, Shim


def add_shim(kit: Kit, shim: Shim, thickness: float, body: str, z: float, *, on_shaft: bool) -> None:
    """A shim ring of the thickness that is drawn, mm; what goes in is chosen after measuring."""
    note = (
        f"a set of {', '.join(f'{one:g}' for one in THICKNESSES)} mm: the play is measured, see stacks.html"
    )
    count, each = rings_for(thickness)
    for k in range(count):
        kit.bought(shim.part_name(each), shim.bought(each, note, on_shaft=on_shaft), body, z + k * each)


def rings_for(thickness: float) -> tuple[int, float]:
    """How many rings of one thickness that is sold fill a room, and that thickness, mm.

    One as thick as the room where none do.

    >>> rings_for(0.2), rings_for(0.4), rings_for(0.27)
    ((1, 0.2), (2, 0.2), (1, 0.27))
    """
    for count in range(1, MOST + 1):
        each = round(thickness / count, 6)
        if each in THICKNESSES:
            return count, each
    return 1, thickness


MOST = 5
"""Rings that are put into one place, at most."""


def shimming(ring: Shim, drawn: float, where: str, least: float) -> Shimming:
    """How the rings of a stack are chosen; one as thick as ``drawn``, mm, stands for them in the list."""
    return Shimming(ring.designation, THICKNESSES, where, least, part=ring.part_name(rings_for(drawn)[1]))
