"""Dimensions of stock and part in the plan view, and its origin."""

import math
from dataclasses import dataclass

from mechwright.geometry.segments import Point
from mechwright.output import svg
from mechwright_cam.pages.picture.frame import Frame
from mechwright_cam.setup.job import Job
from mechwright_plane.nest import Nest

LETTER_WIDTH = 0.58
"""Width of a letter in its height, on average, generously."""


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
        return LETTER_WIDTH * size * len(self.words)

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
        _Dimension(0, (x0, x1), y0 - 2 * step, y0, f"stock {frame.words(x1 - x0, 1)}"),
        _Dimension(1, (y0, y1), x0 - 2 * step, x0, f"stock {frame.words(y1 - y0, 1)}"),
    ]
    if job.side == "top":  # turned over, the target is all of the plate
        rows += [
            _Dimension(0, (px0, px1), y1 + step, y1, f"{what} {frame.words(px1 - px0, 2)}"),
            _Dimension(1, (py0, py1), x1 + step, x1, f"{what} {frame.words(py1 - py0, 2)}"),
        ]
    # How far the origin is from the edges that are probed, unless it is on them.
    x, y = job.datum
    if x != 0:
        rows.append(
            _Dimension(0, (min(x, 0.0), max(x, 0.0)), y0 - step, y0, frame.words(abs(x), 2), "#b00020")
        )
    if y != 0:
        rows.append(
            _Dimension(1, (min(y, 0.0), max(y, 0.0)), x0 - step, x0, frame.words(abs(y), 2), "#b00020")
        )
    return rows


def ends_of_words(job: Job, frame: Frame, axis: int) -> list[float]:
    """Where the words of the dimensions along an axis end, mm."""
    size = frame.letters
    return [d.middle(size) + d.length(size) / 2 + size for d in _listed(job, frame) if d.axis == axis]


def dimensions(job: Job, frame: Frame) -> str:
    """Stock, part, and the way from the edges to the origin."""
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
    line = svg.element("path", d=lines + main, fill="none", stroke=colour, stroke_width=0.05 * size)
    return line + heads + label


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


def origin_mark(frame: Frame) -> str:
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
