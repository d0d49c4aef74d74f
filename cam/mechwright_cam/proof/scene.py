"""What all rules look at."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.contracts.declared import Declared
from mechwright.contracts.guard import UnsoundError
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.lookahead import Motion
from mechwright_cam.controls.offsets import place_of
from mechwright_cam.controls.reading import Run, State
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.details import deepest, deepest_in_fillet, heights
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.footprint import Footprint, footprint
from mechwright_cam.proof.gouge import Gouge, deepest_cut, deepest_in_tab, worst_of
from mechwright_cam.proof.leftover import Remains, remains
from mechwright_cam.proof.misfit import misfit
from mechwright_cam.proof.off_path import OffPath
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.pieces import Pieces
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.several import alike, at_offset
from mechwright_cam.proof.simulation import Simulation, simulate
from mechwright_cam.proof.stock import Stock
from mechwright_cam.proof.sweep import Sweeps
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind


def _hold_line(check: Check, *_: object) -> None:
    if len(check.message.splitlines()) != 1:
        raise UnsoundError(f"message of what it gives is {check.message!r:.80}; one line is wanted")


OneLineCheck = Annotated[Check, Declared(finite=False, nan=True), _hold_line]
"""A check with a message of one line; a place that is not known is NaN."""

_OF_MOVES = frozenset(
    {
        "motion",
        "off_path",
        "sweeps",
        "stock",
        "footprint",
        "pieces",
        "simulation",
        "gouge",
        "in_tab",
        "remains",
    }
    | {"misfit"}
)
"""What follows from the moves and the part alone, and not from the work offset in which they are made."""


@dataclass(frozen=True, eq=False)
class Scene:
    """A program, the job that it should make, and all that follows from both: each thing worked out once."""

    text: str | Mapping[str, str]
    """The program as the control would get it, from this project's posts or from anywhere; several files,
    name to text, if they are run one after the other."""
    job: Job
    """The part, its stock, its holding and the tools on the machine."""
    control: Control
    """The control that reads it."""
    block_delete: bool = False
    """Whether the switch is on that skips lines which start with ``/``."""

    @cached_property
    def run(self) -> Run:
        """The program as run; raises ProgramError that names file and line.

        Of a program for several plates it is what is done at the work offset of the job.
        """
        return self.read()

    def read(self, more: float = 0.0) -> Run:
        """Run the program on the machine of the job, each D as a radius ``more`` mm larger than planned."""
        diameters = {number: 2 * (d + more) for number, d in planned_offsets(self.job).items()}
        upper_end = self.control.upper_end(self.job.settings.machine)
        run = self.control.read(
            self.text, block_delete=self.block_delete, upper_end=upper_end, diameters=diameters
        )
        others = self.job.settings.more_offsets
        return at_offset(run, others, [place_of(other) for other in others]) if others else run

    def at(self, offset: str) -> "Scene":
        """The same program at another of the work offsets of the job.

        What is worked out here is not worked out again where it does the same there.
        """
        other = replace(self, job=replace(self.job, settings=self.job.settings.at(offset)))
        if alike(self.run, other.run):
            worked = {name: found for name, found in self.__dict__.items() if name in _OF_MOVES}
            other.__dict__.update(worked)
        return other

    @cached_property
    def tools(self) -> dict[int, Tool]:
        """T number to tool."""
        return {tool.number: tool for tool in self.job.tools}

    @cached_property
    def motion(self) -> Motion:
        """How the control runs through the moves: how long, and how far off the path."""
        return self.motions(())[0]

    def motions(self, shares: Sequence[float]) -> list[Motion]:
        """That, and what it were with some shares of the machine's acceleration."""
        machine = self.job.settings.machine
        accelerations = [machine.acceleration, *(share * machine.acceleration for share in shares)]
        found = self.control.lookahead.motions(self.run, machine, accelerations)
        self.__dict__["motion"] = found[0]  # in passing
        return found

    @cached_property
    def paths(self) -> Paths:
        """Where the tools go."""
        return Paths(self.run, self.job.tools)

    @cached_property
    def off_path(self) -> OffPath:
        """What they cut where the control leaves the path."""
        return OffPath(self.paths, self.job)

    @cached_property
    def sweeps(self) -> Sweeps:
        """What they cut, by height."""
        return Sweeps(self.paths)

    @cached_property
    def stock(self) -> Stock:
        """The plate while the program runs."""
        return Stock(self.paths, self.job)

    @cached_property
    def footprint(self) -> Footprint:
        """By which step the plate is cut through, cell by cell."""
        return footprint(self.paths, self.job)

    @cached_property
    def pieces(self) -> Pieces:
        """The pieces that it falls into."""
        return Pieces(self.footprint)

    @cached_property
    def simulation(self) -> Simulation:
        """The plate on a grid, and how hard the tools work."""
        return simulate(self.paths, self.job)

    @cached_property
    def gouge(self) -> Gouge | None:
        """The deepest cut into the finished part."""
        paths, job = self.paths, self.job
        return worst_of(
            [
                *deepest(paths, job, bands(job, heights(job))),
                *(cut for fillet in fillets(job) for cut in deepest_in_fillet(paths, job, fillet)),
            ]
        )

    @cached_property
    def in_tab(self) -> Gouge | None:
        """The deepest cut into a tab."""
        tabs = self.job.tabs
        upright = [tab for tab in tabs if not tab.ramped]
        cuts = [
            deepest_cut(self.paths, shapely.union_all([t.shape for t in upright if t.top == top]), top)
            for top in sorted({tab.top for tab in upright})
        ]
        return worst_of([*cuts, *(deepest_in_tab(self.paths, tab) for tab in tabs if tab.ramped)])

    @cached_property
    def remains(self) -> Remains:
        """The stock that stays around the part."""
        return remains(self.sweeps, self.job)

    @cached_property
    def misfit(self) -> str:
        """What is wrong where a path is made for another tool; nothing where it is not."""
        return misfit(self.sweeps, self.job)

    def state(self, step: int) -> State:
        """Machine state in a step."""
        return self.run.states[int(self.run.state[step])]

    @property
    def clear(self) -> float:
        """The height, mm, from which on the tool is at the clearance plane: a text may have rounded it."""
        return self.job.settings.clearance - ROUNDED

    def spot(self, line: int, file: int) -> str:
        """How a line is named, of several files with the file."""
        names = self.run.files
        return f"{names[file]}: line {line}" if len(names) > 1 else f"line {line}"

    def bad(
        self,
        step: int,
        message: str,
        value: float | None = None,
        limit: float | None = None,
        unit: str = "",
        at: tuple[float, float, float] | None = None,
    ) -> Check:
        """A failed check that blames one step, at its end unless another place is given."""
        x, y, z = self.run.end[step].tolist() if at is None else at
        at = x, y, z
        place = " ".join(f"{a}{v:.3f}" for a, v in zip("XYZ", at, strict=True) if np.isfinite(v))
        line, file = int(self.run.line[step]), int(self.run.file[step]) if self.run.files else 0
        text = f"{self.spot(line, file)}: {message}" + (f", at {place}" if place else "")
        return Check(False, text, line, value, limit, unit, at, file=file)


ROUNDED = 0.00254
"""A height may be so much lower in the text than meant, mm: the last of four decimals of an inch."""


def planned_offsets(job: Job) -> dict[int, float]:
    """D number to the radius that it holds as planned, mm; 0 where it holds the wear."""
    wear = job.settings.compensation == "wear"
    # Where a drill happens to have the number, the D is the mill's.
    tools = sorted(job.tools, key=lambda tool: tool.kind is ToolKind.END_MILL)
    return {tool.d_number: 0.0 if wear else tool.radius for tool in tools}


def first(which: NDArray[np.bool_]) -> int | None:
    """The first step of a mask (n,), None if there is none."""
    found = np.flatnonzero(which)
    return int(found[0]) if found.size else None


def in_work(scene: Scene) -> NDArray[np.bool_]:
    """Feed moves below the top of the stock."""
    low = np.fmin(scene.run.start[:, 2], scene.run.end[:, 2])
    return scene.run.cutting & (low < -NEAR)
