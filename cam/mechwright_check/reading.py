"""Derives the moves of a program from its words, and holds the states that they need.

Every mode is set before it is used, the spindle turns while the tool is fed, T, D and H agree, tools are changed
and hands reach in at the machine's upper end only. Places are those of the work offset, mm; z is inf at the
machine's upper end and nan where nothing says it.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mechwright_check import Refuted, Unknown, at
from mechwright_check.words import DIALECTS, ORDER, WORD

ACTIVE = re.compile(r"\(\s*(debug|print|log|logopen|logappend|logclose|probe\w*|py\w*|abort)\b", re.IGNORECASE)
COMMENT = re.compile(r"\([^()]*\)")
ARC = 0.003
"""Radii at both ends of an arc agree within so much, mm."""
RETRACT = 2.003
"""A full retract may end so far below the place that the machine's file says, mm: off the switch, on Grbl."""
MOST = 2_000_000
"""Moves of a program."""


@dataclass
class Moves:
    """What a program does, a row for each motion that goes anywhere."""

    rows: list[tuple[float, ...]] = field(default_factory=list)
    """Line, kind (0 rapid, 1 feed), start, end, centre, sweep, T, rev/min, mm/min, D of corners, file, stops."""
    ended: bool = False

    def array(self) -> np.ndarray:
        """(n, 17) float."""
        return np.array(self.rows, dtype=np.float64).reshape(-1, 17)


class Reader:
    """One program on one control."""

    def __init__(self, control: str, machine: dict[str, Any], tools: dict[int, Any]) -> None:
        if control not in DIALECTS:
            raise Unknown(f"no table of words for the control {control!r:.40}")
        self.control, self.dialect, self.machine, self.tools = control, DIALECTS[control], machine, tools
        self.moves, self.stops = Moves(), 0

    def read(self, text: str, number: int, name: str) -> None:
        """Run one file; files follow each other with the machine as the one before has left it."""
        self.file, self.number, self.line = name, number, 0
        self.place = [math.nan, math.nan, math.nan]
        self.motion, self.feed, self.scale, self.cycle = "", 0.0, 0.0, None
        self.tool = self.selected = self.length = self.turn = 0
        self.rpm, self.off, self.offset, self.centre, self.incremental = 0.0, math.nan, "", None, False
        self.up = self.by_hand = self.waited = self.wet = False
        self.moves.ended = False
        for self.line, block in self._blocks(text):
            if self.moves.ended and not block.startswith("END PGM"):
                self._unknown("words behind the program's end")
            for action, expression in self.dialect.table:
                found = expression.fullmatch(block + " ")
                if found:
                    words = {key: value for key, value in found.groupdict().items() if value is not None}
                    getattr(self, "_" + action)(words)
                    break
            else:
                self._unknown(f"{block!r:.60} is no block of the table for {self.control}")
        if not self.moves.ended:
            self._wrong("the program has no end")

    def _wrong(self, why: str) -> None:
        raise Refuted(at(self.line, self.file) + why)

    def _unknown(self, why: str) -> None:
        raise Unknown(at(self.line, self.file) + why)

    def _blocks(self, text: str) -> Iterator[tuple[int, str]]:
        """Number of each line with anything in it, and its words in order."""
        for self.line, line in enumerate(text.replace("\r\n", "\n").split("\n"), 1):
            if len(line) > self.dialect.longest or not line.isprintable():
                self._unknown(f"more than {self.dialect.longest} characters, or one that cannot be printed")
            if ACTIVE.search(line) or (self.control == "grbl" and re.search("[?!~]", line)):
                self._unknown("a comment that the control obeys")
            if self.dialect.klartext:
                block = re.sub(r"^\d+ ", "", line).partition(";")[0].split()
                block = ["PGM", "NAME"] if block[:1] == ["PGM"] else block
                if block[1:2] == ["PGM"] and len(block) == 4:
                    block[2] = "NAME"
                if block:
                    yield self.line, " ".join(block)
                continue
            words = re.sub(r'^MSG\("[^"]*"\)$', "", line) if self.control == "siemens-840d" else line
            words = COMMENT.sub(" ", words.partition(";")[0]).replace(" ", "").upper()
            words = "" if words == "%" or re.fullmatch(r"O\d{1,8}", words) else words
            words = re.sub(r"^N\d{1,8}(?=\D)", "", words)
            found = list(WORD.finditer(words))
            if "".join(match[0] for match in found) != words:
                self._unknown(f"{words!r:.60} is no block of words")
            if words:
                yield self.line, " ".join(sorted(map(self._spelled, found), key=_order))

    def _spelled(self, word: re.Match[str]) -> str:
        letter, number = word[1], word[2]
        if number is None:
            return letter
        if letter in "GM":
            return letter + f"{float(number):g}"
        if self.dialect.point and letter in "XYZIJRQF" and "." not in number:
            self._unknown(f"{letter}{number} without a decimal point")
        return letter + number

    # What the rows of the tables do.

    def _nothing(self, words: dict[str, str]) -> None:
        pass

    def _modes(self, words: dict[str, str]) -> None:
        self.scale = 25.4 if words["units"] in {"G20", "G700", "INCH"} else 1.0
        if not self.dialect.klartext:
            self.motion, self.cycle, self.length, self.incremental = "", None, 0, False

    def _preset(self, words: dict[str, str]) -> None:
        self.offset = f"G{53 + int(float(words['N']))}"

    def _corners(self, words: dict[str, str]) -> None:
        self.off = float(words.get("P", words.get("T", "0"))) * (self.scale or 1.0)
        if self.off > 0.05 or float(words.get("Q", "0")):
            self._wrong("the control may leave the path by more than 0.05 mm")

    def _offset(self, words: dict[str, str]) -> None:
        self.offset = words["offset"]

    def _start(self, words: dict[str, str]) -> None:
        self.offset = words.get("offset", self.offset)
        self.rpm, self.turn = float(words.get("S", self.rpm)), 1 if words["turn"] == "M3" else -1
        if not (self.up and self.tool):
            self._wrong("the spindle is started with the tool down, or without one")
        if self.by_hand:
            self._wrong(f"T{self.tool} is put in by hand, and the program does not stop for it")

    def _stop(self, words: dict[str, str]) -> None:
        self.turn = 0

    def _coolant(self, words: dict[str, str]) -> None:
        self.wet = words["coolant"] != "M9"

    def _pause(self, words: dict[str, str]) -> None:
        if self.turn or not self.up or self.wet:
            self._wrong("stops for hands with the spindle turning, coolant running or the tool down")
        self.stops += not self.by_hand
        self.by_hand = False
        self.length = 0 if self.control == "grbl" else self.length

    def _end(self, words: dict[str, str]) -> None:
        if self.turn or not self.up:
            self._wrong("the program ends with the spindle turning or the tool down")
        self.moves.ended = True

    def _ready(self, words: dict[str, str]) -> None:
        number = int(float(words.get("T", words.get("N", "0"))))
        if number and number not in self.tools:
            self._wrong(f"T{number} is no tool of the job")

    def _select(self, words: dict[str, str]) -> None:
        self._ready(words)
        self.selected = int(float(words["T"]))

    def _change(self, words: dict[str, str]) -> None:
        number = int(float(words.get("T", words.get("N", self.selected))))
        if number not in self.tools:
            self._wrong(f"T{number} is no tool of the job")
        if self.turn or not self.up:
            self._wrong("a tool is changed with the spindle turning, or below the machine's upper end")
        self.by_hand = self.control == "grbl" and self.tool not in {0, number}
        self.tool, self.length, self.cycle = number, 0, None

    def _call(self, words: dict[str, str]) -> None:
        self._change(words)
        self.length, self.rpm = self.tool, float(words["S"])

    def _machine(self, words: dict[str, str]) -> None:
        if self.cycle or float(words.get("D", "0")) or not self.scale:
            self._unknown("a move in machine coordinates within a cycle, with an offset, or before the units")
        for axis, letter in enumerate("XYZ"):
            if letter in words:
                value, (low, high) = float(words[letter]) * self.scale, self.machine[letter.lower()]
                if not low - 0.003 <= value <= high + 0.003:
                    self._wrong(f"goes to machine {letter}{value:g}, which travels from {low:g} to {high:g}")
                if letter == "Z" and value < self.machine["retract"] - RETRACT:
                    self._wrong(f"machine Z{value:g} is no full retract")
                if letter != "Z" and not self.up:
                    self._wrong("moves in machine coordinates with the tool down")
                self.place[axis] = math.nan
        if "Z" in words:
            self._to_top()
        self.motion = "G0"

    def _home(self, words: dict[str, str]) -> None:
        if float(words["Z"]) or self.cycle or not self.scale:
            self._unknown("a reference point by way of another place")
        self._to_top()
        self.motion, self.incremental = "", True

    def _absolute(self, words: dict[str, str]) -> None:
        self.incremental = False

    def _to_top(self) -> None:
        x, y, z = self.place
        if not math.isnan(x + y + z) and not self.up:
            self._add(0, (x, y, 1000.0))
        self.up, self.place[2] = True, math.inf

    def _length(self, words: dict[str, str]) -> None:
        number = int(float(words.get("H", self.tool if float(words.get("D", "0")) == 1 else 0)))
        if number != self.tool or not number:
            self._wrong(f"the length of another tool than T{self.tool}")
        self._with_length(words)

    _measured = _length

    def _with_length(self, words: dict[str, str]) -> None:
        self.length = self.tool
        if self.motion != "G0":
            self._unknown("a length that takes effect within a feed move")
        self._move({"Z": words["Z"]})

    def _touched(self, words: dict[str, str]) -> None:
        self.length = self.tool

    def _dwell(self, words: dict[str, str]) -> None:
        pass

    def _cancel(self, words: dict[str, str]) -> None:
        self.cycle, self.motion = None, ""

    def _rapid(self, words: dict[str, str]) -> None:
        self._move({**words, "motion": "G0"})

    def _feed(self, words: dict[str, str]) -> None:
        self._move({**words, "motion": "G1"})

    def _centre(self, words: dict[str, str]) -> None:
        self.centre = [float(words[letter]) * self.scale for letter in "XY"]

    def _arc(self, words: dict[str, str]) -> None:
        if self.centre is None or math.isnan(sum(self.place)):
            self._wrong("an arc without a centre, or from an unknown place")
        middle = {letter: str((self.centre[n] - self.place[n]) / self.scale) for n, letter in enumerate("IJ")}
        self._move({**words, **middle, "motion": "G3" if words["turn"] == "DR+" else "G2"})

    def _helix(self, words: dict[str, str]) -> None:
        angle, rise = math.radians(float(words["IPA"])), float(words["IZ"]) * self.scale
        if self.centre is None or math.isnan(sum(self.place)):
            self._wrong("an arc without a centre, or from an unknown place")
        if angle * (1 if words["turn"] == "DR+" else -1) <= 0 or abs(angle) > math.tau + 1e-9:
            self._unknown("an angle against its direction, or of more than a turn")
        x, y = self.place[0] - self.centre[0], self.place[1] - self.centre[1]
        c, s = math.cos(angle), math.sin(angle)
        end = (self.centre[0] + c * x - s * y, self.centre[1] + s * x + c * y, self.place[2] + rise)
        self._fed(words)
        self._add(1, end, (*self.centre, angle))

    def _fed(self, words: dict[str, str]) -> None:
        """The feed of a move, and what it needs besides."""
        self.feed = float(words.get("F", self.feed / (self.scale or 1))) * self.scale
        if self.dialect.klartext and self.scale != 1.0 and "F" in words:
            self.feed /= 10
        if not (self.turn and self.rpm > 0 and self.feed > 0):
            self._wrong("cuts without a turning spindle or a feed")
        if math.isnan(self.off) and self.control in {"linuxcnc", "heidenhain-tnc"}:
            self._unknown("cuts before the program says how far the control may leave the path")

    def _move(self, words: dict[str, str]) -> None:
        if self.cycle is not None:
            if set(words) <= {"X", "Y"}:
                self._hole(words)
                return
            self._unknown("other words than a place while a cycle is in force; write G80")
        self.motion = words.get("motion", self.motion)
        if not self.scale or not self.offset or self.incremental or not self.motion or not self.tool:
            self._wrong("moves before units, work offset, G90, a motion word and a tool are stated")
        if set(words) <= {"motion", "F"}:
            self.feed = float(words["F"]) * self.scale if "F" in words else self.feed
            return
        end = list(self.place)
        for axis, letter in enumerate("XYZ"):
            if letter in words:
                end[axis] = float(words[letter]) * self.scale
        if "Z" in words and self.length != self.tool:
            self._wrong(f"a height before the length of T{self.tool} is in force")
        if self.motion in {"G0", "G1"} and {"I", "J"} & set(words) or self.motion == "G0" and "F" in words:
            self._unknown("a centre in a straight move, or a feed in a rapid one")
        if self.motion == "G0":
            self._add(0, end)
            return
        self._fed(words)
        if self.motion == "G1":
            self._add(1, end)
            return
        if not {"I", "J"} <= set(words) or math.isnan(sum(self.place)):
            self._unknown("an arc without both I and J, or from an unknown place")
        i, j = float(words["I"]) * self.scale, float(words["J"]) * self.scale
        x, y = self.place[0] + i, self.place[1] + j
        if abs(math.hypot(i, j) - math.dist(end[:2], (x, y))) > ARC or math.hypot(i, j) < 0.002:
            self._wrong("the radii of an arc differ at its ends")
        turn = math.atan2(end[1] - y, end[0] - x) - math.atan2(-j, -i)
        turn = turn % math.tau if self.motion == "G3" else -(-turn % math.tau)
        if end[:2] == self.place[:2]:
            turn = math.tau if self.motion == "G3" else -math.tau
        self._add(1, end, (x, y, turn))

    def _cycle(self, words: dict[str, str]) -> None:
        self.cycle, self.initial = words, self.place[2]
        self._hole(words)

    def _hole(self, words: dict[str, str]) -> None:
        """One hole of the cycle in force: over it, down to R, in to Z, and back to where the cycle began."""
        said, size = self.cycle, self.scale
        x, y = (float(words.get(a, "nan")) * size for a in "XY")
        x, y = self.place[0] if math.isnan(x) else x, self.place[1] if math.isnan(y) else y
        bottom, plane = float(said["Z"]) * size, float(said["R"]) * size
        if math.isnan(x + y + self.initial) or math.isinf(self.initial) or not bottom < plane <= self.initial:
            self._wrong("a cycle from an unknown place, or with R below its bottom or above its start")
        if self.incremental or self.length != self.tool or not self.offset:
            self._wrong("a cycle without G90, a work offset or the length of its tool")
        self._fed(said if words is said else {})
        self._add(0, (x, y, self.initial))
        self._add(0, (x, y, plane))
        step = float(said.get("Q", "inf")) * size
        if not step > 0 or (plane - bottom) / step > 1000:
            self._unknown("pecks of nothing, or more than 1000")
        depth = plane - step
        while depth > bottom:
            self._add(1, (x, y, depth))
            if said["cycle"] == "G83":
                self._add(0, (x, y, plane))
            self._add(0, (x, y, depth + self.dialect.gap))
            depth -= step
        self._add(1, (x, y, bottom))
        self._add(0, (x, y, self.initial))

    def _add(self, kind: int, end: Any, arc: tuple[float, ...] = (0.0, 0.0, 0.0)) -> None:
        """A motion from the present place."""
        start, self.place = self.place, list(end)
        self.up = self.up and math.isinf(end[2])
        if math.isinf(start[2]) and not math.isinf(end[2]):
            start = [*start[:2], 1000.0]
        if math.isnan(sum(end)) or math.isinf(end[2]):
            if kind or not math.isinf(end[2]):
                self._wrong("moves from or to a place that the program does not say")
            return
        if math.isnan(sum(start)):
            self._wrong("moves from a place that the program does not say")
        if max(map(abs, end)) > 20_000 or len(self.moves.rows) >= MOST:
            self._unknown("a place beyond 20 m, or too many moves")
        if start != list(end) or arc[2]:
            state = (self.tool, self.rpm * self.turn, self.feed if kind else 0.0, self.off)
            self.moves.rows.append((self.line, kind, *start, *end, *arc, *state, self.number, self.stops))


def _order(word: str) -> tuple[int, float]:
    """Where a word stands in a row."""
    letter = re.match("[A-Z]+", word)[0]
    return ORDER.index(letter) if letter in ORDER else len(ORDER), float(word[1:]) if letter == "G" else 0.0
