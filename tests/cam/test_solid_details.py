"""Chamfers, engravings and threads in solids, STEP, meshes and drawings."""

import dataclasses
import io
import json
import math
import shutil
import subprocess
from functools import cache

import cadquery as cq
import ezdxf
import numpy as np
import pytest
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from plate_shapes import turning, volume_of, wavy
from shop import rounded_box
from step_read import read_step_solids

from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.moments import volume
from mechwright.contracts.part import Bore, Instance, Part, Pocket, Profile
from mechwright.errors import GeometryError
from mechwright.geometry import Line, Loop, Outline, circle
from mechwright.geometry.lettering import lettering
from mechwright_cad.exporters import DxfExporter, StepExporter, StlExporter
from mechwright_cad.exporters.mesh import part_mesh
from mechwright_cad.solids.solid import part_shape, part_solid
from mechwright_cam.pages import picture

THICKNESS = 6.0
BOX = rounded_box(30, 20, 6)
RECTANGLE = Loop.polygon([(-30, -20), (30, -20), (30, 20), (-30, 20)])
HOLE = Loop((circle((-15.0, 0.0), 6.0, clockwise=True),))
THREAD = Thread("m6", (12.0, 5.0), 6.0, 1.0, 5.0)
TEXT = Engraving("number", lettering("A7", 4.0, (4.0, -12.0)), 0.2)
RECESS = Pocket("recess", rounded_box(8, 6, 3).moved(14, -8), (rounded_box(3, 3, 1).moved(14, -8),), 0.0, 2.0)


def part(*details, outer=BOX, machined=(), **changes):
    core = Loop((circle(THREAD.centre, THREAD.core / 2, clockwise=True),))
    shape = (
        Bore("hole", (-15.0, 0.0), 12.0, 0, THICKNESS),
        Bore("core", THREAD.centre, THREAD.core, 0, THICKNESS),
        *machined,
        Profile("outside", outer, "outside", 0, THICKNESS),
    )
    made = Part(
        "plate", Outline(outer, (HOLE, core)), THICKNESS, "aluminium", machined=shape, details=details
    )
    return dataclasses.replace(made, **changes)


def exact(solid):
    """Volume by the kernel's adaptive quadrature, mm³."""
    properties = GProp_GProps()
    BRepGProp.VolumePropertiesGK_s(solid.wrapped, properties, 1e-10, False, False)
    return properties.Mass()


def taken(*details, **changes):
    plain = dataclasses.replace(part(**changes), details=())
    return exact(part_solid(plain)) - exact(part_solid(part(*details, **changes)))


def length(loop):
    return sum(float(np.hypot(*np.diff(s.flatten(1e-9), axis=0).T).sum()) for s in loop.segments)


@pytest.mark.parametrize(
    ("outer", "corners"),
    [(BOX, math.pi), (RECTANGLE, 4.0), (wavy(), math.pi)],
    ids=["arcs", "corners", "splines"],
)
def test_a_chamfered_rim_takes_what_steiners_formula_says(outer, corners):
    """Σ over the depth of L s - c s²: w²/2 L - c w³/3, c = π for smooth edges, tan(45°) for each corner."""
    width = 0.5
    wanted = width**2 / 2 * length(outer) - corners * width**3 / 3
    found = taken(Chamfer("rim", outer, "outside", width), outer=outer)
    assert found == pytest.approx(wanted, rel=1e-6)


def test_a_chamfer_has_one_face_for_each_segment():
    plain, broken = part_solid(part()), part_solid(part(Chamfer("rim", BOX, "outside", 0.5)))
    assert len(broken.Faces()) == len(plain.Faces()) + len(BOX.segments)
    kinds = [face.geomType() for face in broken.Faces()]
    assert kinds.count("CONE") == 4
    assert kinds.count("PLANE") == 2 + 4 + 4
    for face in broken.Faces():
        if face.geomType() == "CONE":
            assert abs(face.normalAt().z) == pytest.approx(math.sqrt(0.5), abs=1e-9)
    box = broken.BoundingBox()
    assert (box.xmin, box.xmax, box.zmin, box.zmax) == pytest.approx((-30, 30, 0, 6), abs=1e-6)


@pytest.mark.parametrize("loop", [HOLE, HOLE.reversed()])
def test_a_chamfered_hole_is_a_cone(loop):
    width, radius = 0.4, 6.0
    found = taken(Chamfer("edge", loop, "inside", width))
    assert found == pytest.approx(math.pi * (radius * width**2 + width**3 / 3), rel=1e-6)
    faces = part_solid(part(Chamfer("edge", loop, "inside", width))).Faces()
    assert sum(face.geomType() == "CONE" for face in faces) == 1


def test_a_keyway_is_chamfered_along_arc_and_lines():
    a = math.asin(0.3)
    x = 10 * math.cos(a)
    slot = [Line((x, 3.0), (12.8, 3.0)), Line((12.8, 3.0), (12.8, -3.0)), Line((12.8, -3.0), (x, -3.0))]
    from mechwright.geometry import Arc

    bore = Loop((Arc((0.0, 0.0), 10.0, -a, 2 * a - 2 * math.pi), *slot))
    whole = Part("hub", Outline(RECTANGLE, (bore,)), THICKNESS, "steel")
    broken = dataclasses.replace(whole, details=(Chamfer("edge", bore, "inside", 0.4),))
    solid = part_solid(broken)
    assert solid.isValid()
    assert exact(solid) == pytest.approx(volume(broken), rel=1e-7)
    assert len(solid.Faces()) == len(part_solid(whole).Faces()) + 4


def test_recesses_have_broken_edges_of_their_own():
    edges = (
        Chamfer("mouth", RECESS.boundary, "inside", 0.4),
        Chamfer("island", RECESS.islands[0], "outside", 0.3),
        Chamfer("rim", BOX, "outside", 0.5),
    )
    found = taken(*edges, machined=(RECESS,))
    wanted = [
        0.4**2 / 2 * length(RECESS.boundary) + math.pi * 0.4**3 / 3,
        0.3**2 / 2 * length(RECESS.islands[0]) - math.pi * 0.3**3 / 3,
        0.5**2 / 2 * length(BOX) - math.pi * 0.5**3 / 3,
    ]
    assert found == pytest.approx(sum(wanted), rel=1e-6)


@cache
def everything():
    rim = Chamfer("rim", BOX, "outside", 0.5)
    return part(rim, Chamfer("edge", HOLE, "inside", 0.4), THREAD, TEXT, instances=(Instance("driver"),))


def test_all_details_together_have_the_volume_of_the_sections():
    solid = part_solid(everything())
    assert solid.isValid()
    assert exact(solid) == pytest.approx(volume(everything()), rel=1e-6)
    mesh = part_mesh(everything())  # closed, or it raises
    assert volume_of(mesh) == pytest.approx(solid.Volume(), rel=1e-4)
    assert len(StlExporter().part(everything())) > len(StlExporter().part(part()))


def test_threads_and_engravings_are_curves_on_the_top_face():
    shape = part_shape(part(THREAD))
    assert exact(shape.Solids()[0]) == pytest.approx(exact(part_solid(part())), rel=1e-12)
    assert exact(part_shape(part(TEXT)).Solids()[0]) == pytest.approx(exact(part_solid(part())), rel=1e-12)
    lines = sum(len(stroke) - 1 for stroke in TEXT.strokes)
    assert len(part_shape(part(TEXT)).Edges()) == len(part_solid(part()).Edges()) + lines
    inside = {edge.hashCode() for edge in shape.Solids()[0].Edges()}
    (ring,) = [edge for edge in shape.Edges() if edge.hashCode() not in inside]
    assert ring.geomType() == "CIRCLE"
    assert (ring.radius(), *ring.arcCenter().toTuple()) == pytest.approx((3.0, 12.0, 5.0, THICKNESS))
    assert isinstance(part_shape(part()), cq.Solid)


def test_step_names_threads_and_engravings_and_keeps_its_bytes(tmp_path):
    data = StepExporter().part(everything())
    assert data == StepExporter().part(dataclasses.replace(everything()))
    assert data.count(b"GEOMETRIC_CURVE_SET('m6: M6x1'") == 1
    assert data.count(b"GEOMETRIC_CURVE_SET('number: engraved 0.2 mm deep'") == len(TEXT.strokes)
    assert data.count(b"MANIFOLD_SOLID_BREP") == 1
    file = tmp_path / "plate.step"
    file.write_bytes(data)
    (solid,) = read_step_solids(file)
    assert exact(solid) == pytest.approx(volume(everything()), rel=1e-6)
    other = dataclasses.replace(part(THREAD, name="other"), instances=(Instance("driven"),))
    both = StepExporter().assembly("pair", [everything(), other], turning(), 1)
    assert both.count(b"GEOMETRIC_CURVE_SET('m6: M6x1'") == 2
    assert b"GEOMETRIC_CURVE_SET" not in StepExporter().part(part())


@pytest.mark.parametrize(
    ("detail", "words"),
    [
        (Chamfer("edge", rounded_box(20, 10, 3), "inside", 0.4), "edge follows no edge of the top face"),
        (Chamfer("edge", BOX, "inside", 0.4), "edge follows no edge of the top face"),
        (Chamfer("edge", BOX, "outside", 6.0), "takes all of an edge 6 mm high"),
    ],
)
def test_what_is_no_chamfer_of_the_part_is_refused(detail, words):
    with pytest.raises(GeometryError, match=f"part plate: .*{words}"):
        part_solid(part(detail))


def test_a_corner_as_round_as_the_chamfer_is_wide_is_left_to_the_kernel():
    """Nothing is left of the arcs at the top: cones end in points, and only the kernel's chamfer makes those."""
    loop = rounded_box(30, 20, 0.5)
    broken = Part("bar", Outline(loop), 5.0, "steel", details=(Chamfer("rim", loop, "outside", 0.5),))
    wanted = 0.5**2 / 2 * length(loop) - math.pi * 0.5**3 / 3
    assert loop.area * 5.0 - exact(part_solid(broken)) == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize("corner", [(40.0, 19.7), (39.0, 20.0)])
def test_a_chamfer_that_swallows_an_edge_is_refused(corner):
    loop = Loop.polygon([(0, 0), (40, 0), corner, (39.7, 20), (0, 20)])
    with pytest.raises(GeometryError, match=r"part bar: .*moved by 2 mm"):
        part_solid(Part("bar", Outline(loop), 5.0, "steel", details=(Chamfer("rim", loop, "outside", 2.0),)))


# -- drawings -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("curves", ["spline", "spline3", "arc", "polyline"])
def test_drawings_have_a_layer_for_each_kind_of_detail(curves):
    data = DxfExporter(curves).part(everything())
    document = ezdxf.read(io.StringIO(data.decode()))
    assert not document.audit().errors
    space = document.modelspace()
    lines = space.query('*[layer=="CHAMFER_0.5"]')
    rim = [entity for entity in lines if entity.dxftype() != "CIRCLE"]
    assert len(rim) == (8 if curves.startswith("spline") else 1)
    (ring,) = space.query('CIRCLE[layer=="CHAMFER_0.4"]')
    assert ring.dxf.radius == pytest.approx(6.4)
    assert len(space.query('LWPOLYLINE[layer=="ENGRAVE_0.2_W0.6"]')) == len(TEXT.strokes)
    (thread,) = space.query('ARC[layer=="THREAD_M6X1_5"]')
    assert thread.dxf.radius == 3.0
    assert (thread.dxf.end_angle - thread.dxf.start_angle) % 360 == pytest.approx(270)
    notes = {text.dxf.text for text in space.query("TEXT")}
    assert {"rim: 0.5 x 45%%d", "m6: M6x1 5 mm deep", "number: engraved 0.2 mm deep, line 0.6 mm"} <= notes
    assert data == DxfExporter(curves).part(everything())
    plain = ezdxf.read(io.StringIO(DxfExporter(curves).part(part()).decode()))
    kinds = {layer.dxf.name.partition("_")[0] for layer in plain.layers}
    assert not {"CHAMFER", "ENGRAVE", "THREAD"} & kinds


@pytest.mark.skipif(
    not shutil.which("ogr2ogr"), reason="GDAL reads DXF independently; apt-get install gdal-bin"
)
def test_gdal_counts_the_details(tmp_path):
    source, target = tmp_path / "part.dxf", tmp_path / "part.json"
    source.write_bytes(DxfExporter("arc").part(everything()))
    command = ["ogr2ogr", "-f", "GeoJSON", str(target), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    layers = [
        feature["properties"]["Layer"].partition("_")[0]
        for feature in json.loads(target.read_text())["features"]
    ]
    assert [layers.count(name) for name in ("CHAMFER", "ENGRAVE", "THREAD")] == [2, len(TEXT.strokes), 1]


def test_a_spline_edge_keeps_its_distance_in_the_drawing():
    broken = Part(
        "wheel", Outline(wavy()), THICKNESS, "steel", details=(Chamfer("rim", wavy(), "outside", 0.5),)
    )
    space = ezdxf.read(io.StringIO(DxfExporter("spline3").part(broken).decode())).modelspace()
    import shapely

    ring = shapely.LinearRing(wavy().flatten(1e-5))
    splines = list(space.query('SPLINE[layer=="CHAMFER_0.5"]'))
    assert len(splines) == len(wavy().segments)
    for spline in splines[:6]:
        points = [(p.x, p.y) for p in spline.flattening(1e-3)]
        assert shapely.distance(ring, shapely.points(points)) == pytest.approx(0.5, abs=2e-3)


def test_pictures_show_details():
    from planning_parts import job

    tools = ("mill-6", "mill-4", "chamfer-6", "engrave-3", "thread-m6")
    shown = picture.plan_view(job(everything(), *tools))
    bare = picture.plan_view(job(part(), *tools))
    more = shown.count("<path") - bare.count("<path")
    assert more == 1
    strokes = sum(1 for stroke in TEXT.strokes)
    extra = shown.count("M") - bare.count("M")
    assert extra == 2 + strokes + 1
