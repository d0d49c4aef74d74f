"""Programs once proven that cut what they should not, and reasons once told wrongly, one by one on each control.

:mod:`test_named_states` has the moves, offsets, paths and texts; here are parts that nothing holds, cutters in
material that they do not cut, what LinuxCNC refuses or runs, and wrong words.
"""

import re
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from by_control import BY_NAME, EVERY, asked, interpret, prove
from by_night import thinned
from golden_operations import made
from klartext_blocks import anew
from machine_programs import job_of, text_of
from rs274 import needs_rs274, run_rs274
from test_cutting_faults import before, changed, fed, files_of, fitted, found_by, only, turned_round
from test_mutations import deep
from test_named_states import reasons

from mechwright.contracts.part import Part
from mechwright.errors import ProgramError, ProofError
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.machining import Machined, machine
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Feed, FeedArc, Move, Operation, Program, Rapid
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import built_in
from mechwright_cam.shop.settings import CamSettings

# -- class 2: a part cut free, and a clamp that comes whenever ----------------------------------------------


def operation_lines(text: str) -> dict[str, int]:
    """Operation to the place of its comment."""
    found = ((re.search(r"operation: ([^)]*)", line, re.I), k) for k, line in enumerate(text.split("\n")))
    return {match[1].lower(): k for match, k in found if match}


def with_the_stop(control: str, where: str) -> str:
    """The program of a part that is clamped through its bore, with the stop at another place, or without it."""
    (one,) = made("profile-outside", control)
    lines, at = one.text.split("\n"), operation_lines(one.text)
    first, last = at["clamp"], at["outside: rough"]
    stop, rest = lines[first:last], lines[:first] + lines[last:]
    place = operation_lines("\n".join(rest))
    into = {"before the bore": place["bore: bore"], "after the part is free": place["outside: finish"]}
    into |= {"never": 0}
    moved = rest if where == "never" else rest[: into[where]] + stop + rest[into[where] :]
    return anew("\n".join(moved))


@pytest.mark.parametrize("control", EVERY)
@pytest.mark.parametrize("where", ["before the bore", "after the part is free", "never"])
def test_a_stop_is_no_clamp_whenever_it_comes(control: str, where: str) -> None:
    (one,) = made("profile-outside", control)
    text = with_the_stop(control, where)
    line, message = reasons(text, one.job, control)["holding"]
    # The line that frees it is in the last turn of roughing, by feed, and the reason is the clamp.
    at = operation_lines(text)
    assert line is not None
    assert at["outside: rough"] + 1 < line <= at["outside: finish"]
    assert "the part comes loose: nothing holds it when this is cut" in message
    assert ("no M0 sets the clamp" if where == "never" else "the clamp is set by the M0") in message


@pytest.mark.parametrize("control", EVERY)
def test_a_part_without_tabs_is_cut_free(control: str) -> None:
    """The last pass goes straight through where the tabs should be; it does not rise over them."""
    text = anew(re.sub(r"\n(?:\d+ L )?Z-4\.9(?=\n)", "", text_of(control)))
    assert text.count("Z-4.9") == 0
    job = replace(job_of(control), tabs=())
    line, message = reasons(text, job, control)["holding"]
    assert line is not None
    assert line > text[: text.index("Z-6.3 F150")].count("\n") + 1
    assert "the part comes loose: nothing holds it when this is cut" in message


# -- class 5: cutters in material that they do not cut so --------------------------------------------------


def slip_down(one: Machined) -> Program:
    """A mill that ramps elsewhere, straight down at the feed of its full cut."""
    section = one.program.sections[0]
    full = max(move.feed for move in section.operations[0].moves if isinstance(move, Feed))
    moves = (Rapid(0, 0), Rapid(z=1), Feed(None, None, 0, full), Feed(None, None, -1.5, full), Rapid(z=5))
    return before(one.program, moves, section.tool.number)


CUTS: dict[str, tuple[str, Callable[[Machined], Program], str, str]] = {
    "a thread mill without its hole": (
        "thread",
        lambda one: changed(one.program, only("m6: thread")),
        "edges",
        "T45 (thread-m6) is fed into material with its neck",
    ),
    "a chamfer mill into full material": (
        "chamfer",
        lambda one: changed(one.program, only("edge: chamfer")),
        "edges",
        "T40 (chamfer-6) is fed into material with its point, which does not cut",
    ),
    "a plunge at full feed": ("pocket-contour", slip_down, "plunges", "T23 (mill-8) down into aluminium at"),
    "2.5 times the chip load in a slot": (
        "slot",
        lambda one: changed(one.program, fed(2.5, "slot: rough")),
        "chips",
        "mm per tooth into aluminium, the tool library says",
    ),
    "a feed of 1 mm/min": (
        "slot",
        lambda one: changed(one.program, at_one_mm_a_minute("slot: rough")),
        "chips",
        "an edge rubs instead of cutting",
    ),
}


def at_one_mm_a_minute(name: str) -> Callable[[Operation], Operation]:
    def slow(move: Move) -> Move:
        return replace(move, feed=1.0) if isinstance(move, Feed | FeedArc) else move

    return lambda one: replace(one, moves=tuple(map(slow, one.moves))) if one.name == name else one


@pytest.mark.parametrize(("name", "control"), thinned(2, CUTS, EVERY))
def test_a_cutter_that_does_not_cut_so_is_refused(name: str, control: str) -> None:
    operation, change, rule, why = CUTS[name]
    (one,) = made(operation, control)
    found = found_by(rule, change(one), one.job, control)
    assert not found.passed
    assert re.match(rf"(?:.*, )?line {found.line}: ", found.message)
    assert why in found.message


@pytest.mark.parametrize("control", EVERY)
def test_finishing_before_roughing_is_refused(control: str) -> None:
    of, _ = deep()
    program = replace(plan(of), machine=of.settings.machine)
    proof = prove(files_of(turned_round(program, "recess: finish"), control), of, BY_NAME[control])
    blamed = [check for check in proof.failures if check.name in {"depth-of-cut", "chips"}]
    assert blamed
    assert all(
        re.match(rf"line {check.line}: T", check.message) or "feeds T" in check.message for check in blamed
    )


@pytest.mark.parametrize("control", EVERY)
def test_climb_reversed_is_told_and_refused_where_it_is_asked_for(control: str) -> None:
    (one,) = made("conventional", control)
    cam = one.job.settings
    rest = cam.model_dump(include=cam.model_fields_set - {"climb"})

    def job(**said: bool) -> Job:
        return replace(one.job, settings=type(cam).model_validate({**rest, **said}))

    found = asked("climb", files_of(one.program, control), job(climb=True), BY_NAME[control])
    assert not found.passed
    assert f"line {found.line}: T23 (mill-8) finishes " in found.message
    assert "by conventional milling, the job asks for climb; turn the path round" in found.message
    usual = prove(files_of(one.program, control), job(), BY_NAME[control])
    assert usual.ok
    assert any("by conventional milling, the usual way is climb" in note for note in usual.notes)


@pytest.mark.parametrize("control", EVERY)
def test_coolant_is_off_at_a_stop(control: str) -> None:
    (one,) = made("profile-outside", control)
    lines = one.text.split("\n")
    stop = next(k for k, line in enumerate(lines) if re.fullmatch(r"(N?\d+ )?M0", line))
    off = max(k for k in range(stop) if re.fullmatch(r"(N?\d+ )?M9", lines[k]))
    wet = anew("\n".join(lines[:off] + lines[off + 1 :]))
    line, message = reasons(wet, one.job, control)["stops"]
    assert line == stop  # one line less stands before it
    assert "M0 stops the program while coolant runs; write M9 before it" in message


# -- class 7: what LinuxCNC refuses, and what it runs -------------------------------------------------------

HEAD = "G17 G21 G40 G90 G94\nG64 P0.002 Q0\nT1 M6\nG0 X0 Y0 Z5\nF100\n"
TABLE = "T1 P1 D0.236220472 Z0\n"
"""A mill of 6 mm: the interpreter's table is in inches."""
INNER = "the tool of radius 3 mm does not fit into the inner corner"
REFUSED = {
    "back on itself in a corner": ("G41 D1 X0 Y10\nX10\nY11\nX0\nG40 Y30", 4, INNER),
    "a step narrower than the cutter": ("G42 D1 G1 X10 Y10\nX20\nY12\nX21\nY10\nX40\nG40 Y0", 4, INNER),
    "a pocket narrower than the cutter": ("G42 D1 G1 X10 Y10\nX20\nY8\nX18\nG40 Y0", 4, INNER),
    "an inside arc too narrow": (
        "G41 D1 G1 X10 Y10\nX20\nG3 X20 Y14 I0 J2\nG1 X10\nG40 Y0",
        3,
        "does not fit",
    ),
    "an exit on an arc": ("G41 D1 G1 X10 Y10\nX20\nG40 G2 X30 Y0 I0 J-10", 3, "is an arc; leave on a line"),
    "an arc behind the exit": (
        "G41 D1 G1 X10 Y10\nX20\nG40\nG2 X30 Y0 I0 J-10",
        4,
        "is an arc; leave on a line",
    ),
    "radii that differ": (
        "G2 X10 Y0 I5.02 J0",
        1,
        "the arc ends 0.0400 mm nearer or further from its centre",
    ),
    "radii of another arc": ("G2 X20 Y0 I5 J0", 1, "the arc ends 10.0000 mm nearer or further"),
    "radii that differ, in inches": ("G20\nG2 X2 Y0 I1.0015 J0", 2, "nearer or further from its centre"),
}
RUN = {
    "an arc in inches": "G20\nG2 X1 Y0 I0.5 J0",
    "an arc with R in inches, a little too short": "G20\nG2 X1 Y0 R0.49996",
    "an arc a little off its end": "G2 X10 Y0 I5.0015 J0",
    "an arc that enters compensation": "G41 D1 G2 X10 Y10 I10 J0\nG1 X20\nG40 Y0",
    "an outer corner under compensation": "G41 D1 G1 X10 Y10\nX20\nX21 Y12\nX22 Y10\nX40\nG40 Y30",
    "a subprogram, twice": "M98 P7 L2\nM2\nO7\nG91 G1 X1\nG90\nM99",
}


@needs_rs274
@pytest.mark.parametrize("name", REFUSED)
def test_linuxcnc_refuses_it_and_so_do_we(name: str) -> None:
    lines, number, why = REFUSED[name]
    with pytest.raises(ProgramError, match=rf"^line {HEAD.count(chr(10)) + number}: .*{re.escape(why)}"):
        interpret(f"{HEAD}{lines}\nM2\n", start=(0.0, 0.0, 0.0), diameters={1: 6.0})
    with tempfile.TemporaryDirectory() as folder:
        assert not run_rs274(f"{HEAD}{lines}\nM2\n", Path(folder), TABLE).ok


@needs_rs274
@pytest.mark.parametrize("name", RUN)
def test_linuxcnc_runs_it_and_so_do_we(name: str) -> None:
    run = interpret(f"{HEAD}{RUN[name]}\nM2\n", start=(0.0, 0.0, 0.0), diameters={1: 6.0})
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(f"{HEAD}{RUN[name]}\nM2\n", Path(folder), TABLE)
    assert canon.ok, canon.error
    scale = 25.4 if "G20" in RUN[name] else 1.0
    assert run.end[-1].tolist() == pytest.approx((canon.ends[-1] * scale).tolist(), abs=2e-3)


# -- wrong words --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", EVERY)
def test_a_mill_of_6_on_the_path_of_one_of_8_is_called_so(control: str) -> None:
    (one,) = made("profile-inside", control)
    wrong = fitted(one, "mill-8", diameter=6.0)
    found = reasons(one.text, wrong.job, control)
    messages = [found[rule][1] for rule in ("gouge", "depth", "leftover") if rule in found]
    assert messages
    assert all("the path is made for a tool of another diameter, and " in message for message in messages)
    assert not any(re.match(r"\S+ is cut down to Z0\.000", message) for message in messages)


@pytest.mark.parametrize("control", EVERY)
def test_line_ends_of_an_old_system_are_named(control: str) -> None:
    text = text_of(control).replace("\n", "\r")
    (said,) = reasons(text, job_of(control), control).values()
    assert said[0] == 1
    assert "a carriage return (CR) ends no line" in said[1]
    assert reasons(text_of(control).replace("\n", "\r\n"), job_of(control), control) == {}


@pytest.mark.parametrize("words", ["G05.1 Q1", "G5.1 Q1", "G05.1 Q1 R10"])
def test_fanuc_s_look_ahead_is_read_as_listed(words: str) -> None:
    text = text_of("fanuc").replace("\nG64\n", f"\nG64\n{words}\n", 1)
    assert words in text
    assert reasons(text, job_of("fanuc"), "fanuc") == {}


@pytest.mark.parametrize("control", EVERY)
def test_a_ring_of_a_fifth_of_a_millimetre_is_not_blamed_on_its_tabs(control: str) -> None:
    rim = Outline(Loop((circle((0.0, 0.0), 12.0),)), (Loop((circle((0.0, 0.0), 11.8, clockwise=True),)),))
    part, cutters = Part("ring", rim, 4.0, "aluminium"), [built_in().get("mill-6")]

    def job(**hold: str) -> Job:
        return make_job(part, CamSettings.model_validate({"hold": hold, "control": control}), cutters)

    assert machine(job(method="tabs"), BY_NAME[control]).proof.ok
    with pytest.raises(ProofError) as error:
        machine(job(method="none", bed="tape"), BY_NAME[control])
    assert "the part comes loose: " in str(error.value)
    assert "leave pieces of 100 mm² at least, or tabs" in str(error.value)
    assert "[tabs]" not in str(error.value)


# -- a thread mill beside its helix -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("operation", "control"),
    thinned(2, ["thread", "thread-left", "thread-inch"], [c for c in EVERY if c != "heidenhain-tnc"]),
)
def test_a_thread_mill_does_not_go_round_beside_its_helix(operation: str, control: str) -> None:
    """A full circle along the wall at the depth where the mill comes in, or goes out: it climbs by no pitch.

    The rule asks for paths, whatever the words; those of Klartext come with a centre in a block of its own.
    """
    (one,) = made(operation, control)
    files = dict(one.files)
    stem, text = list(files.items())[-1]
    lines = text.split("\n")
    out = max(k for k, line in enumerate(lines) if re.search(r"X-?0\.? Y0\.? I", line))
    down = max((k for k in range(out) if re.match(r"G1 Z", lines[k])), default=0)
    wall = out - 1 if "Z-" in lines[out - 1] else down + 1
    at = re.search(r"X(-?[\d.]+) ", lines[wall])
    assert at is not None
    lines.insert(wall + 1, f"X{at[1]} Y0. I{-float(at[1])} J0.")
    files[stem] = "\n".join(lines)
    wrong = files if len(files) > 1 else files[stem]
    found = asked("details", wrong, one.job, BY_NAME[control])
    assert not found.passed
    assert re.match(
        rf"(?:\S+: )?line {found.line}: T\d+ \(thread-\w+\) cuts 0\.\d+ mm into the turns of ", found.message
    )
    assert found.line == wall + 2
    assert found.value is not None
    assert found.limit is not None
    assert found.value > 3 * found.limit
    right = asked("details", one.files if len(files) > 1 else one.text, one.job, BY_NAME[control])
    assert right.passed


@pytest.mark.parametrize("by", [0.25, 0.5, 0.9])
def test_a_second_helix_beside_the_first_is_none(by: float) -> None:
    """A thread mill that goes down and along the helix again, a part of a pitch lower, cuts two grooves."""
    (one,) = made("thread", "linuxcnc")
    lines = one.text.split("\n")
    first = next(k for k, line in enumerate(lines) if "thread)" in line and "operation" in line)
    down = next(k for k in range(first, len(lines)) if lines[k].startswith("G1 Z"))
    up = next(k for k in range(down, len(lines)) if lines[k].startswith("G0 Z"))
    off = [re.sub(r"Z(-?[\d.]+)", lambda z: f"Z{float(z[1]) - by:g}", line) for line in lines[down:up]]
    again = "\n".join([*lines[:up], "G1 X0 Y0 F200", "G0 Z1", *off, *lines[up:]])
    found = asked("details", again, one.job)
    assert not found.passed
    assert "off its helix" in found.message
    same = [re.sub(r"Z(-?[\d.]+)", lambda z: f"Z{float(z[1]) - 0.0:g}", line) for line in lines[down:up]]
    assert asked("details", "\n".join([*lines[:up], "G0 Z1", *same, *lines[up:]]), one.job).passed
