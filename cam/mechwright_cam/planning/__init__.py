"""From a job to a neutral program: which cutter does what, in which order and how."""

from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.planner import plan
from mechwright_cam.planning.remarks import lay_out
from mechwright_cam.planning.selection import choose_tools

__all__ = ["Assignments", "choose_tools", "lay_out", "plan"]
