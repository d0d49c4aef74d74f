"""Whether drills go down where a hole has been begun: beside its spot or pilot a drill follows that."""

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.shop.tool import ToolKind

ASIDE = 0.02
"""So far beside a spot a drill may go down, mm: its own runout is as much."""


def drill_off_spot(scene: Scene) -> Check | None:
    """The first drill that goes down into material off the middle of a spot or a pilot of its hole."""
    kinds = {number: tool.kind for number, tool in scene.tools.items()}
    first, place = _plunges(scene, {ToolKind.SPOT_DRILL, ToolKind.DRILL}, kinds)
    radius, tool = scene.paths.radius[first], scene.run.tool[first]
    spots = np.array([kinds[number] is ToolKind.SPOT_DRILL for number in tool.tolist()], dtype=np.bool_)
    drills = np.flatnonzero(~spots)
    if not drills.size:
        return None
    tree = shapely.STRtree(shapely.points(place))
    drill, begun = tree.query(shapely.points(place[drills]), predicate="dwithin", distance=radius[drills])
    drill = drills[drill]
    before = (first[begun] < first[drill]) & (spots[begun] | (radius[begun] < radius[drill] - NEAR))
    drill, begun = drill[before], begun[before]
    off = np.hypot(*(place[drill] - place[begun]).T)
    least = np.full(first.size, np.inf)
    np.minimum.at(least, drill, off)
    for at in np.flatnonzero((least > ASIDE) & np.isfinite(least)).tolist():
        step = int(first[at])
        if scene.stock.meets(step):
            other = int(begun[(drill == at) & (off == least[at])][0])
            one, two = (scene.tools[int(tool[index])] for index in (at, other))
            message = (
                f"T{one.number} ({one.name}) goes down {least[at]:.3f} mm beside the middle of what "
                f"T{two.number} ({two.name}) has begun, and follows that; drill both at one place"
            )
            return scene.bad(step, message, float(least[at]), ASIDE, "mm")
    return None


def _plunges(scene: Scene, wanted: set[ToolKind], kinds: dict[int, ToolKind]) -> tuple[Ints, Array]:
    """The first steps (n,) straight down below the top at each place (n, 2) of each tool of some kinds."""
    paths, run = scene.paths, scene.run
    numbers = [number for number, kind in kinds.items() if kind in wanted]
    steps: Ints = paths.cuts[np.isin(run.tool[paths.cuts], numbers)]
    way = paths.end[steps] - paths.start[steps]
    straight: NDArray[np.bool_] = (np.hypot(way[:, 0], way[:, 1]) <= NEAR) & (way[:, 2] < 0)
    steps = steps[straight & (paths.end[steps, 2] < -NEAR)]
    rounded = np.rint(paths.end[steps, :2] / NEAR).astype(np.int64)
    _, once = np.unique(np.column_stack((run.tool[steps], rounded)), axis=0, return_index=True)
    first = steps[np.sort(once)]
    return first, paths.end[first, :2]
