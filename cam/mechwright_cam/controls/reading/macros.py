"""The lines of a program in the order of running: as they stand, or as the program works them out.

LinuxCNC has parameters, expressions and O-words (loops, branches, subroutines) in programs. What comes out of
them is plain lines, one at a time, so that each value is worked out when the machine gets there.

Where structures begin and end: :mod:`mechwright_cam.controls.reading.o_words`.
"""

import re
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from mechwright_cam.controls.reading.blocks import check_comments, fail
from mechwright_cam.controls.reading.expressions import Reader
from mechwright_cam.controls.reading.o_words import (
    BRANCHES,
    ENDREPEAT,
    ENDSUB,
    ENDWHILE,
    OWords,
)
from mechwright_cam.controls.reading.plain import PlainLines, Row
from mechwright_cam.controls.reading.values import COMMENT, OWN, BehindError, Frame, Values, whole

_USES = re.compile(
    r"^(?:[^(;\n]|\([^)\n]*\))*?[#\[]|^\s*(?:n[0-9]+\s*)?/?(?:o\s*[0-9<\[#]|m\s*0*9\s*[89](?![0-9]))",
    re.IGNORECASE | re.MULTILINE,
)


def uses_macros(text: str) -> bool:
    """Whether a program has anything that is not plain words.

    >>> uses_macros("G0 X1 (#5)"), uses_macros("G0 X#5"), uses_macros("O100 sub")
    (False, True, True)
    """
    return _USES.search(text) is not None


MOST_LINES = 500_000
"""A program that runs more lines than this is taken for an endless loop: ten seconds."""
MOST_ROWS = 5000
"""So many rows of numbers are run together."""
FEW_LINES = 500
"""Fewer plain lines wait for what follows on them."""
NO_VALUES = dict.fromkeys(range(1, OWN + 1), 0.0)
"""The parameters of a subroutine that is called without values."""
_ENDS = re.compile(r"[Gg][ \t]*0*40(?![0-9.])")
DEEPEST = 10
"""Depth of calls, as LinuxCNC has it."""


class Macros(Values):
    """The same, of a program that works out its values and its way.

    ``system`` gives the value of a parameter that the machine keeps, and raises ValueError if it keeps none
    such; ``returned`` is called when a subroutine ends: the machine looks anew where it stands.
    """

    def __init__(
        self, lines: list[str], system: Callable[[float | str], float], returned: Callable[[], None]
    ) -> None:
        super().__init__(lines, system)
        self.returned = returned
        self.readable = len(lines)
        """Index of the first line that no control reads."""
        self.follow: Sequence[int] = [0] * len(lines)
        """How many plain lines follow on each other from each line on, 0 where it is not plain."""
        self.o_words = OWords(lines)
        self.words = self.o_words.words
        marked = (index for index in self.words if "(" in lines[index] or ";" in lines[index])
        self.commented = {index for index in marked if COMMENT.search(lines[index])}
        """Lines of O-words with a comment."""
        self.settling = {index for index, line in enumerate(lines) if "40" in line and _ENDS.search(line)}
        """Lines with G40: whether a subroutine may end behind one is known once it has been run."""
        self.done = 0
        """How many lines have been run."""

    def run(self) -> Iterator[tuple[int, str | list[Row]]]:
        """What the machine has to obey, in the order of running: a line by index and text, or rows."""
        while self.at < len(self.lines):
            self.done += 1
            if self.done > MOST_LINES:
                yield from self._rows()
                raise fail(self.at + 1, f"more than {MOST_LINES} lines are run; does a loop not end?")
            index = self.at
            if index in self.commented:
                yield from self._rows()
                check_comments(index + 1, self.lines[index])
                yield index, "".join(COMMENT.findall(self.lines[index]))
            try:
                try:
                    line = self._next(index)
                except BehindError:
                    yield from self._rows()
                    line = self._next(index)
            except (ValueError, OverflowError) as error:
                yield from self._rows()  # what goes wrong in them has gone wrong before
                if str(error).startswith("line "):
                    raise
                raise fail(index + 1, str(error)) from None
            if isinstance(line, Row):
                self.waiting.append(line)
                if len(self.waiting) < MOST_ROWS and index not in self.settling:
                    continue
            elif line is not None:
                yield from self._rows()
                yield index, line
                self.done += self.at - index - 1
                continue
            else:
                continue
            yield from self._rows()
        yield from self._rows()

    def _rows(self) -> Iterator[tuple[int, list[Row]]]:
        """The rows that the machine has still to run, if there are any."""
        if self.waiting:
            rows, self.waiting = self.waiting, []
            yield rows[0].index, rows

    def _next(self, index: int) -> str | Row | None:
        """Work out a line; a structure gives none."""
        self.at = index + 1
        if index in self.words:
            self._obey(index, *self.words[index])
            return None
        line = self.lines[index]
        if index >= self.readable:
            return line
        if "#" in line or "[" in line:
            return self._worked_out(index)
        # A few plain lines in a loop or a subroutine wait; many are run as they stand.
        return Row(index, None, []) if 0 < self.follow[index] < FEW_LINES else line

    # -- structures -------------------------------------------------------------------------------------

    def _obey(self, index: int, label: str, word: str, rest: str) -> None:
        o_words = self.o_words
        o_words.check(index)
        match word:
            case "sub":
                self.at = o_words.find(index, ENDSUB) + 1
            case "":  # the number of a program, or of a subroutine that M98 calls
                if self.frames[-1].start >= 0 and not self.frames[-1].by_m98:
                    raise ValueError(f"O{label} stands inside of a subroutine that call has begun")
            case "call":
                self._call(label, rest)
            case "m98":
                self._call_by_number(rest)
            case "return" | "endsub" | "m99":
                self._return(word, rest)
            case "if":
                self._branch(index, rest)
            case "elseif" | "else":
                self.at = self._end_of_if(index) + 1
            case "while":
                self._while(index, rest)
            case "endwhile":
                self.at = o_words.find_back(index, "while")
            case "repeat":
                count = whole(self.alone(rest))
                self.frames[-1].repeats[index] = count
                if count <= 0:
                    self.at = o_words.find(index, ENDREPEAT) + 1
            case "endrepeat":
                start = o_words.find_back(index, "repeat")
                self.frames[-1].repeats[start] -= 1
                if self.frames[-1].repeats[start] > 0:
                    self.at = start + 1
            case "break":
                self.at = o_words.end_of_loop(index) + 1
            case "continue":
                self.at = o_words.end_of_loop(index)

    def _start(self, label: str, word: str) -> int:
        """The first line of the subroutine of a label, which has the word."""
        start = self.o_words.start(label, word)
        if len(self.frames) > DEEPEST:
            raise ValueError(f"calls are nested more than {DEEPEST} deep")
        return start

    def _enter(self, frame: Frame) -> None:
        self.frames.append(frame)
        self.at = frame.start + 1

    def _call(self, label: str, rest: str) -> None:
        if label[0] in "#[":
            label = str(whole(Reader(label, self._value).real()))
        start, own = self._start(label, "sub"), NO_VALUES.copy()
        if rest:
            reader, arguments = Reader(rest, self._value), []
            while reader.at < len(reader.text):
                arguments.append(reader.bracket())
            if len(arguments) > OWN:
                raise ValueError(f"a call has at most {OWN} values")
            own |= enumerate(arguments, 1)
        self._enter(Frame(self.at, start, own=own))

    def _call_by_number(self, rest: str) -> None:
        """M98 P L: subroutine P, L times; it shares the parameters 1 to 30 of whoever calls."""
        reader, words = Reader(rest, self._value), {"l": 1.0}
        while reader.at < len(reader.text):
            letter = reader.text[reader.at]
            if letter not in "pl":
                raise ValueError(f"M98 has P and L only: {reader.text[reader.at :][:12]!r}")
            reader.at += 1
            words[letter] = reader.real()
        if "p" not in words:
            raise ValueError("M98 without the number of a subroutine, P")
        rounds = whole(words["l"])
        if rounds > 0:
            start = self._start(str(whole(words["p"])), "")
            self._enter(Frame(self.at, start, by_m98=True, rounds=rounds, own=self.frames[-1].own))

    def read(self, lines: PlainLines, readable: int) -> None:
        """Say which lines are plain, and up to which one all are read."""
        self.readable = readable
        number = np.arange(len(lines))
        other = np.where(lines.plain, len(lines), number)
        self.follow = (np.minimum.accumulate(other[::-1])[::-1] - number).tolist()

    def _return(self, word: str, rest: str) -> None:
        result = self.alone(rest) if rest and word != "m99" else None
        frame = self.frames[-1]
        if frame.start < 0:
            if word == "m99":
                raise ValueError("M99 in the main program begins it again, without end; write M2 or M30")
            raise ValueError("a subroutine ends that was not called")
        if frame.by_m98 != (word == "m99"):
            raise ValueError("O sub is called by call and ends with endsub, M98 calls what ends with M99")
        if frame.rounds == 1:
            try:
                self.returned()
            except ValueError:
                if self.waiting:
                    raise BehindError from None
                raise
        self.names["_value"] = 0.0 if result is None else result
        self.names["_value_returned"] = float(result is not None)
        frame.rounds -= 1
        if frame.rounds:
            self.at, frame.names = frame.start + 1, {}
            return
        self.frames.pop()
        self.at = frame.back

    def _branch(self, index: int, rest: str) -> None:
        taken = self.condition(rest)
        while not taken:
            self.done += 1
            index = self.o_words.find(index, BRANCHES)
            taken = self.words[index][1] != "elseif" or self._condition(index)
        self.at = index + 1

    def _condition(self, index: int) -> bool:
        """The condition of a line that is not the one which is run, but is worked out with it."""
        try:
            return self.condition(self.words[index][2])
        except (ValueError, OverflowError) as error:
            raise fail(index + 1, str(error)) from None

    def _end_of_if(self, index: int) -> int:
        """The end of an if whose branch has been run: the control works out the conditions on the way."""
        while (word := self.words[index][1]) != "endif":
            if word == "elseif":
                self._condition(index)
            index = self.o_words.find(index, BRANCHES)
        return index

    def _while(self, index: int, rest: str) -> None:
        if self.o_words.ends_do(index):
            start = self.o_words.find_back(index, "do")
            self.at = start + 1 if self.condition(rest) else index + 1
        elif not self.condition(rest):
            self.at = self.o_words.find(index, ENDWHILE) + 1
