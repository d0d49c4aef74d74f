"""Parts as their programs leave them: known offsets, holes, witness lines, corners, nests, undersides."""

import io
import re
from dataclasses import replace

import ezdxf
import numpy as np
import pytest
import shapely
from by_control import BY_NAME, LINUXCNC, posted, scene_of
from planning_parts import job
from shop import BORE, CORNER, HALF_X, HALF_Y, plate_job, plate_program, rounded_box

from mechwright.contracts.as_made import MadeCurve
from mechwright.contracts.finding import Severity, Stage
from mechwright.contracts.made_part import MadeHole
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.as_made import not_closed
from mechwright_cam.pages.as_made.drawing import as_made_drawing
from mechwright_cam.pages.as_made.picture import as_made_picture, exaggeration
from mechwright_cam.pages.as_made.plot import plot
from mechwright_cam.planning import plan
from mechwright_cam.proof.as_made_parts import parts_as_made
from mechwright_cam.proof.rings import circle_ring
from mechwright_cam.proof.scene import in_work
from mechwright_plane.nest import Placed, make_nest

ANGLE = Loop.polygon([(-30, -20), (30, -20), (30, 0), (5, 0), (5, 20), (-30, 20)])


def made(text, of, control=LINUXCNC):
    return parts_as_made(scene_of(text, of, control))


@pytest.mark.parametrize("bias", [0.001, 0.004, -0.002])
def test_walls_stand_where_the_path_ends_them(bias):
    (part,) = made(LINUXCNC.write(plate_program(bias=bias)), plate_job())
    assert len(part.off) > 3000
    assert part.off == pytest.approx(bias, abs=6e-4)  # from the chords of the round corners
    exact = shapely.Polygon(rounded_box(HALF_X, HALF_Y, CORNER).flatten(1e-6)).exterior
    outside = max(part.outline.rings, key=lambda ring: ring.area)
    away = shapely.distance(exact, shapely.points(outside.points))
    assert away == pytest.approx(abs(bias), abs=3e-5)
    x0, y0, x1, y1 = part.outline.polygon().bounds
    assert (-x0, -y0, x1, y1) == pytest.approx((HALF_X + bias, HALF_Y + bias) * 2, abs=1e-5)
    grown = part.outline.polygon(more=0.01)
    assert grown.bounds == pytest.approx((x0 - 0.01, y0 - 0.01, x1 + 0.01, y1 + 0.01), abs=1e-5)


def test_a_bore_is_followed_on_its_circle_and_fitted():
    (part,) = made(LINUXCNC.write(plate_program(bias=0.001)), plate_job())
    hole = part.hole_at(0.0, 0.0, BORE)
    assert (hole.x, hole.y) == pytest.approx((0.0, 0.0), abs=1e-5)
    assert hole.diameter == pytest.approx(BORE - 0.002, abs=1e-4)
    assert hole.least <= hole.diameter
    assert hole.round < 1e-4
    assert part.hole_at(10.0, 0.0, BORE) is None
    assert part.hole_at(0.0, 0.0, BORE / 2) is None


def test_the_corridor_is_how_far_the_control_may_be_off_the_path():
    text = LINUXCNC.write(plate_program())
    (part,) = made(text, plate_job())
    scene = scene_of(text, plate_job())
    assert part.corridor == pytest.approx(scene.motion.off[in_work(scene)].max())
    assert 0.0005 < part.corridor < 0.005
    haas = BY_NAME["haas"]
    (exact,) = made(haas.write(plate_program()), plate_job(control="haas"), haas)
    assert exact.corridor == 0


def test_what_leaves_stock_is_no_part_of_the_corridor():
    machined = (Profile("outside", ANGLE, "outside", 0, 6),)
    of = job(Part("angle", Outline(ANGLE), 6.0, "aluminium", machined=machined), "mill-6")
    text = posted(of)
    scene = scene_of(text, of)
    (part,) = parts_as_made(scene)
    assert "P0.02 " in text
    assert scene.motion.off[in_work(scene)].max() > 0.015
    assert 0 < part.corridor < 0.005


def test_a_loose_pass_beside_the_wall_counts_by_what_it_may_cut_of_it():
    """It makes the wall, or may cut it by less than it is off, or not at all, though it is near."""
    machined = (Profile("outside", ANGLE, "outside", 0, 6),)
    of = job(Part("angle", Outline(ANGLE), 6.0, "aluminium", machined=machined), "mill-6")
    text = posted(of)
    lines = text.splitlines()
    end = lines.index("M9")

    def beside(left):
        """The corridor with a pass that leaves so much, and how far that is off."""
        y = -23 - left
        cut = ["G64 P0.02 Q0", "G0 Z5", "G0 X-20 Y-30", "G1 Z-6.2 F100", "G1 X-21 F600", f"G1 Y{y:.4f}"]
        loose = "\n".join([*lines[:end], *cut, "G1 X20", "G1 Y-30", "G0 Z5", *lines[end:]])
        scene = scene_of(loose, of)
        (part,) = parts_as_made(scene)
        along = scene.run.cutting & (np.abs(scene.run.end[:, :2] - (20, y)) < 1e-9).all(axis=1)
        return part.corridor, float(scene.motion.off[along].max())

    before = made(text, of)[0].corridor
    assert before < 0.005
    for left, counts in ((0.005, 0.0), (0.015, 0.01), (0.023, None), (0.028, None)):
        found, off = beside(left)
        assert 0.0195 < off < 0.0225
        assert found == pytest.approx(before if counts is None else off - counts, abs=1e-6)


def test_a_pass_on_a_line_of_its_own_leaves_a_witness_line():
    machined = (Profile("outside", ANGLE, "outside", 0, 6),)
    of = job(Part("angle", Outline(ANGLE), 6.0, "aluminium", machined=machined), "mill-6")
    text = LINUXCNC.write(plan(of))
    (part,) = made(text, of)
    assert all(line.step < 0.003 for line in part.witnesses)
    lines = text.splitlines()
    # One pass at half the depth that cuts 4 µm deeper into the lower edge.
    cut = [
        "G0 Z5",
        "G0 X-20 Y-30",
        "G1 Z-3 F100",
        "G1 Y-22.996 F300",
        "G1 X20 Y-22.996",
        "G1 Y-30",
        "G0 Z5",
    ]
    end = max(i for i, line in enumerate(lines) if line.startswith("M5") or "M5 " in line or line == "M9")
    (stepped,) = made("\n".join(lines[:end] + cut + lines[end:]), of)
    (line,) = [one for one in stepped.witnesses if one.step > 0.004]
    assert line.depth == pytest.approx(3.0)
    assert line.step == pytest.approx(0.004 + np.median(part.off), abs=5e-4)
    assert line.at[1] == pytest.approx(-20.0, abs=0.01)
    assert stepped.off == pytest.approx(part.off)  # at the foot nothing has changed


def test_corners_that_no_cutter_enters_are_in_the_outline_and_marked():
    machined = (Profile("outside", ANGLE, "outside", 0, 6),)
    of = job(Part("angle", Outline(ANGLE), 6.0, "aluminium", machined=machined), "mill-6")
    (part,) = made(LINUXCNC.write(plan(of)), of)
    (outside,) = part.outline.rings
    assert 0 < outside.corner.sum() < 0.1 * outside.corner.size
    left = part.outline.polygon().area - of.target.area
    assert left == pytest.approx(
        (1 - np.pi / 4) * 9 + part.off.mean() * outside.points.shape[0] * 0.05, abs=0.1
    )
    assert np.abs(part.off).max() < 0.004


def test_recesses_have_a_section_of_their_own():
    hole = Loop.polygon([(-20, -14), (-8, -14), (-8, 6), (-20, 6)])
    machined = (Pocket("pocket", hole, (), 0, 3), Profile("outside", ANGLE, "outside", 0, 6))
    of = job(Part("angle", Outline(ANGLE), 6.0, "aluminium", machined=machined), "mill-6", "mill-4")
    (part,) = made(LINUXCNC.write(plan(of)), of)
    assert [(round(s.top, 6), round(s.bottom, 6), len(s.rings)) for s in part.sections] == [
        (0, 3, 2),
        (3, 6, 1),
    ]
    assert len(part.section(1.0).rings) == 2
    assert part.section(9.0) is part.outline


def test_an_outline_that_no_program_closes_is_a_finding_with_the_limit():
    text = LINUXCNC.write(plate_program())
    lines = text.splitlines()
    last = max(i for i, line in enumerate(lines) if line.startswith(("G2", "G3")))
    first = max(i for i in range(last) if "Z-" in lines[i])
    (part,) = made("\n".join(lines[:first] + lines[last + 1 :]), plate_job())
    (finding,) = not_closed(part)
    assert (finding.severity, finding.stage, finding.limit) == (Severity.ERROR, Stage.OUTPUT, 0.01)
    assert "no closed outline" in finding.message
    assert "limit is 0.01 mm" in finding.message
    assert not not_closed(made(text, plate_job())[0])


def test_copies_of_a_nest_come_back_in_their_own_coordinates():
    bore = Loop((circle((0, 0), 4.0, clockwise=True),))
    machined = (Bore("bore", (0.0, 0.0), 8.0, 0, 6), Profile("outside", ANGLE, "outside", 0, 6))
    part = Part("angle", Outline(ANGLE, (bore,)), 6.0, "aluminium", machined=machined)
    placed = (Placed(part, "angle no 1", 0, 0), Placed(part, "angle no 2", 20, 90, np.pi / 2))
    of = job(make_nest("nest", placed, 10.0), "mill-6")
    one, two = made(LINUXCNC.write(plan(of)), of)
    assert [one.label, two.label] == ["angle no 1", "angle no 2"]
    for copy in (one, two):
        assert copy.name == "angle"
        assert len(copy.outline.rings) == 2
        assert copy.outline.polygon().symmetric_difference(Outline(ANGLE, (bore,)).polygon()).area < 3.0
        hole = copy.hole_at(0.0, 0.0, 8.0)
        assert (hole.x, hole.y) == pytest.approx((0, 0), abs=1e-4)


def test_the_drawing_has_nominal_and_both_bounds_on_layers():
    (part,) = made(LINUXCNC.write(plate_program(bias=0.001)), plate_job())
    document = ezdxf.read(io.StringIO(as_made_drawing(part).decode()))
    outer = {}
    for layer in ("MADE", "MADE-MOST", "MADE-LEAST", "TARGET"):
        rings = [
            shapely.Polygon(line.vertices())
            for line in document.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
        ]
        assert len(rings) == 2
        outer[layer] = max(ring.bounds[2] for ring in rings)
    assert outer["MADE"] == pytest.approx(HALF_X + 0.001, abs=2e-4)
    assert outer["MADE-MOST"] - outer["MADE"] == pytest.approx(part.corridor, abs=2e-4)
    assert outer["MADE"] - outer["MADE-LEAST"] == pytest.approx(part.corridor, abs=2e-4)
    assert outer["TARGET"] == pytest.approx(HALF_X, abs=2e-4)


def test_the_picture_draws_deviations_as_large_as_it_says():
    (part,) = made(LINUXCNC.write(plate_program(bias=0.001)), plate_job())
    picture = as_made_picture(part)
    factor = exaggeration(part, 2 * HALF_X)
    assert f"{factor:,.0f} : 1".replace(",", " ") in picture
    assert 0.2 < factor * (0.001 + part.corridor) / (0.025 * 2 * HALF_X) <= 1.0
    x, _, width, _ = map(float, re.search(r'viewBox="([^"]+)"', picture)[1].split())
    assert x < -HALF_X
    assert x + width / 2 == pytest.approx(0, abs=0.01)


def test_a_circle_fits_whatever_stretch_of_it_there_is():
    ring = circle_ring((3.0, -2.0), 5.0)
    some = ring.points[: len(ring.points) * 2 // 3]
    hole = MadeHole.of(some)
    assert (hole.x, hole.y, hole.diameter) == pytest.approx((3.0, -2.0, 10.0), abs=1e-9)


def test_two_runs_give_the_same_bytes():
    text = LINUXCNC.write(plate_program(bias=0.001))
    assert as_made_drawing(made(text, plate_job())[0]) == as_made_drawing(made(text, plate_job())[0])
    assert replace(made(text, plate_job())[0], label="x").label == "x"


def test_a_plot_of_an_input_that_turns_backwards():
    turned, off = np.array([0.0, -40.0, -130.0]), np.array([1.0, 4.0, 2.0])
    backwards = plot(MadeCurve("Error", "input, degrees", "µrad", turned, {"as made": off}))
    assert '"M170,-15.5L117.69,-62L0,-31"' in backwards
    assert {"-100", "-50", "0"} <= set(re.findall(r">([-\d]+)<", backwards))


def test_a_whole_turn_has_a_mark_every_quarter_and_each_line_its_legend_above():
    x = np.linspace(0.0, 360.0, 73)
    lines = {name: np.sin(np.radians(x)) * size for name, size in (("as made", 0.3), ("drawn", 0.2))}
    drawn = plot(MadeCurve("Error", "input, degrees", "mm", x, lines))
    marks = re.findall(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>(\d+)<', drawn)
    assert [(float(at), words) for at, _, words in marks] == [(n * 170 / 4, f"{90 * n}") for n in range(5)]
    legends = [
        (float(at), words) for at, words in re.findall(r'<text x="([\d.]+)"[^>]*>([\w ]+, mm)<', drawn)
    ]
    assert legends == [(12.0, "as made, mm"), (97.0, "drawn, mm")]
    left, _, width, _ = map(float, re.search(r'viewBox="([^"]+)"', drawn)[1].split())
    scale = re.findall(r'<text x="(-[\d.]+)"[^>]*>[−\d.]+<', drawn)
    assert scale
    assert all(left < float(at) < 0 for at in scale)
    assert left + width > 170


def test_an_input_that_turns_backwards_is_plotted_as_one_that_turns_forwards():
    x, y = np.linspace(-30.0, 0.0, 31), np.linspace(0.0, 2.0, 31)
    there, back = (
        plot(MadeCurve("play", "angle, deg", "mm", x[::way], {"drawn": y[::way]})) for way in (1, -1)
    )
    assert sorted(re.findall(r"<text[^>]*>([^<]*)<", there)) == sorted(
        re.findall(r"<text[^>]*>([^<]*)<", back)
    )
    assert ">-30<" in back
