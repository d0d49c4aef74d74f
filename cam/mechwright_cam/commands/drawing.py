"""A plate part from a DXF drawing of anybody, for the proof of a program against it."""

from collections.abc import Sequence
from pathlib import Path

from mechwright.contracts.part import Part, name_from
from mechwright.designs.files import read_bytes
from mechwright.drawings.asked import Asked
from mechwright.drawings.fault import Fault
from mechwright.drawings.meaning import Meaning
from mechwright.drawings.plate import Cut, part_of
from mechwright.drawings.reading import read
from mechwright.drawings.units import NAMES
from mechwright.errors import DesignError

OPTIONS = {
    "units": f"say it with --units: {', '.join(NAMES)}",
    "layers": "name the layers of the outline and its openings with --layers",
    "join": "close it",
}
"""What to do here where a design file would have a key."""


def read_drawing(
    path: Path, thickness: float, material: str, units: str = "", layers: Sequence[str] = ()
) -> Part:
    """The part that a drawing shows, layers read as their names say; those without a meaning go through.

    ``layers`` are those of the outline and its openings, if nothing else is to be read. Raises DesignError
    that names the file, what is wrong, where, and what to do; OutputError where it cannot be opened.
    """
    if units and units not in NAMES:
        raise DesignError(f"--units: {units!r} is not known; one of: {', '.join(NAMES)}")
    named = tuple((name, "through") for name in layers)
    asked = Asked(units=units or "drawing", layers=named, only=bool(named))
    drawn = read(read_bytes(path), asked, Meaning("through"))
    name = name_from(path.stem, "part")
    part = part_of(drawn, asked, Cut(name, thickness, material))
    if part is None:
        raise DesignError(_said(path, drawn.told.faults[0]))
    return part


def _said(path: Path, fault: Fault) -> str:
    if fault.message.startswith("there is no layer"):
        return f"{path}: --layers: {fault.message}"
    return f"{path}: {fault.message}; {OPTIONS.get(fault.key, fault.remedy)}"
