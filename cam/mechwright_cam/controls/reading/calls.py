"""The lines of a program with subprograms in the order of running.

Fanuc and those who follow it call numbered subprograms: ``M98 P101`` runs the lines from ``O101`` to ``M99``,
Haas' ``M97 P101`` those from the block N101 to M99. LinuxCNC's O-words are those of
:mod:`mechwright_cam.controls.reading.macros`.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from mechwright_cam.controls.reading.blocks import check_comments, fail
from mechwright_cam.controls.reading.plain import Row
from mechwright_cam.controls.reading.values import COMMENT, Lines

DEEPEST = 4
"""Depth of calls, as the older of these controls have it."""
MOST_ROUNDS = 999
"""So often is a subprogram called in one block at most."""
_CALL = re.compile(r"(?:N[0-9]+)?M0*9([78])P0*([0-9]+)(?:L0*([0-9]+))?")
_END = re.compile(r"(?:N[0-9]+)?M0*99")
_BEGINS = {"98": re.compile(r"[O:]0*([0-9]+)"), "97": re.compile(r"N0*([0-9]+)(?![0-9.]).*")}


@dataclass(frozen=True, slots=True)
class Body:
    """The lines of a subprogram: index of the first that is run, and of its M99."""

    first: int
    last: int


class Calls(Lines):
    """Lines that call subprograms of the same file, by M98 and O, or by M97 and N."""

    def __init__(self, lines: list[str], word: Literal["98", "97"]) -> None:
        super().__init__(lines)
        self.covered: set[int] = set()
        """Indices of the lines of all subprograms that are called."""
        self.calls: dict[int, tuple[int, int]] = {}
        """Line to the number that it calls, and how often."""
        self.ends: set[int] = set()
        self._bodies: dict[int, Body] = {}
        self._stack: list[list[int]] = []
        """Number, rounds that are left and line to go on at, of each call that runs."""
        code = [_code(line) for line in lines]
        for index, text in enumerate(code):
            if match := _CALL.fullmatch(text):
                self._see(index, match, word)
            elif _END.fullmatch(text):
                self.ends.add(index)
        for index, (number, _) in self.calls.items():
            if number not in self._bodies:
                self._bodies[number] = self._body(index, number, code, _BEGINS[word], word)
        for body in self._bodies.values():
            self.covered.update(range(body.first - (word == "98"), body.last + 1))

    def _see(self, index: int, match: re.Match[str], word: str) -> None:
        said = f"M9{match[1]}"
        if said != f"M{word}":
            what = "a subprogram of this file is called by M97" if word == "97" else "write M98"
            raise fail(index + 1, f"{said} is not read here; {what}")
        rounds = int(match[3] or 1)
        if not 1 <= rounds <= MOST_ROUNDS:
            raise fail(index + 1, f"L{rounds} runs a subprogram so often; write 1 to {MOST_ROUNDS}")
        number = int(match[2])
        if number > 9999:  # on some controls P30101 is O101 three times, on others it is O30101
            raise fail(index + 1, f"P{number} may be a number or how often it is run; write 4 digits, and L")
        self.calls[index] = number, rounds

    def _body(self, index: int, number: int, code: Sequence[str], begins: re.Pattern[str], word: str) -> Body:
        """Where a subprogram stands; refused unless there is one of the number, with its end."""
        found = [
            place
            for place, text in enumerate(code)
            if (match := begins.fullmatch(text)) and int(match[1]) == number
        ]
        name = f"{'O' if word == '98' else 'N'}{number}"
        if not found:
            raise fail(index + 1, f"there is no {name} in this file; no other is read")
        if len(found) > 1:
            raise fail(found[1] + 1, f"{name} stands twice; give each a number of its own")
        first = found[0] + (word == "98")
        for place in range(first, len(code)):
            if place in self.ends:
                return Body(first, place)
            if code[place] == "%" or (word == "98" and place > first and begins.fullmatch(code[place])):
                break
        raise fail(found[0] + 1, f"{name} has no end; write M99")

    def run(self) -> Iterator[tuple[int, str | list[Row]]]:
        """What the machine has to obey, in the order of running."""
        while self.at < len(self.lines):
            index = self.at
            self.at += 1
            line = self.lines[index]
            if index not in self.calls and index not in self.ends:
                yield index, line
                continue
            if comments := COMMENT.findall(line):
                check_comments(index + 1, line)
                yield index, "".join(comments)
            if index in self.ends:
                self._return(index)
            else:
                number, rounds = self.calls[index]
                if len(self._stack) >= DEEPEST:
                    raise fail(index + 1, f"calls are nested more than {DEEPEST} deep")
                self._stack.append([number, rounds, self.at])
                self.at = self._bodies[number].first

    def _return(self, index: int) -> None:
        if not self._stack:
            raise fail(index + 1, "M99 in the main program begins it again, without end; write M30")
        running = self._stack[-1]
        running[1] -= 1
        if running[1]:
            self.at = self._bodies[running[0]].first
            return
        self.at = self._stack.pop()[2]


def _code(line: str) -> str:
    """The words of a line without blanks and comments."""
    return "".join(COMMENT.sub("", line).split())


def uses_calls(lines: Sequence[str]) -> bool:
    """Whether some line calls a subprogram, or ends one.

    >>> uses_calls(["G0 X1", "N20 M98 P101 (mill)"]), uses_calls(["G0 X1 (M98 P101)"]), uses_calls(["M99"])
    (True, False, True)
    """
    return any(
        _CALL.fullmatch(code) or _END.fullmatch(code)
        for code in (_code(line) for line in lines if "M" in line and ("P" in line or "99" in line))
    )
