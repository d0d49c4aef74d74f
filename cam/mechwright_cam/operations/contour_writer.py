"""Writes contours with cutter compensation, and the way onto them and off."""

import math
from typing import Literal

from mechwright.contracts.part import Bore
from mechwright.geometry.segments import Point
from mechwright_cam.operations.entry import bore_lead, offsets_of
from mechwright_cam.operations.finishing import bore_heights
from mechwright_cam.operations.pen import Pen
from mechwright_cam.program.moves import Feed
from mechwright_cam.setup.depths import bottom_of
from mechwright_cam.setup.job import Job
from mechwright_plane.path import CIRCLE_BIAS, Path, arc, line, round_from_right, rounded


class ContourWriter:
    """Writes a contour: what a pen writes, with the words that turn compensation on and off."""

    def __init__(self, pen: Pen, side: int, planned: float) -> None:
        self.pen, self.side, self.planned = pen, side, planned

    def on(self, end: Point) -> None:
        """The straight line that turns compensation on."""
        self._straight(end, "left" if self.side > 0 else "right")

    def off(self, end: Point) -> None:
        """The straight line that turns it off."""
        self._straight(end, "off")

    def _straight(self, end: Point, word: Literal["left", "right", "off"]) -> None:
        self.pen.moves.append(Feed(end[0], end[1], None, self.pen.rates.feed, word))
        self.pen.place = end

    def follow(self, path: Path) -> None:
        """Along a path; on arcs with the tool inside its centre is slower, by the radius that it runs on."""
        pen = self.pen
        pen.moves += pen.along(path, pen.rates.feed, self.side, nearer=self.planned)
        pen.place = path.end


def finish_bore_compensated(job: Job, bore: Bore, pen: Pen) -> None:
    """Write the finishing circles of a bore, entered from its middle, or from as near to it as may be."""
    tool, side = pen.tool, 1 if job.settings.climb else -1
    offsets = offsets_of(tool, job.settings)
    radius = bore.diameter / 2 - CIRCLE_BIAS - offsets.base
    lead = bore_lead(offsets, radius)
    x, y = bore.centre
    turn = round_from_right(bore.centre, radius, side > 0)
    # Seen from where the circle is touched, y leads to its middle and x along it.
    start, first, last = (
        (rounded(x + radius - v), rounded(y + side * u))
        for u, v in (lead.start, lead.turn, (-lead.turn[0], lead.turn[1]))
    )
    heading = side * math.pi / 2
    bottom = bottom_of(job, bore.top, bore.depth)
    heights = bore_heights(job, tool, bore, bottom)
    pen.above(start)
    run = ContourWriter(pen, side, offsets.planned)
    for z in heights:
        pen.sink(z)
        run.on(first)
        run.follow(touching(first, turn.start, heading, side))
        run.follow(turn)
        run.follow(touching(turn.start, last, heading, side, out=True))
        run.off(start)
    pen.retract()


def touching(start: Point, end: Point, heading: float, side: int, *, out: bool = False) -> Path:
    """The arc between a contour and a lead's line that touches the contour under its heading.

    It ends on the contour, or with ``out`` starts there.
    """
    touch, other = (start, end) if out else (end, start)
    nx, ny = -math.sin(heading) * side, math.cos(heading) * side
    dx, dy = other[0] - touch[0], other[1] - touch[1]
    across = 2 * (dx * nx + dy * ny)
    if across <= 0:
        return Path(start, (line(start, end),))
    radius = (dx * dx + dy * dy) / across
    return Path(start, (arc(start, end, (touch[0] + radius * nx, touch[1] + radius * ny), side),))
