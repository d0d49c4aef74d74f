"""STL, 3MF and GLB: closed, of the right size and volume, and the same bytes always."""

import io
import json
import os
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from plate_shapes import PLATES, Part, turning, volume_of, wavy_part
from scipy.spatial.transform import Rotation

from mechwright.contracts.motion import Poses
from mechwright_cad.exporters import GlbExporter, StlExporter, ThreeMfExporter, mesh
from mechwright_cad.solids import tessellate
from mechwright_cad.solids.solid import part_solid

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


@pytest.fixture(scope="module")
def part():
    return wavy_part()


@pytest.mark.parametrize("name", PLATES)
def test_mesh_is_closed_and_near(name):
    outline = PLATES[name]()
    solid = part_solid(Part(name, outline, 6.0, "pom"))
    found = tessellate.mesh_of(solid, ruled=True)
    edges = np.concatenate([found.triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    _, counts = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    assert set(counts) == {2}
    # Euler's formula: two per hole less than a ball's 2.
    assert len(found.points) - len(counts) + len(found.triangles) == 2 - 2 * len(outline.inner)
    allowed = tessellate.LINEAR * outline.polygon().length * 6
    assert volume_of(found) == pytest.approx(outline.area * 6, abs=allowed)
    assert volume_of(found) != pytest.approx(outline.area * 6, rel=1e-12)
    assert solid.BoundingBox().zmax == pytest.approx(6, abs=1e-6)


def test_ball_has_points_inside_its_face():
    import cadquery as cq

    ball = tessellate.mesh_of(cq.Solid.makeSphere(10.0, angleDegrees1=-90), ruled=False)
    radii = np.linalg.norm(ball.points, axis=1)
    assert radii == pytest.approx(10.0, abs=1e-6)
    assert volume_of(ball) == pytest.approx(4 / 3 * np.pi * 1000, rel=5e-3)


def test_stl(part):
    data = StlExporter().part(part)
    assert not data.startswith(b"solid")
    (count,) = np.frombuffer(data, "<u4", 1, 80)
    assert len(data) == 84 + 50 * count
    rows = np.frombuffer(data, mesh._STL, offset=84)
    corners = rows["corners"].astype(float)
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume == pytest.approx(part.outline.area * 8, rel=2e-4)
    assert np.linalg.norm(rows["normal"], axis=1) == pytest.approx(1, abs=1e-6)
    assert corners[..., 2].min() == 0
    assert corners[..., 2].max() == 8
    assert data == StlExporter().part(part)


def test_threemf(part):
    data = ThreeMfExporter().part(part)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        assert archive.namelist() == ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
        model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))  # noqa: S314 - our own file
    assert model.get("unit") == "millimeter"
    base = model.find(f".//{CORE}base")
    assert (base.get("name"), base.get("displaycolor")) == ("steel", "#CC8033")
    points = [[float(v.get(axis)) for axis in "xyz"] for v in model.iter(f"{CORE}vertex")]
    corners = [[int(t.get(v)) for v in ("v1", "v2", "v3")] for t in model.iter(f"{CORE}triangle")]
    found = tessellate.Mesh(np.array(points), np.array(corners))
    assert volume_of(found) == pytest.approx(part.outline.area * 8, rel=2e-4)
    (item,) = model.iter(f"{CORE}item")
    assert item.get("objectid") == model.find(f".//{CORE}object").get("id")


def glb_document(data):
    head, length = np.frombuffer(data, "<u4", 2, 4)
    assert data[:4] == b"glTF"
    assert (head, length) == (2, len(data))
    (size,) = np.frombuffer(data, "<u4", 1, 12)
    assert data[16:20] == b"JSON"
    assert size % 4 == 0
    body = 20 + size
    assert data[body + 4 : body + 8] == b"BIN\0"
    return json.loads(data[20:body]), data[body + 8 :]


def test_glb_part(part):
    document, body = glb_document(GlbExporter().part(part))
    primitive = document["meshes"][0]["primitives"][0]

    def values(accessor, dtype, width):
        row = document["accessors"][accessor]
        view = document["bufferViews"][row["bufferView"]]
        return np.frombuffer(body, dtype, row["count"] * width, view["byteOffset"]).reshape(-1, width)

    points = values(primitive["attributes"]["POSITION"], "<f4", 3).astype(float)
    normals = values(primitive["attributes"]["NORMAL"], "<f4", 3)
    triangles = values(primitive["indices"], "<u4", 1).reshape(-1, 3)
    a, b, c = points[triangles].transpose(1, 0, 2)
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    assert volume == pytest.approx(part.outline.area * 8e-9, rel=2e-4)
    assert (points[:, 1].min(), points[:, 1].max()) == pytest.approx((0, 0.008))
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1, abs=1e-5)
    face = np.cross(b - a, c - a)
    face /= np.linalg.norm(face, axis=1)[:, None]
    assert np.einsum("ij,ij->i", normals[triangles[:, 0]], face).min() > mesh.CREASE_COS - 1e-4


def test_glb_assembly_stands_in_its_poses(part):
    motion = turning()
    document, _ = glb_document(GlbExporter().assembly("pair", [part], motion, 4))
    assert [node["name"] for node in document["nodes"]] == ["driver", "driven"]
    assert len(document["meshes"]) == 1
    for node, z in zip(document["nodes"], (0.0, 1.5), strict=True):
        matrix = np.eye(4)
        matrix[:3, :3] = Rotation.from_quat(node["rotation"]).as_matrix()
        matrix[:3, 3] = node["translation"]
        x, y, up = 10.0, 2.0, 3.0
        moved = matrix @ [x / 1000, up / 1000, -y / 1000, 1.0]
        wanted = motion.poses[node["name"]].transform([[x, y, up + z]])[4, 0] / 1000
        assert moved[:3] == pytest.approx((wanted[0], wanted[2], -wanted[1]), abs=1e-9)
    assert GlbExporter().assembly("pair", [part], motion, 4) == GlbExporter().assembly(
        "pair", [part], motion, 4
    )


def test_glb_assembly_moves_as_the_motion_does(part):
    motion = turning()
    document, body = glb_document(GlbExporter().assembly("pair", [part], motion, 0))
    (animation,) = document["animations"]
    assert animation["name"] == motion.input_name

    def values(accessor, width):
        row = document["accessors"][accessor]
        view = document["bufferViews"][row["bufferView"]]
        assert "target" not in view
        return np.frombuffer(body, "<f4", row["count"] * width, view["byteOffset"]).reshape(-1, width)

    ways = {(one["target"]["node"], one["target"]["path"]): one["sampler"] for one in animation["channels"]}
    times = values(animation["samplers"][0]["input"], 1).ravel()
    assert times[0] == 0
    assert (np.diff(times) > 0).all()
    row = document["accessors"][animation["samplers"][0]["input"]]
    assert (row["min"], row["max"]) == ([times[0]], [times[-1]])
    y_up = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
    for number, (node, z) in enumerate(zip(document["nodes"], (0.0, 1.5), strict=True)):
        assert "matrix" not in node
        if (number, "rotation") not in ways:
            continue
        places = values(animation["samplers"][ways[number, "translation"]]["output"], 3)
        turns = values(animation["samplers"][ways[number, "rotation"]]["output"], 4)
        assert np.linalg.norm(turns, axis=1) == pytest.approx(1, abs=1e-6)
        assert (np.einsum("ij,ij->i", turns[1:], turns[:-1]) > 0).all(), "no jump of sign"
        wanted = motion.poses[node["name"]].transform([[10.0, 2.0, 3.0 + z]])[:, 0] / 1000
        keys = np.rint(np.linspace(0, motion.samples - 1, len(times))).astype(int)
        moved = Rotation.from_quat(turns).apply(y_up @ (0.010, 0.002, 0.003)) + places
        np.testing.assert_allclose(moved, wanted[keys] @ y_up.T, atol=1e-6)
    assert ways


def test_a_motion_of_two_samples_and_what_stands_are_not_animated(part):
    motion = turning()
    ends = replace(
        motion,
        channels={name: replace(one, values=one.values[[0, -1]]) for name, one in motion.channels.items()},
        poses={
            name: Poses(one.position[[0, -1]], one.rotation[[0, -1]]) for name, one in motion.poses.items()
        },
    )
    document, _ = glb_document(GlbExporter().assembly("pair", [part], ends, 0))
    assert "animations" not in document
    assert all("matrix" in node for node in document["nodes"])


VALIDATOR = Path(os.environ.get("MECHWRIGHT_GLTF_VALIDATOR", "gltf-validator"))


@pytest.mark.skipif(not (VALIDATOR / "package.json").is_file(), reason="no gltf-validator of npm here")
def test_glb_passes_the_validator_of_its_format(part, tmp_path):
    for name, data in {
        "part": GlbExporter().part(part),
        "pair": GlbExporter().assembly("pair", [part], turning(), 4),
    }.items():
        (tmp_path / f"{name}.glb").write_bytes(data)
        code = (
            f"require({str(VALIDATOR.resolve())!r}).validateBytes(new Uint8Array(require('fs').readFileSync("
            f"{str(tmp_path / name)!r} + '.glb'))).then((found) => console.log(JSON.stringify(found.issues)))"
        )
        done = subprocess.run(["node", "-e", code], capture_output=True, text=True, check=True)
        found = json.loads(done.stdout)
        assert (found["numErrors"], found["numWarnings"]) == (0, 0), found["messages"]


def test_listing_the_formats_imports_nothing_heavy():
    code = (
        "import sys, mechwright_cad.plugin as p; from mechwright import Exporter\n"
        "names = [e.name for e in p.mechwright_register() if issubclass(e, Exporter)]\n"
        "heavy = {'numpy', 'scipy', 'shapely', 'cadquery', 'OCP', 'ezdxf', 'jinja2'} & set(sys.modules)\n"
        "print(names, sorted(heavy))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.stdout.strip() == "['step', 'dxf', 'stl', '3mf', 'glb', 'mjcf', 'urdf', 'sdf'] []"
