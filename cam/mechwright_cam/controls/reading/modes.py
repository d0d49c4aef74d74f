"""The modes of the machine: what a word changes and leaves changed."""

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading.blocks import Block, fail
from mechwright_cam.controls.reading.compensation import Compensation
from mechwright_cam.controls.reading.run import Coolant, Ints, Kind, Selection, State, TableWrite
from mechwright_cam.controls.words.groups import EXTENDED, GROUPS, spell

INCH = 25.4
LARGEST_WHOLE = 99_999_999
"""Numbers of tools, offsets and turns: more than eight digits no control takes."""
MOST_CHANGES = 10_000
"""So many changes of states are remembered."""
PLANES = {170: "XYZ", 180: "ZXY", 190: "YZX"}
"""G17, G18, G19: the axes of the plane in the order of a right-handed turn, and the one across it."""
AXES = "XYZ"
COMPENSATING = GROUPS["cutter compensation"] - {400}
NOT_BESIDE_COMPENSATION = GROUPS["path"] | GROUPS["return"] | {921, 922}
"""Codes that need cutter compensation off: in a line with G41 or G42 it is on by then, in either order."""
CENTRES = {"X": "I", "Y": "J", "Z": "K"}
"""The word for the centre along each axis."""
_COOLANT: dict[tuple[bool, bool], Coolant] = {
    (False, False): "off",
    (True, False): "mist",
    (False, True): "flood",
    (True, True): "both",
}
_SPINDLE_CODES = {1: 3, -1: 4, 0: 5}
_COOLANT_CODES: dict[Coolant, tuple[int, ...]] = {"off": (9,), "mist": (7,), "flood": (8,), "both": (7, 8)}
"""M codes that leave spindle and coolant as they are."""


class Modal(Compensation):
    """A machine that knows its modes, and does not move yet."""

    def __init__(self, dialect: Dialect) -> None:
        super().__init__(dialect)
        self.absolute = True
        self.absolute_centres = False
        self.selected: int | None = None
        self.to_initial = True
        self.state = self.states[0]
        self.plane = 170
        self.motion: int | None = None
        self.rigid = dialect.tapping == "always"
        self.offsets_are_zero = False
        self.diameters: Mapping[int, float] = {}
        self._changed: dict[tuple[Any, ...], tuple[State, State]] = {}
        """A state, which lives as long as its identity stands here, and what changes have made of it.

        Programs go to and fro between a few.
        """

    @property
    def moves_plainly(self) -> bool:
        """Whether X, Y and Z say where the tool goes, and arcs lie in the XY plane."""
        return self.plane == 170 and not self.side and self.left is None

    def _take(self, block: Block, share: dict[str, float], letter: str, missing: str) -> float:
        """A word of a code's share, used up; ProgramError where there is none."""
        try:
            return share.pop(letter)
        except KeyError:
            raise fail(block.line, missing) from None

    def _waiting(self, block: Block, share: dict[str, float], letter: str, missing: str) -> float:
        """A time, s: without a point it may be in another unit."""
        bare, unit = self.dialect.bare_dwell_unit, self.dialect.dwell_unit
        value = self._take(block, share, letter, missing)
        return value * (bare if bare is not None and letter in block.bare else unit)

    def _without_compensation(self, block: Block, name: str) -> None:
        if self.side:
            raise fail(block.line, f"{name} while compensation is on; write G40 before")

    def _whole(self, block: Block, letter: str, value: float) -> int:
        if value < 0 or value != int(value) or value > LARGEST_WHOLE:
            raise fail(block.line, f"{letter}{value:g} is no whole number from 0 to {LARGEST_WHOLE}")
        return int(value)

    def _set(self, **changes: Any) -> None:
        state = self.state
        if any(getattr(state, name) != value for name, value in changes.items()):
            key = id(state), *changes.items()  # the hash of a state is that of all its fields
            known = self._changed.get(key)
            if known is None:
                if len(self._changed) >= MOST_CHANGES:
                    self._changed.clear()
                found = replace(state, **changes)
                known = self._changed[key] = state, self.known.setdefault(found, found)
            self.state = known[1]

    def _state(self, group: str) -> None:
        if group not in self.state.stated:
            self._set(stated=self.state.stated | {group})

    def keep_state(self) -> None:
        """Give the present state its number, ``index``."""
        if self.state is not self.states[self.index]:
            number = self.numbers.get(id(self.state))
            if number is None:
                number = self.numbers[id(self.state)] = len(self.states)
                self.states.append(self.state)
            self.index = number

    def at_speeds(self, rpm: Array) -> Ints:
        """Go through spindle speeds (n,), rev/min, and give the number (n,) of the state at each."""
        speeds, first, which = np.unique(rpm, return_index=True, return_inverse=True)
        numbers = np.zeros(speeds.size, dtype=np.int64)
        for place in [*np.argsort(first), which[-1]]:
            self._set(rpm=float(speeds[place]))
            self.keep_state()
            numbers[place] = self.index
        return numbers[which]

    @abstractmethod
    def _check_codes(self, block: Block) -> None:
        """Raise ProgramError for codes that the control does not read, or not together."""

    def is_stated(self, block: Block) -> bool:
        """Whether words of state say what is so anyway.

        They are those of :mod:`mechwright_cam.controls.reading.comments_and_states`.
        G90 and G91 may say either, once the program has said one of them.
        """
        try:
            self._check_codes(block)
        except ProgramError:
            return False
        state, offset = self.state, GROUPS["work offset"]
        now = {_SPINDLE_CODES[state.spindle], *_COOLANT_CODES[state.coolant]}
        groups = {
            "units": {200 if self.scale != 1.0 else 210},
            "distance": {900, 910},
            "plane": {self.plane},
            "cutter compensation": set() if self.side else {400},
            "feed mode": set() if self.dialect.mode_ends_feed else {940},
        }
        said = {code for group, codes in groups.items() if group in state.stated for code in codes}
        return now.issuperset(block.m) and all(
            code in said or (code in offset and spell(code) == state.work_offset) for code in block.g
        )

    def by_centre(self, line: int) -> None:
        """Tell of an arc by its centre: what an earlier program has made of I and J may still hold."""
        if "centres" not in self.state.stated:
            self.lacks(line, "centres", "G91.1")

    def _units(self, block: Block) -> None:
        for code in block.g:
            if code in GROUPS["units"]:
                scale = INCH if code == 200 else 1.0
                if self.dialect.one_unit and scale != self.scale and "units" in self.state.stated:
                    raise fail(
                        block.line,
                        f"{spell(code)} in a program with other units; {self.dialect.name} takes one of G20 "
                        "and G21, at the head of the program",
                    )
                self.scale = scale
                self._state("units")

    def _speeds(self, block: Block) -> None:
        if self.dialect.mode_ends_feed and 940 in block.g:
            self.feed = 0.0
        if "F" in block.words:
            self.feed = block.of("F").pop("F") * self.scale
            if self.feed < 0:
                raise fail(block.line, "F is below 0")
        if "S" in block.words:
            rpm = block.of("S").pop("S")
            if rpm < 0:
                raise fail(block.line, "S is below 0")
            self._set(rpm=rpm)

    def _tool(self, block: Block) -> None:
        if "T" in block.words:
            number = self._whole(block, "T", block.of("T").pop("T"))
            if number != self.selected:
                self.selections.append(Selection(block.line, number))
            self.selected = number
            if self.dialect.tool_by_t and self.selected != self.state.tool:
                self._set(tool=self.selected, length_offset=None, length=None)
                self.keep_state()
                self._row(Kind.TOOL, block.line, self.x, self.y, self.z)
        if 6 in block.m:
            self._without_compensation(block, "M6")
            if self.selected is None:
                raise fail(block.line, "M6 without a tool; write T before it")
            self._set(tool=self.selected, spindle=0)
            if self.dialect.change_stops_coolant:
                self._set(coolant="off")
            self.keep_state()
            x, y = self.x, self.y
            if not self.offsets_are_zero:  # whoever set up the machine has said where tools are changed
                self.lose(block.line, "M6", "XY")
                x = y = math.nan
            self._row(Kind.TOOL, block.line, x, y, self.z)

    def _spindle_and_coolant(self, block: Block) -> None:
        for code in block.m:
            if f"M{code}" == self.dialect.tapping:
                self.rigid = True
            if (turns := self.dialect.words.m[code].spindle) is not None:
                self._set(spindle=turns)
        mist, flood = self.state.coolant in {"mist", "both"}, self.state.coolant in {"flood", "both"}
        if 9 in block.m:
            mist = flood = False
        self._set(coolant=_COOLANT[mist or 7 in block.m, flood or 8 in block.m])

    def _modes(self, block: Block) -> None:
        before = self.side
        if not COMPENSATING.isdisjoint(block.g):
            late = next((code for code in block.g if code in NOT_BESIDE_COMPENSATION), None)
            if late is not None:
                raise fail(block.line, f"{spell(late)} while compensation is on; write it in a line before")
        for code in block.g:
            if code in {900, 910}:
                self.absolute = code == 900
                self._state("distance")
            elif code in {901, 911}:
                self.absolute_centres = code == 901
                self._state("centres")
            elif code in {980, 990}:
                self._without_compensation(block, spell(code))
                self.to_initial = code == 980
                self._state("return")
            elif code == 940:
                self._state("feed mode")
            elif code in {921, 922}:
                self._without_compensation(block, spell(code))
                self._lose_place(block.line, spell(code))
            elif code in PLANES:
                if self.side or (before and code != self.plane):  # G40 in the same line comes too late
                    raise fail(block.line, "the plane changes while compensation is on; write G40 before")
                self.plane = code
                if code == 170:
                    self._state("plane")
            elif code == 400:
                self.end_compensation(block.line)
                self._set(side=0, diameter_offset=None)
                self._state("cutter compensation")
            elif code in {410, 420, 411, 421}:
                if self.plane != 170:
                    raise fail(block.line, f"{spell(code)} is read in the XY plane only (G17)")
                side = 1 if code in {410, 411} else -1
                number, diameter = self._diameter(block, code)
                self.begin_compensation(block.line, side, diameter)
                self._set(side=side, diameter_offset=number)
            elif code in GROUPS["path"]:
                self._corners(block, code)

    def _corners(self, block: Block, code: int) -> None:
        """G61 and G64: how far the control may leave the path; P and Q only where the control has them."""
        corners = self.dialect.corners
        if self.side and corners.tolerance:
            raise fail(block.line, f"{spell(code)} while compensation is on; write it before")
        bound = rounding = 0.0
        if code == 640:
            given = [block.of(code).pop(letter, None) for letter in "PQ"]
            blend, merge = (None if value is None else value * self.scale for value in given)
            bound = corners.bound(blend, merge)
            rounding = max(blend or 0.0, 0.0)
        self._set(off_path=bound, path_mode=code, blend=rounding)

    def _number(self, block: Block, letter: str, code: int) -> int:
        """The number of an offset: as it is written, or the tool's where the control takes that."""
        share = block.of(code)
        if letter not in share and letter == self.dialect.words.g[code].needs:
            raise fail(
                block.line,
                f"{spell(code)} without {letter} takes what {self.dialect.name} had last; write {letter}",
            )
        return self._whole(block, letter, share.pop(letter, self.state.tool))

    def _diameter(self, block: Block, code: int) -> tuple[int | None, float]:
        """D number and diameter of G41 and G42: of the tool in the spindle, of the D word's, or D itself."""
        name = spell(code)
        if code in {411, 421}:
            return None, self._take(block, block.of(code), "D", f"{name} needs the diameter, D") * self.scale
        number = self._number(block, "D", code)
        if number not in self.diameters:
            raise fail(block.line, f"{name} D{number}: no tool of that number is known, so no diameter")
        return number, self.diameters[number]

    def _length_offset(self, block: Block) -> None:
        offset, length = self.state.length_offset, None
        for code in block.g:
            if code in GROUPS["length offset"]:
                self._without_compensation(block, spell(code))
        if 430 in block.g:
            offset = self._number(block, "H", 430)
        elif 431 in block.g:
            share = block.of(431)
            length = self._take(block, share, "Z", "G43.1 needs the length, Z") * self.scale
            if beside := sorted(share.keys() & {"X", "Y"}):
                raise fail(block.line, f"G43.1 takes Z alone; write {beside[0]} in a line of its own")
            offset = -1
        elif 490 in block.g:
            offset = 0
        else:
            return
        if (offset, length) != (self.state.length_offset, self.state.length):
            word = next(spell(code) for code in block.g if code in GROUPS["length offset"])
            if self.dialect.length_moves and (offset or self.state.length_offset):
                self._check_length_move(block, word)
            self._set(length_offset=offset, length=length)
            if math.isfinite(self.z) and not self.offsets_are_zero:
                self.lose(block.line, word, "Z")
                self.z = math.nan

    def _check_length_move(self, block: Block, word: str) -> None:
        """A length that comes or goes without a place of Z may be a move by that length."""
        named = "Z" in block.words and {280, 300}.isdisjoint(block.g)
        if named and (self.absolute or 530 in block.g):
            return
        remedy = (
            "write Z beside it, with G90"
            if word == "G43"
            else "leave it out where G28 of Z follows, or write it beside G53 Z0."
        )
        raise fail(
            block.line,
            f"{word} without a height to go to may move Z by the tool's length at once on "
            f"{self.dialect.name} ({self.dialect.length_moves}); {remedy}",
        )

    def _work_offset(self, block: Block) -> None:
        for code in block.g:
            if code not in GROUPS["work offset"]:
                continue
            name = spell(code)
            self._without_compensation(block, name)
            if code in EXTENDED or block.of(code):
                missing = f"{name} needs its number, P"
                number = self._whole(block, "P", self._take(block, block.of(code), "P", missing))
                name = f"{'G54.1' if code == 540 else name} P{number}"
            if name != self.state.work_offset:
                self._set(work_offset=name)
                self._lose_place(block.line, name)

    def _lose_place(self, line: int, word: str) -> None:
        """Offsets have changed: where the tool is, the text no longer says."""
        if self.offsets_are_zero:
            return
        self.lose(line, word)
        self.x = self.y = math.nan
        if math.isfinite(self.z):
            self.z = math.nan

    def _tables(self, block: Block) -> None:
        """G10 writes into the tables of offsets: whatever it changes, the positions are no longer known."""
        if 100 not in block.g:
            return
        self._without_compensation(block, "G10")
        words, tables = block.of(100), self.dialect.words.tables
        said = self._take(block, words, "L", "G10 needs L")
        table = next((table for table in tables if table.number == said), None)
        if table is None:
            known = ", ".join(f"L{table.number}" for table in tables)
            raise fail(block.line, f"G10 L{said:g}: {self.dialect.name} is known to read G10 with {known}")
        number = self._whole(block, "P", self._take(block, words, "P", "G10 needs P"))
        if not table.first <= number <= table.last:
            places = f"P{table.first} on" if math.isinf(table.last) else f"P{table.first} to P{table.last}"
            raise fail(block.line, f"G10 L{said:g} P{number}: {self.dialect.name} has {places}")
        values = {letter: words.pop(letter) * self.scale for letter in table.letters if letter in words}
        if not values:
            raise fail(block.line, f"G10 L{said:g} without a value; write one of {' '.join(table.letters)}")
        self.writes.append(TableWrite(self.steps, table.number, number, values, not self.absolute))
        self._row(Kind.TABLE, block.line, self.x, self.y, self.z)
        self._lose_place(block.line, "G10")
