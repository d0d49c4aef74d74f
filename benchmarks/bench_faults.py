"""Interruptions at random moments, and faults of the disk at every step of writing: counts by outcome.

    python benchmarks/bench_faults.py --runs 200 --log faults.json
    python benchmarks/bench_faults.py --only interruptions --runs 50 --seed 26

A run of ``solve`` is stopped by the keyboard, ended, or killed at a random moment between its start and
a little after its end; the folder then holds the files of before or of now, whole. What a killed run
leaves beside it has to be gone after the next one. Then each call that changes a file fails once, in
five ways.
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

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "core"))

from writing_faults import built, counted  # noqa: E402

SIGNALS = {"keyboard": signal.SIGINT, "ended": signal.SIGTERM, "killed": signal.SIGKILL}
CODES = {"keyboard": {0, 130}, "ended": {0, 143}, "killed": {0, -9}}
NOT_BEGUN = "ended by the interpreter, which had not begun the program"
EXAMPLE = ROOT / "examples" / "slider-crank-quick-return.toml"


def digest(folder: Path) -> str:
    """Of all that a folder holds, by name; empty where there is none."""
    if not folder.exists():
        return ""
    found = hashlib.sha256()
    for path in sorted(folder.iterdir()):
        found.update(path.name.encode() + b"\0" + path.read_bytes())
    return found.hexdigest()


def started(design: Path, out: Path) -> "subprocess.Popen[str]":
    """A run that the keyboard can stop, in a session of its own."""
    return subprocess.Popen(
        [sys.executable, "-m", "mechwright", "solve", str(design), "-o", str(out)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def members(session: int) -> list[str]:
    """Processes of a session that still live."""
    done = subprocess.run(["ps", "-eo", "sess=,stat=,pid="], capture_output=True, text=True, check=True)
    rows = (line.split() for line in done.stdout.splitlines())
    return [row[2] for row in rows if row[0] == str(session) and not row[1].startswith("Z")]


def begun(code: int, err: str, number: int) -> bool:
    """Whether a stopped run had come to the first line of the program: before, the interpreter speaks."""
    in_words = "KeyboardInterrupt" in err and ("Python error" in err or "__main__.py" not in err)
    return not (in_words or (code == -number and not err))


def interrupted(folder: Path, how: str, rng: random.Random, length: float, states: dict[str, str]) -> str:
    """What comes of one run that is stopped at a random moment."""
    out = folder / "out"
    process = started(folder / "designs" / "b.toml", out)
    time.sleep(rng.uniform(0.0, length))
    process.send_signal(SIGNALS[how])
    _, err = process.communicate(timeout=120)
    end = time.monotonic() + 5
    while (alive := members(process.pid)) and time.monotonic() < end:
        time.sleep(0.1)
    stands = states.get(digest(out), "mixed")
    left = [path.name for path in folder.iterdir() if path.name not in {"out", "designs"}]
    if alive:
        return "processes left"
    if how != "killed" and not begun(process.returncode, err, SIGNALS[how]):
        return f"{stands} files, {NOT_BEGUN}"
    if process.returncode not in CODES[how]:
        return f"exit code {process.returncode}: {err.strip()[-200:]}"
    if "Traceback" in err or (process.returncode in {130, 143} and len(err.splitlines()) != 1):
        return f"words: {err.strip()[-200:]}"
    return f"{stands} files" + (", a folder left for the next run" if left else "")


def interruptions(runs: int, seed: int, log: Path | None = None) -> tuple[dict[str, int], int]:
    """Counts by how a run was stopped and what stands; and how many folders are left after one more run."""
    rng, counts = random.Random(seed), Counter[str]()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place).resolve()
        text = EXAMPLE.read_text(encoding="utf-8")
        designs = folder / "designs"
        designs.mkdir()
        (designs / "a.toml").write_text(text, encoding="utf-8")
        (designs / "b.toml").write_text(text.replace("speed = 60", "speed = 61"), encoding="utf-8")
        out, states = folder / "out", {"": "no"}
        begun = time.monotonic()
        for name, design in (("new", "b.toml"), ("old", "a.toml")):
            done = started(designs / design, out)
            done.communicate(timeout=300)
            assert done.returncode == 0, design
            states[digest(out)] = name
        assert len(states) == 3, "the two designs give the same files"
        length = 1.1 * (time.monotonic() - begun) / 2
        for number in range(runs):
            how = list(SIGNALS)[number % 3]
            what = interrupted(folder, how, rng, length, states)
            counts[f"{how}: {what}"] += 1
            if log is not None:
                log.write_text(json.dumps(counts, indent=1) + "\n", encoding="utf-8")
            if what.startswith("new"):
                started(designs / "a.toml", out).communicate(timeout=300)
        started(designs / "a.toml", out).communicate(timeout=300)
        left = len([path for path in folder.iterdir() if path.name not in {"out", "designs"}])
    return dict(sorted(counts.items())), left


def main() -> None:
    """Count, print and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--seed", type=int, default=25)
    parser.add_argument("--only", choices=("faults", "interruptions"), help="one half; both without it")
    parser.add_argument("--log", type=Path)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        shim = None if asked.only == "interruptions" else built(Path(place).resolve())
        faults = {} if shim is None else {name: dict(found) for name, found in counted(shim).items()}
    runs = 0 if asked.only == "faults" else asked.runs
    stopped, left = interruptions(runs, asked.seed, asked.log) if runs else ({}, 0)
    told = {"faults": faults, "interruptions": stopped, "left after the next run": left}
    said = json.dumps(told, indent=1)
    if asked.log:
        asked.log.write_text(said + "\n", encoding="utf-8")
    print(said)
    words = [word for found in faults.values() for word in found] + [
        one.partition(": ")[2] for one in stopped
    ]
    sound = {"written", "refused", "old files", "new files", "old files, a folder left for the next run"}
    sound |= {"new files, a folder left for the next run", f"old files, {NOT_BEGUN}"}
    sys.exit(1 if left or set(words) - sound or os.name == "nt" else 0)


if __name__ == "__main__":
    main()
