"""What controls read that others wrote, and what three decimals change."""

from dataclasses import replace

import numpy as np
import pytest
from by_control import BY_NAME, CONTROLS, asked, interpret, prove
from golden_programs import every_operation
from hypothesis import given, settings
from hypothesis import strategies as st
from shop import TOOLS, plate_job, plate_program
from test_controls import post_of, read

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind
from mechwright_cam.program.moves import Drill, Program, Rapid

# -- reading what others wrote ------------------------------------------------------------------------------


HEAD = {"fanuc": "%\nO1234 (ANY)\n", "haas": "%\nO1234\n", "grbl": "", "mach3": ""}


@pytest.mark.parametrize(
    ("control", "line", "message"),
    [
        ("fanuc", "G0 X10 Y5.", r"X10 has no decimal point, and Fanuc may read thousandths"),
        ("haas", "G1 Z-2 F100.", "Z-2 has no decimal point"),
        ("fanuc", "G0 X1. ; note", "starts no word"),
        ("fanuc", "G65 P9000", "macros and subprograms"),
        ("fanuc", "M98 P100", "there is no O100 in this file; no other is read"),
        ("fanuc", "G54.1 X1.", "needs its number, P"),
        ("fanuc", "G91.1", "G91.1 is no code"),
        ("haas", "G54.1 P3", "G54.1 is no code that is read in programs for Haas"),
        ("mach3", "G84 X1 Y1 Z-2 R1", "G84 without a feed"),
        ("grbl", "G43 H1 Z5", "no table of lengths"),
        ("grbl", "T1 M6", "M6 is no code that is read in programs for Grbl"),
        ("grbl", "G81 X1 Y1 Z-1 R1 F9", "G81 is no code that is read in programs for Grbl"),
        ("grbl", "G41 D1", "G40 only"),
        ("grbl", "(wait!)", "obeys '!'"),
        ("grbl", "%", "% stands in a line"),
        ("grbl", "G0 X1 Y2 " + "Z3." + "0" * 80, "reads at most 79"),
        ("grbl", "G2 X10.02 Y0 I5 J0 F9", "Grbl 1.1 refuses it"),
    ],
)
def test_what_a_control_would_refuse_is_refused(control: str, line: str, message: str) -> None:
    start = HEAD[control] + "G17 G21 G90 G94\nG0 X0. Y0. Z0.\n"
    with pytest.raises(ProgramError, match=rf"^line {start.count(chr(10)) + 1}: .*{message}"):
        interpret(start + line + "\n", BY_NAME[control])


def test_dwells_are_read_in_the_control_s_unit() -> None:
    start = "G17 G21 G90 G94\nG0 X0. Y0. Z0.\n"
    for control, line, seconds in (
        ("linuxcnc", "G4 P1.5", 1.5),
        ("fanuc", "G4 P500", 0.5),
        ("fanuc", "G4 X2.5", 2.5),
        ("haas", "G4 P2.", 2.0),
        ("haas", "G82 X1. Y1. Z-1. R1. P250 F90.", 0.25),
        ("grbl", "G4 P0.2", 0.2),
    ):
        run = interpret(start + line + "\n", BY_NAME[control])
        assert run.seconds.sum() == pytest.approx(seconds), line


def test_a_tool_that_nobody_measured_is_noticed() -> None:
    job = plate_job(control="grbl")
    text = post_of("grbl").write(plate_program())
    assert prove(text, job, BY_NAME["grbl"]).ok
    at = text.index("M0\n", text.index("\nT2\n"))
    silent = text[:at] + text[at + 3 :]
    found = asked("length-offset", silent, job, BY_NAME["grbl"])
    assert not found.passed
    assert "as if it were as long as the tool before" in found.message


def test_a_length_that_was_not_measured_so_is_noticed() -> None:
    tools = tuple(tool.model_copy(update={"length": 50.0 + tool.number}) for tool in TOOLS)
    program = plate_program()
    sections = tuple(
        replace(s, tool=next(t for t in tools if t.number == s.tool.number)) for s in program.sections
    )
    text = post_of("grbl").write(replace(program, sections=sections))
    job = plate_job(control="grbl", tools=tools)
    assert prove(text, job, BY_NAME["grbl"]).ok
    found = asked("length-offset", text.replace("G43.1 Z52", "G43.1 Z53"), job, BY_NAME["grbl"])
    assert "G43.1 Z53 while the measured length of T2 is 52 mm" in found.message


@pytest.mark.parametrize(
    ("control", "retract_z", "words"),
    [
        ("linuxcnc", 0.0, "retract with G53 G0 Z0"),
        ("linuxcnc", -1.5, "retract with G53 G0 Z-1.5"),
        ("mach3", 0.0, "retract with G53 G0 Z0"),
        ("haas", 0.0, "retract with G53 G0 Z0."),
        ("fanuc", 0.0, "retract with G91 G28 Z0., then G90"),
        ("grbl", -2.0, "retract with G53 G0 Z-2"),
        (
            "grbl",
            0.0,
            "retract with G53 G0 Z0, after setting cam.machine.retract_z below the homing switch, such as -2",
        ),
    ],
)
def test_a_retract_is_advised_as_the_control_and_the_machine_do_it(control, retract_z, words) -> None:
    made = plate_job()
    mill = made.settings.machine.model_copy(update={"retract_z": retract_z})
    made = replace(made, settings=made.settings.model_copy(update={"machine": mill}))
    text = post_of(control).write(replace(plate_program(), machine=mill))
    assert asked("positions", text, made, BY_NAME[control]).passed
    retract = (
        "G91 G28 Z0.\nG90\n" if control == "fanuc" else words.removeprefix("retract with ").split(",")[0]
    )
    assert retract in text  # it is what the post writes
    found = asked("positions", text.replace(retract, ""), made, BY_NAME[control])
    assert not found.passed
    assert f"{words}, at X" in found.message


def test_whoever_touches_off_leaves_the_tool_low() -> None:
    text = post_of("grbl").write(plate_program())
    careless = text.replace("M0\nG53 G0 Z-2\n", "M0\n")
    assert careless != text
    assert not asked("positions", careless, plate_job(control="grbl"), BY_NAME["grbl"]).passed


# -- rounding to three decimals -----------------------------------------------------------------------------


@given(
    st.lists(
        st.tuples(
            st.floats(-90, 90), st.floats(-90, 90), st.floats(0.05, 60), st.floats(-3, 3), st.floats(0.02, 6)
        ),
        min_size=1,
        max_size=8,
    )
)
@settings(max_examples=60)
def test_three_decimals_keep_arcs_consistent(arcs) -> None:
    from math import cos, sin

    from mechwright_cam.program.moves import Feed, FeedArc, Operation, ToolSection

    moves = [Rapid(0.0, 0.0, 1.0)]
    for x, y, radius, start, sweep in arcs:
        cx, cy = x - radius * cos(start), y - radius * sin(start)
        end = (cx + radius * cos(start + sweep), cy + radius * sin(start + sweep))
        moves += [Feed(x, y, None, 100), FeedArc(*end, None, cx - x, cy - y, True, 100)]
    section = ToolSection(TOOLS[2], 1000, "off", (Operation("one", tuple(moves)),))
    program = Program("one", "G54", 5.0, (section,))
    for control in ("fanuc", "grbl"):
        run = read(control, program)
        assert run.arc_error.max(initial=0.0) <= 0.0012
        assert np.abs(run.end[run.cutting][-1, :2] - (moves[-1].x, moves[-1].y)).max() <= 6e-4


def test_through_cuts_stay_through_when_rounded() -> None:
    from mechwright_cam.controls.writing.writer import Writer

    out = Writer(every_operation(), 3, False)
    assert out.height(-6.00004) == "-6.001"
    assert out.height(5.00004, up=True) == "5.001"
    assert out.height(-6.0) == "-6"


def test_a_peck_with_a_dwell_is_written_out() -> None:
    program = every_operation()
    moves = (Rapid(1, 1, 5), Drill(1, 1, -5, 1, 100, peck=2, dwell=0.3))
    one = replace(
        program,
        sections=(
            replace(
                program.sections[1], operations=(replace(program.sections[1].operations[0], moves=moves),)
            ),
        ),
    )
    for control in CONTROLS:
        run = read(control, one)
        assert run.seconds.sum() == pytest.approx(0.3)
        assert run.end[run.kind == Kind.FEED][:, 2].tolist() == [-1, -3, -5]


PLAIN = "G17 G21 G40 G90 G94\nT1 M6\nG54\nG0 X0. Y0. Z5.\n"


@pytest.mark.parametrize("name", ["fanuc", "haas"])
def test_a_spindle_may_start_beside_a_rapid_and_not_beside_a_feed_whose_order_the_builder_sets(
    name: str,
) -> None:
    for line in ("G0 X5. S900 M3", "S900 M3", "G1 F100. S900 M3"):
        assert interpret(f"{PLAIN}{line}\nM30\n", BY_NAME[name]).states[-1].rpm == 900
    for line in ("G1 Z-1. F100. S900 M3", "G2 X5. Y5. I5. J0. F100. S900 M3"):
        with pytest.raises(ProgramError, match=r"^line 5: M3 beside a feed: whether"):
            interpret(f"{PLAIN}{line}\nM30\n", BY_NAME[name])
    with pytest.raises(ProgramError, match=r"^line 6: M3 beside a feed: whether"):
        interpret(f"{PLAIN}G1 F100.\nX5. S900 M3\nM30\n", BY_NAME[name])


def test_g54_with_p_is_an_offset_of_its_own_and_g55_with_p_is_nothing() -> None:
    run = interpret(PLAIN.replace("G54", "G54 P3") + "M30\n", BY_NAME["fanuc"])
    assert run.states[-1].work_offset == "G54.1 P3"
    for name, words in (("fanuc", "G55 P3"), ("haas", "G54 P3")):  # Haas has G154 P for it
        with pytest.raises(ProgramError, match=r"^line 3: P means nothing in this line"):
            interpret(PLAIN.replace("G54", words) + "M30\n", BY_NAME[name])


def test_an_arc_from_an_unknown_place_names_the_line_that_lost_it() -> None:
    text = "G17 G21 G40 G90 G94 G54\nG0 X0 Y0 Z5\n{}\nG2 X5 Y5 I5 J0 F100\nM2\n"
    for line, since in (
        ("G28", "G28 in line 3"),
        ("G53 G0 X0", "G53 in line 3"),
        ("G28 Z9\nG0 Z5\nG28", "G28 in line 5"),
    ):
        with pytest.raises(
            ProgramError, match=f"an arc from an unknown position, unknown since {since}; move"
        ):
            interpret(text.format(line), BY_NAME["linuxcnc"])
