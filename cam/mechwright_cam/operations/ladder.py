"""Which mills rough an outside: the ladder of them that takes the least time by estimate.

Glossary
--------
ladder
    Mills from the one that opens the channel down to the one that finishes; each takes what it reaches of
    what the one before has left.
place
    A connected piece of such stock, as in the gap between two teeth: the cutter comes and goes at each level.

The time of a mill is that of its passes, area over width of cut and feed, times the levels that its depth of
pass asks for, and :data:`PLACE` for each place and level; feeds and depths are those of planning itself.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import shapely

from mechwright_cam.operations.bending import pass_depth
from mechwright_cam.operations.rates import rates
from mechwright_cam.plane.buffers import buffered
from mechwright_cam.plane.offsets import filled, polygons, simplified
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool

PLACE = 0.7
"""Time to come to a place, to be sunk and to leave it, s: 0.6 to 1.0 in the examples."""
CHANGE = 6.0
"""Time of a change besides the changer's own, s: up, spindle, coolant, down."""
COARSE = 0.02
"""The outline is thinned by so much for estimates, mm."""
SLIVER = 0.02
"""Half the width of stock that is none, mm."""


def passes(job: Job, mill: Tool, deep: float) -> int:
    """Levels in which a mill goes down by ``deep`` mm with its whole width."""
    return math.ceil(deep / pass_depth(job, mill, deep) - SLIVER)


def rest_time(job: Job, mill: Tool, deep: float, area: float, places: int) -> float:
    """Time, s, in which a mill takes so much stock, mm², at so many places, ``deep`` mm down."""
    data = mill.cutting[job.part.material]
    feed = rates(mill, job.part.material, job.settings.machine).feed
    return passes(job, mill, deep) * (60 * area / (data.step_over * mill.diameter * feed) + PLACE * places)


def change_time(job: Job) -> float:
    """Time that one more tool takes by itself, s."""
    return job.settings.machine.tool_change + CHANGE


def ladder(job: Job, part: shapely.Polygon, mills: Sequence[Tool], finest: Tool) -> list[Tool]:
    """The mills from the one that opens the channel down to the ``finest``, largest first.

    All ladders among the ``mills`` that are wider are compared, by the shortest way through them: what one
    mill leaves to the next depends on these two alone.
    """
    deep, wide = -job.floor, [mill for mill in mills if mill.diameter > finest.diameter]
    chain = [*sorted(wide, key=lambda mill: -mill.diameter), finest]
    rough = simplified(part, COARSE)
    left = [left_by(rough, mill.radius + job.settings.stock_to_leave) for mill in chain]
    best: list[tuple[float, list[Tool]]] = []
    for n, mill in enumerate(chain):
        ways = [(channel_time(job, rough, mill, deep), [mill])]
        for before, (seconds, tools) in enumerate(best):
            (area, places), (rest, _) = left[before], left[n]
            more = rest_time(job, mill, deep, max(0.0, area - rest), places)
            ways.append((seconds + more + change_time(job), [*tools, mill]))
        best.append(min(ways, key=lambda way: (way[0], len(way[1]))))
    return best[-1][1]


def channel_time(job: Job, part: shapely.Polygon, mill: Tool, deep: float) -> float:
    """Time, s, of the channel: once round at every level, and what is wider than the mill in steps."""
    speed, data = rates(mill, job.part.material, job.settings.machine), mill.cutting[job.part.material]
    reach = mill.radius + job.settings.stock_to_leave
    length = float(_grown(part, reach).length)
    around = (
        float(filled(_grown(part, reach + mill.radius)).area) - float(part.area) - left_by(part, reach)[0]
    )
    more = max(0.0, around - mill.diameter * length) / (data.step_over * mill.diameter)
    seconds: float = 60 * passes(job, mill, deep) * (length + more) / speed.feed
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
