"""T words without M6: a tool that is made ready is one of the job, on every control."""

from pathlib import Path

import pytest
from by_control import BY_NAME, CONTROLS, prove
from machine_programs import at_the_end, job_of, judged, refused, text_of
from rs274 import needs_rs274, run_rs274

from mechwright_cam.proof.machine_rules import tools


@pytest.mark.parametrize("control", CONTROLS)
def test_a_tool_that_is_made_ready_is_one_of_the_job(control: str) -> None:
    for known in ("T1", "T3", "T0"):
        assert judged(tools, control, at_the_end(text_of(control), known)[0]).passed
    found = refused(tools, control, *at_the_end(text_of(control), "T99"))
    assert found.message.endswith("T99 is made ready and is not a tool of this job; its tools are T1, T2, T3")


@pytest.mark.parametrize("control", [c for c in CONTROLS if c != "grbl"])
def test_the_tool_that_was_made_ready_last_is_changed_to(control: str) -> None:
    """A T may stand long before its M6, as changers that look for the tool in time want it."""
    text = text_of(control)
    apart = text.replace("T1 M6", "T1\nM6\nT2").replace("T2 M6", "M6\nT3").replace("T3 M6", "M6")
    assert apart.count("M6\n") == 3
    assert prove(apart, job_of(control), BY_NAME[control]).ok
    # With another tool made ready in between, that is in the spindle, and not the one that the post meant.
    proof = prove(apart.replace("M6\nT3", "M6\nT1"), job_of(control), BY_NAME[control])
    assert not proof.checks["length-offset"].passed


def test_of_several_files_the_one_is_named() -> None:
    whole = text_of("grbl")
    one = prove({"a.nc": whole, "b.nc": at_the_end(whole, "T99")[0]}, job_of("grbl"), BY_NAME["grbl"])
    assert one.checks["tools"].message.startswith("b.nc: line ")


@needs_rs274
def test_linuxcnc_s_own_interpreter_refuses_a_tool_that_is_in_no_table(tmp_path: Path) -> None:
    """It does so at the T word, before any M6; T0 it takes."""
    table = "T1 P1\nT2 P2\nT3 P3\n"
    for word, taken in (("T3", True), ("T0", True), ("T99", False)):
        canon = run_rs274(at_the_end(text_of("linuxcnc"), word)[0], tmp_path, table)
        assert canon.ok is taken, (word, canon.error)
