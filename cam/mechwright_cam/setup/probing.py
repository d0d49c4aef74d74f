"""How a stock's zero is probed: its top, its left edge and its front edge, with the ball of a touch probe.

Glossary
--------
doubt
    By so much the zero that is set by eye beforehand may be off.
touch
    A move that stops where the ball meets the stock: fast, a little back, and slowly once more.
guarded
    A way down beside the stock that stops, and ends the program, where something is in the way.
"""

from typing import Literal

from mechwright_cam.program.touches import Touch, Touches
from mechwright_cam.setup.job import Job

PROBE = "-probe"
"""What the name of a program that probes a zero ends in."""
BEYOND = 1.0
"""A touch goes on so far behind the last place where the stock can be, mm; then the program ends."""
ROOM = 3.0
"""Between ball and edge before a touch, wherever the edge may be, mm."""
INSIDE = 10.0
"""The top is touched so far from both edges, mm, or in the middle of a small stock."""
BELOW = 2.0
"""The ball's middle is so far below the top where an edge is touched, mm: below a rounded or broken rim."""
LEAST_BELOW = 0.3
"""The same at least, where the stock is thin, mm."""
OVER_TABLE = 0.5
"""The ball stays so far above the underside, mm."""


def unprobed(job: Job) -> str:
    """Why a job's zero is not probed; nothing where it can be."""
    probe = job.settings.probe
    if probe.tool is None:
        return "no probe is named"
    if job.settings.more_offsets:
        return "it finds one zero, and there are more_offsets; find them by hand"
    if job.side != "top":
        return "the second side is picked up by bore, dowels or edges by hand"
    if job.jaws or job.toes:
        return "its edges are in a vice or under clamps; find them by hand"
    if any(tool.number == probe.tool for tool in job.tools):
        return f"T{probe.tool} is a cutter of the job; give the probe a number of its own"
    if job.thickness - OVER_TABLE < probe.diameter / 2 + LEAST_BELOW:
        least = probe.diameter / 2 + LEAST_BELOW + OVER_TABLE
        return f"a ball of {probe.diameter:g} mm needs a stock of {least:g} mm; take a smaller stylus"
    return ""


def touches_of(job: Job) -> Touches:
    """How the stock of a job is touched: its top first, for the edges need its height.

    Raises
    ------
    ValueError
        :func:`unprobed` says why not.
    """
    why, probe = unprobed(job), job.settings.probe
    if why or probe.tool is None:
        raise ValueError(why)
    x0, y0, x1, y1 = job.stock
    radius, doubt = probe.diameter / 2, probe.doubt
    high = job.highest + job.settings.clearance + doubt
    at = tuple(low + min(INSIDE + doubt, (end - low) / 2) for low, end in ((x0, x1), (y0, y1)))
    low = -min(radius + BELOW, job.thickness - OVER_TABLE)
    left = _edge("X", x0, "Y", (y0 + y1) / 2, high, low, radius, doubt)
    front = _edge("Y", y0, "X", (x0 + x1) / 2, high, low, radius, doubt)
    top = (Touch("Z", -doubt - BEYOND, "touch"), Touch("Z", high))
    return Touches(
        name=job.part.name + PROBE,
        offset=job.settings.work_offset,
        tool=probe.tool,
        first=(at[0], at[1]),
        high=high,
        steps=(*top, *left, *front),
        notes=(
            f"T{probe.tool} is a touch probe with a ball of {probe.diameter:g} mm; the spindle stays off",
            f"the zero has been set by eye, to {doubt:g} mm",
        ),
    )


def _edge(
    axis: Literal["X", "Y"],
    edge: float,
    other: Literal["X", "Y"],
    along: float,
    high: float,
    low: float,
    radius: float,
    doubt: float,
) -> tuple[Touch, ...]:
    """Beside an edge, down, towards it, away and up again."""
    away, touching = edge - radius - doubt - ROOM, edge - radius
    return (
        Touch(axis, away),
        Touch(other, along),
        Touch("Z", low, "guarded"),
        Touch(axis, touching + doubt + BEYOND, "touch", touching, upward=True),
        Touch(axis, away),
        Touch("Z", high),
    )
