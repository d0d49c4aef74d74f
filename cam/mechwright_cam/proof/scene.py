"""What all rules look at."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind, Run, State
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.stock import Stock
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool


@dataclass(frozen=True)
class Scene:
    """A run, the job it should make, and where its tools go."""

    run: Run
    job: Job
    tools: dict[int, Tool]
    paths: Paths
    stock: Stock
    control: Control

    def where(self, step: int) -> tuple[float, float, float]:
        """End of a step."""
        x, y, z = self.run.end[step].tolist()
        return x, y, z

    def line(self, step: int) -> int:
        """Line of a step, in its file."""
        return int(self.run.line[step])

    def spot(self, step: int) -> str:
        """File and line of a step, in words; there is no file's name where there is one file."""
        names = self.run.files
        name = f"{names[int(self.run.file[step])]}: " if len(names) > 1 else ""
        return f"{name}line {self.line(step)}"

    def state(self, step: int) -> State:
        """Machine state in a step."""
        return self.run.states[int(self.run.state[step])]

    def of_states(self, value: Callable[[State], Any]) -> NDArray[Any]:
        """(n,) a value of the state each step runs in."""
        return np.array([value(state) for state in self.run.states])[self.run.state]

    def bad(
        self,
        name: str,
        step: int,
        message: str,
        value: float | None = None,
        limit: float | None = None,
        unit: str = "",
    ) -> Check:
        """A failed check that blames one step."""
        at = self.where(step)
        place = " ".join(f"{a}{v:.3f}" for a, v in zip("XYZ", at, strict=True) if np.isfinite(v))
        text = f"{self.spot(step)}: {message}" + (f", at {place}" if place else "")
        return Check(name, False, text, self.line(step), value, limit, unit, at)


Rule = Callable[[Scene], Check]


def first(which: NDArray[np.bool_]) -> int | None:
    """The first step of a mask (n,), None if there is none."""
    found = np.flatnonzero(which)
    return int(found[0]) if found.size else None


def moving(run: Run) -> NDArray[np.bool_]:
    """(n,) whether the step moves the tool in work coordinates."""
    return np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC))


def in_work(scene: Scene) -> NDArray[np.bool_]:
    """Feed moves below the top of the stock."""
    low = np.fmin(scene.run.start[:, 2], scene.run.end[:, 2])
    return scene.run.cutting & (low < -NEAR)
