"""Can each desktop machine make three mechanisms of six materials? A table, and what stands in the way.

    python benchmarks/bench_makers.py [--into FOLDER] [--table] [MACHINE ...]

For each machine and material one command writes the shop, with three mills and a sheet of 6 mm as large as
the machine travels, at most 300 x 200 mm. Three designs are made of it by ``new``, with no further key but
the number of slots: a Geneva wheel with six, a pair of elliptic gears, a four-bar linkage. ``cam``
then writes and proves their programs.

A case is a yes if all its plates lie on one sheet in hand and every program is proven. Else its code, its
message and its remedy stand there. FOLDER keeps the programs, and a line for each case in ``cases.jsonl``:
what is there is not done again. ``--table`` prints the table of these lines and does nothing else.

Everything runs in one process, and a program that ``new`` has proven is not planned again for ``cam``.
"""

import argparse
import contextlib
import json
import os
import pickle
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import mechwright_cam.machining
from mechwright.testing import commands
from mechwright_cam.shop.machine import known_machines

MATERIALS = ("acrylic", "plywood", "aluminium", "mdf", "pom", "hdpe")
DESIGNS = {"geneva": ("--set", "slots=6"), "elliptic-gears": (), "four-bar": ()}
MOST = (300.0, 200.0)
"""Length and width of the largest sheet, mm."""
MARGIN = 10.0
"""So much smaller than the travel is the sheet, mm."""
CASES = "cases.jsonl"


@dataclass(frozen=True)
class Case:
    """What became of a design: ``yes``, or the code of what refuses it, with the words."""

    machine: str
    rigidity: str
    homing: str
    material: str
    design: str
    answer: str
    words: str
    programs: int
    seconds: float


def by_name() -> dict[str, tuple[dict[str, Any], Any]]:
    """The desktop machines, without their other names."""
    found: dict[int, tuple[str, Any]] = {}
    for name, (row, preset) in known_machines().items():
        if "rigidity" in row and "haas" not in name:
            found.setdefault(id(row), (name, (row, preset)))
    return dict(found.values())


def programs_once() -> None:
    """Let a program that was planned and proven once be taken again for the same job."""
    done: dict[bytes, Any] = {}
    make = mechwright_cam.machining.machine

    def machine(job: Any, control: Any, *more: Any) -> Any:
        key = pickle.dumps((job, control.name, more))
        if key not in done:
            done.clear()
            done[key] = make(job, control, *more)
        return done[key]

    mechwright_cam.machining.machine = machine  # type: ignore[assignment]


def case(name: str, row: dict[str, Any], material: str, design: str, folder: Path) -> Case:
    """One design of one sheet on one machine; the shop lies in the folder."""
    began = time.monotonic()

    def ended(answer: str, words: str = "", programs: int = 0) -> Case:
        homing, seconds = row.get("homing", "switches"), round(time.monotonic() - began, 1)
        return Case(name, row["rigidity"], homing, material, design, answer, words, programs, seconds)

    file, out = f"{design}.toml", folder / design
    made = commands.run("new", design, *DESIGNS[design], "--shop", "shop.toml", "-o", file, "--force")
    if made.returncode:
        return ended("new", made.stderr.strip())
    lines = made.stdout.splitlines()
    if left := [line for line in lines if line.startswith("not solved")]:
        return ended(left[0].partition("[")[2].partition("]")[0], " / ".join(left))
    if "leave out cam.nest" in lines:
        return ended("no nest", " / ".join(lines))
    written = commands.run("cam", file, "-o", str(out))
    if written.returncode:
        return ended("cam", written.stderr.strip())
    if "shop.stock" in written.stderr:
        return ended("shop.stock", written.stderr.strip())
    proofs = json.loads((out / "proof.json").read_text())
    return ended("yes", programs=len(proofs.get("parts", proofs)))


def cases(names: list[str], into: Path, before: list[Case]) -> Iterator[Case]:
    """Each case that is not among those before, material by material."""
    machines, known = by_name(), {(one.machine, one.material, one.design) for one in before}
    for material in MATERIALS:
        for name in names or machines:
            row, preset = machines[name]
            todo = [design for design in DESIGNS if (name, material, design) not in known]
            folder = into / name / material
            if not todo:
                continue
            folder.mkdir(parents=True, exist_ok=True)
            x, y = (min(row[f"travel_{axis}"] - MARGIN, most) for axis, most in zip("xy", MOST, strict=True))
            spindle = ["--spindle", "10000-30000"] if "spindle" in preset.unknown else []
            words = ["--machine", name, "--mills", "3.175,2,1", *spindle]
            with contextlib.chdir(folder):
                shop = commands.run(
                    "shop", *words, "--sheet", f"{x:g}x{y:g}x6 {material}", "-o", "shop.toml", "--force"
                )
                for design in todo:
                    if shop.returncode:
                        home = row.get("homing", "switches")
                        said = shop.stderr.strip()
                        yield Case(name, row["rigidity"], home, material, design, "shop", said, 0, 0.0)
                    else:
                        yield case(name, row, material, design, Path(os.curdir))


def table(found: list[Case]) -> Iterator[str]:
    """A row for each machine: for each material the answers of the three designs."""
    yield f"| machine | class | {' | '.join(MATERIALS)} |"
    yield f"| --- | --- | {' | '.join('---' for _ in MATERIALS)} |"
    answers = {(one.machine, one.material, one.design): one for one in found}
    for name, (row, _) in by_name().items():
        cells = []
        for material in MATERIALS:
            mine = [answers.get((name, material, design)) for design in DESIGNS]
            said = ["?" if one is None else one.answer for one in mine]
            cells.append(said[0] if len(set(said)) == 1 else ", ".join(said))
        yield f"| {name} | {row['rigidity']} | {' | '.join(cells)} |"


def main() -> None:
    """Do what is left to do, and print the table."""
    reader = argparse.ArgumentParser(description="Desktop machines, materials and mechanisms.")
    reader.add_argument("--into", type=Path, default=Path("makers"))
    reader.add_argument("--table", action="store_true")
    reader.add_argument("machine", nargs="*")
    said = reader.parse_args()
    said.into.mkdir(parents=True, exist_ok=True)
    kept = said.into / CASES
    found = [Case(**json.loads(line)) for line in kept.read_text().splitlines()] if kept.exists() else []
    if not said.table:
        programs_once()
        with kept.open("a") as out:
            for one in cases(said.machine, said.into, found):
                found.append(one)
                print(json.dumps(asdict(one)), file=out, flush=True)
                print(
                    f"{one.machine:20} {one.material:10} {one.design:15} {one.answer} {one.words}", flush=True
                )
    for line in table(found):
        print(line)


if __name__ == "__main__":
    main()
