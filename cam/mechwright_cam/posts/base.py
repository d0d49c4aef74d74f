"""What all posts share: modal words, rounding, and the walk through a program.

A control is a subclass that says how it spells a retract, a tool change, a length offset and the end.

Glossary
--------
modal word
    A word that stays in force until it is changed, and is not written again before.
clearance
    The height at which the tool may travel anywhere, but for a clamp.
"""

import math
from abc import abstractmethod

from mechwright.errors import ProgramError
from mechwright.output import Post
from mechwright.program import (
    OPERATION_COMMENT,
    Drill,
    Feed,
    FeedArc,
    Move,
    Pause,
    Program,
    Rapid,
    ToolSection,
)
from mechwright.tolerances import TOLERANCES
from mechwright_cam.posts.text import comment_lines, number, rounded

COOLANT = {"flood": "M8", "mist": "M7", "off": ""}
PECK_GAP = 0.25
"""Height above the last depth at which a peck that is written out starts to feed, mm: out of the chips."""


class Writer:
    """Program text under way, with what the control remembers.

    Positions are exact as planned (``x``, ``y``, ``z``) and, in the text, rounded; a centre is written from
    the rounded start, so that rounding never adds up. NaN stands for a position the text has not stated.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self.lines: list[str] = []
        self.x = self.y = self.z = math.nan
        self.motion = ""
        self.feed = ""
        self.cycle: tuple[str, ...] = ()

    def line(self, *words: str) -> None:
        """Write a line of these words; empty ones are left out."""
        text = " ".join(word for word in words if word)
        if text:
            self.lines.append(text)

    def motion_word(self, word: str) -> str:
        """The motion code if it is not in force already."""
        if self.motion == word:
            return ""
        self.motion = word
        return word

    def feed_word(self, feed: float) -> str:
        """The feed if it is not in force already."""
        word = "F" + number(feed, 1)
        if self.feed == word:
            return ""
        self.feed = word
        return word

    def axis_words(self, x: float | None, y: float | None, z: float | None) -> list[str]:
        """The coordinates that change in the text, and keep them all in mind."""
        # A position that the text does not state is NaN: its number equals none that is written.
        words = []
        if x is not None:
            if (text := number(x)) != number(self.x):
                words.append("X" + text)
            self.x = x
        if y is not None:
            if (text := number(y)) != number(self.y):
                words.append("Y" + text)
            self.y = y
        if z is not None:
            if (text := number(z)) != number(self.z):
                words.append("Z" + text)
            self.z = z
        return words

    def lost_height(self) -> None:
        """The tool stands at the machine's upper end, whose z the text does not know."""
        self.z = math.nan


class GcodePost(Post):
    """A control that reads RS274 words."""

    active_comments: tuple[str, ...] = ()
    """Words that the control would obey at the start of a comment."""

    def write(self, program: Program) -> str:
        """The program text, lines ended by a line feed.

        Raises
        ------
        ProgramError
            The program has no moves, or a section that does not start with a Rapid to x and y.
        """
        self._check(program)
        out = Writer(program)
        self.head(out)
        self.safe_start(out)
        self.retract(out)
        for section in program.sections:
            self._section(out, section)
        self.end(out)
        return "\n".join(out.lines) + "\n"

    # -- what a control spells its own way ----------------------------------------------------------------

    @abstractmethod
    def safe_start(self, out: Writer) -> None:
        """Set every mode that the program relies on."""

    @abstractmethod
    def retract(self, out: Writer) -> None:
        """Go to the machine's upper end."""

    @abstractmethod
    def tool_change(self, out: Writer, section: ToolSection) -> None:
        """Change the tool, select the work offset, start the spindle."""

    @abstractmethod
    def length_offset(self, out: Writer, section: ToolSection, z: float) -> None:
        """Turn on the tool's length offset, with the first move to z."""

    @abstractmethod
    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill one hole."""

    @abstractmethod
    def end_drilling(self, out: Writer) -> None:
        """Leave the drilling cycle, if one is in force."""

    @abstractmethod
    def end(self, out: Writer) -> None:
        """End the program."""

    def message(self, out: Writer, text: str) -> None:
        """Tell the operator something at a stop."""
        self.comment(out, text)

    # -- what is the same for all -------------------------------------------------------------------------

    def comment(self, out: Writer, text: str) -> None:
        """Write a comment, as many lines as it takes."""
        for line in comment_lines(text, self.active_comments):
            out.line(f"({line})")

    def head(self, out: Writer) -> None:
        """Write what the operator has to know before the start."""
        program = out.program
        self.comment(out, f"program {program.name}, {self.title}")
        for note in program.notes:
            self.comment(out, note)
        self.comment(out, f"origin {program.work_offset}, Z0 on top of the stock, units mm and mm/min")
        for tool in program.tools:
            kind = str(tool.kind).replace("-", " ")
            self.comment(
                out, f"T{tool.number} H{tool.number} D {number(tool.diameter)} mm: {tool.name}, {kind}"
            )

    def _check(self, program: Program) -> None:
        if not any(operation.moves for section in program.sections for operation in section.operations):
            raise ProgramError(f"program {program.name} has no moves; nothing is written")
        for section in program.sections:
            moves = [move for operation in section.operations for move in operation.moves]
            if not moves or not (isinstance(moves[0], Rapid) and None not in (moves[0].x, moves[0].y)):
                raise ProgramError(
                    f"program {program.name}: the section of T{section.tool.number} does not start "
                    "with a rapid to x and y"
                )

    def _section(self, out: Writer, section: ToolSection) -> None:
        named = False
        last = [move for operation in section.operations for move in operation.moves][-1]
        for operation in section.operations:
            self.comment(out, OPERATION_COMMENT + operation.name)
            moves = operation.moves
            if not named and moves:
                self.tool_change(out, section)
                first = moves[0]
                assert isinstance(first, Rapid)  # noqa: S101 - _check has seen to it
                out.line(out.motion_word("G0"), *out.axis_words(first.x, first.y, None))
                self.length_offset(out, section, out.program.clearance if first.z is None else first.z)
                out.line(COOLANT[section.coolant])
                moves = moves[1:]
                named = True
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

    def _move(self, out: Writer, section: ToolSection, move: Move) -> None:
        if not isinstance(move, Drill):
            self.end_drilling(out)
        match move:
            case Rapid():
                self._rapid(out, move)
            case Feed():
                words = out.axis_words(move.x, move.y, move.z)
                if words:
                    out.line(out.motion_word("G1"), *words, out.feed_word(move.feed))
            case FeedArc():
                self._arc(out, move)
            case Drill():
                if math.isnan(out.z):
                    self._rapid(out, Rapid(z=out.program.clearance))
                self.drill(out, move)
            case Pause():
                self._pause(out, section, move)

    def _rapid(self, out: Writer, move: Rapid) -> None:
        """Travel first and go down last, or go up first: never askew past a clamp or a wall."""
        upward = move.z is not None and not math.isnan(out.z) and move.z > out.z
        flat, upright = (move.x, move.y, None), (None, None, move.z)
        for axes in (upright, flat) if upward else (flat, upright):
            words = out.axis_words(*axes)
            if words:
                out.line(out.motion_word("G0"), *words)

    def _arc(self, out: Writer, move: FeedArc) -> None:
        x0, y0 = out.x, out.y
        whole = math.hypot(move.x - x0, move.y - y0) <= TOLERANCES.closure
        start, end = (rounded(x0), rounded(y0)), (rounded(move.x), rounded(move.y))
        if not whole and start == end:
            # Shorter than the last decimal: written as an arc it would be a full circle.
            words = out.axis_words(move.x, move.y, move.z)
            if words:
                out.line(out.motion_word("G1"), *words, out.feed_word(move.feed))
            return
        if whole:
            end = start
        centre = (number(x0 + move.i - start[0]), number(y0 + move.j - start[1]))
        out.x = out.y = math.nan  # an arc states its end in full: some controls want both axes
        axes = out.axis_words(end[0], end[1], None) + out.axis_words(None, None, move.z)
        out.x, out.y = (x0, y0) if whole else (move.x, move.y)
        word = out.motion_word("G3" if move.ccw else "G2")
        out.line(word, *axes, "I" + centre[0], "J" + centre[1], out.feed_word(move.feed))

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
        self.spindle(out, section)
        out.line(COOLANT[section.coolant])

    def spindle(self, out: Writer, section: ToolSection) -> None:
        """Start the spindle clockwise."""
        out.line("S" + number(section.spindle, 0), "M3")

    def drill_in_moves(self, out: Writer, hole: Drill) -> None:
        """Drill with plain moves, for controls and holes that no cycle serves."""
        top = max(out.z, hole.retract)
        self._rapid(out, Rapid(hole.x, hole.y))
        self._rapid(out, Rapid(z=hole.retract))
        depth = hole.retract
        while depth > hole.bottom:
            if depth < hole.retract:
                self._rapid(out, Rapid(z=hole.retract))
                self._rapid(out, Rapid(z=depth + PECK_GAP))
            depth = max(hole.bottom, depth - (hole.peck or math.inf))
            out.line(out.motion_word("G1"), *out.axis_words(None, None, depth), out.feed_word(hole.feed))
        if hole.dwell > 0:
            self.dwell(out, hole.dwell)
        self._rapid(out, Rapid(z=top))

    def dwell(self, out: Writer, seconds: float) -> None:
        """Wait."""
        out.line("G4", "P" + number(seconds, 3))
