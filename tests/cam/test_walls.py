"""The deviation along walls: known offsets, a planted cut, corners, and the picture of all that."""

import math
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from by_control import posted, prove, scene_of, setup_html
from planning_parts import job
from shop import BIAS, HALF_X, HALF_Y, plate_job, plate_program

from mechwright.contracts.part import Part, Pocket, Profile
from mechwright.geometry import Loop, Outline
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.pages.setup_sheet.walls import exaggeration, walls_view
from mechwright_cam.planning import plan
from mechwright_cam.proof.walls import wall_deviation
from mechwright_cam.shop.settings import CamSettings

ANGLE = Loop.polygon([(-30, -20), (30, -20), (30, 0), (5, 0), (5, 20), (-30, 20)])
SQUARE = Loop.polygon([(-24, -14), (-8, -14), (-8, 6), (-24, 6)])


def measured(bias=BIAS):
    return wall_deviation(
        scene_of(LinuxCnc().write(plate_program(bias=bias)), plate_job()).sweeps, plate_job()
    )


@cache
def angle():
    """A plate with sharp inner corners, its program, and what was found along its walls."""
    machined = (Pocket("pocket", SQUARE, (), 0, 3), Profile("outside", ANGLE, "outside", 0, 6))
    of = job(Part("angle", Outline(ANGLE), 6.0, "aluminium", machined=machined), "mill-6", "mill-4")
    program = plan(of)
    text = posted(of, program)
    return of, program, text, wall_deviation(scene_of(text, of).sweeps, of)


@pytest.mark.parametrize("bias", [0.001, 0.003, -0.002])
def test_a_path_that_keeps_off_by_a_bias_is_off_by_that_everywhere(bias):
    walls = measured(bias)
    assert len(walls.off) > 3000
    assert walls.off == pytest.approx(bias, abs=6e-4)  # chords of the outline's round corners
    assert not walls.corner.any()
    assert bool(walls.left) == (bias > 0)
    assert bool(walls.cut) == (bias < 0)
    assert np.hypot(*walls.outward.T) == pytest.approx(1.0)


def test_the_worst_cut_is_where_it_was_planted():
    text = LinuxCnc().write(plate_program())
    lines = text.splitlines()
    # The last pass along the right side comes 4 µm nearer at its end.
    edge = f"X{HALF_X + 3 + BIAS:.4f}".rstrip("0")
    last = max(i for i, line in enumerate(lines) if edge in line and line.startswith("G2"))
    assert prove(text, plate_job()).ok
    below = next(i for i in range(last + 1, len(lines)) if lines[i].startswith(("G1", "Y")))
    lines.insert(below, f"G1 X{HALF_X + 3 - 0.004:.4f}")
    lines.insert(below + 1, f"G1 X{HALF_X + 3 + BIAS:.4f}")
    walls = wall_deviation(scene_of("\n".join(lines), plate_job()).sweeps, plate_job())
    worst = walls.cut[0]
    assert worst.off == pytest.approx(-0.004, abs=2e-4)
    assert worst.x == pytest.approx(HALF_X, abs=0.01)
    assert abs(worst.y) < HALF_Y - 7


def test_corners_are_told_from_stock_within_reach():
    of, _, text, walls = angle()
    proof = prove(text, of)
    assert len(walls.corners) == 5  # four of the pocket, one of the outside
    # A disc of 2 mm stays (√2 - 1) r away from a right corner, and touches the walls r before it.
    for place in walls.corners:
        assert place.off == pytest.approx((math.sqrt(2) - 1) * 2.0, abs=0.03)
    at = {(round(place.x), round(place.y)) for place in walls.corners}
    assert at == {(-24, -14), (-24, 6), (-8, -14), (-8, 6), (5, 0)}
    assert walls.left[0].off == pytest.approx(proof.leftover_reachable_max_mm, abs=1.5e-3)
    assert {place.z for place in walls.corners} == {-3.0, -4.5}  # that of the outside is beside a tab


def test_places_listed_are_plain_data_of_the_proof():
    walls = angle()[3]
    data = walls.as_dict()
    assert set(data) == {"places", "left", "cut", "corners"}
    assert data["places"] == len(walls.off)
    assert data["left"][0] == {
        "x": round(walls.left[0].x, 4),
        "y": round(walls.left[0].y, 4),
        "z": walls.left[0].z,
        "off_mm": round(walls.left[0].off, 4),
    }
    assert [row["off_mm"] for row in data["left"]] == sorted(
        (r["off_mm"] for r in data["left"]), reverse=True
    )


def test_a_program_that_cuts_nothing_leaves_all():
    walls = wall_deviation(scene_of("G21 G90\nM30\n", plate_job()).sweeps, plate_job())
    assert len(walls.off) == 0 or walls.off.min() >= 0
    assert walls.cut == ()


def test_the_picture_exaggerates_by_round_numbers_and_marks_the_worst():
    of, program, _, walls = angle()
    view = walls_view(walls, of)
    assert view == walls_view(walls, of)
    assert view.count("<circle") == 3 + 3
    assert view.count("stroke-dasharray") == 3  # corners are dashed
    assert f"1: {walls.left[0].off:+.4f}" in view
    # The bar of the scale stands below the part, between its two ends, and all of it is in the picture.
    x, top, end = map(float, re.search(r'M([-\d.]+),[-\d.]+V([-\d.]+)H([-\d.]+)V[-\d.]+"', view).groups())
    left, high, width, height = map(float, re.search(r'viewBox="([^"]+)"', view)[1].split())
    assert left < x < end < left + width
    assert 20.0 < top < high + height
    from mechwright_cam.pages.picture import Frame

    small, large = (exaggeration(walls, Frame(0, 0, size, size)) for size in (50.0, 500.0))
    assert large == pytest.approx(10 * small)
    assert f"{small:.0f}"[0] in "125"
    page = setup_html(
        of,
        program,
        {"ok": True, "walls": walls.as_dict(), "simulation": {"air_mm": 1, "feed_mm": 2}},
        deviation=view,
    )
    assert view in page
    assert "cut into the part" not in page.split("<h2>What the proof found</h2>")[1].split("<table>")[1]
    bare = setup_html(of, program, {"ok": True})
    assert "The walls after the program" in page
    asked = "cut at most {} mm too deep and to leave at most\n{} mm"
    assert asked.format(0.001, 0.004) in page
    wide = replace(
        of,
        settings=CamSettings.model_validate({"path": {"inner_tolerance": 0.003, "outer_tolerance": 0.008}}),
    )
    assert asked.format(0.003, 0.008) in setup_html(wide, program, {"ok": True}, deviation=view)
    assert "The walls after the program" not in bare


def test_a_cut_into_the_part_is_drawn_black_and_inwards():
    inwards = walls_view(measured(-0.002), plate_job())
    outwards = walls_view(measured(0.002), plate_job())
    assert 'fill="#000000"' in inwards
    assert 'fill="#e69f00"' not in inwards
    assert 'fill="#000000"' not in outwards
    assert 'fill="#e69f00"' in outwards
