"""Drawings of turned parts: what they measure, that nothing runs into anything, and their files."""

import io
import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from itertools import combinations

import ezdxf
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.turned import EndThread, Groove, KeySeat, Length, Step, Turned, tube
from mechwright.errors import GeometryError
from mechwright_cad.sheet.frame import MARGIN, SHEETS
from mechwright_cad.sheet.scales import SCALES
from mechwright_cad.sheet.settings import DrawingSettings
from mechwright_cad.sheet.sheet import Dimension, Fill, Stroke, Text, width_of
from mechwright_cad.sheet.title import TitleBlock
from mechwright_cad.sheet.to_dxf import dxf
from mechwright_cad.sheet.to_pdf import pdf
from mechwright_cad.turned_drawing.drawing import turned_sheet

SHAFT = Turned(
    (
        Step(10.0055, 9, shaft_fit(10, "k6")),
        Step(14, 4),
        Step(12, 40, shaft_fit(12, "h6")),
        Step(8, 12, shaft_fit(8, "j6")),
    ),
    chamfer=0.5,
    grooves=(Groove(59, 0.9, 7.6, 0.06),),
    seats=(KeySeat(20, 16, 4, 3.5),),
)
PILLAR = Turned(
    (Step(8, 3.8, shaft_fit(8, "h6")), Step(12, 30), Step(8, 3.8, shaft_fit(8, "h6"))),
    threads=(EndThread("lower", 5, 0.8, 10.3), EndThread("upper", 5, 0.8, 12.3)),
)
SPACER = tube(8, 11.9, 2, hole_fit(8, "H7"))


BLOCK = TitleBlock("design", DrawingSettings())


def drawn(turned, name="part"):
    return turned_sheet(Part(name, None, 0.0, "steel", (Instance("body"),) * 2, turned=turned), BLOCK)


def texts(sheet):
    for item in sheet.items:
        if isinstance(item, Text):
            yield item
        elif isinstance(item, Dimension):
            yield item.text


def dimensions(sheet, direction):
    return [item for item in sheet.items if isinstance(item, Dimension) and item.direction == direction]


def box(text):
    x, y = text.left
    return x, y, x + width_of(text.text, text.height), y + text.height


def points(item):
    match item:
        case Stroke(points=found) | Fill(points=found):
            yield from found
        case Text():
            x0, y0, x1, y1 = box(item)
            yield from ((x0, y0), (x1, y1))
        case Dimension():
            for piece in item.pieces:
                yield from points(piece)


turned_parts = st.builds(
    lambda steps, bore: Turned(
        tuple(Step(d, h, shaft_fit(round(d) or 1, "h6") if fit else None) for d, h, fit in steps), bore
    ),
    st.lists(st.tuples(st.floats(3, 90), st.floats(0.5, 200), st.booleans()), min_size=1, max_size=7),
    st.sampled_from([0.0, 2.0]),
)


def test_every_length_says_what_it_measures():
    sheet = drawn(SHAFT)
    found = {}
    for one in dimensions(sheet, "x"):
        measured = (one.second[0] - one.first[0]) / sheet.scale
        assert float(one.text.text.split()[0]) == pytest.approx(measured, abs=6e-4)
        found[one.text.text] = one
    # Shoulders, where the seat begins and its length, the groove, the whole length, and the seat's width.
    words = {text.partition(" N9")[0] for text in found}
    assert words == {"9", "13", "20", "16 (+0.2/0)", "53", "59", "65", "4"}
    assert sum(" N9" in text for text in found) == 1


def test_a_length_with_limits_is_measured_from_the_face_that_bears():
    (groove,) = SHAFT.grooves
    far = groove.at + groove.width
    shoulders = Length("shoulder to shoulder", 9.0, 53.0, -0.05, 0.0)
    loaded = Length("shoulder to far wall of the groove", 53.0, far, 0.0, 0.1)
    sheet = drawn(replace(SHAFT, lengths=(shoulders, loaded)))
    found = {one.text.text: (one.first[0], one.second[0]) for one in dimensions(sheet, "x")}
    assert {"44 (0/-0.05)", f"{far - 53:g} (+0.1/0)", "9", "65"} <= set(found)
    assert not {"53", f"{groove.at:g}"} & set(found), "what a length with limits places is not placed twice"
    for one in dimensions(sheet, "x"):
        measured = (one.second[0] - one.first[0]) / sheet.scale
        assert float(one.text.text.split()[0]) == pytest.approx(measured, abs=6e-4)


def test_every_diameter_is_said_with_its_fit():
    sheet = drawn(SHAFT)
    labels = {one.text.text: (one.second[1] - one.first[1]) / sheet.scale for one in dimensions(sheet, "y")}
    assert labels == {
        "⌀10 k6 (+0.001/+0.01) Ra 0.8": pytest.approx(10.0055),
        "⌀14": pytest.approx(14),
        "⌀12 h6 (-0.011/0) Ra 1.6": pytest.approx(12),
        "⌀8 j6 (-0.002/+0.007) Ra 0.8": pytest.approx(8),
        "⌀7.6 (0/-0.06), 0.9 H13 wide": pytest.approx(7.6),
        "9.5 (0/-0.1)": pytest.approx(12 / 2 + 3.5),
    }


def test_a_ring_is_cut_open_and_its_bore_measured():
    sheet = drawn(SPACER)
    assert next(one.text.text for one in dimensions(sheet, "y")) == "⌀8 H7 (0/+0.015) Ra 1.6, through"
    hatch = [item for item in sheet.items if isinstance(item, Stroke) and item.layer == "HATCH"]
    area = sum(math.dist(*item.points) for item in hatch) * 2.5 / sheet.scale**2
    assert area == pytest.approx(2 * (11.9 - 8) / 2, rel=0.15), "the cut half, on one side of the axis"
    whole = drawn(Turned((Step(8, 20),)))
    assert not [item for item in whole.items if isinstance(item, Stroke) and item.layer == "HATCH"]


def test_a_cone_and_a_point_are_drawn():
    labels = [one.text.text for one in dimensions(drawn(Turned((Step(6, 6, start=0.0), Step(6, 20)))), "y")]
    assert labels == ["⌀6", "⌀0 to ⌀6, cone"]


def test_threads_in_the_ends_are_drawn_as_deep_as_they_are_and_named():
    sheet = drawn(PILLAR)
    labels = [one.text.text for one in dimensions(sheet, "y")]
    assert sorted(text for text in labels if text.startswith("M")) == [
        "M5 x 10.3 / ⌀4.2 x 12.7",
        "M5 x 12.3 / ⌀4.2 x 14.7",
    ]
    level = [
        abs(item.points[0][0] - item.points[1][0]) / sheet.scale
        for item in sheet.items
        if isinstance(item, Stroke) and item.layer == "HATCH" and item.points[0][1] == item.points[1][1]
    ]
    assert sorted(level) == pytest.approx([10.3] * 4 + [12.3] * 4)  # core and nominal diameter, both sides


@example(SHAFT)
@example(PILLAR)
@example(replace(SHAFT, lengths=(Length("a", 9.0, 53.0, -0.05, 0.0), Length("b", 53.0, 59.9, 0.0, 0.1))))
@example(replace(SHAFT, seats=(*SHAFT.seats, KeySeat(0, 9, 3, 3.2)), note="Hardened 58 HRC"))
@given(turned_parts)
@settings(max_examples=40, deadline=None)
def test_nothing_runs_into_anything_or_over_the_frame(turned):
    sheet = drawn(turned)
    assert (sheet.width, sheet.height) in SHEETS
    assert sheet.scale in SCALES
    boxes = [box(text) for text in texts(sheet)]
    for (a0, b0, a1, b1), (c0, d0, c1, d1) in combinations(boxes, 2):
        assert a1 <= c0 or c1 <= a0 or b1 <= d0 or d1 <= b0, "two texts stand in each other"
    for item in sheet.items:
        for x, y in points(item):
            assert MARGIN - 1e-9 <= x <= sheet.width - MARGIN + 1e-9
            assert MARGIN - 1e-9 <= y <= sheet.height - MARGIN + 1e-9


@given(turned_parts)
@settings(max_examples=20, deadline=None)
def test_every_step_has_its_diameter_and_every_shoulder_its_length(turned):
    sheet = drawn(turned)
    heights = sorted((one.second[1] - one.first[1]) / sheet.scale for one in dimensions(sheet, "y"))
    bores = [turned.bore] if turned.bore else []
    assert heights == pytest.approx(sorted([*(step.diameter for step in turned.steps), *bores]))
    ends = sorted({round(at, 6) for at in (*turned.starts[1:], turned.length)})
    lengths = [(one.second[0] - one.first[0]) / sheet.scale for one in dimensions(sheet, "x")]
    assert lengths == pytest.approx(ends)


def test_labels_do_not_stand_on_grooves_or_seats():
    places = {one.text.text[:3]: one.first[0] for one in dimensions(drawn(SHAFT), "y")}
    left = min(
        x
        for item in drawn(SHAFT).items
        if isinstance(item, Stroke) and item.layer == "OUTLINE"
        for x, _ in item.points
    )
    assert not 20 <= places["⌀12"] - left <= 36
    assert not 59 <= places["⌀8 "] - left <= 59.9


def test_a_dxf_reader_finds_dimensions_in_true_size():
    sheet = drawn(SPACER)
    assert sheet.scale == 5
    document = ezdxf.read(io.StringIO(dxf(sheet).decode()))
    audit = document.audit()
    assert (audit.errors, audit.fixes) == ([], [])
    found = {one.dxf.text: one for one in document.modelspace().query("DIMENSION")}
    measured = {text: one.get_measurement() for text, one in found.items()}
    assert measured == {
        "%%c8 H7 (0/+0.015) Ra 1.6, through": pytest.approx(8),
        "%%c11.9": pytest.approx(11.9),
        "2": pytest.approx(2),
    }
    for text, one in found.items():  # what a viewer shows is the block, not the measurement
        shown = [entity.dxf.text for entity in one.get_geometry_block().query("TEXT")]
        assert shown == [text]
        assert len(one.get_geometry_block().query("SOLID")) == 2, "arrows"
    layers = {layer.dxf.name for layer in document.layers}
    assert {"OUTLINE", "DIM", "CENTRE", "HATCH", "TEXT", "FRAME"} <= layers
    assert document.layers.get("CENTRE").dxf.linetype == "CENTER"


def test_a_pdf_is_sound_and_says_the_same():
    sheet = drawn(SHAFT)
    data = pdf(sheet, "design: a (b)")
    start = int(re.search(rb"startxref\n(\d+)\n%%EOF\n$", data)[1])
    assert data[start : start + 4] == b"xref"
    places = [int(place) for place in re.findall(rb"(\d{10}) 00000 n ", data)]
    for number, place in enumerate(places, start=1):
        assert data[place:].startswith(b"%d 0 obj\n" % number)
    length, stream = re.search(rb"/Length (\d+) >>\nstream\n(.*)\nendstream", data, re.S).groups()
    assert int(length) == len(stream)
    shown = [re.sub(rb"\\(.)", rb"\1", text) for text in re.findall(rb"\((.*?)\) Tj", stream)]
    assert [text.decode("cp1252").replace("Ø", "⌀") for text in shown] == [text.text for text in texts(sheet)]
    assert rb"/Title (design: a \(b\))" in data
    width, height = map(float, re.search(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", data).groups())
    assert (width, height) == pytest.approx((297 * 72 / 25.4, 210 * 72 / 25.4), abs=0.01)
    assert b"-0 " not in stream


AGAIN = """
import sys
from mechwright.contracts.part import Part
from mechwright.contracts.turned import tube
from mechwright_cad.sheet.settings import DrawingSettings
from mechwright_cad.sheet.title import TitleBlock
from mechwright_cad.turned_drawing.drawing import turned_sheet
from mechwright_cad.sheet.to_dxf import dxf
from mechwright_cad.sheet.to_pdf import pdf
block = TitleBlock("design", DrawingSettings())
sheet = turned_sheet(Part("spacer", None, 0.0, "brass", turned=tube(8, 12, 2)), block)
sys.stdout.buffer.write(dxf(sheet) + pdf(sheet))
"""


def test_another_process_writes_the_same_bytes():
    sheet = turned_sheet(Part("spacer", None, 0.0, "brass", turned=tube(8, 12, 2)), BLOCK)
    environment = {**os.environ, "PYTHONHASHSEED": "4711"}
    done = subprocess.run([sys.executable, "-c", AGAIN], capture_output=True, check=True, env=environment)
    assert done.stdout == dxf(sheet) + pdf(sheet)


def test_a_part_that_is_not_turned_has_no_such_drawing():
    with pytest.raises(GeometryError, match="part block is not turned"):
        turned_sheet(Part("block", None, 0.0, "steel", build=SHAFT.shape.solid), BLOCK)


def test_drawings_of_plates_leave_out_what_is_turned_or_bought():
    from mechwright.standards.bearings import bearing
    from mechwright_cad.exporters import DxfExporter

    parts = [
        Part("spacer", None, 0.0, "brass", turned=SPACER),
        Part("bearing", None, 0.0, "steel", bought=bearing("608").bought),
    ]
    assert [DxfExporter().part(part) for part in parts] == [None, None]
    with pytest.raises(GeometryError, match="part block has no outline to draw"):
        DxfExporter().part(Part("block", None, 0.0, "steel", build=SHAFT.shape.solid))
