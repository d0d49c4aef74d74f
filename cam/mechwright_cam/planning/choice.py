"""Which of a job's end mills does what."""

from bisect import bisect_left
from collections.abc import Sequence
from functools import lru_cache

import shapely

from mechwright.errors import ToolError
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright.tooling import Tool
from mechwright_cam.job import Job
from mechwright_cam.reach import closing, leaves_at_most, leaves_much_more
from mechwright_cam.toolpath.offsets import BIAS, polygons
from mechwright_cam.toolpath.path import rounded

SAME_REACH = TOLERANCES.leftover - BIAS - TOLERANCES.arc_fit - TOLERANCES.flatten
"""A larger cutter is as good as the finest one if it leaves at most this much more on a wall, mm: what is
left of the permitted leftover when path and outline have used their tolerances."""
ROOMY = 0.7
"""A mill up to this share of a hole's diameter leaves room for chips."""


def long_enough(tool: Tool, depth: float) -> bool:
    """Whether the flutes reach the bottom of a cut of this depth, mm."""
    return tool.flute_length >= depth - 1e-9


def usable_mills(job: Job, depth: float) -> list[Tool]:
    """End mills that cut the job's material to ``depth``, largest first; raises ToolError if none."""
    material = job.part.material
    knows = [tool for tool in job.end_mills if material in tool.cutting]
    if not knows:
        what = f"none has cutting data for {material}" if job.end_mills else "there is none"
        raise ToolError(f"cam.tools: part {job.part.name} needs an end mill, and {what}")
    mills = [tool for tool in knows if long_enough(tool, depth)]
    if not mills:
        longest = max(knows, key=lambda tool: tool.flute_length)
        raise ToolError(
            f"cam.tools: no end mill for part {job.part.name} cuts {depth:g} mm deep; the longest, "
            f"{longest.name}, has a flute length of {longest.flute_length:g} mm; list a longer one"
        )
    return mills


def path_radius(mill: Tool) -> float:
    """How near to a wall the mill's centre comes: a gap of just its diameter is too narrow for it."""
    return mill.radius + BIAS


def finishing_choice(
    mills: Sequence[Tool], keep: shapely.Geometry, near: shapely.Geometry | None = None
) -> Tool:
    """The largest mill that leaves on the walls of ``keep`` no more than the finest, the last one.

    Only the walls ``near`` a shape count, if one is given.
    """
    return mills[_largest_as_good(keep, tuple(path_radius(mill) for mill in mills), near)]


@lru_cache(maxsize=64)
def _largest_as_good(keep: shapely.Geometry, radii: tuple[float, ...], near: shapely.Geometry | None) -> int:
    """Index of the largest radius that leaves no more on the walls of ``keep`` than the last one."""
    finest = radii[-1] - BIAS

    def as_good(radius: float) -> bool:
        if leaves_much_more(keep, radius, finest, SAME_REACH, near):
            return False
        return leaves_at_most(closing(keep, finest), radius, SAME_REACH, near)

    # What is left only grows with the radius.
    return bisect_left(radii, True, hi=len(radii) - 1, key=as_good)


def entry_place(shape: shapely.Polygon) -> tuple[Point, float]:
    """The middle of the largest circle in an opening, and its radius, mm."""
    line = shapely.maximum_inscribed_circle(shape, tolerance=0.01)
    (x, y), _ = line.coords
    return (rounded(x), rounded(y)), float(line.length)


def roomy_mills(mills: list[Tool], opening: shapely.Geometry) -> list[Tool]:
    """The mills that leave room for chips in an opening, largest first; the smallest if none does.

    A cutter as wide as a slot would cut with its whole width at every depth, and leave nothing to finish.
    """
    width = 2 * max(entry_place(part)[1] for part in polygons(opening))
    return [mill for mill in mills if mill.diameter <= ROOMY * width] or mills[-1:]
