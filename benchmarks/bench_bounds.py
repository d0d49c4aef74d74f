"""Time and memory of the proof for long and hostile programs: ``python benchmarks/bench_bounds.py [NAME]``

Each program is a proven one with lines put in front of its last retract, proven in a process of its own.
"""

import math
import random
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from by_control import prove
from golden_operations import made

from mechwright.errors import ProgramError

MANY = 100_000
LONGEST = 60
"""A program may take so long before it is given up, s."""
_RNG = random.Random(1)


def _places(count: int) -> list[str]:
    return [f"X{_RNG.uniform(-25, 25):.3f} Y{_RNG.uniform(-20, 20):.3f}" for _ in range(count)]


def _spiral() -> list[str]:
    out = []
    for k in range(MANY):
        reach, turn = 10 * (1 + k / MANY), k / 50
        out.append(f"G1 X{reach * math.cos(turn):.3f} Y{reach * math.sin(turn):.3f}")
    return out


def _calls() -> list[str]:
    subs = [line for k in range(10, 30_010) for line in (f"O{k} sub", "#31=1", f"O{k} endsub")]
    return subs + [f"O{_RNG.randrange(10, 30_010)} call" for _ in range(400_000)]


CASES: dict[str, Callable[[], list[str]]] = {
    "100,000 cuts in air": lambda: ["G1 Z1 F1000", *(f"G1 {p}" for p in _places(MANY))],
    "100,000 rapids": lambda: [f"G0 {p}" for p in _places(MANY)],
    "100,000 short cuts": lambda: ["G0 X0 Y0", "G1 Z-.5 F1000", *_spiral()],
    "100,000 crossing cuts": lambda: ["G1 Z-.5 F1000", *(f"G1 {p}" for p in _places(MANY))],
    "20,000 through cuts": lambda: ["G1 Z-4.3 F1000", *(f"G1 {p}" for p in _places(20_000))],
    "1,000 crossing circles": lambda: [
        *("G0 X0 Y0", "G1 Z-.5 F1000"),
        *(f"G2 I{_RNG.uniform(1, 20):.3f} J{_RNG.uniform(1, 20):.3f}" for _ in range(1000)),
    ],
    "30,000 holes": lambda: ["G98 G81 X0 Y0 Z-1 R1 F100", *_places(30_000), "G80"],
    "2,000 rapids in stock": lambda: ["G0 Z-1", *(f"G0 {p}" for p in _places(2000))],
    "100,000 changes of speed": lambda: [f"S{k % 9000} M3" for k in range(MANY)],
    "an endless loop": lambda: ["O1 while [1]", "#1=[#1+1]", "O1 endwhile"],
    "30,000 subs, 400,000 calls": _calls,
    "pecks of a micrometre": lambda: [f"G98 G83 {p} Z-5 R1 Q.001 F100" for p in _places(1000)],
    "arcs of 1,000 turns in ZX": lambda: ["G18 F100", *(["G2 X0 Z5 I5 K0 P1000"] * 1000)],
}


def one(name: str) -> None:
    """Prove one program and tell what it took."""
    job = made("profile-outside", "linuxcnc")[0]
    lines = job.text.splitlines()
    last = next(k for k, line in enumerate(lines) if line.startswith("M9"))
    text = "\n".join([*lines[:last], "G0 Z5", *CASES[name](), *lines[last:], ""])
    start = time.perf_counter()
    try:
        proof = prove(text, job.job)
        said = "proven" if proof.ok else f"refused by {proof.failures[0].name}"
    except ProgramError as error:
        said = str(error)
    took, most = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{name:28} {took:6.1f} s {most:6.0f} MB  {said}", flush=True)


def main(*names: str) -> None:
    for name in names or CASES:
        call = [sys.executable, __file__, "--one", name]
        try:
            subprocess.run(call, check=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            print(f"{name:28} more than {LONGEST} s")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        one(sys.argv[2])
    else:
        main(*sys.argv[1:])
