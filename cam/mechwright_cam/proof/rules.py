"""Rules about how the machine is run: each looks at one thing, and gives one check."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.tolerances import TOLERANCES
from mechwright.tooling import Tool, ToolKind
from mechwright_cam.interpreter import Kind, Run, State
from mechwright_cam.interpreter.run import Ints
from mechwright_cam.job import Job
from mechwright_cam.proof.bands import stock_shape
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.stock import Stock

MAX_DWELL = 10.0
"""Longest dwell that makes sense, s: beyond it, a control that counts milliseconds was meant."""
LAST_DECIMAL = 1e-4
"""A ramp may end this much lower than its angle allows, mm: both its ends are rounded in the text."""
SAFE_MODES = {"units": "G21", "distance": "G90", "plane": "G17", "cutter compensation": "G40"}


@dataclass(frozen=True)
class Scene:
    """A run, the job it should make, and where its tools go."""

    run: Run
    job: Job
    tools: dict[int, Tool]
    paths: Paths
    stock: Stock

    def where(self, step: int) -> tuple[float, float, float]:
        """End of a step."""
        x, y, z = self.run.end[step].tolist()
        return x, y, z

    def line(self, step: int) -> int:
        """Line of a step."""
        return int(self.run.line[step])

    def state(self, step: int) -> State:
        """Machine state in a step."""
        return self.run.states[int(self.run.state[step])]

    def of_states(self, value: Callable[[State], Any]) -> NDArray[Any]:
        """(n,) a value of the state each step runs in."""
        return np.array([value(state) for state in self.run.states])[self.run.state]

    def bad(
        self,
        name: str,
        step: int,
        message: str,
        value: float | None = None,
        limit: float | None = None,
        unit: str = "",
    ) -> Check:
        """A failed check that blames one step."""
        at = self.where(step)
        place = " ".join(f"{a}{v:.3f}" for a, v in zip("XYZ", at, strict=True) if np.isfinite(v))
        text = f"line {self.line(step)}: {message}" + (f", at {place}" if place else "")
        return Check(name, False, text, self.line(step), value, limit, unit, at)


Rule = Callable[[Scene], Check]


def _first(which: NDArray[np.bool_]) -> int | None:
    found = np.flatnonzero(which)
    return int(found[0]) if found.size else None


def _moving(run: Run) -> NDArray[np.bool_]:
    return np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC))


def _in_work(scene: Scene) -> NDArray[np.bool_]:
    """Feed moves below the top of the stock."""
    low = np.fmin(scene.run.start[:, 2], scene.run.end[:, 2])
    return scene.run.cutting & (low < -NEAR)


def program_end(scene: Scene) -> Check:
    """The program says that it ends, with the tool up."""
    run = scene.run
    if not run.ended:
        return Check("program-end", False, "the program has no end; write M30 or M2", run.lines)
    moved = np.flatnonzero(np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC, Kind.HOME)))
    if moved.size == 0 or not run.cutting.any():
        return Check("program-end", False, "the program cuts nothing", run.lines)
    last = int(moved[-1])
    height = float(run.end[last, 2])
    if not height >= scene.job.settings.clearance - NEAR:
        return scene.bad(
            "program-end", last, "the program ends with the tool down; retract with G53 G0 Z0", height
        )
    return Check("program-end", True, "the program ends with the tool up")


def modes(scene: Scene) -> Check:
    """Units, distances, plane and compensation are set before the first move in work coordinates."""
    step = _first(_moving(scene.run))
    if step is not None:
        missing = [word for group, word in SAFE_MODES.items() if group not in scene.state(step).stated]
        if missing:
            return scene.bad("modes", step, f"moves before {' '.join(missing)}; set the modes first")
    return Check("modes", True, "units, distance mode, plane and compensation are stated")


def tools_known(scene: Scene) -> Check:
    """Every tool that moves is one of the job."""
    run = scene.run
    step = _first(_moving(run) & ~np.isin(run.tool, list(scene.tools)))
    if step is not None:
        known = ", ".join(f"T{n}" for n in sorted(scene.tools)) or "none"
        number = int(run.tool[step])
        named = f"T{number} is not a tool of this job" if number else "no tool was changed to"
        return scene.bad("tools", step, f"{named}; its tools are {known}", number)
    return Check("tools", True, "all tools belong to the job")


def length_offset(scene: Scene) -> Check:
    """The active length offset is the tool's own before Z is moved to a height above the work."""
    run = scene.run
    offset = scene.of_states(lambda state: -2 if state.length_offset is None else state.length_offset)
    stated = _moving(run) & np.isfinite(run.end[:, 2]) & (run.tool > 0)
    step = _first(stated & (offset != run.tool))
    if step is not None:
        tool, active = int(run.tool[step]), int(offset[step])
        if active in {0, -2}:
            found = "Z is moved without a length offset"
        elif active == -1:
            found = "Z is moved with a length written into the program (G43.1)"
        else:
            found = f"Z is moved with H{active}"
        return scene.bad(
            "length-offset", step, f"{found} while T{tool} is in the spindle; write G43 H{tool}", active, tool
        )
    return Check("length-offset", True, "every tool moves Z under its own G43 H")


def work_offset(scene: Scene) -> Check:
    """All moves are made in the work offset of the job."""
    wanted = scene.job.settings.work_offset
    wrong = scene.of_states(lambda state: state.work_offset != wanted)
    step = _first(_moving(scene.run) & wrong)
    if step is not None:
        used = scene.state(step).work_offset or "no stated work offset"
        return scene.bad("work-offset", step, f"moves in {used}; the job is set up in {wanted}")
    return Check("work-offset", True, f"all moves are in {wanted}")


def positions(scene: Scene) -> Check:
    """No feed and no sideways rapid starts at a place or height that the program never stated."""
    run = scene.run
    sideways = np.nan_to_num(run.end[:, :2] - run.start[:, :2], nan=1.0).any(axis=1)
    unknown = ~np.isfinite(run.start).all(axis=1) | ~np.isfinite(run.end).all(axis=1)
    lost = np.isnan(run.start[:, 2]) | np.isnan(run.end[:, 2])
    step = _first((run.cutting & unknown) | ((run.kind == Kind.RAPID) & sideways & lost))
    if step is not None:
        return scene.bad(
            "positions", step, "moves from an unknown height or place; retract with G53 G0 Z0 first"
        )
    return Check("positions", True, "every move starts from a known height")


def spindle(scene: Scene) -> Check:
    """The spindle turns clockwise while the cutter is in the work."""
    turning = scene.of_states(lambda state: state.spindle if state.rpm > 0 else 0)
    step = _first(_in_work(scene) & (turning != 1))
    if step is not None:
        how = "backwards (M4)" if turning[step] == -1 else "not at all"
        return scene.bad(
            "spindle", step, f"feeds into the work while the spindle turns {how}; write S and M3"
        )
    return Check("spindle", True, "the spindle turns clockwise whenever the cutter is in the work")


def coolant(scene: Scene) -> Check:
    """Coolant runs as planned while the cutter is in the work."""
    wanted = scene.job.settings.coolant
    wrong = scene.of_states(lambda state: state.coolant != wanted)
    step = _first(_in_work(scene) & wrong)
    if step is not None:
        word = {"flood": "M8", "mist": "M7", "off": "M9"}[wanted]
        return scene.bad(
            "coolant",
            step,
            f"cuts with coolant {scene.state(step).coolant}, planned is {wanted}; write {word}",
        )
    return Check("coolant", True, f"coolant is {wanted} whenever the cutter is in the work")


def arcs(scene: Scene) -> Check:
    """Arcs end as far from their centre as they start."""
    error, limit = scene.run.arc_error, TOLERANCES.arc_fit
    worst = int(np.argmax(error)) if error.size else 0
    if error.size and error[worst] > limit:
        found = float(error[worst])
        return scene.bad(
            "arcs",
            worst,
            f"the arc's radii at its start and end differ by {found:.4f} mm, the limit is {limit:g} mm",
            found,
            limit,
            "mm",
        )
    return Check(
        "arcs", True, "all arcs are consistent", value=float(error.max(initial=0.0)), limit=limit, unit="mm"
    )


def feeds(scene: Scene) -> Check:
    """Feeds are within the machine's limit."""
    limit = scene.job.settings.machine.max_feed
    step = _first(scene.run.feed > limit + NEAR)
    if step is not None:
        found = float(scene.run.feed[step])
        return scene.bad(
            "feeds", step, f"F{found:g} is above the machine's {limit:g} mm/min", found, limit, "mm/min"
        )
    return Check("feeds", True, "feeds are within the machine's limit", limit=limit, unit="mm/min")


def speeds(scene: Scene) -> Check:
    """Spindle speeds are within the machine's limits."""
    machine = scene.job.settings.machine
    rpm = scene.of_states(lambda state: state.rpm if state.spindle else machine.spindle_min)
    wrong = (rpm > machine.spindle_max + NEAR) | (rpm < machine.spindle_min - NEAR)
    step = _first(_in_work(scene) & wrong)
    if step is not None:
        found = float(rpm[step])
        over = found > machine.spindle_max
        limit = machine.spindle_max if over else machine.spindle_min
        side = "above" if over else "below"
        return scene.bad(
            "speeds", step, f"S{found:g} is {side} the spindle's {limit:g} rpm", found, limit, "rpm"
        )
    return Check(
        "speeds", True, "speeds are within the spindle's limits", limit=machine.spindle_max, unit="rpm"
    )


def travel(scene: Scene) -> Check:
    """The moves fit into the machine, wherever the stock is clamped."""
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
    return Check("travel", True, "all moves are within the machine's travel")


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


def dwells(scene: Scene) -> Check:
    """No dwell is so long that its unit must be wrong."""
    step = _first(scene.run.seconds > MAX_DWELL)
    if step is not None:
        found = float(scene.run.seconds[step])
        return scene.bad(
            "dwells",
            step,
            f"waits for {found:g} s, at most {MAX_DWELL:g} s make sense; P is in seconds",
            found,
            MAX_DWELL,
            "s",
        )
    return Check("dwells", True, "dwells are short")


def tool_changes(scene: Scene) -> Check:
    """Tools are changed at a safe height."""
    run, clearance = scene.run, scene.job.settings.clearance
    step = _first((run.kind == Kind.TOOL) & ~(run.end[:, 2] >= clearance - NEAR))
    if step is not None:
        return scene.bad(
            "tool-change", step, "a tool is changed without a retract; write G53 G0 Z0 before it"
        )
    return Check("tool-change", True, "tools are changed at the machine's upper end")


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
    """No rapid meets material."""
    found = [step for step in _low_rapids(scene).tolist() if scene.stock.meets(step)]
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
    plunges = {n for n, t in scene.tools.items() if t.centre_cutting or t.kind is not ToolKind.END_MILL}
    plunge = flat <= NEAR
    allowed = plunge & np.isin(run.tool[steps], list(plunges))
    steep = drop > flat * np.tan(np.radians(limit)) + LAST_DECIMAL
    suspect = steep & (paths.end[steps, 2] < -NEAR) & ~allowed
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


def clamp(scene: Scene) -> Check:
    """The cutter stays clear of the clamp, from the stop on at which the operator sets it."""
    run, held, paths = scene.run, scene.job.clamp, scene.paths
    if held is None:
        return Check("clamp", True, "there is no clamp in the way")
    stops = np.flatnonzero(run.kind == Kind.STOP)
    # Without a stop it can only have been there from the start.
    pieces = paths.below(held.top - NEAR, steps=paths.steps[paths.steps > (stops[0] if stops.size else -1)])
    # No path leads further than its length.
    away = np.hypot(*(paths.start[pieces.step, :2] - held.centre).T) - np.nan_to_num(run.length[pieces.step])
    pieces = pieces.only(away < held.diameter / 2 + paths.radius[pieces.step])
    if len(pieces):
        gap = shapely.distance(paths.lines(pieces), shapely.Point(held.centre))
        room = gap - paths.radius[pieces.step] - held.diameter / 2
        worst = int(np.argmin(room))
        if room[worst] < 0:
            return scene.bad(
                "clamp",
                int(pieces.step[worst]),
                f"the cutter goes {-room[worst]:.2f} mm into the clamp (diameter {held.diameter:g} mm, "
                f"up to Z{held.top:g})",
                float(room[worst]),
                0.0,
                "mm",
            )
    return Check("clamp", True, "the cutter stays clear of the clamp")


RULES: tuple[Rule, ...] = (
    *(program_end, modes, tools_known, work_offset, length_offset, positions, tool_changes, spindle, coolant),
    *(arcs, feeds, speeds, dwells, travel, flutes, rapid_height, rapids_in_stock, entries, clamp),
)
"""All rules, in the order of the report."""
