"""A job from the front left above, as SVG: the part in its stock."""

import math
from collections.abc import Iterator

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.sections import sections
from mechwright.output import svg
from mechwright_cam.setup.job import Job

DETAIL = 0.002
"""Chord error, as a share of the stock's larger side: half of a line's width."""
_ACROSS, _UP = math.cos(math.radians(30)), math.sin(math.radians(30))
SEEN = ((0, 1), (0, 2), (1, 3), (2, 3), (0, 4), (1, 5), (2, 6), (4, 5), (4, 6))
"""Edges of a box that are seen from the front left above, by the numbers of its corners."""
_INK, _RED, _STOCK = "#1b2733", "#b00020", "#7a705c"


def isometric_view(job: Job) -> str:
    """The part as it is made, the stock around it in dashed lines, and the axes at the origin."""
    x0, y0, x1, y1 = job.stock
    size = max(x1 - x0, y1 - y0)
    thin, letters, fine = size / 350, size / 22, DETAIL * size
    drawn = []
    for layer in reversed(sections(job.part, fine, steps=0)):  # what lies deeper is covered by what is above
        shape = shapely.transform(layer.shape, lambda points: points - job.origin)
        drawn.append(_solid(shape, -layer.top, -layer.bottom, thin, fine))
    corners = [(x, y, z) for z in (0.0, -job.thickness) for x in (x0, x1) for y in (y0, y1)]
    flat = _projected(np.array(corners)).tolist()
    lines = "".join(svg.path([tuple(flat[a]), tuple(flat[b])]) for a, b in SEEN)
    dashes = f"{4 * thin:.3g} {3 * thin:.3g}"
    look = {"fill": "none", "stroke": _STOCK, "stroke_width": thin, "stroke_dasharray": dashes}
    drawn += [svg.element("path", d=lines, **look), _axes(size, letters)]
    us, vs = zip(*flat, strict=True)
    margin = 1.6 * letters
    box = (
        min(us) - margin,
        -max(vs) - margin,
        max(us) - min(us) + 2 * margin,
        max(vs) - min(vs) + 2 * margin,
    )
    return svg.picture("".join(drawn), box, f"{job.part.name} in its stock")


def _projected(points: Array) -> Array:
    """Places (n, 3) on the picture (n, 2), y upwards: X goes to the right, Y to the left, both away."""
    x, y, z = points.T
    return np.column_stack(((x - y) * _ACROSS, z + (x + y) * _UP))


def _solid(shape: shapely.Geometry, top: float, bottom: float, thin: float, fine: float) -> str:
    """A prism: its walls as far as they are seen, then its upper face."""
    face = shapely.simplify(shape, fine)
    upper, lower = _at(face, top), _at(face, bottom)
    walls = shapely.union_all([*_walls(face, top, bottom)])
    inside = shapely.difference(shapely.intersection(_filled(upper), walls), upper)
    outside = shapely.difference(walls, _filled(upper))
    dark = {"fill": "#8fa3b5", "stroke": _INK, "stroke_width": 0.6 * thin, "fill_rule": "evenodd"}
    seen = shapely.union_all([outside, inside, shapely.difference(lower, _filled(upper))])
    light = {"fill": "#c9d3dc", "stroke": _INK, "stroke_width": thin, "fill_rule": "evenodd"}
    return svg.element("path", d=_data(seen), **dark) + svg.element("path", d=_data(upper), **light)


def _at(shape: shapely.Geometry, z: float) -> shapely.Geometry:
    return shapely.transform(shape, lambda p: _projected(np.column_stack((p, np.full(len(p), z)))))


def _walls(shape: shapely.Geometry, top: float, bottom: float) -> Iterator[shapely.Geometry]:
    for ring in shapely.get_rings(shapely.get_parts(shape)):
        line = shapely.get_coordinates(ring)
        high = _projected(np.column_stack((line, np.full(len(line), top))))
        low = _projected(np.column_stack((line, np.full(len(line), bottom))))
        quads = np.stack((high[:-1], high[1:], low[1:], low[:-1]), axis=1)
        yield shapely.union_all(shapely.make_valid(shapely.polygons(quads)))


def _filled(shape: shapely.Geometry) -> shapely.Geometry:
    return shapely.union_all([shapely.Polygon(one.exterior) for one in shapely.get_parts(shape)])


def _data(shape: shapely.Geometry) -> str:
    polygons = [one for one in shapely.get_parts(shape) if one.geom_type == "Polygon"]
    rings = [ring for one in polygons for ring in shapely.get_rings(one)]
    return "".join(svg.path(shapely.get_coordinates(ring)[:-1], close=True) for ring in rings)


def _axes(size: float, letters: float) -> str:
    """X and Y at the origin, on top of the stock."""
    long = 0.18 * size
    ends = _projected(np.array([(0.0, 0.0, 0.0), (long, 0.0, 0.0), (0.0, long, 0.0), (0.0, 0.0, 0.7 * long)]))
    lines = "".join(svg.path([tuple(ends[0]), tuple(end)]) for end in ends[1:])
    look = {"fill": _RED, "text_anchor": "middle", "font_weight": "bold", "paint_order": "stroke"}
    look |= {"stroke": "#ffffff", "stroke_width": svg.number(0.25 * letters)}
    words = ""
    for (u, v), name in zip(ends[1:].tolist(), "XYZ", strict=True):
        words += svg.text(u, v + 0.3 * letters, name, letters, **look)
    return svg.element("path", d=lines, fill="none", stroke=_RED, stroke_width=0.12 * letters) + words
