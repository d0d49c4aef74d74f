"""The cuts of a program, as operations add them."""

import math
from collections.abc import Callable
from typing import NamedTuple

from mechwright_cam.operations.congruent import Copies
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.rates import rates
from mechwright_cam.program.moves import Move
from mechwright_cam.setup.holding import Tab
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool


def slope(tool: Tool, settings: CamSettings) -> float:
    """Tangent of the steepest ramp that a tool may go down."""
    return math.tan(math.radians(min(settings.ramp_angle, tool.ramp_angle or settings.ramp_angle)))


class Cut(NamedTuple):
    """One cut with one tool."""

    name: str
    tool: Tool
    moves: tuple[Move, ...]


class Steps:
    """The cuts of a job so far, in the order in which they were added."""

    def __init__(self, job: Job, clearance: float) -> None:
        self.job, self.clearance = job, clearance
        self.copies = Copies()
        self.cuts: list[Cut] = []

    def step_down(self, tool: Tool) -> float:
        """Deepest pass of a mill that cuts with its whole width, mm."""
        return tool.cutting[self.job.part.material].step_down * tool.diameter

    def moves(
        self,
        tool: Tool,
        write: Callable[[Pen], object],
        engagement: float = math.pi / 2,
        depth: float = math.inf,
        over: tuple[Tab, ...] = (),
    ) -> tuple[Move, ...]:
        """The moves that ``write`` makes; a cut is ``depth`` mm deep where that makes chips thinner.

        Below a right angle of ``engagement``, rad, chips are thinner as well.
        """
        settings = self.job.settings
        depth = depth if settings.chip_thinning else math.inf
        speed = rates(tool, self.job.part.material, settings.machine, engagement, depth)
        pen = Pen(tool, speed, self.clearance, slope(tool, settings), over)
        write(pen)
        return tuple(pen.moves)

    def add(
        self,
        name: str,
        tool: Tool,
        write: Callable[[Pen], object],
        engagement: float = math.pi / 2,
        depth: float = math.inf,
    ) -> None:
        """Add a cut; see :meth:`moves`. One without any moves is none."""
        self.cuts.append(Cut(name, tool, self.moves(tool, write, engagement, depth)))
