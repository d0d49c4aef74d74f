"""No word of G-code is ignored in silence, in any kind of block, on any control: a sample of all of them."""

from pathlib import Path

import pytest
from by_control import interpret
from every_word import SMALL, judged, words_of
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError

EACH = 97
"""One of so many words; ``python tests/cam/every_word.py`` tries them all."""
START = "G21 G17 G90 G94\nG0 X0 Y0 Z5\n"


@pytest.mark.parametrize("control", SMALL)
def test_a_word_is_read_or_refused_in_every_block(control: str, tmp_path: Path) -> None:
    count, wrong = judged(control, words_of(control)[::EACH], tmp_path)
    assert not wrong
    assert count["refused"] > 300
    assert count["read"] > 0


@needs_rs274
@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("G1\nF100 X1", "line 3: G1 without a feed"),
        ("F100\nG94\nG1 X1", "line 5: G1 without a feed"),
        ("G81 X1 Y1 Z-1 R1 Q1 F100", "line 3: Q means nothing in this line"),
        ("G81 X1 Y1 Z-1 R1 P1 F100", "line 3: P means nothing in this line"),
        ("F100\nG41.1 D2 G1 X20 Y20\nG99\nG1 X60", "line 5: G99 while compensation is on"),
        (
            "F100\nG41.1 D2 G1 X20 Y20\nG1 Y40\nG40 X0 G18",
            "line 6: the plane changes while compensation is on",
        ),
    ],
)
def test_what_linuxcnc_refuses_is_refused(lines: str, said: str, tmp_path: Path) -> None:
    text = START + lines + "\nM2\n"
    assert not run_rs274(text, tmp_path).ok
    with pytest.raises(ProgramError, match=said):
        interpret(text)
