"""How cutters go into material, and that rapids do not."""

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import stock_shape
from mechwright_cam.proof.cutting_rules import BEYOND, cutting_data
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stock import MOST_TOLD, TOUCH, UNEVEN
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind

STEEPEST = 15.0
"""Ramp, degrees, that a centre-cutting mill goes down at the feed of its cut if its maker says nothing: data
sheets have 3 to 15 for full slots. A steeper one is as good as a plunge, and needs its feed."""


def entries(scene: Scene) -> Check:
    """Ramps into material are as gentle as the tools ask for, and only centre-cutting tools plunge."""
    run, paths = scene.run, scene.paths
    steps = paths.cuts
    drop = paths.start[steps, 2] - paths.end[steps, 2]
    straight = np.hypot(*(paths.end[steps, :2] - paths.start[steps, :2]).T)
    flat = np.where(run.kind[steps] == Kind.ARC, np.abs(run.sweep[steps]) * run.radius[steps], straight)
    angle = np.degrees(np.arctan2(drop, flat))
    limit = paths.of_tool(lambda tool: steepest(tool, scene.job.settings.ramp_angle))[steps]
    # Both ends are rounded in the text: a ramp may end a last decimal lower, and be one and a half shorter.
    digit = scene.control.resolution
    steep = drop > (flat + 1.5 * digit) * np.tan(np.radians(np.minimum(limit, UPRIGHT))) + digit
    plunges = [n for n, t in scene.tools.items() if t.centre_cutting or t.kind not in MILLS]
    plunge = flat <= NEAR
    allowed = (plunge | _slowly(scene, steps) | _down_a_tab(scene, steps, drop, flat)) & np.isin(
        run.tool[steps], plunges
    )
    # A thread mill goes down a finished hole, as steeply as its pitch asks.
    threading = [n for n, t in scene.tools.items() if t.kind is ToolKind.THREAD_MILL]
    suspect = steep & ~np.isin(run.tool[steps], threading) & (paths.end[steps, 2] < -NEAR) & ~allowed
    for index in np.flatnonzero(np.isin(steps, scene.stock.suspects(steps[suspect]))).tolist():
        step = int(steps[index])
        if not scene.stock.meets(step):
            continue
        tool = scene.tools[int(run.tool[step])]
        if plunge[index]:
            message = f"T{tool.number} ({tool.name}) plunges into the stock and does not cut at its centre"
            return scene.bad(step, message)
        found, most = float(angle[index]), float(limit[index])
        message = (
            f"T{tool.number} ({tool.name}) ramps into the stock at {found:.1f} degrees, the limit is {most:g}"
        )
        return scene.bad(step, message, found, most, "deg")
    return Check(True, "entries are ramps or plunges that the tools can do")


UPRIGHT = 89.9
"""From this angle on a ramp is a plunge, degrees."""


def steepest(tool: Tool, planned: float) -> float:
    """Steepest ramp of a tool, degrees: as its maker says, or as planned if it is steeper than usual."""
    if tool.ramp_angle is not None:
        return tool.ramp_angle
    return max(planned, STEEPEST) if tool.centre_cutting else planned


def _slowly(scene: Scene, steps: Ints) -> NDArray[np.bool_]:
    """(n,) whether a move is no faster than its tool may plunge."""
    run, fastest = scene.run, np.zeros(len(scene.run))
    rpm = run.of_states(lambda state: state.rpm)
    for tool, data in cutting_data(scene):
        mine = run.tool == tool.number
        fastest[mine] = BEYOND * data.plunge * data.chip_load * rpm[mine] * tool.flutes
    slow: NDArray[np.bool_] = run.feed[steps] <= fastest[steps]
    return slow


TAB_RISE = 0.005
"""A path down a ramped tab may be so much steeper than the tab's side over its whole length, mm: the gouge
limit, as the tab itself may be off by that."""


def _down_a_tab(scene: Scene, steps: Ints, drop: Array, flat: Array) -> NDArray[np.bool_]:
    """(n,) whether a move goes down the side of a ramped tab: no further than the tab is high."""
    found = np.zeros(steps.size, dtype=bool)
    job, paths = scene.job, scene.paths
    for tab in job.tabs:
        if not tab.ramped:
            continue
        gentle = (drop > 0) & (drop <= flat * tab.slope + TAB_RISE) & (drop <= tab.top - job.floor + TAB_RISE)
        index = np.flatnonzero(gentle & (paths.start[steps, 2] <= tab.top + TAB_RISE) & ~found)
        if index.size:
            lines = paths.lines(paths.whole(steps[index]))
            reach = paths.radius[steps[index]] + (job.settings.breakthrough + TAB_RISE) / tab.slope
            found[index] = shapely.dwithin(tab.shape, lines, reach)
    return found


ABOVE = UNEVEN
"""Rapids down end at least so far above the stock, mm."""


def rapid_height(scene: Scene) -> Check:
    """Sideways rapids over the stock run at the clearance plane or above.

    Where all that stands there is named, and no such plane is asked for, they only stay off the stock: cycles
    with G99 go from hole to hole at their R plane.
    """
    paths, limit = scene.paths, scene.job.settings.clearance
    least, named = scene.clear, "the clearance plane is"
    if _all_is_known(scene):
        limit = least = min(limit, max(scene.job.highest, 0.0) + ABOVE)
        named = "the least is"
    rapid = paths.rapids
    sideways = np.hypot(*(paths.end - paths.start)[rapid, :2].T) > NEAR
    low = rapid[sideways & (paths.low[rapid] < least - NEAR)]
    if low.size:
        over = low[shapely.dwithin(paths.room(paths.whole(low)), stock_shape(scene.job), paths.radius[low])]
        if over.size:
            step = int(over[0])
            z = float(paths.low[step])
            where, other = (
                ("over", "set cam.clearance if nothing stands higher") if z >= 0 else ("in", "feed")
            )
            message = (
                f"a sideways rapid {where} the stock at Z{z:g}, {named} Z{limit:g}; "
                f"go up first, or {other} there"
            )
            return scene.bad(step, message, z, limit, "mm")
    return Check(True, "sideways rapids run at the clearance plane or above", limit=limit, unit="mm")


def _all_is_known(scene: Scene) -> bool:
    """Whether all that stands on the plate is named, and no design says how high rapids cross it."""
    cam = scene.job.settings
    return cam.hold.method == "none" and "clearance" not in cam.model_fields_set


def rapids_in_stock(scene: Scene) -> Check:
    """No rapid meets material, nor ends right on it."""
    found = scene.stock.rapids
    for step in [] if found else _onto_stock(scene).tolist():
        z = float(scene.paths.end[step, 2])
        if scene.stock.meets(step, lift=-z - TOUCH, radius=float(scene.paths.radius[step])):
            message = f"a rapid ends {z:g} mm above the stock, less than {ABOVE:g} mm; feed the rest"
            return scene.bad(step, message, z, ABOVE, "mm")
    beside = None if found else scene.stock.rapid_at_side
    if beside is not None:
        message = f"a rapid goes down less than {UNEVEN:g} mm beside the stock; feed there, or keep off more"
        return scene.bad(beside, message, 0.0, UNEVEN, "mm")
    if found:
        many = f"{len(found)} or more" if len(found) == MOST_TOLD else f"{len(found)} in all"
        message = f"a rapid into the stock ({many}); feed there"
        return scene.bad(found[0], message, float(len(found)), 0.0)
    return Check(True, "no rapid meets material", value=0.0, limit=0.0)


def _onto_stock(scene: Scene) -> Ints:
    """Rapids that end down on the top of the stock, or nearly so."""
    paths = scene.paths
    rapid = paths.rapids
    z = paths.end[rapid, 2]
    onto: Ints = rapid[(z < ABOVE - NEAR) & (z >= -NEAR) & (z < paths.start[rapid, 2])]
    onto = onto[~scene.stock.in_own_hole(onto, np.full(onto.size, -TOUCH))]
    return scene.stock.suspects(onto, lift=-paths.end[onto, 2] - TOUCH, radius=paths.radius[onto])
