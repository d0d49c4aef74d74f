"""Walls that another process cuts better: where mills take ten times its minutes, or are too slender.

The figures are handbook's, unchecked: a service that has the machine knows better. Times are those of cutting
along the walls, without setting up, which takes longer for wire erosion and the waterjet than for a mill.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import shapely

from mechwright.contracts.finding import Finding, Severity
from mechwright.contracts.materials import material
from mechwright.contracts.part import Profile
from mechwright_cam.operations.bending import SLENDER
from mechwright_cam.operations.contract import Task
from mechwright_cam.planning.fewer_mills import Wall, wall_time
from mechwright_cam.setup.depths import through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import ToolKind

TIMES = 10.0
"""From so many times the minutes of another process on it is named."""
LEAST = 10.0
"""Walls that mills cut in fewer minutes are not worth another machine."""
GROUPS = ("aluminium", "brass", "steel")
"""What conducts, and so what a wire cuts."""


@dataclass(frozen=True)
class Process:
    """A way to cut a wall through a plate, by the area that it opens in a minute, mm², in a group."""

    name: str
    exact: str
    """What it holds, mm."""
    rate: dict[str, float]


WIRE = Process("wire erosion", "0.02 to 0.03", {"aluminium": 200.0, "brass": 120.0, "steel": 100.0})
"""One cut with a wire of 0.25 mm; a second and a third one bring it to 0.005 mm in twice the time."""
JET = Process(
    "a waterjet",
    "0.13 to 0.25",
    {"aluminium": 5000.0, "brass": 3000.0, "steel": 2000.0, "pom": 8000.0, "polycarbonate": 8000.0},
)
"""With abrasive, at the quality that services call medium; a plate of 10 mm in steel goes at 200 mm/min."""


def better_process(job: Job, tasks: Sequence[Task]) -> Iterator[Finding]:
    """A note on the part whose walls a mill cuts badly: with the minutes of both by estimate."""
    walls = [wall for task in tasks if (wall := _wall(job, task)) is not None]
    minutes = sum(wall_time(job, wall, wall.asked) for wall in walls) / 60
    if minutes < LEAST:
        return
    group = material(job.part.material).group
    area = sum(float(wall.shape.length) for wall in walls) * job.thickness
    finest = min((wall.asked[-1] for wall in walls), key=lambda mill: mill.diameter)
    slender = -job.floor / finest.diameter
    named = []
    for process in (WIRE, JET):
        if group not in process.rate:
            continue
        own = area / process.rate[group]
        if minutes > TIMES * own or (process is WIRE and slender > SLENDER):
            named.append(f"{process.name} in {own:.0f} min to ±{process.exact} mm")
    if named:
        message = (
            f"mills take at least {minutes:.0f} min for the walls of {job.part.name}, the finest "
            f"{finest.name}, {slender:.1f} diameters deep; other processes cut them: {', '.join(named)}"
        )
        yield Finding("cam.better-process", Severity.NOTE, "cam.tools", message, minutes, LEAST, "min")


def _wall(job: Job, task: Task) -> Wall | None:
    """The wall of a task that goes through the plate, if mills make it."""
    feature = task.feature
    mills = tuple(tool for tool in task.tools if tool.kind is ToolKind.END_MILL)
    if not mills or not isinstance(feature, Profile):
        return None
    if not through(job, feature.top + feature.depth):
        return None
    order = tuple(sorted(mills, key=lambda mill: -mill.diameter))
    return Wall(feature, shapely.Polygon(feature.loop.flatten()), -job.floor, order)
