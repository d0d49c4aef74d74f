"""What the next piece takes: by how much its walls stand off, from all that was measured of one process.

A size of w walls that has x mm more than the middle of its limits has x / w mm of stock on each: a bore that
is small, and a plate that is large, say the same of a worn cutter. Inside and outside walls are told apart
where they say different things.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mechwright.pipeline.build import Build
from mechwright.pipeline.measured.readings import Reading
from mechwright.pipeline.process import Process, process_of

SIGMAS = 3.0
"""Inside and outside walls differ if by more than so many standard errors."""
APART = 0.005
"""Nor do they below this, mm: no control corrects the one without the other for less."""
LEAST = 1e-4
"""An offset below this is none, mm."""
STEP = 0.005
"""Standard error of one reading by itself, mm: half a step of a calliper."""


@dataclass(frozen=True)
class Correction:
    """What walls of a process stand off by.

    Parameters
    ----------
    process
        Its name.
    walls
        ``"all"``, ``"inside"`` or ``"outside"``.
    off
        Stock that is left on each wall, mm; below 0 they are cut too deep.
    error
        Its standard error, mm.
    count
        Readings that say so.
    words
        What to set, as the process has it.
    """

    process: str
    walls: str
    off: float
    error: float
    count: int
    words: str


def corrections(build: Build, readings: Sequence[Reading]) -> list[Correction]:
    """What the next piece takes, for each process of the plates that were measured.

    Where a process differs by material, so for each material and thickness.
    """
    known = {one.name: one for one in build.host.all(Process)}
    alike: dict[tuple[object, ...], list[Reading]] = {}
    for one in readings:
        if one.part.outline is not None and one.dimension.walls:
            name = process_of(build.design, one.part.name)
            differs = name in known and known[name].by_material
            key = (name, one.part.material, one.part.thickness) if differs else (name,)
            alike.setdefault(key, []).append(one)
    found = []
    for those in alike.values():
        part = those[0].part
        name = process_of(build.design, part.name)
        for walls, some in _groups(those):
            off, error = mean_offset(some)
            process = known.get(name)
            words = "" if process is None or abs(off) < LEAST else process.correction(off, walls, part, build)
            found.append(Correction(name, walls, off, error, len(some), words))
    return found


def mean_offset(readings: Iterable[Reading]) -> tuple[float, float]:
    """Stock on a wall, mm, and its standard error, from sizes by their walls: least squares.

    >>> from mechwright.contracts.inspected import inspected
    >>> from mechwright.contracts.part import Part
    >>> from mechwright.geometry import Loop, Outline
    >>> part = Part("p", Outline(Loop.polygon([(0, 0), (20, 0), (20, 10), (0, 10)])), 3.0, "pom")
    >>> sizes = [Reading(part, "1", one, one.nominal + 0.04) for one in inspected(part)]
    >>> mean_offset(sizes)[0]
    0.02
    """
    pairs = [(one.dimension.walls, one.off) for one in readings]
    weight = sum(walls**2 for walls, _ in pairs)
    off = sum(walls * more for walls, more in pairs) / weight
    if len(pairs) == 1:
        return round(off, 6), STEP / abs(pairs[0][0])
    variance = sum((more - walls * off) ** 2 for walls, more in pairs) / (len(pairs) - 1)
    return round(off, 6), math.sqrt(max(variance, (STEP / 10) ** 2) / weight)


def _groups(readings: Sequence[Reading]) -> list[tuple[str, list[Reading]]]:
    inside = [one for one in readings if one.dimension.walls < 0]
    outside = [one for one in readings if one.dimension.walls > 0]
    if inside and outside:
        (a, da), (b, db) = mean_offset(inside), mean_offset(outside)
        if abs(a - b) <= max(SIGMAS * math.hypot(da, db), APART):
            return [("all", list(readings))]
    return [(name, some) for name, some in (("inside", inside), ("outside", outside)) if some]
