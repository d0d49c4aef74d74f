"""The lines of a program in the order of running: as they stand, or as the program works them out.

LinuxCNC has parameters, expressions and O-words (loops, branches, subroutines) in programs. What comes out of
them is plain lines, one at a time, so that each value is worked out when the machine gets there.

Glossary
--------
O-word
    A line such as ``O100 while [#1 lt 5]``; the label ties the lines of one structure together.
frame
    What a running subroutine has of its own: parameters 1 to 30, names without a leading underscore.
"""

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from mechwright_cam.controls.reading.blocks import fail
from mechwright_cam.controls.reading.expressions import Reader
from mechwright_cam.controls.reading.parameters import check_writable

_USES = re.compile(
    r"^(?:[^(;\n]|\([^)\n]*\))*?[#\[]|^\s*(?:n\d+\s*)?/?o\s*[\d<\[]", re.IGNORECASE | re.MULTILINE
)


def uses_macros(text: str) -> bool:
    """Whether a program has anything that is not plain words.

    >>> uses_macros("G0 X1 (#5)"), uses_macros("G0 X#5"), uses_macros("O100 sub")
    (False, True, True)
    """
    return _USES.search(text) is not None


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


MOST_LINES = 1_000_000
"""A program that runs more lines than this is taken for an endless loop."""
DEEPEST = 10
"""Depth of calls, as LinuxCNC has it."""
OWN = 30
"""So many numbered parameters belong to a subroutine."""
_COMMENT = re.compile(r"\([^)]*\)|;.*")
_O_WORD = re.compile(
    r"(?:n\d+)?o(\d+|<[^<>]+>)"
    r"(sub|endsub|return|call|do|while|endwhile|if|elseif|else|endif|repeat|endrepeat|break|continue)(.*)"
)
_LETTER = re.compile(r"[a-z@^]")


@dataclass(slots=True)
class _Frame:
    back: int
    label: str
    saved: dict[int, float]
    names: dict[str, float] = field(default_factory=dict)
    repeats: dict[int, int] = field(default_factory=dict)


class Macros(Lines):
    """The same, of a program that works out its values and its way.

    ``system`` gives the value of a parameter that the machine keeps, and raises ValueError if it keeps none
    such; ``returned`` is called when a subroutine ends: the machine looks anew where it stands.
    """

    def __init__(
        self, lines: list[str], system: Callable[[float | str], float], returned: Callable[[], None]
    ) -> None:
        super().__init__(lines)
        self.system, self.returned = system, returned
        self.numbers: dict[int, float] = {}
        self.names: dict[str, float] = {}
        self.frames = [_Frame(-1, "", {})]
        self.words: dict[int, tuple[str, str, str]] = {}
        for index, line in enumerate(lines):
            code = "".join(_COMMENT.sub("", line).split()).lower()
            if code.lstrip("/n0123456789").startswith("o") and (match := _O_WORD.fullmatch(code)):
                self.words[index] = (match[1], match[2], match[3])
        self.order = sorted(self.words)

    def run(self) -> Iterator[tuple[int, str]]:
        """Index and text of each line that the machine has to obey, in the order of running."""
        done = 0
        while self.at < len(self.lines):
            done += 1
            if done > MOST_LINES:
                raise fail(self.at + 1, f"more than {MOST_LINES} lines are run; does a loop not end?")
            index = self.at
            self.at += 1
            try:
                if index in self.words:
                    self._obey(index, *self.words[index])
                else:
                    yield index, self._plain(self.lines[index])
                    done += self.at - index - 1
            except RecursionError:
                raise fail(index + 1, "brackets are nested too deep") from None
            except (ValueError, OverflowError) as error:
                if str(error).startswith("line "):
                    raise
                raise fail(index + 1, str(error)) from None

    # -- values -----------------------------------------------------------------------------------------

    def _value(self, name: float | str) -> float:
        if isinstance(name, str):
            names = self.names if name.startswith("_") else self.frames[-1].names
            return names[name] if name in names else self.system(name)
        number = _whole(name)
        return self.numbers[number] if number in self.numbers else self.system(number)

    def _set(self, name: float | str, value: float) -> None:
        check_writable(name)
        if isinstance(name, str):
            (self.names if name.startswith("_") else self.frames[-1].names)[name] = value
        else:
            self.numbers[_whole(name)] = value

    def _plain(self, line: str) -> str:
        """The line with every value worked out, and its settings of parameters carried out."""
        if "#" not in line and "[" not in line:
            return line
        comments = "".join(_COMMENT.findall(line))
        reader = Reader("".join(_COMMENT.sub("", line).split()).lower(), self._value)
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
                words.append(f"{rest[0].upper()}{_number(reader.real())}")
            else:
                words.append(rest[0])
                reader.at += 1
        for name, value in settings:  # they hold from the next line on
            self._set(name, value)
        return " ".join(words) + comments

    def _condition(self, rest: str) -> bool:
        return bool(Reader(rest, self._value).real())

    # -- structures -------------------------------------------------------------------------------------

    def _obey(self, index: int, label: str, word: str, rest: str) -> None:
        match word:
            case "sub":
                self.at = self._find(index, label, {"endsub"}) + 1
            case "call":
                self._call(label, rest)
            case "return" | "endsub":
                self._return(rest)
            case "if":
                self._branch(index, label, rest)
            case "elseif" | "else":
                self.at = self._find(index, label, {"endif"}) + 1
            case "while":
                self._while(index, label, rest)
            case "endwhile":
                self.at = self._find_back(index, label, "while")
            case "repeat":
                count = _whole(Reader(rest, self._value).real())
                self.frames[-1].repeats[index] = count
                if count <= 0:
                    self.at = self._find(index, label, {"endrepeat"}) + 1
            case "endrepeat":
                start = self._find_back(index, label, "repeat")
                self.frames[-1].repeats[start] -= 1
                if self.frames[-1].repeats[start] > 0:
                    self.at = start + 1
            case "break":
                self.at = self._end(index, label) + 1
            case "continue":
                self.at = self._end(index, label)

    def _call(self, label: str, rest: str) -> None:
        starts = [i for i, (name, word, _) in self.words.items() if name == label and word == "sub"]
        if not starts:
            raise ValueError(f"there is no subroutine {label} in this file; no other is read")
        if len(self.frames) > DEEPEST:
            raise ValueError(f"calls are nested more than {DEEPEST} deep")
        reader, arguments = Reader(rest, self._value), []
        while reader.at < len(reader.text):
            arguments.append(reader.bracket())
        saved = {n: self.numbers[n] for n in range(1, OWN + 1) if n in self.numbers}
        self.frames.append(_Frame(self.at, label, saved))
        for number in range(1, OWN + 1):
            self.numbers[number] = arguments[number - 1] if number <= len(arguments) else 0.0
        self.at = starts[0] + 1

    def _return(self, rest: str) -> None:
        result = Reader(rest, self._value).real() if rest else None
        if len(self.frames) == 1:
            raise ValueError("a subroutine ends that was not called")
        frame = self.frames.pop()
        for number in range(1, OWN + 1):
            self.numbers.pop(number, None)
        self.numbers |= frame.saved
        if result is not None:
            self.names["_value"] = result
        self.names["_value_returned"] = float(result is not None)
        self.at = frame.back
        self.returned()

    def _branch(self, index: int, label: str, rest: str) -> None:
        taken = self._condition(rest)
        while not taken:
            index = self._find(index, label, {"elseif", "else", "endif"})
            _, word, condition = self.words[index]
            taken = word != "elseif" or self._condition(condition)
        self.at = index + 1

    def _while(self, index: int, label: str, rest: str) -> None:
        starts = [
            i for i, (name, word, _) in self.words.items() if i < index and name == label and word == "do"
        ]
        if starts:  # the end of do ... while
            self.at = starts[-1] + 1 if self._condition(rest) else index + 1
        elif not self._condition(rest):
            self.at = self._find(index, label, {"endwhile"}) + 1

    def _end(self, index: int, label: str) -> int:
        """The line that closes the loop of a label."""
        return self._find(index, label, {"endwhile", "endrepeat", "while"})

    def _find(self, index: int, label: str, wanted: set[str]) -> int:
        for place in self.order[bisect_right(self.order, index) :]:
            name, word, _ = self.words[place]
            if place > index and name == label and word in wanted:
                return place
        raise ValueError(f"O{label} has no {' or '.join(sorted(wanted))}")

    def _find_back(self, index: int, label: str, wanted: str) -> int:
        for place in self.order[bisect_right(self.order, index) :: -1]:
            name, word, _ = self.words[place]
            if place < index and name == label and word == wanted:
                return place
        raise ValueError(f"O{label} has no {wanted}")


def _whole(value: float) -> int:
    number = round(value)
    if abs(value - number) > 1e-4:  # as near as LinuxCNC wants it
        raise ValueError(f"{value:g} is no whole number")
    return number


def _number(value: float) -> str:
    return f"{value:.10f}".rstrip("0").rstrip(".") if value else "0"
