"""Cost that grows as the work does: ``python benchmarks/bench_growth.py [gears] [stars] [solve]``.

Processor time and greatest memory of a child for pairs of elliptic gears of one module, for plates with more
and more points of one size, and for tables of more and more samples, of a design of each family. The smallest
case of its kind, a pair of 25 teeth or a table of 1,000 samples, stands for what a child takes in any case:
imports, tables, caches. What each further tooth, point or sample takes may be ``GROWTH`` times what it takes
in any smaller size; ``solve`` is bounded as well.
"""

import itertools
import math
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import ezdxf
from harness import require

EXAMPLE = Path(__file__).parents[1] / "examples" / "elliptic-pair.toml"
GROWTH = 1.3
MOST_SECONDS = 15.0
"""Processor time of planning and proof of 300 teeth, s, of one core."""
MOST_MEMORY = 400.0
"""MB, of a million samples."""
LEAST = 1e-6
"""s or MB: shares below it are noise."""
SOLVED = (
    "elliptic-pair", "figure-eight-best", "noncircular-lobes", "geneva-motor", "four-bar-slots",
    "slider-crank-quick-return", "five-bar-slots", "spherical-five-bar-refined", "cam-conjugate",
)  # fmt: skip
"""Examples that are solved."""
SEMI_MAJOR = 1.6
"""mm for each tooth: a module of 3.07 mm at e = 0.4, so that all have the same cutters."""
POINT_PITCH, POINT_DEPTH = 5.0, 5.0
"""mm of circumference for each point of a star, and how deep it is: the finest mill has to finish it."""

PLANNED = """
import resource, sys
from mechwright import load
from mechwright_cam.machining import Machining

design = load(sys.argv[1])
design.require()
design.parts
begun = sum(resource.getrusage(resource.RUSAGE_SELF)[:2])
proofs = [item.proof for item in design.made(Machining).proven_programs]
assert proofs  # those that fail are raised
used = resource.getrusage(resource.RUSAGE_SELF)
print(sum(used[:2]) - begun, used.ru_maxrss / 1024)
"""

SOLVE = """
import resource, sys
from pathlib import Path
from mechwright import load
from mechwright.contracts.finding import Stage

load(sys.argv[1]).asked(command="solve", samples=int(sys.argv[2])).write(sys.argv[3], Stage.MOTION)
used = resource.getrusage(resource.RUSAGE_SELF)
print(sum(used[:2]), used.ru_maxrss / 1024)
"""

MACHINE = "travel_x = 3000\ntravel_y = 3000\ntravel_z = 500\n"


@dataclass(frozen=True)
class Cost:
    """Processor time, s, and greatest memory, MB, of a child."""

    seconds: float
    memory: float


def cost(code: str, *arguments: object) -> Cost:
    """What a child takes for some Python code that prints both."""
    command = [sys.executable, "-c", code, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, arguments))}: {done.stderr.splitlines()[-1]}")
    return Cost(*map(float, done.stdout.split()))


def pair(teeth: int, folder: Path) -> Path:
    """The example with so many teeth of one module, on a machine that is large enough."""
    text = EXAMPLE.read_text(encoding="utf-8")
    for old, new in (
        ("teeth = 25", f"teeth = {teeth}"),
        ("semi_major = 50", f"semi_major = {SEMI_MAJOR * teeth:g}"),
        ("speed = 60", "speed = 5"),
        ("thickness = 10", "thickness = 5"),
        ("bore = 12", "bore = 6"),
        ('origin = "axis"', 'origin = "axis"\nmachine = "large.toml"'),
    ):
        assert old in text, old
        text = text.replace(old, new)
    path = folder / f"pair-{teeth}.toml"
    path.write_text(text, encoding="utf-8")
    return path


def star(points: int, folder: Path) -> Path:
    """A plate with so many points of one size, on a machine that is large enough."""
    name, radius = f"star-{points}", POINT_PITCH * points / math.tau
    drawing = ezdxf.new(units=4)
    at = [(radius - POINT_DEPTH * (n % 2), math.pi * n / points) for n in range(2 * points)]
    corners = [(away * math.cos(turn), away * math.sin(turn)) for away, turn in at]
    drawing.modelspace().add_lwpolyline(corners, close=True)
    drawing.saveas(folder / f"{name}.dxf")
    path = folder / f"{name}.toml"
    path.write_text(
        f'format = 1\nfamily = "plate"\nname = "{name}"\n[parameters]\ndrawing = "{name}.dxf"\n'
        'thickness = 3\n[cam]\nmachine = "large.toml"\n',
        encoding="utf-8",
    )
    return path


def grown(title: str, least: int, costs: Mapping[int, Cost], unit: str, each: int) -> bool:
    """Print what each ``each`` more than the least size take, and whether that is the same for all sizes."""
    print(f"\n{title}")
    base, shares = costs[least], {"time": [], "memory": []}
    for size, one in costs.items():
        line = f"  {size:>9,} {unit:8} {one.seconds:7.1f} s {one.memory:6.0f} MB"
        if size > least:
            more = (size - least) / each
            shares["time"].append((one.seconds - base.seconds) / more)
            shares["memory"].append((one.memory - base.memory) / more)
            time, memory = (share[-1] for share in shares.values())
            line += f"; for each {each} more {1e3 * time:6.2f} ms {1e3 * memory:6.0f} kB"
        print(line)
    kept = [
        require(f"{name} for each of the {unit}, to that in a smaller size", rise(share), GROWTH)
        for name, share in shares.items()
    ]
    return all(kept)


def rise(shares: Sequence[float]) -> float:
    """By how much one of some shares is more than one before it; what no longer grows is no rise."""
    return max(later / max(early, LEAST) for early, later in itertools.combinations(shares, 2))


def gears(folder: Path) -> bool:
    (folder / "large.toml").write_text(MACHINE, encoding="utf-8")
    costs = {teeth: cost(PLANNED, pair(teeth, folder)) for teeth in (25, 99, 300, 600)}
    kept = grown("planning and proof of a pair", 25, costs, "teeth", 1)
    return require("300 teeth, s of one core", costs[300].seconds, MOST_SECONDS) and kept


def stars(folder: Path) -> bool:
    (folder / "large.toml").write_text(MACHINE, encoding="utf-8")
    costs = {points: cost(PLANNED, star(points, folder)) for points in (30, 60, 120, 240)}
    return grown("planning and proof of a star", 30, costs, "points", 1)


def solve(folder: Path) -> bool:
    kept = [_solved(EXAMPLE.with_stem(name), folder) for name in SOLVED]
    return all(kept)


def _solved(design: Path, folder: Path) -> bool:
    def of(samples: int) -> Cost:
        found = cost(SOLVE, design, samples, folder / "solved")
        shutil.rmtree(folder / "solved")
        return found

    costs = {samples: of(samples) for samples in (1_000, 250_000, 1_000_000)}
    kept = grown(f"solve {design.stem}", 1_000, costs, "samples", 1000)
    return require("a million samples, MB", costs[1_000_000].memory, MOST_MEMORY) and kept


WORK: dict[str, Callable[[Path], bool]] = {"gears": gears, "stars": stars, "solve": solve}


def main(*wanted: str) -> int:
    with tempfile.TemporaryDirectory() as folder:
        kept = [WORK[name](Path(folder)) for name in wanted or WORK]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
