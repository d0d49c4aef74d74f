"""A cut with no tool in the spindle, or one that the job does not know, is refused in one line that names it."""

import re

import pytest
from by_control import BY_NAME, EVERY, prove
from golden_operations import made
from klartext_blocks import anew

from mechwright.errors import ProgramError

CALL = re.compile(r"(\d+ )?(TOOL CALL |T)(23)\b(.*)")
LINES = {name: made("pocket-contour", name)[0].text.splitlines() for name in EVERY}


def never(lines: list[str]) -> list[str]:
    """No tool is called at all."""
    return [line for line in lines if not CALL.fullmatch(line) and line != "M6"]


def selected_only(lines: list[str]) -> list[str]:
    """It is made ready, and never changed to."""
    return [line.replace(" M6", "") for line in lines if line != "M6"]


def another(lines: list[str], number: int) -> list[str]:
    """Another number is called, 0 for none."""
    return [CALL.sub(rf"\g<1>\g<2>{number}\g<4>", line) for line in lines]


def taken_out(lines: list[str]) -> list[str]:
    """The tool is put away right before its first cut, at the upper end."""
    at = next(k for k, line in enumerate(lines) if re.search(r"\b(G1|L) Z\+?0\.? F", line))
    call = next(k for k, line in enumerate(lines) if CALL.fullmatch(line))
    again = [*another(lines[call : call + 1], 0), *(line for line in ["M6"] if line in lines)]
    up = [line for line in lines[:call] if re.search(r"SUPA|M91|G28|G53|^G90$", line)]
    places = [line for line in lines[call:at] if re.search(r"\b(G0|L|D1|G43|Z5)\b", line)]
    return [*lines[:at], *up, *again, *places, *lines[at:]]


FAULTS = {
    "never": never,
    "selected": selected_only,
    "T0": lambda lines: another(lines, 0),
    "T99": lambda lines: another(lines, 99),
    "taken out": taken_out,
}


@pytest.mark.parametrize("control", EVERY)
@pytest.mark.parametrize("turning", [True, False])
@pytest.mark.parametrize("fault", FAULTS)
def test_a_cut_without_a_tool_is_refused(fault: str, turning: bool, control: str) -> None:
    if fault == "selected" and control in {"grbl", "heidenhain-tnc"}:
        pytest.skip("there the tool's word alone changes it")
    lines = FAULTS[fault](LINES[control])
    if not turning:
        lines = [re.sub(r"(^|(?<= ))M3$", "M5", line) for line in lines]
    text, job = anew("\n".join([*lines, ""])), made("pocket-contour", control)[0].job
    if fault == "never" and control == "heidenhain-tnc":
        with pytest.raises(ProgramError, match=r"^line \d+: [^\n]+$"):
            prove(text, job, BY_NAME[control])
        return
    proof = prove(text, job, BY_NAME[control])
    said = proof.checks["tools"]
    assert not said.passed
    named = "T99 is not a tool of this job" if fault == "T99" else "no tool was changed to"
    assert re.match(rf"line {said.line}: {named}; its tools are T23", said.message)
    assert re.match(r"line \d+: ", proof.failures[0].message)
    assert turning or not proof.checks["spindle"].passed
