"""Pictures of jobs as SVG."""

from mechwright_cam.picture.frame import DETAIL, Frame
from mechwright_cam.picture.paths import tool_colours
from mechwright_cam.picture.plan import plan_view

__all__ = ["DETAIL", "Frame", "plan_view", "tool_colours"]
