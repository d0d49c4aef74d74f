"""Shank and holder: what is above the flutes of a tool."""

from dataclasses import dataclass

import numpy as np

from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
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
