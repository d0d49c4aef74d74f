"""What every post must do; a post's own tests subclass :class:`PostContract`."""

import re
from collections.abc import Iterator
from dataclasses import fields, replace
from typing import ClassVar

import pytest

from mechwright_cam.controls.contract import Post
from mechwright_cam.program.moves import Drill, FeedArc, Move, Pause, Program
from mechwright_cam.shop.tool import Tool
from mechwright_cam.testing.programs import sample_program

_STEP = 0.125
"""Change of a number that any control can show: mm, mm/min or s."""

_HOSTILE = (
    "(nested) G0 Z-50 (",
    "a line\nG0 Z-50\r\nM3 S9999",
    "G0 Z-50 ; M30 %",
    "%",
    "Ø 20 ± 0,01 µm – größer",
    "(MSG, hello)",
    "long " * 100,
)
"""Texts that a careless post would let become commands, or lines that a control refuses."""


class PostContract:
    """Tests of one post; subclass it and set :attr:`post`.

    What differs between controls stands in class attributes and in three small methods, which say how the
    control writes comments, its work offset and its length offset.

    Examples
    --------
    ::

        class TestMill(PostContract):
            post = MillPost
            longest_line = 80
    """

    post: ClassVar[type[Post]]
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
        return self.post().write(program)

    def test_names(self) -> None:
        """The post can be chosen and listed, and its files have an ending."""
        assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", self.post.name)
        assert self.post.title.strip() == self.post.title != ""
        assert re.fullmatch(r"(\.[a-z0-9]+)+", self.post.suffix)

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
        for what, changed in _changed(program):
            assert self._write(changed) != text, f"the text does not show {what}"

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
        name, text = self.post().tool_table(tools)
        assert (name == "") == (text == ""), "a tool table has both a name and a text, or neither"
        assert (name, text) == self.post().tool_table(tools)
        if name:
            assert re.fullmatch(r"[A-Za-z0-9_-]+(\.[A-Za-z0-9_-]+)*", name), f"unsafe file name {name!r}"
            assert text.endswith("\n")
            for tool in tools:
                assert re.search(rf"(?<!\d){tool.number}(?!\d)", text), f"tool {tool.number} is missing"


def _changed(program: Program) -> Iterator[tuple[str, Program]]:
    """The program with one number of one move changed, for every number of every move."""
    for s, section in enumerate(program.sections):
        for o, operation in enumerate(section.operations):
            for m, move in enumerate(operation.moves):
                for what, other in _changed_move(move):
                    moves = (*operation.moves[:m], other, *operation.moves[m + 1 :])
                    operations = list(section.operations)
                    operations[o] = replace(operation, moves=moves)
                    sections = list(program.sections)
                    sections[s] = replace(section, operations=tuple(operations))
                    where = f"{what} of {move} in operation {operation.name!r}"
                    yield where, replace(program, sections=tuple(sections))


def _changed_move(move: Move) -> Iterator[tuple[str, Move]]:
    if isinstance(move, Pause):
        yield "the message", replace(move, message=f"{move.message} again")
        return
    if isinstance(move, FeedArc):
        yield "the direction", replace(move, ccw=not move.ccw)
    # The rest of an arc hangs together: one number alone would leave no circle.
    free = {"z", "feed"} if isinstance(move, FeedArc) else {item.name for item in fields(move)}
    if isinstance(move, Drill):
        free -= {"breaking"}
        if move.peck is not None and move.dwell == 0:  # a hole in one go breaks no chips
            yield "the breaking of chips", replace(move, breaking=not move.breaking)
    for name in sorted(free):
        value = getattr(move, name)
        # A dwell of nothing is no dwell, and not every control can dwell in every cycle.
        if name == "breaking" and isinstance(move, Drill):
            # How a peck ends matters only where there are pecks.
            if move.peck is not None:
                yield name, replace(move, breaking=not move.breaking)
        elif value is not None and not (name == "dwell" and value == 0):
            yield name, replace(move, **{name: value + _STEP})
