"""Pictures of jobs as SVG."""

from mechwright_cam.pages.picture.frame import DETAIL, Frame
from mechwright_cam.pages.picture.paths import tool_colours
from mechwright_cam.pages.picture.plan import plan_view

__all__ = ["DETAIL", "Frame", "plan_view", "tool_colours"]
