"""Drills go down where their holes have been begun."""

import re

import pytest
from by_control import BY_NAME, EVERY, asked
from klartext_blocks import anew
from machine_programs import job_of, text_of


def moved(control: str, x: float) -> str:
    """The program with the spot so far beside the hole, mm."""
    text = text_of(control)
    end = next(re.finditer(r"T2( M6)?$|TOOL CALL 2", text, re.MULTILINE)).start()
    return anew(re.sub(r"X\+?0\.? Y", f"X{x:.3f} Y", text[:end]) + text[end:])


@pytest.mark.parametrize("control", EVERY)
@pytest.mark.parametrize(("x", "taken"), [(0.0, True), (0.019, True), (0.021, False), (-0.9, False)])
def test_a_drill_follows_its_spot(control: str, x: float, taken: bool) -> None:
    found = asked("edges", moved(control, x), job_of(control), BY_NAME[control])
    assert found.passed == taken
    if not taken:
        assert (
            f"T2 (drill-8) goes down {abs(x):.3f} mm beside the middle of what T1 (spot-6) has"
            in found.message
        )
        assert (found.value, found.limit) == (pytest.approx(abs(x), abs=1e-9), 0.02)


def test_a_spot_at_its_place_is_the_one_that_counts() -> None:
    """Another one beside it is in the hole anyway."""
    text = text_of("linuxcnc").replace("G81 X0 Y0 Z-2", "G81 X1 Y0 Z-2 R1 F150\nG81 X0 Y0 Z-2")
    assert asked("edges", text, job_of("linuxcnc")).passed


def test_what_is_drilled_in_the_clear_follows_nothing() -> None:
    """The drill's hole has been milled before: its point meets no material."""
    text = text_of("linuxcnc")
    drill = text[text.index("(operation: drill)") : text.index("(operation: bore)")]
    early = moved("linuxcnc", 0.5)
    late = early.replace(drill, "").replace("M30", drill + "M30")
    assert asked("edges", late, job_of("linuxcnc")).passed
    assert not asked("edges", early, job_of("linuxcnc")).passed
