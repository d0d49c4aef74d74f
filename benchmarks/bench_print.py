"""The first example of every family printed, read back, sliced and put together. A table.

    python benchmarks/bench_print.py [--bed MM] [EXAMPLE ...]

Each example is printed with the usual figures of printers on a square bed. Then

- trimesh reads the plates, where it is installed: every object is closed and runs one way;
- PrusaSlicer slices them without repair, where it is installed, and weighs the filament;
- 50 places and more of each part's walls are looked for on its mesh;
- the meshes of the print stand in their places with rods and bought parts, at five poses. No two overlap, but
  where something is pressed, reamed, tapped or screwed; each hole has the play that was asked about its pin.
"""

import argparse
import csv
import io
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import manifold3d
import numpy as np
import shapely
import tomlkit

from mechwright.contracts.bodies import Placed, placed
from mechwright.errors import GeometryError
from mechwright.mechanics.mating.choice import Assembled
from mechwright.mechanics.mating.rounds import Match
from mechwright.pipeline import Build
from mechwright.plugins.host import host
from mechwright.testing import commands
from mechwright_cad.exporters.mesh import part_mesh
from mechwright_cad.solids.tessellate import Mesh
from mechwright_print.job.print_job import PrintJob
from mechwright_print.meshes.stacked import manifold_of, stacked
from mechwright_print.printer.settings import Printer

EXAMPLES = {
    "elliptic-gears": "elliptic-pair",
    "noncircular-gears": "noncircular-lobes",
    "spur-gears": "spur-gears",
    "cam-follower": "cam-lever",
    "geneva": "geneva-straight",
    "slider-crank": "slider-crank-quick-return",
    "four-bar": "four-bar-double-rocker",
    "five-bar": "five-bar-published",
    "linkage": "linkages/crank-shaper",
    "spherical": "spherical-crank-rocker",
    "plate": "nema-17-plate",
}
"""Family to its example."""
COLUMNS = (
    "example", "parts", "beds", "read back", "g", "sliced, g", "difference", "walls off, mm", "joints",
    "play off, mm", "overlaps", "time",
)  # fmt: skip
"""Of the table."""
PLACES = 50
"""Of a part's walls, at least."""
POSES = 5
SPECK = 0.2
"""An overlap of less volume is none, mm³: chords of two walls that touch."""
FINISHED = {"press", "ream", "bush", "insert", "tap", "screw"}
"""Holes that something is driven or screwed into."""


@dataclass(frozen=True)
class Printed:
    """What became of an example."""

    parts: int
    beds: int
    read: str
    ours: float
    sliced: float | None
    joints: int
    play_error: float
    walls_off: float
    overlaps: tuple[str, ...]
    seconds: float

    @property
    def row(self) -> str:
        """Of the table."""
        mass = "" if self.sliced is None else f"{100 * (self.ours / self.sliced - 1):+.1f} %"
        apart = ", ".join(self.overlaps) or "none"
        sliced = "" if self.sliced is None else f"{self.sliced:.1f}"
        return (
            f"{self.parts} | {self.beds} | {self.read} | {self.ours:.1f} | {sliced} | {mass} | "
            f"{self.walls_off:.4f} | {self.joints} | {self.play_error:.3f} | {apart}"
        )


def printed(example: Path, folder: Path, bed: float) -> Printed:
    """Print an example into a folder; raises RuntimeError where it cannot be."""
    began = time.perf_counter()
    design = with_printer(example, folder, bed)
    out = folder / "out"
    done = commands.run("print", design, "-o", out)
    if done.returncode:
        raise RuntimeError(done.stderr.strip())
    with Build(design, host()) as build:
        joints, error, overlaps = assembled(build)
        walls_off = off_model(build.made(PrintJob))
    rows = list(csv.DictReader(io.StringIO((out / "print-bill.csv").read_text())))
    plates = sorted(out.glob("plate-*.3mf"))
    return Printed(
        sum(int(row["qty"]) for row in rows if row["kind"] == "printed"),
        len(plates),
        read_back(plates),
        float(rows[0]["mass_g"]),
        sliced_mass(plates, folder, bed),
        joints,
        error,
        walls_off,
        tuple(overlaps),
        time.perf_counter() - began,
    )


def with_printer(example: Path, folder: Path, bed: float) -> Path:
    """A copy of the example, all that lies beside it along, with a printer of that bed."""
    for beside in example.parent.iterdir():
        if beside.is_file() and beside.suffix != ".toml":
            shutil.copy(beside, folder)
    (folder / "printer.toml").write_text(f"[bed]\nx = {bed:g}\ny = {bed:g}\n")
    content = tomlkit.parse(example.read_text())
    content["print"] = {"printer": "printer.toml"}
    path = folder / example.name
    path.write_text(tomlkit.dumps(content))
    return path


def read_back(plates: list[Path]) -> str:
    """What trimesh says of the plates: ``closed``, else what is not."""
    try:
        import trimesh
    except ImportError:
        return "no reader"
    for plate in plates:
        for name, mesh in trimesh.load(plate).geometry.items():
            if not (mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0):
                return f"{name} is open"
    return "closed"


def sliced_mass(plates: list[Path], folder: Path, bed: float) -> float | None:
    """Filament by PrusaSlicer, g; None without it. Raises RuntimeError where it repairs or refuses."""
    if shutil.which("prusa-slicer") is None:
        return None
    printer, total = Printer(), 0.0
    line = printer.line_width
    settings = {
        "filament-density": 1000 * printer.grams_per_mm3,
        "perimeters": 4,
        "top-solid-layers": 5,
        "bottom-solid-layers": 5,
        "fill-density": "30%",
        "layer-height": printer.layer,
        "first-layer-height": printer.first,
        "nozzle-diameter": printer.nozzle,
        "extrusion-width": line,
        "perimeter-extrusion-width": line,
        "external-perimeter-extrusion-width": line,
        "elefant-foot-compensation": 0,
        "skirts": 0,
        "bed-shape": f"0x0,{bed:g}x0,{bed:g}x{bed:g},0x{bed:g}",
    }
    options = [word for key, value in settings.items() for word in (f"--{key}", str(value))]
    for plate in plates:
        program = folder / f"{plate.stem}.gcode"
        command = ["prusa-slicer", "--export-gcode", "--dont-arrange", *options, "--output", program, plate]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
        info = subprocess.run(["prusa-slicer", "--info", plate], capture_output=True, text=True, check=True)
        said = done.stdout + done.stderr
        if done.returncode or re.search("repair|error", said, re.IGNORECASE):
            raise RuntimeError(said.strip()[-400:])
        if set(re.findall(r"manifold = (\w+)", info.stdout)) != {"yes"}:
            raise RuntimeError(f"{plate.name} is not manifold")
        found = re.search(r"total filament used \[g\] = ([\d.]+)", program.read_text())
        total += float(found[1]) if found else 0.0
    return total


def off_model(job: PrintJob) -> float:
    """How far the walls of the meshes are off their places at most, mm."""
    worst = 0.0
    for one in job.parts:
        outline = one.made.model.outline
        if outline is None:
            continue
        height = max(0.2 * one.part.thickness, 1.5 * job.printer.first)
        height = one.part.thickness - height if one.on_top else height
        rings = manifold_of(job.meshes[one.part.name].in_part).slice(height).to_polygons()
        walls = shapely.union_all([shapely.LinearRing(ring) for ring in rings])
        segments = [segment for loop in outline.loops for segment in loop.segments]
        share = np.linspace(0.0, 1.0, max(3, -(-PLACES // len(segments))))
        there = np.concatenate([segment.at(share) for segment in segments])
        worst = max(worst, float(shapely.distance(walls, shapely.points(there)).max()))
    return worst


def assembled(build: Build) -> tuple[int, float, list[str]]:
    """Joints that were looked at, the greatest error of their play, mm, and pairs that overlap.

    The files' own meshes overlap nowhere, and neither do the parts in the sizes in which they come out.
    """
    job = build.made(PrintJob)
    motion = build.design.solve(POSES)
    bodies = placed(build.parts, motion)
    as_filed = {one.part.name: job.meshes[one.part.name].in_part for one in job.parts}
    as_made = dict(made_meshes(job))
    others = {body.part.name: mesh for body in bodies if (mesh := other_mesh(body, as_made)) is not None}
    whole = Assembled(bodies, motion)
    kinds = {(hole.part, hole.name): hole for one in job.parts for hole in one.made.holes}
    joints, worst, driven = 0, 0.0, set()
    for match in whole.matches:
        hole = kinds.get((bodies[match.hole].part.name, match.inside.face))
        if hole is None:
            continue
        if hole.kind in FINISHED or hole.target < match.outside.diameter:
            driven.add(frozenset((match.pin, match.hole)))
        body = bodies[match.hole]
        across = bore_width(match, stand(as_made[body.part.name], body, 0))
        if across is not None:
            joints, worst = joints + 1, max(worst, abs(across - hole.target))
    overlaps = []
    for meshes in (as_filed, as_made):
        overlaps += list(overlapping({**others, **meshes}, bodies, set(meshes), driven))
    return joints, worst, sorted(set(overlaps))


def made_meshes(job: PrintJob) -> Iterator[tuple[str, Mesh]]:
    """Parts in the sizes in which they come out of a printer that does what its file says."""
    for one in job.parts:
        plate = one.made.printed.outline is not None
        mesh = stacked(one.made.printed, 0.0, 0.0, on_top=False) if plate else part_mesh(one.made.printed)
        yield one.part.name, mesh


def other_mesh(body: Placed, known: dict[str, Mesh]) -> Mesh | None:
    """The mesh of a rod or of a bought part; None of a printed one, or where the kernel has none."""
    if body.part.name in known:
        return None
    try:
        return part_mesh(body.part)
    except GeometryError:
        return None


def stand(mesh: Mesh, body: Placed, sample: int) -> manifold3d.Manifold:
    """A mesh of a part where its copy stands."""
    turn, place = body.poses.rotation[sample], body.poses.position[sample]
    there = (mesh.points + np.array([0.0, 0.0, body.instance.z])) @ turn.T + place
    return manifold_of(Mesh(there, mesh.triangles))


def bore_width(match: Match, body: manifold3d.Manifold) -> float | None:
    """Diameter of a hole of a mesh across its axis, mm, in the middle of what the pin takes of it."""
    axis = match.inside.axis
    side = np.linalg.svd(axis[None, :])[2][1:]
    frame = np.vstack((side, axis))
    if np.linalg.det(frame) < 0:
        frame[0] *= -1
    there = frame @ match.inside.at
    turned = body.transform(np.column_stack((frame, -there)))
    low, high = match.inside.low, match.inside.high
    rings = [shapely.LinearRing(ring) for ring in turned.slice((low + high) / 2).to_polygons()]
    if not rings:
        return None
    return 2 * min(float(ring.distance(shapely.Point(0, 0))) for ring in rings)


def overlapping(
    meshes: dict[str, Mesh], bodies: list[Placed], mine: set[str], driven: set[frozenset[int]]
) -> Iterator[str]:
    """Pairs with a printed part that overlap at a pose, but those that are driven together."""
    for sample in range(POSES):
        solids = {
            k: stand(meshes[one.part.name], one, sample)
            for k, one in enumerate(bodies)
            if one.part.name in meshes
        }
        for a, b in combinations(solids, 2):
            names = (bodies[a].part.name, bodies[b].part.name)
            if not mine & set(names) or frozenset((a, b)) in driven:
                continue
            common = (solids[a] ^ solids[b]).volume()
            if common > SPECK:
                yield f"{names[0]} in {names[1]}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("examples", nargs="*", help="paths below examples without ending; default: all")
    parser.add_argument("--bed", type=float, default=256.0, metavar="MM", help="side of the bed")
    given = parser.parse_args()
    root = Path(__file__).parents[1] / "examples"
    print(" | ".join(COLUMNS))
    for name in given.examples or EXAMPLES.values():
        with tempfile.TemporaryDirectory() as folder:
            try:
                found = printed(root / f"{name}.toml", Path(folder), given.bed)
            except RuntimeError as error:
                print(f"{name} | {error}", flush=True)
                continue
        print(f"{name} | {found.row} | {found.seconds:.0f} s", flush=True)


if __name__ == "__main__":
    sys.exit(main())
