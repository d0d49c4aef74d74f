"""Feeds within the power of the spindle: what a planned program asks for is measured, and lowered.

Only the moves that ask for too much are slowed, and by no more than they need: how much of a cutter is in
material, the simulation of the posted program knows better than any plan.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Move, Program
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.timing import stretches
from mechwright_cam.shop.power import available, slower

SPARE = 0.99
"""Feeds are lowered to this share of what would just do: windows begin elsewhere once the feeds differ."""


def slowed(program: Program, scene: Scene) -> Program | None:
    """The program with lower feeds where the spindle has not the power for them; None if it has for all."""
    most = _most(scene)
    if not np.isfinite(most).any():
        return None
    parts = iter(stretches(scene.run))
    sections, names = [], []
    for section in program.sections:
        operations = []
        for operation in section.operations:
            limits = _limits(scene, most, _next(parts, operation.name), operation.moves)
            moves = tuple(_fed(move, limit) for move, limit in zip(operation.moves, limits, strict=True))
            if moves != operation.moves:
                names.append(operation.name)
            operations.append(replace(operation, moves=moves))
        sections.append(replace(section, operations=tuple(operations)))
    if not names:
        return None
    told = f"feed lowered to the power of the spindle: {', '.join(dict.fromkeys(names))}"
    notes = [note for note in program.notes if not note.startswith(told.partition(":")[0])]
    return replace(program, sections=tuple(sections), notes=(*notes, told))


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


def _fed(move: Move, limit: float) -> Move:
    if isinstance(move, Feed | FeedArc | Drill) and move.feed > limit + NEAR:
        return replace(move, feed=limit)
    return move
