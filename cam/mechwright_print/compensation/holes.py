"""How each round hole of a part is printed: its size on the finished print, and what is done to it later.

Glossary
--------
target
    Diameter that the printed hole is to have, mm.
operation
    What is done to it after printing: a reamer, an insert, a tap; empty where nothing is.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from mechwright.contracts.details import Chamfer, Detail, Thread
from mechwright.contracts.fits import Fit, hole_fit
from mechwright.contracts.free_form import FormBore
from mechwright.contracts.holes import exchanged, wall_beside
from mechwright.contracts.part import Bore, Part
from mechwright.errors import DesignError
from mechwright.geometry import Loop, circle
from mechwright.standards.bushes import Bush, bush_for
from mechwright.standards.screws import screw_size
from mechwright.tolerances import TOLERANCES
from mechwright_print.compensation.offsets import rounded_by
from mechwright_print.printer.facts import JointKind
from mechwright_print.printer.inserts import INSERTS, Insert
from mechwright_print.printer.settings import Printer
from mechwright_print.settings import HoleKind, PrintSettings


@dataclass(frozen=True)
class PrintedHole:
    """A round hole: of which part, its name, how it is printed, diameters as drawn and on the print, mm.

    ``kind`` is that of ``print.holes``, the way of a thread, or empty for a hole without fit and thread.
    """

    part: str
    name: str
    kind: str
    drawn: float
    target: float
    fit: Fit | None = None
    operation: str = ""
    insert: Insert | None = None
    bush: Bush | None = None

    @property
    def is_finished(self) -> bool:
        """Whether its fit comes from a reamer or a bush, and no printer's scatter is in it."""
        return self.kind in {"ream", "bush"}


def joint_kind(fit: Fit) -> JointKind:
    """The kind of joint that a hole's limits are for: N and P hold, H locates, F slides, what is wider turns.

    >>> [joint_kind(hole_fit(8, name)) for name in ("P7", "H7", "F7", "E7")]
    ['press', 'snug', 'sliding', 'turning']
    """
    if fit.lower < 0:
        return "press"
    if fit.lower == 0:
        return "snug"
    return "turning" if fit.lower > hole_fit(fit.size, "F7").lower else "sliding"


def printed_holes(part: Part, settings: PrintSettings, printer: Printer) -> list[PrintedHole]:
    """The round holes of a part; raises DesignError for one that is named and is not there."""
    bores = round_holes(part)
    found = [_hole(part, bore, settings, printer) for bore in bores]
    for bore, printed in zip(bores, found, strict=True):
        _check_room(part, bore, printed, settings)
    for key in settings.holes:
        name, _, hole = key.partition(".")
        if name == part.name and hole not in [bore.name for bore in bores if bore.fit is not None]:
            fitted = ", ".join(bore.name for bore in bores if bore.fit is not None)
            raise DesignError(
                f"print.holes: part {name} has no hole {hole!r} with a fit; it has: {fitted or 'none'}"
            )
    return found


def _check_room(part: Part, bore: "Bore | FormBore", hole: PrintedHole, settings: PrintSettings) -> None:
    """Refuse a hole that breaks through a wall because of what it is printed for."""
    if not isinstance(bore, Bore) or hole.target <= bore.diameter:
        return
    room = 2 * wall_beside(part, bore)
    if hole.target >= room > bore.diameter:
        holes = {**settings.holes, f"{part.name}.{bore.name}": "ream"}
        listed = ", ".join(f'"{key}" = "{kind}"' for key, kind in holes.items())
        way = 'threads = "screw"' if hole.insert is not None else f"holes = {{ {listed} }}"
        raise DesignError(
            f"print.holes: {part.name}.{bore.name} is printed {hole.target:g} mm wide as {hole.kind}, and "
            f"breaks through a wall at {room:.2f} mm; set {way} in [print]"
        )


def round_holes(part: Part) -> "list[Bore | FormBore]":
    """The round holes of a plate, or of a body of free form."""
    if part.free_form is not None:
        return list(part.free_form.bores)
    return [feature for feature in part.features if isinstance(feature, Bore)]


def _hole(part: Part, bore: "Bore | FormBore", settings: PrintSettings, printer: Printer) -> PrintedHole:
    thread = thread_in(part, bore) if isinstance(bore, Bore) else None
    if thread is not None and isinstance(bore, Bore):
        return _threaded(part, bore, thread, settings)
    if bore.fit is None:
        return PrintedHole(part.name, bore.name, "", bore.diameter, bore.diameter)
    own = settings.holes.get(f"{part.name}.{bore.name}")
    kind: HoleKind
    if own is not None:
        kind = own
    elif settings.fits == "open":
        kind = joint_kind(bore.fit)
    else:
        kind = settings.fits
    if kind == "drawn":
        return PrintedHole(part.name, bore.name, kind, bore.diameter, bore.diameter, bore.fit)
    if kind == "bush":
        deep = bore.length if isinstance(bore, FormBore) else min(bore.depth, part.thickness)
        try:
            bush = bush_for(bore.fit.size, deep)
        except DesignError as error:
            raise DesignError(f"print.holes.{part.name}.{bore.name}: {error}; set it to ream") from error
        target = bush.outside + 2 * printer.side_clearance("snug")
        operation = f"glue in {bush.bought.designation}"
        return PrintedHole(part.name, bore.name, kind, bore.diameter, target, bore.fit, operation, bush=bush)
    if kind == "ream":
        target = bore.fit.size - settings.allowance
        operation = f"ream {bore.fit.short}"
        return PrintedHole(part.name, bore.name, kind, bore.diameter, target, bore.fit, operation)
    target = bore.fit.size + 2 * printer.side_clearance(kind)
    return PrintedHole(part.name, bore.name, kind, bore.diameter, target, bore.fit)


def thread_in(part: Part, bore: Bore) -> Thread | None:
    """The thread in a hole; None if it has none."""
    for detail in part.details:
        if isinstance(detail, Thread) and math.dist(detail.centre, bore.centre) <= TOLERANCES.closure:
            return detail
    return None


def _threaded(part: Part, bore: Bore, thread: Thread, settings: PrintSettings) -> PrintedHole:
    insert = None if thread.inch or thread.left else INSERTS.get(thread.diameter)
    if settings.threads == "insert" and insert is not None:
        return PrintedHole(
            part.name,
            bore.name,
            "insert",
            bore.diameter,
            insert.hole,
            None,
            f"press in {insert.name}",
            insert,
        )
    if settings.threads == "screw":
        wide = screw_size(thread.diameter).clearance()
        return PrintedHole(part.name, bore.name, "screw", bore.diameter, wide, None, "screw and nut")
    return PrintedHole(
        part.name, bore.name, "tap", bore.diameter, bore.diameter, None, f"tap {thread.designation}"
    )


def with_targets(part: Part, holes: list[PrintedHole]) -> Part:
    """The part with its round holes as wide as their targets, without threads and fits."""
    by_name = {hole.name: hole for hole in holes}
    if part.free_form is not None:
        bores = tuple(
            replace(one, diameter=by_name[one.name].target, fit=None) for one in part.free_form.bores
        )
        return replace(part, free_form=replace(part.free_form, bores=bores))
    for bore in [feature for feature in part.features if isinstance(feature, Bore)]:
        hole = by_name[bore.name]
        if hole.target != bore.diameter:
            part = exchanged(part, bore, _resized(bore, hole.target))
            part = replace(part, details=tuple(_edge(one, bore, hole.target) for one in part.details))
    return part


def _edge(detail: Detail, bore: Bore, diameter: float) -> Detail:
    """A chamfer along the edge of a hole, along its new one; other details stay."""
    if not isinstance(detail, Chamfer):
        return detail
    around = rounded_by(detail.loop)
    if around is None or not detail.loop.is_circle:
        return detail
    centre, size = around
    if math.dist(centre, bore.centre) > _NEAR or abs(size - bore.diameter) > _NEAR:
        return detail
    edge = circle(bore.centre, diameter / 2, clockwise=detail.loop.area < 0)
    return replace(detail, loop=Loop((edge,)))


_NEAR = 1e-3
"""A chamfer is that of a hole if centres and diameters differ by less, mm."""


def _resized(bore: Bore, diameter: float) -> Bore:
    return Bore(bore.name, bore.centre, diameter, bore.top, bore.depth, None, bore.depth_limits)


def operations(holes: list[PrintedHole]) -> Iterator[str]:
    """What is done after printing, a line each."""
    for hole in holes:
        if hole.operation:
            yield f"{hole.part} {hole.name}: {hole.operation}"
