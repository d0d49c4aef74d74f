"""Cutter paths in the plan view: what each tool cuts, its rapids, and its holes."""

import math
from collections.abc import Sequence

from mechwright.geometry.segments import Point
from mechwright.output import svg
from mechwright_cam.pages.picture.frame import Frame
from mechwright_cam.pages.trace import Stroke, Traced
from mechwright_cam.program.moves import Program
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8c6bb1", "#b8860b", "#56b4e9", "#5d5d5d")
"""One per tool, told apart by colour-blind eyes as well (after Okabe and Ito)."""

DRAWN_ONCE = 2
"""Decimals, mm: paths that lie over one another this closely (passes at several depths) are drawn once."""


def tool_colours(program: Program) -> dict[int, str]:
    """T number to the colour of its paths."""
    return {tool.number: COLOURS[i % len(COLOURS)] for i, tool in enumerate(program.tools)}


def path_layers(program: Program, traced: Sequence[Traced], frame: Frame) -> list[str]:
    """The cuts, rapids and holes of each tool, in order of first use."""
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
                holes[(round(stroke.end[0], DRAWN_ONCE), round(stroke.end[1], DRAWN_ONCE))] = None
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
    start, end = (
        tuple(round(value, DRAWN_ONCE) for value in place[:2]) for place in (stroke.start, stroke.end)
    )
    if stroke.centre is None:
        return None if start == end else (start, end, stroke.feed > 0)
    return start, end, tuple(round(value, DRAWN_ONCE) for value in stroke.centre), stroke.ccw
