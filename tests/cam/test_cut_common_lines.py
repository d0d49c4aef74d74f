"""Parts that share straight edges: laid one kerf apart, cut once, and no program with a fault is passed."""

import math
from collections import Counter
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from beam_faults import (
    blocks,
    cut_in_place_of_rapid,
    mark_cut_through,
    mirrored,
    missing_contour,
    never_off,
    no_beam,
    no_end,
    pick,
    rapid_in_place_of_cut,
    shifted_contour,
    swapped_order,
    twice,
    word_wrong,
    wrong_power,
)
from by_night import examples
from cut_sheets import WRITERS, beam, copies, plate, sheet_of, toothed
from hypothesis import given
from hypothesis import strategies as st
from planning_parts import bore, rounded_box

from mechwright.contracts.details import Engraving
from mechwright.contracts.part import Part
from mechwright.errors import DesignError
from mechwright.geometry import Line, Loop, Outline
from mechwright_cut.cutting import question
from mechwright_cut.jobs import PIERCE, target
from mechwright_cut.paths.order import contours
from mechwright_cut.programs.words import moves
from mechwright_cut.proof.judge import prove, slack

WANTED = examples(60, 320)
ROOMY = {"length": 200.0, "width": 150.0, "margin": 2.0}
SQUARE = Part("square", Outline(Loop.polygon([(0, 0), (20, 0), (20, 20), (0, 20)])), 3, "acrylic")
LINK = Part("link", Outline(rounded_box(50, 12, 6), (bore(5, (-19, 0)), bore(5, (19, 0)))), 3, "acrylic")


def sheet(*parts, **said):
    return sheet_of(*parts, **{"common_lines": True, "sheet": ROOMY, **said})


def ways(job):
    return sum(one.length for one in contours(job) if one.role in ("common", "outside"))


@pytest.mark.parametrize("count", [2, 3, 5])
def test_a_shared_side_of_a_square_is_cut_once(count):
    """n squares alone take n (4 a + π k); in a row, n - 1 sides fewer, and a start before each line."""
    job = sheet(copies(SQUARE, count), overcut=0.0)
    kerf, lines = job.kerf.width, [one for one in contours(job) if one.role == "common"]
    leads = sum(one.length - 20 for one in lines)
    assert len(lines) == count - 1
    assert ways(job) - leads == pytest.approx(count * (80 + math.pi * kerf) - (count - 1) * 20, abs=0.02)


@given(st.floats(8, 40), st.floats(8, 40), st.floats(0.05, 0.8), st.integers(2, 6), st.floats(0, math.tau))
def test_neighbours_stand_one_kerf_apart(width, height, kerf, count, turned):
    part = Part("p", Outline(rounded_box(width, height, 1).moved(3, -2, turned)), 3, "acrylic")
    job = sheet(copies(part, count), kerf=kerf, sheet={**ROOMY, "length": 600.0})
    shapes = [target(piece) for piece in job.pieces]
    assert len(job.common) == count - 1
    for one in job.common:
        first, second = (shapes[number] for number in one.pieces)
        assert shapely.distance(first, second) == pytest.approx(kerf, abs=2e-4)
        for shape in (first, second):
            ends = shapely.points(one.whole)
            assert shapely.distance(ends, shape) == pytest.approx([kerf / 2] * 2, abs=2e-4)
    for (a, one), (b, two) in ((x, y) for x in enumerate(shapes) for y in enumerate(shapes) if x[0] < y[0]):
        if not any(set(line.pieces) == {a, b} for line in job.common):
            assert shapely.distance(one, two) > kerf, "all others have room between them"


def test_a_row_ends_where_the_sheet_does():
    job = sheet(copies(SQUARE, 6), sheet={"length": 80.0, "width": 60.0, "margin": 2.0})
    assert len(job.common) == 4, "two rows of three"


def test_a_sheet_that_is_too_small_for_rows_names_one_that_is_not():
    with pytest.raises(DesignError, match="do not fit on 40 x 40 mm") as error:
        sheet(copies(SQUARE, 6), sheet={"length": 40.0, "width": 40.0})
    said = str(error.value).rpartition("set cut.sheet = ")[2]
    length, width = (float(word.split("=")[1].strip(" }")) for word in said.split(","))
    assert sheet(copies(SQUARE, 6), sheet={"length": length, "width": width})


def flanked():
    """A plate both of whose long sides are flanks."""
    loop = rounded_box(40, 12, 2)
    tagged = [Line(s.start, s.end, "flank") if isinstance(s, Line) else s for s in loop.segments]
    return Part("rack", Outline(Loop(tuple(tagged))), 3, "acrylic")


@pytest.mark.parametrize("part", [toothed(), flanked(), plate("short", size=(6, 6, 2))])
def test_what_works_or_is_short_is_not_shared(part):
    assert sheet(copies(part, 3)).common == ()


def test_without_the_key_nothing_is_shared():
    assert sheet_of(copies(SQUARE, 3), sheet=ROOMY).common == ()


@pytest.mark.parametrize(
    ("length", "shared"), [(20, True), (12, True), (33, True), (9.9, False), (41, False)]
)
@pytest.mark.parametrize("control", WRITERS)
def test_parts_share_an_edge_though_they_differ(length, shared, control):
    """Up to twice as long; the line is the longer one, and each part begins and ends on it."""
    other = Part("tab", Outline(rounded_box(length + 2, 6, 1)), 3, "acrylic")
    job = sheet(SQUARE, other)
    assert bool(job.common) == shared
    for one in job.common:
        assert math.dist(*one.whole) == pytest.approx(max(20, length))
        assert math.dist(*one.of(1)) == pytest.approx(min(20, length))
    text, asked = beam(job, control)
    assert prove(text, asked).ok


def test_lines_come_after_openings_and_before_outsides_and_are_pierced_in_the_waste():
    job = sheet(copies(LINK, 4))
    found = contours(job)
    assert [one.role for one in found] == ["inside"] * 8 + ["common"] * 3 + ["outside"] * 4
    kept = shapely.union_all([target(piece) for piece in job.pieces])
    for one in found:
        (first, *_) = one.strokes
        off = shapely.distance(shapely.Point(first.start), kept)
        if one.role == "common":
            assert off >= PIERCE * job.kerf.width - 1e-3
        if one.role == "outside":
            assert one.pierces == 0
            assert off == pytest.approx(job.kerf.width / 2, abs=1e-3)


@pytest.mark.parametrize("control", WRITERS)
def test_only_what_is_pierced_is_waited_for(control):
    text, asked = beam(sheet(copies(LINK, 3), pierce=0.3), control)
    assert prove(text, asked).ok
    assert text.count("G4 P0.3") == 3 * 2 + 2, "openings and common lines"


@cache
def good(control):
    mark = Engraving("mark", (((-5.0, 4.0), (5.0, 4.0)),), 0.1)
    part = plate("plate", bore(5), bore(3, (8, 0)), size=(26, 18, 3), details=(mark,))
    job = sheet(copies(part, 3), toothed(), sheet={"length": 90.0, "width": 90.0, "margin": 2.0})
    return beam(job, control)


def common(lines):
    return [(a, b) for a, b in blocks(lines) if "common line" in lines[a]]


def missing_line(lines, rng):
    """Two parts that hang together."""
    a, b = pick(rng, common(lines))
    return [*lines[:a], *lines[b:]]


def line_after_its_parts(lines, rng):
    """The parts fall as one, and are cut while they are loose."""
    a, b = pick(rng, common(lines))
    end = lines.index("G0 X0 Y0")
    return [*lines[:a], *lines[b:end], *lines[a:b], *lines[end:]]


def shifted_line(lines, rng):
    """Off the middle: one part is cut into, and the other keeps waste."""
    a, b = pick(rng, common(lines))
    places = [line.split()[1:3] for line in lines[a:b] if line.startswith(("G0", "G1 X"))]
    across = "XY"[int(places[0][0] != places[1][0])]
    by = float(rng.choice([-1, 1]) * rng.uniform(0.008, 0.5))
    moved = [
        " ".join(
            f"{across}{float(word[1:]) + by:.4f}" if word[0] == across and k else word
            for k, word in enumerate(line.split())
        )
        if line.startswith(("G0", "G1 X"))
        else line
        for line in lines[a:b]
    ]
    return [*lines[:a], *moved, *lines[b:]]


def short_line(lines, rng):
    """It ends before the parts do, and a bridge stays."""
    a, b = pick(rng, common(lines))
    k = next(k for k in range(a, b) if lines[k].startswith("G1 X"))
    begin = next(line for line in lines[a:b] if line.startswith("G0"))
    share = float(rng.uniform(0.2, 0.9))
    (x0, y0), (x1, y1) = (
        [float(word[1:]) for word in line.split() if word[0] in "XY"] for line in (begin, lines[k])
    )
    rest = lines[k].split()[3:]
    x, y = x0 + share * (x1 - x0), y0 + share * (y1 - y0)
    return [*lines[:k], " ".join(["G1", f"X{x:.4f}", f"Y{y:.4f}", *rest]), *lines[k + 1 :]]


def line_before_the_openings(lines, rng):
    """An outside that is cut before the openings in it, here and there with its lines."""
    return swapped_order(lines, rng)


def begun_beside_the_slot(lines, rng):
    """A cut around a part that begins off the common line: it is pierced on the wall."""
    a, b = pick(rng, [(a, b) for a, b in blocks(lines) if "plate" in lines[a] and "outside" in lines[a]])
    k = next(k for k in range(a, b) if lines[k].startswith("G0"))
    x, y = (float(word[1:]) for word in lines[k].split()[1:3])
    dx, dy = rng.choice([-1, 1], 2) * rng.uniform(0.05, 1.0, 2)
    return [*lines[:k], f"G0 X{x + dx:.4f} Y{y + dy:.4f}", *lines[k + 1 :]]


def around_the_whole_part(lines, rng):
    """A part that is cut around as if it had no neighbour: the line is cut twice, on loose parts."""
    a, b = pick(rng, common(lines))
    end = lines.index("G0 X0 Y0")
    start, goal = (
        next(line for line in lines[a:b] if line.startswith(word)).split()[1:3] for word in ("G0", "G1 X")
    )
    power = next(line for line in lines[a:b] if line.startswith("G1 X")).split()[3:]
    beam_on = [line for line in lines[a:b] if line.startswith(("M3", "M4"))]
    back = [f"G0 {' '.join(goal)}", *beam_on, " ".join(["G1", *start, *power, "F600"]), "M5"]
    return [*lines[:end], *back, *lines[end:]]


def corner_turned(lines, rng):
    """An arc about a corner the other way round; that of a lead would only take more of the waste."""
    a, b = pick(rng, [(a, b) for a, b in blocks(lines) if "plate" in lines[a] and "outside" in lines[a]])
    k = pick(rng, [k for k in range(a, b) if lines[k].startswith(("G2 X", "G3 X"))])
    return [*lines[:k], f"G{5 - int(lines[k][1])}{lines[k][2:]}", *lines[k + 1 :]]


def beam_on_between(lines, rng):
    """The way to a common line or an opening with the beam on; a part may begin where the one before ends."""
    wrong = cut_in_place_of_rapid(list(lines), rng)
    (k,) = [k for k, line in enumerate(lines) if line != wrong[k]][:1]
    before = next(line for line in reversed(lines[:k]) if line.startswith(("G1 X", "G2 X", "G3 X")))
    return None if before.split()[1:3] == lines[k].split()[1:3] else wrong


FAULTS = [
    missing_line,
    line_after_its_parts,
    shifted_line,
    short_line,
    line_before_the_openings,
    begun_beside_the_slot,
    around_the_whole_part,
    missing_contour,
    shifted_contour,
    corner_turned,
    rapid_in_place_of_cut,
    beam_on_between,
    never_off,
    no_beam,
    wrong_power,
    mark_cut_through,
    twice,
    mirrored,
    word_wrong,
    no_end,
]


@pytest.mark.parametrize("control", WRITERS)
def test_no_planted_fault_of_common_lines_is_passed(control):
    text, asked = good(control)
    assert prove(text, asked).ok
    lines, rng = text.splitlines(), np.random.default_rng(11)
    passed, killed = [], Counter()
    for number in range(WANTED // 2):
        fault = FAULTS[number % len(FAULTS)]
        wrong = fault(list(lines), rng)
        if wrong is None or wrong == lines:
            continue
        if prove("\n".join(wrong) + "\n", asked).ok:
            passed.append(
                (fault.__name__, [(a, b) for a, b in zip(lines, wrong, strict=False) if a != b][:2])
            )
        killed[fault.__name__] += 1
    assert passed == []
    assert len(killed) >= 18


def test_a_shared_cut_is_not_passed_where_none_was_wanted():
    """The proof lets runs begin in a cut only where the design has asked for common lines."""
    job = sheet(copies(SQUARE, 2))
    text, asked = beam(job)
    plain = question(sheet_of(copies(SQUARE, 2), sheet=ROOMY), "grbl-laser")
    assert prove(text, asked).ok
    assert "pierces in the waste" in {one.name for one in prove(text, _with(plain, asked)).failures}


def _with(plain, asked):
    return type(plain)(**{**vars(asked), "common": plain.common})


def test_a_cut_that_begins_on_a_flank_is_not_passed():
    """Two racks laid as neighbours by hand: their flanks would be the common line."""
    flat = Part("rack", Outline(rounded_box(40, 12, 2)), 3, "acrylic")
    text, asked = beam(sheet(copies(flat, 2)))
    assert prove(text, asked).ok
    racks = tuple(
        type(one)(
            one.name,
            Outline(Loop(tuple(Line(s.start, s.end, "flank") if isinstance(s, Line) else s for s in loop))),
        )
        for one in asked.pieces
        for loop in [one.outline.outer.segments]
    )
    assert prove(text, type(asked)(**{**vars(asked), "pieces": racks})).ok, "it begins at corners of flanks"
    tagged = tuple(
        type(one)(one.name, Outline(Loop.polygon([s.start for s in one.outline.outer.segments], "flank")))
        for one in asked.pieces
    )
    failures = {one.name for one in prove(text, type(asked)(**{**vars(asked), "pieces": tagged})).failures}
    assert "leads off flanks" in failures


def test_the_part_of_a_row_is_cut_in_stretches_that_end_in_the_lines():
    job = sheet(copies(SQUARE, 3))
    middle = [one for one in contours(job) if one.role == "outside" and len(one.strokes) == 2]
    ends = [point for one in job.common for point in one.whole]
    assert len(middle) == 1, "the one between two others"
    for stroke in middle[0].strokes:
        for point in (stroke.start, stroke.end):
            assert min(math.dist(point, end) for end in ends) < 2e-4
        assert len(moves(stroke)) == 3, "a corner, a side, a corner"


def test_a_beam_grazes_far_less_than_its_own_width():
    """Else a kerf of hundredths would be let through what is loose."""
    assert [slack(SimpleNamespace(kerf=kerf)) for kerf in (0.2, 0.01)] == [0.005, 0.0025]
