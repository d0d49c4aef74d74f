"""What a drawing shows in its model space: blocks taken apart, layers and colours resolved. Imports ezdxf."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from mechwright.drawings.fault import Told
from mechwright.drawings.strokes import CURVES, NoCurveError, Stroke, curves
from mechwright.errors import GeometryError
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    from ezdxf.document import Drawing

MOST = 50_000
"""Entities of a drawing: a plate has hundreds. Blocks within blocks can make more of a small file."""
DEEPEST = 16
"""Blocks within blocks."""

_TOLD = """
TEXT MTEXT ATTRIB ATTDEF DIMENSION ARC_DIMENSION LARGE_RADIAL_DIMENSION LEADER MULTILEADER MLEADER TOLERANCE
HATCH MPOLYGON SOLID TRACE WIPEOUT IMAGE PDFUNDERLAY DWFUNDERLAY DGNUNDERLAY VIEWPORT POINT OLE2FRAME OLEFRAME
SHAPE ACAD_TABLE LIGHT SUN GEOPOSITIONMARKER SECTION XLINE RAY RTEXT ARCALIGNEDTEXT ACAD_PROXY_ENTITY
"""
NO_CURVES = frozenset(_TOLD.split())
"""Kinds that tell something about a plate and cut nothing of it: they are left out, and told."""
THROUGH = frozenset({"continuous", "bylayer", "byblock", ""})
"""Line types that draw a line through."""


@dataclass(frozen=True)
class _Look:
    """What an entity takes of the block that it stands in."""

    layer: str
    colour: int
    linetype: str
    handle: str


def strokes(
    document: "Drawing",
    scale: float,
    named: Callable[[str, int], str],
    ignored: Callable[[str, int], bool],
    told: Told,
) -> list[Stroke]:
    """The curves that a drawing shows in its model space, mm.

    Parameters
    ----------
    scale
        Length of a unit, mm.
    named
        Who says what a layer and colour mean: ``design``, then it is read even where it is hidden, or
        ``name``, then dashed lines are edges as well; empty where nobody does.
    ignored
        Whether what stands on a layer, in a colour, is left out.
    """
    found: list[Stroke] = []
    heights: set[float] = set()
    zero = 0
    try:
        for entity, look in _Walk(document, told).flat(document.modelspace(), None, 0):
            kind = entity.dxftype()
            if ignored(look.layer, look.colour):
                told.left_out[f"layer {look.layer}"] += 1
            elif why := _hidden(document, entity, look, named):
                told.left_out[why] += 1
            elif kind in NO_CURVES:
                told.left_out[kind] += 1
            else:
                zero += _add(found, heights, entity, look, scale, told)
    except _TooMany:
        told.fault("entity", f"more than {MOST:,} entities are drawn", "export the plate alone")
    if len({round(height, 2) for height in heights}) > 1:
        said = ", ".join(f"Z{height:g}" for height in sorted({round(height, 2) for height in heights})[:4])
        told.note(f"curves are drawn at several heights ({said}); all are taken as one plane")
    if zero:
        told.note(f"{zero} entities without length are left out")
    for what, number in sorted(told.left_out.items()):
        told.note(f"left out: {number} of {what}" if not what.startswith("layer") else f"left out: {what}")
    if not found and not told.faults:
        _nothing(document, told)
    return found


def _add(found: list[Stroke], heights: set[float], entity: Any, look: _Look, scale: float, told: Told) -> int:
    """Add the strokes of one entity; gives 1 if it has no length."""
    kind = entity.dxftype()
    name = f"{kind} {look.handle} on layer {look.layer}"
    if kind not in CURVES:
        remedy = f'explode it, or leave its layer out: layers = {{"{look.layer}" = "ignore"}}'
        told.fault("entity", f"{name} is no curve of a plane", remedy)
        return 0
    try:
        read, height = curves(entity, scale)
    except NoCurveError as error:
        told.fault("entity", f"{name} {error}", error.remedy, error.key)
        return 0
    except GeometryError as error:
        told.fault("entity", f"{name} cannot be read: {error}", "draw it again")
        return 0
    heights.add(height)
    for segments in read:
        kept = tuple(one for one in segments if _long(one))
        if kept:
            found.append(Stroke(kept, look.layer, look.colour, kind, look.handle))
    return 0 if any(_long(one) for segments in read for one in segments) else 1


def _long(segment: Any) -> bool:
    ends = segment.flatten(TOLERANCES.outline)
    return bool(((ends[1:] - ends[:-1]) ** 2).sum() ** 0.5 > TOLERANCES.closure)


class _TooMany(Exception):  # noqa: N818 - ends the walk
    """More is drawn than any plate has."""


class _Walk:
    """The way through a drawing and its blocks, counted: blocks within blocks can be endless."""

    def __init__(self, document: "Drawing", told: Told) -> None:
        self.document, self.told, self._count = document, told, 0

    def flat(self, entities: Any, outer: _Look | None, depth: int) -> Iterator[tuple[Any, _Look]]:
        """Every entity that is no block reference, with what it shows."""
        for entity in entities:
            self._step()
            look = _look(self.document, entity, outer)
            if entity.dxftype() != "INSERT":
                yield entity, look
                continue
            name = f"block {entity.dxf.name} (INSERT {look.handle} on layer {look.layer})"
            fault = self._fault(entity, depth)
            if fault is not None:
                self.told.fault("entity", f"{name} {fault[0]}", fault[1])
                continue
            for copy in entity.multi_insert() if entity.mcount > 1 else (entity,):
                self._step()
                yield from self.flat(self._inside(copy, name), look, depth + 1)

    def _step(self) -> None:
        self._count += 1
        if self._count > MOST:
            raise _TooMany

    def _fault(self, insert: Any, depth: int) -> tuple[str, str] | None:
        from ezdxf.xclip import XClip

        block: Any = self.document.blocks.get(insert.dxf.name)
        if block is None:
            return "is not in the file", "export the drawing with its blocks"
        if block.block is not None and block.block.is_xref:
            return "is another file", "bind the external reference"
        if depth >= DEEPEST:
            return f"lies {DEEPEST} blocks deep", "explode it"
        if XClip(insert).has_clipping_path:
            return "is clipped", "explode it, and trim what is cut off"
        return None

    def _inside(self, insert: Any, name: str) -> Iterator[Any]:
        def skipped(entity: Any, reason: str) -> None:
            if entity.dxftype() not in NO_CURVES:
                said = f"{entity.dxftype()} in {name} cannot be placed: {reason}"
                self.told.fault("entity", said, "explode the block")

        if insert.dxf.get("zscale", 1.0) == 0:
            insert.dxf.zscale = 1.0  # what is flat may say so
        try:
            yield from insert.virtual_entities(skipped_entity_callback=skipped)
        except (ArithmeticError, ValueError, TypeError) as error:  # a scale of 0, a broken entity
            self.told.fault("entity", f"{name} cannot be placed: {error}", "explode the block")


def _look(document: "Drawing", entity: Any, outer: _Look | None) -> _Look:
    """Layer, colour and line type that show: layer 0 and BYBLOCK are those of the block's reference."""
    layer = str(_said(entity, "layer", "0"))
    if outer is not None and layer == "0":
        layer = outer.layer
    own = document.layers.get(layer) if document.layers.has_entry(layer) else None
    colour = abs(int(_said(entity, "color", 256)))
    if colour == 0:
        colour = outer.colour if outer is not None else 7
    elif colour == 256:
        colour = abs(int(own.dxf.color)) if own is not None else 7
    linetype = str(_said(entity, "linetype", "BYLAYER")).lower()
    if linetype == "byblock":
        linetype = outer.linetype if outer is not None else "continuous"
    elif linetype in {"bylayer", ""}:
        linetype = str(own.dxf.linetype).lower() if own is not None else "continuous"
    handle = str(entity.dxf.get("handle") or "")
    return _Look(layer, colour, linetype, handle or (outer.handle if outer is not None else ""))


_CODES = {"layer": 8, "color": 62, "linetype": 6, "invisible": 60}


def _said(entity: Any, name: str, usual: object) -> Any:
    """What an entity says of itself; of a kind that ezdxf does not know there are its groups alone."""
    if entity.dxf.is_supported(name):
        return entity.dxf.get(name, usual)
    said = (tags.get_first_value(_CODES[name], None) for tags in entity.xtags.subclasses)
    return next((value for value in said if value is not None), usual)


def _hidden(document: "Drawing", entity: Any, look: _Look, named: Callable[[str, int], str]) -> str:
    """Why an entity is not taken for an edge that one sees; empty if it is."""
    said = named(look.layer, look.colour)
    if said == "design":
        return ""
    if look.layer.lower() == "defpoints":
        return "layer Defpoints"
    own = document.layers.get(look.layer) if document.layers.has_entry(look.layer) else None
    if own is not None and (own.is_off() or own.is_frozen()):
        return f"layer {look.layer}, which is {'frozen' if own.is_frozen() else 'off'}"
    if _said(entity, "invisible", 0):
        return "invisible entities"
    if look.linetype not in THROUGH and not said:
        return f"lines of type {look.linetype.upper()}"
    return ""


def _nothing(document: "Drawing", told: Told) -> None:
    whole = (layout for layout in document.layouts if layout.block_record.is_alive)
    papers = [layout for layout in whole if not layout.is_modelspace]
    on_paper = sum(1 for layout in papers for one in layout if one.dxftype() != "VIEWPORT")
    if on_paper:
        said = f"the model space shows no curve, and the paper space has {on_paper} entities"
        told.fault("entity", said, "move the plate into the model space, in its true size")
    else:
        told.fault(
            "entity", "the drawing shows no curve", "export the plate's edges; hidden layers count not"
        )
