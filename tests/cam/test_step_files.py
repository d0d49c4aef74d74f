"""STEP files: the same bytes always, names and colours kept, and other readers see the outline."""

import hashlib
import json
import os
import subprocess
import sys

import cadquery as cq
import pytest
import shapely
from by_night import by_night
from plate_shapes import PLATES, Part, turning, wavy_part
from step_read import read_step_outline, read_step_solids

from mechwright.errors import OutputError
from mechwright_cad.exporters import StepExporter, StlExporter

WRITE = """
import hashlib, json
from mechwright_cad.exporters import StepExporter
from plate_shapes import turning, wavy_part
exporter, part = StepExporter(), wavy_part()
files = [exporter.part(part), exporter.assembly("pair", [part], turning(), 2)]
print(json.dumps([hashlib.sha256(file).hexdigest() for file in files]))
"""

GMSH = """
import json, sys
import gmsh
gmsh.initialize(interruptible=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.merge(sys.argv[1])
faces = gmsh.model.occ.getEntities(2)
rows = [(gmsh.model.occ.getMass(2, tag), *gmsh.model.occ.getCenterOfMass(2, tag)) for _, tag in faces]
top = max(rows, key=lambda row: (round(row[3], 6), row[0]))
print(json.dumps({"solids": len(gmsh.model.occ.getEntities(3)), "faces": len(rows), "area": top[0]}))
"""


def child(code, *arguments, seed="0"):
    """Standard output of a fresh interpreter."""
    path = os.pathsep.join([os.path.dirname(__file__), *filter(None, sys.path)])  # noqa: PTH120
    environment = {**os.environ, "PYTHONPATH": path, "PYTHONHASHSEED": seed}
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        env=environment, capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def part():
    return wavy_part()


@by_night
def test_same_bytes_from_every_process_and_every_time(part):
    exporter = StepExporter()
    for _ in range(2):
        files = [exporter.part(part), exporter.assembly("pair", [part], turning(), 2)]
        here = [hashlib.sha256(file).hexdigest() for file in files]
        # Triangles made in between must leave no trace.
        StlExporter().part(part)
    assert json.loads(child(WRITE, seed="1")) == here
    assert json.loads(child(WRITE, seed="2")) == here


def test_part_file(part):
    text = StepExporter().part(part).decode("ascii")
    assert text.startswith("ISO-10303-21;")
    assert "FILE_NAME('wheel.step','2000-01-01T00:00:00'" in text
    assert "FILE_SCHEMA(('AUTOMOTIVE_DESIGN" in text
    assert text.count("PRODUCT('wheel','wheel'") == 1
    assert text.count("MANIFOLD_SOLID_BREP(") == 1
    assert text.count("COLOUR_RGB('',0.8") == 1
    assert "SI_UNIT(.MILLI.,.METRE.)" in text
    assert "PCURVE" not in text
    assert "NEXT_ASSEMBLY" not in text


def test_names_colours_and_poses_of_an_assembly_come_back(part, tmp_path):
    motion = turning()
    path = tmp_path / "pair.step"
    text = StepExporter().assembly("pair", [part], motion, 4)
    assert text.count(b"COLOUR_RGB") == 1  # the part's, which both of its bodies have
    path.write_bytes(text)
    read = cq.Assembly.importStep(str(path))
    assert read.name == "pair"
    assert [node.name for node in read.children] == ["driver", "driven"]
    for node, z in zip(read.children, (0.0, 1.5), strict=True):
        assert node.color.toTuple()[:3] == pytest.approx(part.colour, abs=1e-6)
        wanted = motion.poses[node.name].transform([[10.0, 2.0, z]])[4, 0]
        assert cq.Vertex.makeVertex(10, 2, 0).located(node.loc).toTuple() == pytest.approx(tuple(wanted))
    text = path.read_text("ascii")
    assert text.count("PRODUCT('wheel','wheel'") == 1
    assert "NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','driver'" in text
    assert "NEXT_ASSEMBLY_USAGE_OCCURRENCE('2','driven'" in text


@pytest.mark.parametrize("name", PLATES)
def test_gmsh_reads_the_outlines_area(name, tmp_path):
    pytest.importorskip("gmsh", reason="gmsh reads STEP independently; pip install gmsh", exc_type=Exception)
    outline = PLATES[name]()
    path = tmp_path / "part.step"
    path.write_bytes(StepExporter().part(Part(name, outline, 6.0, "brass")))
    seen = json.loads(child(GMSH, str(path)))
    segments = sum(len(loop.segments) for loop in outline.loops)
    assert (seen["solids"], seen["faces"]) == (1, segments + 2)
    # Without an accuracy asked for, the kernel's quadrature is off on splines of many spans.
    assert seen["area"] == pytest.approx(outline.area, rel=1e-4 if name == "spanned" else 1e-6)


@pytest.mark.parametrize("name", [pytest.param("wavy", marks=by_night), *sorted(PLATES.keys() - {"wavy"})])
def test_outline_read_back(name):
    outline = PLATES[name]()
    (polygon,) = read_step_outline(StepExporter().part(Part(name, outline, 6.0, "brass")), 1e-4)
    assert polygon.is_valid
    assert polygon.exterior.is_ccw
    assert not any(hole.is_ccw for hole in polygon.interiors)
    assert len(polygon.interiors) == len(outline.inner)
    exact = outline.polygon(1e-5)
    assert shapely.hausdorff_distance(polygon.boundary, exact.boundary, densify=0.1) < 0.5
    assert polygon.symmetric_difference(exact).area < 1.2e-4 * exact.length


def test_assembly_read_back_stands_in_its_poses(part, tmp_path):
    path = tmp_path / "pair.step"
    path.write_bytes(StepExporter().assembly("pair", [part], turning(), 4))
    polygons = read_step_outline(path)
    for polygon, (x, angle) in zip(polygons, ((0.0, 1.0), (65.0, -1.0)), strict=True):
        wanted = part.outline.moved(x, 0.0, angle).polygon()
        assert polygon.symmetric_difference(wanted).area < 1.2e-3 * wanted.length
    assert len(read_step_solids(path)) == 2


def test_what_is_no_step_file_is_refused(tmp_path):
    path = tmp_path / "broken.step"
    path.write_text("ISO-10303-21;\nthis is no such file\n")
    with pytest.raises(OutputError, match=r"broken.step cannot be read"):
        read_step_solids(path)
    with pytest.raises(OutputError, match=r"none.step cannot be read"):
        read_step_outline(tmp_path / "none.step")
