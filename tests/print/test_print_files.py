"""Files of a print, read back: by a plain reader of 3MF, by trimesh, and by a slicer where they are installed."""

import csv
import io
import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
import zipfile

import numpy as np
import pytest

from mechwright.pipeline import Build, Wanted
from mechwright.pipeline.file_names import FileNames
from mechwright.plugins.host import host
from mechwright_cad.solids.tessellate import Mesh
from mechwright_print.coupon.coupon_files import coupon_files
from mechwright_print.meshes.printed_mesh import volume
from mechwright_print.pages.files import PrintFiles
from mechwright_print.printer.settings import Bed, Printer

SPACE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
PLA = 1.24


@pytest.fixture(scope="module")
def folder(tmp_path_factory, request):
    from mechwright.testing import commands

    found = tmp_path_factory.mktemp("print") / "out"
    done = commands.run("print", request.config.rootpath / "examples/spur-gears.toml", "-o", found)
    assert done.returncode == 0, done.stderr
    return found


def read(content: bytes) -> tuple[dict[str, Mesh], list[tuple[str, np.ndarray]]]:
    """The objects of a 3MF file by their names, and its build items with their transforms (4, 3)."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        root = ET.fromstring(archive.read("3D/3dmodel.model"))  # noqa: S314 - our own file
    objects, names = {}, {}
    assert root.get("unit") == "millimeter"
    for one in root.iter(f"{SPACE}object"):
        points = [[float(v.get(a)) for a in "xyz"] for v in one.iter(f"{SPACE}vertex")]
        corners = [[int(t.get(f"v{k}")) for k in (1, 2, 3)] for t in one.iter(f"{SPACE}triangle")]
        names[one.get("id")] = one.get("name")
        objects[one.get("name")] = Mesh(np.array(points), np.array(corners))
    items = [
        (names[item.get("objectid")], np.array(item.get("transform").split(), float).reshape(4, 3))
        for item in root.iter(f"{SPACE}item")
    ]
    return objects, items


def test_a_bed_has_its_parts_apart_and_inside(folder):
    objects, items = read((folder / "plate-1.3mf").read_bytes())
    assert sorted(objects) == ["gear-1", "gear-2"]
    boxes = []
    for name, transform in items:
        mesh = objects[name]
        there = mesh.points @ transform[:3] + transform[3]
        assert there[:, 2].min() == pytest.approx(0, abs=1e-6)
        assert np.linalg.det(transform[:3]) == pytest.approx(1)
        boxes.append((there.min(axis=0), there.max(axis=0)))
    for low, high in boxes:
        assert (low[:2] >= 5).all()
        assert (high[:2] <= 215).all()
    (low, high), (other_low, other_high) = boxes
    assert (np.maximum(other_low - high, low - other_high)[:2].max()) >= 5 - 1e-6


def test_objects_are_closed_and_the_stl_is_the_same(folder):
    objects, _ = read((folder / "plate-1.3mf").read_bytes())
    for name, mesh in objects.items():
        edges = np.concatenate([mesh.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
        forth, counts = np.unique(edges, axis=0, return_counts=True)
        assert (counts == 1).all()
        assert np.array_equal(forth, np.unique(edges[:, ::-1], axis=0))
        data = (folder / f"{name}.print.stl").read_bytes()
        rows = np.frombuffer(data[84:], np.dtype([("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")]))
        assert len(rows) == int.from_bytes(data[80:84], "little") == len(mesh.triangles)
        assert np.allclose(rows["c"], mesh.points[mesh.triangles], atol=1e-4)


def test_the_bill_has_filament_by_mass(folder):
    rows = list(csv.DictReader(io.StringIO((folder / "print-bill.csv").read_text())))
    masses = {row["name"]: float(row["mass_g"]) for row in rows}
    objects, _ = read((folder / "plate-1.3mf").read_bytes())
    for name, mesh in objects.items():
        full = volume(mesh) * PLA / 1000
        assert 0.3 * full < masses[name] < full
    assert masses["PLA"] == pytest.approx(masses["gear-1"] + masses["gear-2"], abs=0.02)


def test_the_sheet_tells_of_every_hole_and_of_the_slicer(folder):
    page = (folder / "print.html").read_text()
    assert "http" not in page.replace("http-equiv", "")
    assert "corrections to 0" in page
    assert "is not measured" in page
    assert page.count("snug") == 2


def test_the_same_design_gives_the_same_bytes(folder, tmp_path, command_line, request):
    code, _, err = command_line(
        "print", request.config.rootpath / "examples/spur-gears.toml", "-o", tmp_path / "b"
    )
    assert code == 0, err
    for file in folder.iterdir():
        assert (tmp_path / "b" / file.name).read_bytes() == file.read_bytes()


def test_the_coupon_lies_as_its_sheet_says_and_a_small_bed_is_told():
    files = coupon_files(Printer())
    objects, items = read(files["coupon-1.3mf"])
    assert set(objects) == {"coupon-plate", "coupon-pins", "coupon-trials", "coupon-gauge-pin"}
    assert all(np.allclose(transform[:3], np.eye(3)) for _, transform in items)
    size = np.ptp(objects["coupon-plate"].points, axis=0)
    assert size == pytest.approx([100, 100, 4])
    body = objects["coupon-pins"]
    assert np.ptp(body.points, axis=0)[2] == pytest.approx(13)
    with pytest.raises(Exception, match="the coupon: bed: coupon-p"):
        coupon_files(Printer(bed=Bed(x=90.0, y=90.0)))


def test_another_reader_takes_the_files(folder):
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.load(folder / "plate-1.3mf")
    ours, items = read((folder / "plate-1.3mf").read_bytes())
    assert set(scene.geometry) == set(ours)
    for name, mesh in scene.geometry.items():
        assert mesh.is_watertight
        assert mesh.is_winding_consistent
        assert mesh.volume == pytest.approx(volume(ours[name]), rel=1e-6)
    assert len(scene.graph.nodes_geometry) == len(items)


@pytest.mark.skipif(shutil.which("prusa-slicer") is None, reason="prusa-slicer is not installed")
def test_a_slicer_takes_the_plate_without_repair_and_weighs_the_same(folder, tmp_path):
    program = tmp_path / "plate.gcode"
    settings = {
        "filament-density": PLA,
        "perimeters": 4,
        "top-solid-layers": 5,
        "bottom-solid-layers": 5,
        "fill-density": "30%",
        "layer-height": 0.2,
        "first-layer-height": 0.2,
        "nozzle-diameter": 0.4,
        "extrusion-width": 0.42,
        "perimeter-extrusion-width": 0.42,
        "external-perimeter-extrusion-width": 0.42,
        "skirts": 0,
        "bed-shape": "0x0,220x0,220x220,0x220",
    }
    options = [word for key, value in settings.items() for word in (f"--{key}", str(value))]
    plate = folder / "plate-1.3mf"
    done = subprocess.run(
        ["prusa-slicer", "--export-gcode", "--dont-arrange", *options, "--output", program, plate],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert not re.search("repair|warning|error", done.stdout + done.stderr, re.IGNORECASE)
    told = subprocess.run(
        ["prusa-slicer", "--info", plate], capture_output=True, text=True, check=True
    ).stdout
    assert set(re.findall(r"manifold = (\w+)", told)) == {"yes"}
    found = re.search(r"total filament used \[g\] = ([\d.]+)", program.read_text())
    rows = list(csv.DictReader(io.StringIO((folder / "print-bill.csv").read_text())))
    assert float(rows[0]["mass_g"]) == pytest.approx(float(found[1]), rel=0.1)


@pytest.mark.parametrize(("head", "own"), [("", []), ('process = { parts.crank = "print" }\n', ["crank"])])
def test_a_build_has_what_the_design_gives_to_the_printer(tmp_path, request, head, own):
    text = (request.config.rootpath / "examples/geneva-straight.toml").read_text(encoding="utf-8")
    file = tmp_path / "geneva.toml"
    file.write_text(head + text, encoding="utf-8")
    with Build(file, host(), Wanted("build", formats=("stl",))) as build:
        named = {one.name for one in PrintFiles().names(build, build.wanted)}
        meshes = {f"{name}.print.stl" for name in own}
        assert named == (meshes | {"plate-1.3mf", "print.html", "print-bill.csv"} if own else set())
        assert not FileNames().findings(build)
