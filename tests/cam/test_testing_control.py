"""The contract lets an honest control pass, and names what is wrong with a broken one."""

import re
from dataclasses import fields, replace
from functools import partial

import pytest
from by_control import LINUXCNC

from mechwright.errors import PluginFaultError
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.offsets import OffsetTables
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Operation, Pause, Program, Rapid
from mechwright_cam.testing import ControlContract, sample_program
from mechwright_cam.testing.changes import changed


def numbers(move):
    """What stands in a move and can be changed alone."""
    names = {f.name for f in fields(move) if getattr(move, f.name) is not None} - {"breaking"}
    if isinstance(move, FeedArc):
        return names & {"z", "feed", "ccw"}
    if isinstance(move, Drill) and move.dwell == 0:
        return names - {"dwell"} | ({"breaking"} if move.peck else set())
    return names


def test_in_each_changed_program_one_number_of_one_move_is_another():
    program = sample_program()
    moves = [move for section in program.sections for one in section.operations for move in one.moves]
    seen = {at: [] for at in range(len(moves))}
    for what, other in changed(program):
        again = [move for section in other.sections for one in section.operations for move in one.moves]
        assert len(again) == len(moves), what
        (at,) = (at for at, pair in enumerate(zip(moves, again, strict=True)) if pair[0] != pair[1])
        old, new = moves[at], again[at]
        (name,) = (f.name for f in fields(old) if getattr(old, f.name) != getattr(new, f.name))
        if isinstance(getattr(old, name), float):
            assert getattr(new, name) - getattr(old, name) == pytest.approx(0.125)
        seen[at].append(name)
    for move, names in zip(moves, seen.values(), strict=True):
        assert sorted(names) == sorted(numbers(move)), move


def note(text):
    words = re.sub(r"[^A-Za-z0-9 .,]", " ", text.encode("ascii", "replace").decode())
    return f"({words[:60]})"


CODES = {"FLOOD": "M8", "MIST": "M9 (off)\nM7", "OFF": "M9", "RAPID": "G0", "FEED": "G1"}
SIDES = {"left": "G41 D{}", "right": "G42 D{}", "off": "G40"}


def usual(line):
    """A line of the plain control in the words of LinuxCNC."""
    kind, _, words = line.partition(" ")
    word = dict(re.findall(r"([A-Z]+?)(None|True|False|left|right|off|[-+.\de]+)(?: |$)", words))
    if kind == "DRILL":
        peck = word["PECK"] != "None"
        code = f"G83 Q{word['PECK']}" if peck else f"G82 P{word['DWELL']}"
        return f"G98 {code} X{word['X']} Y{word['Y']} Z{word['BOTTOM']} R{word['RETRACT']} F{word['FEED']}"
    if kind not in {"RAPID", "FEED", "FEEDARC"}:
        return CODES.get(line, line)
    code = CODES[kind] if kind != "FEEDARC" else "G3" if word["CCW"] == "True" else "G2"
    code += " " + SIDES.get(word.get("SIDE", ""), "").format(word.get("D"))
    axes = [letter + word[letter] for letter in "XYZIJ" if word.get(letter, "None") != "None"]
    return " ".join([code, *axes, "F" + word["FEED"] if "FEED" in word else ""])


class Plain(Control):
    """Writes every number of every move, and no more than the contract asks for."""

    name = "plain"
    title = "Plain"
    note = staticmethod(note)
    retract = ("M9", "M5", "G53 G0 Z0")

    def move(self, move):
        values = {f.name.upper(): getattr(move, f.name) for f in fields(move) if f.name != "message"}
        words = " ".join(f"{n}{v:.6f}" if isinstance(v, float) else f"{n}{v}" for n, v in values.items())
        return f"{type(move).__name__.upper()} {words}" if words else f"M0 {self.note(move.message)}"

    def write(self, program):
        lines = ["%", *map(self.note, program.notes), "G21 G90 G17 G40 G64 P0.002", program.work_offset]
        for section in program.sections:
            lines += self.retract
            lines += [f"T{section.tool.number} M6", f"S{section.spindle} M3", section.coolant.upper()]
            lines.append(f"G43 H{section.tool.number}")
            for operation in section.operations:
                lines.append(self.note(operation.name))
                for move in operation.moves:
                    d = f" D{section.tool.d_number}" if getattr(move, "side", None) else ""
                    lines.append(self.move(move) + d)
        return "\n".join([*lines, *self.retract, "M30", "%", ""])

    def read(self, program, **settings):
        return LINUXCNC.read("\n".join(map(usual, program.splitlines())), **settings)

    def tool_table(self, tools):
        return "tool.tbl", "".join(f"T{tool.number} D{tool.diameter}\n" for tool in tools)

    def offset_table(self, tools, settings):
        d = [self.offsets.d_offset(tool, settings.post, settings.compensation, 0.1) for tool in tools]
        return "tool.tbl", "".join(f"T{offset.number} D{offset.planned}\n" for offset in d)


class TestPlain(ControlContract):
    control = Plain


def assert_refused(post, test, words="", *arguments):
    contract = type("Contract", (ControlContract,), {"control": post})()
    with pytest.raises(AssertionError) as caught:
        getattr(contract, test)(*arguments)
    assert words in str(caught.value)


def edited(pattern, new):
    """The plain post with its text changed."""

    class Other(Plain):
        def write(self, program):
            return re.sub(pattern, new, super().write(program))

    return Other


@pytest.mark.parametrize("attributes", [{"name": "Plain Post"}, {"title": ""}, {"suffix": "nc"}])
def test_names(attributes):
    assert_refused(type("Other", (Plain,), attributes), "test_names")


@pytest.mark.parametrize(
    ("pattern", "new"), [(r"\n\Z", ""), ("\n", "\r\n"), ("T3", "Ø3"), ("T3", "T3" + " " * 255)]
)
def test_text(pattern, new):
    assert_refused(edited(pattern, new), "test_text")


def test_a_missing_word_is_named():
    assert_refused(edited("M30", "M5"), "test_program_end", "the last line is 'M5'")
    assert_refused(edited("G5[0-9]", "G54"), "test_work_offset", "no work offset G57")
    assert_refused(edited("G54", "G54.1"), "test_work_offset", "no work offset G54")
    assert_refused(edited("G43 H12", ""), "test_length_offsets", "no length offset of tool 12")
    assert_refused(edited("G43 H3", "G43 H30"), "test_length_offsets", "no length offset of tool 3")
    assert_refused(edited("G43 H12", "(G43 H12)"), "test_length_offsets", "no length offset of tool 12")


@pytest.mark.parametrize("kind", [Rapid, Feed, FeedArc, Drill, Pause])
def test_a_move_that_is_dropped(kind):
    class Other(Plain):
        def move(self, move):
            return "G1" if isinstance(move, kind) else super().move(move)

    assert_refused(Other, "test_every_number_counts", f"of {kind.__name__}(")


@pytest.mark.parametrize("name", ["x", "y", "z", "feed", "bottom", "retract", "peck", "dwell", "ccw"])
def test_a_number_that_is_dropped(name):
    assert_refused(
        edited(rf"\b{name.upper()}[^ \n]+", ""), "test_every_number_counts", "the text does not show"
    )


def test_spindle_and_coolant():
    assert_refused(edited(r"S\d+\.\d", "S100"), "test_spindle_and_coolant_count")
    assert_refused(edited("FLOOD|MIST|OFF", "M8"), "test_spindle_and_coolant_count")


def test_a_post_that_counts_its_programs():
    class Other(Plain):
        written = 0

        def write(self, program):
            Other.written += 1
            return f"(program {Other.written})\n" + super().write(program)

    assert_refused(Other, "test_deterministic")


@pytest.mark.parametrize(
    ("careless", "words"),
    [
        (lambda text: f"({text})", "(nested) G0 Z-50 ("),
        (lambda text: f"({text})", "a line\nG0 Z-50\r\nM3 S9999"),
        (lambda text: f"; {text}", "a line\nG0 Z-50\r\nM3 S9999"),
        (lambda text: f"({text})", "Ø 20 ± 0,01 µm – größer"),
        (lambda text: f"({text})", "long " * 100),
        (lambda text: text, "%M30"),
    ],
)
def test_words_that_become_commands(careless, words):
    other = type("Other", (Plain,), {"note": staticmethod(careless)})
    assert_refused(other, "test_words_stay_comments", "", words)


@pytest.mark.parametrize(
    "table",
    [
        ("tool.tbl", ""),
        ("tool.tbl", "T3\nT12"),
        ("tool.tbl", "T3\nT1\n"),
    ],
)
def test_tool_table(table):
    assert_refused(type("Other", (Plain,), {"tool_table": lambda *_: table}), "test_tool_table")


@pytest.mark.parametrize("name", ["", "../tool.tbl"])
def test_the_guard_asks_for_a_plain_name_of_the_tool_table(name):
    other = type("Other", (Plain,), {"tool_table": lambda *_: (name, "T3\nT12\n")})
    with pytest.raises(PluginFaultError, match=f"control plain: tool_table\\(\\): '{name}' is no plain file"):
        other().tool_table(())


def test_a_control_may_have_no_tool_table():
    other = type("Other", (Plain,), {"tool_table": lambda *_: ("", "")})
    type("Contract", (ControlContract,), {"control": other})().test_tool_table()


def test_the_sample_holds_every_kind_of_move_and_hangs_together():
    program = sample_program()
    moves = [m for s in program.sections for o in s.operations for m in o.moves]
    assert {type(move) for move in moves} == {Rapid, Feed, FeedArc, Drill, Pause}
    at = [0.0, 0.0, 0.0]
    for section in program.sections:
        first = section.operations[0].moves[0]
        assert isinstance(first, Rapid)
        assert None not in (first.x, first.y)
    for move in moves:
        if isinstance(move, FeedArc):
            centre = at[0] + move.i, at[1] + move.j
            radii = [abs(complex(x - centre[0], y - centre[1])) for x, y in (at[:2], (move.x, move.y))]
            assert radii[0] == pytest.approx(radii[1], abs=1e-9)
        if isinstance(move, Drill):
            at = [move.x, move.y, move.retract]
        elif not isinstance(move, Pause):
            at = [old if new is None else new for old, new in zip(at, (move.x, move.y, move.z), strict=True)]
        assert 0 <= at[0] <= 60
        assert 0 <= at[1] <= 40


def test_the_contract_takes_a_program_of_ones_own():
    only = partial(Program, "own", "G54", 5.0)
    section = sample_program().sections[0]
    short = only((replace(section, operations=(Operation("hole", section.operations[0].moves[:2]),)),))

    class Contract(ControlContract):
        control = Plain

        def program(self):
            return short

    Contract().test_every_number_counts()
    Contract().test_length_offsets()


def misread(pattern, new):
    """The plain control, which reads its own text as another one."""

    class Other(Plain):
        def read(self, program, **settings):
            return super().read(re.sub(pattern, new, program), **settings)

    return Other


@pytest.mark.parametrize(
    ("pattern", "new", "words"),
    [
        (r"Z-1\.500000", "Z-1.25", "is read as one to"),
        (r"FEED400\.0", "FEED300.0", "is read as one to"),
        (r"FEED XNone Y12.*\n", "\n", "is not read"),
        (r"(FEED XNone Y12.*\n)", r"\1RAPID XNone YNone Z1\nFEED X1 Y1 Z-1 FEED9\n", "does not have"),
        (r"S6000\.0", "S600", "read in another state"),
        (r"FLOOD", "MIST", "read in another state"),
        (r"G55", "G54", "read in another state"),
        (r"T12 M6", "T3 M6", "read in another state"),
        (r"M0 .*", "", "a stop is not read"),
        (r"M30\n%", "", "does not see the program's end"),
    ],
)
def test_a_control_that_reads_something_else_than_it_writes(pattern, new, words):
    assert_refused(misread(pattern, new), "test_reads_back_what_it_writes", words)


def test_a_control_that_says_two_things_of_d():
    test = "test_program_tables_and_sheet_say_the_same_of_d"
    note = "(D24 holds the radius)\nM30"
    assert_refused(edited("M30", note), test, "D is the diameter", "control", "radius")
    assert_refused(misread("SIDE(left|off)", "SIDENone"), test, "compensation is not read", "wear", "radius")
    table = type("Other", (Plain,), {"offset_table": lambda *_: ("tool.tbl", "T24 D3\n")})
    assert_refused(table, test, "6 for D24 is not in the file", "control", "radius")
    none = type("Other", (Plain,), {"offsets": OffsetTables(d=None)})
    assert_refused(none, test, "compensation is not refused", "control", "radius")
