"""Holes for the heads of standard screws: counterbores and countersinks, by the name of the screw.

Glossary
--------
seat
    What a screw's head lies in, from the top face on: a counterbore for a cylinder, a cone of 90 degrees for
    a countersunk head; with the clearance hole of the shank below it, all through the plate.
"""

import re
from dataclasses import dataclass, replace

from mechwright.contracts.details import Chamfer
from mechwright.contracts.holes import exchanged, hole, wall_beside
from mechwright.contracts.part import Bore, Part
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Loop, circle
from mechwright.standards.screws import lengths, screw_size, screw_sizes
from mechwright.standards.table import table
from mechwright.tolerances import TOLERANCES

EXAMPLES = "write ISO 4762 M6 for a cylinder head, ISO 10642 M6 for a countersunk one, or ASME B18.3 1/4"
UNDER = 0.25
"""So many diameters of the screw stay of the plate under a cylinder head at least; handbook, unchecked."""
BESIDE = 1.0
"""So much of the plate stays beside a seat, mm."""
NARROW = 0.75
"""A hole may be drawn no narrower than so many diameters of its screw: as its core is."""
_STANDARD = r"ISO 4762|ISO 10642|ASME B18\.3(?:\.5M?)?"
_NAME = re.compile(rf"(?:({_STANDARD})\s+)?(M\d+(?:\.\d+)?|#\d+|\d/\d+)", re.IGNORECASE)
_FLAT_INCH = (
    "countersunk inch screws have heads of 82 degrees, and a cutter of 90 degrees would bear on the rim"
)


@dataclass(frozen=True)
class Seat:
    """The hole of one screw, mm."""

    name: str
    """The standard and the thread, as it is told."""
    size: float
    """Diameter of the thread."""
    clearance: float
    """Of the shank (ISO 273, medium)."""
    head: float
    """Diameter of the seat at the top face."""
    depth: float
    """Of the seat: of a counterbore, or of the cone down to the clearance hole."""
    cone: bool


def seat(designation: str) -> Seat:
    """The hole for a screw by its name: ISO 4762 or ISO 10642 by M, ASME B18.3 by # or a fraction.

    Raises DesignError for what is no such name, and for a size that the tables do not have.

    >>> seat("ISO 4762 M6").head, seat("iso 10642 m4").cone, round(seat("1/4").depth, 3)
    (11, True, 6.985)
    """
    match = _NAME.fullmatch(" ".join(designation.split()))
    if match is None:
        why = _FLAT_INCH if "82" in designation or "B18.3.5" in designation.upper() else EXAMPLES
        raise DesignError(f"{designation!r} is no screw with a seat that is known; {why}")
    standard, thread = (match[1] or "").upper(), match[2].upper()
    metric = thread.startswith("M")
    if "B18.3.5" in standard:
        raise DesignError(f"{designation}: {_FLAT_INCH}; use a socket head cap screw, ASME B18.3")
    if metric is standard.startswith("ASME") and standard:
        raise DesignError(f"{designation!r}: {standard} has no thread {thread}; {EXAMPLES}")
    if metric:
        return _metric(float(thread[1:]), cone=standard == "ISO 10642")
    return _inch(thread)


def _metric(size: float, *, cone: bool) -> Seat:
    of = screw_size(size)
    if cone and not of.sunk_head:
        having = ", ".join(f"M{one.size:g}" for one in screw_sizes() if lengths(one.size, "countersunk"))
        raise DesignError(f"no countersunk screws M{size:g}; one of: {having}")
    clearance = of.clearance()
    if cone:
        return Seat(
            f"ISO 10642 M{size:g}", size, clearance, of.countersink, (of.countersink - clearance) / 2, cone
        )
    return Seat(f"ISO 4762 M{size:g}", size, clearance, of.counterbore, of.counterbore_depth, cone)


def _inch(thread: str) -> Seat:
    rows = table("screws-inch").rows
    row = next((row for row in rows if row["name"] == thread), None)
    if row is None:
        having = ", ".join(str(row["name"]) for row in rows)
        raise DesignError(f"no socket head cap screws {thread} (ASME B18.3); one of: {having}")
    sizes = [round(25.4 * float(row[key]), 4) for key in ("size", "clearance", "counterbore", "depth")]
    size, clearance, head, depth = sizes
    return Seat(f"ASME B18.3 {thread}", size, clearance, head, depth, cone=False)


def seated(part: Part, name: str, designation: str) -> Part:
    """The part with a hole for a screw: the clearance hole through the plate, and the seat of its head.

    Raises GeometryError where there is no hole of this name from the top face through; it has a fit, or is
    much narrower than the screw or wider than its head; or too little of the plate would stay under or beside
    the head.
    """
    bore, of = hole(part, name), seat(designation)
    where = f"{name} of part {part.name}"
    if bore.top > TOLERANCES.closure or bore.depth < part.thickness - TOLERANCES.closure:
        raise GeometryError(f"{where} does not go through from the top face; screws go through")
    if bore.fit is not None:
        raise GeometryError(f"{where} has a fit, and the shank of a screw has air")
    if not NARROW * of.size <= bore.diameter <= of.head + TOLERANCES.flatten:
        raise GeometryError(
            f"{where} is drawn with {bore.diameter:g} mm; the hole of {of.name} is drawn from "
            f"{NARROW * of.size:g} mm to its head, {of.head:g} mm"
        )
    least = of.depth if of.cone else of.depth + UNDER * of.size
    if part.thickness < least:
        raise GeometryError(
            f"{where}: the seat of {of.name} is {of.depth:g} mm deep, in a plate of {part.thickness:g} mm; "
            f"it needs {least:g} mm"
        )
    wall = wall_beside(part, bore) - of.head / 2
    if wall < BESIDE:
        raise GeometryError(
            f"the head of {of.name} in {where} leaves a wall of {max(wall, 0):.2f} mm; it needs {BESIDE:g} mm"
        )
    if of.cone:
        made = exchanged(part, bore, replace(bore, diameter=of.clearance))
        edge = Loop((circle(bore.centre, of.clearance / 2),))
        return replace(made, details=(*made.details, Chamfer(f"sink-{name}", edge, "inside", of.depth)))
    below = replace(bore, diameter=of.clearance, top=of.depth, depth=bore.depth - of.depth)
    made = exchanged(part, bore, below)
    seat_of = Bore(f"head-{name}", bore.centre, of.head, 0.0, of.depth)
    return replace(made, machined=(seat_of, *made.features))
