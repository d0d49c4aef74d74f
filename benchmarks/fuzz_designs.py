"""Random designs of every family and random chains, within the bounds that families publish: counts.

    python benchmarks/fuzz_designs.py try --family geneva --from 2000 --count 500 --log designs.jsonl
    python benchmarks/fuzz_designs.py try --seconds 3600 --log designs.jsonl     all families by turns
    python benchmarks/fuzz_designs.py told --log designs.jsonl

Half of them as the kit draws them, half evenly over all bounds: even numbers and odd ones; plates come with a
drawing that is drawn by lot as well. A design is built (motion and parts, every figure finite), or refused by
a finding of its motion or its parts, or by an error in words. Anything else is a fault, told with its number,
which gives the same design again; so is one that takes more than ``SECONDS`` of processor time or lets the
process grow by more than ``MEGABYTES``. The log has one line for each portion; without ``--from`` a family
goes on behind the last number that it has there, and what portions tell adds up.
"""

import argparse
import json
import math
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from fuzzing import SlowError, alarm, memory, peak
from random_chains import chains
from random_designs import WAYS, designs
from random_drawings import plates

from mechwright import Family, Standing
from mechwright.contracts.finding import Stage, errors
from mechwright.designs.design import Design
from mechwright.errors import MechwrightError, PluginFaultError
from mechwright.plugins.host import host

SEED = 25
SECONDS = 60.0
MEGABYTES = 1500
AGAIN = 10
"""Tables drawn by chance before the keys that are refused are left out: most of the time goes there else."""
PORTION = 25
CHAIN = "chain"
"""Stands for chains of mechanisms, beside the names of families."""
SOUND = ("built", "parts refused", "motion refused", "refused by an error")


def outcome(design: Design) -> str:
    """What becomes of a design."""
    try:
        with alarm(SECONDS):
            return _outcome(design)
    except SlowError:
        return f"fault: slow: over {SECONDS:g} s"
    except PluginFaultError as error:
        return f"fault: {error}"
    except MechwrightError as error:
        return f"refused by an error: {error}" if str(error) else "fault: an error without words"
    except Exception as error:  # which is what is sought
        return f"fault: {type(error).__name__}: {error}"


def _outcome(design: Design) -> str:
    found = design.judge()
    figures = [x for one in found for x in (one.value, one.limit) if x is not None]
    word = "motion refused"
    if isinstance(design.family, Standing):
        word = "parts refused"
    elif not errors(found, Stage.MOTION):
        motion = design.solve(181)
        figures += [x for channel in motion.channels.values() for x in channel.values]
        figures += [one.value for one in motion.scalars.values()]
        word = "parts refused"
    if word == "parts refused" and not errors(found, Stage.PARTS):
        word = "built"
        figures += [x for part in design.parts() for one in part.outlines for x in one.bounds]
    return (
        word if all(map(math.isfinite, figures)) else f"fault: a figure of a design that is {word}: no number"
    )


def tried(family: str, numbers: range, until: float) -> dict[str, Any]:
    """Counts of a family, as many designs of these numbers as there is time for."""
    counts, longest, grown, said, done = Counter[str](), (0.0, 0), 0, [], numbers.start
    drawn = [
        _drawn(family, range((numbers.start + 1 - odd) // 2, numbers.stop), way)
        for odd, way in enumerate(WAYS)
    ]
    for number in numbers:
        if time.monotonic() > until:
            break
        design = next(drawn[number % 2])
        begun, had = time.process_time(), memory()
        found = outcome(design)
        longest = max(longest, (round(time.process_time() - begun, 2), number))
        more = (peak() - had) // 1000
        grown, done = max(grown, more), number + 1
        if more > MEGABYTES:
            found = f"fault: takes {more} MB"
        kind = found.partition(":")[0]
        counts[kind] += 1
        if kind not in SOUND[:3] and len(said) < 20:
            said.append({"number": number, "said": found[:300]})
    row = {"family": family, "from": numbers.start, "to": done, "counts": dict(counts)}
    return row | {"longest s": longest[0], "its number": longest[1], "most MB": grown, "said": said}


def _drawn(family: str, numbers: range, way: str) -> Iterator[Design]:
    if family == CHAIN:
        return chains(host(), SEED, numbers, way)
    if family == "plate":
        return plates(host(), SEED, numbers, way)
    return designs(host().family(family), host(), SEED, numbers, way, AGAIN)


def told(rows: list[dict[str, Any]]) -> bool:
    """Print a table of all portions; whether there is no fault."""
    print("| family | numbers | " + " | ".join((*SOUND, "faults", "longest, s", "most memory, MB")) + " |")
    print("| --- " * (len(SOUND) + 5) + "|")
    sound = True
    for name in sorted({row["family"] for row in rows}):
        own = [row for row in rows if row["family"] == name]
        counts = sum((Counter(row["counts"]) for row in own), Counter[str]())
        figures = [f"{counts[kind]:,}" for kind in (*SOUND, "fault")]
        figures += [f"{max(row[key] for row in own)}" for key in ("longest s", "most MB")]
        print(f"| `{name}` | {counts.total():,} | " + " | ".join(figures) + " |")
        sound &= not counts["fault"]
    for row in rows:
        for one in row["said"]:
            if one["said"].startswith("fault"):
                print(f"{row['family']} {one['number']}: {one['said']}")
    return sound


def main() -> None:
    """Try and keep, or tell."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", choices=("try", "told"))
    parser.add_argument("--family", action="append")
    parser.add_argument("--from", type=int, dest="first")
    parser.add_argument("--count", type=int, default=10_000, help="of each family")
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--log", type=Path, required=True)
    asked = parser.parse_args()
    rows = [json.loads(line) for line in asked.log.read_text().splitlines()] if asked.log.exists() else []
    if asked.what == "told":
        sys.exit(not told(rows))
    until = time.monotonic() + asked.seconds
    families = asked.family or [*(one.name for one in host().all(Family)), CHAIN]
    next_of = {
        name: max((row["to"] for row in rows if row["family"] == name), default=0)
        if asked.first is None
        else asked.first
        for name in families
    }
    last = {name: first + asked.count if asked.family else asked.count for name, first in next_of.items()}
    while time.monotonic() < until and any(next_of[name] < last[name] for name in last):
        for family in families:
            first = next_of[family]
            numbers = range(first, min(first + PORTION, last[family]))
            if not numbers or time.monotonic() > until:
                continue
            row = tried(family, numbers, until)
            next_of[family] = row["to"]
            with asked.log.open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
            print(json.dumps(row), flush=True)


if __name__ == "__main__":
    main()
