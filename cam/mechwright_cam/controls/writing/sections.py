"""The walk through a program: tool by tool, operation by operation, move by move.

Glossary
--------
modal word
    A word that stays in force until it is changed, and is not written again before.
clearance
    The height at which the tool may travel anywhere, but for a clamp.
restart point
    A place in the text from which the program can be started: everything that is modal is stated there.
"""

import math
from collections.abc import Sequence

from mechwright_cam.controls.writing.drilling import Drilling
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import (
    OPERATION_COMMENT,
    Drill,
    Feed,
    FeedArc,
    Move,
    Operation,
    Pause,
    Rapid,
    Tap,
    ToolSection,
)
from mechwright_cam.shop.tool import Tool
from mechwright_plane.text import number

COOLANT = {"flood": 8, "mist": 7}
"""The usual M codes."""


class Sections(Drilling):
    """A control that is led through a program."""

    def section(self, out: Writer, section: ToolSection) -> None:
        """Write everything from one tool change to the next."""
        machine, named = out.program.machine, False
        for operation in section.operations:
            self.comment(out, OPERATION_COMMENT + operation.name)
            begins = bool(operation.moves) and not named
            if begins:
                self._take_corners(out, operation)
                self._machine_place(out, machine.change_x, machine.change_y)
                self.tool_change(out, section)
                named = True
            elif out.program.posting.restart and self._can_restart(out, operation):
                self.comment(out, f"restart point: T{section.tool.number} in the spindle")
                self.restate(out)
                self._take_corners(out, operation)
                out.lost_height()
                begins = True
            if begins:
                out.offset = out.program.work_offset
                self._offset_and_spindle(out, section)
            if self._operation(out, section, operation, begins=begins):
                return
        self._halt(out)

    def cuts(self, out: Writer, section: ToolSection) -> None:
        """Write all operations of a section, with tool and work offset in force, up to the last move."""
        begins = True
        for operation in section.operations:
            self.comment(out, OPERATION_COMMENT + operation.name)
            if begins and operation.moves:
                self._take_corners(out, operation)
            if self._operation(out, section, operation, begins=begins and bool(operation.moves)):
                return
            begins = begins and not operation.moves

    def _operation(self, out: Writer, section: ToolSection, operation: Operation, *, begins: bool) -> bool:
        """Write the moves of an operation; whether the last one of the section is a stop, with all off."""
        last = [move for one in section.operations for move in one.moves][-1]
        moves = operation.moves
        if begins:
            self._approach(out, section, moves[0])
            moves = moves[1:]
        else:
            self._take_corners(out, operation)
        for move in moves:
            if move is last and isinstance(move, Pause):
                # The next section starts the spindle: here it would turn beside the operator's hands.
                self._stop(out, move)
                return True
            self._move(out, section, move)
        return False

    def safe_start(self, out: Writer) -> None:
        """Set every mode that the program relies on; an operation may ask for other corners."""
        out.line(*self.safe_modes)
        self.take_default_corners(out)

    def take_default_corners(self, out: Writer) -> None:
        """Choose how corners are taken unless an operation asks for something else."""
        out.corners = self.blending(out.program.posting.exact_stop)
        self.corner_lines(out, out.corners)

    def restate(self, out: Writer) -> None:
        """State the modes once more, at a restart point."""
        self.end_drilling(out)
        self.safe_start(out)
        self.retract(out)

    def _take_corners(self, out: Writer, operation: Operation) -> None:
        """State how an operation takes its corners, where that is otherwise than before it."""
        exact = out.program.posting.exact_stop
        words = [] if exact or operation.tolerance is None else self.rounding(operation.tolerance)
        words = words or self.blending(exact)
        if words != out.corners:
            out.corners = words
            self.corner_lines(out, words)

    def corner_lines(self, out: Writer, words: Sequence[str]) -> None:
        """Write the words that choose how corners are taken."""
        out.line(*words)

    def _can_restart(self, out: Writer, operation: Operation) -> bool:
        """Whether an operation starts above everything, at a stated place."""
        if not operation.moves or math.isnan(out.z) or out.z < out.program.clearance:
            return False
        first = operation.moves[0]
        return isinstance(first, Rapid) and None not in (first.x, first.y)

    def _offset_and_spindle(self, out: Writer, section: ToolSection) -> None:
        """The work offset and the spindle, in one line where that cannot be mistaken."""
        offset = out.offset
        if " " in offset:  # its P must not be taken for another word's
            out.line(offset)
            offset = ""
        self._start_spindle(out, section, offset)

    def _approach(self, out: Writer, section: ToolSection, first: Move) -> None:
        """Place, length offset and coolant, in that order."""
        assert isinstance(first, Rapid)  # noqa: S101 - the caller has seen to it
        out.lost_place()
        out.resumed = None
        out.line(out.motion_word("G0"), *out.axis_words(first.x, first.y, None))
        self.length_offset(out, section, out.program.clearance if first.z is None else first.z)
        out.line(self._coolant(section))
        self._stage(out)

    def _stage(self, out: Writer) -> None:
        """The tool that is to be made ready, once."""
        if out.staged:
            out.line(f"T{out.staged}")
            out.staged = 0

    def go_home(self, out: Writer) -> None:
        """Bring the table where the machine file wants it at the end; without machine zero to X0 Y0."""
        machine = out.program.machine
        if not machine.homed:
            out.line(out.motion_word("G0"), *out.axis_words(0.0, 0.0, None))
            return
        self._machine_place(out, machine.home_x, machine.home_y)

    def _machine_place(self, out: Writer, x: float | None, y: float | None) -> None:
        words = [f"{axis}{out.length(value)}" for axis, value in (("X", x), ("Y", y)) if value is not None]
        if words:
            out.line(*self.machine_words(), *words)
            out.motion = "G0"
            out.x = out.y = math.nan

    def _move(self, out: Writer, section: ToolSection, move: Move) -> None:
        if out.cycle and not isinstance(move, Drill | Tap):
            self.end_drilling(out)
        match move:
            case FeedArc():
                out.arc(move)
            case Feed() if move.side is not None:
                self._compensate(out, section.tool, move)
            case Feed():
                out.straight(move)
            case Rapid():
                self.rapid(out, move)
            case Drill():
                if math.isnan(out.z):
                    self.rapid(out, Rapid(z=out.program.clearance))
                if out.program.posting.cycles:
                    self.drill(out, move)
                else:
                    self.drill_in_moves(out, move)
            case Tap():
                out.tapping = section.tool
                if math.isnan(out.z):
                    self.rapid(out, Rapid(z=out.program.clearance))
                self.tap(out, move)
            case Pause():
                self._pause(out, section, move)

    def _compensate(self, out: Writer, tool: Tool, move: Feed) -> None:
        """Turn cutter compensation on or off along a straight line, which states both axes."""
        out.x = out.y = math.nan
        out.motion = ""  # G41, G42 and G40 want a G1 beside them, for whoever reads the block
        word = {"left": "G41", "right": "G42"}.get(move.side or "", "G40")
        number = f"D{tool.d_number}" if word != "G40" else ""
        axes = out.axis_words(move.x, move.y, None)
        out.line(out.motion_word("G1"), word, number, *axes, out.feed_word(move.feed))

    def _halt(self, out: Writer) -> None:
        """Coolant and spindle off, and up."""
        self.end_drilling(out)
        out.line(self.m(9))
        out.line(self.m(5))
        self.retract(out)

    def _stop(self, out: Writer, move: Pause) -> None:
        self._halt(out)
        self.message(out, move.message)
        out.line(self.m(0))

    def _pause(self, out: Writer, section: ToolSection, move: Pause) -> None:
        self._stop(out, move)
        out.motion = out.feed = ""  # whoever goes on from here finds both stated
        self._start_spindle(out, section)
        out.line(self._coolant(section))
        # G28 ends G43 on some machines, and so may what the operator does at the stop.
        out.resumed = section

    def _start_spindle(self, out: Writer, section: ToolSection, *words: str) -> None:
        out.speed = "S" + number(section.spindle, 0)
        out.line(*words, out.speed, self.m(4 if section.tool.left_hand else 3))
        if out.program.machine.spindle_delay > 0:
            self.dwell(out, out.program.machine.spindle_delay)

    def _coolant(self, section: ToolSection) -> str:
        code = COOLANT.get(section.coolant)
        return "" if code is None else self.m(code)
