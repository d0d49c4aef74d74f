"""The proof of programs that probe: faults are refused by name, and no mutant is proven that finds another zero."""

import re
from collections.abc import Iterator

import pytest
from by_control import BY_NAME
from planning_parts import job as job_of
from planning_parts import plate
from test_probing import CLOSE, PROBE, PROBING, Played, text_of

from mechwright.errors import ProofError
from mechwright_cam.controls.contract import Control
from mechwright_cam.proof.probing import prove_probe
from mechwright_cam.setup.job import Job

OFFS = [(0, 0, 0), (2.9, -2.9, 2.9), (-2.9, 2.9, -2.9), (2.9, 2.9, 2.9), (-2.9, -2.9, -2.9)]
EACH = 11
"""One of so many mutants is tried; the documents tell of all of them."""


def probed() -> Job:
    return job_of(plate(), "mill-6", probe=PROBE, machine={"retract_z": -2.0}, stock={"margin": 9.0})


def said(text: str, job: Job, control: Control) -> str:
    try:
        prove_probe("plate-probe", text, job, control)
    except ProofError as error:
        return str(error)
    return ""


def mutants(lines: list[str]) -> Iterator[list[str]]:
    """Each line removed, doubled, swapped with the next; each of its numbers changed, and with another sign."""
    for k, line in enumerate(lines):
        if line.startswith("("):
            continue
        yield lines[:k] + lines[k + 1 :]
        yield lines[: k + 1] + lines[k:]
        if k + 1 < len(lines):
            yield [*lines[:k], lines[k + 1], line, *lines[k + 2 :]]
        for number in re.finditer(r"-?[\d.]+", line):
            other = [f"{float(number[0]) + by:g}" for by in (5, -5, 0.5)]
            for new in (*other, number[0][1:] if number[0][0] == "-" else "-" + number[0]):
                yield [*lines[:k], line[: number.start()] + new + line[number.end() :], *lines[k + 1 :]]


def finds(text: str, job: Job, control: Control) -> bool:
    """Whether the program finds the zero of stocks that lie off, and breaks nothing."""
    for off in OFFS:
        played = Played(job, off, control.scale)
        played.run(text)  # asserts
        if [played.shift[axis] for axis in "XYZ"] != pytest.approx(off, abs=2 * CLOSE):
            return False
    return True


@pytest.mark.parametrize("units", ["mm", "inch"])
@pytest.mark.parametrize("name", PROBING)
def test_our_own_are_proven(name: str, units: str) -> None:
    control = BY_NAME[name].speaking(units)
    assert said(text_of(control, probed()), probed(), control) == ""


@pytest.mark.parametrize("name", PROBING)
def test_what_is_proven_finds_the_zero(name: str) -> None:
    control, job, passed, tried = BY_NAME[name], probed(), 0, 0
    for lines in list(mutants(text_of(control, job).splitlines()))[::EACH]:
        text, tried = "\n".join(lines) + "\n", tried + 1
        found = said(text, job, control)
        if not found:
            assert finds(text, job, control), text
            passed += 1
        else:
            assert re.match(r"plate-probe: line \d+: ", found)
    assert 0.1 * tried < passed < 0.3 * tried


FAULTS = {
    (r"G0 Z8\nG0 X-47", "G0 X-47"): "moves with the ball at the stock; go back along Z first",
    ("G38.3 Z-4 F150", "G0 Z-4"): "comes down to Z-4 at a rapid; touch the stock, or go by G38.3",
    ("G0 X-47", "G0 X-43"): "may run into a stock that lies 3 mm off",
    ("G38.2 X-37", "G38.2 X-40"): "ends 1.999 mm before a stock that lies 3 mm off",
    ("G38.2 X-37", "G38.2 X-30"): "goes on more than 1 mm behind the last place of the stock",
    ("F25", "F250"): "touches with 250 mm/min, 25 at most",
    (
        "G38.3 Z-4 F150",
        "G38.3 X-44 F150",
    ): "goes down beside the stock, by G38.3, behind the touch of its top",
    ("G38.2 Z-4 F150", "G38.3 Z-4 F150"): "goes down beside the stock, by G38.3, behind the touch of its top",
    ("G38.2 Z-4 F25\n", ""): "writes Z without two touches along it",
    ("G0 X-26 Y-16", "G0 X-36 Y-16"): "may miss the stock: X is -39 to -33",
    ("G38.3 Z-4", "G38.3 Z-5.9"): "nearer to the table than 0.5 mm",
    ("G38.3 Z-4", "G38.3 Z-1"): "the ball's middle less than 0.3 mm below the top",
    ("G10 L20 P1 X", "G10 L20 P2 X"): "is no entry of G54 along one axis",
    ("G10 L20 P1 X", "G10 L2 P1 X"): "is no entry of G54 along one axis",
    ("-41", "-39"): "writes X-39 where the ball is at X-41",
    ("M5", "M3"): "M3 is none of what a program that probes does",
    ("G0 X-47\nG0 Z8", "G0 X-60\nG0 Z8"): "goes back further than the ball has come",
    ("M30", "G0 Z1"): "",
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("name", PROBING)
def test_a_fault_is_named_with_its_line(name: str, fault: tuple[str, str]) -> None:
    control, job = BY_NAME[name], probed()
    text = text_of(control, job)
    wrong = re.sub(fault[0], fault[1], text, count=1)
    assert wrong != text
    found = said(wrong, job, control)
    assert re.match(r"plate-probe: line \d+: ", found)
    assert FAULTS[fault] in found
