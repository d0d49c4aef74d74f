"""From a job to a neutral program: which cutter does what, in which order and how."""

from mechwright_cam.planning.planner import plan
from mechwright_cam.planning.selection import check_tools, choose_tools, lay_out

__all__ = ["check_tools", "choose_tools", "lay_out", "plan"]
