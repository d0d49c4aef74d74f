"""What a program leaves of the plate for the setup that follows: regions by depth.

Nothing is handed on that was not cut: regions are smaller by their accuracy, and of a pointed tool only what
it takes at a few heights counts.
"""

import shapely

from mechwright.contracts.details import Chamfer
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.plane import Shape, swept
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.sweep import ROUNDING
from mechwright_cam.proof.target_shape import TAB_SLACK
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import ToolKind

SWEPT = 0.01
"""Accuracy of what a setup hands on to the next, mm: the leftover limit; never more than was cut."""
SHARES = (0.25, 0.5, 0.75, 1.0)
"""Shares of a chamfer's width, of a round corner, or of a drill's point, at which they are handed on."""
HEIGHT_DIGITS = 3
"""Decimals of heights, mm: nearer ones are one."""


def cut_away(scene: Scene) -> tuple[tuple[Shape, float], ...]:
    """Regions that a program has cut down to a height z, mm, deepest first; higher ones hold deeper ones.

    The heights are those of the job's floors, tabs and details, and of the holes that the program drills.
    """
    found = list[tuple[Shape, float]]()
    for height in sorted(_heights(scene.paths, scene.job)):
        cut = scene.sweeps.at(height + ROUNDING, height)
        areas = [swept(sweep.chains, sweep.radius, SWEPT) for sweep in cut]
        region = shapely.buffer(shapely.union_all(areas), -SWEPT, quad_segs=4)
        if not region.is_empty and not (found and region.area <= found[-1][0].area + NEAR):
            found.append((region, height))
    return tuple(found)


def _heights(paths: Paths, job: Job) -> set[float]:
    floors = {-job.thickness, *(-(feature.top + feature.depth) for feature in job.features)}
    heights = floors | {tab.top + TAB_SLACK for tab in job.tabs}
    for detail in job.details:
        if isinstance(detail, Chamfer):
            heights |= {-detail.width * share for share in SHARES}
        else:
            heights.add(-detail.depth)
    run, steps = paths.run, paths.of_kinds({ToolKind.DRILL, ToolKind.SPOT_DRILL, ToolKind.TAP}).steps
    down = steps[(run.kind[steps] == Kind.FEED) & (paths.end[steps, 2] < paths.start[steps, 2])]
    full = paths.cutters(down).height_at(paths.radius[down])
    noses = {tool.nose for tool in paths.tools.values() if tool.nose > 0}
    for share in SHARES:
        heights |= {height + share * nose for height in floors for nose in noses}
        heights |= set((paths.end[down, 2] + share * full).tolist())
    rounded = {round(height, HEIGHT_DIGITS) for height in heights}
    return {max(height, -job.thickness) for height in rounded if height < -NEAR}
