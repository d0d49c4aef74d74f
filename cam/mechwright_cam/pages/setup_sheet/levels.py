"""A side view of the job: which height is which, and where the Z setter stands. Not to scale."""

from mechwright.output import svg
from mechwright_cam.program.moves import Program
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths

_WIDTH, _SIZE = 132.0, 4.2
"""Width of the picture and height of its letters, in units of the picture."""

_INK, _RED = "#1b2733", "#b00020"


def side_view(job: Job, program: Program, deepest: float, to: Lengths) -> str:
    """Heights as an ``<svg>`` element: stock, holding, rapids, cuts down to ``deepest``, Z setter."""
    rows = [("rapids", program.clearance, "#555555"), ("top of stock, Z0", 0.0, _RED)]
    if job.clamp is not None:
        rows.append(("top of clamp", job.clamp.top, "#8a6100"))
    if job.toes:
        rows.append(("top of the toe clamps", job.highest, "#8a6100"))
    if job.jaws:
        rows.append(("top of the jaws", job.jaws[0].top, "#8a6100"))
    if job.tabs:
        rows.append(("top of tabs", max(tab.top for tab in job.tabs), "#8a6100"))
    rows += [("underside", -job.thickness, _INK), ("through cuts", job.floor, "#555555")]
    if deepest < job.floor:
        rows.append(("points of tools", deepest, "#555555"))
    rows.sort(key=lambda row: -row[1])
    # Equal steps, so that labels never meet; the heights are written beside them.
    step = 9.0
    heights = {label: -place * step for place, (label, _, _) in enumerate(rows)}
    top, under = heights["top of stock, Z0"], heights["underside"]
    layers = [_body(job, heights, top, under, to)]
    for label, value, colour in rows:
        y = heights[label]
        weight = "bold" if value == 0 else "normal"
        dashes = None if value in (0.0, -job.thickness) else "2 1.5"
        layers.append(
            svg.element(
                "path", d=f"M{svg.place(2, y)}H{svg.number(76)}", stroke=colour, stroke_width=0.45,
                stroke_dasharray=dashes, fill="none",
            )
        )  # fmt: skip
        words = f"Z {to.signed(value)}  {label}" if value else "Z 0  top of stock"
        layers.append(svg.text(78, y - 1.4, words, _SIZE, fill=colour, font_weight=weight))
    layers.append(_setter(top))
    bottom = min(heights.values()) - 8
    box = (0.0, -top - 34, _WIDTH, top + 34 - bottom)
    return svg.picture("".join(layers), box, "Heights of the job and the Z setter")


def _body(job: Job, heights: dict[str, float], top: float, under: float, to: Lengths) -> str:
    bed = svg.element("rect", x=2, y=-under, width=74, height=6, fill="#d9c7a3", stroke="#7a705c")
    stock = svg.element(
        "rect", x=6, y=-top, width=66, height=top - under, fill="#c9d3dc", stroke=_INK, stroke_width=0.5
    )
    words = svg.text(26, top - 6.2, f"stock {to.with_unit(job.thickness)}", _SIZE, text_anchor="middle")
    below = svg.text(39, under - 4.4, "spoil board", 3.4, text_anchor="middle", fill="#5c4000")
    clamp = ""
    if "top of clamp" in heights:
        high = heights["top of clamp"]
        look = {"fill": "#e6a100", "fill_opacity": 0.6}
        clamp = svg.element("rect", x=10, y=-high, width=12, height=high - top, **look)
    if "top of the jaws" in heights:
        below = svg.text(39, under - 4.4, "vice", 3.4, text_anchor="middle", fill="#5c4000")
        look = {"fill": "#e6a100", "fill_opacity": 0.6, "stroke": "#8a6100", "stroke_width": 0.4}
        high = heights["top of the jaws"]
        for x in (0.0, 72.0):
            clamp += svg.element("rect", x=x, y=-high, width=6, height=high - under + 6, **look)
    return bed + stock + words + below + clamp


def _setter(top: float) -> str:
    """The setter on the stock, a tool's tip on it, and the height h between the two."""
    ink = {"stroke": _INK, "stroke_width": 0.5}
    box = svg.element("rect", x=44, y=-top - 12, width=14, height=12, fill="#ffffff", **ink)
    pad = svg.element("rect", x=48, y=-top - 14, width=6, height=2, fill=_INK)
    shape = f"M49.4 {svg.number(-top - 14)}v-12h-3v-6h9.2v6h-3v12z"
    tool = svg.element("path", d=shape, fill="#8fa3b5", **ink)
    line = f"M62 {svg.number(-top)}V{svg.number(-top - 14)}M59 {svg.number(-top - 14)}H64"
    mark = svg.element("path", d=line, stroke=_RED, stroke_width=0.45, fill="none")
    label = svg.text(63.5, top + 5.6, "h", 5.0, fill=_RED, font_style="italic", font_weight="bold")
    name = svg.text(51, top + 4.6, "setter", 3.4, text_anchor="middle")
    return tool + box + pad + mark + name + label
