"""Feeds so slow that no edge gets a chip: it rubs, work-hardens what it should cut, and is blunt soon.

The edge of a new mill is round by some 2 µm: what is fed less than that it slides over instead of going in.
Programs of others are slower than ours and cut well; refused is what is below that and far below the library.
"""

import math

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.loads import Loads
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.shop.power import THINNEST
from mechwright_cam.shop.tool import MILLS, CuttingData, Tool, ToolKind

DOWNWARDS = frozenset({ToolKind.DRILL, ToolKind.SPOT_DRILL, ToolKind.REAMER})
"""What is fed along its axis alone."""
FAR_BELOW = 0.1
"""Nothing that has so much of the library's chip load is refused: small cutters are sharper, and the chip
load of some is no more than ``THINNEST``."""


def rubs(scene: Scene, known: list[tuple[Tool, CuttingData]]) -> Check | None:
    """The first stretch of path, a diameter long, in which an edge takes something and gets no chip.

    ``known`` are the tools whose edges the library knows in this material. A stretch is as fast as its
    fastest move, so that a corner or the last of a lead is none.
    """
    for tool, data in known:
        bound = min(THINNEST, FAR_BELOW * data.chip_load)
        slow = _drilled(scene, tool, bound) if tool.kind in DOWNWARDS else _milled(scene, tool, data, bound)
        if slow is None:
            continue
        step, feed, share = slow
        rpm = float(scene.run.states[int(scene.run.state[step])].rpm)
        tooth, least = feed / rpm / tool.flutes, share * bound
        faster = math.ceil(data.chip_load * rpm * tool.flutes * share)
        message = (
            f"F{feed:g} at S{rpm:g} feeds T{tool.number} ({tool.name}) {1000 * tooth:.2g} µm per tooth "
            f"into {scene.job.part.material}, and below {1000 * least:.2g} µm an edge rubs instead of "
            f"cutting; raise F to some {faster}, as the tool library says, or lower S"
        )
        return scene.bad(step, message, tooth, least, "mm")
    return None


def _milled(scene: Scene, tool: Tool, data: CuttingData, bound: float) -> tuple[int, float, float] | None:
    """The first step in which a tool rubs in a stretch, its feed, and how much of the bound counts there."""
    loads = scene.simulation.loads
    share = np.where(loads.down, data.plunge if tool.kind in MILLS else 1.0, 1.0)
    slow = (loads.tool == tool.number) & (loads.rpm > 0) & (loads.tooth < share * bound)
    for window in np.flatnonzero(slow).tolist():
        if loads.tooth[window] * at_the_edge(loads, scene.paths, window) < share[window] * bound:
            return int(loads.step[window]), float(loads.feed[window]), float(share[window])
    return None


def _drilled(scene: Scene, tool: Tool, bound: float) -> tuple[int, float, float] | None:
    """The first step in which a drill, or its like, rubs; pecks may be shorter than a stretch."""
    run, steps = scene.run, scene.paths.cuts
    steps = steps[run.tool[steps] == tool.number]
    rpm = run.of_states(lambda state: state.rpm)[steps]
    slow = steps[(rpm > 0) & (run.feed[steps] < bound * rpm * tool.flutes)]
    nothing = np.zeros(slow.size)
    suspect = scene.stock.suspects(slow, lift=nothing, radius=np.full(slow.size, np.nan))
    found = next(
        (int(step) for step in suspect.tolist() if scene.stock.meets(step, lift=0.0, radius=None)), None
    )
    return None if found is None else (found, float(run.feed[found]), 1.0)


def at_the_edge(loads: Loads, paths: Paths, window: int) -> float:
    """How many times faster than its axis the edge of a cutter may go in a window: in a narrow hole it does.

    On an arc of radius R it is 1 + r / R times as fast. Chords round a hole no wider than two cutters are as
    good as an arc: infinitely faster, for nothing is known of it.
    """
    steps = np.arange(int(loads.first[window]), int(loads.last[window]) + 1)
    radius = float(loads.radius[window])
    arcs = steps[paths.run.kind[steps] == Kind.ARC]
    if arcs.size:
        return 1 + radius / max(float(paths.run.radius[arcs].min()), NEAR)
    if loads.down[window]:
        return 1.0
    at: Array = np.concatenate((paths.start[steps, :2], paths.end[steps, :2]))
    return 1.0 if np.ptp(at, axis=0).max() >= radius else np.inf
