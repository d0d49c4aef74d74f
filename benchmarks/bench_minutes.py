"""Minutes on the mill of every example: ``python benchmarks/bench_minutes.py [--by-tool] [DESIGN ...]``.

Builds programs with their proof and prints a table in Markdown: the estimated seconds of each design, those
in which a tool is fed, and the millimetres fed, with the share of them in air. Without names it takes every
example that has a table ``[cam]``, the default slider-crank, and a gear of 99 teeth of module 2. The exit
code is 1 if a program fails its proof.
"""

import argparse
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

from mechwright.cli.hosting import open_host
from mechwright.errors import MechwrightError
from mechwright.pipeline import Build, Wanted
from mechwright_cam.machining import Machined, Machining

ROOT = Path(__file__).parents[1]
GEAR = """format = 1
family = "elliptic-gears"
name = "teeth-99"

[parameters]
eccentricity = 0
semi_major = 99
teeth = 99
thickness = 10
bore = 12
material = "aluminium"
"""
"""99 teeth of module 2: the pitch circle has a radius of 99 mm."""
SLIDER = 'format = 1\nfamily = "slider-crank"\nname = "slider-crank-default"\n'
"""The parameters that the family has by itself."""


def designs(folder: Path) -> Iterator[Path]:
    """All that is measured; the designs that are no examples are written into the folder."""
    for name, text in (("teeth-99", GEAR), ("slider-crank-default", SLIDER)):
        path = folder / f"{name}.toml"
        path.write_text(text)
        yield path
    for path in sorted((ROOT / "examples").glob("*.toml")):
        if "\n[cam" in path.read_text() and not path.stem.endswith(("-requirement", "-study")):
            yield path


def made(path: Path) -> list[Machined]:
    """The programs of a design with their proofs."""
    with Build(path, open_host(), Wanted("verify")) as build:
        return build.made(Machining).proven_programs


def row(name: str, programs: list[Machined], used: float, by_tool: bool) -> tuple[str, float]:
    """A row of the table, and the seconds on the mill."""
    seconds, fed, cutting, air = 0.0, 0.0, 0.0, 0.0
    tools: defaultdict[str, float] = defaultdict(float)
    for item in programs:
        seconds += item.proof.time_estimate_s
        cutting += sum(item.proof.tool_cutting_s.values())
        fed += item.scene.simulation.feed_mm
        air += item.scene.simulation.air_mm
        names = {tool.number: tool.name for tool in item.job.tools}
        for one in item.proof.operations:
            tools[names.get(one.tool, "start")] += one.time_s
    more = (
        ", ".join(f"{tool} {part:.0f}" for tool, part in sorted(tools.items(), key=lambda item: -item[1]))
        if by_tool
        else ""
    )
    cells = [name, f"{seconds:.0f}", f"{cutting:.0f}", f"{fed:.0f}", f"{100 * air / max(fed, 1):.0f} %"]
    return f"| {' | '.join([*cells, f'{used:.1f}', more])} |", seconds


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    asked.add_argument("designs", nargs="*", type=Path)
    asked.add_argument("--by-tool", action="store_true", help="seconds of each tool besides")
    given = asked.parse_args()
    total, good = 0.0, True
    print("| design | s | fed s | fed mm | in air | planning and proof, CPU s | tools |")
    print("| --- | --- | --- | --- | --- | --- | --- |", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for path in given.designs or designs(Path(folder)):
            begun = time.process_time()
            try:
                programs = made(path)
            except MechwrightError as error:
                print(f"| {path.stem} | FAILED: {error} |", flush=True)
                good = False
                continue
            text, seconds = row(path.stem, programs, time.process_time() - begun, given.by_tool)
            good &= all(item.proof.ok for item in programs)
            total += seconds
            print(text, flush=True)
    print(f"| all | {total:.0f} |")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
