"""Rules about what of a tool cuts, how fast its middle goes into material, and which way round it finishes.

A drill cuts with its point, downwards; a thread mill with the teeth at its rim; a chamfer mill with its cone.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.bored import bored
from mechwright_cam.proof.cutting_rules import BEYOND, MIDDLE, ROUGHING_PLAY, SHAVES, cutting_data
from mechwright_cam.proof.loads import Loads
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Boundary
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.spotted import drill_off_spot
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind

POINTS = frozenset({ToolKind.DRILL, ToolKind.SPOT_DRILL, ToolKind.REAMER, ToolKind.TAP})
"""Tools that cut with their end alone, straight down."""


def edges(scene: Scene) -> Check:
    """Tools meet material with nothing but their cutting edges."""
    run, paths, stock = scene.run, scene.paths, scene.stock
    cuts = paths.cuts[paths.low[paths.cuts] < -NEAR]
    way = paths.end - paths.start
    sideways = (np.hypot(*way[:, :2].T) > NEAR) | (run.kind == Kind.ARC)
    for tool in scene.tools.values():
        mine = cuts[run.tool[cuts] == tool.number]
        name = f"T{tool.number} ({tool.name})"
        if tool.kind in POINTS:
            for step in stock.suspects(mine[sideways[mine]]).tolist():
                if stock.meets(step):
                    return scene.bad(step, f"{name} is fed sideways into material, and cuts downwards only")
        if tool.hollow == 0:
            continue
        # What of the middle is below the plate meets nothing of it.
        least = float(cutter(tool).height_at(tool.hollow))
        lift = np.maximum(least, -scene.job.thickness - paths.low[mine])
        inner = np.isin(mine, stock.suspects(mine, lift=lift, radius=tool.hollow))
        down = (tool.kind is ToolKind.THREAD_MILL) & ~sideways[mine] & (way[mine, 2] < 0)
        for index in np.flatnonzero(inner | down).tolist():
            step = int(mine[index])
            if inner[index] and stock.meets(step, lift=float(lift[index]), radius=tool.hollow):
                return scene.bad(step, f"{name} {_hollow(tool)}", 2 * tool.hollow, 0.0, "mm")
            if down[index] and stock.meets(step, radius=tool.radius - SHAVES):
                message = f"{name} is fed down into material, and cuts sideways only; make its hole first"
                return scene.bad(step, message)
    return drill_off_spot(scene) or Check(True, "tools meet material with nothing but their cutting edges")


def _hollow(tool: Tool) -> str:
    if tool.kind is ToolKind.THREAD_MILL:
        return (
            f"is fed into material with its neck of {2 * tool.hollow:g} mm, and cuts with the teeth at its "
            "rim; make the hole of the thread's core first"
        )
    if tool.kind is ToolKind.REAMER:
        return (
            "is fed into material with its middle, and cuts with its rim; open its hole to "
            f"{2 * tool.hollow:g} mm at least first"
        )
    if tool.kind is ToolKind.TAP:
        return (
            "is fed into material with its core, and cuts with its teeth alone; drill the hole of its thread "
            f"to {tool.diameter - (tool.pitch or 0.0):g} mm first, deep enough for its chamfer"
        )
    return (
        "is fed into material with its point, which does not cut; keep the point beside the material, or set "
        "centre_cutting in the tool library if it engraves"
    )


WITHIN = 0.8
"""Straight down, the outer fifth of a mill's radius cuts well: it is fast."""


SKIM = 0.3
"""A mill may go so far into material, mm, as roughing leaves on floors, before its plunge feed counts."""


def plunges(scene: Scene) -> Check:
    """No mill goes down into material faster than its middle cuts, straight or on a steep ramp."""
    for step, tool, found, limit in too_steep(scene):
        feed = float(scene.run.feed[step])
        message = (
            f"F{feed:g} takes T{tool.number} ({tool.name}) down into {scene.job.part.material} at "
            f"{found:.0f} mm/min, {limit:.0f} at most; lower F to {math.floor(feed * limit / found)}, or "
            "ramp less steeply"
        )
        return scene.bad(step, message, found, limit, "mm/min")
    return Check(True, "no mill goes down into material faster than its middle cuts")


@lru_cache(maxsize=1)  # planning lowers feeds by it, and the proof asks the same scene again
def too_steep(scene: Scene) -> tuple[tuple[int, Tool, float, float], ...]:
    """The steps that go down too fast: step, tool, its speed downwards and the greatest one, mm/min."""
    return tuple(_too_steep(scene))


def _too_steep(scene: Scene) -> Iterator[tuple[int, Tool, float, float]]:
    run, paths = scene.run, scene.paths
    rpm = run.of_states(lambda state: state.rpm)
    drop = paths.start[:, 2] - paths.end[:, 2]
    down = run.feed * np.clip(drop / np.maximum(paths.length, NEAR), 0.0, 1.0)
    cuts = paths.cuts[(drop[paths.cuts] > NEAR) & (paths.low[paths.cuts] < -NEAR)]
    for tool, data in cutting_data(scene):
        if tool.kind not in MILLS and tool.kind is not ToolKind.CHAMFER:
            continue
        # Beside that, a mill goes down along a wall, and takes what is left there with its rim.
        beside = SKIN * scene.job.settings.stock_to_leave + ROUGHING_PLAY
        flat = tool.kind in MILLS and tool.nose == 0
        radius = min((WITHIN if flat else MIDDLE) * tool.radius, tool.radius - beside)
        mine = cuts[run.tool[cuts] == tool.number]
        share = BEYOND * data.plunge
        most = share * data.chip_load * rpm[mine] * tool.flutes
        if radius <= 0:
            continue
        lift = max(float(cutter(tool).height_at(radius)), SKIM)
        fast = np.flatnonzero(down[mine] > most + 1.0)
        fast = fast[~bored(scene.paths, scene.stock.cuts, mine[fast], lift=lift, radius=radius)]
        fast = fast[np.isin(mine[fast], scene.stock.suspects(mine[fast], lift=lift, radius=radius))]
        for index in fast.tolist():
            step, limit = int(mine[index]), float(most[index])
            if _sliver(scene, tool, step):
                continue
            if not scene.stock.meets(step, lift=lift, radius=radius):
                continue
            yield step, tool, float(down[step]), limit


SLIVER = 0.2
"""Straight down, less than this share of a cutter's area is what other cutters left between their cuts."""


def _sliver(scene: Scene, tool: Tool, step: int) -> bool:
    """Whether a move straight down takes next to nothing, as measured on the grid."""
    loads = scene.simulation.loads
    section = loads.section[loads.down & (loads.first <= step) & (loads.last >= step)]
    return bool(section.size and section.max() < SLIVER * math.pi * tool.radius**2)


SKIN = 1.5
"""A cut that takes no more beside a wall than so many times what is left there is a finishing cut; in corners
that is as much."""
ONE_SIDED = 0.3
"""Material is on one side of a path if its middle is so far off it, in radii."""
LASTS = 3.0
"""Finishing the wrong way round is told of if it lasts for so many diameters: leads and corners do not."""


def climb(scene: Scene) -> Check:
    """Walls are finished the way round that the job asks for."""
    cam = scene.job.settings
    wanted, other = ("climb", "conventional") if cam.climb else ("conventional", "climb")
    found = against(scene)
    if found is None:
        return Check(True, f"walls are finished by {wanted} milling")
    step, tool, length = found
    message = (
        f"T{tool.number} ({tool.name}) finishes {length:.0f} mm of wall by {other} milling, the job asks for "
        f"{wanted}; turn the path round"
    )
    if "climb" in cam.model_fields_set:
        return scene.bad(step, message, length, LASTS * tool.diameter, "mm")
    told = scene.bad(step, message).message.replace("the job asks for", "the usual way is")
    return Check(True, told.removesuffix("; turn the path round"), line=int(scene.run.line[step]), told=True)


def against(scene: Scene) -> tuple[int, Tool, float] | None:
    """The first step, the tool, and the length, mm, of finishing that goes the other way round than planned.

    That is so if most of what a tool takes in finishing cuts is on the wrong side.
    """
    cam, loads = scene.job.settings, scene.simulation.loads
    for number, tool in scene.tools.items():
        if tool.kind not in MILLS:
            continue
        mine = loads.only(loads.tool == number)
        skin = mine.only(
            ~mine.down & (mine.width <= min(SKIN * cam.stock_to_leave + ROUGHING_PLAY, tool.radius / 2))
        )
        turned = skin.only((skin.side if cam.climb else -skin.side) > ONE_SIDED)
        turned = turned.only(np.isin(turned.step, _at_walls(scene, turned.step)))
        if float(turned.path.sum()) <= LASTS * tool.diameter:
            continue
        skin = skin.only(np.isin(skin.step, _at_walls(scene, skin.step)))
        skin = skin.only(~_to_and_fro(scene, skin))
        side = skin.side if cam.climb else -skin.side
        wrong = side > ONE_SIDED
        length = float(skin.path[wrong].sum())
        if length > LASTS * tool.diameter and _volume(skin, wrong) > _volume(skin, side < -ONE_SIDED):
            return int(skin.step[wrong][0]), tool, length
    return None


RETURNED = 0.25
"""A way down that goes back by this part of its length goes to and fro."""


def _to_and_fro(scene: Scene, loads: Loads) -> NDArray[np.bool_]:
    """(n,) which pieces of path are of a way down that goes to and fro, and so mills either way.

    Moves down that follow on each other are one way down.
    """
    paths = scene.paths
    ramp = scene.run.cutting & (paths.start[:, 2] - paths.end[:, 2] > NEAR)
    way, mine = np.cumsum(~ramp)[loads.step], ramp[loads.step]
    sides = [np.bincount(way, loads.path * (mine & (side * loads.side > ONE_SIDED))) for side in (1, -1)]
    returns = np.minimum(*sides) > RETURNED * np.maximum(*sides)
    return np.asarray(mine & returns[way], dtype=np.bool_)


AT_WALL = 0.02
"""The edge of a mill that finishes a wall is so near to it, mm."""


def _at_walls(scene: Scene, steps: Ints) -> Ints:
    """Those of the steps in which the edge of the tool runs along a finished wall."""
    paths, steps = scene.paths, np.unique(steps)
    if not steps.size:
        return steps
    lines, radius = paths.lines(paths.whole(steps)), paths.radius[steps]
    found = np.zeros(steps.size, dtype=np.bool_)
    for band in bands(scene.job):
        if not band.keep.is_empty:
            away = Boundary(band.keep).distance(lines, within=float(radius.max()) + AT_WALL)
            found |= (np.abs(away - radius) < AT_WALL) & (paths.low[steps] < band.top - NEAR)
    at: Ints = steps[found]
    return at


def _volume(loads: Loads, which: NDArray[np.bool_]) -> float:
    return float((loads.path * loads.section)[which].sum())
