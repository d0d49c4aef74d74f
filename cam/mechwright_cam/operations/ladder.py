"""Which mills rough an outside: the ladder of them that takes the least time by estimate.

Glossary
--------
ladder
    Mills from the one that opens the channel down to the one that finishes; each takes what it reaches of
    what the one before has left.
place
    A connected piece of such stock, as in the gap between two teeth: the cutter comes and goes at each level.

The time of a mill is that of its passes, area over width of cut and feed, times the levels that its depth of
pass asks for, and for each place the time to come there, to turn and to go down; feeds and depths are those
of planning itself.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import shapely

from mechwright_cam.operations.bending import pass_depth
from mechwright_cam.operations.clearing import SLIVER
from mechwright_cam.operations.pen import DOWN
from mechwright_cam.operations.rates import rates
from mechwright_cam.operations.steps import slope
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.buffers import buffered
from mechwright_plane.offsets import filled, polygons, simplified

COME = 0.6
"""Time to come to a place and to leave it, s: two rapids in each direction with their ramps of speed."""
TURN = 0.08
"""Time to turn round at each level of a place, s, besides that of going down."""
THINNER = 0.85
"""Share of the feed time that is left where chips are thin on the way in and out."""
CHANGE = 6.0
"""Time of a change besides the changer's own, s: up, spindle, coolant, down."""
COARSE = 0.02
"""The outline is thinned by so much for estimates, mm."""


def passes(job: Job, mill: Tool, deep: float) -> int:
    """Levels in which a mill goes down by ``deep`` mm with its whole width."""
    return math.ceil(deep / pass_depth(job, mill, deep) - SLIVER)


def rest_time(job: Job, mill: Tool, deep: float, area: float, places: int) -> float:
    """Time, s, in which a mill takes so much stock, mm², at so many places, ``deep`` mm down."""
    data = mill.cutting[job.part.material]
    feed = rates(mill, job.part.material, job.settings.machine).feed / 60
    levels = passes(job, mill, deep)
    along = THINNER * area / (data.step_over * mill.diameter * feed)
    down = deep / (DOWN * feed)
    return levels * along + places * (down + levels * TURN + COME)


def change_time(job: Job) -> float:
    """Time that one more tool takes by itself, s."""
    return job.settings.machine.tool_change + CHANGE


Ladder = tuple[float, list[Tool]]
"""Time, s, and the mills, largest first."""


def ladder(
    job: Job, part: shapely.Polygon, mills: Sequence[Tool], finest: Tool, change: float | None = None
) -> Ladder:
    """The mills from the one that opens the channel down to the ``finest``, and their time.

    A further mill costs the time of its ``change``, s; by default that of the machine. All ladders among the
    ``mills`` that are wider are compared, by the shortest way through them: what one mill leaves to the next
    depends on these two alone.
    """
    deep, wide = -job.floor, [mill for mill in mills if mill.diameter > finest.diameter]
    chain = [*sorted(wide, key=lambda mill: -mill.diameter), finest]
    rough = simplified(part, COARSE)
    left = [left_by(rough, mill.radius + job.settings.stock_to_leave) for mill in chain]
    best: list[Ladder] = []
    change = change_time(job) if change is None else change
    for n, mill in enumerate(chain):
        ways = [(channel_time(job, rough, mill, deep), [mill])]
        for before, (seconds, tools) in enumerate(best):
            (area, places), (rest, _) = left[before], left[n]
            more = rest_time(job, mill, deep, max(0.0, area - rest), places)
            ways.append((seconds + more + change, [*tools, mill]))
        best.append(min(ways, key=lambda way: (way[0], len(way[1]))))
    return best[-1]


def recess_ladder(
    job: Job,
    shape: shapely.Geometry,
    mills: Sequence[Tool],
    finest: Tool,
    deep: float,
    change: float | None = None,
) -> Ladder:
    """The mills that clear a recess down to the ``finest`` in the least time, and this time.

    The first takes what it reaches of all, each other what the one before has left.
    """
    wide = [mill for mill in mills if mill.diameter > finest.diameter]
    chain = [*sorted(wide, key=lambda mill: -mill.diameter), finest]
    rough = simplified(shape, COARSE)
    change = change_time(job) if change is None else change
    reached = [_reached(rough, mill.radius, job.settings.stock_to_leave) for mill in chain]
    best: list[Ladder] = []
    for n, mill in enumerate(chain):
        area = float(reached[n].area)
        ways = [(rest_time(job, mill, deep, area, 1), [mill])]
        for before, (seconds, tools) in enumerate(best):
            left = shapely.difference(rough, reached[before])
            places = len(polygons(_grown(left, -job.settings.stock_to_leave)))
            more = rest_time(job, mill, deep, max(0.0, area - float(reached[before].area)), places)
            ways.append((seconds + more + change, [*tools, mill]))
        best.append(min(ways, key=lambda way: (way[0], len(way[1]))))
    return best[-1]


def _reached(shape: shapely.Geometry, radius: float, leave: float) -> shapely.Geometry:
    """What of a recess a mill reaches that leaves an allowance on its walls."""
    return _grown(_grown(shape, -radius - leave), radius)


def channel_time(job: Job, part: shapely.Polygon, mill: Tool, deep: float) -> float:
    """Time, s, of the channel: once round at every level, and what is wider than the mill in steps."""
    speed, data = rates(mill, job.part.material, job.settings.machine), mill.cutting[job.part.material]
    reach = mill.radius + job.settings.stock_to_leave
    length = float(_grown(part, reach).length)
    around = (
        float(filled(_grown(part, reach + mill.radius)).area) - float(part.area) - left_by(part, reach)[0]
    )
    more = max(0.0, around - mill.diameter * length) / (data.step_over * mill.diameter)
    levels = passes(job, mill, deep) + (job.settings.hold.method == "tabs")  # tabs divide it in two layers
    down = min(length, deep / slope(mill, job.settings))
    seconds: float = 60 * (levels * (length + more) + down) / speed.feed
    return seconds


@lru_cache(maxsize=64)
def left_by(part: shapely.Polygon, radius: float) -> tuple[float, int]:
    """Area, mm², of what a mill leaves around the part, and in how many places; finer ones leave less."""
    left = shapely.difference(_grown(_grown(part, radius), -radius), part)
    places = polygons(_grown(left, -SLIVER))
    return sum(float(place.area) for place in places), len(places)


@lru_cache(maxsize=64)
def _grown(shape: shapely.Geometry, by: float) -> shapely.Geometry:
    """An offset of so few chords as estimates need."""
    return buffered(shape, by, 4)
