"""Mills chosen for one feature that those of others replace in less time than a change takes.

Glossary
--------
asked
    The mills that a wall asked for, largest first. The last reaches its corners, as any finer one does.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import shapely

from mechwright.contracts.part import Bore, Feature, Pocket, Profile, is_outside
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.bore import boring_mill, boring_time, sizing_drill
from mechwright_cam.operations.choice import ROOMY, long_enough
from mechwright_cam.operations.drilling import starting_drill
from mechwright_cam.operations.entry import enters
from mechwright_cam.operations.finishing import finish_depth, finish_engagement
from mechwright_cam.operations.ladder import change_time, ladder, recess_ladder
from mechwright_cam.operations.rates import rates
from mechwright_cam.operations.recess import recess
from mechwright_cam.operations.tap import core_drill
from mechwright_cam.setup.depths import bottom_of
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind


@dataclass(frozen=True)
class Wall:
    """An outside or a recess that mills rough and finish, with those it asked for."""

    feature: Feature
    shape: shapely.Geometry
    deep: float
    asked: tuple[Tool, ...]


def fewer_mills(every: Job, asked: Sequence[tuple[Feature, Sequence[Tool]]]) -> set[str]:
    """Names of the mills that are better left out, of those that features ``asked`` for, by estimate.

    One after the other goes whose work others do in less time than its change takes. A mill stays that a
    bore or a floor with a fillet has no other for.
    """
    walls, mills = _walls(every, asked), dict[str, Tool]()
    for _, tools in asked:
        mills |= {tool.name: tool for tool in tools if tool.kind is ToolKind.END_MILL}
    fixed = {
        tool.name
        for feature, tools in asked
        for tool in tools
        if isinstance(feature, Pocket) and feature.floor_radius > 0
    }
    left = dict(mills)
    seconds = _time(every, walls, list(left.values()))
    while len(left) > 1 and math.isfinite(seconds):
        ways = []
        for name in sorted(left.keys() - fixed):
            rest = [mill for other, mill in left.items() if other != name]
            ways.append((_time(every, walls, rest), name))
        if not ways or min(ways)[0] >= seconds:
            break
        seconds, name = min(ways)
        del left[name]
    return mills.keys() - left.keys()


def _walls(every: Job, asked: Sequence[tuple[Feature, Sequence[Tool]]]) -> list[Wall]:
    walls = []
    for feature, tools in asked:
        flat = tuple(tool for tool in tools if tool.kind is ToolKind.END_MILL)
        if not flat or isinstance(feature, Bore) or getattr(feature, "floor_radius", 0.0) > 0:
            continue
        deep = -bottom_of(every, feature.top, feature.depth)
        if is_outside(feature):
            shape = shapely.Polygon(feature.loop.flatten())
        elif isinstance(feature, Profile | Pocket):
            shape = recess(every, feature, flat, roomy=True).must
        walls.append(Wall(feature, shape, deep, flat))
    return walls


def _time(every: Job, walls: Sequence[Wall], mills: Sequence[Tool]) -> float:
    """Time of all walls and bores with some mills and their changes, s; inf where one lacks a mill."""
    seconds = len(mills) * change_time(every)
    for wall in walls:
        seconds += wall_time(every, wall, mills)
        if math.isinf(seconds):
            return seconds
    return seconds + _bores_time(every, mills)


def wall_time(every: Job, wall: Wall, mills: Sequence[Tool]) -> float:
    """Time in which mills rough and finish a wall, s, without changes; inf where none reaches its corners."""
    known, finest = every.part.material, wall.asked[-1].diameter
    able = [mill for mill in mills if long_enough(mill, wall.deep) and known in mill.cutting]
    able = [mill for mill in able if mill.diameter <= wall.asked[0].diameter + TOLERANCES.noise]
    last = max(
        (mill for mill in able if mill.diameter <= finest + TOLERANCES.noise),
        key=lambda mill: mill.diameter,
        default=None,
    )
    if last is None:
        return math.inf
    if is_outside(wall.feature):
        assert isinstance(wall.shape, shapely.Polygon)  # noqa: S101 - that of a loop
        rough = ladder(every, wall.shape, able, last, 0.0)[0]
    else:
        rough = recess_ladder(every, wall.shape, able, last, wall.deep, 0.0)[0]
    high = wall.deep - wall.feature.top
    laps = math.ceil(high / finish_depth(every, last, high, wall.deep)) + every.settings.spring_passes
    engagement = finish_engagement(every.settings, last.radius)
    feed = rates(last, known, every.settings.machine, engagement).feed
    return rough + 60 * laps * float(wall.shape.length) / feed


def _bores_time(every: Job, mills: Sequence[Tool]) -> float:
    """Time of the bores that mills make, s."""
    seconds = 0.0
    counted: dict[tuple[float, float, float], float] = {}
    for feature in every.features:
        if not isinstance(feature, Bore) or sizing_drill(every, feature) is not None:
            continue
        if core_drill(every, feature) is not None:
            continue
        alike = feature.diameter, feature.top, feature.depth
        if alike not in counted:
            deep = -bottom_of(every, feature.top, feature.depth)
            able = [
                mill
                for mill in sorted(mills, key=lambda tool: -tool.diameter)
                if long_enough(mill, deep)
                and every.part.material in mill.cutting
                and mill.diameter <= ROOMY * feature.diameter
                and enters(mill, feature.diameter, every.settings)
            ]
            mill, drill = boring_mill(able, feature.diameter), starting_drill(every, feature.diameter, deep)
            counted[alike] = math.inf if mill is None else boring_time(every, feature, drill, mill)
        seconds += counted[alike]
    return seconds
