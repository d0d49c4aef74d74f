"""The machine that runs the words.

Order of execution within a line and the meaning of each code follow RS274/NGC (Kramer, Proctor, Messina:
The NIST RS274NGC Interpreter, version 3, 2000, table 8) and LinuxCNC's documents.
"""

import math
from collections.abc import Mapping

from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading.blocks import Block, check_points, fail, no_code, rows_of
from mechwright_cam.controls.reading.motions import Moving
from mechwright_cam.controls.reading.run import Kind, Remark, SpindleChange
from mechwright_cam.controls.words.assign import RefusedError, Situation, owners
from mechwright_cam.controls.words.groups import MOTIONS, STOPPING, spell
from mechwright_cam.controls.words.table import Use

MOST_KINDS = 10_000
"""So many kinds of block, by their codes, addresses and the motion in force, are remembered."""
HIGHEST_PARAMETER = 5000
"""Parameters beyond this are probe results, offsets and states of the machine."""


class Machine(Moving):
    """The machine while a program runs; lengths in mm."""

    def __init__(self, dialect: Dialect, upper_end: float, diameters: Mapping[int, float]) -> None:
        super().__init__(dialect)
        self.upper_end = upper_end
        self.diameters = diameters
        self.sticky = {}
        self.idle = 0
        """Blocks without X and Y since the last move beside compensation."""
        self._taken: dict[tuple[object, ...], list[tuple[str, str]]] = {}
        """Kind of block to its addresses, each with the code that takes it."""
        self._idle = frozenset(row.word for row in dialect.words.codes if row.use is Use.IDLE)

    def system_value(self, name: float | str) -> float:
        """A parameter that the machine keeps.

        Raises ValueError for one that an earlier program, or the operator, may have set.
        """
        place = {"_x": self.x, "_y": self.y, "_z": self.z, 5420: self.x, 5421: self.y, 5422: self.z}
        known = {
            **place,
            "_feed": self.feed / self.scale,
            "_rpm": self.state.rpm,
            "_current_tool": float(self.state.tool),
            "_selected_tool": float(-1 if self.selected is None else self.selected),
            "_metric": float(self.scale == 1.0),
            "_imperial": float(self.scale != 1.0),
            "_absolute": float(self.absolute),
            "_incremental": float(not self.absolute),
        }
        if name in known:
            value = known[name]
            if word := self._left_over(name):
                raise ValueError(f"#<{name}> is what an earlier program has left; write {word} before it")
            if name in place:
                if not math.isfinite(value):
                    raise ValueError(f"#{name} is asked for, and the text does not say where the tool is")
                value /= self.scale
            return value
        if isinstance(name, str):
            raise ValueError(
                f"#<{name}> has no value in this program, and {self.dialect.name} keeps that of an earlier "
                "one; set it before it is read"
            )
        if name < 1:
            raise ValueError(f"there is no parameter #{name:g}; a program reads from #1 on")
        if name > HIGHEST_PARAMETER:
            raise ValueError(f"#{name:g} is kept by the machine, and not known here")
        raise ValueError(
            f"#{name:g} is read before the program sets it, and {self.dialect.name} keeps the value of an "
            f"earlier program; write #{name:g}=0 before it, or its value"
        )

    def _left_over(self, name: float | str) -> str:
        """What a program has to say before it reads one of its states; empty if it has said so."""
        if name in {"_metric", "_imperial"}:
            return "" if "units" in self.state.stated else "G21 or G20"
        if name in {"_absolute", "_incremental"}:
            return "" if "distance" in self.state.stated else "G90 or G91"
        if name in {"_feed", "_rpm"}:
            value = self.feed if name == "_feed" else self.state.rpm
            return "" if value > 0 else ("F" if name == "_feed" else "S")
        if name == "_current_tool":
            return "" if self.state.tool else "T and M6"
        return "T" if name == "_selected_tool" and self.selected is None else ""

    def run(self, block: Block) -> None:
        """Run one block."""
        if self.dialect.stops_behind and not STOPPING.isdisjoint(block.m) and block.words.keys() & set("XYZ"):
            move = block.again(block.line)
            move.m = [code for code in block.m if code not in STOPPING]
            self.run(move)
            self.run(Block(block.line, m=[code for code in block.m if code in STOPPING]))
            return
        for comment in block.comments:
            self.remarks.append(Remark(block.line, comment, self.steps))
        if not (block.g or block.m or block.words):
            return
        words, before, contour = block.words, self.state, self.contour
        self._share(block)
        self._units(block)  # first, so that every length of this line is read in the units it states
        if self.dialect.point_needed and block.bare:
            check_points(block, self.dialect, inches=self.scale != 1.0)
        if "F" in words and (331 in block.g or (self.motion == 331 and "K" in words)):
            raise fail(block.line, "G33.1 with F, which the spindle gives there; leave it out")
        self._speeds(block)
        self._tool(block)
        if block.m:
            self._spindle_and_coolant(block)
        if self.state is not before and self.state.spindle_rotation != before.spindle_rotation:
            place = self.x, self.y, self.z
            self.spindle_changes.append(SpindleChange(block.line, before.tool, place, self.steps))
            if self.state.spindle_rotation:
                self._check_start(block)
        if 40 in block.g:
            time = block.of(40)
            seconds = self._waiting(block, time, "X" if "X" in time else "P", "G4 needs a time, P")
            if seconds < 0:
                raise fail(block.line, f"G4 waits for {seconds:g} s; write P 0 or more")
            self._row(Kind.DWELL, block.line, self.x, self.y, self.z, seconds=seconds)
        if not MOTIONS.issuperset(block.g):
            self._modes(block)
            self._length_offset(block)
            self._work_offset(block)
            self._tables(block)
        self.keep_state()
        if 280 in block.g or 300 in block.g:
            self._home(block)
        self._move(block)
        self._check_idle(block.line, contour)
        for share in block.shares.values():
            if share:
                raise fail(block.line, f"{next(iter(share))} means nothing in this line")
        self._stop(block)

    def _share(self, block: Block) -> None:
        """Give each word of a block to the code that takes it; one that none takes, or two, is refused."""
        motion = self._without_cycle() if 800 in block.g else self.motion
        kind = (*block.g, None, *block.m, None, *block.words, None, motion, self.cancelled)
        taken = self._taken.get(kind)
        if taken is None:
            if len(self._taken) >= MOST_KINDS:
                self._taken.clear()
            taken = self._taken[kind] = self._takers(block, motion)
        shares: dict[str, dict[str, float]] = {}
        for letter, taker in taken:
            shares.setdefault(taker, {})[letter] = block.words[letter]
        block.shares = shares
        for code, letter, kept, remedy in self.dialect.corners.looser:
            value = block.of(code).get(letter) if code in block.g else None
            if value is not None and value not in kept:
                raise fail(
                    block.line,
                    f"{spell(code)} {letter}{value:g} lets {self.dialect.name} round corners further than "
                    f"the setting of the machine; {remedy}",
                )
        for idle in self._idle & shares.keys():
            del shares[idle]

    def _takers(self, block: Block, motion: int | None) -> list[tuple[str, str]]:
        """Each address of a block with the code that takes it."""
        self._check_codes(block)
        now = Situation(None if motion is None else spell(motion), self.cancelled)
        table, rows = self.dialect.words, rows_of(block, self.dialect)
        try:
            return [*owners(table, rows, block.words, now, self.dialect.name).items()]
        except RefusedError as error:
            raise fail(block.line, str(error)) from None

    def _check_start(self, block: Block) -> None:
        """Refuse to start the spindle beside a feed where the machine's builder has set which is first."""
        start = next((row for row in rows_of(block, self.dialect) if not row.before_feed), None)
        if start is not None and self._feeds(block):
            word = f"M{self.dialect.m(start.number)}"
            raise fail(
                block.line,
                f"{word} beside a feed: whether {self.dialect.name} starts the spindle before it, the "
                f"machine's builder has set; write {word} in a line before",
            )

    def _check_idle(self, line: int, contour: tuple[float, float]) -> None:
        """Refuse a move beside compensation that the control has not seen when it made the one before."""
        if not self.side or self.fresh or self.contour == contour:
            self.idle = self.idle + 1 if self.side and not self.fresh else 0
            return
        if self.idle > self.dialect.idle_most:
            raise fail(
                line,
                f"{self.idle} blocks without X and Y before this one while compensation is on: "
                f"{self.dialect.name} looks no further ahead, and may cut into the corner; write one at most",
            )
        self.idle = 0

    def _feeds(self, block: Block) -> bool:
        """Whether a block moves at a feed."""
        named = next((code for code in block.g if code in MOTIONS - {800}), self.motion)
        return named not in {None, 0} and 530 not in block.g and not block.words.keys().isdisjoint("XYZ")

    def _check_codes(self, block: Block) -> None:
        """Refuse codes that the control does not read, and those that lack a word."""
        table = self.dialect.words
        for code in block.g:
            row = table.g.get(code)
            if row is None:
                raise fail(block.line, no_code(spell(code), self.dialect))
            if row.use is Use.REFUSED:
                raise fail(block.line, f"{row.word} is not supported; {row.remedy}")
            if row.use is Use.IDLE and row.one_of and not any(letter in block.words for letter in row.one_of):
                raise fail(block.line, f"{row.word} needs {row.one_of[0]}")
        for code in block.m:
            if code not in table.m:
                raise fail(block.line, no_code(f"M{code}", self.dialect))

    def _stop(self, block: Block) -> None:
        for code in block.m:
            if code in {0, 1}:
                by_hand = self.dialect.tool_by_t and self.rows and self.rows[-1][0] == Kind.TOOL
                self._row(Kind.MAYBE if code else Kind.STOP, block.line, self.x, self.y, self.z)
                if by_hand:  # whoever has touched the tool off has left it somewhere
                    self._lose_place(block.line, f"M{code}")
                    self.z = math.nan
            elif code in {2, 30}:
                self.check_last_move(block.line)
                self._row(Kind.END, block.line, self.x, self.y, self.z)
                self.ended = True
