"""Whether a stopped build leaves a folder whole: ``python benchmarks/bench_interruptions.py --count 200``.

A design and a variant of it are built in turns into one folder, and each build is stopped at a random moment:
by the keyboard, by a system that ends, or killed. The folder then holds the files of one run, as its manifest
lists them, and no process of the build is left.
"""

import argparse
import hashlib
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

DESIGN = (
    'format = 1\nfamily = "geneva"\nname = "wheel"\n'
    '[parameters]\nlaw = "straight"\nrollers = 1\nentry_radius = {}\n'
)
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1e9, help="no further build after so long")
    asked = parser.parse_args()
    rng, tally, end = random.Random(asked.seed), Counter[str](), time.monotonic() + asked.seconds
    with tempfile.TemporaryDirectory() as place:
        path, folder = Path(place) / "wheel.toml", Path(place) / "out"
        digests, longest = {}, 0.0
        for radius in (40, 45):
            begun = time.monotonic()
            subprocess.run(command(path, folder, radius), check=True, capture_output=True, cwd=place)
            longest = time.monotonic() - begun
            digests[digest(folder)] = radius
        for number in range(asked.count):
            if time.monotonic() > end:
                break
            fault = stopped(path, folder, rng, longest, digests, tally)
            tally["builds"] += 1
            if fault:
                tally["faults"] += 1
                print(f"{number}: {fault}", flush=True)
    print(", ".join(f"{count} {what}" for what, count in tally.items()))
    return 1 if tally["faults"] else 0


def command(path: Path, folder: Path, radius: int) -> list[str]:
    path.write_text(DESIGN.format(radius))
    return [sys.executable, "-m", "mechwright", "build", path.name, "-o", folder.name]


def digest(folder: Path) -> str:
    """Of all files of a folder, which are those of its manifest; empty for another folder."""
    listed = json.loads((folder / "manifest.json").read_text())["outputs"]
    files = {one.name for one in folder.iterdir()} - {"manifest.json"}
    if files != set(listed):
        return ""
    found = hashlib.sha256()
    for name in sorted(files):
        found.update(name.encode() + (folder / name).read_bytes())
    return found.hexdigest()


def stopped(
    path: Path,
    folder: Path,
    rng: random.Random,
    longest: float,
    digests: dict[str, int],
    tally: Counter[str],
) -> str:
    """What is wrong after a build was stopped; empty if nothing is."""
    radius, stop = rng.choice((40, 45)), rng.choice(SIGNALS)
    before, there = digest(folder), set(path.parent.iterdir())
    words = command(path, folder, radius)
    running = subprocess.Popen(
        words,
        cwd=path.parent,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    time.sleep(rng.random() * longest * 1.05)
    if stop == signal.SIGTERM:
        running.send_signal(stop)
    else:
        os.killpg(running.pid, stop)
    out, said = running.communicate(timeout=60)
    code, after = running.returncode, digest(folder)
    tally[f"{signal.Signals(stop).name} {code}"] += 1
    if not after or after not in digests:
        return f"{stop!r}: the folder is mixed"
    if code not in {0, 128 + stop, -stop}:
        return f"{stop!r}: exit code {code}: {said}"
    if code == 128 + stop and after != before:
        return f"{stop!r}: another run stands, and it said {said!r}"
    if code == 0 and digests[after] != radius:
        return f"{stop!r}: it was written, and is not there: {out!r}"
    rest = set(path.parent.iterdir()) - there
    if rest and stop != signal.SIGKILL:
        return f"{stop!r}: {sorted(one.name for one in rest)} are left"
    tally["left by a killed build"] += bool(rest)
    time.sleep(0.5)
    alive = [
        status for status in map(status_of, Path("/proc").glob("[0-9]*/stat")) if status[2] == running.pid
    ]
    return f"{stop!r}: processes are left" if alive else ""


def status_of(path: Path) -> tuple[str, int, int]:
    """State, parent and group of a process; one that has ended, and that nobody has waited for, has none."""
    try:
        state, parent, group = path.read_text().rpartition(")")[2].split()[:3]
    except OSError:
        return "Z", 0, 0
    return (state, int(parent), 0 if state == "Z" else int(group))


if __name__ == "__main__":
    sys.exit(main())
