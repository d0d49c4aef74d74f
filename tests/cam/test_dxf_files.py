"""DXF files: closed contours in millimetres that other readers see as the outline."""

import hashlib
import io
import json
import os
import shutil
import subprocess
import sys

import ezdxf
import numpy as np
import pytest
import shapely
from plate_shapes import PLATES, wavy, wavy_part

from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.geometry import BSpline
from mechwright_cad.exporters import DxfExporter
from mechwright_cad.exporters.curves import cubic, vertices

CURVES = ("spline", "spline3", "arc", "polyline")
CUTTING = {"OUTLINE", "BORE", "OPENING"}
NEEDS_GDAL = pytest.mark.skipif(
    not shutil.which("ogr2ogr"), reason="GDAL reads DXF independently; apt-get install gdal-bin"
)

WRITE = """
import hashlib, sys
from mechwright_cad.exporters import DxfExporter
from plate_shapes import wavy_part
digests = [hashlib.sha256(DxfExporter(c).part(wavy_part())).hexdigest() for c in sys.argv[1:]]
assert not {"cadquery", "OCP"} & set(sys.modules), "a drawing needs no CAD kernel"
print(*digests)
"""


def plate(name):
    return Part(name, PLATES[name](), 6.0, "brass")


def read(data):
    document = ezdxf.read(io.StringIO(data.decode("utf-8")))
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    return document


def flattened(entity):
    if entity.dxftype() == "LINE":
        return [entity.dxf.start, entity.dxf.end]
    return list(entity.flattening(1e-4))


def contours(document):
    """Polygons of the closed contours on the layers that are cut; the first is without its openings."""
    lines = []
    for entity in document.modelspace():
        if entity.dxf.layer in CUTTING:
            pieces = entity.virtual_entities() if entity.dxftype() == "LWPOLYLINE" else [entity]
            lines += [shapely.LineString([(p.x, p.y) for p in flattened(piece)]) for piece in pieces]
    # A grid on whose halves no number of eight decimals lies: ends that meet would fall apart there.
    rings = shapely.polygonize(shapely.set_precision(lines, 1.37e-6)).geoms
    return sorted(rings, key=lambda ring: -ring.area)


@pytest.mark.parametrize("curves", CURVES)
@pytest.mark.parametrize("name", PLATES)
def test_contours_close_and_enclose_the_outline(name, curves):
    outline = PLATES[name]()
    rings = contours(read(DxfExporter(curves).part(plate(name))))
    assert len(rings) == len(outline.loops)
    area = rings[0].area
    assert area == pytest.approx(outline.area, abs=0.0025 * outline.polygon().length)
    if curves == "spline":
        # Only the chords of the reader stand between the two.
        assert area == pytest.approx(outline.area, abs=1.2e-4 * outline.polygon().length)


def test_entities_are_the_segments():
    document = read(DxfExporter().part(wavy_part()))
    space = document.modelspace()
    assert len(space.query('SPLINE[layer=="OUTLINE"]')) == 36
    assert len(space.query('LINE[layer=="OPENING"]')) == 3
    assert len(space.query('ARC[layer=="OPENING"]')) == 1
    assert len(space.query('CIRCLE[layer=="BORE"]')) == 1
    assert len(space.query('*[layer=="OUTLINE" | layer=="OPENING" | layer=="BORE"]')) == 41
    for spline, segment in zip(space.query("SPLINE"), wavy().segments, strict=True):
        assert spline.dxf.degree == segment.degree == 5
        assert not spline.fit_points
        assert list(spline.knots) == pytest.approx(list(segment.knots), abs=1e-12)
        assert np.array(spline.control_points)[:, :2] == pytest.approx(np.array(segment.points), abs=0.5e-8)
    arc = space.query("ARC").first
    assert arc.dxf.radius == 10
    circle = space.query("CIRCLE").first
    assert (circle.dxf.center.x, circle.dxf.center.y, circle.dxf.radius) == (0, 20, 4)


def test_units_layers_and_text():
    document = read(DxfExporter().part(wavy_part()))
    assert document.dxfversion == "AC1024"
    assert document.header["$INSUNITS"] == 4
    assert document.header["$MEASUREMENT"] == 1
    assert {layer.dxf.name for layer in document.layers} >= CUTTING | {"CENTRE", "TEXT"}
    assert document.layers.get("CENTRE").dxf.linetype == "CENTER"
    (text,) = document.modelspace().query("TEXT")
    assert text.dxf.text == "wheel, steel, 8 mm"
    x0, y0, x1, y1 = wavy_part().outline.bounds
    assert document.header["$EXTMIN"] == pytest.approx((x0, y0, 0))
    assert document.header["$EXTMAX"] == pytest.approx((x1, y1, 0))


def test_one_closed_polyline_per_loop():
    for curves in ("arc", "polyline"):
        polylines = read(DxfExporter(curves).part(plate("slotted"))).modelspace().query("LWPOLYLINE")
        assert [polyline.closed for polyline in polylines] == [True, True]
    outline = read(DxfExporter("arc").part(plate("slotted"))).modelspace().query("LWPOLYLINE").first
    bulges = [bulge for *_, bulge in outline.get_points("xyb")]
    assert bulges == pytest.approx([0, np.tan(np.pi / 8)] * 4)


def test_spline3_is_of_degree_3():
    splines = read(DxfExporter("spline3").part(wavy_part())).modelspace().query("SPLINE")
    assert {spline.dxf.degree for spline in splines} == {3}


def test_same_bytes_from_every_process_without_the_cad_kernel():
    here = [hashlib.sha256(DxfExporter(curves).part(wavy_part())).hexdigest() for curves in CURVES]
    path = os.pathsep.join([os.path.dirname(__file__), *filter(None, sys.path)])  # noqa: PTH120
    for seed in "12":
        done = subprocess.run(
            [sys.executable, "-c", WRITE, *CURVES],
            env={**os.environ, "PYTHONPATH": path, "PYTHONHASHSEED": seed},
            capture_output=True, text=True, timeout=60,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        assert done.stdout.split() == here


@NEEDS_GDAL
@pytest.mark.parametrize("curves", CURVES)
@pytest.mark.parametrize("name", PLATES)
def test_gdal_sees_as_many_closed_contours(name, curves, tmp_path):
    outline = PLATES[name]()
    source, target = tmp_path / "part.dxf", tmp_path / "part.json"
    source.write_bytes(DxfExporter(curves).part(plate(name)))
    command = ["ogr2ogr", "-f", "GeoJSON", "--config", "OGR_ARC_STEPSIZE", "0.5", str(target), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    # It drops what it cannot read and still returns 0.
    assert (done.returncode, done.stderr) == (0, "")
    features = json.loads(target.read_text())["features"]
    lines = [
        shapely.force_2d(shapely.geometry.shape(feature["geometry"]))
        for feature in features
        if feature["properties"]["Layer"] in CUTTING
    ]
    whole = sum(1 if loop.is_circle else len(loop.segments) for loop in outline.loops)
    assert len(lines) == (whole if curves.startswith("spline") else len(outline.loops))
    rings = sorted(shapely.polygonize(shapely.set_precision(lines, 1e-5)).geoms, key=lambda r: -r.area)
    assert len(rings) == len(outline.loops)
    area = rings[0].area
    # GDAL draws a spline with chords of its own choice.
    assert area == pytest.approx(outline.area, rel=2e-3)


def test_part_without_outline_is_refused():
    with pytest.raises(GeometryError, match="part ball has no outline"):
        DxfExporter().part(Part("ball", None, 0.0, "steel", build=lambda: None))


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-5])
def test_cubic_stays_within_its_tolerance(tolerance):
    for segment in wavy(pieces=1).segments:
        fitted = cubic(segment, tolerance)
        t = np.linspace(0, 1, 501)
        assert fitted.degree == 3
        assert (fitted.start, fitted.end) == (segment.start, segment.end)
        assert np.linalg.norm(fitted.at(t) - segment.at(t), axis=1).max() <= 1.05 * tolerance
        assert fitted.derivative([0])[0] == pytest.approx(segment.derivative([0])[0])


@pytest.mark.parametrize("tolerance", [1e-1, 2e-3, 1e-4])
def test_biarcs_stay_within_their_tolerance_and_are_few(tolerance):
    curve = wavy(lobes=5, pieces=1).segments[1]
    corners = [*vertices(curve, tolerance), None]
    points = [(corner.x, corner.y) for corner in corners[:-1]] + [curve.end]
    fine = curve.at(np.linspace(0, 1, 20001))
    exact = shapely.LineString(fine)
    for a, b, corner in zip(points, points[1:], corners[:-1], strict=False):
        arc = np.array([(p.x, p.y) for p in ezdxf.math.Vec2.generate([a, b])])
        if corner.bulge:
            centre, start, end, radius = ezdxf.math.bulge_to_arc(a, b, corner.bulge)
            angles = np.linspace(start, end if end > start else end + 2 * np.pi, 33)
            arc = np.column_stack((centre.x + radius * np.cos(angles), centre.y + radius * np.sin(angles)))
        assert shapely.distance(shapely.points(arc), exact).max() <= 1.1 * tolerance + 1e-6
    # The error of a biarc falls with the third power of its length.
    assert len(points) <= 16 * (1e-1 / tolerance) ** (1 / 3) / 2 + 4


def test_biarc_of_an_inflected_curve_keeps_its_tangents():
    curve = BSpline.bezier([(0, 0), (10, 12), (20, -12), (30, 0)])
    corners = vertices(curve, 1e-3)
    assert {np.sign(corner.bulge) for corner in corners} == {-1, 1}
    a, b = corners[0], corners[1]
    chord = np.arctan2(b.y - a.y, b.x - a.x)
    assert chord - 2 * np.arctan(a.bulge) == pytest.approx(np.arctan2(12, 10))


def test_impossible_tolerance_is_refused():
    with pytest.raises(GeometryError, match="in degree 3 within 1e-30 mm"):
        cubic(wavy(pieces=1).segments[0], 1e-30)
    with pytest.raises(GeometryError, match="in arcs within 1e-30 mm"):
        vertices(wavy(pieces=1).segments[0], 1e-30)
