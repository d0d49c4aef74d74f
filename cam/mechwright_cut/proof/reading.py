"""Reads programs of beams back: every move, and whether the beam is on in it.

A word that is not in the tables below is refused: what the reader does not know, it cannot prove.
"""

import math
import re
from dataclasses import dataclass, field

from mechwright.errors import ProgramError
from mechwright.geometry.segments import Point

_WORD = re.compile(r"([A-Z$])\s*([+-]?(?:\d+\.?\d*|\.\d+))")
_COMMENT = re.compile(r"\([^()]*\)")
IDLE = {17, 21, 40, 49, 54, 64, 80, 90, 91.1, 94}
"""G words that set what the program counts on anyway."""
NEEDED = {17, 21, 90, 94}
"""G words that a program must say before it moves."""
ROUND = 0.005
"""Difference of the radii at both ends of an arc that controls take, mm: the limit of Grbl."""


@dataclass(frozen=True)
class Motion:
    """A move.

    Parameters
    ----------
    line
        Number of its line, from 1.
    rapid
        Whether it is a G0.
    start, end, centre
        mm; the centre of an arc, None of a line.
    turn
        0 of a line, 1 of a counter-clockwise arc, -1 of a clockwise one.
    power
        S of the beam; 0 where it is off.
    """

    line: int
    rapid: bool
    start: Point
    end: Point
    centre: Point | None
    turn: int
    power: float


@dataclass
class Reading:
    """What a program does: moves in order, and places where the beam burns at rest, with their lines."""

    motions: list[Motion] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    ended: bool = False
    off: bool = True
    """Whether the beam is off at the end."""


class _State:
    def __init__(self, grbl: bool) -> None:
        self.grbl = grbl
        self.here: Point = (0.0, 0.0)
        self.motion: int | None = None
        self.spindle, self.s, self.feed = 5, 0.0, 0.0
        self.said: set[float] = set()


def read_beam(text: str, control: str) -> Reading:
    """Read a program of ``grbl-laser`` or ``linuxcnc-beam``; raises ProgramError for what is not known."""
    state, found = _State(control == "grbl-laser"), Reading()
    for number, raw in enumerate(text.splitlines(), start=1):
        line = _COMMENT.sub("", raw).strip()
        if not line or line == "%":
            continue
        if found.ended:
            raise ProgramError(f"line {number}: {raw.strip()!r} stands behind the end of the program")
        words = _WORD.findall(line)
        if re.sub(r"\s", "", _WORD.sub("", line)):
            raise ProgramError(
                f"line {number}: {raw.strip()!r} is not understood; the proof knows plain words"
            )
        _block(number, [(letter, float(value)) for letter, value in words], state, found)
    found.off = state.spindle == 5
    if not found.ended:
        found.faults.append("the program has no M2 or M30 at its end")
    return found


def _block(number: int, words: list[tuple[str, float]], state: _State, found: Reading) -> None:
    values: dict[str, float] = {}
    commands: list[tuple[str, float]] = []
    for letter, value in words:
        if letter in "GM":
            commands.append((letter, value))
        elif letter in "XYIJFSP$":
            if letter in values:
                raise ProgramError(f"line {number}: {letter} stands twice")
            values[letter] = value
        else:
            raise ProgramError(f"line {number}: {letter}{value:g} is not known to the proof")
    if "F" in values:
        state.feed = values["F"]
    if "S" in values:
        state.s = values["S"]
    dwell = False
    for letter, value in commands:
        if letter == "M":
            _switch(number, value, state, found)
        elif value in (0, 1, 2, 3):
            state.motion = int(value)
        elif value == 4:
            dwell = True
        elif value in IDLE:
            state.said.add(value)
        else:
            raise ProgramError(f"line {number}: G{value:g} is not known to the proof")
    if dwell:
        if "X" in values or "Y" in values:
            raise ProgramError(f"line {number}: a dwell does not move")
        return
    if "X" in values or "Y" in values:
        _move(number, values, state, found)
    elif "I" in values or "J" in values:
        raise ProgramError(f"line {number}: an arc without its end is a full circle, and is not written here")


def _switch(number: int, value: float, state: _State, found: Reading) -> None:
    if value in (3, 4, 5):
        state.spindle = int(value)
    elif value in (2, 30):
        found.ended = True
        if state.spindle != 5:
            found.faults.append(f"line {number}: the program ends with the beam on; write M5 before it")
    else:
        raise ProgramError(f"line {number}: M{value:g} is not known to the proof")


def _move(number: int, values: dict[str, float], state: _State, found: Reading) -> None:
    if missing := sorted(NEEDED - state.said):
        said = ", ".join(f"G{word:g}" for word in missing)
        raise ProgramError(f"line {number}: the program moves before it says {said}")
    if state.motion is None:
        raise ProgramError(f"line {number}: a move without G0 to G3")
    start = state.here
    end = values.get("X", start[0]), values.get("Y", start[1])
    rapid, turn = state.motion == 0, {2: -1, 3: 1}.get(state.motion, 0)
    centre = None
    if turn:
        centre = start[0] + values.get("I", 0.0), start[1] + values.get("J", 0.0)
        one, two = math.dist(start, centre), math.dist(end, centre)
        if abs(one - two) > ROUND or one == 0:
            raise ProgramError(f"line {number}: the radii of the arc are {one:.4f} and {two:.4f} mm")
    elif "I" in values or "J" in values:
        raise ProgramError(f"line {number}: I and J belong to an arc")
    lit = state.spindle != 5 and state.s > 0
    if lit and rapid and state.grbl:
        lit = False  # in laser mode G0 has no beam
    if not rapid and state.feed <= 0:
        raise ProgramError(f"line {number}: a move in feed without F")
    found.motions.append(Motion(number, rapid, start, end, centre, turn, state.s if lit else 0.0))
    state.here = end
