"""An overcut as it is: all its lines, and how far it reaches beyond the walls.

The depth of a cut into the part is the way out of it, the shortest. In a recess of 3 mm that is 3 mm, however
much too wide the recess is cut; so the width is told beside it.
"""

from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import replace
from itertools import groupby

import numpy as np

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.details import heights
from mechwright_cam.proof.gouge import Gouge, deepest_cut, worst_of
from mechwright_cam.proof.off_path import too_deep
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene

LISTED = 6
"""So many lines, or runs of them, are listed; the others are counted."""
WIDER = 0.0005
"""A width is told if it is more than the depth by so much, mm: half of the last decimal that is written."""


def with_extent(check: Check, scene: Scene, cut: Gouge) -> Check:
    """A failed check of the deepest cut, its width beyond the walls, and the other lines that make it."""
    steps = overcutting(scene, cut)
    said, wide = [], widest(scene, steps)
    if wide > cut.depth + WIDER:
        said.append(f"seen from above it reaches {wide:.3f} mm beyond the nearest wall")
    others = other_lines(scene, steps, cut.step)
    if others:
        said.append(f"{others} {'cuts' if others.startswith('line ') else 'cut'} into it too")
    return replace(check, message="; ".join([check.message, *said]))


def overcutting(scene: Scene, cut: Gouge) -> Ints:
    """The steps that cut deeper than the limit; of round and pointed tools the deepest alone."""
    found = too_deep(scene.paths, scene.job, np.zeros(len(scene.run)), TOLERANCES.gouge)
    found[cut.step] = True
    return np.flatnonzero(found)


def widest(scene: Scene, steps: Ints) -> float:
    """How far some steps cut beyond the walls of the part, seen from above, mm."""
    paths, job = copy(scene.paths), scene.job
    paths.steps = steps
    cuts = (
        # As cuts that go through, whose depth is their width.
        deepest_cut(paths, band.keep, band.top - TOLERANCES.gouge, underside=np.inf)
        for band in bands(job, heights(job))
    )
    worst = worst_of(cuts)
    return 0.0 if worst is None else worst.depth


def other_lines(scene: Scene, steps: Ints, told: int) -> str:
    """The lines of steps but that of one: ``lines 17 to 31 and 40``; empty if there is no other."""
    run = scene.run
    files = run.file[steps] if run.files else np.zeros(steps.size, dtype=np.int64)
    own = int(run.line[told]), int(run.file[told]) if run.files else 0
    moves = np.unique(np.column_stack((run.file if run.files else np.zeros_like(run.line), run.line)), axis=0)
    place = {(file, line): at for at, (file, line) in enumerate(moves.tolist())}
    found = sorted({*zip(files.tolist(), run.line[steps].tolist(), strict=True)} - {(own[1], own[0])})
    words = []
    for file, pairs in groupby(found, key=lambda pair: pair[0]):
        lines = [(line, place[file, line]) for _, line in pairs]
        name = f"{run.files[file]}: " if len(run.files) > 1 else ""
        words.append(name + _spelt(list(_runs(lines)), len(lines)))
    return ", ".join(words)


def _runs(lines: Iterable[tuple[int, int]]) -> Iterable[tuple[int, int]]:
    """First and last line of those that no other line with a move stands between."""
    for _, run in groupby(enumerate(lines), key=lambda one: one[1][1] - one[0]):
        some = [line for _, (line, _) in run]
        yield some[0], some[-1]


def _spelt(runs: Sequence[tuple[int, int]], count: int) -> str:
    names = []
    for first, last in runs:
        names += [f"{first} to {last}"] if last > first + 1 else [f"{line}" for line in sorted({first, last})]
    if len(names) > LISTED:
        return f"lines {', '.join(names[:LISTED])} and more, {count} in all,"
    listed = " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))
    return f"line{'s' if count > 1 else ''} {listed}"
