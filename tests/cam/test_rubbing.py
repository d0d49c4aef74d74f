"""Feeds at which no edge gets a chip are refused, on each control; slow programs, and narrow holes, are none."""

import re
from dataclasses import replace

import pytest
from by_control import BY_NAME, CONTROLS, asked, prove
from machine_programs import job_of, text_of
from shop import MILL, plate_job

from mechwright_cam.shop.tool import CuttingData

DATA = {"aluminium": CuttingData(cutting_speed=220, chip_load=0.042, plunge=0.3)}
KNOWN = MILL.model_copy(update={"cutting": DATA})
OUTSIDE = "F600"
"""The feed of the plate's outside: 0.025 mm per tooth at S8000 with three."""


def job(control: str = "linuxcnc", mill=KNOWN):  # type: ignore[no-untyped-def]
    of = job_of(control)
    return replace(of, tools=tuple(mill if tool.number == mill.number else tool for tool in of.tools))


def fed(control: str, feed: str) -> str:
    """The plate's program with its mill fed so."""
    text = text_of(control)
    assert re.search(rf"{OUTSIDE}\.?(?!\d)", text)
    return re.sub(rf"{OUTSIDE}(?!\d)\.?", f"F{feed}{'' if '.' in feed else '.'}", text)


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("feed", ["1", "0.1", "20", "40"])
def test_a_feed_without_a_chip_is_refused_with_its_line(control: str, feed: str) -> None:
    text = fed(control, feed)
    found = asked("chips", text, job(control), BY_NAME[control])
    assert not found.passed
    assert found.line is not None
    assert text.splitlines()[found.line - 1].startswith(("G1", "G2", "G3", "X", "Y", "N", "Z"))
    assert re.match(
        rf"line {found.line}: F{feed} at S8000 feeds T3 \(mill-6\) [\d.]+ µm per tooth into aluminium, and "
        r"below 2 µm an edge rubs instead of cutting; raise F to some 1008, as the tool library says, or lower S",
        found.message,
    )


@pytest.mark.parametrize("feed", ["48", "60", "100", "1008"])
def test_a_slow_program_of_somebody_else_passes(feed: str) -> None:
    """48 mm/min are 2 µm per tooth; 1008 is the feed that the message advises."""
    assert asked("chips", fed("linuxcnc", feed), job()).passed


def test_the_advice_is_good() -> None:
    told = re.search(r"raise F to some (\d+)", asked("chips", fed("linuxcnc", "1"), job()).message)
    assert told is not None
    proof = prove(fed("linuxcnc", told[1]), job())
    assert proof.checks["chips"].passed
    assert proof.checks["power"].passed
    slower = fed("linuxcnc", "20").replace("S8000", "S3000")  # or lower S
    assert asked("chips", slower, job()).passed


HEAD = "G17 G21 G40 G49 G80 G90 G94\nG61\nG53 G0 Z0\nT3 M6\nG54 S8000 M3 M8\nG0 X0 Y0\nG43 H3 Z5\nZ1\n"
TAIL = "\nG0 Z5\nM5 M9\nG53 G0 Z0\nM30\n"


def said(cut: str) -> str:
    found = asked("chips", HEAD + cut + TAIL, replace(plate_job(), tools=(KNOWN,)))
    return "" if found.passed else found.message


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(("name", "own", "number"), [("drill-8", "200", 2), ("spot-6", "150", 1)])
def test_a_drill_rubs_in_pecks_too(control: str, name: str, own: str, number: int) -> None:
    of = job_of(control)
    data = {"aluminium": CuttingData(cutting_speed=70, chip_load=0.05)}
    known = tuple(t.model_copy(update={"cutting": data}) if t.number == number else t for t in of.tools)
    of = replace(of, tools=known)
    assert asked("chips", text_of(control), of, BY_NAME[control]).passed
    slow = re.sub(rf"F{own}(?!\d)\.?", "F1.", text_of(control))
    found = asked("chips", slow, of, BY_NAME[control])
    assert re.match(
        rf"line {found.line}: F1 at S\d+ feeds T{number} \({name}\) 0\.\d+ µm per tooth", found.message
    )


@pytest.mark.parametrize(("speed", "feed", "good"), [(1, 0.003, False), (1, 0.004, True), (50, 0.19, False)])
def test_a_drill_that_hardly_turns_is_asked_as_well(speed: int, feed: float, good: bool) -> None:
    """Two lips, and 2 µm for each of them."""
    of = job_of("linuxcnc")
    data = {"aluminium": CuttingData(cutting_speed=70, chip_load=0.05)}
    of = replace(of, tools=tuple(t.model_copy(update={"cutting": data}) for t in of.tools if t.number == 2))
    text = f"{HEAD}G1 Z-1 F{feed}{TAIL}".replace("T3", "T2").replace("H3", "H2").replace("S8000", f"S{speed}")
    assert asked("chips", text, of).passed is good


def test_a_drill_in_air_does_not() -> None:
    of = job_of("linuxcnc")
    data = {"aluminium": CuttingData(cutting_speed=70, chip_load=0.05)}
    of = replace(of, tools=tuple(t.model_copy(update={"cutting": data}) for t in of.tools))
    text = text_of("linuxcnc").replace(
        "G98 G83 X0 Y0 Z-9 R1 Q3 F200", "G1 Z1 F1\nG98 G83 X0 Y0 Z-9 R1 Q3 F200"
    )
    assert "\nG1 Z1 F1\n" in text
    assert asked("chips", text, of).passed


def test_straight_down_it_is_the_share_of_a_plunge() -> None:
    assert "0.54 µm per tooth into aluminium, and below 0.6 µm" in said("G1 Z-5 F13")
    assert said("G1 Z-5 F15") == ""


def test_the_edge_counts_and_not_the_axis() -> None:
    """In a hole hardly wider than the cutter the axis hardly moves, as arcs or as chords."""
    arcs = "G1 X0.1 Z0 F300\n" + "".join(f"G3 I-0.1 Z{-0.2 * k:.1f} F10\n" for k in range(1, 16))
    assert said(arcs) == ""
    square = ((0.1, 0), (0, 0.1), (-0.1, 0), (0, -0.1))
    chords = "G1 X0.1 Z0 F300\n" + "".join(
        f"G1 X{square[k % 4][0]} Y{square[k % 4][1]} Z{-0.02 * k:.2f} F10\n" for k in range(1, 100)
    )
    assert said(chords) == ""
    assert "per tooth" in said("G1 Z-1 F300\nG1 X12 F10\n")
    assert "per tooth" in said("G1 Z-1 F300\nX10\nG3 I-10 F10\n")
    assert "per tooth" in said("G1 Z-1 F300\n" + "".join(f"G1 X{k / 10} F10\n" for k in range(1, 100)))


def test_air_and_short_ways_are_fed_as_slowly_as_one_likes() -> None:
    assert said("G1 Z0.5 F1\nX30\n") == ""
    assert said("G1 Z-1 F300\nX10 F600\nX10.5 F1\nX20 F600\n") == ""
    assert "F1 at S8000" in said("G1 Z-1 F300\nX10 F600\nX24 F1\nX30 F600\n")
