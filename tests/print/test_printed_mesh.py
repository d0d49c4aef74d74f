"""Meshes of compensated plates: closed, and every wall where the printer's deviations want it."""

import math

import numpy as np
import pytest
import shapely
from printed_meshes import CHORD, is_closed, section

from mechwright.contracts.details import Chamfer, Thread
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.geometry import Loop, Outline, circle
from mechwright_print.compensation.plates import compensated
from mechwright_print.meshes.printed_mesh import printed_mesh, volume
from mechwright_print.printer.settings import Deviation, Printer
from mechwright_print.settings import PrintSettings

OFF = Deviation(hole=-0.3, slot=-0.14, pin=0.1, wall=0.16, foot=0.12, scale_x=1.004, scale_y=0.997)
PRINTER = Printer(deviation=OFF)
PLACES = 50


def plate(*, recess: bool = False, chamfer: bool = False, thread: bool = False) -> Part:
    """A plate of 60 x 30 x 6 with bores, a slot and what is asked for."""
    rim = Loop.polygon([(0, 0), (60, 0), (60, 30), (0, 30)])
    slot = Loop.polygon([(30, 10), (50, 10), (50, 14), (30, 14)])
    features = [
        Bore("seat", (10.0, 15.0), 8.0075, 0.0, 6.0, hole_fit(8, "H7")),
        Bore("free", (22.0, 15.0), 3.242 if thread else 5.0, 0.0, 6.0),
        Profile("slot", slot, "inside", 0.0, 6.0),
    ]
    if recess:
        around = Loop.polygon([(30, 17), (55, 17), (55, 27), (30, 27)])
        pin = Loop((circle((42.0, 22.0), 2.0),))
        features.append(Pocket("recess", around, (pin,), 0.0, 2.0))
    details = []
    if chamfer:
        details.append(Chamfer("rim", rim, "outside", 0.5))
    if thread:
        details.append(Thread("t", (22.0, 15.0), 4.0, 0.7, 6.0))
    inner = [Loop((circle(f.centre, f.diameter / 2, clockwise=True),)) for f in features[:2]]
    outline = Outline(rim, (*inner, slot.reversed()))
    machined = (*features, Profile("outside", rim, "outside", 0.0, 6.0))
    return Part("plate", outline, 6.0, "pom", machined=machined, details=tuple(details))


def printed_of(shape: shapely.Geometry, printer: Printer) -> shapely.Geometry:
    """What the printer makes of a section: first its lengths grow."""
    off = printer.deviation
    return shapely.transform(shape, lambda p: p * (off.scale_x, off.scale_y))


@pytest.mark.parametrize("recess", [False, True])
@pytest.mark.parametrize("chamfer", [False, True])
@pytest.mark.parametrize("on_top", [False, True])
def test_meshes_are_closed_and_walls_stand_where_they_have_to(recess, chamfer, on_top):
    part = plate(recess=recess, chamfer=chamfer)
    made = compensated(part, PrintSettings(fits="drawn"), PRINTER)
    mesh = printed_mesh(made, PRINTER, on_top=on_top, correct=True)
    assert is_closed(mesh)
    assert volume(mesh.mesh) > 0
    assert mesh.size[2] == pytest.approx(6.0, abs=1e-6)
    got = printed_of(section(mesh, 3.0), PRINTER)
    sign = -1 if on_top else 1
    # what the printer does besides: walls grow, holes and slots shrink, each by half its deviation a side
    rings = {}
    for ring in [got.exterior, *got.interiors]:
        x, y = ring.centroid.coords[0]
        rings[round(x), round(sign * y)] = np.asarray(ring.coords)
    rim = rings[30, 15]
    assert np.ptp(rim, axis=0) + OFF.wall == pytest.approx([60, 30], abs=2e-4)
    for at, size in (((10, 15), 8.0075), ((22, 15), 5.0)):
        radius = np.hypot(*(rings[at] - (at[0], sign * at[1])).T)
        assert radius.max() * 2 + OFF.hole == pytest.approx(size, abs=0.02)
    assert np.ptp(rings[40, 12], axis=0) + OFF.slot == pytest.approx([20, 4], abs=2e-4)


@pytest.mark.parametrize("recess", [False, True])
def test_fifty_places_of_the_mesh_are_on_the_model(recess):
    part = plate(recess=recess)
    made = compensated(part, PrintSettings(), PRINTER)
    mesh = printed_mesh(made, PRINTER, on_top=False, correct=True)
    walls = shapely.boundary(section(mesh, 3.0))
    worst = 0.0
    loops = made.model.outline.loops
    for loop in loops:
        for segment in loop.segments:
            t = np.linspace(0, 1, math.ceil(PLACES / len(loops)))
            there = mesh.moved(np.column_stack((segment.at(t), np.zeros(len(t)))))
            worst = max(worst, float(shapely.distance(walls, shapely.points(there[:, :2])).max()))
    assert worst < CHORD


def test_the_first_layer_stands_back_by_the_foot():
    part = plate(recess=True)
    made = compensated(part, PrintSettings(fits="drawn"), PRINTER)
    mesh = printed_mesh(made, PRINTER, on_top=False, correct=True)
    assert mesh.foot == OFF.foot
    up, low = section(mesh, 3.0), section(mesh, PRINTER.first / 2)
    for one, other in ((up.exterior, low.exterior),):
        assert (np.ptp(one.coords, axis=0) - np.ptp(other.coords, axis=0)) / 2 == pytest.approx(
            [OFF.foot / OFF.scale_x, OFF.foot / OFF.scale_y], abs=1e-3
        )
    assert len(up.interiors) == len(low.interiors) == 3
    # openings widen by the foot on each side
    for one, other in zip(
        sorted(up.interiors, key=lambda ring: ring.length),
        sorted(low.interiors, key=lambda ring: ring.length),
        strict=True,
    ):
        grown = (np.ptp(other.coords, axis=0) - np.ptp(one.coords, axis=0)) / 2
        assert grown == pytest.approx([OFF.foot, OFF.foot], abs=0.006)


def test_pins_and_recesses_are_moved_each_by_its_kind():
    made = compensated(plate(recess=True), PrintSettings(), PRINTER)
    (pocket,) = [one for one in made.model.features if isinstance(one, Pocket)]
    (pin,) = pocket.islands
    assert 2 * pin.segments[0].radius + OFF.pin == pytest.approx(4.0)
    x0, y0, x1, y1 = pocket.boundary.bounds
    assert (x1 - x0 + OFF.slot, y1 - y0 + OFF.slot) == pytest.approx((25.0, 10.0))


def test_the_slicer_corrects_where_it_is_asked_to():
    settings = PrintSettings(fits="drawn", compensate="slicer")
    made = compensated(plate(), settings, PRINTER)
    mesh = printed_mesh(made, PRINTER, on_top=False, correct=False)
    assert np.ptp(mesh.mesh.points, axis=0) == pytest.approx([60, 30, 6])
    assert mesh.foot == 0


@pytest.mark.parametrize(
    ("settings", "seat"),
    [
        (PrintSettings(), 8 + 2 * 0.025),
        (PrintSettings(fits="ream"), 8 - 0.4),
        (PrintSettings(fits="drawn"), 8.0075),
        (PrintSettings(holes={"plate.seat": "turning"}), 8 + 2 * 0.4),
    ],
)
def test_holes_have_the_size_of_their_joint(settings, seat):
    made = compensated(plate(), settings, PRINTER)
    (hole,) = [one for one in made.holes if one.name == "seat"]
    assert hole.target == pytest.approx(seat)
    (bore,) = [one for one in made.model.features if one.name == "seat"]
    assert bore.diameter + OFF.hole == pytest.approx(seat)
    assert (hole.operation == "ream 8 H7") == (settings.fits == "ream")


@pytest.mark.parametrize(("threads", "wide"), [("insert", 5.6), ("screw", 4.5), ("tap", 3.242)])
def test_threads_become_inserts_screws_or_pilots(threads, wide):
    made = compensated(plate(thread=True), PrintSettings(threads=threads), PRINTER)
    (hole,) = [one for one in made.holes if one.name == "free"]
    assert (hole.kind, hole.target) == (threads, pytest.approx(wide))
    assert hole.operation


def test_a_body_lies_on_its_largest_face():
    def wedge():
        import cadquery as cq

        return cq.Workplane("XZ").polyline([(0, 0), (30, 0), (0, 10)]).close().extrude(20).val()

    body = Part("wedge", None, 0.0, "pom", build=wedge)
    mesh = printed_mesh(compensated(body, PrintSettings(), Printer()), Printer(), on_top=False, correct=True)
    assert mesh.mesh.points[:, 2].min() == 0
    flat = np.isclose(mesh.mesh.points[mesh.mesh.triangles][:, :, 2], 0, atol=1e-9).all(axis=1)
    a, b, c = mesh.mesh.points[mesh.mesh.triangles[flat]].transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert area == pytest.approx(20 * math.hypot(30, 10))  # the sloping side
    assert volume(mesh.mesh) == pytest.approx(30 * 10 / 2 * 20)
