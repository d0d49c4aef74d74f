"""What ``[cam]`` asks of the parts themselves: fits and threads of holes, broken edges, marks.

Solids, drawings, programs, proofs and setup sheets are made of the parts that come from here.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from mechwright.contracts.edges import deburred
from mechwright.contracts.holes import fitted, threaded
from mechwright.contracts.marking import engraved_dots, marked
from mechwright.contracts.part import Part
from mechwright.errors import DesignError, MechwrightError
from mechwright.standards.screw_holes import seated
from mechwright_cam.shop.settings import CamSettings, Hole, PartSettings

NAME = "{part}"
"""Stands for the part's name in a mark."""


def with_requested_features(
    cam: CamSettings, own: Mapping[str, PartSettings], parts: Sequence[Part], path: Path
) -> tuple[Part, ...]:
    """The parts as the design file asks for them; parts that are no plates as they are.

    Of the table ``[cam]``, and part name to the table ``[cam.part.NAME]``. Raises DesignError that begins
    with ``path`` and the key of what cannot be done.
    """
    plates = [part.name for part in parts if part.outline is not None]
    for name, table in own.items():
        for key in ("holes", "deburr", "mark"):
            if name not in plates and getattr(table, key) != getattr(cam, key, {}):
                raise DesignError(
                    f"{path}: cam.part.{name}.{key}: no plate part has this name; "
                    f"there is: {', '.join(sorted(plates)) or 'none'}"
                )
    return tuple(
        part if part.outline is None else _made(part, own.get(part.name) or cam, path) for part in parts
    )


def _made(part: Part, table: CamSettings, path: Path) -> Part:
    """A plate with what its table asks for: first its holes, then edges, then the mark that keeps clear."""
    where = f"cam.part.{part.name}"
    holes = table.holes if isinstance(table, PartSettings) else {}
    for name, hole in holes.items():
        part = _told(f"{path}: {where}.holes.{name}", _hole, part, name, hole)
    if table.deburr > 0:
        part = _told(f"{path}: {where}.deburr", deburred, part, table.deburr)
    if table.fitting_marks:
        depth, line = table.mark_depth, table.mark_line
        part = _told(f"{path}: {where}.fitting_marks", engraved_dots, part, depth, line)
    if table.mark:
        text = table.mark.replace(NAME, part.name)
        letters = (table.mark_height, table.mark_depth, table.mark_line)
        part = _told(f"{path}: {where}.mark", marked, part, text, *letters)
    return part


def _hole(part: Part, name: str, hole: Hole) -> Part:
    if hole.fit is not None:
        return fitted(part, name, hole.fit)
    if hole.screw is not None:
        return seated(part, name, hole.screw)
    assert hole.thread is not None  # noqa: S101 - a hole has one of the three
    return threaded(part, name, hole.thread, hole.depth)


def _told(where: str, change: Callable[..., Part], *of: object) -> Part:
    """A change of a part, whose refusal begins with ``where``."""
    try:
        return change(*of)
    except MechwrightError as error:
        raise DesignError(f"{where}: {error}") from error
