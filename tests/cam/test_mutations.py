"""Programs with one fault: each is refused, by the check that it is about, and by its line."""

import re
import zlib
from dataclasses import replace
from itertools import pairwise

import golden_compensation
import golden_operations
import numpy as np
import pytest
from by_control import BY_NAME, CONTROLS, asked, prove, read
from by_night import NIGHT, examples, thinned
from golden_case import SHARP
from line_faults import STATES
from mutant_traces import differences, trace
from mutants import mutant
from planning_parts import LIBRARY, job, part, rounded_box

from mechwright.contracts.part import Pocket
from mechwright.errors import ProgramError
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind
from mechwright_cam.machining import Machined, machine
from mechwright_cam.proof import Check
from mechwright_cam.setup.job import Job


def made(operation: str, control: str = "linuxcnc") -> Machined:
    if operation == "compensation":
        return golden_compensation.made("wear", control)
    return golden_operations.made(operation, control)[-1]


def refused(
    one: Machined, old: str, new: str, check: str, control: str = "linuxcnc", count: int = 1
) -> Check:
    """The failed check of a program in which some text is another; the text has to be there."""
    assert old in one.text
    found = asked(check, one.text.replace(old, new, count), one.job, BY_NAME[control])
    assert not found.passed
    assert found.message.startswith(f"line {found.line}: ")
    return found


def unread(one: Machined, old: str, new: str, control: str) -> str:
    assert old in one.text
    with pytest.raises(ProgramError, match=r"^line \d+: ") as error:
        prove(one.text.replace(old, new, 1), one.job, BY_NAME[control])
    return str(error.value)


@pytest.mark.parametrize("control", golden_compensation.CONTROLS)
def test_compensation_takes_the_d_of_its_own_tool(control: str) -> None:
    """With the wear in D every D is 0 as planned, so the path is right whatever D is named."""
    one = made("compensation", control)
    whole = replace(one, job=replace(one.job, tools=LIBRARY.tools))
    found = refused(whole, "D26 X", "D24 X", "diameter-offset", control)
    assert "D24 while T26 is in the spindle; write D26" in found.message


@pytest.mark.parametrize("control", ["fanuc", "haas"])
def test_a_d_or_h_that_is_not_written_is_the_last_one_on_fanuc_and_haas(control: str) -> None:
    one = made("compensation", control)
    assert "write D" in unread(one, "G41 D26 ", "G41 ", control)
    assert "write H" in unread(one, "G43 H26 ", "G43 ", control)
    text = made("compensation").text  # LinuxCNC takes those of the tool
    assert prove(text.replace(" D26 ", " ").replace(" H26 ", " "), one.job).ok


@pytest.mark.parametrize("control", ["fanuc", "haas"])
def test_the_end_of_the_tape_ends_no_program_on_fanuc_and_haas(control: str) -> None:
    one = made("slot", control)
    found = asked("program-end", one.text.replace("M30", "M0"), one.job, BY_NAME[control])
    assert "the program has no end" in found.message


@pytest.mark.parametrize("control", CONTROLS)
def test_hands_reach_in_only_when_the_spindle_stands_still(control: str) -> None:
    one = made("profile-outside", control)
    at = one.text.lower().index("(operation: clamp)")
    late = replace(one, files={"": one.text[:at] + one.text[at:].replace("M5\n", "", 1)})
    found = asked("stops", late.text, one.job, BY_NAME[control])
    assert "while the spindle turns; write M5 before it" in found.message
    assert late.text.splitlines()[found.line - 1] == "M0"


def test_a_stop_finds_the_tool_up() -> None:
    found = refused(made("pocket-contour"), "G0 Z5\n(", "M5\nM0\nM3\nG0 Z5\n(", "stops")
    assert "with the tool down" in found.message


@pytest.mark.parametrize("control", CONTROLS)
def test_a_rapid_stops_short_of_the_stock(control: str) -> None:
    one = made("helix", control)
    zero = "Z0. " if control in {"fanuc", "haas"} else "Z0 "
    found = refused(one, f"G1 {zero}", f"G0 {zero}", "rapids-in-stock", control)
    assert "a rapid ends 0 mm above the stock" in found.message


def test_a_cycle_stops_short_of_the_stock() -> None:
    found = refused(made("drill"), "R1 ", "R0.1 ", "rapids-in-stock")
    assert "ends 0.1 mm above the stock, less than 0.2 mm" in found.message


@pytest.mark.parametrize(
    ("operation", "old", "new"),
    [
        ("drill", "F376", "F3760"),
        ("drill", "S5093", "S509.3"),
        ("pocket-contour", "S8754", "S1754"),
        ("slot", "F1750\nX10.9246", "F17500\nX10.9246"),
        ("chamfer", "S7003", "S700.3"),
        ("thread", "S12000 M3", "S1200 M3"),
        ("ball", "S11671", "S1167.1"),
    ],
)
def test_chips_are_not_much_thicker_than_planned(operation: str, old: str, new: str) -> None:
    found = refused(made(operation), old, new, "chips")
    assert "mm per tooth into aluminium, the tool library says" in found.message
    assert found.value > found.limit


def test_a_flat_mill_plunges_slowly() -> None:
    """Straight down into material no chip is thinner than the feed per tooth."""
    one = made("tabs")
    lines = one.text.splitlines()
    at = lines.index("G1 Z0 F2346") + 1
    assert "Z-" in lines[at]  # the ramp, from the top of the stock
    lines.insert(at, "G1 Z-0.5 F4000")
    found = asked("chips", "\n".join(lines), one.job)
    assert not found.passed
    assert found.line == at + 1


def test_edges_do_not_run_too_fast() -> None:
    found = refused(made("drill"), "S5093", "S10186", "cutting-speed")
    assert "S10186 turns T7 (drill-5) at 160 m/min in aluminium, the tool library says 80" in found.message


@pytest.mark.parametrize(
    ("control", "old", "new"), [("linuxcnc", "Q3", "Q30"), ("mach3", "Q3", "Q30"), ("haas", "Q3.", "Q30.")]
)
def test_drills_come_out_of_deep_holes(control: str, old: str, new: str) -> None:
    found = refused(made("peck", control), old, new, "pecks", control)
    assert "T4 (drill-3) drills 19.2 mm in one go, 13.5 mm at most; use G73 or G83" in found.message


def deep() -> tuple[Job, str]:
    """A recess of four levels, and its program; level by level the same path."""
    recess = Pocket("recess", rounded_box(30, 20, 4), (), 0, 11)
    settings = {"stock": {"margin": 0}, "floor_to_leave": 0, "ramp_angle": 3}
    of = job(part(SHARP, thickness=14, machined=(recess,)), "mill-6", **settings)
    return of, machine(of, host().get(Control, "linuxcnc")).text


def operation_of(text: str, name: str) -> tuple[int, int]:
    """Index of the first line of an operation's moves, and of the line after them."""
    lines = text.splitlines()
    first = lines.index(f"(operation: {name})")
    last = next(k for k in range(first + 1, len(lines)) if lines[k].startswith(("(operation", "M9")))
    return first, last


def test_a_level_that_is_missing_is_too_much_for_the_next() -> None:
    of, text = deep()
    assert prove(text, of).ok
    first, last = operation_of(text, "recess: rough")
    lines = text.splitlines()
    # The way round at a level: between the end of its ramp and the beginning of the next one.
    heights = [k for k in range(first, last) if "Z-" in lines[k]]
    rounds = [(a + 1, b) for a, b in pairwise(heights) if b - a > 8]
    assert len(rounds) >= 2
    for a, b in rounds[:2]:
        without = prove("\n".join(lines[:a] + lines[b - 1 :]), of)
        assert not without.ok
    (a, b), (c, _) = rounds[:2]
    found = asked("depth-of-cut", "\n".join(lines[:a] + lines[b - 1 :]), of)
    assert not found.passed
    assert found.line >= c - (b - 1 - a)
    assert "cuts more than 4.5 mm of aluminium at once, 1.5 times its step_down" in found.message


@pytest.mark.parametrize("control", CONTROLS)
def test_nothing_goes_far_below_the_plate(control: str) -> None:
    """A drill has its point below, and a through cut its 0.3 mm; a wrong digit is more."""
    one = made("peck", control)
    lines = one.text.splitlines()
    at = max(k for k, line in enumerate(lines) if "Z-19.20" in line)
    lines[at] = lines[at].replace("Z-19.20", "Z-29.20")
    found = asked("underside", "\n".join(lines), one.job, BY_NAME[control])
    assert re.match(rf"line {at + 1}: T4 goes 11.20 mm below the plate", found.message)
    shallow = one.text.replace("Z-19.20", "Z-20.10")
    assert asked("underside", shallow, one.job, BY_NAME[control]).passed


def test_lines_that_a_switch_skips_are_proven_both_ways() -> None:
    one = made("pocket-contour")
    extra = one.text.replace("M9\n", "/(nothing)\nM9\n")
    assert prove(extra, one.job).ok
    found = prove(one.text.replace("\nM8\n", "\n/M8\n"), one.job).checks["coolant"]
    assert re.match(r"with lines that start with / skipped, line \d+: cuts with coolant off", found.message)
    with pytest.raises(
        ProgramError, match=r"^with lines that start with / skipped, line 19: .* without a feed"
    ):
        prove(re.sub(r"\nG1 Z0 (F\d+)", r"\n/\1\nG1 Z0", one.text, count=1), one.job)


SURE = (
    *(
        "G54 -> G55",
        "G54 lost",
        "M3 lost",
        "M3 -> M4",
        "M6 lost",
        "M8 lost",
        "M8 -> M7",
        "G17 -> G18",
        "G17 lost",
    ),
    *("G21 -> G20", "G21 lost", "G40 lost", "G41 -> G42", "G41 lost", "G43 lost", "G43 -> G49", "G53 lost"),
    *("G91.1 -> G90.1", "G94 -> G93", "G2 -> G1", "another T", "another H", "T lost", "Q lost"),
    *("R lost", "S times 10", "S times 0.1", "F times 100", "point lost", "tab lost", "I off by 1"),
    *(
        "Q times 1000",
        "Z sign",
        "Y off by 10",
        "line lost: safe start",
        "line lost: tool change",
        "cut short",
    ),
)
"""Faults that nothing excuses."""
SOURCES = (
    *(("compensation", "haas"), ("compensation", "linuxcnc"), ("rest", "mach3"), ("tabs-ramped", "grbl")),
    *(
        ("peck", "fanuc"),
        ("drill", "haas"),
        ("chamfer", "linuxcnc"),
        ("thread", "mach3"),
        ("engrave", "grbl"),
    ),
    *(("profile-outside", "fanuc"), ("second-side", "haas"), ("bull-nose", "linuxcnc"), ("floor", "grbl")),
)
EACH = examples(2, 3)


def verdict(text: str, one: Machined, control: str) -> tuple[bool, str]:
    """Whether a program is refused, and what is said of it."""
    try:
        failures = prove(text, one.job, BY_NAME[control]).failures
    except ProgramError as error:
        return True, str(error)
    return bool(failures), "; ".join(check.message for check in failures)


@pytest.mark.parametrize("kind", SURE)
def test_a_fault_that_changes_anything_is_refused(kind: str) -> None:
    rng = np.random.default_rng(zlib.crc32(kind.encode()))
    tried = 0
    for place in rng.permutation(len(SOURCES)).tolist():
        operation, control = SOURCES[place]
        one, reader = made(operation, control), BY_NAME[control]
        wrong = mutant(one.text, kind, rng)
        if wrong is None or tried == EACH:
            continue
        tried += 1
        is_refused, said = verdict(wrong.text, one, control)
        if is_refused:
            assert re.search(r"\bline \d+: ", said), said
        else:
            before, after = (trace(read(text, one.job, reader)) for text in (one.text, wrong.text))
            assert not differences(before, after), f"{operation} {control}, {wrong.line}: {wrong.change}"
    assert tried


@pytest.mark.parametrize("depth", ["1.", "-1."])
@pytest.mark.parametrize("control", CONTROLS)
def test_a_feed_move_from_the_upper_end_is_refused_in_a_line(control: str, depth: str) -> None:
    """Its length is not known; nor does it make the fall to the stock slower than it is fed."""
    one = made("pocket-contour", control)
    lines = one.text.splitlines()
    at = next(k for k, line in enumerate(lines) if re.search(r"\bZ5\b", line))
    lines[at : at + 1] = [lines[at].replace("Z5.", "").replace("Z5", ""), f"G1 Z{depth} F9000.", "G0 Z5."]
    lines[at] = re.sub("G1 |G0 ", "", lines[at])
    text = "\n".join([*lines, ""])
    if control == "fanuc":  # which may move by the length alone
        with pytest.raises(ProgramError, match=rf"line {at + 1}: G43 without a height to go to"):
            prove(text, one.job, BY_NAME[control])
        return
    found = prove(text, one.job, BY_NAME[control])
    assert re.match(rf"line {at + 2}: moves from an unknown height", found.checks["positions"].message)
    assert found.checks["plunges"].passed is (depth == "1.")
    assert sum(each.cutting_mm for each in found.operations) < 1000


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "grbl"])
def test_what_stands_behind_the_end_is_not_taken_for_proven(control: str) -> None:
    one = made("profile-outside", control)
    assert prove(one.text + "(spare)\n\nwritten by hand\n", one.job, BY_NAME[control]).ok
    rest = "M30\n(once more)\nG0 X0 Y0\nM30\n"
    found = refused(one, "M30\n", rest, "program-end", control)
    line = one.text[: one.text.index("M30\n")].count("\n") + 3
    assert found.line == line
    assert "behind the program's end" in found.message


def cuts(rows: np.ndarray) -> np.ndarray:
    """What a machine does while it cuts, of a trace."""
    return rows[np.isin(rows[:, 0], (Kind.FEED, Kind.ARC))]


@pytest.mark.parametrize("control", thinned(3, CONTROLS))
def test_state_words_at_any_place_are_refused_or_change_no_cut(control: str) -> None:
    """By the reader, by a rule, or because the program states it itself before the next cut."""
    rng = np.random.default_rng(53)
    one, reader = made("pocket-contour", control), BY_NAME[control]
    before = cuts(trace(read(one.text, one.job, reader)))
    refusals = 0
    first = CONTROLS.index(control) % 2
    for state in STATES if NIGHT else STATES[first::2]:
        wrong = mutant(one.text, f"inserted {state}", rng)
        assert wrong is not None
        is_refused, said = verdict(wrong.text, one, control)
        if is_refused:
            assert re.search(r"\bline \d+: ", said), said
            refusals += 1
            continue
        changed = differences(before, cuts(trace(read(wrong.text, one.job, reader))))
        # A rapid that is fed instead, in air, takes longer and no more.
        assert not changed or state == "G1", f"line {wrong.line}: {wrong.change}: {changed}"
    assert refusals > (160 if NIGHT else 80)
