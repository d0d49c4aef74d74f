"""Do the tests bite? One fault at a time in the source, and the tests that reach its line: score, survivors.

    python benchmarks/bench_mutation.py reach --area geometry tests/core/test_fit.py   lines that tests reach
    python benchmarks/bench_mutation.py run --area geometry --sample 200 --seconds 600     plant a draw
    python benchmarks/bench_mutation.py again                                              survivors once more
    python benchmarks/bench_mutation.py told                                               scores, survivors
    python benchmarks/bench_mutation.py line --only core/mechwright/geometry/fit.py:131 tests/core/test_fit.py

The last plants each fault of a line and gives it to tests, in a new interpreter; nothing of it is kept.
The others go on where they stopped: what is known stands in ``--place`` (``build/mutation``), one line each.
The draw is seeded, over the mutants of functions that a test that was watched reaches (``--whole``: over all
of an area). A mutant is killed if one of its tests fails, or takes far longer than it should; its tests are
those that reach its lines, the quickest first, for ``--budget`` seconds. It is planted in a fork of a process
that has collected the tests, so that it takes as long as they do; ``again`` tries survivors once more, and
gives who survives there, or stands outside of functions, to a new interpreter on a changed copy, which
processes that tests start see too.
Every tenth time the same tests run without the fault and have to pass: otherwise the outcome is ``broken``
and counts for nothing.

mutmut 3.8 mutates functions alone, of one source root that must not be installed, and sees no doctests;
cosmic-ray 8.7 starts pytest anew for each mutant, with all tests.
"""

import argparse
import hashlib
import json
import random
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from code_mutants import Mutant, mutants
from mutation_tests import ROOMS, ROOT, Reaching, Suite, afresh, forked, tree

PLANS = ("planning", "operations", "setup")
AREAS: dict[str, tuple[str, ...]] = {
    "proof": ("cam/mechwright_cam/proof/",),
    "checker": ("cam/mechwright_check/",),
    "readers": ("cam/mechwright_cam/controls/",),
    "planning": tuple(
        f"cam/{room}/" for room in ("mechwright_plane", *(f"mechwright_cam/{one}" for one in PLANS))
    ),
    "geometry": ("core/mechwright/geometry/",),
    "kinematics": ("core/mechwright/mechanics/", "plugins/"),
    "core": ("core/mechwright/",),
    "cutting": ("cam/mechwright_cut/",),
    "printing": ("cam/mechwright_print/",),
    "cam": ("cam/mechwright_cam/", "cam/mechwright_cad/"),
}
"""The first that fits; goals: 0.95 of the first two, 0.85 of the others."""
GOALS = {name: 0.95 if name in {"proof", "readers"} else 0.85 for name in AREAS}
LONG = 900.0
"""Seconds for the tests of one file under the watch."""
CONTROL = 10
"""Every so many mutants their tests run without a fault too."""
MANY = 150
"""Tests of one mutant at most."""
KILLED, SURVIVED, UNTESTED, BROKEN, OUTSIDE = "killed", "survived", "no test", "broken", "outside"
NOT_PLANTED = 3
SECONDS = 60.0
"""Of tests that nobody has watched."""


@dataclass(frozen=True)
class Known:
    """Tests that were watched: the seconds that each takes, and the lines that it reaches, by file."""

    seconds: Mapping[str, float]
    lines: Mapping[str, Mapping[int, frozenset[str]]]

    def of(self, mutant: Mutant, budget: float) -> dict[str, float]:
        """The quickest tests that reach the lines of a mutant, as many as the budget has room for."""
        reached = self.lines.get(mutant.path, {})
        found = {
            test for line in range(mutant.line, mutant.end[0] + 1) for test in reached.get(line, frozenset())
        }
        chosen: dict[str, float] = {}
        for test in sorted(found, key=lambda one: (self.seconds[one], one)):
            if chosen and (sum(chosen.values()) + self.seconds[test] > budget or len(chosen) == MANY):
                break
            chosen[test] = self.seconds[test]
        return chosen


def area(path: str) -> str:
    """Of which a file is."""
    return next(name for name, starts in AREAS.items() if path.startswith(starts))


@cache
def all_of(name: str) -> list[Mutant]:
    """All mutants of an area."""
    paths = (path for room in ROOMS for path in sorted((ROOT / room).rglob("*.py")))
    names = ((path.relative_to(ROOT).as_posix(), path) for path in paths)
    found = ((one, path) for one, path in names if area(one) == name)
    return [one for file, path in found for one in mutants(file, path.read_text(encoding="utf-8"))]


def lines(path: Path) -> list[dict[str, object]]:
    """What stands in a file, one value a line; nothing where there is none."""
    return [json.loads(row) for row in path.read_text(encoding="utf-8").splitlines()] if path.exists() else []


def added(path: Path, value: object) -> None:
    """One more line."""
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(value) + "\n")


def digest(name: str) -> str:
    """Of a file of the project."""
    return hashlib.sha256((ROOT / name).read_bytes()).hexdigest()[:12]


def reach(place: Path, names: list[str], files: list[str], end: float) -> None:
    """Watch the tests of files that are not known as they stand, each file in a fork of one that has all."""
    known = {(row["file"], row["digest"], row["area"]) for row in lines(place / "reach.jsonl")}
    asked = [(file, name) for name in names for file in files if (file, digest(file), name) not in known]
    suite = Suite(sorted({file for file, _ in asked}), place / "temporary")
    for file, name in asked:
        if time.monotonic() > end:
            break
        watch, said = Reaching(AREAS[name]), place / "reached.json"

        def work(file: str = file, watch: Reaching = watch, said: Path = said) -> int:
            suite.config.pluginmanager.register(watch)
            suite.run(test for test in suite.items if test.partition("::")[0] == file)
            said.write_text(json.dumps(watch.found), encoding="utf-8")
            return 0

        said.unlink(missing_ok=True)
        begun = time.monotonic()
        forked(work, LONG)
        found = json.loads(said.read_text(encoding="utf-8")) if said.exists() else {}
        row = {"file": file, "digest": digest(file), "area": name, "tests": found}
        added(place / "reach.jsonl", row)
        print(f"{file}: {len(found)} tests of {name}, {time.monotonic() - begun:.0f} s", flush=True)


def known_tests(place: Path) -> Known:
    """What has been watched of test files as they stand now."""
    seconds: dict[str, float] = {}
    found: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
    for row in lines(place / "reach.jsonl"):
        if digest(str(row["file"])) != row["digest"]:
            continue
        for test, (taken, files) in row["tests"].items():  # type: ignore[attr-defined]
            seconds[test] = taken
            for file, numbers in files.items():
                for number in numbers:
                    found[file][number].add(test)
    frozen = {file: {line: frozenset(tests) for line, tests in one.items()} for file, one in found.items()}
    return Known(seconds, frozen)


def outcome(suite: Suite, mutant: Mutant | None, tests: Mapping[str, float]) -> str:
    """What the tests say of a mutant; without one, whether they pass at all."""
    if not tests:
        return UNTESTED
    text = (ROOT / mutant.path).read_text(encoding="utf-8") if mutant else ""

    def work() -> int:
        if mutant and not suite.planted(mutant, text):
            return NOT_PLANTED
        return int(not suite.run(tests))

    code = forked(work, 60.0 + 20 * sum(tests.values()))
    return {0: SURVIVED, NOT_PLANTED: OUTSIDE}.get(1 if code is None else code, KILLED)


def tried(place: Path, draw: list[Mutant], budget: float, end: float, afresh_too: bool) -> None:
    """Outcomes of mutants, as many as there is time for; who survives is tried afresh if asked."""
    known = known_tests(place)
    asked = [(mutant, known.of(mutant, budget)) for mutant in draw]
    files = sorted({test.partition("::")[0] for _, tests in asked for test in tests})
    with tempfile.TemporaryDirectory() as folder:
        within = Path(folder).resolve()
        suite = Suite(files, within / "tests", {mutant.path for mutant in draw if mutant.function})
        for number, (mutant, tests) in enumerate(asked):
            if time.monotonic() > end:
                break
            begun = time.monotonic()
            found = outcome(suite, mutant, tests)
            if found == KILLED and number % CONTROL == 0 and outcome(suite, None, tests) != SURVIVED:
                found = BROKEN
            if afresh_too and found in {SURVIVED, OUTSIDE}:
                found = SURVIVED if afresh(tree(within / "tree"), mutant, tests) else KILLED
            row = {"key": mutant.key, "function": mutant.function, "digest": digest(mutant.path)}
            row |= {"area": area(mutant.path), "outcome": found, "tests": len(tests)}  # type: ignore[dict-item]
            added(place / "outcomes.jsonl", row | {"seconds": round(time.monotonic() - begun, 1)})
            print(f"{found}: {mutant.key}", flush=True)


def last(place: Path) -> dict[str, dict[str, object]]:
    """The last outcome of each mutant."""
    return {str(row["key"]): row for row in lines(place / "outcomes.jsonl")}


def drawn(place: Path, name: str, sample: int, seed: int, whole: bool) -> list[Mutant]:
    """What has no outcome yet of a draw."""
    known, done = known_tests(place), last(place)
    every = [one for one in all_of(name) if whole or (one.function and known.of(one, 0.0))]
    draw = random.Random(seed).sample(every, min(sample, len(every)))
    return [one for one in draw if one.key not in done]


def told(place: Path) -> None:
    """Print the score of each area, and the survivors."""
    rows = last(place).values()
    for name in AREAS:
        counts = Counter(row["outcome"] for row in rows if row["area"] == name)
        judged = counts[KILLED] + counts[SURVIVED] + counts[UNTESTED]
        if judged:
            score = f"{counts[KILLED] / judged:.3f} (goal {GOALS[name]:g})"
            print(f"{name}: {score} of {judged} of {len(all_of(name))}: {dict(counts)}")
    for row in rows:
        if row["outcome"] in {SURVIVED, UNTESTED}:
            print(f"{row['outcome']} [{row['function']}, {row['tests']} tests] {row['key']}")


def of_line(only: str, tests: list[str]) -> None:
    """Print what tests, or files of them, say of each fault of a place that begins so."""
    path = only.partition(":")[0]
    with tempfile.TemporaryDirectory() as folder:
        copy = tree(Path(folder).resolve() / "tree")
        for one in mutants(path, (ROOT / path).read_text(encoding="utf-8")):
            if one.key.startswith(only):
                passed = afresh(copy, one, dict.fromkeys(tests, SECONDS))
                print(f"{SURVIVED if passed else KILLED}: {one.key}", flush=True)


def main() -> None:
    """Watch, try, or tell."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", choices=("reach", "run", "again", "told", "line"))
    parser.add_argument("files", nargs="*")
    parser.add_argument("--place", type=Path, default=ROOT / "build" / "mutation")
    parser.add_argument("--area", choices=tuple(AREAS), action="append")
    parser.add_argument("--sample", type=int, default=500, help="mutants of each area")
    parser.add_argument("--seed", type=int, default=25)
    parser.add_argument("--whole", action="store_true", help="also what no watched test reaches")
    parser.add_argument("--only", default="", help="mutants whose line of outcome holds this")
    parser.add_argument("--budget", type=float, default=10.0, help="seconds of tests for one mutant")
    parser.add_argument("--seconds", type=float, default=3600.0)
    asked = parser.parse_intermixed_args()
    asked.place.mkdir(parents=True, exist_ok=True)
    place, end = asked.place.resolve(), time.monotonic() + asked.seconds
    names = asked.area or list(AREAS)
    if asked.what == "line":
        of_line(asked.only, asked.files)
    elif asked.what == "reach":
        reach(place, names, asked.files, end)
    elif asked.what == "told":
        told(place)
    elif asked.what == "again":
        alive = {key for key, row in last(place).items() if row["outcome"] != KILLED}
        draw = [one for name in names for one in all_of(name) if one.key in alive and asked.only in one.key]
        tried(place, draw, asked.budget, end, afresh_too=True)
    else:
        draw = [one for name in names for one in drawn(place, name, asked.sample, asked.seed, asked.whole)]
        tried(place, [one for one in draw if asked.only in one.key], asked.budget, end, afresh_too=False)
    sys.exit(0)


if __name__ == "__main__":
    main()
