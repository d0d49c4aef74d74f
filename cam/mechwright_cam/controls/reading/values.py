"""The lines of a program as they stand, or with the values that it works out: parameters and expressions.

Glossary
--------
frame
    What a running subroutine has of its own: parameters 1 to 30, names without a leading underscore.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from mechwright_cam.controls.reading.blocks import check_comments
from mechwright_cam.controls.reading.expressions import HELD, Formulas, Known, MissingError, Reader, Worked
from mechwright_cam.controls.reading.parameters import FIRST, LAST, check_writable
from mechwright_cam.controls.reading.plain import DECIMALS, LETTERS, N, PlainLines, Row, spelt

OWN = 30
"""So many numbered parameters belong to a subroutine."""
COMMENT = re.compile(r"\([^)]*\)|;.*")
_LETTER = re.compile(r"[a-z@^]")
_NAME_OR_NUMBER = re.compile(r"<[^<>]*>|[0-9]+\.?[0-9]*|\.[0-9]+")
_LINE_NUMBER = re.compile(r"n[0-9]{1,5}(?![0-9.])")
_COLUMNS = {letter.lower(): column for column, letter in enumerate(LETTERS) if column != N}


class Lines:
    """The lines of a program, one after the other; whoever has run some more of them moves ``at`` on."""

    def __init__(self, lines: list[str]) -> None:
        self.lines = lines
        self.at = 0

    def read(self, lines: PlainLines, readable: int) -> None:
        """Say which lines are plain, and up to which one all are read; here none is worked out."""

    def run(self) -> Iterator[tuple[int, str | list[Row]]]:
        """Index and text of each line that the machine has to obey, in the order of running.

        Instead of a text there may be several lines that follow on each other, as rows of numbers.
        """
        while self.at < len(self.lines):
            self.at += 1
            yield self.at - 1, self.lines[self.at - 1]


@dataclass(slots=True)
class Frame:
    """What a running subroutine, or the main program, has of its own, and where it goes on."""

    back: int
    start: int
    """Line of its first word, -1 for the main program."""
    by_m98: bool = False
    rounds: int = 1
    """How often it is still to be run, this time included."""
    own: dict[int, float] = field(default_factory=dict)
    names: dict[str, float] = field(default_factory=dict)
    repeats: dict[int, int] = field(default_factory=dict)

    @property
    def fresh(self) -> bool:
        """Whether it has begun without any names."""
        return self.start >= 0 and not self.by_m98


class BehindError(Exception):
    """A value hangs on where the machine is, and it is not there yet: rows of numbers are still to be run."""


class Formula:
    """What a line of values says, whatever its numbers are (:data:`HELD` stands for each).

    Attributes
    ----------
    words
        Letter and value of each word; no value for a character that starts none.
    settings
        Parameters, by name or by what gives their number, and their values.
    columns
        The columns of its words in a row of numbers (:data:`~mechwright_cam.controls.reading.plain.LETTERS`);
        None if it is no such row.
    """

    def __init__(self, text: str) -> None:
        self.words: list[tuple[str, Worked | None]] = []
        self.settings: list[tuple[str | Worked, Worked]] = []
        formulas = Formulas(text)
        while formulas.at < len(text):
            first = text[formulas.at]
            if first == "#":
                name = formulas.parameter()
                if text[formulas.at : formulas.at + 1] != "=":
                    raise ValueError(f"= expected at {text[formulas.at :][:12]!r}")
                formulas.at += 1
                self.settings.append((name, formulas.real()))
                continue
            formulas.at += 1
            self.words.append((first, formulas.real() if _LETTER.match(first) else None))
        letters = [letter for letter, value in self.words]
        if "n" in letters:
            raise ValueError("a line number stands at the start of its line, and is a plain number")
        plain = len(set(letters)) == len(letters) and _COLUMNS.keys() >= set(letters)
        self.columns = tuple(_COLUMNS[letter] for letter in letters) if plain else None

    def worked_out(
        self, known: Known, held: Sequence[float]
    ) -> tuple[list[float | None], list[tuple[float | str, float]]]:
        """Values of the words, and what is set: the name or number of each parameter, and its value."""
        values = [None if value is None else value(known, held) for _, value in self.words]
        settings = [
            (name if isinstance(name, str) else name(known, held), value(known, held))
            for name, value in self.settings
        ]
        return values, settings


class Values(Lines):
    """Lines whose values are worked out; ``system`` gives that of a parameter which the machine keeps."""

    def __init__(self, lines: list[str], system: Callable[[float | str], float]) -> None:
        super().__init__(lines)
        self.waiting: list[Row] = []
        """Rows of numbers that the machine has still to run."""
        self._formulas: dict[str, Formula] = {}
        self._understood: dict[int, tuple[Formula, list[float], str]] = {}
        self.system = system
        self.numbers: dict[int, float] = {}
        self.names: dict[str, float] = {}
        self.frames = [Frame(-1, -1)]

    def _value(self, name: float | str) -> float:
        if isinstance(name, str):
            names = self.names if name.startswith("_") else self.frames[-1].names
            if name not in names and not name.startswith("_") and self.frames[-1].fresh:
                raise MissingError(f"#<{name}> has no value; set it before it is read")
            return names[name] if name in names else self._kept(name)
        number = whole(name)
        numbers = self.frames[-1].own if 1 <= number <= OWN else self.numbers
        return numbers[number] if number in numbers else self._kept(number)

    def _kept(self, name: float | str) -> float:
        """What the machine keeps."""
        if self.waiting and not (isinstance(name, int) and FIRST <= name <= LAST):
            raise BehindError
        return self.system(name)

    def _set(self, name: float | str, value: float) -> None:
        check_writable(name)
        if isinstance(name, str):
            (self.names if name.startswith("_") else self.frames[-1].names)[name] = value
        else:
            number = whole(name)
            (self.frames[-1].own if number <= OWN else self.numbers)[number] = value

    def _understand(self, index: int) -> tuple[Formula, list[float], str]:
        """What a line says, its numbers, and its comments."""
        line = self.lines[index]
        comments = "".join(COMMENT.findall(line))
        if comments:
            check_comments(index + 1, line)
            line = COMMENT.sub("", line)
        text = "".join(line.split()).lower()
        if HELD in text:
            raise ValueError("a character of number 0 is no part of a value")
        if match := _LINE_NUMBER.match(text):
            text = text[match.end() :]
        numbers: list[float] = []

        def hold(match: re.Match[str]) -> str:
            if match[0][0] == "<":
                return match[0]
            numbers.append(float(match[0]))
            return HELD

        text = _NAME_OR_NUMBER.sub(hold, text)
        if text not in self._formulas:
            self._formulas[text] = Formula(text)
        return self._formulas[text], numbers, comments

    def _worked_out(self, index: int) -> str | Row | None:
        """A line with every value worked out, and its settings of parameters carried out.

        A line that is nothing but plain words becomes a row of numbers; one of settings alone is None.
        """
        if index not in self._understood:
            self._understood[index] = self._understand(index)
        formula, numbers, comments = self._understood[index]
        values, settings = formula.worked_out(self._value, numbers)
        for name, value in settings:  # they hold from the next line on
            self._set(name, value)
        if formula.columns is not None and not comments:
            return (
                Row(index, formula.columns, [round(v, DECIMALS) if v else 0.0 for v in values])
                if values
                else None
            )
        words = (
            letter if value is None else f"{letter.upper()}{spelt(value)}"
            for (letter, _), value in zip(formula.words, values, strict=True)
        )
        return " ".join(words) + comments

    def alone(self, rest: str) -> float:
        """The value of an expression in brackets that has nothing behind it."""
        reader = Reader(rest, self._value)
        if reader.text[:1] != "[":
            raise ValueError(f"an O-word takes its value in brackets, [...]; found {rest[:12]!r}")
        value = reader.real()
        if reader.at < len(reader.text):
            raise ValueError(f"{reader.text[reader.at :][:12]!r} stands behind the value of an O-word")
        return value

    def condition(self, rest: str) -> bool:
        """Whether an expression is other than 0."""
        return bool(self.alone(rest))


def whole(value: float) -> int:
    """The whole number that a value is; raises ValueError if it is none."""
    number = round(value)
    if abs(value - number) > 1e-4:  # as near as LinuxCNC wants it
        raise ValueError(f"{value:g} is no whole number")
    return number
