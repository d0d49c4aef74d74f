"""Checks a drawing as a service would: by its file alone, and by the rules that the service publishes.

It shares no code with the drawing: it reads the file with ezdxf, makes polygons of it, and compares those
with the outline that is wanted.
"""

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely
from ezdxf.document import Drawing
from ezdxf.entities.circle import Circle
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.filemanagement import read
from ezdxf.lldxf.const import DXFError

from mechwright.geometry import Outline
from mechwright.tolerances import TOLERANCES
from mechwright_cut.settings.services import ServiceRules

LAYERS = frozenset({"CUT", "ENGRAVE"})
VERSIONS = {"R2000": "AC1015", "R2010": "AC1024"}
CHORD = 0.0005
"""Chord error of arcs as they are compared, mm."""
WALL = TOLERANCES.gouge
"""Largest distance of a contour from the outline, mm."""
FORM = 0.02
"""A polygon whose corners are so nearly on one circle, in radii, is a round hole."""


@dataclass(frozen=True)
class Drawn:
    """What a drawing has to show; lengths in mm.

    ``offset`` is by how much a path stands off the outline: half the kerf where the designer allows for it.
    """

    outline: Outline
    thickness: float
    offset: float = 0.0
    waterjet: bool = False


def faults(content: bytes, wanted: Drawn, rules: ServiceRules) -> list[str]:
    """What a service would refuse, or cut wrong; nothing of a good drawing."""
    try:
        document = read(io.StringIO(content.decode("utf-8")))
    except (DXFError, UnicodeDecodeError, ValueError) as error:
        return [f"the file cannot be read: {error}"]
    found = _file(document, rules)
    entities = list(document.modelspace())
    found += [said for one in entities for said in _entity(one, rules)]
    rings = _rings(entities)
    if bad := [ring for ring in rings if not shapely.is_valid(ring) or ring.area <= 0]:
        return [*found, f"{len(bad)} contours cross themselves"]
    if not rings:
        return [*found, "nothing is to be cut"]
    rings.sort(key=lambda ring: -ring.area)
    return [*found, *_nested(rings), *_sizes(rings, wanted, rules), *_compared(rings, wanted)]


def drawn_rings(content: bytes) -> list[shapely.Polygon]:
    """The contours that a drawing has cut, filled; chords of arcs within CHORD."""
    return _rings(list(read(io.StringIO(content.decode("utf-8"))).modelspace()))


def _rings(entities: Sequence[DXFEntity]) -> list[shapely.Polygon]:
    return [shapely.Polygon(_points(one)) for one in entities if _cut(one)]


def _file(document: Drawing, rules: ServiceRules) -> list[str]:
    found = []
    if document.dxfversion != VERSIONS[rules.dxf]:
        found.append(f"{rules.words} asks for DXF {rules.dxf}, and it is {document.dxfversion}")
    if document.header.get("$INSUNITS") != 4 or document.header.get("$MEASUREMENT") != 1:
        found.append("the units are not millimetres")
    return found


def _cut(entity: DXFEntity) -> bool:
    return isinstance(entity, Circle | LWPolyline) and entity.dxf.layer == "CUT"


def _entity(entity: DXFEntity, rules: ServiceRules) -> list[str]:
    kind, layer = entity.dxftype(), entity.dxf.layer
    if layer not in LAYERS or (layer == "ENGRAVE" and not rules.engraves):
        return [f"layer {layer} must not be there"]
    if not isinstance(entity, Circle | LWPolyline):
        return [f"a {kind} on layer {layer}: closed polylines and circles alone are cut"]
    if layer == "CUT" and isinstance(entity, LWPolyline) and not entity.closed:
        return [f"a contour at {_where(_points(entity)[0])} is open"]
    return []


def _where(point: np.ndarray) -> str:
    return f"({point[0]:.2f}, {point[1]:.2f})"


def _points(entity: DXFEntity) -> np.ndarray:
    """Points (n, 2) along a contour, chords within CHORD."""
    if isinstance(entity, Circle):
        centre, radius = np.array(entity.dxf.center)[:2], float(entity.dxf.radius)
        return centre + radius * _round(0.0, math.tau, radius)
    assert isinstance(entity, LWPolyline)  # noqa: S101 - nothing else is asked
    rows = [(float(x), float(y), float(b)) for x, y, b in entity.get_points("xyb")]
    parts = []
    for (x0, y0, bulge), (x1, y1, _) in zip(rows, [*rows[1:], rows[0]], strict=True):
        if bulge == 0 or math.hypot(x1 - x0, y1 - y0) == 0:
            parts.append(np.array([(x0, y0)]))
            continue
        # The sagitta of a piece is half its chord times the bulge.
        half = math.hypot(x1 - x0, y1 - y0) / 2
        radius = half * (1 + bulge**2) / (2 * abs(bulge))
        to_centre = half * (1 - bulge**2) / (2 * bulge)
        cx = (x0 + x1) / 2 - to_centre * (y1 - y0) / (2 * half)
        cy = (y0 + y1) / 2 + to_centre * (x1 - x0) / (2 * half)
        begin = math.atan2(y0 - cy, x0 - cx)
        parts.append(np.array((cx, cy)) + radius * _round(begin, 4 * math.atan(bulge), radius)[:-1])
    return np.concatenate(parts)


def _round(begin: float, sweep: float, radius: float) -> np.ndarray:
    step = 2 * math.acos(max(1 - CHORD / radius, 0.0))
    angle = begin + np.linspace(0.0, sweep, max(3, math.ceil(abs(sweep) / step)) + 1)
    return np.column_stack((np.cos(angle), np.sin(angle)))


def _nested(rings: list[shapely.Polygon]) -> list[str]:
    """One part a file: one contour around all others, none of which meets another."""
    outer, *inner = rings
    found = [
        f"the contour at {_where(np.array(one.centroid.coords[0]))} lies outside the part"
        for one in inner
        if not shapely.contains(outer, one)
    ]
    for one, two in combinations(inner, 2):
        if shapely.equals_exact(one, two, TOLERANCES.outline):
            found.append(f"a contour at {_where(np.array(one.centroid.coords[0]))} is there twice")
        elif shapely.intersects(one, two):
            found.append(f"two contours overlap at {_where(np.array(one.centroid.coords[0]))}")
    return found


def _sizes(rings: list[shapely.Polygon], wanted: Drawn, rules: ServiceRules) -> list[str]:
    outer, *inner = rings
    least, web = rules.least_hole(wanted.thickness, wanted.waterjet), rules.least_web(wanted.thickness)
    found = []
    x0, y0, x1, y1 = outer.bounds
    if max(x1 - x0, y1 - y0) < rules.part:
        size = max(x1 - x0, y1 - y0)
        found.append(f"{rules.words} takes parts of {rules.part:g} mm and more, not of {size:.2f}")
    for hole in inner:
        size = 2 * (math.sqrt(hole.area / math.pi) + wanted.offset)
        if _is_round(hole) and size < least - WALL:
            at = _where(np.array(hole.centroid.coords[0]))
            found.append(
                f"the hole of {size:.2f} mm at {at} is below the least of {rules.words}, {least:g} mm"
            )
    for one, two in combinations(rings, 2):
        off = float(shapely.distance(one.exterior, two.exterior)) + 0.0
        if 0 < off < web - WALL:
            at = _where(np.array(shapely.shortest_line(one.exterior, two.exterior).coords[0]))
            found.append(f"{off:.2f} mm stay between two contours at {at}; {rules.words} asks for {web:g} mm")
    return found


def _is_round(hole: shapely.Polygon) -> bool:
    return bool(abs(4 * math.pi * hole.area / hole.length**2 - 1) < FORM)


def _compared(rings: list[shapely.Polygon], wanted: Drawn) -> list[str]:
    """The drawn contours against the parallels of the outline."""
    loops = sorted(wanted.outline.loops, key=lambda loop: -abs(loop.area))
    if len(loops) != len(rings):
        return [f"{len(rings)} contours are drawn, and the part has {len(loops)}"]
    found = []
    for loop in loops:
        aim = shapely.Polygon(loop.flatten())
        if wanted.offset:
            aim = shapely.buffer(aim, wanted.offset if loop.area > 0 else -wanted.offset, quad_segs=256)
        grown, shrunk = shapely.buffer(aim, WALL), shapely.buffer(aim, -WALL)
        if not any(shapely.covers(grown, ring) and shapely.covers(ring, shrunk) for ring in rings):
            at = _where(np.array(aim.centroid.coords[0]))
            found.append(f"no contour is within {1000 * WALL:g} µm of the one at {at}")
    return found
