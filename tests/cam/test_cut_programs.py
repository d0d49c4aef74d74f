"""Programs of beams: their text line by line, read by LinuxCNC's interpreter, and proven."""

import re
from dataclasses import replace

import numpy as np
import pytest
from cut_sheets import beam, copies, plate, sheet_of, toothed
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_parts import bore, keyed_bore, rounded_box
from rs274 import needs_rs274, run_rs274

from mechwright.contracts.details import Engraving
from mechwright.contracts.part import Part
from mechwright.geometry import Loop, Outline
from mechwright_cut.proof.judge import prove
from mechwright_cut.proof.reading import read_beam

SQUARE = Part("tile", Outline(Loop.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])), 3, "acrylic")


def test_a_grbl_program_line_by_line():
    text, asked = beam(sheet_of(SQUARE, kerf=0.2, overcut=0.0, lead=1.0))
    assert text.splitlines()[:9] == [
        "(sheet: CO2 laser)",
        "(acrylic 3 mm, kerf 0.2 mm)",
        "(X0 Y0: lower left corner of the sheet 90 x 60)",
        "(needs $32=1 and $30=1000)",
        "G21 G90 G17 G94 G54",
        "M5 S0",
        "(tile outside)",
        "M4 S0",
        text.splitlines()[8],
    ]
    assert re.fullmatch(r"G0 X[\d.]+ Y[\d.]+", text.splitlines()[8])
    assert re.fullmatch(r"G3 .* S800 F600", text.splitlines()[9])
    assert text.splitlines()[-3:] == ["M5 S0", "G0 X0 Y0", "M2"]
    assert prove(text, asked).ok


def test_a_pierce_burns_at_rest_under_m3():
    text, asked = beam(sheet_of(SQUARE, pierce=0.3))
    lines = text.splitlines()
    at = lines.index("G4 P0.3")
    assert lines[at - 1] == "G1 S800 F600"
    assert lines[at - 3] == "M3 S0"
    assert prove(text, asked).ok


def test_every_line_is_short_and_plain():
    part = plate("a-name-that-is-as-long-as-names-of-parts-may-be-or-nearly-so-00", bore(6))
    for control in ("grbl-laser", "linuxcnc-beam"):
        text, _ = beam(sheet_of(part), control)
        assert max(map(len, text.splitlines())) <= 70
        assert text.isascii()


@pytest.mark.parametrize("control", ["grbl-laser", "linuxcnc-beam"])
@pytest.mark.parametrize("said", [{}, {"passes": 3}, {"pierce": 0.5}, {"joints": 2}, {"overcut": 0}])
def test_programs_are_proven(control, said):
    job = sheet_of(toothed(), plate("plate", bore(5), keyed_bore(5, 2, 3.2).moved(6, 0)), **said)
    text, asked = beam(job, control)
    proof = prove(text, asked)
    assert proof.ok, proof.failures


@given(
    st.floats(12, 40),
    st.floats(10, 30),
    st.floats(0.5, 4.5),
    st.floats(2, 6),
    st.floats(0.08, 0.4),
    st.integers(1, 3),
)
@settings(max_examples=12)
def test_whatever_the_plate_its_program_is_proven(width, height, radius, hole, kerf, count):
    part = plate("p", bore(hole), size=(width, height, radius))
    text, asked = beam(sheet_of(copies(part, count), kerf=kerf, sheet={"length": 200, "width": 120}))
    proof = prove(text, asked)
    assert proof.ok, proof.failures


def test_marks_are_cut_with_little_power_and_proven():
    mark = Engraving("mark", (((-3.0, 0.0), (3.0, 0.0)), ((0.0, -3.0), (0.0, 3.0), (2.0, 3.0))), 0.1)
    part = plate("p", bore(4, (8, 0)), details=(mark,))
    text, asked = beam(sheet_of(part))
    assert text.index("(p marks)") < text.index("(p opening 1)")
    assert len(re.findall("S200 F1500", text)) == 2
    assert prove(text, asked).ok
    assert not prove(text.replace("S200", "S0"), asked).ok
    assert not prove(text, replace(asked, pieces=tuple(replace(one, marks=()) for one in asked.pieces))).ok


@needs_rs274
@pytest.mark.parametrize("process", ["co2-laser", "waterjet", "plasma"])
def test_linuxcnc_reads_the_same_moves(process, tmp_path):
    material = {"co2-laser": "acrylic"}.get(process, "steel")
    part = Part("p", Outline(rounded_box(50, 40, 6), (bore(14),)), 3, material)
    job = sheet_of(part, process=process, sheet={"length": 200, "width": 120})
    text, asked = beam(job, "linuxcnc-beam")
    canon = run_rs274(text, tmp_path)
    assert canon.ok, canon.error
    reading = read_beam(text, "linuxcnc-beam")
    ours = np.array([motion.end for motion in reading.motions])
    np.testing.assert_allclose(canon.ends[:, :2], ours, atol=1.1e-4)
    assert [kind == "rapid" for kind in canon.kinds] == [motion.rapid for motion in reading.motions]
    assert canon.text.count("START_SPINDLE_CLOCKWISE") == 2
    assert prove(text, asked).ok
