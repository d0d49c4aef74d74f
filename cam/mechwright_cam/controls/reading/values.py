"""The lines of a program as they stand, or with the values that it works out: parameters and expressions.

Glossary
--------
frame
    What a running subroutine has of its own: parameters 1 to 30, names without a leading underscore.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from mechwright_cam.controls.reading.expressions import Reader
from mechwright_cam.controls.reading.parameters import check_writable

OWN = 30
"""So many numbered parameters belong to a subroutine."""
COMMENT = re.compile(r"\([^)]*\)|;.*")
_LETTER = re.compile(r"[a-z@^]")


class Lines:
    """The lines of a program, one after the other; whoever has run some more of them moves ``at`` on."""

    def __init__(self, lines: list[str]) -> None:
        self.lines = lines
        self.at = 0

    def run(self) -> Iterator[tuple[int, str]]:
        """Index and text of each line that the machine has to obey, in the order of running."""
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


class Values(Lines):
    """Lines whose values are worked out; ``system`` gives that of a parameter which the machine keeps."""

    def __init__(self, lines: list[str], system: Callable[[float | str], float]) -> None:
        super().__init__(lines)
        self.system = system
        self.numbers: dict[int, float] = {}
        self.names: dict[str, float] = {"_value": 0.0, "_value_returned": 0.0}
        self.frames = [Frame(-1, -1)]

    def _value(self, name: float | str) -> float:
        if isinstance(name, str):
            names = self.names if name.startswith("_") else self.frames[-1].names
            return names[name] if name in names else self.system(name)
        number = whole(name)
        numbers = self.frames[-1].own if 1 <= number <= OWN else self.numbers
        return numbers[number] if number in numbers else self.system(number)

    def _set(self, name: float | str, value: float) -> None:
        check_writable(name)
        if isinstance(name, str):
            (self.names if name.startswith("_") else self.frames[-1].names)[name] = value
        else:
            number = whole(name)
            (self.frames[-1].own if number <= OWN else self.numbers)[number] = value

    def _plain(self, line: str) -> str:
        """The line with every value worked out, and its settings of parameters carried out."""
        if "#" not in line and "[" not in line:
            return line
        comments = "".join(COMMENT.findall(line))
        reader = Reader("".join(COMMENT.sub("", line).split()).lower(), self._value)
        words, settings = [], []
        while reader.at < len(reader.text):
            rest = reader.text[reader.at :]
            if rest[0] == "#":
                name = reader.parameter()
                if reader.text[reader.at : reader.at + 1] != "=":
                    raise ValueError(f"= expected at {reader.text[reader.at :][:12]!r}")
                reader.at += 1
                settings.append((name, reader.real()))
            elif _LETTER.match(rest):
                reader.at += 1
                words.append(f"{rest[0].upper()}{spelt(reader.real())}")
            else:
                words.append(rest[0])
                reader.at += 1
        for name, value in settings:  # they hold from the next line on
            self._set(name, value)
        return " ".join(words) + comments

    def condition(self, rest: str) -> bool:
        """Whether an expression is other than 0."""
        return bool(Reader(rest, self._value).real())


def whole(value: float) -> int:
    """The whole number that a value is; raises ValueError if it is none."""
    number = round(value)
    if abs(value - number) > 1e-4:  # as near as LinuxCNC wants it
        raise ValueError(f"{value:g} is no whole number")
    return number


def spelt(value: float) -> str:
    """A value as a program has it."""
    return f"{value:.10f}".rstrip("0").rstrip(".") if value else "0"
