"""How far the control may leave the programmed path: a bound within that of a gouge, or no proof."""

import math
import re
import tempfile
from pathlib import Path

import pytest
from by_control import BY_NAME, CONTROLS, interpret
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_programs import in_cut, job_of, judged, refused, scene_of, text_of
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError
from mechwright_cam.proof import prove
from mechwright_cam.proof.cutting_state import LOOSEST, path_tolerance
from mechwright_cam.proof.part_rules import gouge

OWN = "G64 P0.002 Q0\n"
CLEAR = 0.001
"""How far the outside of the plate's program stays off the part, mm."""


def with_words(words: str) -> str:
    assert text_of("linuxcnc").count(OWN) == 1
    return text_of("linuxcnc").replace(OWN, words + "\n")


@pytest.mark.parametrize("words", ["", "G64", "G64 P0", "G64 P0 Q0", "G64 Q0.001", "G64 P-0.001", "G61\nG64"])
def test_no_bound_is_no_proof_on_linuxcnc(words: str) -> None:
    text = with_words(words)
    line = next(k for k, one in enumerate(text.splitlines(), 1) if re.search(r"\bG0 X", one))
    found = refused(path_tolerance, "linuxcnc", text, line)
    assert (
        "nothing bounds how far LinuxCNC leaves the path at corners, the limit is 0.005 mm" in found.message
    )


@pytest.mark.parametrize(
    ("words", "value"),
    [
        *(("G64 P2", 4), ("G64 P0.5 Q0.5", 1), ("G64 P0.03", 0.06), ("G20\nG64 P0.001 Q0.002\nG21", 0.0762)),
    ],
)
def test_what_is_too_loose_is_another_path(words: str, value: float) -> None:
    found = judged(path_tolerance, "linuxcnc", with_words(words))
    assert not found.passed
    assert (found.value, found.limit) == (pytest.approx(value), LOOSEST)
    assert "Z-" in found.message  # the first cut below the top


@pytest.mark.parametrize(
    ("words", "value"),
    [
        *(("G64 P0.003", 0.006), ("G64 P0.004 Q0.002", 0.006), ("G64 P0.0025", 0.005)),
        *(("G64 P0.002 Q0.02", 0.022), ("G20\nG64 P0.00012\nG21", 0.0061)),
    ],
)
def test_what_the_control_cuts_off_the_path_is_a_gouge(words: str, value: float) -> None:
    found = judged(path_tolerance, "linuxcnc", with_words(words))
    assert not found.passed
    assert found.limit == 0.005
    assert found.value is not None
    assert value - CLEAR < found.value < value + 0.002
    assert f"{found.value:.4f} mm into the finished part" in found.message


def test_path_and_corridor_are_one_gouge() -> None:
    """Neither 2 µm of the path nor 3.3 µm of the control are too deep; both are."""
    for words, by, proven in (
        ("G64 P0.003 Q0.0003", CLEAR, True),
        ("G61", -0.002, True),
        ("G64 P0.003 Q0.0003", -0.002, False),
    ):
        text = with_words(words)
        for ends in (33, 23, 11):
            text = text.replace(f"{ends + CLEAR:g}", f"{ends + by:g}")
        assert f"X{33 + by:g}" in text
        assert judged(gouge, "linuxcnc", text).passed
        assert judged(path_tolerance, "linuxcnc", text).passed == proven


@pytest.mark.parametrize(
    "words",
    [
        "G61",
        "G61.1",
        "G64 P0.003 Q0",
        "G64 P0.002 Q0.002",
        "G20\nG64 P0.00005\nG21",
        "G64\nG61",
    ],
)
def test_a_tighter_path_is_accepted(words: str) -> None:
    assert judged(path_tolerance, "linuxcnc", with_words(words)).passed


def test_the_advice_is_good() -> None:
    control = BY_NAME["linuxcnc"]
    for words in (control.rounding_words.removesuffix(" (in mm)"), control.exact_words):
        assert prove(with_words(words), job_of("linuxcnc"), BY_NAME["linuxcnc"]).ok


def test_what_is_loosened_later_counts_from_there() -> None:
    text, line = in_cut(text_of("linuxcnc"), "G64 P2\nG1 X-22 F100")
    refused(path_tolerance, "linuxcnc", text, line + 1)
    text, line = in_cut(text_of("linuxcnc"), "G64\nG0 Z5")
    refused(path_tolerance, "linuxcnc", text, line + 1)


def test_the_mode_does_not_change_under_compensation() -> None:
    with pytest.raises(ProgramError, match=r"^line 4: G64 while compensation is on; write it before"):
        interpret("G21 G90 G17\nG0 X0 Y0 Z5\nG41 D1 X9\nG64 P0.002\nM2", diameters={1: 2.0})


@pytest.mark.parametrize("control", [c for c in CONTROLS if c != "linuxcnc"])
def test_elsewhere_the_machine_is_set_and_no_word_loosens_it(control: str) -> None:
    text = text_of(control)
    assert ("G64\n" in text) == (control != "grbl")
    for words in ("", "G61\n"):
        assert prove(text.replace("G64\n", words), job_of(control), BY_NAME[control]).ok
    said = "G64 is no code" if control == "grbl" else "P means nothing in this line"
    looser, line = in_cut(text, "G64 P5")
    with pytest.raises(ProgramError, match=f"^line {line}: {said}"):
        _ = scene_of(control, looser).run


@pytest.mark.parametrize(
    ("control", "words", "remedy"),
    [
        ("haas", "G187 P1", r"write P2 \(medium\) or P3 \(finish\)"),
        ("fanuc", "G5.1 Q1. R1.", r"write R10 \(precision\)"),
    ],
)
def test_a_word_that_asks_for_speed_is_refused(control: str, words: str, remedy: str) -> None:
    text, line = in_cut(text_of(control), words)
    with pytest.raises(
        ProgramError, match=rf"^line {line}: .* round corners further than the setting.*{remedy}"
    ):
        _ = scene_of(control, text).run


@pytest.mark.parametrize(
    ("control", "words"),
    [
        *(("haas", w) for w in ("G187", "G187 P2", "G187 P3")),
        *(("fanuc", w) for w in ("G5.1 Q1.", "G5.1 Q1. R10.")),
    ],
)
def test_one_that_does_not_is_none(control: str, words: str) -> None:
    assert judged(path_tolerance, control, in_cut(text_of(control), words)[0]).passed


WORDS = st.floats(0, 0.02).map(lambda value: round(value, 4))


@needs_rs274
@given(st.sampled_from([20, 21]), st.none() | WORDS, st.none() | WORDS)
@settings(max_examples=15)
def test_linuxcnc_means_the_same_by_the_words(units: int, blend: float | None, merge: float | None) -> None:
    words = "G64" + "".join(f" {k}{v:.4f}" for k, v in (("P", blend), ("Q", merge)) if v is not None)
    text = f"G{units} G90\n{words}\nG0 X1 Y1 Z1\nM2\n"
    ours = interpret(text)
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(text, Path(folder))
    assert canon.ok, canon.error
    corner = float(re.findall(r"MOTION_CONTROL_MODE\(CANON_CONTINUOUS, ([\d.]+)\)", canon.text)[-1])
    lines = float(re.findall(r"SET_NAIVECAM_TOLERANCE\(([\d.]+)\)", canon.text)[-1])
    theirs = (corner + lines) * (25.4 if units == 20 else 1) if corner > 0 else math.inf
    assert ours.states[int(ours.state[0])].off_path == pytest.approx(theirs)
