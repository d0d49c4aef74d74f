"""The LinuxCNC post: golden text, and what must hold for any program."""

import math
from dataclasses import replace

import numpy as np
import pytest
from by_control import interpret
from hypothesis import example, given
from hypothesis import strategies as st
from shop import DRILL, MILL, SPOT, TOOLS

from mechwright.errors import ProgramError
from mechwright.plugins.host import Host
from mechwright_cam import plugin
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.controls.mach3 import Mach3
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.writing.writer import AGREEING, Writer
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Operation, Pause, Program, Rapid, ToolSection
from mechwright_plane.text import COMMENT_WIDTH, comment_lines

POST = LinuxCnc()


def apart(centre: tuple[float, float], end: tuple[float, float]) -> float:
    """By how much the radii at both ends of an arc from the origin differ, mm."""
    return abs(math.hypot(*centre) - math.hypot(end[0] - centre[0], end[1] - centre[1]))


@given(
    st.floats(1.0, 200.0), st.floats(-3.0, 3.0), st.floats(0.2, 3.0), st.sampled_from([(3, 1.0), (4, 25.4)])
)
def test_the_radii_at_both_ends_of_an_arc_agree_to_a_fraction_of_the_last_place(radius, heading, sweep, unit):
    """Plain rounding of end and centre would leave them two places apart: 2 µm, and 5 µm of four in an inch."""
    decimals, scale = unit
    writer = Writer(Program("none", "G54", 5.0, ()), decimals, point=True, scale=scale)
    place = scale * 10.0**-decimals
    i, j = radius * math.cos(heading), radius * math.sin(heading)
    angle = heading + math.pi + sweep
    end = (writer.rounded(i + radius * math.cos(angle)), writer.rounded(j + radius * math.sin(angle)))
    centre = writer.centre(i, j, end)
    for value, wanted in zip(centre, (i, j), strict=True):
        assert value / place == pytest.approx(round(value / place), abs=1e-6)
        assert abs(value - wanted) <= 2.51 * place
    plain = writer.rounded(i), writer.rounded(j)
    assert apart(centre, end) <= apart(plain, end) + 1e-9
    near = [(plain[0] + a * place, plain[1] + b * place) for a in (-1, 0, 1) for b in (-1, 0, 1)]
    best = min(apart(one, end) + math.dist(one, (i, j)) / 4 for one in near)
    assert apart(plain, end) <= AGREEING or apart(centre, end) + math.dist(centre, (i, j)) / 4 <= best + 1e-6


GOLDEN = """\
(program bracket, LinuxCNC)
(part bracket, steel, D20 [H7])
(origin G55, Z0 on top of the stock, units mm and mm/min)
(T2 H2 D 8 mm: drill-8, drill)
(T3 H3 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: holes)
T2 M6
G55 S2400 M3
G0 X10 Y10
G43 H2 Z5
M8
G98 G83 X10 Y10 Z-12 R1 Q3 F200
X30
Y20
G80
G98 G81 X40 Y20 Z-2 R1 F150
G80
G98 G82 X50 Y20 Z-2 R1 P0.5
G80
M9
M5
G53 G0 Z0
(operation: contour)
T3 M6
G55 S8000 M3
G0 X0 Y0
G43 H3 Z5
Z1
G1 Z-1 F100
X20 F600
G3 X20 Y10 I0 J5
G2 X20 Y10 I-3 J0
G3 X10 Y20 Z-1.5 I-10 J0
G0 Z5
X0 Y0
M9
M5
G53 G0 Z0
(MSG, set the clamp)
M0
S8000 M3
G0 X1 Y1
G43 H3 Z5
Z2
(operation: deburr)
G1 Z-0.2 F600
M9
M5
G53 G0 Z0
M30
"""


def golden_program() -> Program:
    holes = Operation(
        "holes",
        (
            Rapid(10, 10, 5),
            Drill(10, 10, -12, 1, 200, peck=3),
            Drill(30, 10, -12, 1, 200, peck=3),
            Drill(30, 20, -12, 1, 200, peck=3),
            Drill(40, 20, -2, 1, 150),
            Drill(50, 20, -2, 1, 150, dwell=0.5),
        ),
    )
    contour = Operation(
        "contour",
        (
            Rapid(0, 0),
            Rapid(z=1),
            Feed(None, None, -1, 100),
            Feed(20, None, None, 600),
            Feed(20.00001, None, None, 600),
            FeedArc(20, 10, None, 0, 5, True, 600),
            FeedArc(20, 10, None, -3, 0, False, 600),
            FeedArc(10, 20, -1.5, -10, 0, True, 600),
            Rapid(0, 0, 5),
            Pause("set the clamp"),
            Rapid(1, 1, 2),
        ),
    )
    deburr = Operation("deburr", (Feed(None, None, -0.2, 600),))
    sections = (
        ToolSection(DRILL, 2400, "flood", (holes,)),
        ToolSection(MILL, 8000, "off", (contour, deburr)),
    )
    return Program("bracket", "G55", 5.0, sections, ("part bracket, steel, Ø20 (H7)",))


def test_golden_text() -> None:
    assert POST.write(golden_program()) == GOLDEN


def test_the_same_program_gives_the_same_bytes() -> None:
    assert POST.write(golden_program()) == POST.write(golden_program())


def test_tool_table_is_sorted_and_has_each_tool_once() -> None:
    name, text = POST.tool_table((MILL, SPOT, DRILL, MILL))
    assert name == "tool.tbl"
    assert text == (
        ";units=mm\n"
        "T1 P1 Z0 D6 ;spot-6 spot-drill flute_length=8 point_angle=90\n"
        "T2 P2 Z0 D8 ;drill-8 drill flute_length=40\n"
        "T3 P3 Z0 D6 ;mill-6 end-mill flute_length=12 flutes=3\n"
    )


def test_the_post_is_registered() -> None:
    host = Host()
    host.add(plugin, "mechwright", "cam")
    assert host.broken == []
    assert isinstance(host.get(Control, "linuxcnc"), LinuxCnc)


def one(*moves: object) -> Program:
    section = ToolSection(MILL, 1000, "off", (Operation("one", tuple(moves)),))  # type: ignore[arg-type]
    return Program("one", "G54", 5.0, (section,))


@pytest.mark.parametrize("program", [one(), Program("none", "G54", 5.0, ())])
def test_an_empty_program_is_refused(program: Program) -> None:
    with pytest.raises(ProgramError, match="no moves"):
        POST.write(program)


@pytest.mark.parametrize("first", [Feed(1, 1, 1, 100), Rapid(z=5.0), Rapid(1, None), Rapid(y=1.0)])
def test_a_section_starts_with_a_place(first: Feed | Rapid) -> None:
    with pytest.raises(ProgramError, match="T3 does not start with a rapid"):
        POST.write(one(first, Rapid(1, 1)))


def test_an_operation_that_may_round_corners_says_so_and_the_next_takes_it_back() -> None:
    moves = (Rapid(0, 0), Feed(1, 1, 1, 100))
    loose = (Operation("exact", moves), Operation("loose", moves, 0.1), Operation("none", moves, 0.0))
    text = POST.write(Program("one", "G54", 5.0, (ToolSection(MILL, 1000, "off", (*loose, loose[0])),)))
    words = [line for line in text.splitlines() if line.startswith(("(operation", "G64", "G61"))]
    assert words == [
        *("G64 P0.002 Q0", "(operation: exact)", "(operation: loose)", "G64 P0.1 Q0"),
        *("(operation: none)", "G61", "(operation: exact)", "G64 P0.002 Q0"),
    ]


def test_rapids_go_down_last_and_up_first() -> None:
    text = POST.write(one(Rapid(0, 0, 5), Rapid(9, 9, 1), Rapid(0, 0, 5)))
    assert "X9 Y9\nZ1\nZ5\nX0 Y0\n" in text


def test_a_hole_with_pecks_and_dwell_is_written_in_moves() -> None:
    run = interpret(POST.write(one(Rapid(1, 1), Drill(1, 1, -5, 1, 100, peck=2, dwell=0.3))))
    assert run.seconds.sum() == 0.3
    feeds = run.end[run.kind == Kind.FEED][:, 2]
    assert feeds.tolist() == [-1, -3, -5]


def test_an_arc_too_short_for_the_decimals_becomes_no_full_circle() -> None:
    tiny = FeedArc(10 + 2e-5, 10, None, 5, 0, True, 100)
    run = interpret(POST.write(one(Rapid(10, 10), tiny, FeedArc(20, 10, None, 5, 0, True, 100))))
    arcs = run.sweep[run.kind == Kind.ARC]
    assert arcs.tolist() == pytest.approx([math.pi], abs=1e-5)


@given(st.text(max_size=300))
@example("full width（parentheses）")
def test_no_comment_can_hurt(text: str) -> None:
    for line in comment_lines(text, LinuxCnc.active_comments):
        assert line.isascii()
        assert line.isprintable()
        assert 0 < len(line) <= COMMENT_WIDTH
        assert not set(line) & set("()")
        assert not line.upper().startswith(LinuxCnc.active_comments)


@pytest.mark.parametrize("note", ["PROBEOPEN x.txt", "logopen, /etc/x", "x" * 500, "a)\nM30\n("])
def test_notes_cannot_leave_their_comments(note: str) -> None:
    plain = POST.write(golden_program())
    noted = POST.write(replace(golden_program(), notes=(note,)))
    code = [line for line in noted.splitlines() if not line.startswith("(")]
    assert code == [line for line in plain.splitlines() if not line.startswith("(")]
    assert not [line for line in noted.splitlines() if line.upper().startswith(("(PROBE", "(LOG"))]


@given(
    st.lists(
        st.tuples(
            st.floats(-80, 80), st.floats(-80, 80), st.floats(0.01, 50), st.floats(-3, 3), st.booleans()
        ),
        min_size=1,
        max_size=20,
    )
)
def test_rounding_never_adds_up_and_arcs_stay_consistent(
    arcs: list[tuple[float, float, float, float, bool]],
) -> None:
    moves: list[object] = [Rapid(0.0, 0.0, 0.0)]
    exact = []
    for x, y, radius, angle, ccw in arcs:
        i, j = radius * math.cos(angle), radius * math.sin(angle)
        moves += [Feed(x, y, None, 100), FeedArc(x + 2 * i, y + 2 * j, None, i, j, ccw, 100)]
        exact += [(x, y), (x + 2 * i, y + 2 * j)]
    run = interpret(POST.write(one(*moves)))
    assert run.arc_error.max() < 3e-4
    np.testing.assert_allclose(run.end[run.cutting][-1, :2], exact[-1], atol=6e-5)
    assert (run.kind == Kind.ARC).sum() == len(arcs)


def test_every_tool_s_first_height_has_its_offset() -> None:
    run = interpret(POST.write(golden_program()))
    for number in (2, 3):
        states = {run.states[s].length_offset for s in run.state[(run.tool == number) & run.cutting]}
        assert states == {number}
    assert {tool.number for tool in TOOLS} >= {2, 3}


@pytest.mark.parametrize("dwell", [0.0, 0.5, 2.0])
def test_mach3_is_told_the_unit_of_dwells_where_there_is_one(dwell: float) -> None:
    moves = (Rapid(x=0.0, y=0.0), Rapid(z=5.0), Drill(0.0, 0.0, -2.0, 2.0, 120.0, dwell=dwell))
    program = Program("plate", "G54", 5.0, (ToolSection(DRILL, 900, "off", (Operation("drill", moves),)),))
    assert ("dwells are in seconds" in Mach3().write(program)) == (dwell > 0)
