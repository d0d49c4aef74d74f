"""The proof of programs that measure tools on a setter: read back word by word.

Such a program may do little, and everything else in it is refused by name: sideways moves at the machine's
upper end alone, where nothing stands; downward ones over the setter; two touches of each tool, and then one
entry of one tool of the job.
"""

import math
import re
from collections.abc import Mapping

from mechwright.errors import ProofError
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.offsets import place_of
from mechwright_cam.proof.by_words import FEED_ROUNDED, MODES, NEEDED, ROOM, ByWords
from mechwright_cam.proof.offset_rules import LAST_DECIMAL
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.setup.job import Job

_WORD = re.compile(r"([A-Z])(-?(?:\d+\.?\d*|\.\d+))")


def prove_lengths(texts: Mapping[str, str], job: Job, control: Control, numbers: tuple[int, ...]) -> None:
    """Judge the programs that measure the tools of these numbers, each of them once.

    Raises
    ------
    ProofError
        One line: file and line, what is wrong, the limit.
    """
    left = list(numbers)
    for name, text in texts.items():
        _Reading(name, job, control, left, one_by_hand=not control.offsets.lengths).read(text)
    if left:
        raise ProofError(f"{', '.join(texts)}: T{left[0]} is not measured; measure every tool of the job")


class _Reading(ByWords):
    """A program that measures tools."""

    def __init__(self, name: str, job: Job, control: Control, left: list[int], *, one_by_hand: bool) -> None:
        super().__init__(name, job, control)
        self.left, self.setter = left, job.settings.setter
        self.tool: int | None = left[0] if one_by_hand and left else None
        """The one that has been put in, where tools are changed by hand."""
        self.up = self.over_setter = False
        self.touches = 0

    def obey(self, code: str) -> None:
        """Obey a line, or refuse it."""
        words = [(letter, float(value)) for letter, value in _WORD.findall(code)]
        if "".join(match[0] for match in _WORD.finditer(code)) != code:
            raise self.bad(f"{code!r} is more than a program that measures tools may say")
        names = [f"{letter}{value:g}" for letter, value in words]
        values = dict(words)
        if set(names) <= MODES | set(self.job.settings.offsets):
            self.modes(names)
        elif names[:2] == ["G53", "G0"]:
            self._machine_place(values)
        elif names[0] == "G38.2" and set(values) == {"G", "Z", "F"}:
            self._touch(values["Z"] * self.scale, values["F"] * self.scale)
        elif names[0] == "G0" and set(values) == {"G", "Z"}:
            self._back(values["Z"] * self.scale)
        elif names[0] == "G10":
            self._entry(values)
        elif set(values) <= {"T", "M"} and names[-1] in {"M6", f"T{values.get('T', 0):g}"}:
            self._change(int(values["T"]))
        elif names == ["M30"]:
            self.ended = True
            self.check_up("ends", up=self.up)
        else:
            raise self.bad(f"{' '.join(names)} is none of what a program that measures tools does")

    def _machine_place(self, values: dict[str, float]) -> None:
        self.check_modes([word for word in NEEDED if word not in self.said])
        for axis in values.keys() & {"X", "Y", "Z"}:
            self.check_ends(axis, values[axis] * self.scale)
        if set(values) == {"G", "Z"}:
            z = values["Z"] * self.scale
            self.up = z >= self.top - NEAR
            if self.up:
                self.over_setter, self.touches = False, 0
            elif not self.over_setter:
                raise self.bad("goes down elsewhere than over the setter")
            else:
                self._clear(z)
            return
        if set(values) != {"G", "X", "Y"}:
            raise self.bad("a move in machine coordinates is of X and Y, or of Z")
        self.check_up("goes sideways", up=self.up)
        x, y = values["X"] * self.scale, values["Y"] * self.scale
        assert self.setter.x is not None and self.setter.y is not None  # noqa: S101, PT018 - the table has both
        off = math.hypot(x - self.setter.x, y - self.setter.y)
        if off > LAST_DECIMAL * math.sqrt(2):
            raise self.bad(f"goes {off:.3f} mm beside the setter")
        self._beside_stock(x, y)
        self.over_setter = True

    def _clear(self, z: float) -> None:
        """Where heights are known the tip stays over the setter at a rapid."""
        tool = next((tool for tool in self.job.tools if tool.number == self.tool), None)
        zero, over = self.job.settings.measured.z, self.setter.over
        if tool is None or tool.length is None or zero is None or over is None:
            return
        room = z - tool.length - zero - over
        if room < ROOM:
            raise self.bad(
                f"the tip of T{self.tool} would stand {room:.1f} mm over the setter at a rapid, {ROOM:g} mm "
                "at least; raise cam.setter.start"
            )

    def _beside_stock(self, x: float, y: float) -> None:
        """Where the stock lies is known, no tool comes down on it, nor on what holds it."""
        tool = next((tool for tool in self.job.tools if tool.number == self.tool), None)
        wide = (tool.diameter, tool.holder_diameter) if tool else ()
        radius = max(self.setter.diameter, *wide) / 2
        for offset in self.job.settings.offsets:
            known = self.job.settings.at(offset).measured
            if known.x is None or known.y is None:
                continue
            x0, y0, x1, y1 = self.job.stock
            away = math.hypot(
                max(known.x + x0 - x, x - known.x - x1, 0.0), max(known.y + y0 - y, y - known.y - y1, 0.0)
            )
            if away < radius:
                raise self.bad(
                    f"the setter is {away:.1f} mm beside the stock at {offset}, {radius:g} mm at least for "
                    f"it and T{self.tool}; put it elsewhere (cam.setter)"
                )

    def _touch(self, z: float, feed: float) -> None:
        if not self.over_setter or "G91" not in self.said:
            raise self.bad("touches elsewhere than over the setter, or not by a distance (G91)")
        if self.tool is None:
            raise self.bad("touches before a tool is called")
        if not 0 < -z <= self.setter.travel + LAST_DECIMAL:
            raise self.bad(f"touches {-z:g} mm down, {self.setter.travel:g} mm at most")
        limit = self.setter.slow if self.touches else self.setter.fast
        if feed > limit + FEED_ROUNDED * self.scale:
            raise self.bad(f"touches with {feed:g} mm/min, {limit:g} at most")
        self.up, self.touches = False, self.touches + 1

    def _back(self, z: float) -> None:
        if "G91" not in self.said or z < 0 or not self.touches:
            raise self.bad(
                "goes to a height that no touch has found; go up by a distance (G91) behind a touch"
            )

    def _entry(self, values: dict[str, float]) -> None:
        """The one thing that is written: of the tool in the spindle, after its second touch."""
        if self.touches != 2 or "G90" not in self.said or self.tool not in self.left:
            raise self.bad(f"writes a length of T{self.tool} without two touches of it, or again")
        table = (int(values.get("L", 0)), int(values.get("P", 0)))
        if self.control.offsets.lengths:
            allowed = (10, self.tool)
        else:
            allowed = (20, place_of(self.job.settings.work_offset)[1])
        if table != allowed or set(values) != {"G", "L", "P", "Z"}:
            said, meant = (f"G10 L{one} P{place}" for one, place in (table, allowed))
            raise self.bad(f"{said} is no entry of T{self.tool}; {meant} is")
        over, z = self.setter.over, values["Z"] * self.scale
        if over is None or abs(z - over) > LAST_DECIMAL:
            raise self.bad(f"writes Z{z:g} where the setter's top is at {over:g}")
        self.left.remove(self.tool)
        self.touches = 0

    def _change(self, tool: int) -> None:
        self.check_up("changes the tool", up=self.up)
        if tool not in self.left:
            raise self.bad(f"T{tool} is no tool of this job, or has been measured")
        self.tool = tool
