"""The plan view of a job as SVG: stock, part, holding, origin, cutter paths, and what no cutter reaches."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import shapely

from mechwright.cutter import cutter
from mechwright.details import Chamfer, Engraving, Thread, chamfer_lines
from mechwright.geometry.segments import Point
from mechwright.program import Program
from mechwright.sections import sections
from mechwright.tooling import Tool
from mechwright_cam import svg
from mechwright_cam.job import Job
from mechwright_cam.nest import Nest, outlines_of
from mechwright_cam.tabs import Tab
from mechwright_cam.trace import Stroke, Traced, trace

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8c6bb1", "#b8860b", "#56b4e9", "#5d5d5d")
"""One per tool, told apart by colour-blind eyes as well (after Okabe and Ito)."""

DETAIL = 0.02
"""Chord error of outlines in pictures, mm."""

WIDE = 0.58
"""Width of a letter in its height, on average, generously."""

LETTERS = 0.026
"""Height of letters as a share of the picture's larger side."""

THREAD_ENDS = (math.radians(100.0), math.radians(10.0))
"""A thread's circle is drawn from here on for three quarters of a turn, as drawings do (ISO 6410-1)."""

SAME = 2
"""Decimals, mm: paths that lie over one another this closely (passes at several depths) are drawn once."""


@dataclass(frozen=True)
class Frame:
    """The drawn region, work coordinates, mm, and sizes that follow from it."""

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def letters(self) -> float:
        """Height of letters, mm."""
        return LETTERS * max(self.x1 - self.x0, self.y1 - self.y0)


def tool_colours(program: Program) -> dict[int, str]:
    """T number to the colour of its paths."""
    return {tool.number: COLOURS[i % len(COLOURS)] for i, tool in enumerate(program.tools)}


JAW = 1.2
"""So much of a vice's jaws is drawn, in heights of letters: up to the first dimension."""


def plan_view(
    job: Job,
    program: Program | None = None,
    spots: Sequence[Point] = (),
    traced: Sequence[Traced] | None = None,
) -> str:
    """A job seen from above.

    Parameters
    ----------
    job
        Part, stock, holding.
    program
        The paths to draw; None for a picture of the job alone.
    spots
        Places to mark, work coordinates, mm.
    traced
        The program's strokes, if they are known already.

    Returns
    -------
    svg
        An ``<svg>`` element that scales to its container.
    """
    x0, y0, x1, y1 = job.stock
    frame = Frame(x0, y0, x1, y1)
    layers = [_stock(job), _part(job, frame)]
    if program is not None:
        layers += _paths(program, trace(program) if traced is None else traced, frame)
    layers += [_holding(job, frame), _dimensions(job, frame), _origin(frame), _spots(spots, frame)]
    margin = 4.6 * frame.letters
    # Words that do not fit between the arrows of a short dimension stand beyond its far end.
    right = max([margin, *(at - x1 for at in _ends(job, frame, 0))])
    above = max([margin, *(at - y1 for at in _ends(job, frame, 1))])
    box = (x0 - margin, -y1 - above, x1 - x0 + margin + right, y1 - y0 + above + margin)
    return svg.element(
        "svg",
        "\n".join(layer for layer in layers if layer),
        xmlns="http://www.w3.org/2000/svg",
        viewBox=" ".join(svg.number(value) for value in box),
        font_family="Helvetica, Arial, sans-serif",
        role="img",
        aria_label=f"Plan view of {job.part.name}",
    )


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
    placed = [outline.moved(-job.origin[0], -job.origin[1]) for outline in outlines_of(job.part)]
    data = "".join(svg.path(loop.flatten(DETAIL), close=True) for one in placed for loop in one.loops)
    plate = svg.element(
        "path",
        d=data, fill="#c9d3dc", fill_rule="evenodd", stroke="#1b2733", stroke_width=0.08 * frame.letters,
    )  # fmt: skip
    return plate + _gone(job, frame) + _recesses(job, frame) + _details(job, frame) + _names(job, frame)


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
    rings = shapely.get_rings(shapely.get_parts(shapely.simplify(job.air_below(0.0), DETAIL)))
    data = "".join(svg.path(shapely.get_coordinates(ring)[:-1], close=True) for ring in rings)
    look = {"fill": "#ffffff", "fill_rule": "evenodd", "stroke": "#1b2733"}
    return svg.element("path", d=data, **look, stroke_width=0.05 * frame.letters) if data else ""


def _recesses(job: Job, frame: Frame) -> str:
    """The floors of recesses, darker the deeper they lie."""
    whole = job.target
    layers = []
    for layer in sections(job.part, DETAIL, steps=0)[:-1]:
        taken = shapely.difference(whole, shapely.transform(layer.shape, lambda p: p - job.origin))
        rings = [ring for part in shapely.get_parts(taken) for ring in shapely.get_rings(part)]
        data = "".join(svg.path(shapely.get_coordinates(ring)[:-1], close=True) for ring in rings)
        if data:
            look = {"fill": "#5f7688", "fill_opacity": 0.4, "fill_rule": "evenodd", "stroke": "#1b2733"}
            layers.append(svg.element("path", d=data, **look, stroke_width=0.04 * frame.letters))
    return "".join(layers)


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
    parts = []
    for place, tab in enumerate(job.tabs, start=1):
        shape = svg.path(list(tab.shape.exterior.coords)[:-1], close=True)
        level = svg.path(list(tab.level.exterior.coords)[:-1], close=True)
        if tab.ramped:
            parts.append(svg.element("path", d=shape, fill="#e6a100", fill_opacity=0.35))
        parts.append(svg.element("path", d=level, fill="#e6a100", fill_opacity=0.75))
        parts.append(_tag(*_outer_end(job, tab), f"tab {place}", frame))
    for jaw in job.jaws:
        x0, y0, x1, y1 = shapely.intersection(jaw.shape, _around(job, JAW * frame.letters)).bounds
        look = {"fill": "#e6a100", "fill_opacity": 0.45, "stroke": "#8a6100", "stroke_width": _thin(job)}
        parts.append(svg.element("rect", x=x0, y=-y1, width=x1 - x0, height=y1 - y0, **look))
        parts.append(_tag((x0 + x1) / 2, (y0 + y1) / 2, "jaw", frame))
    if job.clamp is not None:
        x, y = job.clamp.centre
        circle = {"cx": x, "cy": -y, "r": job.clamp.diameter / 2}
        parts.append(svg.element("circle", **circle, fill="#e6a100", fill_opacity=0.45, stroke="#8a6100"))
        parts.append(_tag(x, y - job.clamp.diameter / 2 + frame.letters, "clamp", frame))
    return "".join(parts)


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


def _paths(program: Program, traced: Sequence[Traced], frame: Frame) -> list[str]:
    colours = tool_colours(program)
    layers = []
    for tool in program.tools:
        mine = [item for item in traced if item.section.tool.number == tool.number]
        cuts, rapids, holes = _path_data(mine)
        name = f"{program.name}-t{tool.number}"
        pen = {
            "fill": "none",
            "stroke": colours[tool.number],
            "stroke_linejoin": "round",
            "stroke_linecap": "round",
        }
        width = 0.09 * frame.letters
        if rapids:
            dashes = f"{svg.number(4 * width)} {svg.number(4 * width)}"
            look = {"stroke_width": 0.6 * width, "stroke_dasharray": dashes, "opacity": 0.55}
            layers.append(svg.element("path", d=rapids, **pen, **look))
        if cuts:
            layers.append(svg.element("defs", svg.element("path", id=name, d=cuts)))
            layers.append(
                svg.element("use", href=f"#{name}", **pen, stroke_width=_swath(tool, mine), opacity=0.16)
            )
            layers.append(svg.element("use", href=f"#{name}", **pen, stroke_width=width))
        arm = max(tool.radius, 0.4 * frame.letters)
        for x, y in holes:
            level = f"M{svg.place(x - arm, y)}H{svg.number(x + arm)}"
            cross = level + f"M{svg.place(x, y - arm)}V{svg.number(-y - arm)}"
            layers.append(svg.element("path", d=cross, **pen, stroke_width=width))
            layers.append(svg.element("circle", cx=x, cy=-y, r=tool.radius, **pen, stroke_width=width))
    return layers


def _swath(tool: Tool, items: Sequence[Traced]) -> float:
    """Width of what a tool cuts at the top face, mm: near its tip it may be narrower than its diameter."""
    depth = -min((item.bottom for item in items if item.bottom is not None), default=-math.inf)
    return 2 * float(cutter(tool).radius_at(depth))


def _path_data(items: Sequence[Traced]) -> tuple[str, str, list[Point]]:
    """Cuts and rapids as path data, and the holes; what lies over one another counts once."""
    drawn: set[tuple[object, ...]] = set()
    data: dict[bool, list[str]] = {True: [], False: []}
    pens: dict[bool, Point | None] = {True: None, False: None}
    holes: dict[Point, None] = {}
    for item in items:
        for stroke in item.strokes:
            if stroke.drilled:
                holes[(round(stroke.end[0], SAME), round(stroke.end[1], SAME))] = None
                continue
            key = _key(stroke)
            if key is None or key in drawn:
                continue
            drawn.add(key)
            cutting = stroke.feed > 0
            start, end = stroke.start[:2], stroke.end[:2]
            if pens[cutting] != start:
                data[cutting].append("M" + svg.place(*start))
            if stroke.centre is None:
                data[cutting].append("L" + svg.place(*end))
            else:
                data[cutting].append(svg.arc_to(start, end, stroke.centre, ccw=stroke.ccw))
            pens[cutting] = end
    return "".join(data[True]), "".join(data[False]), list(holes)


def _key(stroke: Stroke) -> tuple[object, ...] | None:
    """What a stroke looks like from above; None for one that is a point."""
    start, end = (tuple(round(value, SAME) for value in place[:2]) for place in (stroke.start, stroke.end))
    if stroke.centre is None:
        return None if start == end else (start, end, stroke.feed > 0)
    return start, end, tuple(round(value, SAME) for value in stroke.centre), stroke.ccw


@dataclass(frozen=True)
class _Dimension:
    """A length along X (``axis`` 0) or Y (1), ``at`` across, measured from the ``edge``."""

    axis: int
    ends: tuple[float, float]
    at: float
    edge: float
    words: str
    colour: str = "#333333"

    def length(self, size: float) -> float:
        """Of the words, mm."""
        return WIDE * size * len(self.words)

    def fits(self, size: float) -> bool:
        """Whether the words have room between the arrows."""
        return self.length(size) <= self.ends[1] - self.ends[0]

    def middle(self, size: float) -> float:
        """Where the middle of the words stands along the axis, mm."""
        if self.fits(size):
            return (self.ends[0] + self.ends[1]) / 2
        return self.ends[1] + AWAY * size + self.length(size) / 2


AWAY = 1.3
"""Words beyond a short dimension stand so many heights away from it, past its arrow."""


def _listed(job: Job, frame: Frame) -> list[_Dimension]:
    x0, y0, x1, y1 = job.stock
    px0, py0, px1, py1 = job.target.bounds
    step = 1.7 * frame.letters
    what = "parts" if isinstance(job.part, Nest) else "part"
    rows = [
        _Dimension(0, (x0, x1), y0 - 2 * step, y0, f"stock {x1 - x0:.1f}"),
        _Dimension(0, (px0, px1), y1 + step, y1, f"{what} {px1 - px0:.2f}"),
        _Dimension(1, (y0, y1), x0 - 2 * step, x0, f"stock {y1 - y0:.1f}"),
        _Dimension(1, (py0, py1), x1 + step, x1, f"{what} {py1 - py0:.2f}"),
    ]
    # How far the origin is from the edges that are probed, unless it is on them.
    if x0 < 0:
        rows.append(_Dimension(0, (x0, 0.0), y0 - step, y0, f"{-x0:.2f}", "#b00020"))
    if y0 < 0:
        rows.append(_Dimension(1, (y0, 0.0), x0 - step, x0, f"{-y0:.2f}", "#b00020"))
    return rows


def _ends(job: Job, frame: Frame, axis: int) -> list[float]:
    """Where the words of the dimensions along an axis end, mm."""
    size = frame.letters
    return [d.middle(size) + d.length(size) / 2 + size for d in _listed(job, frame) if d.axis == axis]


def _dimensions(job: Job, frame: Frame) -> str:
    size = frame.letters
    return "".join(_drawn(dimension, size) for dimension in _listed(job, frame))


def _drawn(one: _Dimension, size: float) -> str:
    """Extension lines, the line between arrows, and words on its upper or left side."""
    (a, b), at = one.ends, one.at
    beyond = at + math.copysign(0.4 * size, at - one.edge)
    middle, colour = one.middle(size), one.colour
    # Arrows of a short dimension come from outside.
    out = 0.0 if one.fits(size) else AWAY * size
    first, last = a - out, b + out

    def place(along: float, across: float) -> Point:
        return (along, across) if one.axis == 0 else (across, along)

    lines = "".join(f"M{svg.place(*place(end, one.edge))}L{svg.place(*place(end, beyond))}" for end in (a, b))
    main = f"M{svg.place(*place(first, at))}L{svg.place(*place(last, at))}"
    look = {"text_anchor": "middle", "fill": colour}
    if not one.fits(size):  # there may be lines of other dimensions behind
        look |= {"paint_order": "stroke", "stroke": "#ffffff", "stroke_width": svg.number(0.25 * size)}
    if one.axis == 0:
        label = svg.text(middle, at + 0.3 * size, one.words, size, **look)
    else:
        spot = (at - 0.3 * size, middle)
        turn = f"rotate(-90 {svg.number(spot[0])} {svg.number(-spot[1])})"
        label = svg.text(*spot, one.words, size, transform=turn, **look)
    heads = _heads(place(a, at), place(b, at), colour, size, inwards=out > 0)
    return _dimension_lines(lines, main, colour, size) + heads + label


def _dimension_lines(thin: str, main: str, colour: str, size: float) -> str:
    return svg.element("path", d=thin + main, fill="none", stroke=colour, stroke_width=0.05 * size)


def _heads(a: Point, b: Point, colour: str, size: float, *, inwards: bool = False) -> str:
    length = math.hypot(b[0] - a[0], b[1] - a[1]) or 1.0
    turn = -1 if inwards else 1
    ux, uy = turn * (b[0] - a[0]) / length, turn * (b[1] - a[1]) / length
    return _head(a, (-ux, -uy), colour, size) + _head(b, (ux, uy), colour, size)


def _head(tip: Point, direction: Point, colour: str, size: float) -> str:
    """An arrow head at ``tip`` that points along the unit vector ``direction``."""
    (x, y), (ux, uy) = tip, direction
    back, across = (x - 0.7 * size * ux, y - 0.7 * size * uy), 0.16 * size
    corners = [
        tip,
        (back[0] - across * uy, back[1] + across * ux),
        (back[0] + across * uy, back[1] - across * ux),
    ]
    return svg.element("path", d=svg.path(corners, close=True), fill=colour)


def _origin(frame: Frame) -> str:
    """The quartered circle of a datum at X0 Y0, and the axes."""
    size = frame.letters
    r = 0.75 * size
    # On a slim plate the axes end before the words of the part's dimensions.
    right, above = (max(1.2 * r, min(3.4 * size, end - 1.2 * size)) for end in (frame.x1, frame.y1))
    quarter = f"M0,0V{svg.number(-r)}A{svg.number(r)} {svg.number(r)} 0 0 1 {svg.place(r, 0)}Z"
    other = f"M0,0V{svg.number(r)}A{svg.number(r)} {svg.number(r)} 0 0 1 {svg.place(-r, 0)}Z"
    axes = f"M0,0H{svg.number(right)}M0,0V{svg.number(-above)}"
    red = "#b00020"
    halo = {"paint_order": "stroke", "stroke": "#ffffff", "stroke_width": 0.3 * size, "font_weight": "bold"}
    return "".join(
        [
            svg.element("path", d=axes, stroke=red, stroke_width=0.12 * size),
            _head((right + 0.5 * size, 0.0), (1.0, 0.0), red, size),
            _head((0.0, above + 0.5 * size), (0.0, 1.0), red, size),
            svg.element("circle", cx=0, cy=0, r=r, fill="#ffffff", stroke=red, stroke_width=0.12 * size),
            svg.element("path", d=quarter + other, fill=red),
            svg.text(right + 0.9 * size, -0.35 * size, "X", size, fill=red, **halo),
            svg.text(0.0, above + 0.8 * size, "Y", size, fill=red, text_anchor="middle", **halo),
        ]
    )


def _spots(spots: Sequence[Point], frame: Frame) -> str:
    look = {"fill": "none", "stroke": "#d4001a", "stroke_width": 0.1 * frame.letters}
    return "".join(svg.element("circle", cx=x, cy=-y, r=0.5 * frame.letters, **look) for x, y in spots)
