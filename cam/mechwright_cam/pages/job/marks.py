"""Marks of a job: what the proof found, plunges, ways over tabs, and ways past what holds the part."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import shapely

from mechwright_cam.controls.reading import Kind
from mechwright_cam.pages.job.steps import line_numbers, places
from mechwright_cam.proof.loads import first_greatest
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check, Proof
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.tool_collisions import Body, Obstacle, bodies, obstacles

OVER = 0.25
"""A cut that is so little above a tab runs over it, mm."""

CHORD = 0.02
"""Chord error of arcs, mm."""

Mark = dict[str, Any]


def marks_of(scene: Scene, proof: Proof) -> list[Mark]:
    """All marks: failures, then what passed and names a place, then the rest in the program's order."""
    found = [_of_check(scene, check) for check in proof.failures]
    passed = [check for check in proof.checks.values() if check.passed]
    found += [_of_check(scene, check) for check in passed if check.line is not None or check.at is not None]
    rest = [*_plunges(scene), *_over_tabs(scene), *_nearest(scene), *_hardest(scene)]
    return found + sorted(rest, key=lambda mark: mark["step"])


def _mark(kind: str, text: str, step: int, at: tuple[float, ...] | None = None) -> Mark:
    place = None if at is None or not np.isfinite(at).all() else [round(float(part), 4) for part in at]
    return {"kind": kind, "text": text, "step": step, **({"at": place} if place else {})}


def _of_check(scene: Scene, check: Check) -> Mark:
    step = -1
    if check.line is not None:
        here = scene.run.line == check.line
        if scene.run.files:
            here &= scene.run.file == check.file
        steps = np.flatnonzero(here)
        if steps.size:
            ends = scene.run.end[steps]
            off = np.linalg.norm(ends - (check.at or (np.nan,) * 3), axis=1)
            step = int(steps[np.nanargmin(off)] if np.isfinite(off).any() else steps[-1])
    name = check.name.replace("-", " ")
    return _mark("passed" if check.passed else "failed", f"{name}: {check.message}", step, check.at)


def _line(scene: Scene, step: int) -> str:
    return f"line {int(line_numbers(scene)[step]) + 1}"


def _plunges(scene: Scene) -> Iterator[Mark]:
    """The first straight way down at a feed into the plate of each tool, and how many there are."""
    run = scene.run
    start, end = places(scene)
    upright = np.hypot(*(end - start)[:, :2].T) <= NEAR
    down = run.cutting & upright & (end[:, 2] < start[:, 2] - NEAR) & (end[:, 2] < -NEAR)
    for number in np.unique(run.tool[down]).tolist():
        steps = np.flatnonzero(down & (run.tool == number))
        first = int(steps[0])
        x, y, z = end[first].tolist()
        more = (
            ["", ", and once more"][steps.size - 1]
            if steps.size <= 2
            else f", and {steps.size - 1} times more"
        )
        text = f"T{number} plunges to Z{z:.3f} at X{x:.3f} Y{y:.3f}, {_line(scene, first)}{more}"
        yield _mark("plunge", text, first, (x, y, z))


def _over_tabs(scene: Scene) -> Iterator[Mark]:
    """The first step that runs over each tab at its top, or cuts into it."""
    paths = scene.paths
    for number, tab in enumerate(scene.job.tabs, start=1):
        pieces = paths.below(tab.top + OVER, steps=paths.cuts)
        if not len(pieces):
            continue
        lines = paths.lines(pieces, CHORD)
        reach = paths.radius[pieces.step]
        over = shapely.distance(tab.level, lines) < reach - NEAR
        deep = pieces.low > tab.top - CHORD
        for which, words in ((over & deep, "runs over"), (over & ~deep, "cuts beside or into")):
            hit = np.flatnonzero(which)
            if hit.size:
                step = int(pieces.step[hit[0]])
                text = f"tab {number}: {_line(scene, step)} {words} it at Z{float(pieces.low[hit[0]]):.3f}"
                yield _mark("tab", text, step, (*tab.at, tab.top))
                break


def _nearest(scene: Scene) -> Iterator[Mark]:
    """For everything that holds the part, how near each tool comes to it below its top."""
    every = bodies(scene)
    for one in obstacles(scene):
        for tool in scene.tools.values():
            own = [body for body in every if body.tool.number == tool.number]
            whole = [Body(tool, "cutter", 0.0, tool.radius), *own]
            found = [mark for body in whole if (mark := _beside(scene, one, body)) is not None]
            if found:
                yield min(found, key=lambda pair: pair[0])[1]


def _beside(scene: Scene, one: Obstacle, body: Body) -> tuple[float, Mark] | None:
    paths = scene.paths
    steps = paths.steps[(scene.run.tool[paths.steps] == body.tool.number) & (paths.steps > one.since)]
    pieces = paths.below(one.top - body.lift - NEAR, steps=steps)
    if not len(pieces):
        return None
    gaps = shapely.distance(one.shape, paths.lines(pieces, CHORD)) - one.radius - body.radius
    place = int(np.argmin(gaps))
    gap, step = float(gaps[place]), int(pieces.step[place])
    text = f"{body.name} of T{body.tool.number} comes within {gap:.2f} mm of {one.name}, {_line(scene, step)}"
    return gap, _mark("near", text, step, tuple(scene.run.end[step].tolist()))


def _hardest(scene: Scene) -> Iterator[Mark]:
    """Where each tool works hardest: the window with the greatest power."""
    loads = scene.simulation.loads
    for number in np.unique(loads.tool).tolist():
        own = np.flatnonzero(loads.tool == number)
        place = int(own[first_greatest(loads.power[own])])
        step = int(loads.step[place])
        angle = float(np.degrees(loads.engagement[place]))
        text = (
            f"T{number} works hardest: {float(loads.power[place]):.2f} kW, {angle:.0f}° of it in material, "
            f"{float(loads.depth[place]):.2f} mm deep, {_line(scene, step)}"
        )
        yield _mark("load", text, step, tuple(scene.run.end[step].tolist()))


KINDS = {int(kind): kind.name.lower() for kind in Kind}
"""Number of a kind of step to its word on the page."""
