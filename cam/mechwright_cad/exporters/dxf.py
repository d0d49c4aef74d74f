"""DXF drawings (R2010, millimetres) of outlines. Imports ezdxf, and never the CAD kernel.

Layers hold what a reader needs to tell apart: ``OUTLINE`` the outer loop, ``BORE`` round openings,
``OPENING`` all others, ``POCKET`` edges of recesses as far as they lie on the plate, ``CHAMFER`` where a
broken edge ends, ``ENGRAVE`` the strokes of engravings, ``THREAD`` three quarters of a thread's nominal
circle (ISO 6410-1), ``CENTRE`` the axes of the part and its bores and the centre
lines of grooves, ``TEXT`` lines that say what it is. Sizes that the plan view cannot show follow in the
layer's name: ``BORE_H7``, ``POCKET_3.5``, ``THREAD_M6X1_12``; ``POCKET_3.5_OPEN`` closes its contour beyond
the rim. ``mechwright.drawings`` reads them again.
"""

import io
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ezdxf import units
from ezdxf._options import options  # noqa: PLC2701 (ezdxf.options, which is public, has no type)
from ezdxf.filemanagement import new

from mechwright.contracts.details import Chamfer, Detail, Engraving, Thread, chamfer_lines, detail_note
from mechwright.contracts.part import Bore, Feature, OpenProfile, Part, Pocket, Profile
from mechwright.contracts.sections import blind
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, Loop, Outline, Segment, circle
from mechwright.geometry.segments import Point
from mechwright.geometry.trim import stretches
from mechwright.tolerances import TOLERANCES
from mechwright_cad.exporters.curve_kinds import Curves
from mechwright_cad.exporters.curves import cubic, vertices
from mechwright_cad.exporters.decimals import of_dxf

if TYPE_CHECKING:
    import shapely
    from ezdxf.document import Drawing
    from ezdxf.layouts.layout import Modelspace

LAYERS = {
    "OUTLINE": (7, "CONTINUOUS", 35),
    "BORE": (5, "CONTINUOUS", 35),
    "OPENING": (4, "CONTINUOUS", 35),
    "POCKET": (3, "CONTINUOUS", 25),
    "CHAMFER": (2, "CONTINUOUS", 18),
    "ENGRAVE": (6, "CONTINUOUS", 18),
    "THREAD": (4, "CONTINUOUS", 18),
    "CENTRE": (1, "CENTER", 18),
    "TEXT": (8, "CONTINUOUS", 18),
    "OPEN": (8, "CENTER", 18),
}
"""Layer to colour index, line type and line weight in hundredths of a millimetre (ISO 128: 0.35 and 0.18)."""

_CENTRE_LINE = [2.5, 1.25, -0.5, 0.25, -0.5]
"""Whole length, then dash, gap, dot-like dash, gap, mm."""

OVERHANG = 2.0
"""How far a centre line goes beyond its circle, mm (ISO 128-2: 2 to 3)."""

TEXT_HEIGHT = 3.5
"""Height of letters, mm (ISO 3098)."""


def part(part: Part, curves: Curves = "spline") -> bytes:
    """The drawing of a plate part, in its own coordinates.

    Raises GeometryError for a part without outline, or a segment that cannot be had in the wanted curves.
    """
    if part.outline is None:
        raise GeometryError(f"part {part.name} has no outline to draw; write it as STEP")
    fits = [f"{f.name}: %%c{f.fit.text}" for f in part.features if isinstance(f, Bore) and f.fit]
    said = [detail_note(detail, part.thickness) for detail in part.details]
    text = [f"{part.name}, {part.material}, {part.thickness:g} mm", *map(_note, blind(part)), *fits, *said]
    fitted = [f for f in part.features if isinstance(f, Bore) and f.fit]
    recesses = [f for f in blind(part) if not _in_outline(f, part.outlines)]
    details = [(detail, detail_layer(detail, part.thickness)) for detail in part.details]
    return drawing(part.outlines, "\n".join(text), curves, recesses, part.axes, details, fitted)


def recess_layer(feature: Feature) -> str:
    """The layer of a recess: its floor below the top face, where it begins, the fillet of its floor.

    >>> recess_layer(Bore("hole", (0.0, 0.0), 6.0, 2.0, 3.0))
    'POCKET_5_FROM_2'
    """
    fit = feature.fit.name if isinstance(feature, Bore) and feature.fit else ""
    name = f"BORE_{fit}" if fit else "POCKET"
    start = f"_FROM_{feature.top:g}" if feature.top > 0 else ""
    radius = feature.floor_radius if isinstance(feature, Pocket) else 0.0
    return f"{name}_{feature.top + feature.depth:g}{start}" + (f"_R{radius:g}" if radius > 0 else "")


def detail_layer(detail: Detail, thickness: float) -> str:
    """The layer of a detail of a plate, with its sizes; a thread all through says no depth."""
    match detail:
        case Chamfer():
            return f"CHAMFER_{detail.width:g}"
        case Engraving():
            return f"ENGRAVE_{detail.depth:g}_W{detail.width:g}"
        case Thread():
            deep = "" if detail.depth >= thickness - TOLERANCES.closure else f"_{detail.depth:g}"
            return f"THREAD_{detail.designation.upper().replace('/', '_')}{deep}"  # no name has a stroke


def _in_outline(feature: Feature, outlines: Sequence[Outline]) -> bool:
    """Whether the outline shows a feature: a hole that goes on through from the floor of a recess."""
    return isinstance(feature, Bore) and any(
        _is_bore(loop, feature) for outline in outlines for loop in outline.inner
    )


def _is_bore(loop: Loop, bore: Bore) -> bool:
    arc = loop.segments[0]
    return (
        loop.is_circle
        and isinstance(arc, Arc)
        and math.dist(arc.centre, bore.centre) <= TOLERANCES.closure
        and abs(2 * arc.radius - bore.diameter) <= TOLERANCES.closure
    )


def _note(feature: Feature) -> str:
    """What the plan view cannot show of a recess."""
    radius = feature.floor_radius if isinstance(feature, Pocket) else 0.0
    round_ = f", floor radius R{radius:g}" if radius > 0 else ""
    if isinstance(feature, Bore) and feature.depth_limits is not None:
        return f"{feature.name}: {feature.depth_text} mm deep".replace("±", "%%p")
    if feature.top > 0:
        down = f"from {feature.top:g} to {feature.top + feature.depth:g} mm below the top"
        return f"{feature.name}: {down}{round_}"
    return f"{feature.name}: {feature.depth:g} mm deep{round_}"


def drawing(
    outlines: Sequence[Outline],
    text: str = "",
    curves: Curves = "spline",
    recesses: Sequence[Feature] = (),
    axes: Sequence[Point] = ((0.0, 0.0),),
    details: Sequence[tuple[Detail, str]] = (),
    fitted: Sequence[Bore] = (),
) -> bytes:
    """The drawing of plates, of the recesses in them and of their details, with lines of text below.

    Details come with their layers; ``fitted`` are bores to a fit, which have layers of their own.
    """
    import shapely

    with fixed_metadata():
        document = new("R2010", units=units.MM)
        document.header["$MEASUREMENT"] = 1
        document.linetypes.add("CENTER", _CENTRE_LINE, description="Center ____ _ ____ _")
        for name in LAYERS:
            if name not in SIZED:
                _layer(document, name)
        space = document.modelspace()
        for outline in outlines:
            _loop(space, outline.outer, "OUTLINE", curves)
            for loop in outline.inner:
                fits = [bore.fit.name for bore in fitted if bore.fit and _is_bore(loop, bore)]
                layer = "BORE" if loop.is_circle else "OPENING"
                _loop(space, loop, _layer(document, f"{layer}_{fits[0]}" if fits else layer), curves)
        plates = shapely.union_all([outline.polygon() for outline in outlines])
        for feature in recesses:
            _recess(space, feature, plates, _layer(document, recess_layer(feature)), curves)
        for detail, name in details:
            _detail(space, detail, plates, _layer(document, name), curves)
        inner = [loop for outline in outlines for loop in outline.inner]
        _centres(space, inner, [f for f in recesses if isinstance(f, Bore)], axes)
        return finished(document, plates.bounds, text)


def finished(document: "Drawing", box: tuple[float, float, float, float], text: str) -> bytes:
    """A drawing as a file: a view of the box (x0, y0, x1, y1), mm, with lines of text below it."""
    x0, y0, _, _ = box
    _frame(document, box)
    for row, line in enumerate(text.splitlines()):
        place = (x0, y0 - (2 + 1.6 * row) * TEXT_HEIGHT)
        note = document.modelspace().add_text(line, height=TEXT_HEIGHT, dxfattribs={"layer": "TEXT"})
        note.set_placement(place)
    order_classes(document)
    stream = io.StringIO()
    document.write(stream)
    return of_dxf(stream.getvalue()).encode(document.output_encoding)


def _layer(document: "Drawing", name: str) -> str:
    """The layer of this name, which looks as its first word has it; it is made where there is none."""
    if not document.layers.has_entry(name):
        colour, linetype, weight = LAYERS[OPEN if name.endswith(f"_{OPEN}") else name.partition("_")[0]]
        document.layers.add(name, color=colour, linetype=linetype, lineweight=weight)
    return name


def _recess(
    space: "Modelspace", feature: Feature, plates: "shapely.Geometry", layer: str, curves: Curves
) -> None:
    """The edges of a recess, cut off where it is open."""
    match feature:
        case Bore():
            loops: tuple[Loop, ...] = (Loop((circle(feature.centre, feature.diameter / 2),)),)
        case Profile():
            loops = (feature.loop,)
        case Pocket():
            loops = (feature.boundary, *feature.islands)
    if isinstance(feature, OpenProfile) and feature.side == "on":
        for segment in feature.path:
            _segment(space, segment, {"layer": "CENTRE"}, simple=curves != "spline")
    for loop in loops:
        if not _on_plate(space, loop, plates, layer, curves):
            beyond = _layer(space.doc, f"{layer}_OPEN")
            _edges(space, stretches(loop, plates, outside=True), beyond, curves)


def _on_plate(
    space: "Modelspace", loop: Loop, plates: "shapely.Geometry", layer: str, curves: Curves
) -> bool:
    """A loop as far as it lies on the plates; gives whether all of it does."""
    edges = stretches(loop, plates)
    whole = edges == list(loop.segments)
    if whole:
        _loop(space, loop, layer, curves)
    else:
        _edges(space, edges, layer, curves)
    return whole


def _edges(space: "Modelspace", edges: Sequence[Segment], layer: str, curves: Curves) -> None:
    """Stretches of a loop."""
    attributes = {"layer": layer}
    for edge in edges:
        if curves in ("spline", "spline3"):
            _segment(space, edge, attributes, simple=curves == "spline3")
            continue
        if curves == "polyline":
            rows = [(x, y, 0.0) for x, y in edge.flatten(TOLERANCES.outline).tolist()]
        else:
            rows = [(corner.x, corner.y, corner.bulge) for corner in vertices(edge, TOLERANCES.arc_fit)]
            rows.append((*edge.end, 0.0))
        space.add_lwpolyline(rows, format="xyb", dxfattribs=attributes)


OPEN = "OPEN"
"""Last word of the layer on which the contour of a recess goes on beyond the plate, where it is open."""
SIZED = frozenset({"POCKET", "CHAMFER", "ENGRAVE", "THREAD", OPEN})
"""Layers that a drawing has only where there is something on them: their names go on with a size."""

THREAD_ARC = (100.0, 10.0)
"""A thread's circle runs from here on counter-clockwise, degrees: three quarters of a turn (ISO 6410-1)."""


def _detail(
    space: "Modelspace", detail: Detail, plates: "shapely.Geometry", layer: str, curves: Curves
) -> None:
    match detail:
        case Chamfer():
            for loop in chamfer_lines(detail):
                _on_plate(space, loop, plates, layer, curves)
        case Engraving():
            for stroke in detail.strokes:
                space.add_lwpolyline(stroke, dxfattribs={"layer": layer})
        case Thread():
            space.add_arc(detail.centre, detail.diameter / 2, *THREAD_ARC, dxfattribs={"layer": layer})


def _loop(space: "Modelspace", loop: Loop, layer: str, curves: Curves) -> None:
    attributes = {"layer": layer}
    first = loop.segments[0]
    if loop.is_circle and isinstance(first, Arc):
        space.add_circle(first.centre, first.radius, dxfattribs=attributes)
    elif curves == "polyline":
        space.add_lwpolyline(loop.flatten(TOLERANCES.outline).tolist(), close=True, dxfattribs=attributes)
    elif curves == "arc":
        corners = [corner for segment in loop.segments for corner in vertices(segment, TOLERANCES.arc_fit)]
        rows = [(corner.x, corner.y, corner.bulge) for corner in corners]
        space.add_lwpolyline(rows, format="xyb", close=True, dxfattribs=attributes)
    else:
        for segment in loop.segments:
            _segment(space, segment, attributes, simple=curves == "spline3")


def _segment(space: "Modelspace", segment: Segment, attributes: dict[str, str], *, simple: bool) -> None:
    match segment:
        case Line():
            space.add_line(segment.start, segment.end, dxfattribs=attributes)
        case Arc():
            # DXF arcs run counter-clockwise.
            angles = (segment.start_angle, segment.start_angle + segment.sweep)
            start, end = (math.degrees(angle) for angle in sorted(angles))
            space.add_arc(segment.centre, segment.radius, start % 360, end % 360, dxfattribs=attributes)
        case BSpline():
            curve = cubic(segment, TOLERANCES.flatten) if simple else segment
            points = [(x, y, 0.0) for x, y in curve.points]
            space.add_open_spline(points, curve.degree, curve.knots, dxfattribs=attributes)


def _centres(
    space: "Modelspace", inner: Sequence[Loop], blind_bores: Sequence[Bore], axes: Sequence[Point]
) -> None:
    bores = [loop.segments[0] for loop in inner if loop.is_circle]
    crosses = {arc.centre: arc.radius for arc in bores if isinstance(arc, Arc)}
    crosses |= {bore.centre: bore.diameter / 2 for bore in blind_bores if bore.centre not in crosses}
    for axis in axes:
        if not any(math.dist(axis, centre) <= TOLERANCES.closure for centre in crosses):
            crosses[axis] = OVERHANG
    for (x, y), radius in crosses.items():
        arm = radius + OVERHANG
        space.add_line((x - arm, y), (x + arm, y), dxfattribs={"layer": "CENTRE"})
        space.add_line((x, y - arm), (x, y + arm), dxfattribs={"layer": "CENTRE"})


def _frame(document: "Drawing", bounds: tuple[float, float, float, float]) -> None:
    """What a viewer shows when the file is opened."""
    x0, y0, x1, y1 = bounds
    document.modelspace().reset_extents((x0, y0, 0.0), (x1, y1, 0.0))
    document.set_modelspace_vport(1.2 * max(y1 - y0, x1 - x0), center=((x0 + x1) / 2, (y0 + y1) / 2))


def order_classes(document: "Drawing") -> None:
    """Bring the class table into one order; some of it comes out of sets, which differ by process."""
    document.classes.add_required_classes(document.dxfversion)
    classes = document.classes.classes
    ordered = {key: classes[key] for key in sorted(classes)}
    classes.clear()
    classes.update(ordered)


@contextmanager
def fixed_metadata() -> Iterator[None]:
    """No time stamps and random identifiers, so that the same outline gives the same bytes."""
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before
