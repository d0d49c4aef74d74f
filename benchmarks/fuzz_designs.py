"""Random designs of every family, within the bounds that it publishes: counts by outcome, times, memory.

    python benchmarks/fuzz_designs.py --designs 10000 --seconds 3600 --log designs.json [FAMILY ...]

Half of them as the kit draws them, half evenly over all bounds. A design is built (motion and parts), or
refused: by a finding of its motion or its parts, or by an error in words. Anything else is a fault, told
with the number that gives the same design again; so is one that takes more than ``SECONDS`` of processor
time.
"""

import argparse
import json
import resource
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

from random_designs import WAYS, designs

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Stage, errors
from mechwright.designs.design import Design
from mechwright.errors import MechwrightError, PluginFaultError
from mechwright.plugins.host import host

SECONDS = 60.0
SOUND = frozenset({"built", "parts refused", "motion refused"})


def outcome(design: Design) -> str:
    """What becomes of a design."""
    begun = time.process_time()
    try:
        found = design.judge()
        if errors(found, Stage.MOTION):
            word = "motion refused"
        else:
            design.solve(181)
            word = "parts refused"
            if not errors(found, Stage.PARTS):
                design.parts()
                word = "built"
    except PluginFaultError as error:
        return f"fault: {error}"
    except MechwrightError as error:
        return f"no finding, but an error: {error}"
    except Exception as error:  # which is what is sought
        return f"fault: {type(error).__name__}: {error}"
    return word if time.process_time() - begun <= SECONDS else f"slow: over {SECONDS:g} s"


def tried(family: Family[Any], count: int, until: float) -> dict[str, Any]:
    """Counts of a family, as many designs as there is time for."""
    counts, longest, faults = Counter[str](), 0.0, []
    both = [designs(family, host(), 25, range(count // 2), way) for way in WAYS]
    for number in range(2 * (count // 2)):
        if time.monotonic() > until:
            break
        way = number % 2
        design = next(both[way])
        begun = time.process_time()
        found = outcome(design)
        longest = max(longest, time.process_time() - begun)
        counts[found if found in SOUND else found.partition(":")[0]] += 1
        if found not in SOUND and len(faults) < 20:
            faults.append({"number": number // 2, "way": WAYS[way], "said": found[:400]})
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1000
    return {"counts": dict(counts), "longest s": round(longest, 2), "most MB so far": most, "faults": faults}


def main() -> None:
    """Try, print and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("families", nargs="*")
    parser.add_argument("--designs", type=int, default=10_000)
    parser.add_argument("--seconds", type=float, default=3600.0, help="for all families together")
    parser.add_argument("--log", type=Path)
    asked = parser.parse_args()
    every = [one for one in host().all(Family) if not asked.families or one.name in asked.families]
    end, told = time.monotonic() + asked.seconds, {}
    for place, family in enumerate(every):
        share = (end - time.monotonic()) / (len(every) - place)
        told[family.name] = tried(family, asked.designs, time.monotonic() + share)
        print(family.name, json.dumps(told[family.name]), flush=True)
        if asked.log:
            asked.log.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    sys.exit(any(set(one["counts"]) - SOUND for one in told.values()))


if __name__ == "__main__":
    main()
