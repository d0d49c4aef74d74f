"""G28 and G30 go to a place that is stored in many controls: the proof tells so, for no program shows it."""

import re

import pytest
from by_control import BY_NAME, prove
from machine_programs import job_of, text_of

CONTROLS = ("linuxcnc", "mach3", "grbl", "haas", "fanuc")
RETRACT = r"G53 G0 Z-2\.?\n|G91 G28 Z0\.\nG90\n"


@pytest.mark.parametrize(
    ("control", "word"),
    [(control, "G28") for control in CONTROLS]
    + [(c, "G30") for c in CONTROLS[1:] if "G30" in BY_NAME[c].dialect.words.known],
)
def test_a_place_that_is_stored_in_the_control_is_told(control: str, word: str) -> None:
    zero = "0." if control in {"haas", "fanuc"} else "0"
    text = re.sub(RETRACT, f"G91 {word} Z{zero}\nG90\n", text_of(control))
    if control == "grbl":  # it takes no axis word while G80 is in force
        text = text.replace(f"G91 {word}", f"G0\nG91 {word}", 1)
    assert word in text
    found = prove(text, job_of(control), BY_NAME[control]).checks["machine-moves"]
    assert found.passed
    stored = word == "G30" or control in {"linuxcnc", "mach3", "grbl"}
    assert found.told is stored
    if stored:
        line = next(n for n, one in enumerate(text.splitlines(), 1) if word in one)
        assert found.line == line
        assert re.search(rf"line {line}: {word} takes Z to a place that is stored", found.message)
    own = prove(text_of(control), job_of(control), BY_NAME[control]).checks["machine-moves"]
    assert own.passed
    assert not own.told
