"""Whether ``check`` keeps its word: ``python benchmarks/bench_judge.py --count 150`` (by night: hours).

Examples of every family are disturbed, named badly, or given a random shop. What ``check`` says of each, by
itself and up to each stage, is held against what the commands then do: a design that is allowed up to a stage
passes it, one that is refused is refused by ``build`` with the same codes.
"""

import argparse
import json
import random
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mechwright import Stage, host
from mechwright.contracts.finding import errors
from mechwright.contracts.refused import RefusedError
from mechwright.designs.change import changed
from mechwright.designs.design import design_of, load
from mechwright.errors import MechwrightError
from mechwright.pipeline import WORK
from mechwright.remedies.keys import keys_of
from mechwright.scripting.mechanism import Mechanism

EXAMPLES = Path(__file__).parent.parent / "examples"
SHARE, WIDE = 0.15, 0.12
"""Share of the keys of an example that are changed, and by how much in the mean (of a logarithm)."""
NAMES = (
    "wheel", "gear", "assembly", "motion", "setup", "proof", "summary", "manifest", "con", "aux", "nul",
    "com1", "a", "A", "x" * 64, "x" * 200, "tool", "1", "-", "--json", "part-1", "bill-of-materials",
    "as-made", "O1000", "%", "a b", "ü", "name.toml", "..", "CON.txt", "drive", "poles", "drawing", "n0",
)  # fmt: skip
"""Names that a file system, a control or another file of the same design may have for itself."""


@dataclass
class Verdicts:
    """What is said of one design: error codes by who says it; None where it could not be said."""

    what: str
    said: dict[str, list[str] | None] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    broken: list[str] = field(default_factory=list)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=5, help="designs of each family")
    parser.add_argument("--names", type=int, default=0, help="designs with hostile names")
    parser.add_argument("--shops", type=int, default=0, help="designs with a random shop")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1e9, help="no further design after so long")
    parser.add_argument("--log", type=Path, help="a file that gets a line of JSON for every design")
    parser.add_argument("--stages", action="store_true", help="every stage, not only the last")
    parser.add_argument("families", nargs="*")
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    end, tally = time.monotonic() + asked.seconds, Counter[str]()
    for one in cases(asked):
        if time.monotonic() > end:
            break
        verdicts = judged(one, stages=asked.stages)
        tally["designs"] += 1
        allowed = verdicts.said["check"] == []
        tally["allowed by check"] += allowed
        tally["plain differs"] += allowed and verdicts.said["check --to output"] != []
        tally["broken"] += bool(verdicts.broken)
        if verdicts.broken:
            print(f"{verdicts.what}: {'; '.join(verdicts.broken)}", flush=True)
        if asked.log:
            with asked.log.open("a") as log:
                log.write(json.dumps(vars(verdicts)) + "\n")
    print(", ".join(f"{count} {what}" for what, count in tally.items()))
    return 1 if tally["broken"] else 0


@dataclass(frozen=True)
class Case:
    """A design file's content, where it stands, and what was done to it."""

    what: str
    content: dict[str, Any]
    path: Path
    shop: str = ""


def cases(asked: argparse.Namespace) -> Iterator[Case]:
    """Designs in turns of the families, then names, then shops."""
    found = host()
    paths = [one for one in sorted(EXAMPLES.rglob("*.toml")) if is_design(one)]
    known = {path: load(path, found) for path in paths}
    families: dict[str, list[Path]] = {}
    for path, design in known.items():
        families.setdefault(design.family.name, []).append(path)
    chosen = {name: own for name, own in families.items() if not asked.families or name in asked.families}
    for number in range(asked.count):
        for name, own in chosen.items():
            rng = random.Random(f"{asked.seed} {name} {number}")
            path = rng.choice(own)
            yield Case(f"{name} {number} of {path.stem}", disturbed(known[path], rng), path)
    every = [path for own in chosen.values() for path in own]
    for number in range(asked.names):
        rng = random.Random(f"{asked.seed} name {number}")
        path = rng.choice(every)
        content = dict(known[path].content) | {"name": rng.choice(NAMES)}
        if rng.random() < 0.3 and "nest" not in content.get("cam", {}):
            nest = {"name": rng.choice(NAMES), "length": 400, "width": 300}
            content = changed(content, {f"cam.nest.{key}": value for key, value in nest.items()})
        yield Case(f"name {number} of {path.stem}", content, path)
    for number in range(asked.shops):
        rng = random.Random(f"{asked.seed} shop {number}")
        path = rng.choice(every)
        content = dict(known[path].content) | {"shop": "shop.toml"}
        yield Case(f"shop {number} of {path.stem}", content, path, shop(rng))


def is_design(path: Path) -> bool:
    """Whether a file of the examples is a design, and not what one is asked of or studied by."""
    text = path.read_text()
    other = any(word in str(path) for word in ("template", "study", "requirement", "tutorial"))
    return not other and ("[parameters]" in text or "[[stage]]" in text)


def disturbed(design: Any, rng: random.Random) -> dict[str, Any]:
    """The content of a design with some of the numbers that its file says changed."""
    change: dict[str, Any] = {}
    for path, key in keys_of(design).items():
        if key.numeric and key.stands_in(design.content) and rng.random() < SHARE:
            now = float(key.now(design.content))
            new = now * 2.718281828 ** rng.gauss(0.0, WIDE) if now else 0.0
            new = min(max(new, key.low), key.high)
            change[path] = round(new) if key.kind == "integer" else float(f"{new:.4g}")
    return changed(design.content, change)


def shop(rng: random.Random) -> str:
    """A shop with some of the tools and plates of the one that ``mechwright shop`` writes."""
    from typer.testing import CliRunner

    from mechwright.cli.app import make_app

    whole = CliRunner().invoke(make_app(), ["shop"]).stdout
    head, *tools = whole.split("[[tool]]")
    last = tools[-1].partition("\n[") if tools else ("", "", "")
    tools[-1] = last[0] + "\n"
    kept = [tool for tool in tools if rng.random() < 0.7] or tools[:1]
    sizes = rng.sample([3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0], rng.randint(1, 6))
    plates = f'\n[[stock]]\nmaterial = "aluminium"\nthickness = {sorted(sizes)}\n'
    rest = (last[1] + last[2]).split("[[stock]]")[0]
    return head + "".join(f"[[tool]]{tool}" for tool in kept) + rest + plates


def judged(case: Case, *, stages: bool) -> Verdicts:
    """What check says of a case, and what becomes of it."""
    found = Verdicts(case.what)
    with tempfile.TemporaryDirectory() as folder:
        path = case.path
        if case.shop:
            path = Path(folder) / "design.toml"
            (Path(folder) / "shop.toml").write_text(case.shop)

        def fresh(command: str = "build") -> Mechanism:
            design = design_of(case.content, path, "", host())
            return Mechanism(design, host()).asked(command=command)

        def take(who: str, ask: Callable[[], list[str]]) -> None:
            begun = time.perf_counter()
            try:
                found.said[who] = ask()
            except RefusedError as error:
                found.said[who] = codes(error.findings)
            except MechwrightError as error:
                found.said[who] = ["build.refused"] if who != "check" else None
                found.broken += [f"{who} raises {error}"] if who == "check" else []
            found.seconds[who] = time.perf_counter() - begun

        try:
            fresh()
        except MechwrightError as error:  # every command says the same of it, before any work
            found.said = {"check": None, "check --to output": None}
            found.what += f" (no design: {str(error)[:80]})"
            return found
        take("check", lambda: codes(fresh().check()))
        for command, work in WORK.items():
            if stages or work.stage is Stage.OUTPUT:
                who = f"check --to {work.stage}"
                take(who, lambda stage=work.stage: codes(fresh().check(to=stage)))
                take(command, lambda name=command: written(fresh(name), Path(folder) / name))
                compare(found, who, command)
        if found.said["check"] and set(found.said["check"]) - set(found.said["build"] or ["build.refused"]):
            found.broken.append(f"check {found.said['check']}, build {found.said['build']}")
    return found


def written(mechanism: Mechanism, folder: Path) -> list[str]:
    mechanism.write(folder)
    return []


def compare(found: Verdicts, who: str, command: str) -> None:
    said, done = found.said[who], found.said[command]
    if said == [] and done != []:
        found.broken.append(f"{who} allows it, {command} says {done}")
    if command == "build" and said and set(said) != set(done or ()):
        found.broken.append(f"{who} {said}, {command} {done}")


def codes(findings: Any) -> list[str]:
    return sorted({one.code for one in errors(findings)})


if __name__ == "__main__":
    sys.exit(main())
