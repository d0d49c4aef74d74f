"""Rules about where the tool goes: each looks at one thing, and gives one check."""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.part import Pocket
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import run_out, stock_shape
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stock import TOUCH
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind


def travel(scene: Scene) -> Check:
    """The moves fit into the machine: where the stock is clamped if that is known, else wherever it is."""
    paths, machine = scene.paths, scene.job.settings.machine
    if paths.steps.size == 0:
        return Check("travel", True, "no moves")
    least, most = paths.extent()
    heights = np.stack((scene.run.start[paths.steps, 2], scene.run.end[paths.steps, 2]))
    heights[np.isinf(heights)] = np.nan  # the machine's upper end is within its travel
    low, high = np.fmin(*heights), np.fmax(*heights)
    for axis, lower, upper, limit in (
        ("X", least[:, 0], most[:, 0], machine.travel_x),
        ("Y", least[:, 1], most[:, 1], machine.travel_y),
        ("Z", low, high, machine.travel_z),
    ):
        if np.isnan(lower).all():
            continue
        extent = float(np.nanmax(upper) - np.nanmin(lower))
        if extent > limit:
            # Furthest from the middle: the move that a stray coordinate belongs to.
            middle = np.nanmedian(lower)
            far = int(np.nanargmax(np.maximum(np.abs(upper - middle), np.abs(lower - middle))))
            return scene.bad(
                "travel",
                int(paths.steps[far]),
                f"the moves span {extent:.1f} mm in {axis}, the machine travels {limit:g} mm",
                extent,
                limit,
                "mm",
            )
        beyond = _beyond(scene, axis, lower, upper, limit)
        if beyond is not None:
            return beyond
    return Check("travel", True, "all moves are within the machine's travel")


def _beyond(scene: Scene, axis: str, lower: Array, upper: Array, limit: float) -> Check | None:
    """The move that leaves the travel furthest, where offsets and the ends of travel are known."""
    cam, steps = scene.job.settings, scene.paths.steps
    low: float | None = getattr(cam.machine, f"low_{axis.lower()}")
    place: float | None = getattr(cam.measured, axis.lower())
    if low is None or place is None:
        return None
    length = np.zeros(steps.size)
    if axis == "Z":
        known = {n: tool.length for n, tool in scene.tools.items() if tool.length is not None}
        length = np.array([known.get(number, np.nan) for number in scene.run.tool[steps].tolist()])
    over = np.fmax(low - (lower + place + length), upper + place + length - (low + limit))
    if np.isnan(over).all() or np.nanmax(over) <= NEAR:
        return None
    worst = int(np.nanargmax(over))
    found = float(over[worst])
    return scene.bad(
        "travel",
        int(steps[worst]),
        f"the move leaves the travel of {axis} by {found:.1f} mm (machine {axis} {low:g} to {low + limit:g}, "
        f"work offset at {place:g}); clamp the stock elsewhere",
        found,
        0.0,
        "mm",
    )


def flutes(scene: Scene) -> Check:
    """No tool goes deeper than its flutes reach."""
    run = scene.run
    for number, tool in scene.tools.items():
        deep = np.where((run.tool == number) & run.cutting, -run.end[:, 2], -np.inf)
        worst = int(np.argmax(deep)) if deep.size else 0
        if deep.size and deep[worst] > tool.flute_length + NEAR:
            found = float(deep[worst])
            return scene.bad(
                "flutes",
                worst,
                f"T{number} ({tool.name}) cuts {found:.3f} mm deep, its flutes are {tool.flute_length:g} mm",
                found,
                tool.flute_length,
                "mm",
            )
    return Check("flutes", True, "no tool cuts deeper than its flutes")


BELOW = 1.0
"""Cuts through the plate may go so much further below it than planned, mm: the setup sheet tells of the room
that they need; a wrong digit is more."""


def underside(scene: Scene) -> Check:
    """Nothing goes much further below the plate than cuts through it have to: there is a table or a vice."""
    paths, job = scene.paths, scene.job
    low = np.minimum(paths.start[paths.steps, 2], paths.end[paths.steps, 2])
    shape = paths.cutters(paths.steps)
    point = np.where(np.isfinite(shape.slope) | (shape.nose > 0), shape.height_at(shape.radius), 0.0)
    over = job.floor - BELOW - point - low
    worst = int(np.argmax(over)) if over.size else 0
    if over.size and over[worst] > NEAR:
        deep = -float(low[worst]) - job.thickness
        limit, tool = deep - float(over[worst]), scene.run.tool[paths.steps[worst]]
        return scene.bad(
            "underside",
            int(paths.steps[worst]),
            f"T{tool} goes {deep:.2f} mm below the plate, {limit:.2f} mm at most; "
            "set cam.breakthrough if there is room",
            deep,
            limit,
            "mm",
        )
    return Check("underside", True, "no tool goes further below the plate than cuts through it have to")


def beside(scene: Scene) -> Check:
    """No cut goes on far outside of the stock and of what is drawn: that is a program for another plate."""
    job, cuts = scene.job, scene.stock.cuts
    if cuts.size:
        least, most = scene.stock.extents
        drawn = [inside_of(feature).bounds for feature in job.features if isinstance(feature, Pocket)]
        x0, y0, x1, y1 = shapely.total_bounds(shapely.box(*np.array([job.stock, *drawn]).T))
        away = np.maximum((x0, y0) - least, most - (x1, y1)).max(axis=1)
        limit = run_out(2 * scene.paths.radius[cuts])
        worst = int(np.argmax(away - limit))
        if away[worst] > limit[worst]:
            found, allowed = float(away[worst]), float(limit[worst])
            return scene.bad(
                "beside",
                int(cuts[worst]),
                f"cuts {found:.1f} mm outside of the stock, {allowed:g} mm at most; the program is for "
                "another part, place or work offset",
                found,
                allowed,
                "mm",
            )
    return Check("beside", True, "no cut goes on far outside of the stock")


def rapid_height(scene: Scene) -> Check:
    """Sideways rapids over the stock run at the clearance plane or above."""
    paths, limit = scene.paths, scene.job.settings.clearance
    rapid = paths.steps[scene.run.kind[paths.steps] == Kind.RAPID]
    start, end = paths.start[rapid], paths.end[rapid]
    sideways = np.hypot(*(end - start)[:, :2].T) > NEAR
    low = rapid[sideways & (np.minimum(start[:, 2], end[:, 2]) < limit - NEAR)]
    if low.size:
        lines = paths.lines(paths.below(np.inf, steps=low))
        over = low[shapely.dwithin(lines, stock_shape(scene.job), paths.radius[low])]
        if over.size:
            step = int(over[0])
            z = float(min(paths.start[step, 2], paths.end[step, 2]))
            return scene.bad(
                "rapid-height",
                step,
                f"a sideways rapid over the stock at Z{z:g}, the clearance plane is Z{limit:g}",
                z,
                limit,
                "mm",
            )
    return Check(
        "rapid-height", True, "sideways rapids run at the clearance plane or above", limit=limit, unit="mm"
    )


def rapids_in_stock(scene: Scene) -> Check:
    """No rapid meets material, nor ends right on it."""
    found = [step for step in _low_rapids(scene).tolist() if scene.stock.meets(step)]
    for step in [] if found else _onto_stock(scene).tolist():
        z = float(scene.paths.end[step, 2])
        if scene.stock.meets(step, lift=-z - TOUCH, radius=float(scene.paths.radius[step])):
            return scene.bad(
                "rapids-in-stock",
                step,
                f"a rapid ends {z:g} mm above the stock, less than {ABOVE:g} mm; feed the rest",
                z,
                ABOVE,
                "mm",
            )
    if found:
        return Check(
            "rapids-in-stock",
            False,
            scene.bad("", found[0], f"a rapid into the stock ({len(found)} in all); feed there").message,
            scene.line(found[0]),
            float(len(found)),
            0.0,
            "",
            scene.where(found[0]),
        )
    return Check("rapids-in-stock", True, "no rapid meets material", value=0.0, limit=0.0)


ABOVE = 0.2
"""Rapids down end at least so far above the stock, mm: plates are uneven, and tools are set, to tenths."""


def _onto_stock(scene: Scene) -> Ints:
    """Rapids that end down on the top of the stock, or nearly so."""
    paths = scene.paths
    rapid = paths.steps[scene.run.kind[paths.steps] == Kind.RAPID]
    z = paths.end[rapid, 2]
    onto: Ints = rapid[(z < ABOVE - NEAR) & (z >= -NEAR) & (z < paths.start[rapid, 2])]
    return onto


def _low_rapids(scene: Scene) -> Ints:
    """Rapids that end or run below the top of the stock; straight up follows the tool's own hole."""
    paths = scene.paths
    rapid = paths.steps[scene.run.kind[paths.steps] == Kind.RAPID]
    start, end = paths.start[rapid], paths.end[rapid]
    sideways = np.hypot(*(end - start)[:, :2].T) > NEAR
    low = np.minimum(start[:, 2], end[:, 2]) < -NEAR
    low_rapids: Ints = rapid[low & (sideways | (end[:, 2] < start[:, 2]))]
    return low_rapids


def entries(scene: Scene) -> Check:
    """Ramps into material are gentle, and only centre-cutting tools plunge."""
    run, paths = scene.run, scene.paths
    limit = scene.job.settings.ramp_angle
    steps = paths.steps[run.cutting[paths.steps]]
    drop = paths.start[steps, 2] - paths.end[steps, 2]
    straight = np.hypot(*(paths.end[steps, :2] - paths.start[steps, :2]).T)
    flat = np.where(run.kind[steps] == Kind.ARC, np.abs(run.sweep[steps]) * run.radius[steps], straight)
    angle = np.degrees(np.arctan2(drop, flat))
    plunges = {n for n, t in scene.tools.items() if t.centre_cutting or t.kind not in MILLS}
    plunge = flat <= NEAR
    allowed = plunge & np.isin(run.tool[steps], list(plunges))
    # Both ends are rounded in the text: a ramp may end a last decimal lower, and be one and a half shorter.
    digit = 10.0**-scene.control.decimals
    steep = drop > (flat + 1.5 * digit) * np.tan(np.radians(limit)) + digit
    threading = [n for n, t in scene.tools.items() if t.kind is ToolKind.THREAD_MILL]
    # A thread mill goes down a finished hole, as steeply as its pitch asks.
    allowed |= _down_a_tab(scene, steps, drop, flat) & np.isin(run.tool[steps], list(plunges))
    suspect = steep & ~np.isin(run.tool[steps], threading) & (paths.end[steps, 2] < -NEAR) & ~allowed
    for index in np.flatnonzero(suspect).tolist():
        step = int(steps[index])
        if not scene.stock.meets(step):
            continue
        tool = scene.tools[int(run.tool[step])]
        if plunge[index]:
            return scene.bad(
                "entries",
                step,
                f"T{tool.number} ({tool.name}) plunges into the stock and does not cut at its centre",
            )
        found = float(angle[index])
        return scene.bad(
            "entries",
            step,
            f"T{tool.number} ({tool.name}) ramps into the stock at {found:.1f} degrees, "
            f"the limit is {limit:g}",
            found,
            limit,
            "deg",
        )
    return Check(
        "entries", True, "entries are ramps or plunges that the tools can do", limit=limit, unit="deg"
    )


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
            lines = paths.lines(paths.below(np.inf, steps=steps[index]))
            reach = paths.radius[steps[index]] + (job.settings.breakthrough + TAB_RISE) / tab.slope
            found[index] = shapely.dwithin(tab.shape, lines, reach)
    return found


def holder(scene: Scene) -> Check:
    """Shank and holder stay out of the stock and of finished walls, where the tool library knows them."""
    paths, run = scene.paths, scene.run
    for body in bodies(scene):
        low = np.minimum(paths.start[:, 2], paths.end[:, 2]) + body.lift
        steps = paths.steps[(run.tool[paths.steps] == body.tool.number) & (low[paths.steps] < -NEAR)]
        # The deepest first: if they pass where material may still be, the others nearly always do.
        for step in steps[np.argsort(low[steps], kind="stable")].tolist():
            if scene.stock.meets(step, lift=body.lift, radius=body.radius):
                return scene.bad(
                    "holder",
                    step,
                    f"the {body.name} of T{body.tool.number} ({body.tool.name}), {2 * body.radius:g} mm wide "
                    f"from {body.lift:g} mm above the tip, goes {-low[step]:.2f} mm deep into material; "
                    "let the tool stick out further",
                    float(-low[step]),
                    0.0,
                    "mm",
                )
    return Check("holder", True, "shank and holder stay out of stock and walls")


@dataclass(frozen=True)
class Body:
    """What is above a tool's flutes: a cylinder from ``lift`` above the tip."""

    tool: Tool
    name: str
    lift: float
    radius: float


def bodies(scene: Scene) -> list[Body]:
    """Shanks and holders, as far as the tool library knows them."""
    bodies = []
    for tool in scene.tools.values():
        if tool.shank_diameter is not None and tool.shank_diameter > tool.diameter:
            bodies.append(Body(tool, "shank", tool.flute_length, tool.shank_diameter / 2))
        if tool.stick_out is not None:
            bodies.append(Body(tool, "holder", tool.stick_out, tool.holder_diameter / 2))
    return bodies
