"""What must not meet: shank and holder with material, and any of a tool with a clamp or a vice's jaws."""

from dataclasses import dataclass

import numpy as np
import shapely

from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import NEAR, Pieces
from mechwright_cam.proof.plane import Shape
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stops import clamp_set
from mechwright_cam.shop.tool import Tool


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


def holder(scene: Scene) -> Check:
    """Shank and holder stay out of the stock and of finished walls, where the tool library knows them."""
    paths, run = scene.paths, scene.run
    for body in bodies(scene):
        low = paths.low + body.lift
        steps = paths.steps[(run.tool[paths.steps] == body.tool.number) & (low[paths.steps] < -NEAR)]
        steps = scene.stock.suspects(steps, lift=body.lift, radius=body.radius)
        # The deepest first: if they pass where material may still be, the others nearly always do.
        for step in steps[np.argsort(low[steps], kind="stable")].tolist():
            if scene.stock.meets(step, lift=body.lift, radius=body.radius):
                message = (
                    f"the {body.name} of T{body.tool.number} ({body.tool.name}), {2 * body.radius:g} mm wide "
                    f"from {body.lift:g} mm above the tip, goes {-low[step]:.2f} mm deep into material; "
                    "let the tool stick out further"
                )
                return scene.bad(step, message, float(-low[step]), 0.0, "mm")
    return Check(True, "shank and holder stay out of stock and walls")


@dataclass(frozen=True)
class Obstacle:
    """Something that reaches up to ``top``, z in mm: all within ``radius`` of a shape, from a step on."""

    name: str
    shape: Shape
    radius: float
    top: float
    since: int


def obstacles(scene: Scene) -> list[Obstacle]:
    """Clamp and jaws of the job; a clamp is set at a stop, jaws are there from the start."""
    job = scene.job
    found = [
        Obstacle(f"the {jaw.edge} jaw of the vice (up to Z{jaw.top:g})", jaw.shape, 0.0, jaw.top, -1)
        for jaw in job.jaws
    ]
    found += [
        Obstacle(f"toe clamp {toe.number} (up to Z{toe.top:g})", toe.shape, 0.0, toe.top, -1)
        for toe in job.toes
    ]
    if job.clamp is not None:
        since = clamp_set(scene)
        name = f"the clamp (diameter {job.clamp.diameter:g} mm, up to Z{job.clamp.top:g})"
        if since < 0:  # without a stop it can only have been there from the start
            name += f", which no {scene.control.m(0)} sets later"
        found.append(
            Obstacle(name, shapely.Point(job.clamp.centre), job.clamp.diameter / 2, job.clamp.top, since)
        )
    return found


def clamp(scene: Scene) -> Check:
    """Cutter, shank and holder stay clear of clamp and jaws."""
    paths, run = scene.paths, scene.run
    every = obstacles(scene)
    for one in every:
        after = paths.steps[paths.steps > one.since]
        check = _met(scene, one, "cutter", paths.below(one.top - NEAR, steps=after), None)
        if check is not None:
            return check
        for body in bodies(scene):
            own: Ints = after[run.tool[after] == body.tool.number]
            pieces = paths.below(one.top - body.lift - NEAR, steps=own)
            check = _met(scene, one, f"{body.name} of T{body.tool.number}", pieces, body.radius)
            if check is not None:
                return check
    if not every:
        return Check(True, "there is no clamp in the way")
    held = "jaws of the vice" if scene.job.jaws else "toe clamps" if scene.job.toes else "clamp"
    return Check(True, f"the cutter stays clear of the {held}")


def _met(scene: Scene, one: Obstacle, what: str, pieces: Pieces, radius: float | None) -> Check | None:
    """The failed check, if a cylinder along some pieces goes into an obstacle: the cutter, or a radius."""
    paths = scene.paths
    own = paths.radius if radius is None else np.full(len(scene.run), radius)
    # No path leads further than its length.
    away = shapely.distance(shapely.points(paths.start[pieces.step, :2]), one.shape)
    near = away - paths.length[pieces.step] < one.radius + own[pieces.step]
    pieces = pieces.only(near)
    if len(pieces) == 0:
        return None
    room = shapely.distance(paths.room(pieces), one.shape) - own[pieces.step] - one.radius
    worst = int(np.argmin(room))
    if room[worst] >= 0:
        return None
    advice = "" if radius is None else "; let the tool stick out further"
    message = f"the {what} goes {-room[worst]:.2f} mm into {one.name}{advice}"
    return scene.bad(int(pieces.step[worst]), message, float(room[worst]), 0.0, "mm")
