"""Thousands of programs with one fault each: does the proof see it?

``python benchmarks/mutations.py [EACH [SEED [KIND ...]]]``

Takes proven programs of every operation and control, and of random parts, makes EACH faults of every kind
(``tests/cam/mutants.py``), and has each proven. A fault that passes is judged by what the machine does with
the text: whether anything differs at all, and if so, on a height map that is none of the proof's
(``tests/cam/height_map.py``), what is left of the plate and how hard the cutter works. Prints the faults that
pass and change something, and a table.
"""

import multiprocessing
import sys
import time
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import shapely

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
import golden_compensation
import golden_operations
import height_map
import random_parts
from by_control import BY_NAME, prove, read
from mutants import FAULTS, Mutant, differences, mutant, trace

from mechwright.errors import ProgramError
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.proof.paths import Paths
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool

PROCESSES = 2
RANDOM = 2
"""Random parts of each operation."""
PITCH = 0.15
"""Cells of the height map, mm."""
SEEN = 0.02
"""Heights of the plate that differ by more are told, mm."""
HARDER = 1.5
"""A cut that takes so many times more per mm than the program's hardest with that tool is told."""


@dataclass(frozen=True)
class Source:
    name: str
    control: str
    job: Job
    text: str

    @property
    def reader(self) -> Control:
        return BY_NAME[self.control]


@dataclass(frozen=True)
class Verdict:
    source: str
    mutant: Mutant
    check: str
    """First check that fails, ``"reading"`` if the text is refused; empty if it is proven."""
    message: str
    line: int | None
    differs: tuple[str, ...] = ()
    judged: str = ""


@cache
def sources() -> tuple[Source, ...]:
    """Proven programs, each of one file."""
    found = []
    for control in golden_operations.CONTROLS:
        for operation in golden_operations.CASES:
            for one in golden_operations.made(operation, control):
                found.append(Source(f"{one.program.name} {control}", control, one.job, one.text))
    for way in golden_compensation.WAYS:
        for control in golden_compensation.CONTROLS:
            one = golden_compensation.made(way, control)
            found.append(Source(f"compensation {way} {control}", control, one.job, one.text))
    for operation in random_parts.OPERATIONS:
        for seed in range(RANDOM):
            outcome = random_parts.run(operation, seed)
            for place, one in enumerate(outcome.made):
                if one.proof.ok and len(one.text) < 60_000:
                    name = f"random {operation} {seed} {place} {outcome.control}"
                    found.append(Source(name, outcome.control, one.job, one.text))
    return tuple(found)


def _moves(run: Run, tools: Sequence[Tool]) -> list[height_map.Move]:
    """The run as moves of the height map."""
    paths = Paths(run, tools)
    steps = paths.steps
    points, owner = paths.points(paths.below(np.inf, steps=steps), 0.01)
    edges = np.flatnonzero(np.diff(owner)) + 1
    out = []
    for place, (step, flat) in enumerate(zip(steps.tolist(), np.split(points, edges), strict=True)):
        share = np.linspace(0, 1, len(flat))[:, None]
        z = paths.start[step, 2:] + (paths.end[step, 2:] - paths.start[step, 2:]) * share
        kind = "rapid" if run.kind[step] == Kind.RAPID else "feed"
        full, state = np.hstack((flat, z)), run.states[int(run.state[step])]
        out.append(
            height_map.Move(
                int(run.line[step]),
                kind,
                int(run.tool[step]),
                "",
                full,
                float(run.feed[step]),
                state.rpm,
                place,
            )
        )
    return out


def _cut(run: Run, job: Job) -> tuple[height_map.Simulation, np.ndarray]:
    """The height map at the end, and the stamps."""
    depth = job.gone
    under = None
    if depth:

        def under(x: np.ndarray, y: np.ndarray) -> np.ndarray:
            low = np.full(x.shape, -job.thickness)
            for air in sorted(depth, key=lambda a: a.top):
                low[shapely.contains_xy(air.shape, x, y)] = air.top
            return low

    seen = height_map.Simulation(job.stock, job.thickness, PITCH, under)
    seen.run(_moves(run, job.tools), height_map.cutters(job))
    return seen, seen.table().reshape(-1, 10)


@cache
def _original(name: str) -> tuple[Run, height_map.Simulation, np.ndarray]:
    source = next(s for s in sources() if s.name == name)
    run = read(source.text, source.job, source.reader)
    return run, *_cut(run, source.job)


def judge(source: Source, text: str) -> tuple[tuple[str, ...], str]:
    """In what a program differs from the proven one, and what comes of it."""
    run, before, stamps = _original(source.name)
    other = read(text, source.job, source.reader)
    differs = differences(trace(run), trace(other))
    if not differs:
        return (), "the machine does the same"
    told = []
    if differs & {"path", "tool"}:
        after, more = _cut(other, source.job)
        low = -source.job.thickness
        off = np.abs(np.maximum(before.height, low) - np.maximum(after.height, low))[before.solid]
        # A cell at a wall may fall on either side of it.
        if (off > SEEN).sum() > 0:
            told.append(f"{(off > SEEN).sum() * PITCH**2:.2f} mm² differ, by {off.max():.3f} mm at most")
        if len(after.complaints) > len(before.complaints):
            told.append(f"rapids in stock: {after.complaints[0]}")
        for tool in np.unique(more[:, 1]):
            for sideways in (0, 1):
                a, b = (s[(s[:, 1] == tool) & (s[:, 9] == 1 - sideways)] for s in (stamps, more))
                if b.size and sideways:
                    worst = b[np.argmax(b[:, 6])]
                    most = a[:, 6].max() if a.size else 0.0
                    if worst[6] > HARDER * most and worst[6] > 0.2:
                        told.append(f"T{tool:.0f} takes {worst[6]:.2f} mm², before at most {most:.2f}")
                elif b.size:
                    deep = b[:, 8].max()
                    most = a[:, 8].max() if a.size else 0.0
                    if b[:, 8].sum() > 1.2 * a[:, 8].sum() + 0.3:
                        told.append(f"T{tool:.0f} plunges {deep:.2f} mm deep, before {most:.2f}")
    if "feed" in differs or "path" in differs:
        for tool in np.unique(other.tool[other.cutting]):
            a, b = (r.feed[r.cutting & (r.tool == tool)] for r in (run, other))
            if a.size and (b.max() > 1.2 * a.max() or b.min() < 0.8 * a.min()):
                told.append(f"T{tool} feeds {b.min():g} to {b.max():g}, before {a.min():g} to {a.max():g}")
    return tuple(sorted(differs)), "; ".join(told)


def one(case: tuple[int, Mutant]) -> Verdict:
    place, made = case
    source = sources()[place]
    try:
        proof = prove(made.text, source.job, source.reader)
    except ProgramError as error:
        said = str(error)
        line = int(said.split(":")[0].removeprefix("line ")) if said.startswith("line ") else None
        return Verdict(source.name, made, "reading", said, line)
    except Exception as error:
        return Verdict(source.name, made, "CRASH", repr(error), None)
    if proof.ok:
        differs, judged = judge(source, made.text)
        return Verdict(source.name, made, "", "", None, differs, judged)
    first = proof.failures[0]
    return Verdict(source.name, made, first.name, first.message, first.line)


def cases(kinds: tuple[str, ...], each: int, seed: int) -> list[tuple[int, Mutant]]:
    """Faults of every kind, each in a program chosen at random among those that have a place for it."""
    found = []
    for kind in kinds:
        rng = np.random.default_rng(zlib.crc32(f"{kind} {seed}".encode()))
        mine: list[tuple[int, Mutant]] = []
        for place in rng.integers(len(sources()), size=20 * each).tolist():
            if len(mine) == each:
                break
            made = mutant(sources()[place].text, kind, rng)
            if made is not None:
                mine.append((place, made))
        found += mine
    return found


def main(each: int = 20, seed: int = 0, *kinds: str) -> int:
    start, found = time.perf_counter(), []
    every = cases(kinds or tuple(FAULTS), each, seed)
    print(f"{len(every)} faults in {len(sources())} programs", flush=True)
    with multiprocessing.get_context("fork").Pool(PROCESSES) as pool:
        for verdict in pool.imap(one, every, chunksize=4):
            found.append(verdict)
            if (not verdict.check and verdict.differs) or verdict.check == "CRASH":
                made = verdict.mutant
                print(
                    f"{verdict.source} | {made.kind} | line {made.line}: {made.change} | "
                    f"{verdict.check or ','.join(verdict.differs)} | {verdict.judged or verdict.message}",
                    flush=True,
                )
    count = dict.fromkeys(v.mutant.kind for v in found)
    print(f"{'kind':24} {'made':>5} {'refused':>7} {'same':>5} {'left':>5}")
    for kind in count:
        mine = [v for v in found if v.mutant.kind == kind]
        same = [v for v in mine if not v.check and not v.differs]
        left = [v for v in mine if not v.check and v.differs]
        print(
            f"{kind:24} {len(mine):5d} {len(mine) - len(same) - len(left):7d} {len(same):5d} {len(left):5d}"
        )
    left = [v for v in found if not v.check and v.differs]
    print(f"{len(found)} faults, {len(left)} pass and change something; {time.perf_counter() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:3]), *sys.argv[3:]))
