"""From program text to proof."""

import math
import re
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Profile
from mechwright.errors import ProgramError
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.program.moves import OPERATION_COMMENT
from mechwright_cam.proof import details
from mechwright_cam.proof.bands import bands, floor_of, stock_shape
from mechwright_cam.proof.compensation import follows, planned_offsets
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.gouge import Gouge, deepest_cut
from mechwright_cam.proof.holding import holding
from mechwright_cam.proof.leftover import SPOTS, Remains, remains
from mechwright_cam.proof.paths import NEAR, Paths, Pieces
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.proof.ramped import deepest_in_tab
from mechwright_cam.proof.report import Check, OperationTime, Proof, Spot
from mechwright_cam.proof.rules import RULES
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stock import Stock
from mechwright_cam.proof.sweep import ROUNDING, Sweeps
from mechwright_cam.proof.timing import step_times
from mechwright_cam.setup.job import Job

SWITCHED = re.compile(r"^\s*/", re.MULTILINE)
"""A line that a switch at the machine skips."""
FEW = 64
"""So many of the deepest moves are asked first whether they cut a feature."""
BESIDE = 0.5
"""The cut around an outside is looked for so near to it, mm: half of the least frame between two channels."""
ROUGHLY = 0.01
"""Accuracy of that, mm."""


def prove(text: str | Mapping[str, str], job: Job, control: Control) -> Proof:
    """Simulate a program against the part it should make.

    Parameters
    ----------
    text
        The program as the control would get it, from this project's posts or from anywhere; several files,
        name to text, if they are run one after the other.
    job
        The part, its stock, its holding and the tools on the machine.
    control
        The control that reads it.

    Returns
    -------
    proof
        All checks; :meth:`Proof.require` raises if one failed.

    Raises
    ------
    ProgramError
        The text cannot be read; the message names the line.
    """
    proof = _prove(text, job, control)
    if not proof.ok or not any(map(SWITCHED.search, [text] if isinstance(text, str) else text.values())):
        return proof
    words = "with lines that start with / skipped, "
    try:
        other = _prove(text, job, control, block_delete=True)
    except ProgramError as error:
        raise ProgramError(words + str(error)) from error
    if other.ok:
        return proof
    return replace(
        other,
        checks={
            name: check if check.passed else replace(check, message=words + check.message)
            for name, check in other.checks.items()
        },
    )


def _prove(text: str | Mapping[str, str], job: Job, control: Control, *, block_delete: bool = False) -> Proof:
    """Simulate a program with the switch for optional lines off, or on."""
    run = read(text, job, control, block_delete=block_delete)
    tools = {tool.number: tool for tool in job.tools}
    paths = Paths(run, tools)
    scene = Scene(run, job, tools, paths, Stock(paths, job), control)
    with ThreadPoolExecutor() as pool:  # none of the three depends on another
        cuts, stays = pool.submit(_cuts, scene), pool.submit(_stays, scene)
        checks = [rule(scene) for rule in RULES]
    gouge, in_tab = cuts.result()
    left, held, loose = stays.result()
    checks += [
        _gouge_check(scene, gouge),
        _tab_check(scene, in_tab),
        _depth_check(scene),
        _leftover_check(left),
        held,
        details.cut(scene.paths, job),
        follows(scene, lambda more: read(text, job, control, more, block_delete=block_delete)),
    ]
    seconds = step_times(run, job.settings.machine)
    by_name = {check.name: check for check in checks}
    return Proof(
        part=job.part.name,
        checks=by_name,
        gouge_max_mm=max((cut.depth for cut in (gouge, in_tab) if cut), default=0.0),
        leftover_reachable_max_mm=left.reachable,
        unreachable_area_mm2=sum(spot[4] for spot in left.beyond),
        unreachable_max_mm=max((spot[3] for spot in left.beyond), default=0.0),
        unreachable=tuple(Spot(*spot) for spot in left.beyond[:SPOTS]),
        rapids_in_stock=int(by_name["rapids-in-stock"].value or 0),
        time_estimate_s=float(seconds.sum()),
        cutting_length_mm=float(np.nansum(run.length[run.cutting])),
        operations=_operations(run, seconds),
        notes=(*_notes(left), *loose),
    )


def _cuts(scene: Scene) -> tuple[Gouge | None, Gouge | None]:
    """The deepest cut into the part, and into a tab."""
    paths, job = scene.paths, scene.job
    gouge = _deepest(
        [
            *details.deepest(paths, job, bands(job, details.heights(job))),
            *(cut for fillet in fillets(job) for cut in details.deepest_in_fillet(paths, job, fillet)),
        ]
    )
    upright = [tab for tab in job.tabs if not tab.ramped]
    in_tab = [
        deepest_cut(paths, shapely.union_all([t.shape for t in upright if t.top == top]), top)
        for top in sorted({tab.top for tab in upright})
    ]
    in_tab += [deepest_in_tab(paths, tab) for tab in job.tabs if tab.ramped]
    return gouge, _deepest(in_tab)


def _stays(scene: Scene) -> tuple[Remains, Check, list[str]]:
    """What is left, and what holds the part."""
    sweeps = Sweeps(scene.paths)
    left = remains(sweeps, scene.job)
    held, loose = holding(sweeps, scene.job)
    return left, held, loose


def read(
    text: str | Mapping[str, str],
    job: Job,
    control: Control,
    more: float = 0.0,
    *,
    block_delete: bool = False,
) -> Run:
    """Run a program on the machine of a job; raises ProgramError that names file and line.

    Every D is ``more`` mm larger than planned, as a radius. With ``block_delete`` lines that start with ``/``
    are skipped.
    """
    diameters = {number: 2 * (d + more) for number, d in planned_offsets(job).items()}
    upper_end = job.settings.machine.retract_z
    return control.read(text, block_delete=block_delete, upper_end=upper_end, diameters=diameters)


def _deepest(cuts: Iterable[Gouge | None]) -> Gouge | None:
    found = [cut for cut in cuts if cut is not None]
    return max(found, key=lambda cut: cut.depth, default=None)


def _gouge_check(scene: Scene, cut: Gouge | None) -> Check:
    limit = TOLERANCES.gouge
    if cut is None or cut.depth <= limit:
        depth = cut.depth if cut else 0.0
        return Check(
            "gouge", True, "the cutter stays out of the finished part", value=depth, limit=limit, unit="mm"
        )
    return _blame(scene, "gouge", cut, limit, "cuts {:.3f} mm into the finished part, the limit is {:g} mm")


def _tab_check(scene: Scene, cut: Gouge | None) -> Check:
    limit = TOLERANCES.gouge
    if not scene.job.tabs:
        return Check("tabs", True, "there are no tabs")
    if cut is None or cut.depth <= limit:
        return Check("tabs", True, f"all {len(scene.job.tabs)} tabs remain")
    return _blame(
        scene, "tabs", cut, limit, "cuts {:.3f} mm into a tab that holds the part, the limit is {:g} mm"
    )


def _blame(scene: Scene, name: str, cut: Gouge, limit: float, message: str) -> Check:
    x, y, z = cut.at
    line = scene.line(cut.step)
    text = f"{scene.spot(cut.step)}: {message.format(cut.depth, limit)}, at X{x:.3f} Y{y:.3f} Z{z:.3f}"
    return Check(name, False, text, line, cut.depth, limit, "mm", cut.at)


def _depth_check(scene: Scene) -> Check:
    """Every feature is cut down to its floor, somewhere at least; the rest is for the leftover check."""
    paths, job = scene.paths, scene.job
    cutting = paths.steps[np.isin(scene.run.kind[paths.steps], (Kind.FEED, Kind.ARC))]
    for feature in job.features:
        floor = -min(feature.top + feature.depth, job.thickness)
        shape = floor_of(feature, job)
        if isinstance(feature, Profile) and feature.side == "outside":
            # At its own wall: further away, in a nest, are the cuts around its neighbours.
            around = shapely.intersection(grow(shape, BESIDE, ROUGHLY), stock_shape(job))
            shape = shapely.difference(around, shape)
        if shape.is_empty or shape.area <= NEAR:
            continue
        shape = prepared(shape)
        low = _lowest(paths, paths.below(floor + ROUNDING, steps=cutting), shape)
        if low > floor + ROUNDING:
            low = _lowest(paths, paths.below(-NEAR, steps=cutting), shape)
        if low > floor + ROUNDING:
            return Check(
                "depth",
                False,
                f"{feature.name} is cut down to Z{low:.3f}, its floor is at Z{floor:.3f}",
                None,
                low,
                floor,
                "mm",
            )
    return Check("depth", True, "every feature is cut to its full depth")


def _lowest(paths: Paths, pieces: Pieces, shape: Shape) -> float:
    """Lowest z at which any piece cuts into a shape; 0 if none does."""
    order, some, begin = np.argsort(pieces.low, kind="stable"), FEW, 0
    while begin < order.size:  # the lowest first: one of them nearly always does
        few = pieces.only(order[begin : begin + some])
        # The disc has to enter the feature, not to touch it: a bore beside an edge is not its neighbour's.
        radius = np.maximum(paths.radius[few.step] - NEAR, NEAR)
        near = np.flatnonzero(shapely.dwithin(shape, paths.lines(few), radius))
        if near.size:
            return min(float(few.low[near[0]]), 0.0)
        begin, some = begin + some, 4 * some
    return 0.0


def _leftover_check(left: Remains) -> Check:
    limit = TOLERANCES.leftover
    if left.reachable <= limit or left.at is None:
        return Check(
            "leftover",
            True,
            "no stock is left that the cutters could reach",
            value=left.reachable,
            limit=limit,
            unit="mm",
        )
    x, y, z = left.at
    found = (
        f"{left.reachable:.3f} mm of stock stay" if math.isfinite(left.reachable) else "the stock stays whole"
    )
    where = "where a cutter of the program could go"
    if left.bore is not None:
        where = f"on the wall of {left.bore.name}, which is to be cut to {left.bore.diameter:g} mm"
    return Check(
        "leftover",
        False,
        f"{found} {where}, the limit is {limit:g} mm, at X{x:.3f} Y{y:.3f} Z{z:.3f}",
        None,
        left.reachable,
        limit,
        "mm",
        left.at,
    )


def _operations(run: Run, seconds: Array) -> tuple[OperationTime, ...]:
    """Times by operation: from one operation comment to the next; by tool where there are none."""
    named = [
        (remark.step, _as_planned(remark.text[len(OPERATION_COMMENT) :]))
        for remark in run.remarks
        if remark.text.lower().startswith(OPERATION_COMMENT)
    ]
    if not named:
        named = [(int(step), f"T{run.tool[step]}") for step in np.flatnonzero(run.kind == Kind.TOOL)]
    if not named or named[0][0] > 0:
        named.insert(0, (0, "start"))
    edges = [step for step, _ in named] + [len(run)]
    path = np.where(run.cutting, np.nan_to_num(run.length), 0.0)
    out = []
    for (first, name), last in zip(named, edges[1:], strict=True):
        if last > first:
            # After the last cut the next file may already have named its tool.
            cuts = np.flatnonzero(run.cutting[first:last])
            tool = int(run.tool[first + cuts[-1] if cuts.size else last - 1])
            out.append(
                OperationTime(
                    name,
                    tool,
                    float(seconds[first:last].sum()),
                    float(path[first:last].sum()),
                    float(seconds[first:last][run.cutting[first:last]].sum()),
                )
            )
    return tuple(out)


def _as_planned(name: str) -> str:
    """The name of an operation; a control that shows capitals only has changed it."""
    return name.lower() if name.isupper() else name


def _notes(left: Remains) -> tuple[str, ...]:
    if not left.beyond:
        return ()
    deepest = left.beyond[0]
    return (
        f"stock that no cutter of the program reaches: in {len(left.beyond)} place(s), "
        f"up to {deepest[3]:.3f} mm, {sum(spot[4] for spot in left.beyond):.3f} mm² in all",
    )
