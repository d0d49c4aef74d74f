"""The moves of roughing: what has to be cut of a connected piece of stock, level by level."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import shapely

from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.thin_cuts import Stretch
from mechwright_plane.path import Path

EASY = 1.5
"""A way down along a ring is so many times as long as the steepest, for the steeper it is the slower."""
PARTS = 4
"""A way down is divided in so many moves at least: a proof that takes a move to be as deep as its end all
along then finds no more than a quarter too much."""
LONG = 0.8
"""Where that is more than this share of the ring, the way down is all of it."""


@dataclass(frozen=True)
class Run:
    """A path of the centre at one depth."""

    path: Path
    open: bool
    """The start is clear of stock, so the cutter may be sunk there."""
    linked: bool
    """The cutter may go straight from the end of the run before to the start of this one at depth."""
    cleared: bool = False
    """All of that way is cleared, so that it is no cut."""
    beside: bool = False
    """Where the start is, no more than the allowance of walls stands in the way: a mill that cuts at its
    centre may be plunged through that, slowly, which is shorter than a ramp."""
    parts: tuple[Stretch, ...] = ()
    """The path by the thickness of chips, where that is known."""


@dataclass(frozen=True)
class Cavity:
    """Runs that remove connected stock, in cutting order; ``back``: the last leads to the first."""

    core: shapely.Polygon
    """That stock, less slivers at its edge."""
    runs: tuple[Run, ...]
    back: bool
    cleared: bool
    """All of the way back is cleared."""
    bottom: float | None = None
    """Down to which it is cut, z in mm, if that is not the bottom of its zone."""
    returns: tuple[Stretch, ...] = ()
    """Its only run in the other direction, where that begins in the clear as well: then it is run to and fro,
    a level each way. What is cut is a slot, to which both directions are alike, or stays for finishing."""


def write_ring(pen: Pen, path: Path, top: float, heights: list[float]) -> None:
    """One closed ring, level by level without a stop: down along its beginning, and on around.

    The way down of a level lies under that of the one before, so that it is as deep as all of the ring. What
    it leaves at the bottom is cut at last.
    """
    pen.above(path.start)
    pen.sink(top)
    easy = EASY * max(a - b for a, b in pairwise([top, *heights])) / pen.slope
    if easy >= LONG * path.length:
        for z in heights:
            pen.ramp(path, z)
        pen.follow(path)
        return
    parts, rest = [], path
    for _ in range(PARTS):
        part, rest = rest.split(easy / PARTS)
        parts.append(part)
    for above, z in pairwise([top, *heights]):
        for number, part in enumerate(parts, start=1):
            pen.descend(part, above + (z - above) * number / PARTS)
        pen.follow(rest)
    for part in parts:
        pen.follow(part)


def write_levels(pen: Pen, cavity: Cavity, top: float, heights: list[float], *, thinning: bool) -> None:
    """All runs at one height, then all at the next."""
    above = top
    for level, z in enumerate(heights):
        if cavity.returns and level % 2:
            pen.sink(z, pen.air_down)
            _follow(pen, cavity.returns, thinning=thinning)
            above = z
            continue
        for number, run in enumerate(cavity.runs):
            # Back to the first run goes through what this level has already cleared.
            back = number == 0 and level > 0 and bool(cavity.back or cavity.returns)
            feed = pen.air if run.cleared or (back and cavity.cleared) else None
            pen.go(run.path.start, run.linked or back, feed)
            if run.beside and not (run.open or run.linked):
                pen.sink(above)
                pen.sink(z, pen.rates.plunge)
            elif not run.linked:
                pen.enter(run.path, above, z, run.open, pen.air_down)
            _follow(pen, run.parts or ((run.path, 1.0),), thinning=thinning)
        above = z


def _follow(pen: Pen, parts: Sequence[Stretch], *, thinning: bool) -> None:
    """Along a path in stretches, as fast as their chips allow."""
    for part, share in parts:
        pen.follow(part, pen.times(share) if thinning and share > 1 else None)
