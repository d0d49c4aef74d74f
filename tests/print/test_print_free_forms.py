"""Walls that are no circle: cams, flanks, slots of Geneva wheels and bodies of free form, each by its kind."""

import math

import numpy as np
import pytest
import shapely
from printed_meshes import CHORD, section

from mechwright.cli.hosting import open_host
from mechwright.designs.design import load
from mechwright.geometry import Loop
from mechwright.geometry.parallel import Parallel
from mechwright.geometry.segments import Arc, Line
from mechwright.pipeline import Build
from mechwright_print.compensation.open_slots import open_slots
from mechwright_print.compensation.plates import compensated, is_convex
from mechwright_print.job.print_job import JobPart, PrintJob
from mechwright_print.meshes.printed_mesh import printed_mesh
from mechwright_print.printer.settings import Deviation, Printer
from mechwright_print.rules.judged import form_rule, level_bores
from mechwright_print.settings import PrintSettings

OFF = Deviation(hole=-0.3, slot=-0.14, pin=0.1, wall=0.16, foot=0.12, scale_x=1.004, scale_y=0.997)
PRINTER = Printer(deviation=OFF)
PLACES = 50


def parts_of(name: str, request):
    return Build(load(request.config.rootpath / f"examples/{name}.toml", open_host()), open_host()).parts


def fork(tilt: float = 0.0) -> Loop:
    """A block with a slot 3 mm wide and 7 mm deep whose walls lean outwards by an angle, degrees."""
    lean = 7 * math.tan(math.radians(tilt))
    return Loop.polygon([(0, 0), (20, 0), (20, 9), (12 + lean, 9), (12, 2), (9, 2), (9 - lean, 9), (0, 9)])


def test_a_slot_is_open_where_its_walls_run_against_each_other():
    assert open_slots(fork()) == [[3, 4, 5]]
    assert open_slots(fork(2.0)) == [[3, 4, 5]]
    assert open_slots(fork(5.0)) == []  # a tooth space
    shallow = Loop.polygon([(0, 0), (20, 0), (20, 9), (16, 9), (16, 7), (4, 7), (4, 9), (0, 9)])
    assert open_slots(shallow) == []
    notch = Loop.polygon([(0, 0), (20, 0), (20, 9), (12, 9), (12, 5), (0, 5)])
    assert open_slots(notch) == []


def test_walls_that_move_apart_meet_where_closed_form_says():
    """Slot walls by one distance and the rest by another: widths and depths are sums of both."""
    run = fork()
    more = [-0.1 if k in (3, 4, 5) else 0.25 for k in range(8)]
    moved = Parallel(run, -1, tuple(more)).at(1.0)
    x0, y0, x1, y1 = moved.bounds
    assert (x0, y0, x1, y1) == pytest.approx((-0.25, -0.25, 20.25, 9.25))
    corners = np.array([one.start for one in moved.segments])
    assert corners[4] == pytest.approx((12.1, 1.9))
    assert corners[3] == pytest.approx((12.1, 9.25))
    assert corners[6] == pytest.approx((8.9, 9.25))


def test_a_wheel_with_slots_is_no_pin_and_a_shaft_with_a_flat_is_one():
    def rim(gap: float) -> Loop:
        half = math.radians(gap / 2)
        arc = Arc((0.0, 0.0), 10.0, half, math.tau - 2 * half)
        return Loop((arc, Line(arc.end, arc.start)))

    assert is_convex(rim(60))
    wheel = rim(60).segments[0]
    assert not is_convex(Loop((wheel, Line(wheel.end, (0.0, 0.0)), Line((0.0, 0.0), wheel.start))))


@pytest.mark.parametrize(
    ("example", "name"),
    [
        ("geneva-straight", "wheel"),
        ("geneva-straight", "locking-disc"),
        ("cam-lever", "cam"),
        ("elliptic-pair", "gear"),
        ("noncircular-slider", "gear-1"),
    ],
)
def test_fifty_places_of_a_printed_outline_are_where_the_drawing_wants_them(request, example, name):
    """The print is the mesh that grows by the printer's deviations: it comes back to the drawing."""
    part = parts_of(example, request)[name]
    made = compensated(part, PrintSettings(), PRINTER)
    mesh = printed_mesh(made, PRINTER, on_top=False, correct=True)
    walls = shapely.boundary(section(mesh, part.thickness * 0.6))
    segments = part.outline.outer.segments
    slots = {k for run in open_slots(part.outline.outer) for k in run}
    assert bool(slots) == (name == "wheel")
    share = np.linspace(0.15, 0.85, max(2, math.ceil(PLACES / len(segments))))
    count, worst = 0, 0.0
    for number, segment in enumerate(segments):
        rate = segment.derivative(share)
        outwards = np.column_stack((rate[:, 1], -rate[:, 0])) / np.hypot(*rate.T)[:, None]
        back = OFF.slot / 2 if number in slots else -OFF.wall / 2
        there = mesh.moved(np.column_stack((segment.at(share) + back * outwards, np.zeros(len(share)))))
        off = shapely.distance(walls, shapely.points(there[:, :2]))
        count, worst = count + len(off), max(worst, float(off.max()))
    assert count >= PLACES
    assert worst < CHORD


def test_the_slot_of_a_geneva_wheel_comes_out_as_wide_as_drawn(request):
    part = parts_of("geneva-straight", request)["wheel"]
    run = open_slots(part.outline.outer)[0]
    drawn = [part.outline.outer.segments[k] for k in run]
    moved = [compensated(part, PrintSettings(), PRINTER).model.outline.outer.segments[k] for k in run]

    def width(slot):
        one, two = (np.array(side.start) for side in (slot[0], slot[-1]))
        x, y = np.subtract(slot[0].end, slot[0].start) / math.dist(slot[0].end, slot[0].start)
        return abs(float(x * (two - one)[1] - y * (two - one)[0]))

    assert width(moved) + OFF.slot == pytest.approx(width(drawn), abs=1e-6)
    assert moved[1].radius * 2 + OFF.slot == pytest.approx(drawn[1].radius * 2, abs=1e-6)


def test_bores_of_a_spherical_link_are_corrected_and_the_rest_is_told(request):
    part = parts_of("spherical-crank-rocker", request)["crank"]
    made = compensated(part, PrintSettings(), PRINTER)
    kinds = {hole.name: hole.kind for hole in made.holes}
    assert kinds == {"a0": "snug", "a": "press"}
    mesh = printed_mesh(made, PRINTER, on_top=False, correct=True)
    points = mesh.in_part.points
    for bore, hole in zip(part.free_form.bores, made.holes, strict=True):
        axis, start = np.array(bore.axis), np.array(bore.start)
        along = (points - start) @ axis
        off = np.linalg.norm(points - start - along[:, None] * axis, axis=1)
        near = (along > -0.5) & (along < bore.length + 0.5) & (off < bore.diameter / 2 + 0.5)
        radius = (hole.target - OFF.hole) / 2
        assert near.sum() > 20
        assert off[near] == pytest.approx(radius, abs=2e-3)


def test_what_is_not_corrected_of_a_free_form_is_told_by_name(request, tmp_path):
    host = open_host()
    build = Build(load(request.config.rootpath / "examples/spherical-crank-rocker.toml", host), host)
    job = build.made(PrintJob)
    for name, told in (("crank", True), ("base", False)):
        part = build.parts[name]
        one = JobPart(compensated(part, job.settings, job.printer), on_top=False)
        found = list(form_rule(job, one))
        assert bool(found) == told
        if told:
            assert found[0].message.startswith("crank is of free form: its bores a0, a are corrected")
            # one axis stands upright on the bed where the crank lies on its boss, the other leans by its arc
            axes = {bore.name: np.array(bore.axis) for bore in part.free_form.bores}
            up = job.mesh_of(one).to_bed[2]
            lean = {
                name: math.degrees(math.acos(min(1.0, abs(float(axis @ up))))) for name, axis in axes.items()
            }
            assert level_bores(job, one) == [name for name, angle in lean.items() if angle > 45]
