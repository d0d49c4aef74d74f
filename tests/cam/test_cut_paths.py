"""Ways of a beam in closed form: parallels, leads, overcuts, micro-joints, order."""

import math

import numpy as np
import pytest
import shapely
from cut_sheets import copies, plate, sheet_of, toothed
from hypothesis import given
from hypothesis import strategies as st
from planning_parts import bore, lobes, rounded_box

from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Loop
from mechwright_cut.jobs import PIERCE, target
from mechwright_cut.paths.order import contours
from mechwright_cut.paths.parallels import beam_path

SQUARE = Loop.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])


@given(st.floats(0.5, 40), st.floats(0.05, 0.45), st.booleans())
def test_a_circle_keeps_its_centre_and_is_exact(radius, kerf, outside):
    loop = bore(2 * radius)
    path = beam_path(loop if not outside else loop.reversed(), kerf, outside, "disc")
    assert path.length == pytest.approx(math.tau * (radius + (kerf if outside else -kerf) / 2), abs=1e-6)
    assert {cut.turn for cut in path.cuts} == {-1 if outside else 1}, "the wall is on the right"
    assert path.closed


@given(st.floats(0.05, 1.5))
def test_around_a_square_the_beam_turns_on_its_corners(kerf):
    """4 a + π k outside, where it runs about the corners; 4 (a - k) inside."""
    assert beam_path(SQUARE, kerf, True, "s").length == pytest.approx(40 + math.pi * kerf, abs=0.02)
    assert beam_path(SQUARE.reversed(), kerf, False, "s").length == pytest.approx(4 * (10 - kerf), abs=0.02)


@given(
    st.floats(6, 60), st.floats(6, 40), st.floats(0.05, 0.9), st.floats(0.1, 0.45), st.floats(0, 2 * math.pi)
)
def test_every_point_of_the_way_is_half_a_kerf_off(width, height, kerf, share, turned):
    loop = rounded_box(width, height, share * min(width, height)).moved(3, -2, turned)
    path = beam_path(loop, kerf, True, "box")
    ring = shapely.LinearRing(loop.flatten())
    off = shapely.distance(shapely.points(path.points(0.2)), ring)
    assert np.abs(off - kerf / 2).max() < 0.004


def test_arcs_stay_arcs():
    path = beam_path(rounded_box(60, 40, 6), 0.2, True, "box")
    radii = [math.dist(here, (cut.cx, cut.cy)) for here, cut, _ in path.walk() if cut.turn]
    assert len(path.cuts) <= 10
    assert radii == pytest.approx([6.1] * len(radii), abs=0.003)


@pytest.mark.parametrize(
    ("loop", "outside", "said"),
    [
        (bore(0.4), False, "as wide as the hole of 0.4 mm"),
        (rounded_box(8, 0.45, 0.1, clockwise=True), False, "wider than it, or a slot in it"),
        (
            Loop.polygon([(0, 0), (10, 0), (10, 5.2), (3, 5.2), (3, 5.5), (10, 5.5), (10, 10), (0, 10)]),
            True,
            r"wider than the slot at \(3.00, 5.\d0\)",
        ),
    ],
)
def test_a_kerf_that_is_wider_than_a_slot_is_refused(loop, outside, said):
    with pytest.raises(GeometryError, match=said):
        beam_path(loop, 0.5, outside, "part")


def test_marks_come_first_then_openings_then_outsides_small_before_large():
    small, large = plate("small", bore(5), size=(14, 12, 2)), plate("large", bore(6), bore(4, (8, 0)))
    roles = [(one.role, one.name) for one in contours(sheet_of(large, small))]
    assert [role for role, _ in roles] == ["inside"] * 3 + ["outside"] * 2
    assert [name for _, name in roles] == [
        "large opening 2",
        "small opening 1",
        "large opening 1",
        "small outside",
        "large outside",
    ]


def test_alike_contours_follow_each_other_far_apart():
    job = sheet_of(copies(plate("p", size=(12, 10, 2)), 4))
    starts = [one.start for one in contours(job)]
    first = math.dist(starts[0], starts[1])
    assert first == pytest.approx(max(math.dist(starts[0], other) for other in starts[1:]), abs=1e-3)


@pytest.mark.parametrize("lead", [None, 0.5, 3.0])
def test_leads_start_in_the_waste_and_meet_no_flank(lead):
    job = sheet_of(toothed(), plate("plate", bore(8), size=(20, 16, 3)), lead=lead)
    kept = shapely.union_all([target(piece) for piece in job.pieces])
    wheel = next(piece for piece in job.pieces if piece.label == "wheel")
    flanks = shapely.union_all(
        [shapely.LineString(s.flatten(0.01)) for s in wheel.outline.outer.segments if s.tag == "flank"]
    )
    for one in contours(job):
        (path,) = one.strokes
        assert shapely.distance(shapely.Point(path.start), kept) >= PIERCE * job.kerf.width - 1e-3
        foot = path.cuts[0].x, path.cuts[0].y
        assert shapely.distance(shapely.Point(foot), kept) == pytest.approx(job.kerf.width / 2, abs=0.003)
        if one.name == "wheel outside":
            assert shapely.distance(shapely.Point(foot), flanks) > job.kerf.width / 2 + 0.003


def test_the_cut_goes_on_past_its_start():
    plain, past = (contours(sheet_of(plate(), overcut=way))[0] for way in (0.0, 0.8))
    assert past.length - plain.length == pytest.approx(0.8, abs=0.02)


@pytest.mark.parametrize("count", [1, 2, 4])
def test_micro_joints_leave_material_of_their_width(count):
    job = sheet_of(plate(), joints=count, joint_width=0.6)
    (outside,) = contours(job)
    assert len(outside.strokes) == count + 1
    for one, two in zip(outside.strokes, outside.strokes[1:], strict=False):
        assert math.dist(one.end, two.start) == pytest.approx(0.6 + job.kerf.width, abs=0.05)


def test_a_sheet_that_is_too_small_names_one_that_is_not():
    with pytest.raises(DesignError, match=r"do not fit on 90 x 60 mm") as error:
        sheet_of(copies(plate(), 12))
    said = str(error.value).rpartition("set cut.sheet = ")[2]
    length, width = (float(word.split("=")[1].strip(" }")) for word in said.split(","))
    assert sheet_of(copies(plate(), 12), sheet={**job_sheet(), "length": length, "width": width})


def job_sheet():
    return {"margin": 2.0}


def test_a_smooth_part_of_many_corners_becomes_few_moves():
    path = beam_path(lobes(7, 25, 4), 0.2, True, "lobes")
    assert len(path.cuts) < 250
