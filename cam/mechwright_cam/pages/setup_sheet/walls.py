"""The deviation along the walls as a picture: what was left stands outwards, what was cut too deep inwards.

It is legible in grey: the side tells the sign, and what is cut into the part is black.
"""

import math
from collections.abc import Iterator

import numpy as np

from mechwright.arrays import Array
from mechwright.output import svg
from mechwright.tolerances import TOLERANCES
from mechwright_cam.pages.picture import Frame
from mechwright_cam.pages.picture.frame import outline_data
from mechwright_cam.pages.setup_sheet.facts import MARKED
from mechwright_cam.proof.walls import Place, Walls
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths

SHOWN = 1500
"""Places along the walls in the picture: each is the worst of its neighbours."""
LARGEST_HIGH = 0.9
"""The largest deviation within reach is drawn so high, in heights of letters."""
CORNERS_HIGH = 1.8
"""Corners are drawn no higher, in heights of letters; their value stands beside them."""
LEFT_FILL, CUT_FILL, PART = "#e69f00", "#000000", "#e8ecef"
"""Stock left, cuts into the part, and the part."""


def exaggeration(walls: Walls, frame: Frame) -> float:
    """How many times larger than they are deviations are drawn: 1, 2 or 5 times a power of ten."""
    reach = np.abs(walls.off[~walls.corner])
    largest = max(float(reach.max(initial=0.0)), TOLERANCES.arc_fit / 2)
    wanted = LARGEST_HIGH * frame.letters / largest
    power = 10.0 ** math.floor(math.log10(wanted))
    return power * max(step for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-9))


def walls_view(walls: Walls, job: Job) -> str:
    """The walls seen from above with the deviation along them, as an ``<svg>`` element."""
    x0, y0, x1, y1 = job.target.bounds
    margin = 0.09 * max(x1 - x0, y1 - y0)
    units = job.settings.post.units or "mm"
    frame = Frame(x0 - margin, y0 - margin, x1 + margin, y1 + margin, units)
    factor = exaggeration(walls, frame)
    part = svg.element("path", d=outline_data(job), fill=PART, fill_rule="evenodd", stroke="none")
    layers = [part, *_bands(walls, frame, factor), *_marks(walls, frame)]
    layers.append(_scale(frame, factor))
    low = frame.y0 - 2.4 * frame.letters
    box = (frame.x0, -frame.y1, frame.x1 - frame.x0, frame.y1 - low)
    return svg.picture("".join(layers), box, f"Deviation along the walls of {job.part.name}")


def _bands(walls: Walls, frame: Frame, factor: float) -> Iterator[str]:
    """The walls, and along them what was left and what was cut too deep."""
    wall: list[str] = []
    left: list[str] = []
    cut: list[str] = []
    for points, outward, off in _stretches(walls):
        wall.append(svg.path(points))
        high = np.clip(off * factor, -CORNERS_HIGH * frame.letters, CORNERS_HIGH * frame.letters)
        for data, part in ((left, np.maximum(high, 0.0)), (cut, np.minimum(high, 0.0))):
            for piece in _where(part != 0):
                edge = points[piece] + outward[piece] * part[piece, None]
                data.append(svg.path(np.concatenate((points[piece], edge[::-1])).tolist(), close=True))
    thin = 0.05 * frame.letters
    for shapes, colour in ((left, LEFT_FILL), (cut, CUT_FILL)):
        if shapes:
            yield svg.element("path", d="".join(shapes), fill=colour, stroke=colour, stroke_width=0.5 * thin)
    yield svg.element("path", d="".join(wall), fill="none", stroke="#333333", stroke_width=thin)


def _stretches(walls: Walls) -> Iterator[tuple[Array, Array, Array]]:
    """Points (k, 2), directions (k, 2) and deviation (k,) of each stretch of wall, as many as are shown."""
    bunch = max(1, math.ceil(len(walls.off) / SHOWN))
    for number in np.unique(walls.run).tolist():
        mine = np.flatnonzero(walls.run == number)
        first = np.arange(0, mine.size, bunch)
        group = np.arange(mine.size) // bunch
        order = np.lexsort((-np.abs(walls.off[mine]), group))
        worst = mine[order[first]]
        yield walls.points[mine[first]], walls.outward[mine[first]], walls.off[worst]


def _where(mask: Array) -> list[Array]:
    """Runs of indices at which a mask holds, each one longer at both ends."""
    at = np.flatnonzero(mask)
    if not at.size:
        return []
    runs = np.split(at, np.flatnonzero(np.diff(at) > 1) + 1)
    last = len(mask) - 1
    return [np.arange(max(run[0] - 1, 0), min(run[-1] + 1, last) + 1) for run in runs]


def marked(walls: Walls) -> list[tuple[str, str, Place]]:
    """The places that the picture marks: number, what they are, and the place."""
    kinds = (("left", walls.left), ("cut", walls.cut), ("corner", walls.corners))
    found = [(kind, place) for kind, places in kinds for place in places[:MARKED]]
    return [(str(number), kind, place) for number, (kind, place) in enumerate(found, start=1)]


def _marks(walls: Walls, frame: Frame) -> Iterator[str]:
    size = frame.letters
    middle = ((frame.x0 + frame.x1) / 2, (frame.y0 + frame.y1) / 2)
    halo = {"paint_order": "stroke", "stroke": "#ffffff", "stroke_width": 0.3 * size}
    for number, kind, place in marked(walls):
        dash = f"{svg.number(0.25 * size)} {svg.number(0.2 * size)}" if kind == "corner" else None
        look = {"fill": "none", "stroke": "#000000", "stroke_width": 0.09 * size, "stroke_dasharray": dash}
        yield svg.element("circle", cx=place.x, cy=-place.y, r=0.5 * size, **look)
        side = 1.0 if place.x >= middle[0] else -1.0
        at = (place.x + side * 0.8 * size, place.y + 0.5 * size)
        words = f"{number}: {Lengths(frame.units).signed(place.off, 4)}"
        anchor = "start" if side > 0 else "end"
        if side > 0 and at[0] + 5.2 * size > frame.x1:  # no room beside it
            at, anchor = (frame.x1 - 0.2 * size, place.y + 0.9 * size), "end"
        if side < 0 and at[0] - 5.2 * size < frame.x0:
            at, anchor = (frame.x0 + 0.2 * size, place.y + 0.9 * size), "start"
        yield svg.text(*at, words, 0.85 * size, text_anchor=anchor, font_weight="bold", **halo)


def _scale(frame: Frame, factor: float) -> str:
    """A bar as high as the gouge limit is drawn, or a tenth of it, and the exaggeration in words."""
    size = frame.letters
    length = next(
        limit
        for limit in (TOLERANCES.gouge, TOLERANCES.gouge / 5, TOLERANCES.gouge / 50, 0.0)
        if limit * factor <= 6 * size
    )
    x, y = frame.x0 + 0.5 * size, frame.y0 - 1.6 * size
    end = x + length * factor
    bar = f"M{svg.place(x, y + 0.4 * size)}V{svg.number(-y)}H{svg.number(end)}V{svg.number(-y - 0.4 * size)}"
    length_words = Lengths(frame.units).with_unit(length)
    words = f"{length_words}; deviations drawn {factor:,.0f} : 1".replace(",", " ")
    line = svg.element("path", d=bar, fill="none", stroke="#000000", stroke_width=0.08 * size)
    return line + svg.text(end + 0.5 * size, y, words, 0.85 * size)
