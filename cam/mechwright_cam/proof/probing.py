"""The proof of programs that probe the zero: read back word by word, for a stock anywhere within the doubt.

Places are kept as intervals in the coordinates of the stock as it really lies: until an axis has been touched
and written, a place along it may be off by ``doubt`` either way. Moves have to be clear of the stock at both
ends of all intervals, touches have to meet it, and what is written has to be where they do.

Glossary
--------
sure
    An axis whose zero has been written: from there on the text says where the ball is.
contact
    Where ball and stock meet along an axis, mm: an edge and the ball's radius beside it, or the top.
"""

import math
import re

from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.offsets import place_of
from mechwright_cam.controls.writing.probing import FAST, PARAMETERS, SLOW
from mechwright_cam.proof.by_words import FEED_ROUNDED, MODES, NEEDED, ROOM, ByWords
from mechwright_cam.proof.offset_rules import LAST_DECIMAL
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.probing import BEYOND, LEAST_BELOW, OVER_TABLE

_NUMBER = r"-?(?:\d+\.?\d*|\.\d+)"
_WORD = re.compile(rf"([A-Z])({_NUMBER}|\[[^\[\]]*\])")
_BACK = re.compile(rf"\[(#\d+)([+-])((?!-){_NUMBER})\]")
_SHOWN = re.compile(rf"\[({_NUMBER})\+(#\d+)-(#\d+)\]")
Span = tuple[float, float]


def prove_probe(name: str, text: str, job: Job, control: Control) -> None:
    """Judge the program that probes the zero of a job.

    Raises
    ------
    ProofError
        One line: file and line, what is wrong, the limit.
    """
    _Reading(name, job, control).read(text)


class _Reading(ByWords):
    """A program that probes."""

    def __init__(self, name: str, job: Job, control: Control) -> None:
        super().__init__(name, job, control)
        self.probe, self.offset = job.settings.probe, job.settings.work_offset
        self.radius, self.doubt = self.probe.diameter / 2, self.probe.doubt
        self.at: dict[str, Span] = dict.fromkeys("XYZ", (math.nan, math.nan))
        self.sure = set[str]()
        self.touched: tuple[str, int, int] | None = None
        """Axis, direction and number of the last touches, if nothing but moves along it came since."""
        self.meets = self.taken = False
        """Whether the ball stands at a contact, the probe is in the spindle."""
        self.slow = False
        self.free: Span = (0.0, 0.0)
        """Where along its axis the ball has come from in its last touch."""

    def obey(self, code: str) -> None:
        """Obey a line, or refuse it."""
        words = _WORD.findall(code)
        if "".join(letter + value for letter, value in words) != code:
            raise self.bad(f"{code!r} is more than a program that probes may say")
        codes = [f"{letter}{float(value):g}" for letter, value in words if letter in "GMTHLP"]
        rest = {letter: value for letter, value in words if letter not in "GMTHLP"}
        if len(codes) + len(rest) != len(words):
            raise self.bad("two words of one letter")
        if not rest and set(codes) <= MODES:
            self.modes(codes)
        elif codes in (["G53", "G0"],) and set(rest) == {"Z"}:
            self._retract(self._value(rest["Z"]))
        elif not rest and codes == [f"T{self.probe.tool}", "M6"] and self.control.offsets.lengths:
            self._up("changes the tool")
            self.taken = True
        elif not rest and codes == ["M30"]:
            self._up("ends")
            self.ended = True
        elif codes[:1] == ["G10"]:
            self._entry(codes[1:], rest)
        elif codes in (["G38.2"], ["G38.3"]) and len(rest) == 2 and "F" in rest:
            self._touch(codes[0], next(axis for axis in rest if axis != "F"), rest)
        elif set(codes) <= {self.offset, f"G43 H{self.probe.tool}", "G0", "G43", f"H{self.probe.tool}"}:
            self._states(set(codes))
            if rest:
                self._rapid(codes, rest)
        else:
            raise self.bad(f"{code} is none of what a program that probes does")

    def _value(self, word: str) -> float:
        try:
            return float(word) * self.scale
        except ValueError:
            raise self.bad(f"{word} is no place that is known here") from None

    def _states(self, codes: set[str]) -> None:
        if {"G43", f"H{self.probe.tool}"} <= codes:
            if not self.taken:
                raise self.bad("the probe's length before the probe")
            self.said.add("G43")
        elif codes & {"G43", f"H{self.probe.tool}"}:
            raise self.bad(f"write {self.control.length_words(self.probe.tool or 0)} whole")
        self.said |= codes & {self.offset}

    def _up(self, what: str) -> None:
        self.check_up(what, up=self.at["Z"][0] == math.inf)

    def _retract(self, z: float) -> None:
        self.check_modes([word for word in NEEDED if word != "M5" and word not in self.said])
        if not self.top - NEAR <= z <= max(self.top, 0.0) + NEAR or "G91" in self.said:
            raise self.bad(
                f"goes to machine Z{z:g}, and not to its upper end, {self.top:g}, in absolute coordinates"
            )
        self.check_ends("Z", z)
        self.at["Z"], self.touched, self.meets = (math.inf, math.inf), None, False

    def _target(self, axis: str, word: str) -> Span:
        """Where a word takes the ball along an axis, in the coordinates of the stock."""
        here = self.at[axis]
        if match := _BACK.fullmatch(word):
            if not self.meets or self.touched is None or match[1] != PARAMETERS[axis][0]:
                raise self.bad(f"{word} is known right behind a touch along its axis alone")
            by = float(match[2] + match[3]) * self.scale
            return here[0] + by, here[1] + by
        value = self._value(word)
        if "G91" in self.said:
            return here[0] + value, here[1] + value
        around = 0.0 if axis in self.sure else self.doubt
        return value - around, value + around

    def _rapid(self, codes: list[str], rest: dict[str, str]) -> None:
        if "G0" not in codes or not set(rest) <= set("XYZ"):
            raise self.bad("moves otherwise than by G0")
        self.check_modes([word for word in (*NEEDED, self.offset) if word not in self.said and word != "G90"])
        if "G91" in self.said and not self.meets:
            raise self.bad("goes by a distance elsewhere than away from a contact")
        if self.meets and self.touched is not None and set(rest) != {self.touched[0]}:
            raise self.bad(f"moves with the ball at the stock; go back along {self.touched[0]} first")
        end = {**self.at, **{axis: self._target(axis, word) for axis, word in rest.items()}}
        if "Z" in rest:
            self._height(end["Z"], alone=len(rest) == 1)
        elif self.at["Z"][0] != math.inf:
            self._sideways(rest, end)
        self._clear(end)
        if not (self.touched and set(rest) == {self.touched[0]}):
            self.touched = None
        self.at, self.meets = end, False

    def _height(self, z: Span, *, alone: bool) -> None:
        if not alone:
            raise self.bad("moves sideways and in Z at once")
        if any(math.isnan(self.at[axis][0]) for axis in "XY"):
            raise self.bad("comes down before X and Y are those of the work")
        if "G43" not in self.said and self.control.offsets.lengths:
            raise self.bad(f"moves Z before {self.control.length_words(self.probe.tool or 0)}")
        if z[0] < self.at["Z"][0] and z[0] < self.job.highest + ROOM:
            raise self.bad(f"comes down to Z{z[0]:g} at a rapid; touch the stock, or go by G38.3")

    def _sideways(self, rest: dict[str, str], end: dict[str, Span]) -> None:
        """Low beside the stock only back the way that the ball has come."""
        if self.at["Z"][0] >= self.job.highest:
            return
        if self.touched is None or set(rest) != {self.touched[0]}:
            raise self.bad(
                f"goes sideways at Z{self.at['Z'][0]:g}, where nobody knows what stands; go up first"
            )
        low, high = end[self.touched[0]]
        if low < self.free[0] - LAST_DECIMAL or high > self.free[1] + LAST_DECIMAL:
            raise self.bad("goes back further than the ball has come")

    def _clear(self, end: dict[str, Span]) -> None:
        """The ball, on its stylus, stays out of the stock wherever that may lie."""
        x0, y0, x1, y1 = self.job.stock
        swept = {axis: (min(a[0], b[0]), max(a[1], b[1])) for axis, a, b in self._both(end)}
        if swept["Z"][0] >= -LAST_DECIMAL:
            return
        for axis, low, high in (("X", x0, x1), ("Y", y0, y1)):
            if swept[axis][1] + self.radius <= low + LAST_DECIMAL:
                return
            if swept[axis][0] - self.radius >= high - LAST_DECIMAL:
                return
        raise self.bad(f"may run into a stock that lies {self.doubt:g} mm off")

    def _both(self, end: dict[str, Span]) -> list[tuple[str, Span, Span]]:
        known = {a: end[a] if math.isnan(self.at[a][0]) else self.at[a] for a in "XYZ"}
        return [(axis, known[axis], end[axis]) for axis in "XYZ"]

    def _touch(self, code: str, axis: str, rest: dict[str, str]) -> None:
        if axis not in "XYZ" or "G91" in self.said or self.at["Z"][0] == math.inf or "M5" not in self.said:
            raise self.bad("touches from the upper end, with a spindle that turns, or by a distance (G91)")
        end, feed = self._target(axis, rest[axis]), self._value(rest["F"])
        again = self.touched is not None and self.touched[0] == axis
        limit = SLOW if again else FAST
        if not 0 < feed <= limit + FEED_ROUNDED * self.scale:
            raise self.bad(f"touches with {feed:g} mm/min, {limit:g} at most")
        if code == "G38.3":
            self._guarded(axis, end)
            return
        if self.meets:
            raise self.bad("touches again with the ball still at the stock; go back first")
        way = 1 if end[0] > self.at[axis][0] else -1
        contact = self._contact(axis, way)
        reach = (end[0] - contact if way > 0 else contact - end[1]) + LAST_DECIMAL
        if reach < 0:
            raise self.bad(f"ends {-reach:.3f} mm before a stock that lies {self.doubt:g} mm off")
        beyond = (end[1] - contact if way > 0 else contact - end[0]) - BEYOND - LAST_DECIMAL
        if beyond > (0.0 if axis in self.sure else 2 * self.doubt):
            raise self.bad(f"goes on more than {BEYOND:g} mm behind the last place of the stock")
        start = self.at[axis]
        if (start[1] > contact + LAST_DECIMAL) if way > 0 else (start[0] < contact - LAST_DECIMAL):
            raise self.bad("begins with the ball in a stock that may lie there")
        if not again:
            self.free = (start[0], contact) if way > 0 else (contact, start[1])
        count = self.touched[2] + 1 if again and self.touched else 1
        self.at[axis], self.touched, self.meets = (contact, contact), (axis, way, count), True

    def _guarded(self, axis: str, end: Span) -> None:
        if axis != "Z" or "Z" not in self.sure:
            raise self.bad("goes down beside the stock, by G38.3, behind the touch of its top alone")
        if end[0] < -(self.job.thickness - OVER_TABLE) - LAST_DECIMAL:
            raise self.bad(f"goes down to Z{end[0]:g}, nearer to the table than {OVER_TABLE:g} mm")
        self._clear({**self.at, "Z": end})
        self.at["Z"], self.touched, self.meets = end, None, False

    def _contact(self, axis: str, way: int) -> float:
        """Where the ball meets the stock; refused where it may miss it."""
        x0, y0, x1, y1 = self.job.stock
        sides = {"X": (x0, x1), "Y": (y0, y1)}
        for other, (low, high) in sides.items():
            if other != axis and not (low < self.at[other][0] and self.at[other][1] < high):
                raise self.bad(
                    f"may miss the stock: {other} is {self.at[other][0]:g} to {self.at[other][1]:g}"
                )
        if axis == "Z":
            if way > 0:
                raise self.bad("touches upwards")
            return 0.0
        if "Z" not in self.sure or self.at["Z"][1] > -(self.radius + LEAST_BELOW) + LAST_DECIMAL:
            raise self.bad(
                f"touches an edge with the ball's middle less than {LEAST_BELOW:g} mm below the top"
            )
        low, high = sides[axis]
        return low - self.radius if way > 0 else high + self.radius

    def _entry(self, codes: list[str], rest: dict[str, str]) -> None:
        """The one thing that is written: the axis of a contact, with where that is."""
        if codes != ["L20", f"P{place_of(self.offset)[1]}"] or len(rest) != 1:
            raise self.bad(f"G10 {' '.join(codes)} is no entry of {self.offset} along one axis")
        ((axis, word),) = rest.items()
        if not self.meets or self.touched is None or self.touched[0] != axis or self.touched[2] != 2:
            raise self.bad(f"writes {axis} without two touches along it")
        if match := _SHOWN.fullmatch(word):
            if (match[3], match[2]) != PARAMETERS[axis]:
                raise self.bad(f"{word} is not where the ball has met the stock along {axis}")
            word = match[1]
        value, contact = self._value(word), self.at[axis][0]
        if abs(value - contact) > LAST_DECIMAL:
            raise self.bad(f"writes {axis}{value:g} where the ball is at {axis}{contact:g}")
        if axis in self.sure:
            raise self.bad(f"writes {axis} again")
        self.sure.add(axis)

    def finish(self) -> None:
        """Refuse a program that does not end, or has not found the zero."""
        super().finish()
        if missing := sorted(set("XYZ") - self.sure):
            raise self.bad(f"ends without {' and '.join(missing)} of {self.offset}")
