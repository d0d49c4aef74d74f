"""Solids are their outlines, extruded; what is not is refused."""

import math
from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plate_shapes import (
    PLATES,
    WAVE_HEIGHT,
    WAVE_RADIUS,
    rounded_rectangle,
    slotted_plate,
    turning,
    wavy,
    wavy_part,
    wavy_plate,
)
from step_read import top_face

from mechwright.contracts.part import Instance, Part
from mechwright.errors import GeometryError
from mechwright.geometry import BSpline, Line, Loop, Outline, circle
from mechwright_cad.solids import solid as solids
from mechwright_cad.solids.solid_check import check_plate, check_solid, top_area
from mechwright_cad.solids.wires import extruded


@pytest.mark.parametrize("name", PLATES)
def test_plate_is_its_outline(name):
    outline = PLATES[name]()
    solid = solids.plate(outline, 7.5)
    segments = sum(len(loop.segments) for loop in outline.loops)
    assert solid.isValid()
    assert len(solid.Faces()) == segments + 2
    assert len(solid.Edges()) == 3 * segments
    assert len(solid.Vertices()) == 2 * segments
    assert top_area(top_face(solid)) == pytest.approx(outline.area, rel=1e-8)
    box = solid.BoundingBox()
    assert (box.zmin, box.zmax) == pytest.approx((0, 7.5), abs=1e-6)


def test_area_of_the_wave_is_that_of_the_formula():
    solid = solids.plate(Outline(wavy()), 1.0)
    exact = math.pi * (WAVE_RADIUS**2 + WAVE_HEIGHT**2 / 2)
    assert top_area(top_face(solid)) == pytest.approx(exact, rel=1e-6)


@settings(max_examples=20, deadline=None)
@given(
    width=st.floats(5, 300),
    height=st.floats(5, 300),
    corner=st.floats(0.05, 0.45),
    bore=st.floats(0.05, 0.45),
    thickness=st.floats(0.1, 50),
)
def test_rounded_plate_with_bore_has_the_volume_of_the_formula(width, height, corner, bore, thickness):
    least = min(width, height)
    radius, hole = corner * least, bore * least
    outline = Outline(
        rounded_rectangle(width, height, radius), (Loop((circle((0, 0), hole, clockwise=True),)),)
    )
    area = width * height - (4 - math.pi) * radius**2 - math.pi * hole**2
    assert solids.plate(outline, thickness).Volume() == pytest.approx(area * thickness, rel=1e-9)


@pytest.mark.parametrize("thickness", [0.0, -1.0, math.nan, math.inf])
def test_thickness_that_is_none_is_refused(thickness):
    with pytest.raises(GeometryError, match="thickness above 0"):
        solids.plate(slotted_plate(), thickness)


def test_outline_that_cuts_itself_is_refused():
    loop = Loop.polygon([(0, 0), (10, 0), (10, 10), (4, -3), (0, 10)])
    with pytest.raises(GeometryError, match="cuts itself"):
        solids.plate(Outline(loop), 5)


def test_opening_that_crosses_the_outside_is_refused():
    hole = Loop((circle((29, 0), 5, clockwise=True),))
    with pytest.raises(GeometryError, match="cuts itself"):
        solids.plate(Outline(rounded_rectangle(60, 40, 5), (hole,)), 5)


def test_reversed_end_tangent_is_refused():
    """The kernel calls this solid valid, and divides such into millions of triangles."""
    curve = BSpline.bezier([(0, 0), (13, -1), (27, -1), (40.001, -0.0001), (40, 0)], "flank")
    loop = Loop((curve, Line((40, 0), (40, 30)), Line((40, 30), (0, 30)), Line((0, 30), (0, 0))))
    assert extruded(Outline(loop), 5.0).isValid()
    with pytest.raises(GeometryError, match=r"the flank segment near .* turns back on itself"):
        solids.plate(Outline(loop), 5)


def test_gate_holds_the_solid_against_its_outline():
    outline = wavy_plate()
    solid = solids.plate(outline, 8.0)
    check_plate(solid, outline, 8.0)
    with pytest.raises(GeometryError, match=r"has 0 faces at z = 8.1"):
        check_plate(solid, outline, 8.1)
    with pytest.raises(GeometryError, match="has 43 faces; its outline gives 42"):
        check_plate(solid, replace(outline, inner=outline.inner[:1]), 8.0)
    with pytest.raises(GeometryError, match=r"size differs from the outline's by 0.002 mm"):
        check_plate(solid, outline.moved(0.002, 0), 8.0)
    smaller_hole = (outline.inner[0], Loop((circle((0, 20), 3.99, clockwise=True),)))
    with pytest.raises(GeometryError, match=r"-0.0001 apart, limit 1e-06"):
        check_plate(solid, replace(outline, inner=smaller_hole), 8.0)
    other_place = (outline.inner[0], Loop((circle((0, 19.999), 4, clockwise=True),)))
    with pytest.raises(GeometryError, match=r"edge at .* is 0.001 mm off its segment"):
        check_plate(solid, replace(outline, inner=other_place), 8.0)


def test_gate_counts_triangles(monkeypatch):
    outline = wavy_plate()
    solid = extruded(outline, 8.0)
    check_plate(solid, outline, 8.0)
    monkeypatch.setattr("mechwright_cad.solids.solid_check.SURPLUS", 0.01)
    with pytest.raises(GeometryError, match="triangles, limit"):
        check_plate(solid, outline, 8.0)


def test_part_built_as_a_solid():
    part = Part("ball", None, 0.0, "steel", build=lambda: cq.Solid.makeSphere(5.0, angleDegrees1=-90))
    assert solids.part_solid(part).Volume() == pytest.approx(4 / 3 * math.pi * 125)
    assert solids.part_solid(part) is solids.part_solid(part)


@pytest.mark.parametrize(
    ("build", "reason"),
    [
        (lambda: cq.Workplane().box(1, 1, 1), "a solid is wanted, not Workplane"),
        (lambda: cq.Solid.makeBox(1, 1, 1).faces("<Z"), "a solid is wanted, not Face"),
        (lambda: cq.Solid(cq.Solid.makeBox(1, 1, 1).wrapped.Reversed()), "inside out"),
    ],
)
def test_part_that_builds_no_right_solid_is_named(build, reason):
    part = Part("odd", None, 0.0, "steel", build=build)
    with pytest.raises(GeometryError, match=f"part odd: .*{reason}"):
        solids.part_solid(part)


def test_check_solid_refuses_an_open_shell():
    faces = cq.Solid.makeBox(1, 1, 1).Faces()[:5]
    with pytest.raises(GeometryError, match=r"invalid|not above 0"):
        check_solid(cq.Solid.makeSolid(cq.Shell.makeShell(faces)))


def test_assembly_stands_in_the_poses_of_the_motion():
    part, motion = wavy_part(), turning()
    whole = solids.assembly("pair", [part], motion, 3)
    assert [child.name for child in whole.children] == ["driver", "driven"]
    assert whole.children[0].color.toTuple()[:3] == pytest.approx(part.colour)
    body = np.array([[10.0, 2.0, 4.0]])
    for child, z in zip(whole.children, (0.0, 1.5), strict=True):
        wanted = motion.poses[child.name].transform(np.add(body, (0, 0, z)))[3, 0]
        found = cq.Vertex.makeVertex(*body[0]).located(child.loc).toTuple()
        assert found == pytest.approx(tuple(wanted), abs=1e-12)


def test_two_parts_on_one_body_have_names_of_their_own():
    a = replace(wavy_part("wheel"), instances=(Instance("driver"), Instance("driver", 20.0)))
    b = replace(wavy_part("hub"), instances=(Instance("driver", 8.0),))
    whole = solids.assembly("stack", [a, b], turning())
    assert [child.name for child in whole.children] == ["driver-wheel", "driver-wheel-2", "driver-hub"]


def test_assembly_names_what_the_motion_lacks():
    part = replace(wavy_part(), instances=(Instance("idler"),))
    with pytest.raises(GeometryError, match=r"part wheel .* 'idler', .* it has driven, driver"):
        solids.assembly("pair", [part], turning())
    with pytest.raises(GeometryError, match="5 samples; there is no sample 5"):
        solids.assembly("pair", [wavy_part()], turning(), 5)
