"""Program text under way, with what the control remembers."""

import math

from mechwright.tolerances import TOLERANCES
from mechwright_cam.program.moves import Feed, FeedArc, Program, ToolSection
from mechwright_cam.shop.tool import Tool
from mechwright_plane.path import NOISE
from mechwright_plane.text import floored, number

HIGHEST_NUMBER = 99999
"""The largest N number that all controls take."""
AGREEING = TOLERANCES.arc_fit / 4
"""Radii at both ends of an arc that agree so well need no better centre, mm."""


class Writer:
    """Program text under way, with what the control remembers.

    Positions are exact as planned (``x``, ``y``, ``z``) and, in the text, rounded to so many ``decimals`` of
    a unit that is ``scale`` mm long; a centre is written from the rounded start, so that rounding never adds
    up. NaN stands for a position the text has not stated. With ``point`` every length and feed has a decimal
    point.
    """

    def __init__(self, program: Program, decimals: int, point: bool, scale: float = 1.0) -> None:
        self.program = program
        self.decimals, self.point, self.scale = decimals, point, scale
        self.lines: list[str] = []
        self.x = self.y = self.z = math.nan
        self.height_text = ""
        self.motion = ""
        self.feed = ""
        self._last_feed = math.nan
        self.tool = 0
        self.resumed: ToolSection | None = None
        self.cycle: tuple[str, ...] = ()
        self.tapping: Tool
        self.speed = ""
        self.staged = 0
        self.offset = program.work_offset
        """The work offset that the next section begins in."""
        self.subprograms: list[list[str]] = []
        """The lines of each subprogram so far."""
        """The tool that the next change takes, where it is to be made ready ahead; 0 for none."""
        self.corners: list[str] = []
        # By identity: the program holds its moves as long as it is written.
        self._ends: dict[tuple[int, float, float], str] = {}
        self._arcs: dict[tuple[int, float, float], tuple[str, str, bool]] = {}

    def line(self, *words: str) -> None:
        """Write a line of these words; empty ones are left out."""
        text = " ".join(filter(None, words))
        if text:
            self.lines.append(text)

    def length(self, value: float) -> str:
        """A coordinate or another length, mm."""
        return number(value / self.scale, self.decimals, self.point)

    def height(self, value: float, *, up: bool = False) -> str:
        """A height, mm: never above the planned one by rounding, so that through cuts go through.

        With ``up`` never below it, so that rapids keep their height.
        """
        value /= self.scale
        down = -floored(-value, self.decimals) if up else floored(value, self.decimals)
        return number(down, self.decimals, self.point)

    def rounded(self, value: float) -> float:
        """A coordinate as the control will read it."""
        return round(value / self.scale, self.decimals) * self.scale

    def motion_word(self, word: str) -> str:
        """The motion code if it is not in force already."""
        if self.motion == word:
            return ""
        self.motion = word
        return word

    def feed_word(self, feed: float) -> str:
        """The feed if it is not in force already."""
        if feed == self._last_feed and self.feed:
            return ""
        self._last_feed = feed
        word = self.feed_text(feed)
        if self.feed == word:
            return ""
        self.feed = word
        return word

    def pitch(self, value: float) -> str:
        """A pitch, mm: to more decimals than a place, as it adds up over all turns."""
        return number(value / self.scale, 6, self.point)

    def feed_text(self, feed: float, *, exact: bool = False) -> str:
        """A feed, mm/min: to a tenth of a millimetre or a hundredth of an inch a minute.

        An ``exact`` one, of a tap, has two decimals more.
        """
        if exact:
            return "F" + number(feed / self.scale, 3 if self.scale == 1.0 else 4, self.point)
        if self.scale == 1.0:
            return "F" + number(feed, 1, self.point)
        return "F" + number(floored(feed / self.scale, 2), 2, self.point)  # a limit may be no round number

    def axis_words(
        self, x: float | None, y: float | None, z: float | None, *, rapid: bool = False
    ) -> list[str]:
        """The coordinates that change in the text, and keep them all in mind."""
        # A position that the text does not state is NaN: its text equals none that is written.
        words = []
        if x is not None and x != self.x:
            if (text := self.length(x)) != self.length(self.x):
                words.append("X" + text)
            self.x = x
        if y is not None and y != self.y:
            if (text := self.length(y)) != self.length(self.y):
                words.append("Y" + text)
            self.y = y
        if z is not None:
            text = self.height(z, up=rapid)
            if math.isnan(self.z) or (text != self.height_text and z != self.z):
                words.append("Z" + text)
                self.height_text = text
            self.z = z
        return words

    def straight(self, move: Feed | FeedArc) -> None:
        """Write a straight cut to the end of a move, if the text shows that it goes anywhere.

        Passes at many depths make the same moves from the same places: their words are kept in mind.
        """
        key = id(move), self.x, self.y
        ends = self._ends.get(key)
        if ends is None:
            ends = self._ends[key] = " ".join(self.axis_words(move.x, move.y, None))
        self.x = self.x if move.x is None else move.x
        self.y = self.y if move.y is None else move.y
        height = self.axis_words(None, None, move.z) if move.z is not None else ()
        if ends or height:
            self.line(self.motion_word("G1"), ends, *height, self.feed_word(move.feed))

    def arc(self, move: FeedArc) -> None:
        """Write an arc from the present place; one that is shorter than the last decimal is straight."""
        key = id(move), self.x, self.y
        words = self._arcs.get(key)
        if words is None:
            words = self._arcs[key] = self._arc_words(move)
        ends, centre, whole = words
        if not ends:
            self.straight(move)
            return
        if not whole:
            self.x, self.y = move.x, move.y
        word = self.motion_word("G3" if move.ccw else "G2")
        height = self.axis_words(None, None, move.z) if move.z is not None else ()
        self.line(word, ends, *height, centre, self.feed_word(move.feed))

    def _arc_words(self, move: FeedArc) -> tuple[str, str, bool]:
        """End and centre of an arc, and whether it is a full turn; empty if it is written as a line."""
        whole = math.hypot(move.x - self.x, move.y - self.y) <= TOLERANCES.closure
        start = self.rounded(self.x), self.rounded(self.y)
        end = start if whole else (self.rounded(move.x), self.rounded(move.y))
        if not whole and start == end:
            return "", "", False  # as an arc it would be a full circle
        i, j = self.centre(
            self.x + move.i - start[0], self.y + move.j - start[1], (end[0] - start[0], end[1] - start[1])
        )
        place = f"X{self.length(end[0])} Y{self.length(end[1])}"  # in full: some controls want both axes
        return place, f"I{self.length(i)} J{self.length(j)}", whole

    def centre(self, i: float, j: float, end: tuple[float, float]) -> tuple[float, float]:
        """The centre from the rounded start, (i, j), rounded so that both ends of an arc agree best.

        ``end`` is the rounded end, from the rounded start. With three decimals, plain rounding could leave
        the two radii 2 µm apart; of the nine nearest centres one is much better. Four decimals of an inch are
        coarser, and more centres are looked at.
        """
        step = self.scale * 10.0**-self.decimals
        plain = self.rounded(i), self.rounded(j)
        if abs(math.hypot(*plain) - math.hypot(end[0] - plain[0], end[1] - plain[1])) <= AGREEING:
            return plain
        best, least = plain, math.inf
        near = [place * step for place in (range(-1, 2) if step <= AGREEING * 2 else range(-2, 3))]
        for di in near:
            for dj in near:
                a, b = self.rounded(i + di), self.rounded(j + dj)
                apart = abs(math.hypot(a, b) - math.hypot(end[0] - a, end[1] - b))
                # Of centres that agree alike, the nearest to the planned one.
                cost = apart + math.hypot(a - i, b - j) / 4
                if cost < least - NOISE * step:
                    best, least = (a, b), cost
        return best

    def lost_height(self) -> None:
        """The tool stands at the machine's upper end, whose z the text does not know."""
        self.z = math.nan

    def lost_place(self) -> None:
        """The next section states place, motion and feed itself."""
        self.x = self.y = math.nan
        self.motion = self.feed = ""


def with_numbers(lines: list[str], step: int) -> list[str]:
    """Give every line of code an N number; comments, percent signs and program numbers have none.

    >>> with_numbers(["%", "O0001", "(part)", "G21", "G0 X1"], 10)
    ['%', 'O0001', '(part)', 'N10 G21', 'N20 G0 X1']
    """
    code = sum(_is_code(line) for line in lines)
    if code * step > HIGHEST_NUMBER:
        step = max(1, HIGHEST_NUMBER // code)
    numbered, count = [], 0
    for line in lines:
        if not _is_code(line):
            numbered.append(line)
            continue
        # Beyond the largest number they start again; no control minds, and no search finds the wrong one
        # of two that are a hundred thousand lines apart.
        numbered.append(f"N{(count % (HIGHEST_NUMBER // step) + 1) * step} {line}")
        count += 1
    return numbered


def _is_code(line: str) -> bool:
    return not line.startswith(("%", "O", "o", "(", ";"))
