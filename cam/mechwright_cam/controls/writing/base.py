"""What all posts share: the frame of a program and the walk through it.

A control is a subclass that says how it spells a retract, a tool change, a length offset and the end.

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
from abc import abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from mechwright.contracts.finding import Finding
from mechwright.errors import ProgramError
from mechwright_cam.controls.contract import Post
from mechwright_cam.controls.writing.checks import check_program, unmet
from mechwright_cam.controls.writing.offsets import OFFSETS, DOffset, d_offset, has_offset
from mechwright_cam.controls.writing.text import DECIMALS, comment_lines, number
from mechwright_cam.controls.writing.writer import Writer, with_numbers
from mechwright_cam.program.moves import (
    OPERATION_COMMENT,
    Drill,
    Feed,
    FeedArc,
    Move,
    Operation,
    Pause,
    Program,
    Rapid,
    ToolSection,
)
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

COOLANT = {"flood": "M8", "mist": "M7", "off": ""}
PECK_GAP = 0.25
"""Height above the last depth at which a peck that is written out starts to feed, mm: out of the chips."""


class GcodePost(Post):
    """A control that reads RS274 words."""

    decimals: ClassVar[int] = DECIMALS
    """Of coordinates, mm."""
    point: ClassVar[bool] = False
    """Whether a number without a decimal point means thousandths."""
    capitals: ClassVar[bool] = False
    """Whether comments are of capitals."""
    active_comments: ClassVar[tuple[str, ...]] = ()
    """Words that the control would obey at the start of a comment."""
    forbidden: ClassVar[str] = ""
    """Characters that the control would obey even in a comment."""
    work_offsets: ClassVar[tuple[str, ...]] = ("G54 to G59",)
    """The work offsets it has: keys of :data:`mechwright_cam.controls.writing.offsets.OFFSETS`."""
    highest_tool: ClassVar[int] = 9999
    """The largest T number that it takes."""
    compensates: ClassVar[bool] = True
    """Whether it has cutter compensation, G41 and G42."""
    milliseconds: ClassVar[bool] = False
    """Whether P counts thousandths of a second."""
    modes: ClassVar[tuple[str, ...]] = ("G17", "G21", "G40", "G49", "G80", "G90", "G94")
    """The safe start: every mode that the program relies on."""

    def write(self, program: Program) -> str:
        """The program text, lines ended by a line feed.

        Raises
        ------
        ProgramError
            The program has no moves, or a section that does not start with a Rapid to x and y; the offsets
            that it should set have not been measured.
        """
        check_program(program, self.title, self.highest_tool, self.compensates)
        out = Writer(program, self.decimals, self.point)
        self.frame(out)
        self.head(out)
        self.safe_start(out)
        if program.posting.offsets:
            self.set_offsets(out)
        self.retract(out)
        for place, section in enumerate(program.sections):
            if place and program.posting.optional_stops and out.lines[-1] != "M0":
                out.line("M1")
            self._section(out, section)
        self.go_home(out)
        self.end(out)
        step = program.posting.line_numbers
        lines = with_numbers(out.lines, step) if step else out.lines
        return "\n".join(lines) + "\n"

    def check(self, settings: CamSettings) -> Sequence[Finding]:
        """What the control cannot do of what a design file asks for: work offset, cutter compensation."""
        return tuple(unmet(settings, self.title, self.work_offsets, self.compensates))

    # -- what a control spells its own way ----------------------------------------------------------------

    def frame(self, out: Writer) -> None:
        """Write what stands before everything else."""

    @abstractmethod
    def retract(self, out: Writer) -> None:
        """Go to the machine's upper end."""

    @abstractmethod
    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Change the tool, which stands at the machine's upper end."""

    def length_offset(self, out: Writer, section: ToolSection, z: float) -> None:
        """Turn on the tool's length offset, with the first move to z."""
        out.line("G43", f"H{section.tool.number}", *out.axis_words(None, None, z, rapid=True))

    @abstractmethod
    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill one hole."""

    def end_drilling(self, out: Writer) -> None:
        """Leave the drilling cycle, if one is in force."""
        if out.cycle:
            out.line("G80")
            out.cycle = ()
            out.motion = ""

    def end(self, out: Writer) -> None:
        """Coolant, spindle and height are safe already; end."""
        out.line("M30")

    def message(self, out: Writer, text: str) -> None:
        """Tell the operator something at a stop."""
        self.comment(out, text)

    def blending(self, exact: bool) -> list[str]:
        """The words that choose how corners are taken."""
        return ["G61" if exact else "G64"]

    def tool_words(self, tool: Tool) -> list[str]:
        """The lines that set a tool's measured length."""
        return [f"G10 L1 P{tool.number} Z{number(tool.length or 0.0, self.decimals, self.point)}"]

    # -- what is the same for all -------------------------------------------------------------------------

    def comment(self, out: Writer, text: str) -> None:
        """Write a comment, as many lines as it takes."""
        for line in comment_lines(text, self.active_comments, self.forbidden, self.capitals):
            out.line(f"({line})")

    def head(self, out: Writer) -> None:
        """Write what the operator has to know before the start."""
        program = out.program
        self.comment(out, f"program {program.name}, {self.title}")
        for note in program.notes:
            self.comment(out, note)
        self.comment(out, f"origin {program.work_offset}, Z0 on top of the stock, units mm and mm/min")
        for tool in program.tools:
            self.comment(out, self.tool_note(tool))
        for tool in program.compensated:
            offset = d_offset(tool, self.dialect, program.posting, program.compensation, program.wear_limit)
            self.comment(out, self.d_note(offset))

    def tool_note(self, tool: Tool) -> str:
        """A tool in the head: its numbers, diameter, name and kind."""
        kind = str(tool.kind).replace("-", " ")
        return f"T{tool.number} H{tool.number} D {number(tool.diameter)} mm: {tool.name}, {kind}"

    def d_note(self, offset: DOffset) -> str:
        """What a D offset has to hold."""
        what = f"{offset.quantity} of T{offset.tool.number}"
        if offset.planned == 0:
            value, what = "0 for a cutter as planned", f"wear on the {what}"
        else:
            value = f"{number(offset.planned)} as planned"
        return f"D{offset.number} holds the {what}: {value}, at most {number(offset.limit)} more or less"

    def safe_start(self, out: Writer) -> None:
        """Set every mode that the program relies on."""
        out.line(*self.modes)
        out.line(*self.blending(out.program.posting.exact_stop))

    def set_offsets(self, out: Writer) -> None:
        """Write the measured work offset and tool lengths into the control's tables."""
        program, places = out.program, out.program.measured
        missing = [f"cam.measured.{axis}" for axis in "xyz" if getattr(places, axis) is None]
        missing += [f"cam.measured.lengths.{tool.name}" for tool in program.tools if tool.length is None]
        if missing:
            raise ProgramError(
                f"cam.post.offsets: program {program.name} is to set its offsets, and {missing[0]} is not "
                "given; measure it, or leave the offsets to the operator"
            )
        axes = [a.upper() + out.length(getattr(places, a)) for a in "xyz"]
        family = next(name for name in self.work_offsets if has_offset((name,), program.work_offset))
        self.comment(out, "measured offsets")
        out.line(OFFSETS[family].setting(program.work_offset), *axes)
        for tool in program.tools:
            for line in self.tool_words(tool):
                out.line(line)

    def _section(self, out: Writer, section: ToolSection) -> None:
        named = False
        last = [move for operation in section.operations for move in operation.moves][-1]
        for operation in section.operations:
            self.comment(out, OPERATION_COMMENT + operation.name)
            moves = operation.moves
            if moves and not named:
                self._to_place_of_change(out)
                self.tool_change(out, section)
                out.lost_place()
                self._begin(out, section, moves[0])
                moves = moves[1:]
                named = True
            elif out.program.posting.restart and self._can_restart(out, operation):
                self.comment(out, f"restart point: T{section.tool.number} in the spindle")
                self.restate(out)
                out.lost_place()
                out.lost_height()
                self._begin(out, section, moves[0])
                moves = moves[1:]
            for move in moves:
                if move is last and isinstance(move, Pause):
                    # The next section starts the spindle: here it would turn beside the operator's hands.
                    self._stop(out, move)
                    return
                self._move(out, section, move)
        self.end_drilling(out)
        out.line("M9")
        out.line("M5")
        self.retract(out)

    def restate(self, out: Writer) -> None:
        """State the modes once more, at a restart point."""
        self.end_drilling(out)
        out.line(*self.modes)
        out.line(*self.blending(out.program.posting.exact_stop))
        self.retract(out)

    def _can_restart(self, out: Writer, operation: Operation) -> bool:
        """Whether an operation starts above everything, at a stated place."""
        if not operation.moves or math.isnan(out.z) or out.z < out.program.clearance:
            return False
        first = operation.moves[0]
        return isinstance(first, Rapid) and None not in (first.x, first.y)

    def _begin(self, out: Writer, section: ToolSection, first: Move) -> None:
        """Spindle, place, length offset and coolant, in that order."""
        assert isinstance(first, Rapid)  # noqa: S101 - the caller has seen to it
        out.resumed = None
        offset = out.program.work_offset
        if " " in offset:  # its P must not be taken for another word's
            out.line(offset)
            offset = ""
        self._start_spindle(out, section, offset)
        out.line(out.motion_word("G0"), *out.axis_words(first.x, first.y, None))
        self.length_offset(out, section, out.program.clearance if first.z is None else first.z)
        out.line(COOLANT[section.coolant])

    def _to_place_of_change(self, out: Writer) -> None:
        machine = out.program.machine
        self._machine_place(out, machine.change_x, machine.change_y)

    def go_home(self, out: Writer) -> None:
        """Bring the table where the machine file wants it at the end."""
        machine = out.program.machine
        self._machine_place(out, machine.home_x, machine.home_y)

    def _machine_place(self, out: Writer, x: float | None, y: float | None) -> None:
        words = [f"{axis}{out.length(value)}" for axis, value in (("X", x), ("Y", y)) if value is not None]
        if words:
            out.line("G53", "G0", *words)
            out.motion = "G0"
            out.x = out.y = math.nan

    def _move(self, out: Writer, section: ToolSection, move: Move) -> None:
        if out.cycle and not isinstance(move, Drill):
            self.end_drilling(out)
        match move:
            case FeedArc():
                out.arc(move)
            case Feed() if move.side is not None:
                self._compensate(out, section.tool, move)
            case Feed():
                out.straight(move)
            case Rapid():
                self._rapid(out, move)
            case Drill():
                if math.isnan(out.z):
                    self._rapid(out, Rapid(z=out.program.clearance))
                if out.program.posting.cycles:
                    self.drill(out, move)
                else:
                    self.drill_in_moves(out, move)
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

    def _rapid(self, out: Writer, move: Rapid) -> None:
        """Travel first and go down last, or go up first: never askew past a clamp or a wall."""
        upward = move.z is not None and not math.isnan(out.z) and move.z > out.z
        flat, upright = (move.x, move.y, None), (None, None, move.z)
        for axes in (upright, flat) if upward else (flat, upright):
            if move.z is not None and axes is upright and out.resumed is not None:
                section, out.resumed = out.resumed, None
                self.length_offset(out, section, max(move.z, out.program.clearance))
            words = out.axis_words(*axes, rapid=True)
            if words:
                out.line(out.motion_word("G0"), *words)

    def _stop(self, out: Writer, move: Pause) -> None:
        self.end_drilling(out)
        out.line("M9")
        out.line("M5")
        self.retract(out)
        self.message(out, move.message)
        out.line("M0")

    def _pause(self, out: Writer, section: ToolSection, move: Pause) -> None:
        self._stop(out, move)
        out.motion = out.feed = ""  # whoever goes on from here finds both stated
        self._start_spindle(out, section)
        out.line(COOLANT[section.coolant])
        # G28 ends G43 on some machines, and so may what the operator does at the stop.
        out.resumed = section

    def _start_spindle(self, out: Writer, section: ToolSection, *words: str) -> None:
        out.line(*words, "S" + number(section.spindle, 0), "M3")
        if out.program.machine.spindle_delay > 0:
            self.dwell(out, out.program.machine.spindle_delay)

    def cycle(self, out: Writer, hole: Drill, *, every_word: bool = False) -> None:
        """Drill with G81, G82 (dwell), G83 (pecks) or G73 (broken chips); holes that agree share the cycle.

        With ``every_word`` each hole states the whole cycle.
        """
        if hole.peck is not None and hole.dwell > 0:
            self.end_drilling(out)  # no cycle does both on all controls
            self.drill_in_moves(out, hole)
            return
        pecking = "G73" if hole.breaking else "G83"
        code = pecking if hole.peck is not None else "G82" if hole.dwell > 0 else "G81"
        words = [code, "Z" + out.height(hole.bottom), "R" + out.height(hole.retract, up=True)]
        if hole.peck is not None:
            words.append("Q" + out.length(hole.peck))
        elif hole.dwell > 0:
            words.append("P" + self.waiting(hole.dwell))
        # The cycle itself returns to the height it started from, so z stays what it is.
        feed = "F" + number(hole.feed, 1, self.point)
        again = out.cycle == (*words, feed)
        if again and not every_word:
            place = out.axis_words(hole.x, hole.y, None)
            out.line(*(place or ["X" + out.length(hole.x)]))
            return
        if not again:
            self.end_drilling(out)
        out.x = out.y = math.nan  # the first line of a cycle states both
        place = out.axis_words(hole.x, hole.y, None)
        stated = out.feed_word(hole.feed) or (feed if every_word else "")
        out.line("G98", code, *place, *words[1:], stated)
        out.cycle = (*words, feed)
        out.motion = ""

    def drill_in_moves(self, out: Writer, hole: Drill) -> None:
        """Drill with plain moves, for controls and holes that no cycle serves."""
        top = max(out.z, hole.retract)
        self._rapid(out, Rapid(hole.x, hole.y))
        self._rapid(out, Rapid(z=hole.retract))
        depth = hole.retract
        while depth > hole.bottom:
            if depth < hole.retract:
                if not hole.breaking:
                    self._rapid(out, Rapid(z=hole.retract))
                self._rapid(out, Rapid(z=depth + PECK_GAP))
            depth = max(hole.bottom, depth - (hole.peck or math.inf))
            out.line(out.motion_word("G1"), *out.axis_words(None, None, depth), out.feed_word(hole.feed))
        if hole.dwell > 0:
            self.dwell(out, hole.dwell)
        self._rapid(out, Rapid(z=top))

    def dwell(self, out: Writer, seconds: float) -> None:
        """Wait."""
        out.line("G4", "P" + self.waiting(seconds))

    def waiting(self, seconds: float) -> str:
        """A time as P counts it."""
        return number(1000 * seconds, 0) if self.milliseconds else number(seconds, 3)
