"""Feeds so slow that no edge gets a chip: it rubs, work-hardens what it should cut, and is blunt soon.

The edge of a new mill is round by some 2 µm: what is fed less than that it slides over instead of going in.
Programs of others are slower than ours and cut well; refused is what is below that and far below the library.
"""

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.loads import Loads
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.shop.tool import MILLS, CuttingData, Tool

THINNEST = 0.002
"""Feed per tooth below which edges rub, mm: about their own radius when new."""
FAR_BELOW = 0.1
"""Nothing that has so much of the library's chip load is refused: small cutters are sharper, and the chip
load of some is no more than ``THINNEST``."""


def rubs(scene: Scene, known: list[tuple[Tool, CuttingData]]) -> Check | None:
    """The first stretch of path, a diameter long, in which an edge takes something and gets no chip.

    ``known`` are the tools whose edges the library knows in this material. A stretch is as fast as its
    fastest move, so that a corner or the last of a lead is none.
    """
    loads = scene.simulation.loads
    for tool, data in known:
        bound = min(THINNEST, FAR_BELOW * data.chip_load)
        limit = np.where(loads.down, data.plunge if tool.kind in MILLS else 1.0, 1.0) * bound
        slow = (loads.tool == tool.number) & (loads.rpm > 0) & (loads.tooth < limit)
        for window in np.flatnonzero(slow).tolist():
            least, tooth = float(limit[window]), float(loads.tooth[window])
            if tooth * at_the_edge(loads, scene.paths, window) >= least:
                continue
            step = int(loads.step[window])
            rpm, feed = float(loads.rpm[window]), float(loads.feed[window])
            faster = int(np.ceil(data.chip_load * rpm * tool.flutes * (limit[window] / bound)))
            message = (
                f"F{feed:g} at S{rpm:g} feeds T{tool.number} ({tool.name}) {1000 * tooth:.2g} µm per tooth "
                f"into {scene.job.part.material}, and below {1000 * least:.2g} µm an edge rubs instead of "
                f"cutting; raise F to some {faster}, as the tool library says, or lower S"
            )
            return scene.bad(step, message, tooth, least, "mm")
    return None


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
