"""Parts drawn for a printer: every wall of a plate moved in the plane, exactly, before a solid is made of it.

A wall is moved by half the deviation of its kind; the growth of lengths is taken off the triangles later,
since along X and Y it may differ, which no arc survives. Of a body of free form the bores are moved.
"""

from dataclasses import dataclass, replace

import shapely

from mechwright.contracts.details import Chamfer, Detail
from mechwright.contracts.part import Bore, Feature, OpenProfile, Part, Pocket, Profile
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline
from mechwright_print.compensation.holes import PrintedHole, printed_holes, with_targets
from mechwright_print.compensation.offsets import material_left, rounded_by, thickened, thickened_each
from mechwright_print.compensation.open_slots import open_slots
from mechwright_print.printer.settings import Printer
from mechwright_print.settings import PrintSettings


@dataclass(frozen=True, eq=False)
class Compensated:
    """A part for a printer.

    Parameters
    ----------
    part
        As designed.
    printed
        As the print is to come out: holes in the sizes of their joints.
    model
        As the printer has to be given it, without the growth of lengths.
    holes
        How each round hole is printed.
    """

    part: Part
    printed: Part
    model: Part
    holes: tuple[PrintedHole, ...] = ()


def compensated(part: Part, settings: PrintSettings, printer: Printer) -> Compensated:
    """A part as it is given to the printer.

    Raises
    ------
    GeometryError
        A wall cannot be moved so far; the message names the part.
    DesignError
        ``print.holes`` names a hole that is not there.
    """
    holes = printed_holes(part, settings, printer)
    printed = _plain(with_targets(part, holes))
    if settings.compensate == "slicer":
        return Compensated(part, printed, printed, tuple(holes))
    if part.outline is None:
        return Compensated(part, printed, _bored(printed, printer), tuple(holes))
    try:
        return Compensated(part, printed, _moved(printed, printer), tuple(holes))
    except GeometryError as error:
        raise GeometryError(f"part {part.name}: {error}") from error


def _plain(part: Part) -> Part:
    """Without threads and engraved lines, which no printer makes."""
    return replace(part, details=tuple(one for one in part.details if isinstance(one, Chamfer)))


def _bored(part: Part, printer: Printer) -> Part:
    """A body of free form with its bores against the printer's deviation; other bodies have none."""
    if part.free_form is None:
        return part
    bores = tuple(
        replace(one, diameter=one.diameter - printer.hole_off(one.diameter)) for one in part.free_form.bores
    )
    return replace(part, free_form=replace(part.free_form, bores=bores))


def _moved(part: Part, printer: Printer) -> Part:
    """The part with every wall moved against the printer's deviations."""
    assert part.outline is not None  # noqa: S101 - asked of plates
    outline = part.outline
    outer = _wall(outline.outer, printer, opening=False)
    inner = tuple(_wall(loop, printer, opening=True) for loop in outline.inner)
    features = tuple(_feature(feature, printer) for feature in part.features)
    details = tuple(_detail(detail, printer) for detail in part.details)
    # The outline and the features that go through are the same walls: they move alike.
    return replace(part, outline=Outline(outer, inner, outline.deviation), machined=features, details=details)


def is_convex(loop: Loop) -> bool:
    """Whether a loop is as a pin is, that may have a flat; a wheel whose rim has gaps is none.

    >>> is_convex(Loop.polygon([(0, 0), (4, 0), (4, 4)]))
    True
    """
    shape = shapely.Polygon(loop.flatten())
    return bool(shapely.convex_hull(shape).area <= shape.area * (1 + _ROUND))


_ROUND = 1e-3
"""Share of its area by which a pin may differ from its convex hull: chords of its circle."""


def more_material(loop: Loop, printer: Printer, *, opening: bool) -> float:
    """By how much the wall along a loop has to be moved off its material, mm."""
    round_ = rounded_by(loop)
    if opening:
        off = printer.deviation.slot if round_ is None else printer.hole_off(round_[1])
        return off / 2
    off = printer.deviation.pin if round_ is not None and is_convex(loop) else printer.deviation.wall
    return -off / 2


def _wall(loop: Loop, printer: Printer, *, opening: bool) -> Loop:
    """A loop moved, run as it was; slots that are open at an outer one move as slots do."""
    run = material_left(loop, opening=opening)
    more = more_material(loop, printer, opening=opening)
    slots = [] if opening else open_slots(run)
    if slots:
        each = [more] * len(run.segments)
        for k in (number for slot in slots for number in slot):
            each[k] = printer.deviation.slot / 2
        moved = thickened_each(run, each)
    else:
        moved = thickened(run, more)
    return moved if (moved.area > 0) == (loop.area > 0) else moved.reversed()


def _feature(feature: Feature, printer: Printer) -> Feature:
    match feature:
        case Bore():
            return replace(feature, diameter=feature.diameter - printer.hole_off(feature.diameter))
        case Profile():
            loop = _wall(feature.loop, printer, opening=feature.side == "inside")
            return replace(feature, loop=loop, tab_sites=())
        case OpenProfile():  # its strip, moved, is no strip of one path any more
            boundary = _wall(feature.boundary, printer, opening=True)
            return Pocket(feature.name, boundary, (), feature.top, feature.depth, feature.floor_radius)
        case Pocket():
            islands = tuple(_wall(island, printer, opening=False) for island in feature.islands)
            boundary = _wall(feature.boundary, printer, opening=True)
            return replace(feature, boundary=boundary, islands=islands)


def _detail(detail: Detail, printer: Printer) -> Detail:
    if not isinstance(detail, Chamfer):
        return detail
    return replace(detail, loop=_wall(detail.loop, printer, opening=detail.side == "inside"))
