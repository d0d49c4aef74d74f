"""What a control spells its own way: its words, its comments, and the few lines that differ."""

import math
from collections.abc import Mapping, Sequence
from typing import ClassVar

from mechwright_cam.controls.contract import METRIC, Control
from mechwright_cam.controls.dialect import Corners, Dialect
from mechwright_cam.controls.offsets import DOffset
from mechwright_cam.controls.words.kept import left_over
from mechwright_cam.controls.writing.writer import Writer, with_numbers
from mechwright_cam.program.moves import Program, ToolSection
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import COMMENT_WIDTH, comment_lines, number

SHORT = {"mm": "mm", "inch": "in"}
"""Units as they stand behind a number."""


class Spelling(Control):
    """A control that reads RS274 words, and how it spells what differs."""

    dialect: ClassVar[Dialect]
    """What it understands, and what it means by it."""
    capitals: ClassVar[bool] = False
    """Whether comments are of capitals."""
    active_comments: ClassVar[tuple[str, ...]] = ()
    """Words that the control would obey at the start of a comment."""
    forbidden: ClassVar[str] = ""
    """Characters that the control would obey even in a comment."""
    comment_width: ClassVar[int] = COMMENT_WIDTH
    """Comments are shorter than this."""
    highest_tool: ClassVar[int] = 9999
    """The largest T number that it takes."""
    retract_motion: ClassVar[str] = "G0"
    """The motion in force after a retract."""
    modes: ClassVar[tuple[str, ...]] = ("G17", METRIC, "G40", "G49", "G80", "G90", "G94")
    """The safe start: every mode that the program relies on; in inches with G20 for G21."""

    @property
    def compensates(self) -> bool:
        """Whether it has cutter compensation at all, which an earlier program may have left on."""
        return self.dialect.then("cutter compensation") is not None

    takes_back: ClassVar[str] = ""
    """How hands take back what an earlier program has left and none shows."""

    @property
    def leftover(self) -> str:
        """The states that no program shows, and how hands take them back."""
        states = left_over(self.dialect.kept)
        return f"{states} of an earlier program: {self.takes_back}" if states else ""

    @property
    def decimals(self) -> int:
        """Decimals of a coordinate, in its units, that the control keeps."""
        return self.dialect.decimals_inch if self.units == "inch" else self.dialect.decimals

    @property
    def safe_modes(self) -> tuple[str, ...]:
        """The safe start in the units of the program."""
        metric = self.speaking("mm").unit_word
        return tuple(self.unit_word if word == metric else word for word in self.modes)

    @property
    def corners(self) -> Corners:
        """How far the control leaves the path between two moves."""
        return self.dialect.corners

    @property
    def length_write(self) -> tuple[int, str] | None:
        """L of the G10 that sets a tool's length, and the letter of the length; None without such a table."""
        return self.dialect.length_write

    def length(self, value: float) -> str:
        """A coordinate or another length, mm."""
        return number(value / self.scale, self.decimals, self.dialect.point_needed)

    def m(self, code: int) -> str:
        """The control's word for a usual M code."""
        return f"M{self.dialect.m(code)}"

    def writer(self, program: Program) -> Writer:
        """What the words of a program are written with."""
        return Writer(program, self.decimals, self.dialect.point_needed, self.scale)

    def finished(self, out: Writer) -> list[str]:
        """The lines of a program that is written, with their numbers where they are asked for."""
        step = out.program.posting.line_numbers
        return with_numbers(out.lines, step) if step else out.lines

    def frame(self, out: Writer) -> None:
        """Write what stands before everything else."""

    def end(self, out: Writer) -> None:
        """Coolant, spindle and height are safe already; end."""
        out.line(self.m(30))

    def retract_lines(self, z: float) -> Sequence[str]:
        """The lines that go to the machine's upper end, which is at machine Z z, mm."""
        return (f"G53 G0 Z{self.length(z)}",)

    def machine_words(self) -> Sequence[str]:
        """The words before axes that are machine coordinates, for a rapid."""
        return ("G53", "G0")

    def write_offset(self, offset: str, places: Mapping[str, float]) -> str:
        """The line that sets a work offset, axis by axis, mm."""
        axes = [axis + self.length(value) for axis, value in places.items()]
        return " ".join([self.setting_words(offset), *axes])

    def retract(self, out: Writer) -> None:
        """Go to the machine's upper end; without machine coordinates, to the height of rapids."""
        if not out.program.machine.homed:
            out.motion, out.z = "", math.nan
            out.line(out.motion_word("G0"), *out.axis_words(None, None, out.program.clearance, rapid=True))
            return
        for line in self.retract_lines(self.upper_end(out.program.machine)):
            out.line(line)
        out.motion = self.retract_motion
        out.lost_height()

    def retract_words(self, machine: Machine) -> str:
        """What goes to the upper end of a machine, or above everything in the work."""
        if not machine.homed:
            return "G0 Z, in a line of its own, to the height of rapids"
        return ", then ".join(self.retract_lines(self.upper_end(machine)))

    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Change the tool, which stands at the machine's upper end."""
        out.line(self.change_words(section.tool.number))

    def length_offset(self, out: Writer, section: ToolSection, z: float) -> None:
        """Turn on the tool's length offset, with the first move to z."""
        out.line(self.length_words(section.tool.number), *out.axis_words(None, None, z, rapid=True))

    def message(self, out: Writer, text: str) -> None:
        """Tell the operator something at a stop."""
        self.comment(out, text)

    def blending(self, exact: bool) -> list[str]:
        """The words that choose how corners are taken."""
        return ["G61" if exact else "G64"]

    def rounding(self, tolerance: float) -> list[str]:  # noqa: ARG002 - for controls that can be asked
        """The words that keep within a tolerance of the path, mm, 0 for exact; none if there are none."""
        return []

    def tool_words(self, tool: Tool) -> list[str]:
        """The lines that set a tool's measured length."""
        return [f"G10 L1 P{tool.number} Z{self.length(tool.worn_length)}"]

    def comment(self, out: Writer, text: str) -> None:
        """Write a comment, as many lines as it takes."""
        for line in comment_lines(
            text, self.active_comments, self.forbidden, self.capitals, self.comment_width
        ):
            out.line(f"({line})")

    def tool_note(self, tool: Tool) -> str:
        """A tool in the head: its numbers, diameter, name and kind."""
        kind = str(tool.kind).replace("-", " ")
        size = f"{self._said(tool.diameter)} {SHORT[self.units]}"
        return f"T{tool.number} H{tool.number} D {size}: {tool.name}, {kind}"

    def _said(self, value: float) -> str:
        """A length for people, mm, in the units of the program."""
        return number(value / self.scale, max(self.decimals, 4))

    def d_note(self, offset: DOffset) -> str:
        """What a D offset has to hold."""
        what = f"{offset.quantity} of T{offset.tool.number}"
        if offset.planned == 0:
            value, what = "0 for a cutter as planned", f"wear on the {what}"
        else:
            value = f"{self._said(offset.planned)} as planned"
        return f"D{offset.number} holds the {what}: {value}, at most {self._said(offset.limit)} more or less"
