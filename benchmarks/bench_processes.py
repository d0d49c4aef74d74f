"""The first example of each family by laser, by service and by wire: proven, and assembled as made.

    python benchmarks/bench_processes.py [--into FOLDER] [--service SERVICE] [--material MATERIAL] [CASE ...]

A case is a process and a family, such as ``laser/geneva``. Its design is an example with the material and the
thickness of the process. Changes that the first error proposes are made until none is left, at most ten
times; the row names the keys. Then programs or drawings are made and proven, and the family judges the
mechanism with walls as the programs or drawings leave them. Solids are not compared. FOLDER keeps the files.
SERVICE is one of those whose rules are known; MATERIAL is that of its plates in place of steel.
"""

import argparse
import json
import re
import shutil
import tempfile
import time
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import tomlkit

from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.refused import RefusedError
from mechwright.designs.design import load
from mechwright.errors import MechwrightError
from mechwright.output.folder import write_folder
from mechwright.pipeline import PROGRAMS, Build, Run, Wanted, Work
from mechwright.pipeline.as_made import as_made, produced_plates
from mechwright.pipeline.page import pages_of
from mechwright.plugins.host import host
from mechwright_cut.cutting import Cutting, ProvenCut, written

EXAMPLES = Path(__file__).parents[1] / "examples"
WORK = Work(Stage.OUTPUT, frozenset({PROGRAMS}))
ROUNDS = 10
"""Changes at most."""
ACRYLIC: dict[str, Any] = {"parameters.material": "acrylic"}
STEEL: dict[str, Any] = {"parameters.material": "steel"}
SIX: dict[str, Any] = {
    f"parameters.{key}": 6.0
    for key in ("thickness", "ground_thickness", "follower_thickness", "gear_thickness", "crank_thickness")
}
FAMILIES = {
    "cam-follower": ("cam-lever", SIX),
    "elliptic-gears": ("elliptic-pair", SIX),
    "five-bar": ("five-bar-slots", SIX),
    "four-bar": ("four-bar-double-rocker", SIX),
    "geneva": ("geneva-straight", {**SIX, "parameters.thickness": 4.0}),
    "linkage": ("linkages/hoecken", SIX),
    "noncircular-gears": ("noncircular-lobes", SIX),
    "plate": ("inch-bracket", {"parameters.thickness": "6 mm"}),
    "slider-crank": ("slider-crank-quick-return", SIX),
    "spherical": ("spherical-crank-rocker", SIX),
    "spur-gears": ("spur-gears", SIX),
}
"""Family to its first example, and the plates of a sheet of 6 mm; a locking disc is 2 mm thicker."""
MAKE = re.compile(r"make ([\w.]+) ([0-9.]+)")
"""How some remedies name a key and its value."""
WIRE = ("elliptic-gears", "noncircular-gears", "spur-gears", "geneva", "cam-follower")
PROCESSES: dict[str, tuple[Mapping[str, Any], dict[str, Any], tuple[str, ...]]] = {
    "laser": ({"small_holes": "spot", "sheet": {"length": 900, "width": 600}}, ACRYLIC, tuple(FAMILIES)),
    "service": ({"small_holes": "spot"}, STEEL, tuple(FAMILIES)),
    "wire": ({"passes": 3, "sheet": {"length": 900, "width": 600}}, STEEL, WIRE),
}
"""Process to its table, its material, and the families."""


@dataclass
class Row:
    """What became of a case."""

    case: str
    answer: str = ""
    changes: dict[str, Any] = field(default_factory=dict)
    programs: int = 0
    pieces: int = 0
    metres: float = 0.0
    walls: str = ""
    seconds: float = 0.0


def design_file(process: str, family: str, folder: Path) -> Path:
    """The file of a case: the example with another process, without what was chosen for the mill."""
    name, sizes = FAMILIES[family]
    table, material, _ = PROCESSES[process]
    content = tomllib.loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))
    content = {key: value for key, value in content.items() if key not in ("cam", "machine")}
    content |= {"process": process, "cut": dict(table)}
    path = folder / process / family / "design.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    if "drawing" in content["parameters"]:
        shutil.copy(EXAMPLES / content["parameters"]["drawing"], path.parent)
    path.write_text(tomlkit.dumps(content), encoding="utf-8")
    design = load(path, host())
    fields = type(design.params).model_fields
    change = {key: value for key, value in (material | sizes).items() if key.partition(".")[2] in fields}
    for key, value in change.items():
        content["parameters"][key.partition(".")[2]] = value
    if family == "spherical":
        content["parameters"]["hardware"] = {"material": material["parameters.material"]}
        content["parameters"]["stand"] = {"plate_thickness": 6.0}
    path.write_text(tomlkit.dumps(content), encoding="utf-8")
    return path


def tried(case: str, folder: Path) -> Row:
    """The case, after the changes that its errors propose."""
    process, _, family = case.partition("/")
    row, began = Row(case), time.perf_counter()
    try:
        design = load(design_file(process, family, folder), host())
        for _ in range(ROUNDS + 1):
            with Build(design, host(), Wanted("cut", work=WORK)) as build:
                run = Run(build, WORK)
                try:
                    files = run.make(pages_of(build.host, "cut"))
                except RefusedError:
                    wrong = errors(run.findings)
                    if not (change := _change(wrong)):
                        row.answer = str(wrong[0])
                        break
                    row.changes |= change
                    design = design.changed(change)
                    continue
                row.answer = "yes"
                _count(row, build)
                for one in build.made(Cutting).programs:
                    if one.suffix == ".nc":
                        files.add(f"{one.name}.ngc", written_for(one))
                write_folder(folder / process / family / "out", files, "cut", {})
                break
        else:
            row.answer = f"not after {ROUNDS} changes"
    except MechwrightError as error:
        row.answer = str(error)
    row.seconds = round(time.perf_counter() - began, 1)
    return row


def written_for(item: ProvenCut) -> str:
    """The same sheet for LinuxCNC, proven."""
    text, proof = written(item.job, item.contours, "linuxcnc-beam")
    assert proof.ok, proof.failures
    return text


def _change(wrong: Sequence[Finding]) -> dict[str, Any]:
    """What the first error proposes that proposes anything; empty where none does."""
    for one in wrong:
        if one.proposed:
            return dict(one.proposed[0])
        if said := MAKE.search(one.remedy):
            return {f"parameters.{said[1]}": float(said[2].rstrip("."))}
    return {}


def _count(row: Row, build: Build) -> None:
    """Programs, pieces, metres of the way, and figures as made."""
    cutting = build.made(Cutting)
    row.programs = len(cutting.programs) or len(cutting.ordered)
    row.pieces = sum(len(one.job.pieces) for one in cutting.programs) or sum(
        max(1, len(one.part.instances)) for one in cutting.ordered
    )
    row.metres = round(sum(one.proof.length for one in cutting.programs) / 1000, 2)
    plates, said = build.made(produced_plates), build.made(as_made)
    worst = max((float(abs(part.off).max()) for parts in plates.values() for part in parts), default=0.0)
    judged = f"{len(said.figures)} figures" if said.figures else "not judged"
    if not build.design.family.moves:
        judged = "mates with nothing"
    row.walls = f"{judged}, walls within {1000 * worst:.1f} µm"


def main() -> None:
    """Print a row for each case."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--into", type=Path, help="folder that keeps the files")
    every = [f"{process}/{family}" for process, (_, _, of) in PROCESSES.items() for family in of]
    parser.add_argument("cases", nargs="*", default=every)
    parser.add_argument("--service", default="sendcutsend", help="who cuts in the cases of a service")
    parser.add_argument("--material", default="steel", help="what the plates of a service are made of")
    args = parser.parse_args()
    table, _, families = PROCESSES["service"]
    material = {"parameters.material": args.material}
    PROCESSES["service"] = ({**table, "service": args.service}, material, families)
    with tempfile.TemporaryDirectory() as other:
        for case in args.cases:
            print(json.dumps(asdict(tried(case, args.into or Path(other))), ensure_ascii=False), flush=True)


if __name__ == "__main__":
    main()
