"""Programs in the language of Siemens controls, line by line in the words that the interpreter reads.

What is read says one thing whatever the machine and earlier programs have set; all else is refused by its
name. A line stays a line, so that what is found in the words is told by the line of the program.

Glossary
--------
D
    Cutting edge of the tool in the spindle, whose length (and radius) it puts in force; D0 takes both back.
SUPA
    Machine coordinates for one block: without frames. Without the tool's length it is only under D0.
"""

import re
from collections.abc import Sequence

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading.blocks import NUMBER, fail
from mechwright_cam.controls.words.sinumerik import RENAMED, WORDS
from mechwright_cam.controls.words.table import Use

NAME = "SINUMERIK"
LONGEST = 512
"""Characters of a block."""
INCHES, METRIC = "G700", "G710"
WORK_OFFSETS = frozenset({"G54", "G55", "G56", "G57"})
_ADDRESSES = frozenset(letter for row in WORDS.codes for letter in row.takes) | frozenset("NST")
_HEADER = re.compile(r"%_N_\w+_MPF\s*")
_MESSAGE = re.compile(r'\s*(?:N[0-9]+\s*)?MSG\s*\(\s*(?:"([^"()]*)")?\s*\)\s*(?:;.*)?', re.IGNORECASE)
_FRAME_SET = re.compile(
    rf"\s*(?:N[0-9]+\s*)?\$P_UIFR\[([1-4])\]\s*=\s*CTRANS\(X,({NUMBER}),Y,({NUMBER}),Z,({NUMBER})\)\s*",
    re.IGNORECASE,
)
_WORD = re.compile(rf"\s*(?:([A-Z]{{2,}})(?:=({NUMBER}))?(?![\w=.+-])|([A-Z])=?({NUMBER})(?![0-9.]*[=(]))")
_WORKED_OUT = re.compile(r"\s*((CR|[FIJSXYZ])=[^\s;]+)")
"""A value that is an expression, or relative."""
_UNKNOWN = re.compile(r"\s*([A-Z_$]+[0-9]*|.)")
_ODD = re.compile(r"[^\t -~]")
_AXES = frozenset("XYZ")
_BLOCKS = re.compile(r"\s*(?:N[0-9]+\s*)?CALL\s+BLOCK\s+(\w+)\s+TO\s+(\w+)\s*", re.IGNORECASE)
_LABEL = re.compile(r"\s*(?:N[0-9]+\s*)?([A-Z_]{2}\w{0,30})\s*:\s*", re.IGNORECASE)


def translated(text: str, block_delete: bool) -> str:
    r"""The program in words that the interpreter reads, as many lines, up to its end.

    Raises
    ------
    ProgramError
        A word is not read, or says something only together with what the text does not say.

    Examples
    --------
    >>> translated("G17 G710 G90 ; modes\nG0 SUPA Z0 D0\nG2 X5 Y5 CR=5 F90\nG4 F0.5", False)
    'G17 G21 G90 ; modes\nG0 G53 Z0 G49\nG2 X5 Y5 R5 F90\nG4 P0.5'
    """
    lines = text.split("\n")
    reading = _Reading(lines)
    for index, line in enumerate(lines):
        if index == 0 and _HEADER.fullmatch(line):
            lines[0] = ""
            continue
        lines[index] = reading.line(index + 1, line, block_delete)
        if reading.ended and not reading.called:
            break
    return "\n".join(lines)


class _Reading:
    """What the words of a program say together."""

    def __init__(self, lines: Sequence[str]) -> None:
        found = (_BLOCKS.fullmatch(line.partition(";")[0]) for line in lines if "CALL" in line.upper())
        pairs = dict.fromkeys((match[1].upper(), match[2].upper()) for match in found if match)
        self.called = {pair: number for number, pair in enumerate(pairs, start=1)}
        """First and last label of each stretch that is called as a subprogram, and a number for it."""
        self.begins = {first: number for (first, _), number in self.called.items()}
        self.lasts = {last for _, last in self.called}
        self.edge: int | None = None
        """D in force; None while a setting of the machine decides."""
        self.units = ""
        self.shifted = False
        """Whether a work offset has been written and not been called since."""
        self.ended = False

    def line(self, number: int, text: str, block_delete: bool) -> str:
        """One line translated."""
        if len(text) > LONGEST or _ODD.search(text.partition(";")[0]):
            self.ended = True  # nobody reads the line, and none behind it
            return text
        if match := _MESSAGE.fullmatch(text):
            return f"; {match[1]}" if match[1] else ""
        code, mark, comment = text.partition(";")
        bare = code.lstrip(" \t")
        deleted = bare.startswith("/")
        if deleted:
            bare = bare[1:]
            if bare[:1].isdigit():
                raise fail(number, f"/{bare[0]} is a level of its own; write / for lines that may be skipped")
            if block_delete:
                return "/" + mark + comment
        made = self._subprogram(number, bare) or self._frame(bare) or self._block(number, bare)
        return ("/" if deleted else "") + made + (" " + mark if made and mark else mark) + comment

    def _subprogram(self, number: int, code: str) -> str:
        """A call of a stretch between two labels, or one of the labels."""
        if match := _BLOCKS.fullmatch(code):
            self.edge = None
            return f"M98 P{self.called[match[1].upper(), match[2].upper()]}"
        match = _LABEL.fullmatch(code)
        if match is None:
            return ""
        label, self.edge = match[1].upper(), None
        if label not in self.begins and label not in self.lasts:
            raise fail(number, f"{label} is a label of no CALL BLOCK; take it out")
        if not self.ended:
            raise fail(number, f"{label} before M30; what is called is read behind the end of the program")
        if label in self.begins and label in self.lasts:
            raise fail(number, f"{label} is the first label of one CALL BLOCK and the last of another")
        return f"O{self.begins[label]}" if label in self.begins else "M99"

    def _frame(self, code: str) -> str:
        """A work offset that is written by the program."""
        match = _FRAME_SET.fullmatch(code)
        if match is None:
            return ""
        self.shifted = True
        return f"G10 L2 P{match[1]} X{match[2]} Y{match[3]} Z{match[4]}"

    def _block(self, number: int, code: str) -> str:
        words = self._words(number, code.upper())
        names = {name for name, _ in words}
        if ("G", "4") in words:
            return self._dwell(number, words, names)
        made = [self._word(number, name, value) for name, value in words]
        self._together(number, words, names)
        return " ".join(word for word in made if word)

    def _words(self, number: int, code: str) -> list[tuple[str, str]]:
        """Name and value of each word; G and M without leading zeros."""
        words, at = [], 0
        code = code.rstrip(" \t")
        while at < len(code):
            match = _WORD.match(code, at)
            if match is None:
                found = _UNKNOWN.match(code, at)
                word = found[1] if found else code[at:]
                if (worked := _WORKED_OUT.match(code, at)) is not None:
                    raise fail(number, f"{worked[1]} is worked out; write {worked[2]} with a plain number")
                raise self._refused(number, word)
            name, value = match[1] or match[3], match[2] or match[4] or ""
            if name in {"G", "M", "T", "D", "N"}:
                if not value.isdigit():
                    raise fail(number, f"{name}{value} is no whole number")
                value = str(int(value)) if name != "N" else value
            if name in {"N", "G", "M", "D"} and "=" in match[0]:
                raise fail(number, f"{match[0].strip()} is no word of one axis or spindle; take the = out")
            words.append((name, value))
            at = match.end()
        return words

    def _refused(self, number: int, word: str) -> ProgramError:
        """The error of a word that is not read; the row of its name says what to write instead."""
        row = WORDS.known.get(word) or WORDS.known.get(re.sub(r"[0-9]+$", "", word))
        what = row.remedy if row is not None and row.remedy else "post the program without it"
        return fail(number, f"{word} is no word that is read in programs for {NAME}; {what}")

    def _dwell(self, number: int, words: list[tuple[str, str]], names: set[str]) -> str:
        """G4 stands alone; its F is a time, and no feed."""
        seconds = dict(words).get("F", "")
        if names - {"N", "G", "F"} or not seconds or len(words) - ("N" in names) != 2:
            raise fail(number, "G4 stands in a block of its own, with F, its seconds (S, turns, is not read)")
        return f"G4 P{seconds}"

    def _word(self, number: int, name: str, value: str) -> str:
        """What one word comes to, by its row or as an address of other rows."""
        row = WORDS.known.get(name + value)
        if row is None or row.use is Use.REFUSED:
            if name in _ADDRESSES and value:
                return f"{RENAMED.get(name, name)}{value}"
            if name == "D":
                raise fail(
                    number, f"D{value} is an edge that the tools of a job do not have; write D1, or D0"
                )
            raise self._refused(number, name + value if name in {"G", "M"} else name)
        match name:
            case "G":
                self._g(number, row.word)
            case "M":
                self.ended = self.ended or row.word in {"M2", "M30"}
                self.edge = None if row.word == "M6" else self.edge
            case "D":
                self.edge = int(value)
        return "" if row.use is Use.IDLE else row.becomes or row.word

    def _g(self, number: int, word: str) -> None:
        """Note what a G word says for others."""
        if word in {INCHES, METRIC}:
            if self.units not in {"", word}:
                raise fail(number, f"{word} in a program that has begun with {self.units}; keep to one")
            self.units = word
        if word in WORK_OFFSETS:
            self.shifted = False

    def _together(self, number: int, words: list[tuple[str, str]], names: set[str]) -> None:
        """Refuse words that mean something only with others."""
        if "D" in names and ("M", "6") in words:
            raise fail(number, "D beside M6; write it in a block behind the change")
        if "SUPA" in names:
            if self.edge != 0:
                raise fail(
                    number, "SUPA counts the tool's length in while an edge is in force; write D0 beside it"
                )
        elif self.shifted and names & _AXES:
            raise fail(
                number, "a work offset that is written holds from its next call on; write it, such as G54"
            )
