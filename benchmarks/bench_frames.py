"""How many random designs get a frame, or a refusal by name: ``python benchmarks/bench_frames.py``.

Designs whose parts can be made get ``frame = "base"`` with a motor. Of those that are refused the changes
that the refusals propose are made, one after the other: how many have a frame then.
"""

import argparse
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

from random_designs import WAYS, designs, near

from mechwright import Design, DesignError, Family, Stage, host
from mechwright.contracts.finding import Change, Finding, errors
from mechwright.designs.design import design_of, load

MACHINE = {"frame": "base", "motor": "auto"}

STEPS = 6
"""So many remedies are followed, one after the other."""

DRAWN = 250
"""So many designs are drawn at most for each that is wanted: most of them cannot be made."""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--way", choices=WAYS, default="likely")
    parser.add_argument("--near", type=Path, help="a design file, about which designs are drawn instead")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="of the parameters")
    parser.add_argument("--tell", action="store_true", help="print every refusal")
    parser.add_argument("--no-fix", dest="fix", action="store_false", help="follow no remedies")
    parser.add_argument("families", nargs="*", default=sorted(host().of(Family)))
    asked = parser.parse_args()
    warnings.simplefilter("ignore")  # of arrays, in designs nobody would ask for
    families = [load(asked.near, host()).family.name] if asked.near else asked.families
    faults = [fault for name in families for fault in one_family(name, asked)]
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


def one_family(name: str, asked: argparse.Namespace) -> list[str]:
    """Print what became of the designs of one family; gives those without a frame or a named reason."""
    found, framed, fixed = host(), 0, Counter[str]()
    refused, faults, times, shown = Counter[str](), [], [], 0
    numbers = range(DRAWN * asked.count)
    given = {key: read(value) for key, value in (word.split("=") for word in asked.set)}
    if asked.near:
        all_drawn = near(load(asked.near, found), found, asked.seed, numbers)
    else:
        all_drawn = designs(found.family(name), found, asked.seed, numbers, asked.way)
    for number, drawn in zip(numbers, all_drawn, strict=True):
        content = {key: table for key, table in drawn.content.items() if key != "machine"}
        content["parameters"] = {
            **content["parameters"],
            **given,
        }
        try:
            plain = design_of(content, Path("random.toml"), "", found)
            if errors(plain.check(), Stage.PARTS):
                continue
            design = design_of({**content, "machine": MACHINE}, Path("random.toml"), "", found)
        except DesignError:
            continue
        if shown == asked.count:
            break
        shown, start = shown + 1, time.process_time()
        told = errors(design.check(), Stage.PARTS)
        times.append(time.process_time() - start)
        parts = [part for around in design.surroundings for part in around.parts]
        if parts and not told:
            framed += 1
        elif not told:
            faults.append(f"{name} {number}: no frame, and nothing says why")
        else:
            refused[told[0].code] += 1
            if asked.tell:
                print(f"  {number}: {told[0].code} {told[0].parameter}: {told[0].message}; {told[0].remedy}")
            faults += [f"{name} {number}: {one}" for one in told if not named(one)]
            if asked.fix:
                fixed[outcome(design)] += 1
    way = f"near {asked.near.stem}" if asked.near else asked.way
    print(f"\n{name}, {way}: {shown} designs that can be made, seed {asked.seed}")
    print(f"  framed {framed}, refused {sum(refused.values())}: {dict(refused.most_common())}")
    if asked.fix:
        print(f"  the refused after their remedies: {dict(fixed.most_common())}")
    print(f"  processor time: mean {sum(times) / max(shown, 1):.2f} s, most {max(times, default=0):.1f} s")
    return faults


def read(value: str) -> float | str:
    """A number, or words."""
    try:
        return float(value)
    except ValueError:
        return value


def named(finding: Finding) -> bool:
    """Whether a refusal says which key it is about, and what to do."""
    return bool(finding.parameter and finding.remedy)


def outcome(design: Design) -> str:
    """What the proposals of the refusals make of a refused design."""
    for _ in range(STEPS):
        told = errors(design.check(), Stage.PARTS)
        if not told:
            machine = design.content["machine"]
            kept = "framed" if machine["frame"] != "none" else "left without a frame"
            return kept if machine["motor"] != "none" else f"{kept}, without a motor"
        steps = [better for change in told[0].proposed if (better := changed(design, told[0], change))]
        if not steps:
            return f"left with {told[0].code}"
        design = min(steps, key=own_errors)
    return "not framed within so many remedies"


def own_errors(design: Design) -> int:
    """How many errors the mechanism has without its frame: the first change that makes none is taken."""
    return len(errors(design.family.check(design.params), Stage.PARTS))


def changed(design: Design, finding: Finding, change: Change) -> Design | None:
    """The design with a change, if that removes the finding."""
    try:
        better = design.changed(change)
        left = {(one.code, one.parameter) for one in errors(better.check(), Stage.PARTS)}
    except DesignError:
        return None
    return None if (finding.code, finding.parameter) in left else better


if __name__ == "__main__":
    sys.exit(main())
