"""Rules about what the edges of a cutter bear: speed, chips, and how deep a drill goes in one go.

They ask what the tool library says of the cutter in the material of the part; of one that it says nothing of
they know nothing. Programs of others cut otherwise than ours, so only what is far beyond is refused.
"""

import math

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.materials import material
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.rubbing import rubs
from mechwright_cam.proof.scene import Scene, in_work
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import MILLS, CuttingData, Tool, ToolKind

BEYOND = 1.5
"""Speeds, depths, and feeds of what is no mill, may be so many times the library's: tables of makers differ
by as much, and a wrong digit is more."""
THIN_CHIPS = 3.0
"""Feed per tooth of a mill in chip loads: where it takes little, chips are thinner. Beyond, nobody feeds into
material."""
MIDDLE = 0.5
"""Radius of the middle of a mill in radii: beside it a quarter of the diameter may be in a wall."""
SHAVES = 0.05
"""A mill on its way through what is cleared may shave so much off a wall, mm."""
ROUGHING_PLAY = 0.1
"""What roughing leaves on walls may be so much more than planned without being in the middle, mm."""


def cutting_data(scene: Scene) -> list[tuple[Tool, CuttingData]]:
    """The tools whose edges the library knows in this material."""
    name = scene.job.part.material
    return [(tool, tool.cutting[name]) for tool in scene.tools.values() if name in tool.cutting]


def cutting_speed(scene: Scene) -> Check:
    """No edge runs much faster than the tool library says, unless the spindle turns no slower."""
    run, machine = scene.run, scene.job.settings.machine
    rpm = scene.run.of_states(lambda state: state.rpm)
    working = in_work(scene)
    for tool, data in cutting_data(scene):
        highest = max(1000 * BEYOND * data.cutting_speed / (math.pi * tool.diameter), machine.spindle_min)
        fast = np.flatnonzero(working & (run.tool == tool.number) & (rpm > highest + 1.0))
        if fast.size:
            step = int(fast[0])
            speed = math.pi * tool.diameter * float(rpm[step]) / 1000
            message = (
                f"S{rpm[step]:g} turns T{tool.number} ({tool.name}) at {speed:.0f} m/min in "
                f"{scene.job.part.material}, the tool library says {data.cutting_speed:g}; lower S, or set "
                f"cutting_speed in [cam.cutting.{tool.name}]"
            )
            return scene.bad(step, message, speed, BEYOND * data.cutting_speed, "m/min")
    return Check(True, "no edge runs much faster than the tool library says")


def chips(scene: Scene) -> Check:
    """Nothing is fed into material much faster than the tool library says, nor so slowly that edges rub."""
    run, paths = scene.run, scene.paths
    full = _full_chips(scene)
    rpm = scene.run.of_states(lambda state: state.rpm)
    working = paths.steps[in_work(scene)[paths.steps] & (rpm[paths.steps] > 0)]
    for tool, data in cutting_data(scene):
        steps = working[run.tool[working] == tool.number]
        way = paths.end[steps] - paths.start[steps]
        plunge = (way[:, 2] < 0) & (paths.length[steps] <= -way[:, 2] + NEAR)
        if tool.kind in {ToolKind.DRILL, ToolKind.SPOT_DRILL, ToolKind.REAMER, ToolKind.TAP}:
            steps, plunge = steps[plunge], plunge[plunge]
        # Straight down a flat end has no place where chips are thin.
        thick = (plunge & (tool.nose == 0)) | (tool.kind not in MILLS) | np.isin(steps, full)
        share = np.where(thick, BEYOND, THIN_CHIPS)
        # Whole feeds are as near as some posts come to a small one.
        fastest = share * data.chip_load * rpm[steps] * tool.flutes + 1.0
        fast = np.flatnonzero(run.feed[steps] > fastest)
        teeth = run.feed[steps[fast]] / rpm[steps[fast]] / tool.flutes
        lift, radius = _where_thick(tool, BEYOND * data.chip_load / teeth)
        suspect = np.isin(steps[fast], scene.stock.suspects(steps[fast], lift=lift, radius=radius))
        for one in np.flatnonzero(suspect).tolist():
            index, tooth = int(fast[one]), float(teeth[one])
            step = int(steps[index])
            reach = None if np.isnan(radius[one]) else float(radius[one])
            if not scene.stock.meets(step, lift=float(lift[one]), radius=reach):
                continue
            feed, turns = float(run.feed[step]), float(rpm[step])
            message = (
                f"F{feed:g} at S{turns:g} feeds T{tool.number} ({tool.name}) {tooth:.3f} mm per tooth into "
                f"{scene.job.part.material}, the tool library says {data.chip_load:g}; lower F, or set "
                f"chip_load in [cam.cutting.{tool.name}]"
            )
            return scene.bad(step, message, tooth, float(share[index]) * data.chip_load, "mm")
    said = "nothing is fed into material much faster than the tool library says, or so slowly that edges rub"
    return rubs(scene, cutting_data(scene)) or Check(True, said)


def _full_chips(scene: Scene) -> Ints:
    """The steps in which a mill takes so much that its chips are too thick, as measured on the grid.

    That is so for two windows on end at least: a corner is over sooner.
    """
    loads = scene.simulation.loads
    limits = {tool.number: BEYOND * data.chip_load for tool, data in cutting_data(scene)}
    limit = np.array([limits.get(number, np.inf) for number in loads.tool.tolist()])
    thick = ~loads.down & (loads.chip > limit)
    lasting = thick[1:] & thick[:-1] & (np.diff(loads.step) <= 1)
    found: Ints = np.unique(loads.step[1:][lasting])
    return found


def _where_thick(tool: Tool, thin: Array) -> tuple[Array, Array]:
    """Where chips are thicker than shares (n,) of the feed per tooth: height above the tip and radius, mm.

    The radius of what is no mill is NaN: all of it counts.

    They are f_z sin θ with the engagement θ of a mill, which reaches in by r (1 - cos θ); where a rounded
    corner cuts, less by the sine of the angle of its edge.
    """
    if tool.kind not in MILLS:
        return np.zeros(thin.size), np.full(thin.size, np.nan)
    on_nose = tool.radius - tool.nose * (1 - np.maximum(thin, MIDDLE))
    radius = np.minimum(tool.radius * np.sqrt(1 - thin**2) - SHAVES, on_nose)
    return cutter(tool).height_at(radius), radius


def meets_middle(scene: Scene, tool: Tool, step: int, above: float) -> bool:
    """Whether the middle of a mill meets material in a move, so far above the tip or higher, mm.

    A move that only shaves a wall, or the cusps on a floor, does not.
    """
    radius = middle(scene, tool)
    lift = max(above, float(cutter(tool).height_at(radius)))
    return scene.stock.meets(step, lift=lift, radius=radius)


def middle(scene: Scene, tool: Tool) -> float:
    """Radius of the middle of a mill, mm, 0 if it has none: what roughing leaves on a wall is beside it."""
    beside = tool.radius - MIDDLE * tool.radius
    return MIDDLE * tool.radius if scene.job.settings.stock_to_leave + ROUGHING_PLAY <= beside else 0.0


def pecks(scene: Scene) -> Check:
    """Drills come out, or break the chip, before chips jam."""
    paths, run = scene.paths, scene.run
    diameters = BEYOND * material(scene.job.part.material).unbroken
    for tool in scene.tools.values():
        if tool.kind is not ToolKind.DRILL:
            continue
        steps: Ints = paths.cuts[run.tool[paths.cuts] == tool.number]
        top = np.minimum(paths.start[steps, 2], 0.0)
        deep = top - paths.end[steps, 2]
        for index in np.flatnonzero(deep > diameters * tool.diameter + NEAR).tolist():
            step = int(steps[index])
            found = float(top[index] - paths.end[step, 2])
            if found > diameters * tool.diameter and scene.stock.meets(step):
                message = (
                    f"T{tool.number} ({tool.name}) drills {found:.1f} mm in one go, "
                    f"{diameters * tool.diameter:.1f} mm at most; use G73 or G83 with a smaller Q"
                )
                return scene.bad(step, message, found, diameters * tool.diameter, "mm")
    return Check(True, "no drill goes too deep in one go")
