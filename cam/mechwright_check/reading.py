"""Derives the moves of a program from its words, and holds the states that they need.

Every mode is set before it is used, the spindle turns while the tool is fed, T, D and H agree, tools are
changed and hands reach in at the machine's upper end only. A place is nan where nothing says it; z is inf,
and TOP in moves, at the machine's upper end.
"""

import math
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright_check import RefutedError, UnknownError
from mechwright_check.words import GAP, ORDER, POINTS, ROWS, WORD, pattern

ACTIVE = re.compile(
    r"\(\s*(debug|print|log|logopen|logappend|logclose|probe\w*|py\w*|abort)\b", re.IGNORECASE
)
TOP, ARC, RETRACT, ROUNDED, WIDEST = 1000.0, 0.0026, 2.003, 0.003, 0.05
"""Radii of an arc agree within ARC, a full retract ends within RETRACT of its place (off the switch), ends of
travel are rounded by ROUNDED, and a control may leave the path by WIDEST."""
MOST, FAR = 1_000_000, 20_000.0
"""Moves of a program, and the furthest place."""
LINE, KIND, START, END, CENTRE, SWEEP = 0, 1, slice(2, 5), slice(5, 8), slice(8, 10), 10
TOOL, RPM, FEED, OFF, FILE, STOPS, COLUMNS = 11, 12, 13, 14, 15, 16, 17
"""Columns of a move: kind is 0 of a rapid and 1 of a feed, OFF how far the control may leave the path."""
Words = dict[str, str]


class Reader:
    """A program of some files on one control, of which the moves are gathered in ``rows``."""

    def __init__(self, control: str, machine: dict[str, Any], tools: dict[int, Any]) -> None:
        if control not in ROWS:
            raise UnknownError(f"no table of words for the control {control!r:.40}")
        self.control, self.machine, self.tools, self.stops = control, machine, tools, 0
        self.table = [(action, pattern(row)) for action, row in ROWS[control]]
        self.klartext = control == "heidenhain-tnc"
        self.rows: list[tuple[float, ...]] = []

    def read(self, text: str, number: int, name: str) -> None:
        """Run one file, of which the machine knows nothing before."""
        self.file, self.number, self.line, self.place = name, number, 0, [math.nan] * 3
        self.motion, self.offset, self.feed, self.scale, self.rpm = "", "", 0.0, 0.0, 0.0
        self.off = self.initial = math.nan
        self.cycle: Words = {}
        self.centre: list[float] = []
        self.coolant: set[str] = set()
        self.tool = self.ready = self.length = self.turn = 0
        self.up = self.by_hand = self.ended = self.incremental = False
        for block in self.blocks(text):
            self.unknown(self.ended and not block.startswith("END PGM"), "words behind the program's end")
            found = ((action, row.fullmatch(block + " ")) for action, row in self.table)
            action, match = next(((action, match) for action, match in found if match), ("", None))
            self.unknown(match is None, f"{block!r:.60} is no block of the table for {self.control}")
            words = (
                {key: value for key, value in match.groupdict().items() if value is not None} if match else {}
            )
            moves = action in {"move", "rapid", "feed", "arc", "helix", "cycle"}
            (self.move if moves else self.obey)(action, words)
        self.wrong(not self.ended, "the program has no end")

    def wrong(self, condition: bool, why: str, kind: type[Exception] = RefutedError) -> None:
        """Refute the program on a condition."""
        if condition:
            raise kind(f"{self.file}{': ' * bool(self.file)}line {self.line}: {why}")

    def unknown(self, condition: bool, why: str) -> None:
        """Say on a condition that nothing can be said."""
        self.wrong(condition, why, UnknownError)

    def blocks(self, text: str) -> Iterator[str]:
        """The words of each line in order, with its number in ``line``."""
        due, joined, grbl = 0, False, self.control == "grbl"
        for self.line, line in enumerate(text.replace("\r\n", "\n").split("\n"), 1):
            obeyed = bool(ACTIVE.search(line) or (grbl and re.search("[?!~]", line)))
            odd = obeyed or len(line) > (80 if grbl else 250) or not line.isprintable()
            self.unknown(odd, "too long, not to be printed, or a comment that the control obeys")
            if self.klartext:
                number = re.match(r"\d+ ", line)
                begins = bool(line) and not joined
                self.unknown(begins and (number is None or int(number[0]) != due), f"block {due} is due")
                due, joined = due + begins, line.endswith("~")
                line = line[number.end() if number else 0 :].partition(";")[0]
                words = re.sub(r"(?<=PGM )\S+", "NAME", line).split()
            else:
                line = re.sub(r'^MSG\("[^"]*"\)$', "", line) if self.control == "siemens-840d" else line
                line = re.sub(r"\([^()]*\)", " ", line.partition(";")[0]).replace(" ", "").upper()
                line = re.sub(r"^N\d{1,8}(?=\D)", "", re.sub(r"^(%|O\d{1,8})$", "", line))
                found = list(WORD.finditer(line))
                self.unknown("".join(word[0] for word in found) != line, f"{line!r:.60} is no block of words")
                for word in found:
                    bare = word[1] in "XYZIJRQF" and "." not in (word[2] or "") and self.control in POINTS
                    bare = bare or (word[1] in "PSTH" and "." in (word[2] or "") and self.control in POINTS)
                    self.unknown(bare, f"{word[0]} without a decimal point, or with one")
                words = [f"{w[1]}{float(w[2]):g}" if w[1] in "GM" and w[2] else w[0] for w in found]
                words.sort(key=_order)
            if words:
                yield " ".join(words)

    def obey(self, action: str, words: Words) -> None:
        """Do what a block says that makes no move in the work."""
        number = int(float(words.get("T", words.get("N", self.ready))))
        match action:
            case "modes":
                self.scale = 25.4 if words["units"] in {"G20", "G700", "INCH"} else 1.0
                self.motion, self.cycle, self.incremental, self.length = "", {}, False, 0
            case "offset" | "preset" | "start":
                offset = f"G{53 + number}" if action == "preset" else words.get("offset", self.offset)
                self.wrong(offset != (self.machine["work_offset"] or offset), f"{offset} is not the job's")
                self.unknown(self.offset not in {"", offset}, "another work offset")
                self.offset = offset
                if action == "start":
                    self.rpm, self.turn = float(words.get("S", self.rpm)), 1 if words["turn"] == "M3" else -1
                    self.wrong(
                        not self.up or not self.tool, "the spindle starts with the tool down, or without one"
                    )
                    self.wrong(self.by_hand, f"T{self.tool} is put in by hand, and no M0 is there for it")
            case "corners":
                self.off = float(words.get("P", words.get("T", "0"))) * (self.scale or 1.0)
                loose = (
                    self.off > WIDEST or float(words.get("Q", "0")) != 0 or (self.off == 0 and self.klartext)
                )
                self.wrong(loose, f"the control may leave the path by more than {WIDEST} mm")
            case "stop":
                self.wrong(not self.place[2] > 0.2, "the spindle stops in the stock")
                self.turn = 0
            case "coolant":
                kind = {"M7": {"mist"}, "M8": {"flood"}}.get(words["coolant"])
                self.coolant = self.coolant | kind if kind else set()
            case "pause" | "end":
                busy = bool(self.turn or not self.up or self.coolant)
                self.wrong(busy, "stops with the spindle turning, coolant running or the tool down")
                self.stops += words.get("stop") == "M0" and not self.by_hand
                self.by_hand = self.by_hand and words.get("stop") != "M0"
                self.length, self.ended = self.length if self.klartext else 0, action == "end"
            case "absolute":
                self.incremental = False
            case "cancel":
                self.cycle, self.motion = {}, ""
            case "centre":
                self.centre = [float(words[letter]) * self.scale for letter in "XY"]
            case "ready" | "change":
                self.wrong(number not in self.tools, f"T{number} is no tool of the job")
                self.ready = number
                if action == "change":
                    self.wrong(
                        bool(self.turn) or not self.up, "changes the tool with the spindle turning, or down"
                    )
                    self.by_hand = self.control == "grbl" and self.tool not in {0, number}
                    self.tool, self.cycle, self.length = number, {}, number if self.klartext else 0
                    self.rpm = float(words.get("S", self.rpm))
            case "length" | "touched":
                named = int(float(words.get("H", self.tool if float(words.get("D", "1")) == 1 else 0)))
                self.wrong(
                    not self.tool or named != self.tool, f"the length of another tool than T{self.tool}"
                )
                self.length = self.tool
                if action == "length" and self.control != "grbl":
                    self.unknown(self.motion != "G0", "a length that takes effect in a feed move")
                    self.move("move", {"Z": words["Z"]})
            case "machine" | "home":
                self.machine_move(words, home=action == "home")

    def machine_move(self, words: Words, home: bool) -> None:
        """A rapid in machine coordinates, or to the reference of Z."""
        odd = (
            self.cycle
            or not self.scale
            or float(words.get("D", "0")) != 0
            or (home and float(words["Z"]) != 0)
        )
        self.unknown(
            bool(odd), "machine coordinates in a cycle, before the units, or by way of another place"
        )
        for axis, letter in enumerate("XYZ") if not home else ():
            if letter in words:
                value, (low, high) = float(words[letter]) * self.scale, self.machine[letter.lower()]
                low = max(low, self.machine["retract"] - RETRACT) if letter == "Z" else low
                inside = low - ROUNDED <= value <= high + ROUNDED
                self.wrong(not inside, f"machine {letter}{value:g} is not within {low:g} to {high:g}")
                self.wrong(letter != "Z" and not self.up, "moves in machine coordinates with the tool down")
                self.place[axis] = self.place[axis] if letter == "Z" else math.nan
        if "Z" in words:
            if not self.up and not math.isnan(sum(self.place)):
                self.add(False, [*self.place[:2], TOP])
            self.up, self.place = True, [*self.place[:2], math.inf]
        self.motion, self.incremental = ("", True) if home else ("G0", self.incremental)
        self.length = 0 if home else self.length

    def move(self, action: str, words: Words) -> None:
        """A move in work coordinates."""
        self.stated(self.length == self.tool or not {"Z", "IZ", "cycle"} & set(words) or bool(self.cycle))
        if self.cycle or action == "cycle":
            self.unknown(action != "cycle" and not set(words) <= {"X", "Y"}, "more than a place in a cycle")
            self.hole(words)
            return
        self.motion = {"rapid": "G0", "feed": "G1"}.get(action, words.pop("motion", self.motion))
        if "turn" in words:
            self.motion = "G3" if words["turn"] == "DR+" else "G2"
        straight, letters = self.motion in {"G0", "G1"}, set(words)
        self.wrong(not self.motion, "moves without a motion word")
        odd = letters & ({"I", "J", "F"} if self.motion == "G0" else {"I", "J"} if straight else set())
        self.unknown(bool(odd), "words that have no place in a straight move, or a feed in a rapid")
        end = [
            float(words[a]) * self.scale if a in words else b for a, b in zip("XYZ", self.place, strict=True)
        ]
        if "F" in words:
            self.feed = float(words["F"]) * self.scale / (10 if self.klartext and self.scale > 1 else 1)
        if straight:
            if {"X", "Y", "Z"} & letters:
                self.add(self.motion == "G1", end)
            return
        self.unknown(math.isnan(sum(self.place)), "an arc from a place that is not known")
        if action == "move":
            self.unknown(not {"I", "J"} <= letters or not {"X", "Y"} & letters, "an arc without a word")
            self.centre = [self.place[n] + float(words[letter]) * self.scale for n, letter in enumerate("IJ")]
        self.unknown(not self.centre, "an arc without a centre")
        way, (a, b) = 1 if self.motion == "G3" else -1, self.centre
        x, y = self.place[0] - a, self.place[1] - b
        if action == "helix":
            turn = math.radians(float(words["IPA"]))
            self.unknown(not 0 < turn * way < math.tau + 1e-9, "an angle that is no turn, or more than one")
            c, s = math.cos(turn), math.sin(turn)
            end = [a + c * x - s * y, b + s * x + c * y, self.place[2] + float(words["IZ"]) * self.scale]
        else:
            turn = way * ((way * (math.atan2(end[1] - b, end[0] - a) - math.atan2(y, x))) % math.tau)
            turn = way * math.tau if end[:2] == self.place[:2] else turn
        apart = abs(math.hypot(x, y) - math.dist(end[:2], self.centre))
        self.wrong(apart > ARC or math.hypot(x, y) < ARC, "the radii of an arc differ at its ends")
        self.add(True, end, (a, b, turn))

    def stated(self, length: bool) -> None:
        """Refute the program if something is not stated that every move needs."""
        self.wrong(not length, f"a height without the length of T{self.tool}")
        stated = self.scale and self.offset and self.tool and not self.incremental
        self.wrong(not stated, "moves before units, work offset, G90 and a tool are stated")

    def hole(self, words: Words) -> None:
        """One hole of a cycle: over it, down to R, in to Z, and back to the height where the cycle began."""
        if "cycle" in words:
            self.initial, self.cycle = self.initial if self.cycle else self.place[2], words
            self.feed = float(words["F"]) * self.scale if "F" in words else self.feed
        size, clear = self.scale, [math.nan, math.nan, self.initial]
        x, y = (float(words[a]) * size if a in words else b for a, b in zip("XY", self.place, strict=False))
        bottom, plane, step = (float(self.cycle.get(letter, "inf")) * size for letter in "ZRQ")
        self.stated(self.length == self.tool)
        self.wrong(not bottom < plane <= self.initial < TOP, "R below the bottom, or above the cycle's start")
        self.unknown(not (plane - bottom) / 1000 < step, "more than 1000 pecks")
        clear, depth = [x, y, self.initial], plane - step
        self.add(False, clear)
        self.add(False, [x, y, plane])
        while depth > bottom:
            self.add(True, [x, y, depth])
            if self.cycle["cycle"] == "G83":
                self.add(False, [x, y, plane])
            self.add(False, [x, y, depth + GAP.get(self.control, 0.254)])
            depth -= step
        self.add(True, [x, y, bottom])
        self.add(False, clear)

    def add(self, fed: bool, end: list[float], arc: tuple[float, ...] = (0.0, 0.0, 0.0)) -> None:
        """A motion from the present place."""
        start, self.place = self.place, end
        if math.isinf(end[2]) and not fed:
            return
        if fed:
            planned = self.tools[self.tool].raw.get("coolant")
            self.wrong(
                not (self.turn and self.rpm > 0 and self.feed > 0), "cuts without a turning spindle or a feed"
            )
            self.wrong(
                planned is not None and (self.coolant or {"off"}) != {planned}, f"coolant is not {planned}"
            )
            loose = math.isnan(self.off) and self.control in {"linuxcnc", "heidenhain-tnc"}
            self.unknown(loose, "cuts before the program says how far the control may leave the path")
        start = [*start[:2], TOP] if math.isinf(start[2]) else start
        self.up = self.up and end[2] >= TOP
        self.wrong(
            math.isnan(sum(start) + sum(end)), "moves from or to a place that the program does not say"
        )
        self.unknown(
            max(map(abs, end)) > FAR or len(self.rows) >= MOST, "a place beyond 20 m, or too many moves"
        )
        if start != end or arc[2]:
            state = (self.tool, self.rpm * self.turn, self.feed * fed, self.off, self.number, self.stops)
            self.rows.append((self.line, fed, *start, *end, *arc, *state))


def read(control: str, texts: dict[str, str], machine: dict[str, Any], tools: dict[int, Any]) -> np.ndarray:
    """The moves (n, COLUMNS) that the words of a program's files give, run in their order."""
    reader = Reader(control, machine, tools)
    for number, (name, text) in enumerate(texts.items()):
        reader.read(text, number, name if len(texts) > 1 else "")
    moves = np.array(reader.rows, dtype=np.float64).reshape(-1, COLUMNS)
    if not (moves[:, KIND] == 1).any():
        raise RefutedError("the program cuts nothing")
    return moves


def _order(word: str) -> tuple[int, float]:
    """Where a word stands in a row."""
    letter = word if word in ORDER else word[0]
    return ORDER.index(letter) if letter in ORDER else len(ORDER), float(word[1:]) if letter == "G" else 0.0
