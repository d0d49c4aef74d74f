"""Feeds within the power of the spindle, the ends of mills and their chips: what they ask for is measured.

Only the moves that ask for too much are slowed, and by no more than they need: how much of a cutter is in
material, the simulation of the posted program knows better than any plan.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Move, Program
from mechwright_cam.proof.cutting_rules import cutting_data
from mechwright_cam.proof.edge_rules import too_steep
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.timing import operation_steps
from mechwright_cam.shop.power import available, slower

TOLD = "feed lowered to the power of the spindle"
"""Begins the note on what was slowed for want of power."""
THICK = 1.25
"""Chips of mills may be so many times as thick as planned: less than the proof lets pass."""
SPARE = 0.99
"""Feeds are lowered to this share of what would just do: windows begin elsewhere once the feeds differ."""


def slowed(program: Program, scene: Scene) -> Program | None:
    """The program with lower feeds where moves ask for too much; None if none does.

    Where that is for want of power the program says so in a note: a larger machine would be faster.
    """
    weak, steep = _most(scene), np.minimum(_down(scene), _thin(scene))
    if not np.isfinite(np.minimum(weak, steep)).any():
        return None
    parts = iter(operation_steps(scene.run))
    sections, names = [], []
    for section in program.sections:
        operations = []
        for operation in section.operations:
            steps = _next(parts, operation.name)
            moves = _within(operation.moves, _limits(scene, weak, steps, operation.moves))
            if moves != operation.moves:
                names.append(operation.name)
            moves = _within(moves, _limits(scene, steep, steps, moves))
            operations.append(replace(operation, moves=moves))
        sections.append(replace(section, operations=tuple(operations)))
    gentler = replace(program, sections=tuple(sections))
    if gentler == program:
        return None
    if not names:
        return gentler
    notes = [note for note in program.notes if not note.startswith(TOLD)]
    return replace(gentler, notes=(*notes, f"{TOLD}: {', '.join(dict.fromkeys(names))}"))


def _down(scene: Scene) -> Array:
    """Greatest feed (n,) of each step, mm/min, at which mills may go down into material; inf beside that."""
    most = np.full(len(scene.run), np.inf)
    for step, _, found, limit in too_steep(scene):
        most[step] = max(1.0, math.floor(float(scene.run.feed[step]) * limit / found))
    return most


def _thin(scene: Scene) -> Array:
    """Greatest feed (n,) of each step, mm/min, at which chips are hardly thicker than the chip load.

    Finishing is fed for what roughing leaves; in inside corners, and where little was roughed, it takes more.
    """
    loads, most = scene.simulation.loads, np.full(len(scene.run), np.inf)
    for tool, data in cutting_data(scene):
        limit = THICK * data.chip_load
        thick = (loads.tool == tool.number) & ~loads.down & (loads.chip > limit)
        for index in np.flatnonzero(thick).tolist():
            feed = max(1.0, math.floor(float(loads.feed[index]) * limit / float(loads.chip[index])))
            mine = slice(int(loads.first[index]), int(loads.last[index]) + 1)
            most[mine] = np.minimum(most[mine], feed)
    return most


def _most(scene: Scene) -> Array:
    """Greatest feed (n,) of each step, mm/min, with which the spindle turns; inf where it does anyway."""
    loads = scene.simulation.loads
    given = available(scene.job.settings.machine, loads.rpm)
    most = np.full(len(scene.run), np.inf)
    for index in np.flatnonzero(loads.power > given).tolist():
        share = slower(loads.stuff, float(loads.power[index]), float(given[index]))
        feed = max(1.0, math.floor(SPARE * share * float(loads.feed[index])))
        mine = slice(int(loads.first[index]), int(loads.last[index]) + 1)
        most[mine] = np.minimum(most[mine], feed)
    return most


def _next(parts: Iterator[tuple[str, int, int]], name: str) -> tuple[int, int]:
    """The steps of the operation of this name, behind those that were asked for before."""
    return next(
        ((first, last) for found, first, last in parts if found.casefold() == name.casefold()), (0, 0)
    )


def _limits(scene: Scene, most: Array, steps: tuple[int, int], moves: tuple[Move, ...]) -> list[float]:
    """The greatest feed of each move of an operation, mm/min.

    Where the control makes other moves of them, as of cycles and of compensated paths, the least is for all.
    """
    first, last = steps
    cuts = first + np.flatnonzero(scene.run.cutting[first:last])
    fed = [isinstance(move, Feed | FeedArc) for move in moves]
    if cuts.size == sum(fed) and not any(isinstance(move, Drill) for move in moves):
        limits = iter(most[cuts].tolist())
        return [next(limits) if one else math.inf for one in fed]
    return [float(most[cuts].min(initial=math.inf))] * len(moves)


def _within(moves: tuple[Move, ...], limits: Sequence[float]) -> tuple[Move, ...]:
    return tuple(
        replace(move, feed=limit)
        if isinstance(move, Feed | FeedArc | Drill) and move.feed > limit + NEAR
        else move
        for move, limit in zip(moves, limits, strict=True)
    )
