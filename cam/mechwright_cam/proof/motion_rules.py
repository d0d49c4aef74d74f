"""Rules about how far the tool goes: each looks at one thing, and gives one check."""

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Pocket
from mechwright_cam.proof.bands import run_out
from mechwright_cam.proof.machine_rules import retract
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import ROUNDED, Scene
from mechwright_cam.setup.views import inside_of


def travel(scene: Scene) -> Check:
    """The moves fit into the machine: where the stock is clamped if that is known, else wherever it is.

    Machine coordinates (G53) lie within both ends of every axis. Unknown ends and places are named.
    """
    paths, machine = scene.paths, scene.job.settings.machine
    outside = _outside(scene)
    if outside is not None:
        return outside
    if paths.steps.size == 0:
        return Check(True, "no moves")
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
            message = f"the moves span {extent:.1f} mm in {axis}, the machine travels {limit:g} mm"
            return scene.bad(_going_there(scene, int(paths.steps[far]), axis), message, extent, limit, "mm")
        beyond = _beyond(scene, axis, lower, upper, limit)
        if beyond is not None:
            return beyond
    unknown = _unknown(scene)
    if not unknown:
        return Check(True, "all moves are within the machine's travel")
    return Check(True, f"the moves span no more than the machine travels; not known is {unknown}")


def _unknown(scene: Scene) -> str:
    """What is not known of where the moves lie in the machine; empty if all is."""
    cam = scene.job.settings
    ends = [f"cam.machine.low_{axis}" for axis in cam.machine.open_axes]
    places = [f"cam.measured.{axis}" for axis in "xyz" if getattr(cam.measured, axis) is None]
    used = sorted({*scene.run.tool[scene.paths.steps].tolist()} & scene.tools.keys())
    lengths = [f"the length of T{number}" for number in used if scene.tools[number].length is None]
    return ", ".join([*ends, *places, *lengths])


def _outside(scene: Scene) -> Check | None:
    """The first move in machine coordinates that goes beyond an end of its axis."""
    machine = scene.job.settings.machine
    ends = {axis: machine.ends(axis.lower()) for axis in "XYZ"}
    for place in scene.run.machine_places:
        for axis, value in place.axes.items():
            low, high = ends[axis]
            if not low - ROUNDED <= value <= high + ROUNDED:
                limit = high if value > high else low
                known = getattr(machine, f"low_{axis.lower()}") is not None
                remedy = retract(scene) if axis == "Z" else "write a place between them"
                if not known:
                    remedy += (
                        f", or, if these ends are wrong, set cam.machine.low_{axis.lower()} to the lower one"
                    )
                message = (
                    f"goes to machine {axis} {value:g}, and {axis} travels from {low:g} to {high:g}; {remedy}"
                )
                return scene.bad(place.step, message, value, limit, "mm")
    return None


def _going_there(scene: Scene, step: int, axis: str) -> int:
    """A step, or the move before that has gone to where it starts, if that is where it is furthest.

    A move from a place that the text does not say is none of the paths.
    """
    run, at = scene.run, "XYZ".index(axis)
    there = abs(run.start[step, at]) >= abs(run.end[step, at])
    return step - 1 if step and there and run.moving[step - 1] else step


def _beyond(scene: Scene, axis: str, lower: Array, upper: Array, limit: float) -> Check | None:
    """The move that leaves the travel furthest, where offsets and the ends of travel are known."""
    cam, steps = scene.job.settings, scene.paths.steps
    place: float | None = getattr(cam.measured, axis.lower())
    if axis.lower() in cam.machine.open_axes or place is None:
        return None
    low = cam.machine.ends(axis.lower())[0]
    length = np.zeros(steps.size)
    if axis == "Z":
        length = scene.paths.of_tool(lambda tool: None if tool.length is None else tool.worn_length)[steps]
    over = np.fmax(low - (lower + place + length), upper + place + length - (low + limit))
    if np.isnan(over).all() or np.nanmax(over) <= NEAR:
        return None
    worst = int(np.nanargmax(over))
    found = float(over[worst])
    message = (
        f"the move leaves the travel of {axis} by {found:.1f} mm (machine {axis} {low:g} to {low + limit:g}, "
        f"work offset at {place:g}); clamp the stock elsewhere"
    )
    return scene.bad(int(steps[worst]), message, found, 0.0, "mm")


def flutes(scene: Scene) -> Check:
    """No tool goes deeper than its flutes reach."""
    run = scene.run
    for number, tool in scene.tools.items():
        deep = np.where((run.tool == number) & run.cutting, -run.end[:, 2], -np.inf)
        worst = int(np.argmax(deep)) if deep.size else 0
        if deep.size and deep[worst] > tool.flute_length + NEAR:
            found = float(deep[worst])
            message = (
                f"T{number} ({tool.name}) cuts {found:.3f} mm deep, its flutes are {tool.flute_length:g} mm"
            )
            return scene.bad(worst, message, found, tool.flute_length, "mm")
    return Check(True, "no tool cuts deeper than its flutes")


BELOW = 1.0
"""Cuts through the plate may go so much further below it than planned, mm: the setup sheet tells of the room
that they need; a wrong digit is more."""


def underside(scene: Scene) -> Check:
    """Nothing goes much further below the plate than cuts through it have to: there is a table or a vice."""
    paths, job = scene.paths, scene.job
    low = paths.low[paths.steps]
    shape = paths.cutters(paths.steps)
    point = np.where(np.isfinite(shape.slope) | (shape.nose > 0), shape.height_at(shape.radius), 0.0)
    over = job.floor - BELOW - point - low
    worst = int(np.argmax(over)) if over.size else 0
    if over.size and over[worst] > NEAR:
        deep = -float(low[worst]) - job.thickness
        limit, tool = deep - float(over[worst]), scene.run.tool[paths.steps[worst]]
        message = (
            f"T{tool} goes {deep:.2f} mm below the plate, {limit:.2f} mm at most; "
            "set cam.breakthrough if there is room"
        )
        return scene.bad(int(paths.steps[worst]), message, deep, limit, "mm")
    return Check(True, "no tool goes further below the plate than cuts through it have to")


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
            message = (
                f"cuts {found:.1f} mm outside of the stock, {allowed:g} mm at most; the program is for "
                "another part, place or work offset"
            )
            return scene.bad(int(cuts[worst]), message, found, allowed, "mm")
    return Check(True, "no cut goes on far outside of the stock")
