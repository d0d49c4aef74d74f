"""Threads that a tap cuts, in holes that a drill of their core makes where there is one."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import shapely

from mechwright.contracts.details import CORE_PLAY, Detail, Thread
from mechwright.contracts.finding import Finding, Severity
from mechwright.contracts.part import Bore, Feature
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.bore import EXACT
from mechwright_cam.operations.contract import Hole, Operation, Task
from mechwright_cam.operations.drilling import point_length
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.program.moves import Rapid, Tap
from mechwright_cam.setup.depths import bottom_of, core_of, makes, tapped_deep, thread_in, through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind
from mechwright_plane.path import printed, rounded

RUN_UP = 5.0
"""A tap starts so many pitches above the plate, and no less than so many mm: until then spindle and feed run
together."""
RUN_OUT = 1.0
"""So many pitches a blind hole is deeper than its tap goes: before it turns back, the spindle runs on."""
TURNING_BACK = 0.3
"""A tap in a floating holder waits so long at the bottom, s: the spindle has to have come to a stop."""


class TapOperation(Operation):
    """Taps threads for which the job has a tap, and drills their holes where it has a drill for that."""

    name = "tap"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """A thread that a tap can cut, or the hole of one that a drill makes; all others are milled."""
        if isinstance(feature, Bore):
            drill = core_drill(job, feature)
            if drill is None:
                return None
            deep = None if through(job, feature.depth) else feature.depth - point_length(drill)
            region = shapely.Point(feature.centre).buffer(feature.diameter / 2, quad_segs=EXACT)
            hole = Hole(drill, feature.centre, deep)
            return Task(feature, self, (), 0.0, bottom_of(job, 0.0, feature.depth), region, hole)
        if not isinstance(feature, Thread):
            return None
        tap = tap_of(job, feature)
        return None if tap is None else Task(feature, self, (tap,), 0.0, -tapped_deep(tap, feature))

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """The tap; of a hole no mill, where a drill makes it."""
        if isinstance(feature, Bore):
            return None if core_drill(every, feature) is None else []
        tap = tap_of(every, feature) if isinstance(feature, Thread) else None
        return None if tap is None else [tap]

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """In and out, a pitch in every turn."""
        for tap in task.tools:
            assert isinstance(task.feature, Thread)  # noqa: S101 - holes have no other tool than their drill
            steps.add(
                f"{task.feature.name}: tap", tap, partial(_tap, thread=task.feature, bottom=task.bottom)
            )
        return stock

    def remarks(self, task: Task, job: Job) -> list[Finding]:
        """Which tap cuts a thread."""
        return [
            _note(f"{task.feature.name}, {_called(task.feature)}, is cut by the tap {tap.name}")
            for tap in task.tools
            if isinstance(task.feature, Thread)
        ]


def _tap(pen: Pen, thread: Thread, bottom: float) -> None:
    tap, (x, y) = pen.tool, printed(thread.centre)
    retract = max(RUN_UP, RUN_UP * thread.pitch)
    dwell = TURNING_BACK if tap.floating else 0.0
    pen.moves += [
        Rapid(x=x, y=y),
        Rapid(z=max(retract, pen.clearance)),
        Tap(x, y, rounded(bottom), retract, pen.rates.feed, dwell),
        Rapid(z=pen.clearance),
    ]


def tap_of(job: Job, thread: Thread) -> Tool | None:
    """The tap of a job that cuts a thread, the one with the shortest chamfer where there are several."""
    hole = core_of(job, thread)
    if hole is None:
        return None
    taps = [
        tap
        for tap in job.tools_of(ToolKind.TAP)
        if makes(tap, thread) and not _misses(job, tap, thread, hole)
    ]
    return min(taps, key=lambda tap: tap.chamfer_length, default=None)


def _misses(job: Job, tap: Tool, thread: Thread, hole: Bore) -> str:
    """Why a tap of a thread cannot cut it in a hole; nothing where it can."""
    deep = tapped_deep(tap, thread)
    if tap.flute_length < deep:
        return f"its flutes are {tap.flute_length:g} mm long, and it goes {deep:g} mm deep with its chamfer"
    least = deep + RUN_OUT * thread.pitch
    if not through(job, hole.depth) and hole.depth < least - TOLERANCES.noise:
        return f"its hole is {hole.depth:g} mm deep, and has to be {least:g} mm with the chamfer of the tap"
    return ""


def core_drill(job: Job, hole: Bore) -> Tool | None:
    """The drill for a hole that gets a thread: nearest to D - P of those within the tolerance of the core.

    Its full diameter reaches as deep as the tap of the job, or without one as deep as the thread.
    """
    thread = thread_in(job, hole)
    if thread is None or hole.fit is not None:
        return None
    tap, play, fit = tap_of(job, thread), CORE_PLAY * thread.pitch, []
    wanted = thread.depth if tap is None else tapped_deep(tap, thread)
    for drill in job.tools_of(ToolKind.DRILL):
        tip = point_length(drill)
        ends = -bottom_of(job, 0.0, hole.depth) if through(job, hole.depth) else hole.depth - tip
        deep = through(job, hole.depth) or ends >= wanted
        if deep and drill.flute_length >= ends + tip and -ON_CORE <= drill.diameter - hole.diameter <= play:
            fit.append(drill)
    return min(fit, key=lambda drill: abs(drill.diameter - (thread.diameter - thread.pitch)), default=None)


ON_CORE = 0.005
"""By so much a drill may be narrower than the core of a thread, mm: lists are rounded."""


def lacks(job: Job, thread: Thread) -> str:
    """Why no tap of a job cuts a thread, in words that follow on "milled: "."""
    hole = core_of(job, thread)
    taps = [tap for tap in job.tools_of(ToolKind.TAP) if makes(tap, thread)]
    if not taps or hole is None:
        return f"there is no tap {thread.designation} that the control can use"
    return "; ".join(f"{tap.name}: {_misses(job, tap, thread, hole)}" for tap in taps)


def declined(job: Job, tasks: Sequence[Task], useless: Mapping[str, str]) -> Iterator[Finding]:
    """Threads that are milled though the crib, the tools of ``job``, has a tap of their size, and why.

    ``useless`` are the names of taps that the control cannot use, with the reason.
    """
    for task in tasks:
        thread = task.feature
        if not isinstance(thread, Thread) or isinstance(task.operation, TapOperation):
            continue
        taps = [tap for tap in job.tools_of(ToolKind.TAP) if makes(tap, thread)]
        said = [f"{tap.name}: {useless[tap.name]}" for tap in taps if tap.name in useless]
        able = [tap for tap in taps if tap.name not in useless]
        if able and tap_of(replace(job, tools=tuple(able)), thread) is None:
            said.append(lacks(replace(job, tools=tuple(able)), thread))
        if said:
            yield _note(f"{thread.name}, {thread.designation}, is milled: {'; '.join(said)}")


def _called(feature: Feature | Detail) -> str:
    return feature.designation if isinstance(feature, Thread) else ""


def _note(message: str) -> Finding:
    return Finding("cam.tapping", Severity.NOTE, "cam.tools", message)
