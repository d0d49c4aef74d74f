"""Reads programs of wires back: where the wire is threaded, and passes with their side and D."""

import math
import re
from dataclasses import dataclass, field

from mechwright.errors import ProgramError
from mechwright.geometry.segments import Point
from mechwright_cut.proof.reading import ROUND, Motion

_WORD = re.compile(r"([A-Z])\s*([+-]?(?:\d+\.?\d*|\.\d+))")
_COMMENT = re.compile(r"\([^()]*\)")


@dataclass
class WireRun:
    """Moves with one offset: from where it is put on to where it is taken off.

    ``side`` is 1 with the wire on the left of its way, -1 on its right; ``held`` says whether the program
    stopped before it, so that somebody holds what falls.
    """

    line: int
    side: int
    register: int
    held: bool
    motions: list[Motion] = field(default_factory=list)


@dataclass
class Threaded:
    """What is done with the wire through one start hole."""

    line: int
    hole: Point
    runs: list[WireRun] = field(default_factory=list)


@dataclass
class WireReading:
    """What a program does."""

    holes: list[Threaded] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


class _Wire:
    def __init__(self) -> None:
        self.found = WireReading()
        self.here: Point | None = None
        self.motion: int | None = None
        self.said: set[int] = set()
        self.threaded = False
        self.ended = False
        self.stopped = False
        self.run: WireRun | None = None

    def block(self, number: int, raw: str, words: list[tuple[str, float]]) -> None:
        values = {letter: value for letter, value in words if letter not in "GM"}
        if len(values) + sum(letter in "GM" for letter, _ in words) != len(words):
            raise ProgramError(f"line {number}: {raw!r} says a word twice")
        if unknown := set(values) - set("XYIJD"):
            raise ProgramError(f"line {number}: {min(unknown)} is not known to the proof")
        off = self._words(number, words, values)
        if self.motion == 92:
            self.here, self.motion = (values["X"], values["Y"]), None
        elif "X" in values or "Y" in values:
            self._move(number, values, off)
        elif off:
            raise ProgramError(f"line {number}: G40 without a move")

    def _words(self, number: int, words: list[tuple[str, float]], values: dict[str, float]) -> bool:
        off = False
        for letter, value in words:
            if letter == "M":
                self._switch(number, int(value))
            elif letter == "G" and value in (0, 1, 2, 3):
                self.motion = int(value)
            elif letter == "G" and value in (90, 21):
                self.said.add(int(value))
            elif letter == "G" and value == 92:
                if self.here is not None or not {"X", "Y"} <= values.keys():
                    raise ProgramError(f"line {number}: G92 stands once, before all moves, with X and Y")
                self.motion = 92
            elif letter == "G" and value in (41, 42):
                if "D" not in values:
                    raise ProgramError(f"line {number}: G{value:g} without D")
                if self.run is not None:
                    raise ProgramError(f"line {number}: G{value:g} while an offset is on; write G40 before")
                self.run = WireRun(number, 1 if value == 41 else -1, int(values["D"]), self.stopped)
                self.stopped = False
            elif letter == "G" and value == 40:
                off = True
            elif letter == "G":
                raise ProgramError(f"line {number}: G{value:g} is not known to the proof")
        return off

    def _switch(self, number: int, value: int) -> None:
        if value == 60:
            if self.threaded or self.here is None:
                raise ProgramError(f"line {number}: M60 where the wire is in, or before the first hole")
            self.threaded = True
            self.found.holes.append(Threaded(number, self.here))
        elif value == 50:
            if not self.threaded or self.run is not None:
                self.found.faults.append(f"line {number}: M50 without a wire, or with an offset on")
            self.threaded = False
        elif value in (0, 1):
            self.stopped = True
        elif value in (2, 30):
            self.ended = True
            if self.threaded:
                self.found.faults.append(
                    f"line {number}: the program ends with the wire in; write M50 before"
                )
        else:
            raise ProgramError(f"line {number}: M{value} is not known to the proof")

    def _move(self, number: int, values: dict[str, float], off: bool) -> None:
        if not {90, 21} <= self.said:
            raise ProgramError(f"line {number}: the program moves before it says G90 and G21")
        if self.here is None or self.motion is None:
            raise ProgramError(f"line {number}: a move before G92, or without G0 to G3")
        start, end = self.here, (values.get("X", self.here[0]), values.get("Y", self.here[1]))
        turn = {2: -1, 3: 1}.get(self.motion, 0)
        centre = None
        if turn:
            centre = start[0] + values.get("I", 0.0), start[1] + values.get("J", 0.0)
            one, two = math.dist(start, centre), math.dist(end, centre)
            if abs(one - two) > ROUND or one == 0:
                raise ProgramError(f"line {number}: the radii of the arc are {one:.4f} and {two:.4f} mm")
        if self.motion == 0 and self.threaded:
            self.found.faults.append(f"line {number}: a rapid with the wire in")
        if self.motion != 0 and not self.threaded:
            self.found.faults.append(f"line {number}: a cut without a wire")
        motion = Motion(number, self.motion == 0, start, end, centre, turn, 1.0)
        if self.run is not None:
            first = not self.run.motions
            if (first or off) and self.motion != 1:
                raise ProgramError(f"line {number}: an offset is put on and taken off on G1 alone")
            self.run.motions.append(motion)
            if off:
                if self.found.holes:
                    self.found.holes[-1].runs.append(self.run)
                self.run = None
        elif self.motion != 0:
            self.found.faults.append(f"line {number}: a cut without an offset")
        self.here = end


def read_wire(text: str) -> WireReading:
    """Read a program of a wire; raises ProgramError for what is not known."""
    state = _Wire()
    for number, raw in enumerate(text.splitlines(), start=1):
        line = _COMMENT.sub("", raw).strip()
        if not line or line == "%":
            continue
        if state.ended:
            raise ProgramError(f"line {number}: {raw.strip()!r} stands behind the end of the program")
        if re.sub(r"\s", "", _WORD.sub("", line)):
            raise ProgramError(f"line {number}: {raw.strip()!r} is not understood; write plain words")
        state.block(number, line, [(letter, float(value)) for letter, value in _WORD.findall(line)])
    if not state.ended:
        state.found.faults.append("the program has no M2 or M30 at its end")
    return state.found
