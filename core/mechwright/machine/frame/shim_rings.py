"""The shim rings of a frame, as they are drawn."""

from mechwright.contracts.axial_stack import Shimming
from mechwright.machine.frame.kit import Kit
from mechwright.standards.shims import THICKNESSES, Shim


def add_shim(kit: Kit, shim: Shim, thickness: float, body: str, z: float, *, on_shaft: bool) -> None:
    """A shim ring of the thickness that is drawn, mm; what goes in is chosen after measuring."""
    note = (
        f"a set of {', '.join(f'{one:g}' for one in THICKNESSES)} mm: the play is measured, see stacks.html"
    )
    kit.bought(shim.part_name(thickness), shim.bought(thickness, note, on_shaft=on_shaft), body, z)


def shimming(ring: Shim, drawn: float, where: str, least: float) -> Shimming:
    """How the rings of a stack are chosen; one as thick as ``drawn``, mm, stands for them in the list."""
    return Shimming(ring.designation, THICKNESSES, where, least, part=ring.part_name(drawn))
