"""Solids and files of a 40-tooth gear: other ways of making them against ours, in one run.

Run it with ``python benchmarks/bench_cad.py``.
"""

import math
import sys
import tempfile
from pathlib import Path

import cadquery as cq
import numpy as np
from harness import race, report, require
from rack_gear import RackGear, outline

from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Instance, Part
from mechwright.geometry import BSpline
from mechwright_cad.exporters import dxf, mesh, step
from mechwright_cad.solids import solid as solids
from mechwright_cad.solids.solid_check import check_plate
from mechwright_cad.solids.wires import extruded

GEAR = RackGear()
THICKNESS = 10.0
POLYLINE = 4000
UP = cq.Vector(0, 0, THICKNESS)


def by_polyline() -> cq.Solid:
    """Some 4,000 straight lines."""
    corners = outline(GEAR).outer.flatten(2.5e-4)
    step_over = max(1, round(len(corners) / POLYLINE))
    wire = cq.Wire.makePolygon([cq.Vector(x, y, 0) for x, y in corners[::step_over]], close=True)
    return cq.Solid.extrudeLinear(wire, [cq.Wire.makeCircle(10, cq.Vector(), cq.Vector(0, 0, 1))], UP)


def by_spline_edges() -> cq.Solid:
    """One spline edge per flank and fillet and exact arcs, assembled and extruded by CadQuery."""
    shape = outline(GEAR)
    edges = []
    for segment in shape.outer.segments:
        if isinstance(segment, BSpline):
            edges.append(cq.Edge.makeBezier([cq.Vector(x, y, 0) for x, y in segment.points]))
        else:
            points = segment.at([0.0, 0.5, 1.0]).tolist()
            edges.append(cq.Edge.makeThreePointArc(*(cq.Vector(x, y, 0) for x, y in points)))
    wire = cq.Wire.assembleEdges(edges)
    return cq.Solid.extrudeLinear(wire, [cq.Wire.makeCircle(10, cq.Vector(), cq.Vector(0, 0, 1))], UP)


def ours_unchecked() -> cq.Solid:
    return extruded(outline(GEAR), THICKNESS)


def cadquery_step(solid: cq.Solid) -> int:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "gear.step"
        cq.exporters.export(cq.Workplane(solid), str(path), opt={"write_pcurves": False})
        return path.stat().st_size


def main() -> int:
    shape = outline(GEAR)
    print(f"40 teeth, m = 2: {sum(len(loop.segments) for loop in shape.loops)} segments, "
          f"{1e3 * shape.deviation:.2f} µm from the exact envelope")  # fmt: skip

    contestants = {
        "polyline": by_polyline,
        "spline edges, CadQuery": by_spline_edges,
        "ours, unchecked": ours_unchecked,
        "ours, with the gate": lambda: solids.plate(outline(GEAR), THICKNESS),
    }
    builds = race(contestants)
    best = "spline edges, CadQuery"
    build = report("curves to solid", builds, best, lambda solid: f"{len(solid.Faces())} faces")
    made = {name: timing.result for name, timing in builds.items() if name != "polyline"}
    ours = made["ours, with the gate"]

    checks = {
        "validity alone": ours.isValid,
        "our whole gate": lambda: check_plate(ours, shape, THICKNESS),
    }
    report("checking", race(checks), "validity alone")

    part = Part("gear", shape, THICKNESS, "steel", (Instance("driver"), Instance("driven")))
    theta = np.zeros(2)
    poses = {"driver": Poses.planar(0, 0, theta), "driven": Poses.planar(80, 0, theta + math.pi)}
    motion = Motion("theta", {"theta": Channel(theta, "rad")}, poses)
    solids.part_solid(part)
    files = race(
        {
            best: lambda: cadquery_step(made[best]),
            "ours": lambda: len(step.part(part)),
            "ours, assembly of two": lambda: len(step.assembly("pair", [part], motion)),
        }
    )
    written = report("STEP", files, best, lambda size: f"{size / 1e3:.0f} kB")

    mesh_solid = solids.part_solid(part)
    loose = "CadQuery, 0.1 rad"
    formats = race(
        {
            loose: lambda: len(_fresh(mesh_solid).tessellate(0.01)[1]),
            "ours": lambda: len(mesh.mesh_of(mesh_solid, ruled=True).triangles),
        },
        rounds=3,
    )
    report("triangles at 0.01 mm", formats, loose, lambda count: f"{count} triangles")

    curves = ("spline", "spline3", "arc", "polyline")
    drawings = race({name: lambda name=name: len(dxf.part(part, name)) for name in curves})
    report("DXF", drawings, "spline", lambda size: f"{size / 1e3:.0f} kB")

    print("\nlimits")
    together = builds["ours, unchecked"].seconds + files["ours"].seconds
    both = together / (builds[best].seconds + files[best].seconds)
    kept = [
        require("solid against the best technique", build["ours, unchecked"], 1.0),
        require("STEP against the best technique", written["ours"], 1.1),
        require("solid and STEP together", both, 1.0),
        require("size of the STEP file", files["ours"].result / files[best].result, 1.05),
    ]
    return 0 if all(kept) else 1


def _fresh(solid: cq.Solid) -> cq.Solid:
    """The solid without the triangles that an earlier round left on it."""
    from mechwright_cad.solids.tessellate import forget

    forget(solid.wrapped)
    return solid


if __name__ == "__main__":
    sys.exit(main())
