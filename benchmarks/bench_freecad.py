"""Against FreeCAD's own planner, same outline and cutter: ``python benchmarks/bench_freecad.py``.

An elliptic gear of 41 teeth with a pocket, its rim once as a polyline of 2,000 points and once as the
B-splines of our STEP file, cut with a mill of 2 mm. FreeCAD 0.20 (Debian's ``freecad-python3``) plans a
profile and a pocket in rings, the rest as it comes: one path each, at full depth. Ours is the plan of the
part with all its operations, at full depth, without allowance and spring pass, as FreeCAD has neither;
roughing, bore, clamp and leads are in it. Times are of the processor, and leave out both programs' start,
FreeCAD's import of the model, and our choice of cutters. FreeCAD is run as a program; nothing of it is used
here.

Gouge and leftover are measured alike on both, from the cutter's centre path against the outline as it was
given: how much nearer than the radius the path comes to the wall, and how far from the path's reach the
wall stays where the cutter could have touched it. The targets are those of the rim; straight walls with
round corners are no trouble to either.

Ours is planned twice: as it comes, which is as exact as our outlines and takes more arcs than FreeCAD, and
with a table [cam.path] that gives walls 4 um to either side and prefers lines. That one has to keep all the
targets at once: the time, a fifth of gouge and leftover, and no more arcs per millimetre. It has more moves
than FreeCAD, as any path has that is so exact: how many at least, and how near ours comes to the fewest, is
shown by a bound that any path keeps (``least_moves.py``). In the band of FreeCAD's path our fit has to
have no more of either, and no preference for lines.
"""

import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

import numpy as np
import shapely
from harness import require
from least_moves import least_moves

from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.designs.design import load
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright.plugins.host import host
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.controls.reading.run import Kind
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import OPERATION_COMMENT
from mechwright_cam.proof import prove
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.settings import CamSettings
from mechwright_elliptic_gears.parts.gear import outline_of
from mechwright_plane.arcfit import fit
from mechwright_plane.offsets import grow
from mechwright_plane.reach import closing

EXAMPLE = Path(__file__).parents[1] / "examples" / "elliptic-pair.toml"
CHILD = Path(__file__).with_name("freecad_job.py")
POINTS = 2000
THICKNESS, DEPTH, MILL = 4.0, 2.0, "mill-2"
STEP_DOWN = 3.0
"""Diameters: full depth in one pass."""
STEP_OVER = 40
"""Percent of the diameter, the same for both."""
SAGITTA = 1e-4
"""Chord error of arcs and walls when distances are taken, mm: a fiftieth of the gouge our proof lets pass."""
AS_IT_COMES, FEW_ARCS = "Mechwright", "  few arcs"
PATHS = {
    AS_IT_COMES: {},
    FEW_ARCS: {"inner_tolerance": 0.004, "outer_tolerance": 0.004, "lines_per_arc": 3},
}
"""Tables [cam.path]."""
OURS = 3
"""Runs of ours for one of FreeCAD's, which takes half a minute on the polyline."""
FINEST = 1e-4
"""Gouge that measuring does not tell from none, mm."""
NEARLY = 1.3
"""How near to the bound, which no path reaches: its pieces do not even meet, and skip the corners."""
LEVEL = 1e-4
"""A move this near to a floor runs on it, mm; FreeCAD stays a millionth above."""


@dataclass(frozen=True)
class Cuts:
    """A cutter's centre path: polylines, the number of its arcs and of all its moves, and its length, mm."""

    lines: shapely.Geometry
    arcs: int
    moves: int
    length: float


def rounded_box(width, height, radius, x, y):
    """A recess with round corners about a point."""
    a, b, quarter = width / 2 - radius, height / 2 - radius, math.pi / 2
    corners = [((a, -b), -1), ((a, b), 0), ((-a, b), 1), ((-a, -b), 2)]
    arcs = [Arc((x + cx, y + cy), radius, turn * quarter, quarter) for (cx, cy), turn in corners]
    sides = [Line(arc.end, arcs[(i + 1) % 4].start) for i, arc in enumerate(arcs)]
    return Loop(tuple(segment for pair in zip(arcs, sides, strict=True) for segment in pair))


def gear_part(rim):
    """The plate: rim, bore at the axis, and a recess in the other half."""
    x0, _, x1, _ = Outline(rim).bounds
    middle = (x0 + x1) / 2
    recess = rounded_box(24.0, 30.0, 4.0, middle + (10.0 if middle > 0 else -10.0), 0.0)
    hole = Loop((circle((0.0, 0.0), 6.0, clockwise=True),))
    machined = (
        Bore("bore", (0.0, 0.0), 12.0, 0.0, THICKNESS),
        Pocket("recess", recess, (), 0.0, DEPTH),
        Profile("outside", rim, "outside", 0.0, THICKNESS),
    )
    return Part("gear", Outline(rim, (hole,)), THICKNESS, "aluminium", machined=machined)


def bulged(start, centre, sweep, end):
    """Points of an arc, without its start."""
    radius = math.hypot(start[0] - centre[0], start[1] - centre[1])
    count = max(2, math.ceil(abs(sweep) / math.acos(max(-1.0, 1 - SAGITTA / max(radius, SAGITTA)))))
    first = math.atan2(start[1] - centre[1], start[0] - centre[0])
    angle = first + sweep * np.arange(1, count + 1) / count
    points = np.column_stack((centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)))
    points[-1] = end
    return points


def cuts_of(rows, kept):
    """Of rows (kind, start, end, centre, sweep) the cuts that are ``kept``, as one centre path."""
    pieces, arcs, moves, length = [], 0, 0, 0.0
    for number, (is_arc, start, end, centre, sweep) in enumerate(rows):
        if not kept(number):
            continue
        moves += 1
        arcs += is_arc
        points = bulged(start, centre, sweep, end) if is_arc else np.array([end])
        points = np.vstack((start, points))
        length += float(np.hypot(*np.diff(points, axis=0).T).sum())
        pieces.append(points)
    return Cuts(shapely.multilinestrings([shapely.linestrings(p) for p in pieces]), arcs, moves, length)


def ours(part, settings, tools):
    """Seconds of the plan, and the cuts of the last pass along each wall, read back from the program."""
    job = make_job(part, settings, tools)
    start = time.process_time()
    program = plan(job)
    seconds = time.process_time() - start
    control = LinuxCnc()
    text = control.write(program)
    proof = prove(text, job, control)
    if not proof.ok:
        sys.exit(f"our own proof fails: {proof.failures[0].message}")
    run = control.read(text)
    named = [r for r in run.remarks if r.text.startswith(OPERATION_COMMENT)]
    cuts = {}
    for feature, wall, bottom in (("outside", "profile", job.floor), ("recess", "pocket", -DEPTH)):
        steps = set()
        for remark, after in zip(named, [*(r.step for r in named[1:]), len(run)], strict=False):
            name = remark.text.removeprefix(OPERATION_COMMENT)
            last = after if isinstance(after, int) else after.step
            # The wall of the rim is what the finishing pass leaves; a floor is what all passes leave.
            if name.startswith(feature) and (feature == "recess" or name.endswith("finish")):
                steps |= set(range(remark.step, last))
        rows = [
            (bool(run.kind[s] == Kind.ARC), run.start[s, :2], run.end[s, :2], run.centre[s], run.sweep[s])
            for s in range(len(run))
        ]
        deep = np.abs(run.end[:, 2] - bottom) < 1e-6
        deep &= np.abs(run.start[:, 2] - bottom) < 1e-6
        cutting = np.isin(run.kind, (Kind.FEED, Kind.ARC))
        cuts[wall] = cuts_of(rows, lambda s, of=steps, low=deep & cutting: s in of and bool(low[s]))
    return seconds, cuts


def theirs(case, folder):
    """Seconds of both operations, and their cuts."""
    (folder / "case.json").write_text(json.dumps({**case, "answer": str(folder / "answer.json")}))
    done = subprocess.run(
        [FREECAD, str(CHILD)],
        env={**os.environ, "FREECAD_JOB": str(folder / "case.json"), "HOME": str(folder)},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    if not (folder / "answer.json").exists():
        sys.exit(f"FreeCAD gave no answer:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    answer = json.loads((folder / "answer.json").read_text())
    (folder / "answer.json").unlink()
    seconds = sum(answer[name]["seconds"] for name in ("profile", "pocket"))
    bottoms = {"profile": 0.0, "pocket": THICKNESS - DEPTH}
    cuts = {name: freecad_cuts(answer[name]["commands"], bottoms[name]) for name in bottoms}
    return seconds, cuts


def freecad_cuts(commands, bottom):
    place, rows, deep = np.zeros(3), [], []
    for name, words in commands:
        end = np.array([words.get(axis, value) for axis, value in zip("XYZ", place, strict=True)])
        kind = name.lstrip("G").lstrip("0") or "0"
        if name.startswith("G") and kind in {"1", "2", "3"}:
            centre, sweep = None, 0.0
            if kind != "1":
                centre = place[:2] + np.array((words.get("I", 0.0), words.get("J", 0.0)))
                a, b = (math.atan2(*(point[:2] - centre)[::-1]) for point in (place, end))
                way = 1 if kind == "3" else -1
                sweep = way * (((b - a) * way) % math.tau or math.tau)
            rows.append((kind != "1", place[:2].copy(), end[:2], centre, sweep))
            deep.append(
                max(abs(place[2] - bottom), abs(end[2] - bottom)) < LEVEL
                and not np.allclose(place[:2], end[:2])
            )
        if name in {"G0", "G00", "G1", "G01", "G2", "G02", "G3", "G03"}:
            place = end
    return cuts_of(rows, lambda number: deep[number])


def measured(cuts, keep, wall, radius):
    """Gouge and reachable leftover of a centre path, mm."""
    points = shapely.points(shapely.get_coordinates(shapely.segmentize(cuts.lines, 0.02)))
    shapely.prepare(keep)
    near = shapely.distance(points, keep)
    inside = shapely.contains(keep, points)
    nearest = np.where(inside, -shapely.distance(points, shapely.boundary(keep)), near)
    touched = closing(keep, radius)
    on = shapely.get_coordinates(
        shapely.intersection(shapely.boundary(touched), shapely.buffer(wall, radius))
    )
    tree = shapely.STRtree(edges(cuts.lines))
    _, far = tree.query_nearest(shapely.points(on), return_distance=True, all_matches=False)
    return max(0.0, radius - float(nearest.min())), max(0.0, float(far.max()) - radius)


def fitted(rim, radius, tolerance):
    """Arcs and moves per mm of our fit of the path around a rim."""
    path = fit(shapely.get_coordinates(grow(rim, radius).exterior), tolerance)
    return sum(1 for cut in path.cuts if cut.turn) / path.length, len(path.cuts) / path.length


def edges(lines):
    found = []
    for part in shapely.get_parts(lines):
        points = shapely.get_coordinates(part)
        found.append(shapely.linestrings(np.stack((points[:-1], points[1:]), axis=1)))
    return np.concatenate(found)


def compared(title, part, case, tool, folder, rounds):
    """Print both, and say whether the targets are kept."""
    rim = shapely.Polygon(part.outline.outer.flatten(SAGITTA))
    recess = shapely.Polygon(part.machined[1].boundary.flatten(SAGITTA))
    frame = shapely.box(*shapely.buffer(rim, 20.0).bounds).difference(recess)
    keeps = {"profile": rim, "pocket": frame}
    walls = {"profile": rim.exterior, "pocket": recess.exterior}
    tools = [tool]
    held = {"method": "bore", "clamp_diameter": 8, "clamp_height": 8}
    plain = {"hold": held, "stock_to_leave": 0, "spring_passes": 0}
    wanted = {name: CamSettings.model_validate({**plain, "path": path}) for name, path in PATHS.items()}
    runs = {"FreeCAD": [], **{name: [] for name in PATHS}}
    ours(part, wanted[AS_IT_COMES], tools)  # imports and compiled code
    for _ in range(rounds):
        runs["FreeCAD"].append(theirs(case, folder))
        for name, settings in wanted.items():
            runs[name] += [ours(replace(part), settings, tools) for _ in range(OURS)]
    print(f"\n{title}, mill of {tool.diameter:g} mm")
    titles = f"{'gouge':>9}{'leftover':>10}{'arcs':>7}{'moves':>7}{'arcs/mm':>9}{'moves/mm':>10}"
    print(f"  {'planning':>24}   {'':<8}{titles}")
    found = {}
    for name, done in runs.items():
        seconds, cuts = median(s for s, _ in done), done[-1][1]
        worst = {}
        for wall in ("profile", "pocket"):
            gouge, left = measured(cuts[wall], keeps[wall], walls[wall], tool.radius)
            dense = cuts[wall].arcs / cuts[wall].length
            moves = cuts[wall].moves / cuts[wall].length
            first = f"{name:<12}{1e3 * seconds:9.0f} ms" if wall == "profile" else f"{'':<24}"
            print(
                f"  {first}   {wall:<8}{1e3 * gouge:6.1f} um{1e3 * left:7.1f} um"
                f"{cuts[wall].arcs:7d}{cuts[wall].moves:7d}{dense:9.3f}{moves:10.3f}"
            )
            worst[wall] = (gouge, left, dense, moves)
        found[name] = seconds, worst
    slow, other = found.pop("FreeCAD")
    (gouge, left, arcs, moves), mine = other["profile"], found[AS_IT_COMES][1]["profile"]
    band = gouge + left
    alike = fitted(part.outline.polygon(), tool.radius, band / 2)
    print(
        f"  in FreeCAD's band of {1e3 * band:.0f} um ours has {alike[0]:.3f} arcs and {alike[1]:.3f} moves/mm"
    )
    # Counter-clockwise, so that the wall is on the left.
    ring = shapely.orient_polygons(grow(rim, tool.radius, SAGITTA / 10)).exterior
    fifth, finest = (
        least_moves(ring, inside, outside) / ring.length
        for inside, outside in ((gouge / 5, left / 5), (max(mine[0], FINEST), mine[1]))
    )
    print(f"  at a fifth of FreeCAD's gouge and leftover any path has {fifth:.3f} moves/mm at least")
    print(f"  where ours stays, any path has {finest:.3f} moves/mm at least\n")
    kept = []
    for name, (fast, own) in found.items():
        said, (cut, stays, dense, _) = name.strip(), own["profile"]
        kept += [
            require(f"{said}: time, as a part of FreeCAD's", fast / slow, 0.1),
            require(f"{said}: gouge, as a part of FreeCAD's", cut / gouge, 0.2),
            require(f"{said}: leftover, as a part of FreeCAD's", stays / left, 0.2),
        ]
        if name == FEW_ARCS:
            kept.append(require(f"{said}: arcs per mm, to FreeCAD's", dense / arcs, 1.0))
    return [
        *kept,
        require("arcs per mm at one accuracy, to FreeCAD's", alike[0] / arcs, 1.0),
        require("moves per mm at one accuracy, to FreeCAD's", alike[1] / moves, 1.0),
        require("moves per mm, to the fewest of any path as exact", mine[3] / finest, NEARLY),
    ]


FREECAD = shutil.which("freecadcmd") or shutil.which("FreeCADCmd")


def main():
    if FREECAD is None:
        print("skipped: FreeCAD is not installed (Debian package freecad-python3)")
        return 0
    design = load(EXAMPLE, host())
    rim = outline_of(design.family.Params(teeth=41, module=2, eccentricity=0.4)).outer
    fine = shapely.LineString(rim.flatten(1e-5))
    points = shapely.get_coordinates(fine.interpolate(np.arange(POINTS) / POINTS, normalized=True))
    tool = load_library().get(MILL)
    data = tool.cutting["aluminium"].model_copy(update={"step_over": STEP_OVER / 100, "step_down": STEP_DOWN})
    tool = tool.model_copy(update={"cutting": {"aluminium": data}})
    kept = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        case = {
            "thickness": THICKNESS,
            "pocket_depth": DEPTH,
            "diameter": tool.diameter,
            "step_over": STEP_OVER,
        }
        polyline = gear_part(Loop.polygon(points))
        pocket = polyline.machined[1].boundary.flatten(1e-3)[:-1].tolist()
        corners = {"step": None, "points": points.tolist(), "pocket": pocket}
        kept += compared("polyline of 2,000 points", polyline, {**case, **corners}, tool, folder, 1)
        splines = gear_part(rim)
        from mechwright_cad.exporters import step

        (folder / "gear.step").write_bytes(step.part(splines))
        file = {"step": str(folder / "gear.step"), "points": None, "pocket": None}
        kept += compared("B-splines of our STEP file", splines, {**case, **file}, tool, folder, 3)
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
