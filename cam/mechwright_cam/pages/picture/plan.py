"""The plan view of a job as SVG: stock, part, holding, origin, cutter paths, and what no cutter reaches."""

import math
from collections.abc import Sequence

import shapely

from mechwright.contracts.details import Chamfer, Engraving, Thread, chamfer_lines
from mechwright.contracts.sections import sections
from mechwright.designs.inches import Units
from mechwright.geometry.segments import Point
from mechwright.output import svg
from mechwright_cam.pages.picture.dimensions import dimensions, ends_of_words, origin_mark
from mechwright_cam.pages.picture.frame import DETAIL, Frame, outline_data
from mechwright_cam.pages.picture.paths import path_layers
from mechwright_cam.pages.trace import Traced
from mechwright_cam.planning.holding_force import holding
from mechwright_cam.program.moves import Program
from mechwright_cam.setup.clamping import SCREW, strap_box
from mechwright_cam.setup.holding import Tab
from mechwright_cam.setup.job import Job
from mechwright_plane.nest import Nest

THREAD_ENDS = (math.radians(100.0), math.radians(10.0))
"""A thread's circle is drawn from here on for three quarters of a turn, as drawings do (ISO 6410-1)."""

JAW = 1.2
"""So much of a vice's jaws is drawn, in heights of letters: up to the first dimension."""


def plan_view(
    job: Job,
    program: Program | None = None,
    traced: Sequence[Traced] = (),
    spots: Sequence[Point] = (),
    units: Units = "mm",
) -> str:
    """A job seen from above, as an ``<svg>`` element that scales to its container.

    With a program its strokes are drawn; ``spots`` are places to mark, work coordinates, mm.
    """
    x0, y0, x1, y1 = job.stock
    frame = Frame(x0, y0, x1, y1, units)
    layers = [_stock(job), _part(job, frame)]
    if program is not None:
        layers += path_layers(program, traced, frame)
    layers += [_holding(job, frame), dimensions(job, frame), origin_mark(frame), _spots(spots, frame)]
    layers.append(_names(job, frame))
    margin = 4.6 * frame.letters
    # Words that do not fit between the arrows of a short dimension stand beyond its far end.
    right = max([margin, *(at - x1 for at in ends_of_words(job, frame, 0))])
    above = max([margin, *(at - y1 for at in ends_of_words(job, frame, 1))])
    box = (x0 - margin, -y1 - above, x1 - x0 + margin + right, y1 - y0 + above + margin)
    return svg.picture("\n".join(filter(None, layers)), box, f"Plan view of {job.part.name}")


def _stock(job: Job) -> str:
    x0, y0, x1, y1 = job.stock
    return svg.element(
        "rect",
        x=x0, y=-y1, width=x1 - x0, height=y1 - y0, fill="#f1ece2", stroke="#7a705c", stroke_width=_thin(job),
    )  # fmt: skip


def _thin(job: Job) -> float:
    x0, y0, x1, y1 = job.stock
    return max(0.06, 0.0022 * max(x1 - x0, y1 - y0))


def _part(job: Job, frame: Frame) -> str:
    plate = svg.element(
        "path",
        d=outline_data(job), fill="#c9d3dc", fill_rule="evenodd",
        stroke="#1b2733", stroke_width=0.08 * frame.letters,
    )  # fmt: skip
    return plate + _gone(job, frame) + _recesses(job, frame) + _details(job, frame)


def _names(job: Job, frame: Frame) -> str:
    """In a nest, which part is which."""
    if not isinstance(job.part, Nest):
        return ""
    words = []
    for one in job.part.placed:
        middle = one.outline.polygon().representative_point()
        x, y = middle.x - job.origin[0], middle.y - job.origin[1]
        if abs(y) < frame.letters and x > 0:  # below the axis X
            y -= 1.6 * frame.letters
        words.append(_tag(x, y, one.label, frame))
    return "".join(words)


def _gone(job: Job, frame: Frame) -> str:
    """What an earlier setup has cut through."""
    data = _data(shapely.simplify(job.air_below(0.0), DETAIL))
    look = {"fill": "#ffffff", "fill_rule": "evenodd", "stroke": "#1b2733"}
    return svg.element("path", d=data, **look, stroke_width=0.05 * frame.letters) if data else ""


def _recesses(job: Job, frame: Frame) -> str:
    """The floors of recesses, darker the deeper they lie."""
    whole = job.target
    layers = []
    for layer in sections(job.part, DETAIL, steps=0)[:-1]:
        taken = shapely.difference(whole, shapely.transform(layer.shape, lambda p: p - job.origin))
        if data := _data(taken):
            look = {"fill": "#5f7688", "fill_opacity": 0.4, "fill_rule": "evenodd", "stroke": "#1b2733"}
            layers.append(svg.element("path", d=data, **look, stroke_width=0.04 * frame.letters))
    return "".join(layers)


def _data(shape: shapely.Geometry) -> str:
    """Path data of all rings of a shape."""
    rings = shapely.get_rings(shapely.get_parts(shape))
    return "".join(svg.path(shapely.get_coordinates(ring)[:-1], close=True) for ring in rings)


def _details(job: Job, frame: Frame) -> str:
    """Where chamfers end, strokes of engravings, and three quarters of each thread's circle."""
    data = []
    for detail in job.details:
        match detail:
            case Chamfer():
                data += [svg.path(loop.flatten(DETAIL), close=True) for loop in chamfer_lines(detail)]
            case Engraving():
                data += [svg.path(stroke) for stroke in detail.strokes]
            case Thread():
                (x, y), r = detail.centre, detail.diameter / 2
                start, end = ((x + r * math.cos(a), y + r * math.sin(a)) for a in THREAD_ENDS)
                data.append("M" + svg.place(*start) + svg.arc_to(start, end, (x, y), ccw=True))
    look = {"fill": "none", "stroke": "#1b2733", "stroke_width": 0.04 * frame.letters}
    return svg.element("path", d="".join(data), **look) if data else ""


def _holding(job: Job, frame: Frame) -> str:
    parts = _on_waste(job, frame)
    for place, tab in enumerate(job.tabs, start=1):
        shape = svg.path(list(tab.shape.exterior.coords)[:-1], close=True)
        level = svg.path(list(tab.level.exterior.coords)[:-1], close=True)
        if tab.ramped:
            parts.append(svg.element("path", d=shape, fill="#e6a100", fill_opacity=0.35))
        parts.append(svg.element("path", d=level, fill="#e6a100", fill_opacity=0.75))
        if not isinstance(job.part, Nest):  # there they would hide each other; the legend has the colour
            parts.append(_tag(*_outer_end(job, tab), f"tab {place}", frame))
    for jaw in job.jaws:
        x0, y0, x1, y1 = shapely.intersection(jaw.shape, _around(job, JAW * frame.letters)).bounds
        look = {"fill": "#e6a100", "fill_opacity": 0.45, "stroke": "#8a6100", "stroke_width": _thin(job)}
        parts.append(svg.element("rect", x=x0, y=-y1, width=x1 - x0, height=y1 - y0, **look))
        parts.append(_tag((x0 + x1) / 2, (y0 + y1) / 2, "jaw", frame))
    for toe in job.toes:
        x0, y0, x1, y1 = toe.shape.bounds
        look = {"fill": "#e6a100", "fill_opacity": 0.45, "stroke": "#8a6100", "stroke_width": _thin(job)}
        parts.append(svg.element("rect", x=x0, y=-y1, width=x1 - x0, height=y1 - y0, **look))
        parts.append(_tag((x0 + x1) / 2, (y0 + y1) / 2, f"clamp {toe.number}", frame))
    if job.clamp is not None:
        x, y = job.clamp.centre
        circle = {"cx": x, "cy": -y, "r": job.clamp.diameter / 2}
        parts.append(svg.element("circle", **circle, fill="#e6a100", fill_opacity=0.45, stroke="#8a6100"))
        parts.append(_tag(x, y - job.clamp.diameter / 2 + frame.letters, "clamp", frame))
    return "".join(parts)


def _on_waste(job: Job, frame: Frame) -> list[str]:
    """The straps on the rim, or the screws through the waste, as the sheet proposes them."""
    if job.jaws or job.toes or (way := holding(job).way) is None:
        return []
    look = {"fill": "#e6a100", "fill_opacity": 0.45, "stroke": "#8a6100", "stroke_width": _thin(job)}
    parts = []
    for strap in way.straps:
        x0, y0, x1, y1 = strap_box(job, strap)
        parts.append(svg.element("rect", x=x0, y=-y1, width=x1 - x0, height=y1 - y0, **look))
        parts.append(_tag((x0 + x1) / 2, (y0 + y1) / 2, "M8", frame))
    for x, y in way.screws:
        parts.append(svg.element("circle", cx=x, cy=-y, r=SCREW, **look))
        parts.append(_tag(x, y, f"M{SCREW:g}", frame))
    return parts


def _around(job: Job, width: float) -> shapely.Polygon:
    """The stock and so much around it."""
    x0, y0, x1, y1 = job.stock
    return shapely.box(x0 - width, y0 - width, x1 + width, y1 + width)


def _outer_end(job: Job, tab: Tab) -> Point:
    """A place for a tab's name: on the tab, towards the frame."""
    own = min(shapely.get_parts(job.target), key=lambda part: float(shapely.distance(part, tab.shape)))
    middle, centre = own.centroid, tab.shape.centroid
    far = max(tab.shape.exterior.coords, key=lambda p: math.hypot(p[0] - middle.x, p[1] - middle.y))
    if isinstance(job.part, Nest):  # the neighbour's tab may end where this one does
        return centre.x, centre.y
    return (centre.x + 2 * far[0]) / 3, (centre.y + 2 * far[1]) / 3


def _tag(x: float, y: float, words: str, frame: Frame) -> str:
    size = 0.8 * frame.letters
    halo = {"paint_order": "stroke", "stroke": "#ffffff", "stroke_width": 0.25 * size}
    return svg.text(
        x, y - size / 3, words, size, text_anchor="middle", fill="#5c4000", font_weight="bold", **halo
    )


def _spots(spots: Sequence[Point], frame: Frame) -> str:
    look = {"fill": "none", "stroke": "#d4001a", "stroke_width": 0.1 * frame.letters}
    return "".join(svg.element("circle", cx=x, cy=-y, r=0.5 * frame.letters, **look) for x, y in spots)
