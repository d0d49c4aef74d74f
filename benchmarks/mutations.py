"""Thousands of programs with one fault each: does the proof see it?

``python benchmarks/mutations.py [EACH [SEED [KIND ...]]]``
``python benchmarks/mutations.py blocks [SHARE [SEED]]``
``python benchmarks/mutations.py no-homing [COUNT [SEED]]``

Takes proven programs of every operation and control, and of random parts, makes EACH faults of every kind
(``tests/cam/mutants.py``), and has each proven. A fault that passes is judged by what the machine does with
the text: whether anything differs at all, and if so, on a height map that is none of the proof's
(``tests/cam/height_map.py``), what is left of the plate and how hard the cutter works. Prints the faults that
pass and change something, with the reason why they may, and a table. With ``blocks`` the faults are those of
``tests/cam/block_mutants.py``: for every kind of block of every control all of them, in programs drawn among
those that have such a block; with a SHARE of more than 1 in so many programs each, below 1 so much of them.
With ``no-homing`` COUNT faults, 300 by default, are those of every kind and of
``tests/cam/programs_without_homing.py``, in programs of a Grbl machine without switches.
A fault that passes for no reason (``UNEXPLAINED``) makes the command fail.
"""

import multiprocessing
import sys
import time
import zlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import shapely

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
import golden_cases
import golden_compensation
import golden_operations
import height_map
import programs_without_homing
import random_outcomes
import random_parts
from block_mutants import PLACES, faults, inserted, kinds, wrong
from by_control import BY_NAME, EVERY, prove, read
from line_faults import STATES
from mutant_traces import differences, trace
from mutants import FAULTS, Mutant, mutant
from programs_without_homing import MORE_PARTS, PARTS

from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.errors import ProgramError
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind

PROCESSES = 2
RANDOM = 2
"""Random parts of each operation."""
PITCH = 0.15
"""Cells of the height map, mm."""
WALL = 0.2
"""So near to a wall, mm, its height is not certain."""
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
    reason: str = ""
    judged: str = ""


@cache
def golden() -> tuple[Source, ...]:
    """The kept programs, each of one file."""
    found = []
    for control in EVERY:
        for operation, case in golden_cases.CASES.items():
            if control not in case.controls:
                continue
            for one in golden_operations.made(operation, control):
                found.append(Source(f"{one.program.name} {control}", control, one.job, one.text))
    for way in golden_compensation.WAYS:
        for control in golden_compensation.CONTROLS:
            one = golden_compensation.made(way, control)
            found.append(Source(f"compensation {way} {control}", control, one.job, one.text))
    return tuple(found)


@cache
def sources() -> tuple[Source, ...]:
    """The kept programs, and proven ones of random parts."""
    found = list(golden())
    for operation in random_parts.OPERATIONS:
        for seed in range(RANDOM):
            outcome = random_outcomes.run(operation, seed)
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


_ORIGINALS: dict[str, tuple[Run, height_map.Simulation, np.ndarray]] = {}


def _original(source: Source) -> tuple[Run, height_map.Simulation, np.ndarray]:
    if source.name not in _ORIGINALS:
        run = read(source.text, source.job, source.reader)
        _ORIGINALS[source.name] = run, *_cut(run, source.job)
    return _ORIGINALS[source.name]


UNEXPLAINED = "no reason"


def judge(source: Source, text: str) -> tuple[tuple[str, ...], str, str]:
    """In what a program differs from the proven one, why it may, and what comes of it."""
    run, before, stamps = _original(source)
    other = read(text, source.job, source.reader)
    differs = tuple(sorted(differences(trace(run), trace(other))))
    if not differs:
        return (), "the machine does the same", ""
    if not set(differs) & {"path", "tool"}:
        return differs, *_feeds(run, other, "the same path; what runs while it cuts, rules ask")
    after, more = _cut(other, source.job)
    if len(after.complaints) > len(before.complaints):
        return differs, UNEXPLAINED, f"rapids in stock: {after.complaints[0]}"
    low = -source.job.thickness
    off = np.where(before.solid, np.abs(np.maximum(before.height, low) - np.maximum(after.height, low)), 0.0)
    if off.max() > SEEN:
        y, x = np.nonzero(off > SEEN)
        told = f"{x.size * PITCH**2:.2f} mm² differ, by {off.max():.3f} mm at most"
        spots = shapely.points(before.x[x], before.y[y])
        walls = shapely.union_all([shapely.boundary(band.keep) for band in bands(source.job)])
        inner = shapely.intersects(source.job.target, spots)
        beyond = inner & ~shapely.dwithin(walls, spots, WALL)
        if beyond.any():
            depths = [deepest_point(one, source.job) for one in (run, other)]
            reason = on_details(source.job, spots[beyond], off[y, x][beyond], depths)
            return differs, reason, told
        where = "a cell of the height map at a wall" if inner.any() else "another piece of the waste"
        return differs, where, told
    if told := "; ".join(_harder(stamps, more)):
        return differs, "harder work, within chips, plunges, depth-of-cut and power", told
    return differs, *_feeds(run, other, "the same plate is left")


def deepest_point(run: Run, job: Job) -> float:
    """How deep the pointed tools go, mm."""
    pointed = [tool.number for tool in job.tools if tool.kind is ToolKind.CHAMFER]
    return float(np.max(-run.end[run.cutting & np.isin(run.tool, pointed), 2], initial=0.0))


def on_details(job: Job, spots: np.ndarray, off: np.ndarray, depths: Sequence[float]) -> str:
    """Why heights may differ by ``off`` (n,), mm, at places (n,) on details; pointed tools went so deep, mm.

    On the slope of a chamfer a cell is uncertain. A line of a mark may be a little longer or run a little
    aside while it keeps within the width and the depth that the design gives it; that all strokes are there,
    ``details`` asks. So it does of the turns of a thread, and how far a mill may go beside them; a way out
    that leaves its groove sooner takes less of the wall.
    """
    if shapely.dwithin(slopes(job), spots, WALL).all() and off.max() < PITCH:
        return "a cell of the height map on a chamfer, which details measures"
    for mark in job.details:
        if isinstance(mark, Engraving) and max(depths) <= mark.depth + NEAR:
            strokes = shapely.MultiLineString(list(mark.strokes))
            if shapely.dwithin(strokes, spots, mark.width / 2 + PITCH / 2).all():
                return "a line of a mark, within the width and the depth that it may have"
        if isinstance(mark, Thread):
            reach = np.hypot(shapely.get_x(spots) - mark.centre[0], shapely.get_y(spots) - mark.centre[1])
            if (
                np.abs(reach - (mark.core + mark.diameter) / 4) <= (mark.diameter - mark.core) / 4 + PITCH
            ).all():
                return "in the turns of a thread, which details measures"
    return UNEXPLAINED


def slopes(job: Job) -> shapely.Geometry:
    """Where chamfers are, in plan view: at 45 degrees the height of a cell is as uncertain as it is wide."""
    chamfers = [detail for detail in job.details if isinstance(detail, Chamfer)]
    return shapely.union_all(
        [shapely.buffer(shapely.LinearRing(one.loop.flatten()), one.width) for one in chamfers]
    )


def _harder(stamps: np.ndarray, more: np.ndarray) -> list[str]:
    """What the tools of a program have to do that they had not before, by their stamps on the height map."""
    told = []
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
    return told


def _feeds(run: Run, other: Run, reason: str) -> tuple[str, str]:
    """The reason, or that of other feeds, with the feeds."""
    for tool in np.unique(other.tool[other.cutting]):
        a, b = (r.feed[r.cutting & (r.tool == tool)] for r in (run, other))
        told = f"T{tool} feeds {b.min():g} to {b.max():g}, before {a.min() if a.size else 0:g} to "
        told += f"{a.max() if a.size else 0:g}"
        if not a.size or b.max() > 1.2 * a.max():
            return "faster, within chips, feeds and power", told
        if b.min() < 0.8 * a.min():
            return "slower, but not so slowly that edges rub, which chips asks", told
    return reason, ""


def one(case: tuple[Source, Mutant]) -> Verdict:
    source, made = case
    try:
        proof = prove(made.text, source.job, source.reader)
    except ProgramError as error:
        said = str(error)
        line = int(said.split(":")[0].removeprefix("line ")) if said.startswith("line ") else None
        return Verdict(source.name, made, "reading", said, line)
    except Exception as error:
        return Verdict(source.name, made, "CRASH", repr(error), None)
    if proof.ok:
        return Verdict(source.name, made, "", "", None, *judge(source, made.text))
    first = proof.failures[0]
    return Verdict(source.name, made, first.name, first.message, first.line)


def cases(kinds: tuple[str, ...], each: int, seed: int) -> list[tuple[Source, Mutant]]:
    """Faults of every kind, each in a program chosen at random among those that have a place for it."""
    found = []
    for kind in kinds:
        rng = np.random.default_rng(zlib.crc32(f"{kind} {seed}".encode()))
        mine: list[tuple[Source, Mutant]] = []
        for place in rng.integers(len(sources()), size=20 * each).tolist():
            if len(mine) == each:
                break
            made = mutant(sources()[place].text, kind, rng)
            if made is not None:
                mine.append((sources()[place], made))
        found += mine
    return found


def block_cases(share: float, seed: int) -> list[tuple[Source, Mutant]]:
    """Every fault of every kind of block of each control, and every state at every kind of place."""
    rng = np.random.default_rng(seed)
    found = []
    for control in EVERY:
        mine = [source for source in golden() if source.control == control]
        homes: dict[str, list[Source]] = {}
        for source in mine:
            for kind in kinds(source.text.split("\n")):
                homes.setdefault(kind, []).append(source)
        jobs = [(home, kind, fault) for kind, home in homes.items() for fault in faults(kind)]
        jobs += [(mine, state, place) for state in STATES for place in PLACES]
        for home, what, fault in jobs:
            count = min(int(share), len(home)) if share >= 1 else int(rng.random() < share)
            for index in rng.permutation(len(home))[:count].tolist():
                make = inserted if fault in PLACES else wrong
                made = make(home[index].text.split("\n"), what, fault, rng)
                if made is not None and made.text != home[index].text:
                    found.append((home[index], made))
    return found


def _group(kind: str) -> str:
    """What kinds of fault are counted together: of blocks, the fault without the block."""
    if ": " in kind:
        return kind.split(": ")[1].split(" of ")[0]
    return "state " + kind.split(" ", 1)[1] if kind.endswith(tuple(PLACES)) else kind


def run(every: list[tuple[Source, Mutant]]) -> int:
    """Have all of them proven and print what passes; 1 if any passes for no reason."""
    start, found = time.perf_counter(), []
    print(f"{len(every)} faults in {len({source.name for source, _ in every})} programs", flush=True)
    with multiprocessing.get_context("fork").Pool(PROCESSES) as pool:
        for verdict in pool.imap(one, every, chunksize=4):
            found.append(verdict)
            if (not verdict.check and verdict.differs) or verdict.check == "CRASH":
                made = verdict.mutant
                print(
                    f"{verdict.reason or verdict.check} | {verdict.source} | {made.kind} | line {made.line}: "
                    f"{made.change} | {','.join(verdict.differs)} | {verdict.judged or verdict.message}",
                    flush=True,
                )
    groups = dict.fromkeys(_group(v.mutant.kind) for v in found)
    print(f"{'kind':34} {'made':>5} {'refused':>7} {'same':>5} {'left':>5}")
    for group in groups:
        mine = [v for v in found if _group(v.mutant.kind) == group]
        same = sum(not v.check and not v.differs for v in mine)
        refused = sum(bool(v.check) for v in mine)
        print(f"{group:34} {len(mine):5d} {refused:7d} {same:5d} {len(mine) - refused - same:5d}")
    for title, said in (("refused by", [v.check for v in found if v.check]), ("passes", _reasons(found))):
        print(f"{title}: " + ", ".join(f"{name} {n}" for name, n in Counter(said).most_common()))
    print(f"{len(found)} faults; {time.perf_counter() - start:.0f} s")
    return int(UNEXPLAINED in _reasons(found) or any(v.check == "CRASH" for v in found))


def _reasons(found: Sequence[Verdict]) -> list[str]:
    return [verdict.reason for verdict in found if not verdict.check]


def cases_without_homing(count: int, seed: int) -> list[tuple[Source, Mutant]]:
    """Faults of every kind in programs that go by the work zero alone."""
    made = programs_without_homing.faulty(count, seed, (*PARTS, *MORE_PARTS))
    return [(Source(f"{one.name} grbl", "grbl", one.job, one.text), fault) for one, fault in made]


def main(*arguments: str) -> int:
    if arguments[:1] == ("no-homing",):
        return run(cases_without_homing(int((*arguments, "300")[1]), int((*arguments, "300", "0")[2])))
    if arguments[:1] == ("blocks",):
        share, seed = float((*arguments, "1")[1]), int((*arguments, "1", "0")[2])
        return run(block_cases(share, seed))
    each, seed = int((*arguments, "20")[0]), int((*arguments, "20", "0")[1])
    return run(cases(arguments[2:] or tuple(FAULTS), each, seed))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
