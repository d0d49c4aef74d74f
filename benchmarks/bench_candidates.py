"""Every design of every synthesis passes every check and keeps every limit: ``bench_candidates.py [COUNT]``.

Requirements of all kinds of all families by turns, drawn near what they are by default. Each design is read
from the text of its file, checked through all stages (motion, parts, machining, comparison of the solids),
compared with the other designs, and with the limits of its requirement: by its figures, and for links and
transmission angles by what the motion of the design itself says.
"""

import argparse
import math
import sys
import time
from collections import Counter
from collections.abc import Iterator

import numpy as np
from harness import require
from random_requirements import kinds, near_default

import mechwright as mw
from mechwright.contracts.finding import errors
from mechwright.testing.likeness import repeated
from mechwright.testing.limits import limits_broken

SHARE = 1e-6
"""Of a limit, that what is measured on the design may lie beyond it: digits of the file, samples."""

LINKS = {
    "four-bar": ("crank", "coupler", "follower", "ground"),
    "slider-crank": ("crank", "rod"),
}
"""Links that ``shortest_link`` and ``longest_link`` speak of."""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", nargs="?", type=int, default=100)
    parser.add_argument("--first", type=int, default=0, help="number of the first: for parts of a long run")
    asked = parser.parse_args()
    every = kinds()
    told: Counter[str] = Counter()
    for number in range(asked.first, asked.first + asked.count):
        family, kind = every[number % len(every)]
        table = near_default(family, kind, np.random.default_rng([23, number]))
        start = time.process_time()
        found = mw.synthesize(family, kind, **table)
        bad = list(faults(found))
        told["requirements"] += 1
        told["without a design"] += not len(found)
        told["without a design or a reason"] += not len(found) and not errors(found.result.findings)
        told["designs"] += len(found)
        told["designs with a fault"] += len({name for name, _ in bad})
        print(f"{number} {family} {kind}: {found.told}, {time.process_time() - start:.0f} s", flush=True)
        if not len(found):
            print(f"    {str(found.result.findings[0])[:160]}")
        for name, said in bad:
            print(f"    {name}: {said}", flush=True)
    print(", ".join(f"{count} {what}" for what, count in told.items()))
    kept = require("designs with a fault", told["designs with a fault"], 0.0)
    return 0 if require("without a reason", told["without a design or a reason"], 0.0) and kept else 1


def faults(found: mw.Found) -> Iterator[tuple[str, str]]:
    """Names of designs and what is wrong with them."""
    for candidate, mechanism in zip(found.result.candidates, found, strict=True):
        for one in mechanism.check().errors:
            yield mechanism.design.name, str(one)
        for said in limits_broken(found.asked.table, candidate):
            yield mechanism.design.name, said
        for said in measured(found, mechanism):
            yield mechanism.design.name, said
    for said in repeated(found.asked.family, found.result.candidates):
        yield found.asked.name, said


def measured(found: mw.Found, mechanism: mw.Mechanism) -> Iterator[str]:
    """Limits of links and transmission angles that the design itself breaks."""
    asked, params = found.asked.table, mechanism.design.params
    for key, beyond in (("shortest_link", min), ("longest_link", max)):
        limit = getattr(asked, key, None)
        names = LINKS.get(found.asked.family.name)
        if limit is None or names is None:
            continue
        names = names[:1] if key == "shortest_link" and found.asked.family.name == "slider-crank" else names
        length = beyond(getattr(params, name) for name in names)
        over = limit - length if beyond is min else length - limit
        if over > SHARE * limit:
            yield f"{key}: {limit:g} asked, the design has {length:.9g}"
    limit = getattr(asked, "least_transmission_angle", getattr(asked, "least_transmission", None))
    scalars = mechanism.motion.scalars
    angle = scalars.get("least_transmission_angle", scalars.get("transmission_angle_min"))
    if limit and angle is not None and math.degrees(angle.value) < limit * (1 - SHARE):
        yield f"transmission angle: {limit:g} degrees asked, the motion has {math.degrees(angle.value):.9g}"


if __name__ == "__main__":
    sys.exit(main())
