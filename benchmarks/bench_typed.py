"""Whether remedies work when they are typed: ``python benchmarks/bench_typed.py --count 50`` (by night: 500).

Examples are disturbed until ``check`` refuses them. Each remedy that it prints is put into the design, which
is checked again: the finding has to be gone, and no error may stand that did not stand before. Then the first
remedy is followed, and the first of what is left, and so on: no design may come twice.
"""

import argparse
import json
import random
import sys
import time
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import bench_judge

from mechwright import host
from mechwright.contracts.finding import Finding, Severity
from mechwright.designs.change import changed
from mechwright.designs.design import design_of, load
from mechwright.errors import MechwrightError
from mechwright.remedies.bench import identity
from mechwright.scripting.mechanism import Mechanism

MOST = 12
"""Remedies that are followed one after the other."""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20, help="refused designs")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1e9, help="no further design after so long")
    parser.add_argument("--log", type=Path, help="a file that gets a line of JSON for every design")
    parser.add_argument("families", nargs="*")
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    bench_judge.SHARE, bench_judge.WIDE = 0.3, 0.3
    tally, end = Counter[str](), time.monotonic() + asked.seconds
    for what, content, path in drawn(asked):
        if tally["refused"] >= asked.count or time.monotonic() > end:
            break
        try:
            found = check(content, path)
        except MechwrightError:
            tally["no design"] += 1
            continue
        if not errors(found):
            tally["allowed"] += 1
            continue
        tally["refused"] += 1
        faults = [*typed(content, path, found, tally), *followed(content, path, found, tally)]
        for fault in faults:
            print(f"{what}: {fault}", flush=True)
        tally["faults"] += len(faults)
        if asked.log:
            with asked.log.open("a") as log:
                log.write(json.dumps([what, faults]) + "\n")
    print(", ".join(f"{count} {what}" for what, count in tally.items()))
    return 1 if tally["faults"] else 0


def drawn(asked: argparse.Namespace) -> Iterator[tuple[str, dict[str, Any], Path]]:
    """Disturbed examples, the families in turns."""
    families: dict[str, list[Path]] = {}
    for path in sorted(bench_judge.EXAMPLES.rglob("*.toml")):
        if bench_judge.is_design(path):
            families.setdefault(load(path, host()).family.name, []).append(path)
    number = 0
    while True:
        for name, own in families.items():
            if not asked.families or name in asked.families:
                rng = random.Random(f"{asked.seed} {name} {number}")
                path = rng.choice(own)
                content = bench_judge.disturbed(load(path, host()), rng)
                yield f"{name} {number} of {path.stem}", content, path
        number += 1


def check(content: dict[str, Any], path: Path) -> Sequence[Finding]:
    return Mechanism(design_of(content, path, "", host()), host()).check()


def errors(found: Sequence[Finding]) -> list[Finding]:
    return [one for one in found if one.severity is Severity.ERROR]


def typed(
    content: dict[str, Any], path: Path, found: Sequence[Finding], tally: Counter[str]
) -> Iterator[str]:
    """What is wrong with the remedies of findings, each typed by itself."""
    stood = {identity(one) for one in errors(found)}
    for one in found:
        if one.severity is Severity.NOTE:
            continue
        tally[f"{one.severity}s"] += 1
        if one.fix is None:
            tally[f"{one.severity}s without"] += 1
            continue
        after = check(changed(content, one.fix), path)
        if identity(one) in {identity(each) for each in after if each.severity is not Severity.NOTE}:
            yield f"{one.code} stays with {dict(one.fix)}"
        for new in errors(after):
            if identity(new) not in stood:
                yield f"{one.code}: {dict(one.fix)} brings {new.code}: {new.message}"


def followed(
    content: dict[str, Any], path: Path, found: Sequence[Finding], tally: Counter[str]
) -> Iterator[str]:
    """What is wrong with the remedies one after the other, up to a design that builds."""
    seen = {json.dumps(content, sort_keys=True, default=str)}
    for _ in range(MOST):
        change = next((one.fix for one in found if one.severity is not Severity.NOTE and one.fix), None)
        if change is None:
            tally["ends without an error" if not errors(found) else "ends with one"] += 1
            return
        content = changed(content, change)
        name = json.dumps(content, sort_keys=True, default=str)
        if name in seen:
            yield f"{dict(change)} leads back"
            return
        seen.add(name)
        found = check(content, path)
    tally["goes on"] += 1


if __name__ == "__main__":
    sys.exit(main())
