"""The cuts of a program, as operations add them."""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from mechwright_cam.operations.bending import pass_depth
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
    """The cuts of a job so far, in the order in which they were added.

    ``depths`` says how deep below the top of the stock its mills cut, mm, by their names: a mill that cuts
    deep somewhere stands out of its holder everywhere.
    """

    def __init__(self, job: Job, clearance: float, depths: Mapping[str, float] | None = None) -> None:
        self.job, self.clearance, self.depths = job, clearance, depths or {}
        self.copies = Copies()
        self.cuts: list[Cut] = []
        self.held = 0
        """How many of them have been looked at."""

    def step_down(self, tool: Tool, *, to_size: bool = False) -> float:
        """Deepest pass of a mill with its whole width, mm; ``to_size`` if it leaves no allowance."""
        return pass_depth(self.job, tool, self.depths.get(tool.name, 0.0), to_size=to_size)

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
