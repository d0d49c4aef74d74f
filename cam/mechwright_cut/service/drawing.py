"""The drawing that a service cuts: closed contours alone, true to size, in millimetres. Imports ezdxf.

One layer, CUT, and one more, ENGRAVE, where the service takes marks. A contour is one closed polyline of
lines and arcs, or a circle; there is no text, no centre line, nothing that must not be cut.
"""

import math

from ezdxf import units
from ezdxf.filemanagement import new

from mechwright.geometry import Arc, Loop
from mechwright.tolerances import TOLERANCES
from mechwright_cad.exporters.curves import vertices
from mechwright_cad.exporters.dxf import finished, fixed_metadata
from mechwright_cut.jobs import CutPart
from mechwright_cut.paths.parallels import beam_path
from mechwright_cut.settings.services import ServiceRules

CUT, ENGRAVE = "CUT", "ENGRAVE"
"""Layers."""
SUFFIX = "-cut.dxf"

Row = tuple[float, float, float]
"""x, y, mm, and the bulge of the piece that follows."""


def service_drawing(cut: CutPart, rules: ServiceRules) -> bytes:
    """The drawing of a part for a service; raises GeometryError where its kerf is wider than a slot."""
    offset = rules.offset(cut.part.material)
    with fixed_metadata():
        document = new(rules.dxf, units=units.MM)
        document.header["$MEASUREMENT"] = 1
        document.layers.add(CUT, color=1)
        space = document.modelspace()
        for loop in cut.outline.loops:
            first = loop.segments[0]
            if loop.is_circle and isinstance(first, Arc):
                radius = first.radius + (offset if loop.area > 0 else -offset)
                space.add_circle(first.centre, radius, dxfattribs={"layer": CUT})
            else:
                rows = _rows(loop, offset, cut.part.name)
                space.add_lwpolyline(rows, format="xyb", close=True, dxfattribs={"layer": CUT})
        if rules.engraves and cut.strokes:
            document.layers.add(ENGRAVE, color=5)
            for stroke in cut.strokes:
                space.add_lwpolyline(stroke, dxfattribs={"layer": ENGRAVE})
        return finished(document, cut.outline.bounds, "")


def _rows(loop: Loop, offset: float, name: str) -> list[Row]:
    if offset == 0:
        corners = [corner for one in loop.segments for corner in vertices(one, TOLERANCES.arc_fit)]
        return [(corner.x, corner.y, corner.bulge) for corner in corners]
    rows: list[Row] = []
    for here, cut, _ in beam_path(loop, 2 * offset, loop.area > 0, name).walk():
        if not cut.turn:
            rows.append((*here, 0.0))
            continue
        pieces = vertices(_arc(here, (cut.cx, cut.cy), cut.turn, cut.length), TOLERANCES.arc_fit)
        rows += [(one.x, one.y, one.bulge) for one in pieces]
    return rows


def _arc(start: tuple[float, float], centre: tuple[float, float], turn: int, length: float) -> Arc:
    radius = math.dist(start, centre)
    return Arc(centre, radius, math.atan2(start[1] - centre[1], start[0] - centre[0]), turn * length / radius)
