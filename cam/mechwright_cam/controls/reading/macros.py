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
    r"^(?:[^(;\n]|\([^)\n]*\))*?[#\[]|^\s*(?:n[0-9]+\s*)?/?(?:o\s*[0-9<\[#]|m\s*0*9\s*[89](?![0-9]))",
    re.IGNORECASE | re.MULTILINE,
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


MOST_LINES = 500_000
"""A program that runs more lines than this is taken for an endless loop: ten seconds."""
DEEPEST = 10
"""Depth of calls, as LinuxCNC has it."""
OWN = 30
"""So many numbered parameters belong to a subroutine."""
_COMMENT = re.compile(r"\([^)]*\)|;.*")
_O_WORD = re.compile(
    r"(?:n[0-9]+)?o([0-9]+|<[^<>]+>)"
    r"(sub|endsub|return|call|do|while|endwhile|if|elseif|else|endif|repeat|endrepeat|break|continue|$)(.*)"
)
_WORKED_OUT = re.compile(r"(?:n[0-9]+)?o((?:#|\[).*)call(.*)")
"""A call whose label is a value."""
_M98 = re.compile(r"(?:n[0-9]+)?m0*9([89])(?![0-9.])(.*)")
_LETTER = re.compile(r"[a-z@^]")


@dataclass(slots=True)
class _Frame:
    back: int
    start: int
    """Line of its first word, -1 for the main program."""
    by_m98: bool = False
    rounds: int = 1
    """How often it is still to be run, this time included."""
    own: dict[int, float] = field(default_factory=dict)
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
        self.names: dict[str, float] = {"_value": 0.0, "_value_returned": 0.0}
        self.frames = [_Frame(-1, -1)]
        self.words: dict[int, tuple[str, str, str]] = {}
        self.places: dict[str, list[int]] = {}
        """Lines of each label, in order."""
        percents = 0
        for index, line in enumerate(lines):
            code = "".join(_COMMENT.sub("", line).split()).lower()
            percents += code == "%"
            if percents == 2:
                break
            if not code.lstrip("n0123456789").startswith(("o", "m")):
                continue
            if match := _O_WORD.fullmatch(code):
                label = str(int(match[1])) if match[1].isdigit() else match[1]
                self.words[index] = (label, match[2], match[3])
                self.places.setdefault(label, []).append(index)
            elif match := _WORKED_OUT.fullmatch(code):
                self.words[index] = (match[1], "call", match[2])
            elif match := _M98.fullmatch(code):
                self.words[index] = ("", f"m9{match[1]}", match[2])

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
                    if comments := _COMMENT.findall(self.lines[index]):
                        yield index, "".join(comments)
                    self._obey(index, *self.words[index])
                else:
                    yield index, self._plain(self.lines[index])
                    done += self.at - index - 1
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
        numbers = self.frames[-1].own if 1 <= number <= OWN else self.numbers
        return numbers[number] if number in numbers else self.system(number)

    def _set(self, name: float | str, value: float) -> None:
        check_writable(name)
        if isinstance(name, str):
            (self.names if name.startswith("_") else self.frames[-1].names)[name] = value
        else:
            number = _whole(name)
            (self.frames[-1].own if number <= OWN else self.numbers)[number] = value

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
                if any(self.words.get(k, ("", "", ""))[1] == "sub" for k in range(index + 1, self.at)):
                    raise ValueError(
                        f"a subroutine is defined inside of O{label}; define one after the other"
                    )
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

    def _start(self, label: str, word: str) -> int:
        """The first line of the subroutine of a label, which has the word."""
        starts = [place for place in self.places.get(label, ()) if self.words[place][1] == word]
        if not starts:
            raise ValueError(f"there is no subroutine {label} in this file; no other is read")
        if len(self.frames) > DEEPEST:
            raise ValueError(f"calls are nested more than {DEEPEST} deep")
        return starts[0]

    def _enter(self, frame: _Frame) -> None:
        self.frames.append(frame)
        self.at = frame.start + 1

    def _call(self, label: str, rest: str) -> None:
        if label[0] in "#[":
            label = str(_whole(Reader(label, self._value).real()))
        start, reader, arguments = self._start(label, "sub"), Reader(rest, self._value), []
        while reader.at < len(reader.text):
            arguments.append(reader.bracket())
        if len(arguments) > OWN:
            raise ValueError(f"a call has at most {OWN} values")
        own = dict.fromkeys(range(1, OWN + 1), 0.0) | dict(enumerate(arguments, 1))
        self._enter(_Frame(self.at, start, own=own))

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
        rounds = _whole(words["l"])
        if rounds > 0:
            start = self._start(str(_whole(words["p"])), "")
            self._enter(_Frame(self.at, start, by_m98=True, rounds=rounds, own=self.frames[-1].own))

    def _return(self, word: str, rest: str) -> None:
        result = Reader(rest, self._value).real() if rest and word != "m99" else None
        frame = self.frames[-1]
        if frame.start < 0:
            if word == "m99":
                raise ValueError("M99 in the main program begins it again, without end; write M2 or M30")
            raise ValueError("a subroutine ends that was not called")
        if frame.by_m98 != (word == "m99"):
            raise ValueError("O sub is called by call and ends with endsub, M98 calls what ends with M99")
        self.names["_value"] = 0.0 if result is None else result
        self.names["_value_returned"] = float(result is not None)
        frame.rounds -= 1
        if frame.rounds:
            self.at, frame.names = frame.start + 1, {}
            return
        self.frames.pop()
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
        before = self._before(index, label, {"do", "while"})
        if before is not None and self.words[before][1] == "do":  # the end of do ... while
            self.at = before + 1 if self._condition(rest) else index + 1
        elif not self._condition(rest):
            self.at = self._find(index, label, {"endwhile"}) + 1

    def _end(self, index: int, label: str) -> int:
        """The line that closes the loop of a label."""
        return self._find(index, label, {"endwhile", "endrepeat", "while"})

    def _find(self, index: int, label: str, wanted: set[str]) -> int:
        places = self.places[label]
        for at in range(bisect_right(places, index), len(places)):
            if self.words[places[at]][1] in wanted:
                return places[at]
        raise ValueError(f"O{label} has no {' or '.join(sorted(wanted))}")

    def _before(self, index: int, label: str, wanted: set[str]) -> int | None:
        """The last line before another, of the same label, that has one of the words."""
        places = self.places[label]
        for at in range(bisect_right(places, index - 1) - 1, -1, -1):
            if self.words[places[at]][1] in wanted:
                return places[at]
        return None

    def _find_back(self, index: int, label: str, wanted: str) -> int:
        place = self._before(index, label, {wanted})
        if place is None:
            raise ValueError(f"O{label} has no {wanted}")
        return place


def _whole(value: float) -> int:
    number = round(value)
    if abs(value - number) > 1e-4:  # as near as LinuxCNC wants it
        raise ValueError(f"{value:g} is no whole number")
    return number


def _number(value: float) -> str:
    return f"{value:.10f}".rstrip("0").rstrip(".") if value else "0"
