"""Which of a job's end mills does what."""

import math
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Sequence
from functools import lru_cache

import shapely

from mechwright.errors import ToolError
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.entry import lead_length
from mechwright_cam.setup.job import Job, wear_margin
from mechwright_cam.shop.cutter import cutter, makes_floor
from mechwright_cam.shop.estimates import no_estimate
from mechwright_cam.shop.settings import CamSettings, PathSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import ROUGH, areas, grow
from mechwright_plane.path import rounded
from mechwright_plane.reach import closing, leaves_at_most, leaves_much_more

REACH_SHARE = 1.5
"""Of both tolerances of walls together, what a larger cutter may leave in their corners besides."""
FITS = 0.9
"""A mill is worth choosing where what larger ones leave holds a disc of this share of it."""
HEAVY = 0.1
"""Stock thicker than the allowance by this much, mm, is roughed once more before it is finished."""
HANDY = 6.0
"""Up to this diameter, mm, a roughing mill is sensible for a part of any size: it wastes little."""
INSCRIBED = 0.01
"""How far the largest circle in an opening may be off, mm."""
MATERIALS = 2
"""So many materials that the mills at hand cut are named where they do not cut the part's."""
ROOMY = 0.7
"""A mill up to this share of a hole's diameter leaves room for chips."""

DEEP = "cam.too-deep"
"""Code of the finding that no mill is long enough."""


class MisfitError(ToolError):
    """No cutter fits a length of the part: ``limit``, mm, in place of what is ``measured`` would do.

    ``code`` is that of the finding, where it has one of its own: what cures one is no cure of the other.
    """

    def __init__(self, message: str, measured: float, limit: float, code: str = "") -> None:
        super().__init__(message)
        self.measured, self.limit, self.code = measured, limit, code


def long_enough(tool: Tool, depth: float) -> bool:
    """Whether the flutes reach the bottom of a cut of this depth, mm."""
    return tool.flute_length >= depth - TOLERANCES.noise


def usable_mills(
    job: Job, depth: float, floor_radius: float = 0.0, enters: Callable[[Tool], bool] = lambda _: True
) -> list[Tool]:
    """Mills that cut the job's material to ``depth``, largest first; raises ToolError if none.

    A cut through the plate goes deeper by the corner radius of a bull nose, so that the wall is straight down
    to the underside. A ball makes no flat floor in good time: it counts only for a floor of its own radius,
    or where there is nothing else that ``enters``.
    """
    material = job.part.material
    knows = [tool for tool in job.mills if material in tool.cutting]
    if not knows:
        others = Counter(other for tool in job.mills for other in tool.cutting)
        instead = "".join(f', or use material = "{other}"' for other, _ in others.most_common(MATERIALS))
        cure = f"give one its cutting_speed and chip_load in [cam.cutting.NAME]{instead}"
        why = no_estimate(job.mills, material, job.settings.machine)
        what = f"none has cutting data for {material}{why}; {cure}" if job.mills else "there is none"
        raise ToolError(f"cam.tools: part {job.part.name} needs an end mill, and {what}")
    through = depth >= job.thickness - TOLERANCES.noise
    mills = [tool for tool in knows if long_enough(tool, depth + (tool.nose if through else 0.0))]
    if not mills:
        longest = max(knows, key=lambda tool: tool.flute_length)
        raise MisfitError(
            f"cam.tools: no end mill for part {job.part.name} cuts {depth:g} mm deep; the longest, "
            f"{longest.name}, has a flute length of {longest.flute_length:g} mm; list a longer one",
            depth,
            longest.flute_length,
            DEEP,
        )
    plain = [tool for tool in mills if tool.nose < tool.radius or makes_floor(tool, floor_radius)]
    return plain if any(map(enters, plain)) else mills


def radius_in(mill: Tool, height: float) -> float:
    """Radius of a mill at a height above its tip, mm: that of a nose which is higher is smaller."""
    return float(cutter(mill).radius_at(height)) if mill.nose > height else mill.radius


def last_mills(
    mills: Sequence[Tool],
    keep: shapely.Geometry,
    settings: CamSettings,
    near: shapely.Geometry | None = None,
    height: float = math.inf,
) -> list[Tool]:
    """The mills that finish a wall of a height, mm, one after the other: from the sharpest to the finest.

    A flat end mill leaves no fillet on the floor, and a small nose a small one. Where a rounder mill reaches
    further into corners it comes after it.
    """
    last: list[Tool] = []
    for nose in sorted({mill.nose for mill in mills}):
        best = finishing_choice([mill for mill in mills if mill.nose <= nose], keep, settings, near, height)
        if not last or radius_in(best, height) < radius_in(last[-1], height):
            last.append(best)
    return last


def roughers(mills: Sequence[Tool], last: Sequence[Tool]) -> list[Tool]:
    """The mills that rough before the last ones: the wider ones, and round ones as wide, whose edges last.

    Before a ball every other mill roughs, for a ball takes long to make a floor; and before one of the last
    that has no room for chips, and is not among ``mills``, all of them.
    """
    finest = last[-1]
    if any(mill not in mills for mill in last):
        return list(mills)
    is_ball = finest.nose == finest.radius
    return [
        mill
        for mill in mills
        if mill.diameter > finest.diameter
        or (mill is not finest and mill.diameter == finest.diameter and mill.nose > finest.nose)
        or (is_ball and mill.nose < mill.radius)
    ]


def same_reach(path: PathSettings) -> float:
    """A larger cutter is as good as the finest one if it leaves at most this much more on a wall, mm.

    It is what is left of the permitted leftover beside the path's tolerance, and in proportion to the zone in
    which walls may lie.
    """
    zone = path.inner_tolerance + path.outer_tolerance
    return min(TOLERANCES.leftover - path.outer_tolerance, REACH_SHARE * zone)


def finishing_choice(
    mills: Sequence[Tool],
    keep: shapely.Geometry,
    settings: CamSettings,
    near: shapely.Geometry | None = None,
    height: float = math.inf,
) -> Tool:
    """The largest mill that leaves on the walls of ``keep`` no more than the finest, the last one.

    Only the walls ``near`` a shape count, if one is given; they are ``height`` mm high.
    """
    mills, wear = sorted(mills, key=lambda mill: -radius_in(mill, height)), wear_margin(settings)
    reach = tuple(radius_in(mill, height) + wear for mill in mills)
    return mills[_largest_as_good(keep, reach, settings.path, near)]


@lru_cache(maxsize=64)
def _largest_as_good(
    keep: shapely.Geometry, radii: tuple[float, ...], path: PathSettings, near: shapely.Geometry | None
) -> int:
    """Index of the largest mill that leaves no more on the walls of ``keep`` than the last one."""
    finest, most = radii[-1], same_reach(path)

    def as_good(radius: float) -> bool:
        # A gap of just its diameter is too narrow for the mill.
        if leaves_much_more(keep, radius + path.bias, finest, most, near):
            return False
        return leaves_at_most(closing(keep, finest), radius + path.bias, most, near)

    # What is left only grows with the radius.
    return bisect_left(radii, True, hi=len(radii) - 1, key=as_good)


@lru_cache(maxsize=64)
def entry_place(shape: shapely.Polygon) -> tuple[Point, float]:
    """The middle of the largest circle in an opening, and its radius, mm."""
    line = shapely.maximum_inscribed_circle(shape, tolerance=INSCRIBED)
    (x, y), _ = line.coords
    return (rounded(x), rounded(y)), float(line.length)


def with_sharper(mills: list[Tool], roomy: list[Tool], enters: Callable[[Tool], bool]) -> list[Tool]:
    """The mills that may finish: roomy ones, and those with sharper noses that just enter.

    What is roughed leaves them little to cut, and they level the fillets of the others.
    """
    sharpest = min(mill.nose for mill in roomy)
    return [*(mill for mill in mills if mill.nose < sharpest and enters(mill)), *roomy]


def run_out(mills: Sequence[Tool], settings: CamSettings) -> float:
    """How far beyond an open edge mills go that finish up to it, mm."""
    more = settings.stock_to_leave + HEAVY
    return max(mill.diameter + lead_length(mill, settings) + more for mill in mills)


def roomy_mills(mills: Sequence[Tool], opening: shapely.Geometry, allowance: float) -> list[Tool]:
    """The mills that have room in an opening, largest first; the smallest if none does.

    In a slot longer than two diameters a mill cuts with its whole width at every depth, as in the channel
    around a part. There it needs no more room than for the ``allowance``, mm, on both walls, without which it
    would leave nothing to finish.
    """

    def has_room(mill: Tool) -> bool:
        if not shapely.is_empty(grow(opening, INSCRIBED / 2 - mill.radius / ROOMY, ROUGH)):
            return True
        ways = grow(opening, INSCRIBED / 2 - mill.radius - max(allowance, INSCRIBED), ROUGH)
        boxes = (way.bounds for way in shapely.get_parts(ways))
        return any(max(x1 - x0, y1 - y0) >= mill.diameter for x0, y0, x1, y1 in boxes)

    return list(mills[bisect_left(mills, True, hi=len(mills) - 1, key=has_room) :])


def finest_needed(
    mills: Sequence[Tool],
    keep: shapely.Geometry,
    settings: CamSettings,
    near: shapely.Geometry | None = None,
    fits: Callable[[Tool], bool] = lambda _: True,
) -> Tool:
    """The largest mill that leaves next to nothing on a wall, else the largest as good as the finest.

    No mill below ``corner_mill`` is taken for the sake of sharp corners.
    """
    most, more = same_reach(settings.path), settings.path.bias + wear_margin(settings)
    # What a mill leaves only shrinks with its size.
    clean = bisect_left(mills, True, key=lambda mill: leaves_at_most(keep, mill.radius + more, most, near))
    for mill in mills[clean:]:
        if fits(mill):
            return mill
    fitting = [mill for mill in mills if fits(mill)]
    return finishing_choice(_worthwhile(fitting, keep, settings.corner_mill, near), keep, settings, near)


def _worthwhile(
    mills: Sequence[Tool], keep: shapely.Geometry, least: float, near: shapely.Geometry | None
) -> Sequence[Tool]:
    """The mills down to ``least``, mm, and finer ones only as far as they fit into what is left."""
    coarse = [mill for mill in mills if mill.diameter >= least] or list(mills[:1])
    for finer in mills[len(coarse) :]:
        # On a grid, for a closing may touch itself, on which exact overlays fail.
        left = shapely.difference(closing(keep, coarse[-1].radius), keep, grid_size=ROUGH)
        if near is not None:
            left = areas(shapely.intersection(areas(left), areas(near)))
        if not shapely.is_empty(grow(left, -FITS * finer.radius, ROUGH)):
            coarse.append(finer)
    return coarse
