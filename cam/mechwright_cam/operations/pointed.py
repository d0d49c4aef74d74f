"""Tools for details, and how wide the pointed ones are."""

import math

from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind


def tools_of(job: Job, kind: ToolKind) -> list[Tool]:
    """The job's tools of a kind that cut its material, widest first."""
    fit = [t for t in job.tools if t.kind is kind and job.part.material in t.cutting]
    return sorted(fit, key=lambda tool: -tool.diameter)


def spread(tool: Tool, height: float) -> float:
    """Radius of a pointed tool at a height above its tip, mm."""
    return tool.tip_diameter / 2 + height * math.tan(math.radians(tool.point_angle / 2))
