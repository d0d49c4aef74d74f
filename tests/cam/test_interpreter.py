"""The interpreter against the rules of RS274/NGC: what it reads, and what it refuses with a line number."""

import math
from dataclasses import replace

import numpy as np
import pytest
from by_control import BY_NAME, LINUXCNC, interpret
from hypothesis import given
from hypothesis import strategies as st

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind, State, modes
from mechwright_cam.controls.reading.motions import MOST_TURNS
from mechwright_cam.controls.words.table import Words

START = "G17 G21 G40 G49 G80 G90 G94\nG54\nG0 X0 Y0 Z5\n"


def ends(text: str) -> list[list[float]]:
    run = interpret(START + text + "\nM2")
    return run.end[(run.kind != Kind.END)][1:].tolist()


def test_words_may_come_in_any_order_case_and_spacing() -> None:
    plain = ends("G1 X10 Y-2.5 F100")
    assert plain == ends("f100y-2.5x10g01") == ends("N30 G1(a)X1 0 Y - 2.5 F100 ; b".replace("- 2", "-2"))
    assert plain == [[10.0, -2.5, 5.0]]


@pytest.mark.parametrize(
    "line",
    ["G1 X1.25 Y2 Z-1 F90", "G2 X3 Y0 Z1 I1.5 J0 F80", "G3 X0 Y0 I4 J3 F10", "G0 Z7", "G1 Y-3 F1"],
)
def test_the_quick_path_and_the_general_path_agree(line: str) -> None:
    quick, general = interpret(START + line), interpret(START + line + " (a comment)")
    assert len(quick) == len(general) == 2
    for name in ("kind", "line", "start", "end", "centre", "sweep", "feed", "arc_error"):
        np.testing.assert_array_equal(getattr(quick, name), getattr(general, name))


def test_inches_and_distances() -> None:
    assert ends("G20\nG1 X1 F10") == [[25.4, 0.0, 5.0]]
    assert ends("G91\nG1 X1 Y2 F10\nX1 Z-1") == [[1.0, 2.0, 5.0], [2.0, 2.0, 4.0]]
    run = interpret(START + "G20 G1 X1 F10")
    assert run.feed[-1] == 254.0


def test_a_place_by_distance_and_angle() -> None:
    """From the origin, where no direction is known, both are needed; elsewhere what is not named stays."""
    along = math.radians(30)
    there = [10 * math.cos(along), 10 * math.sin(along), 5.0]
    assert ends("G0 @10 ^30") == [pytest.approx(there)]
    assert ends("G0 @10 ^30 Z1") == [pytest.approx([*there[:2], 1.0])]
    assert ends("G0 X0 Y10\n@4") == [[0.0, 10.0, 5.0], pytest.approx([0.0, 4.0, 5.0])]
    assert ends("G0 X0 Y10\n^30") == [[0.0, 10.0, 5.0], pytest.approx(there)]
    for alone in ("@10", "^30"):
        with pytest.raises(
            ProgramError, match=r"^line 4: polar coordinates from a place without a direction"
        ):
            ends(f"G0 {alone}")


def test_an_arc_has_so_many_turns_at_most() -> None:
    most = MOST_TURNS
    assert interpret(f"{START}G2 I5 J0 P{most} F9").sweep[-1] == pytest.approx(-most * math.tau)
    for turns in (0, most + 1):
        with pytest.raises(ProgramError, match=rf"^line 4: P is the number of turns, 1 to {most}$"):
            interpret(f"{START}G2 I5 J0 P{turns} F9")


def test_offsets_may_not_change_under_compensation() -> None:
    """Contour and table would belong to different places."""
    text = f"{START}G41.1 D2 G1 X10 Y10 F100\nX20\nG10 L2 P1 X1 Y1\nG40 X40\nM2"
    with pytest.raises(ProgramError, match=r"^line 6: G10 .*compensation"):
        interpret(text)


def test_behind_the_end_of_a_program_stand_subroutines_alone() -> None:
    """They are none of its moves; of other lines it is told where they begin."""
    plain = ends("G0 X1")
    for letter in "oO":
        run = interpret(f"{START}G0 X1\nM2\n{letter}200 sub\nG0 X9\n{letter}200 endsub\n")
        assert run.end[run.kind != Kind.END][1:].tolist() == plain
        assert run.beyond == 0
    assert interpret(f"{START}G0 X1\nM2\n\nG0 X9\n").beyond == 7
    run = interpret("#1=5\n" + START + "G0 X#1")  # and it may have none
    assert run.end[-1].tolist() == [5.0, 0.0, 5.0]


@pytest.mark.parametrize(
    ("spindle", "rpm", "turning"), [(1, 1.0, 1), (-1, 0.5, -1), (1, 12000.0, 1), (1, 0.0, 0), (0, 500.0, 0)]
)
def test_a_spindle_turns_at_any_speed_above_0(spindle: int, rpm: float, turning: int) -> None:
    assert State(spindle=spindle, rpm=rpm).spindle_rotation == turning


def test_the_diameter_of_compensation_is_in_the_units_of_the_program() -> None:
    """Beside a contour along X, a quarter of an inch wide or of a millimetre."""
    for units, wide in (("G20", 6.35), ("G21", 0.25)):
        run = interpret(f"{START}{units}\nG1 F20\nG41.1 D0.25 X1 Y1\nX3\nX4\nG40 X6\nM2")
        size = 25.4 if units == "G20" else 1.0
        assert run.end[-3, 1] == pytest.approx(size + wide / 2)


@pytest.mark.parametrize("codes", ["M3 M8", "M8 M3", "M3 M8 M48"])
def test_a_control_that_obeys_one_m_in_a_line_reads_one(codes: str) -> None:
    assert len(interpret(f"{START}S500 M3 M8\nM2")) > 0
    with pytest.raises(ProgramError, match=r"^line 4: several M codes; .* obeys one in a line"):
        interpret(f"G17 G21 G40 G80 G90 G94\nG54\nG0 X0. Y0. Z5.\nS500 {codes}\nM30", BY_NAME["fanuc"])


@pytest.mark.parametrize(
    ("text", "centre", "sweep"),
    [
        ("G2 X10 Y0 I5 J0 F9", (5, 0), -math.pi),
        ("G3 X10 Y0 I5 J0 F9", (5, 0), math.pi),
        ("G90.1\nG3 X10 Y0 I5 J0 F9", (5, 0), math.pi),
        ("G3 X0 Y0 I5 J0 F9", (5, 0), 2 * math.pi),
        ("G2 I5 J0 F9", (5, 0), -2 * math.pi),
        ("G2 I5 J0 P3 F9", (5, 0), -6 * math.pi),
        ("G2 X5 Y5 R5 F9", (5, 0), -math.pi / 2),
        ("G2 X5 Y5 R-5 F9", (0, 5), -3 * math.pi / 2),
        ("G3 X5 Y5 R5 F9", (0, 5), math.pi / 2),
    ],
)
def test_arcs(text: str, centre: tuple[float, float], sweep: float) -> None:
    run = interpret(START + text)
    assert run.kind[-1] == Kind.ARC
    assert run.centre[-1] == pytest.approx(centre, abs=1e-12)
    assert run.sweep[-1] == pytest.approx(sweep, abs=1e-12)


def test_a_helix_has_the_length_of_a_helix() -> None:
    run = interpret(START + "G3 X0 Y0 Z2 I5 J0 F100")
    assert run.length[-1] == pytest.approx(math.hypot(10 * math.pi, 3))


def test_arc_error_is_the_difference_of_the_radii() -> None:
    run = interpret(START + "G2 X10.01 Y0 I5 J0 F100")
    assert run.arc_error[-1] == pytest.approx(0.01)


def test_cycles_expand_into_moves() -> None:
    z = [end[2] for end in ends("G98 G83 X3 Y4 Z-3 R2 Q2 F50")]
    gap = LINUXCNC.dialect.peck_clearance
    assert z == pytest.approx([5, 2, 0, 2, gap, -2, 2, -2 + gap, -3, 5])
    z = [end[2] for end in ends("G99 G73 X3 Y4 Z-3 R2 Q2 F50")]
    assert z == pytest.approx([5, 2, 0, gap, -2, -2 + gap, -3, 2])
    two = ends("G99 G81 X3 Y4 Z-3 R2 F50\nX5\nG80")
    assert two[-2:] == [[5, 4, -3], [5, 4, 2]]
    run = interpret(START + "G82 X1 Y1 Z-1 R1 P0.5 F50")
    assert run.seconds.sum() == 0.5
    reamed = interpret(START + "G85 X1 Y1 Z-1 R1 F50")
    assert reamed.kind[-2] == Kind.FEED
    assert reamed.end[-2].tolist() == [1, 1, 1]


def test_states_follow_the_words() -> None:
    run = interpret(START + "T3 M6\nG55 S900 M3\nG0 X1 Y1\nG43 H3 Z5\nM7\nM8\nG1 X2 F10\nM5 M9\nG1 X3\nM30")
    cut, after = (run.states[i] for i in run.state[run.kind == Kind.FEED])
    assert (cut.tool, cut.length_offset, cut.work_offset) == (3, 3, "G55")
    assert (cut.spindle, cut.rpm, cut.coolant) == (1, 900, "both")
    assert (after.spindle, after.coolant) == (0, "off")
    assert cut.stated == {"units", "distance", "plane", "cutter compensation", "feed mode"}


def test_states_that_come_again_are_those_of_their_words(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a change makes of a state is remembered, and forgotten where there is too much of it."""
    turns = [
        f"G6{1 + 3 * (k % 2)}{' P0.002 Q0' * (k % 2)} S{900 + k % 3} M{3 + k % 3} G1 X{k} F9"
        for k in range(30)
    ]
    often = interpret(START + "\n".join(turns))
    found = [often.states[i] for i in often.state[often.kind == Kind.FEED]]
    assert [state.rpm for state in found] == [900 + k % 3 for k in range(30)]
    assert [state.spindle for state in found] == [(1, -1, 0)[k % 3] for k in range(30)]
    assert [(state.path_mode, state.blend) for state in found] == [
        ((610, 0), (640, 0.002))[k % 2] for k in range(30)
    ]
    monkeypatch.setattr(modes, "MOST_CHANGES", 1)
    seldom = interpret(START + "\n".join(turns))
    assert (seldom.states, seldom.state.tolist()) == (often.states, often.state.tolist())


def test_a_tool_change_stops_the_spindle() -> None:
    run = interpret(START + "S900 M3\nT1 M6\nG0 X1\nM2")
    assert run.states[run.state[-1]].spindle == 0


def test_retracts_leave_the_height_unknown_but_high() -> None:
    for retract in ("G53 G0 Z0", "G91 G28 Z0\nG90"):
        run = interpret(START + retract + "\nG0 X7\nM2")
        assert run.end[-2].tolist() == [7.0, 0.0, math.inf]
    through_zero = interpret(START + "G28 Z0\nM2")  # by way of Z0 in the work, as the control does
    assert through_zero.end[1].tolist() == [0, 0, 0]
    assert through_zero.kind[1] == Kind.RAPID


def test_offsets_make_the_position_unknown() -> None:
    run = interpret(START + "G55\nG0 X1\nG43 H1\nG0 Y1\nM2")
    assert np.isnan(run.end[1, 1:]).all()
    assert np.isnan(run.end[2, 2])


def test_text_after_the_end_is_not_read() -> None:
    assert interpret(START + "M30\nG1 nonsense #(").ended
    assert interpret("%\n" + START + "%\n#1=2").ended
    assert not interpret(START).ended


def test_block_delete() -> None:
    assert len(interpret(START + "/G0 X1\nM2")) == 3
    assert len(interpret(START + "/G0 X1\nM2", block_delete=True)) == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("G1 X1", "without a feed"),
        ("G1 X1 F0", "without a feed"),
        ("G2 X1 Y1 F1", "without a centre"),
        ("G2 X0 Y0 R3 F1", "full circle"),
        ("G2 X10 Y0 R3 F1", "half the distance"),
        ("G2 X10.2 Y0 I5 J0 F1", "0.2000 mm"),
        ("G2 X1 Y1 I1 R1 F1", "either R"),
        ("G2 X1 Y0 I0 J0 F1", "radius 0"),
        ("G2 F1", "without an axis"),
        ("G0 G1 X1 F1", "G0 and G1 exclude"),
        ("M3 M5", "M3 and M5 exclude"),
        ("M8 M9", "exclude each other"),
        ("G90 G91", "G90 and G91 exclude"),
        ("X1 X2", "two X words"),
        ("G41 D1", "no tool of that number is known"),
        ("G18 G81 X1 Y1 Z-1 R1 F9", "XY plane"),
        ("G93", "G93 is not supported"),
        ("G92 X0", "G92 is not supported"),
        ("G76", "no code"),
        ("G1.7", "no code"),
        ("M77", "no code"),
        ("M6", "without a tool"),
        ("G43 H1.5", "no whole number"),
        ("X1", "without a motion"),
        ("G0 X", "no number"),
        ("G0 X1..2", "starts no word"),
        ("G0 X1e5", "starts no word"),
        ("G0 A5", "axis A"),
        ("G0 X1 (open", "not closed"),
        ("G0 X1 (a (b) c)", "inside a comment"),
        ("G0 X1)", "without its"),
        ("G0 X1 N5", "at the start"),
        ("G4", "needs a time"),
        ("G4 P-1", "write P 0"),
        ("S-5", "S is below 0"),
        ("G0 X1 Q2", "Q means nothing"),
        ("G81 X1 Y1 Z-1 F1", "G81 needs R"),
        ("G83 X1 Y1 Z-1 R1 F1", "G83 needs Q"),
        ("G83 X1 Y1 Z-1 R1 Q0 F1", "Q above 0"),
        ("G81 X1 Y1 Z-1 R-2 F1", "below the bottom"),
        ("G91\nG81 X1 Y1 Z-1 R1 F1", "G91"),
        ("G83 X1 Y1 Z-9 R1 Q0.0001 F1", "more than 10000 times"),
        ("G2 I5 P2000 F1", "1 to 1000"),
        ("G0 X123456.7", "beyond 100 m"),
        ("G2 X1 Y1 R900000 F1", "beyond 100 m"),
        ("G53 X0", "G53 needs G0 or G1"),
        ("G55\nG91 G0 X5", "unknown position"),
        ("G55\nG2 X5 Y5 I5 J0 F1", "unknown position"),
        ("G0 X1 " + "(" + "-" * 300 + ")", "at most 255"),
        ("G0 é5", r"U\+00E9 .* stands outside of comments"),
    ],
)
def test_bad_text_is_refused_with_its_line(text: str, message: str) -> None:
    start = START.replace("G0 X0 Y0 Z5\n", "G0 X0 Y0 Z5\nG80\n")
    number = (start + text).count("\n") + 1
    with pytest.raises(ProgramError, match=rf"^line {number}: .*{message.replace('(', '.')}") as caught:
        interpret(start + text)
    assert "\n" not in str(caught.value)


def test_a_dialect_changes_the_meaning() -> None:
    milliseconds = replace(LINUXCNC.dialect, name="other", dwell_unit=0.001)
    run = interpret(START + "G4 P500\nG90.1 G2 X10 Y0 I5 J0 F9", milliseconds)
    assert run.seconds.sum() == 0.5
    assert run.centre[-1].tolist() == [5, 0]
    with pytest.raises(ProgramError, match="is read in programs for other"):
        interpret("M6", replace(milliseconds, words=Words(milliseconds.words.codes[:5])))


@given(st.text(alphabet="GMXYZIJRFSTHPQN0123456789.-+ ()/%;\n", max_size=80))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        run = interpret(text)
    except ProgramError as error:
        refused = str(error)
    else:
        refused = ""
        assert run.start.shape == run.end.shape == (len(run), 3)
    assert refused == "" or refused.startswith("line ")
