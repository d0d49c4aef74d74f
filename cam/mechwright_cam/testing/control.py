"""What every control must do; a control's own tests subclass :class:`ControlContract`."""

import re
from dataclasses import replace
from typing import ClassVar, Literal, get_args

import pytest

from mechwright.contracts.finding import errors
from mechwright.errors import ProgramError
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind
from mechwright_cam.machining import machine
from mechwright_cam.pages.setup_sheet import setup_html
from mechwright_cam.program.moves import Pause, Program
from mechwright_cam.shop.posting import Compensation
from mechwright_cam.shop.tool import Tool
from mechwright_cam.testing.agreement import assert_one_d, assert_read_back, assert_same_at
from mechwright_cam.testing.changes import changed
from mechwright_cam.testing.programs import compensated_sample, plate_job, sample_program

_HOSTILE = (
    "(nested) G0 Z-50 (",
    "a line\nG0 Z-50\r\nM3 S9999",
    "G0 Z-50 ; M30 %",
    "%",
    "Ø 20 ± 0,01 µm – größer",
    "(MSG, hello)",
    "long " * 100,
)
"""Texts that a careless control would let become commands, or lines that a control refuses."""


class ControlContract:
    """Tests of one control; subclass it and set :attr:`control`.

    What differs between controls stands in class attributes and in three small methods, which say how the
    control writes comments, its work offset and its length offset.

    Examples
    --------
    ::

        class TestMill(ControlContract):
            control = MillControl
            longest_line = 80
    """

    control: ClassVar[type[Control]]
    """The class under test."""
    program_end: ClassVar[str] = r"M0*(2|30)"
    """Pattern that the last line of code matches."""
    longest_line: ClassVar[int] = 255
    """Characters the control reads of one line; 255 is what LinuxCNC takes."""

    def program(self) -> Program:
        """The program that is written: one with every kind of move."""
        return sample_program()

    def code(self, text: str) -> list[str]:
        """The lines that the control acts on: without comments and empty lines."""
        lines = (re.sub(r"\([^()]*\)|;.*", "", line).strip() for line in text.splitlines())
        return [line for line in lines if line and line != "%"]

    def work_offset(self, program: Program) -> str:
        """Pattern of the words that choose the work offset."""
        return rf"{re.escape(program.work_offset)}(?![\d.])"

    def length_offset(self, tool: Tool) -> str:
        """Pattern of the words that put a tool's length offset in force."""
        return rf"G43(?![\d.]).*H0*{tool.number}(?!\d)"

    def _write(self, program: Program) -> str:
        return self.control().write(program)

    def test_names(self) -> None:
        """The control can be chosen and listed, and its files have an ending."""
        assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", self.control.name)
        assert self.control.title.strip() == self.control.title != ""
        assert re.fullmatch(r"(\.[a-z0-9]+)+", self.control.suffix)

    def test_text(self) -> None:
        """The text is plain ASCII in lines that the control can read."""
        text = self._write(self.program())
        assert text.isascii()
        assert text.endswith("\n")
        assert "\r" not in text
        assert max(map(len, text.splitlines())) <= self.longest_line

    def test_program_end(self) -> None:
        """The program says where it ends."""
        last = self.code(self._write(self.program()))[-1]
        assert re.search(self.program_end, last), f"the last line is {last!r}"

    def test_work_offset(self) -> None:
        """The work offset of the program is called, and follows the design file."""
        for offset in ("G54", "G57"):
            program = replace(self.program(), work_offset=offset)
            code = "\n".join(self.code(self._write(program)))
            assert re.search(self.work_offset(program), code), f"no work offset {offset}"

    def test_length_offsets(self) -> None:
        """Every tool gets its own length offset, in the order of use."""
        program = self.program()
        code = "\n".join(self.code(self._write(program)))
        at = 0
        for section in program.sections:
            found = re.compile(self.length_offset(section.tool)).search(code, at)
            assert found, f"no length offset of tool {section.tool.number}"
            at = found.end()

    def test_deterministic(self) -> None:
        """The same program gives the same text."""
        assert self._write(self.program()) == self._write(self.program())

    def test_every_number_counts(self) -> None:
        """No move is dropped and no number of it: each one that changes, changes the text."""
        program = self.program()
        text = self._write(program)
        for what, other in changed(program):
            assert self._write(other) != text, f"the text does not show {what}"

    def test_spindle_and_coolant_count(self) -> None:
        """Spindle speed and coolant of every section reach the text."""
        program = self.program()
        text = self._write(program)
        for i, section in enumerate(program.sections):
            for other in (replace(section, spindle=section.spindle + 100), replace(section, coolant="off")):
                sections = (*program.sections[:i], other, *program.sections[i + 1 :])
                assert self._write(replace(program, sections=sections)) != text

    @pytest.mark.parametrize("words", _HOSTILE, ids=[repr(words[:12]) for words in _HOSTILE])
    def test_words_stay_comments(self, words: str) -> None:
        """Names, notes and messages never become commands, whatever they hold."""
        program = self.program()
        sections = tuple(
            replace(
                section,
                operations=tuple(
                    replace(
                        operation,
                        name=words,
                        moves=tuple(
                            replace(move, message=words) if isinstance(move, Pause) else move
                            for move in operation.moves
                        ),
                    )
                    for operation in section.operations
                ),
            )
            for section in program.sections
        )
        text = self._write(replace(program, sections=sections, notes=(words,)))
        assert text.isascii()
        assert max(map(len, text.splitlines())) <= self.longest_line
        assert self.code(text) == self.code(self._write(program))

    def test_tool_table(self) -> None:
        """The tool table has a safe file name and holds every tool, or the control has none."""
        tools = self.program().tools
        name, text = self.control().tool_table(tools)
        assert (name == "") == (text == ""), "a tool table has both a name and a text, or neither"
        assert (name, text) == self.control().tool_table(tools)
        if name:
            assert re.fullmatch(r"[A-Za-z0-9_-]+(\.[A-Za-z0-9_-]+)*", name), f"unsafe file name {name!r}"
            assert text.endswith("\n")
            for tool in tools:
                assert re.search(rf"(?<!\d)0*{tool.number}(?!\d)", text), f"tool {tool.number} is missing"

    def test_names_its_files_before_any_planning(self) -> None:
        """No file of a program has a stem that is not among those that a check compares."""
        control, program = self.control(), self.program()
        assert set(control.files(program)) <= set(control.stems(program.name, program.tools))

    def test_reads_back_what_it_writes(self) -> None:
        """Every cut is read where the program has it, with its tool, feed, spindle, coolant and offset."""
        assert_read_back(self.control(), self.program())

    def test_does_the_same_at_every_work_offset(self) -> None:
        """With further work offsets every cut is read at each, and every tool is changed to once."""
        control, program = self.control(), self.program()
        if not control.several:
            pytest.skip("the control has programs for one work offset alone")
        other = next(o for o in ("G54", "G55") if o != program.work_offset)
        program = replace(program, more_offsets=(other,))
        files = control.files(program)
        run = control.read(files if len(files) > 1 else next(iter(files.values())))
        assert_same_at(run, program.offsets)
        assert (run.kind == Kind.TOOL).sum() <= len(program.sections), "a tool is changed to more than once"

    @pytest.mark.parametrize("way", ["control", "wear"])
    @pytest.mark.parametrize("quantity", ["radius", "diameter"])
    def test_program_tables_and_sheet_say_the_same_of_d(
        self, way: Compensation, quantity: Literal["radius", "diameter"]
    ) -> None:
        """What D holds is the same in the program's head, in the offsets' file and on the setup sheet."""
        control, (job, program) = self.control(), compensated_sample(way, quantity)
        if control.offsets.d is None:
            assert errors(control.check(job.settings)), "compensation is not refused, and there is no D"
            with pytest.raises(ProgramError):
                control.write(program)
        else:
            assert_read_back(control, program)
            assert_one_d(control, job, program)

    def test_the_sheet_says_whether_lengths_are_kept(self) -> None:
        """The setup sheet asks for H where the control keeps lengths, and there alone."""
        job, program = plate_job(), self.program()
        page = setup_html(job, program, None, self.control())
        kept = self.control.offsets.lengths
        assert ("Offsets to type in" in page) == kept
        assert ("The control keeps no lengths" in page) != kept
        assert self.control.name in page
        if kept:
            first = program.sections[0].tool.number
            assert self.control().length_words(first) in page
            assert self.control().change_words(first) in page

    @pytest.mark.parametrize("way", get_args(Compensation))
    def test_a_planned_program_is_proven(self, way: Compensation) -> None:
        """A plate with a bore is planned, posted, read back and proven."""
        control = self.control()
        if way != "computer" and control.offsets.d is None:
            pytest.skip("the control has no cutter compensation")
        made = machine(plate_job(compensation=way), control)
        assert made.proof.ok
