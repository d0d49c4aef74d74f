"""One tool at several work offsets: its cuts stand once, in a subprogram that is called at each of them.

A control without subprograms has the cuts written out at each offset. Either way every tool is changed to
once, and between two offsets the tool is at the machine's upper end, where no offset says how high it stands.
"""

from typing import ClassVar, Literal

from mechwright_cam.controls.writing.sections import Sections
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Pause, ToolSection

RESTARTS_NONE = "with more_offsets operations stand in subprograms, in which no program is started"
"""Why there are no restart points."""


class Subprograms(Sections):
    """A control that is led through a program at each of its work offsets."""

    several = True
    subprograms: ClassVar[Literal["", "first", "behind"]] = ""
    """Where subprograms stand: before the main program, behind its end, or nowhere if there are none."""

    def end(self, out: Writer) -> None:
        """The end, and the subprograms that stand behind it."""
        super().end(out)
        if self.subprograms == "behind":
            out.lines += [line for lines in out.subprograms for line in lines]

    def subprogram_begins(self, out: Writer, number: int) -> str:
        """The line that begins a subprogram; the first is 1."""
        return f"O{self.subprogram_number(out, number)}"

    def subprogram_ends(self, out: Writer, number: int) -> str:  # noqa: ARG002
        """The line that ends it."""
        return "M99"

    def subprogram_call(self, out: Writer, number: int) -> str:
        """The line that runs it."""
        return f"M98 P{self.subprogram_number(out, number)}"

    def subprogram_number(self, out: Writer, number: int) -> int:  # noqa: ARG002
        """Its number on the control."""
        return 100 + number

    def section(self, out: Writer, section: ToolSection) -> None:
        """Write everything from one tool change to the next, at all work offsets."""
        if not out.program.more_offsets:
            super().section(out, section)
            return
        machine = out.program.machine
        self._machine_place(out, machine.change_x, machine.change_y)
        self.tool_change(out, section)
        number, turns = len(out.subprograms) + 1, False
        for place, offset in enumerate(out.program.offsets):
            out.offset = offset
            self.take_offset(out, section, turns=turns)
            if not place:
                self._stage(out)
            if not self.subprograms:
                turns = self._body(out, section)
                continue
            if not place:
                turns = self._subprogram(out, section, number)
            out.line(self.subprogram_call(out, number))
        if turns:
            out.line(self.m(5))

    def _subprogram(self, out: Writer, section: ToolSection, number: int) -> bool:
        """Write a tool's cuts into a subprogram; whether the spindle turns behind them."""
        main, out.lines = out.lines, []
        out.line(self.subprogram_begins(out, number))
        self.comment(out, self.tool_note(section.tool))
        turns = self._body(out, section)
        out.line(self.subprogram_ends(out, number))
        out.subprograms.append(out.lines)
        out.lines = main
        return turns

    def _body(self, out: Writer, section: ToolSection) -> bool:
        """Write a tool's cuts, from the upper end to there; whether the spindle turns behind them."""
        out.corners = []
        self.cuts(out, section)
        last = [move for operation in section.operations for move in operation.moves][-1]
        if isinstance(last, Pause):
            return False
        self.end_drilling(out)
        out.line(self.m(9))
        self.retract(out)
        return True

    def take_offset(self, out: Writer, section: ToolSection, *, turns: bool) -> None:
        """Put a work offset in force, and start the spindle unless it turns."""
        if turns:
            out.line(out.offset)
        else:
            self._offset_and_spindle(out, section)
