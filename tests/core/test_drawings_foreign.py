"""Drawings as twelve programs write them: the bracket comes out of each, or is refused by name."""

import io
from dataclasses import replace

import ezdxf
import pytest
from dxf_habits import AREA, HABITS, HIGH, HOLE, HOLES, WIDE

from mechwright import Bore, Part
from mechwright.drawings.asked import Asked
from mechwright.drawings.fault import Told
from mechwright.drawings.plate import Cut, part_of
from mechwright.drawings.reading import read

PLAIN = Asked()


def drawn(data: bytes, asked: Asked = PLAIN) -> tuple[Part | None, Told]:
    found = read(data, asked)
    return part_of(found, asked, Cut("bracket", 5.0, "aluminium")), found.told


MM = replace(PLAIN, units="mm")
NEEDS = {
    "FreeCAD": ("no $INSUNITS", MM),
    "Inkscape": ("no $INSUNITS", MM),
    "OpenSCAD": ("no $INSUNITS", MM),
    "CorelDRAW": ("no $INSUNITS", replace(MM, join=0.5)),
    "SolidWorks": ("layer 0 has", replace(PLAIN, layers=(("SLD-0", "ignore"), ("0", "through")))),
}
"""What is refused as it comes, for what, and how it is asked for then."""
CHORDED = {"OpenSCAD": 25.0}
"""mm² by which the area of what is drawn in chords may differ."""


@pytest.mark.parametrize("program", HABITS)
def test_the_bracket_of_every_program_is_built_or_refused_by_name(program):
    data = HABITS[program]()
    part, told = drawn(data)
    if program in NEEDS:
        refused, asked = NEEDS[program]
        assert part is None
        assert refused in told.faults[0].message
        part, told = drawn(data, asked)
    assert told.faults == []
    assert part is not None
    assert part.outline is not None
    x0, y0, x1, y1 = part.outline.bounds
    assert (x1 - x0, y1 - y0) == pytest.approx((WIDE, HIGH), abs=2e-3)
    assert part.outline.area == pytest.approx(AREA, abs=CHORDED.get(program, 0.05))
    bores = [feature for feature in part.features if isinstance(feature, Bore)]
    assert len(part.outline.inner) == 5
    if program not in CHORDED:
        assert [bore.diameter for bore in bores] == pytest.approx([HOLE] * 4, abs=1e-3)
        wanted = sorted((x - x0, y - y0) for x, y in ((a + x0, b + y0) for a, b in HOLES))
        places = sorted((round(b.centre[0] - x0, 3), round(b.centre[1] - y0, 3)) for b in bores)
        assert [v for place in places for v in place] == pytest.approx(
            [v for p in wanted for v in p], abs=1e-3
        )


def dxf(corners, units=4):
    document = ezdxf.new("R2000", units=units)
    for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
        document.modelspace().add_line(start, end)
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode()


@pytest.mark.parametrize(("units", "size"), [(1, 25.4), (4, 1.0), (5, 10.0)])
def test_a_plate_is_read_at_any_height_in_any_unit(units, size):
    part, told = drawn(dxf([(0, 0, 3), (4, 0, 3), (4, 2, 3), (0, 2, 3)], units))
    assert (told.faults, [note for note in told.notes if "height" in note]) == ([], [])
    assert part is not None
    assert part.outline is not None
    assert part.outline.area == pytest.approx(8 * size**2)


@pytest.mark.parametrize("overlap", [0.0, 20.0])
def test_a_hole_of_two_arcs_is_one_though_they_overlap(overlap):
    document = ezdxf.new("R2000", units=4)
    space = document.modelspace()
    space.add_lwpolyline([(0, 0), (40, 0), (40, 20), (0, 20)], close=True)
    space.add_arc((20, 10), 3, 0, 180 + overlap)
    space.add_arc((20, 10), 3, 180, 360)
    stream = io.StringIO()
    document.write(stream)
    part, told = drawn(stream.getvalue().encode())
    assert told.faults == []
    assert part is not None
    (bore,) = [feature for feature in part.features if isinstance(feature, Bore)]
    assert (bore.centre, bore.diameter) == ((20, 10), pytest.approx(6))


@pytest.mark.parametrize("far", [0.0, 100.0, -300.0])
def test_edges_on_one_line_with_a_notch_between_stay_two(far):
    notched = [(0, 0), (40, 0), (40, 20), (25, 20), (25, 12), (15, 12), (15, 20), (0, 20)]
    part, told = drawn(dxf([(x + far, y - far) for x, y in notched]))
    assert told.faults == []
    assert part is not None
    assert part.outline is not None
    assert part.outline.area == pytest.approx(40 * 20 - 10 * 8)
    assert len(part.outline.outer.segments) == 8


def test_a_gap_that_is_wider_than_asked_for_is_refused_with_its_place_and_both_ends():
    part, told = drawn(HABITS["CorelDRAW"](), MM)
    assert part is None
    (fault,) = told.faults
    assert fault.key == "join"
    assert (
        "at X5.000 Y0.000, where ARC 36 on layer 0 ends, 0.5 mm from the next end at X5.500 Y0.000"
        in fault.message
    )
    assert fault.remedy.endswith("join = 0.5")


def test_what_was_mended_and_left_out_is_told():
    _, told = drawn(HABITS["QCAD"]())
    assert "drawn twice, to the last digit: 12 curves; each is taken once" in told.notes
    assert "drawn twice: LINE 44 on layer 0, at X32.500 Y17.000; taken once" in told.notes
    assert "left out: layer construction" in told.notes
    _, told = drawn(HABITS["LibreCAD"]())
    assert {
        "left out: 1 of DIMENSION",
        "left out: 1 of HATCH",
        "left out: 4 of lines of type CENTER2",
    } <= set(told.notes)
    _, told = drawn(HABITS["AutoCAD"]())
    assert {
        "the drawing is in inch",
        "left out: layer FROZEN, which is frozen",
        "left out: 1 of MTEXT",
    } <= set(told.notes)


def test_holes_drawn_as_polygons_are_circles_where_they_are_said_to_be():
    asked = replace(MM, holes=((5.0, "M6"),))
    part, told = drawn(HABITS["OpenSCAD"](), asked)
    assert part is None
    assert "holes: no circle has 5 mm; there are: none" in told.faults[0].message
