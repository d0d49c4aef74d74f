"""Changed files for every reader: counts by outcome, the longest time, the most memory; finds go to a corpus.

    python benchmarks/fuzz_files.py --cases 2000 --seconds 600 --log fuzz.json [READER ...]

Cases are those of ``tests/fuzzing.py``, by number: the same number is the same case.
"""

import argparse
import hashlib
import json
import random
import re
import resource
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from fuzzing import CORPUS, READ, REFUSED, mutated, outcome, readers


def tried(reader: str, first: int, count: int, until: float) -> dict[str, Any]:
    """What comes of cases with these numbers, as many as there is time for."""
    counts, known, longest = Counter[str](), set[str](), 0.0
    seeds = readers()[reader].seeds
    for number in range(first, first + count):
        if time.monotonic() > until:
            break
        rng = random.Random(number)
        (suffix, data), (_, other) = rng.choice(seeds), rng.choice(seeds)
        case = mutated(data, rng.randrange(1 << 48), other)
        begun = time.process_time()
        found = outcome(reader, suffix, case)
        longest = max(longest, time.process_time() - begun)
        if found in {READ, REFUSED}:
            counts[found] += 1
            continue
        kind = re.sub(r"\d+", "#", found)[:80]
        counts[kind] += 1
        if kind not in known:
            known.add(kind)
            folder = CORPUS / reader
            folder.mkdir(parents=True, exist_ok=True)
            (folder / f"{hashlib.sha256(case).hexdigest()[:12]}{suffix}").write_bytes(case)
            print(f"{reader} {number}: {found}", flush=True)
    return {"cases": counts.total(), "counts": dict(counts), "longest s": round(longest, 2)}


def main() -> None:
    """Try, print and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("readers", nargs="*")
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=600.0, help="for all readers together")
    parser.add_argument("--log", type=Path)
    asked = parser.parse_args()
    names = asked.readers or list(readers())
    told: dict[str, Any] = {}
    for place, name in enumerate(names):
        left = asked.seconds - sum(one["wall s"] for one in told.values())
        begun = time.monotonic()
        told[name] = tried(name, asked.first, asked.cases, begun + left / (len(names) - place))
        told[name]["wall s"] = time.monotonic() - begun
        told[name]["most MB so far"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1000
        print(name, json.dumps(told[name]), flush=True)
        if asked.log:
            asked.log.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    sys.exit(any(set(one["counts"]) - {READ, REFUSED} for one in told.values()))


if __name__ == "__main__":
    main()
