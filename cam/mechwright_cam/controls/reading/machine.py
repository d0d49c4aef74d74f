"""The machine that runs the words.

Order of execution within a line and the meaning of each code follow RS274/NGC (Kramer, Proctor, Messina:
The NIST RS274NGC Interpreter, version 3, 2000, table 8) and LinuxCNC's documents.
"""

import math
from collections.abc import Mapping

from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading.blocks import POLAR, Block, check_points, fail, no_code
from mechwright_cam.controls.reading.groups import EXTENDED, GROUPS, STOPPING, TAPPING, spell
from mechwright_cam.controls.reading.motions import PLACES, Moving
from mechwright_cam.controls.reading.run import Kind, Remark, SpindleChange

MOTIONS = GROUPS["motion"]
TAKERS = {"P": frozenset({40, 100, 640}) | EXTENDED, "Q": frozenset({640})}
"""Codes, other than motions, that take a letter which motions take as well."""
MOTION_TAKERS = {"P": frozenset({20, 30, 820, 890}) | TAPPING, "Q": frozenset({730, 830})}
"""The motions that take it; of arcs those of controls on which P is the number of turns."""
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
        self.usual: set[tuple[int, ...]] = set()
        """Codes of blocks, G, 0 and M, that are known to go together on this control."""

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
        codes = (*block.g, 0, *block.m)
        if codes not in self.usual:
            self._check_codes(block)
            if not self.dialect.inert_g & set(block.g):  # their letters are taken out each time
                self.usual.add(codes)
        words, before, contour = block.words, self.state, self.contour
        if not words.keys().isdisjoint(PLACES):
            self._check_axes(block)
        self._units(block)  # first, so that every length of this line is read in the units it states
        if self.dialect.point_needed and block.bare:
            check_points(block, self.dialect, inches=self.scale != 1.0)
        if "F" in words and (331 in block.g or (self.motion == 331 and "K" in words)):
            raise fail(block.line, "G33.1 with F, which the spindle gives there; leave it out")
        self._speeds(block, words)
        self._tool(block, words)
        if block.m:
            self._spindle_and_coolant(block)
        if self.state is not before and self.state.spindle_rotation != before.spindle_rotation:
            place = self.x, self.y, self.z
            self.spindle_changes.append(SpindleChange(block.line, before.tool, place, self.steps))
            if self.state.spindle_rotation and not self.dialect.starts_first and self._feeds(block):
                word = f"M{self.dialect.m(3 if self.state.spindle_rotation > 0 else 4)}"
                raise fail(
                    block.line,
                    f"{word} beside a feed: whether {self.dialect.name} starts the spindle before it, the "
                    f"machine's builder has set; write {word} in a line before",
                )
        if not words.keys().isdisjoint("PQ") and block.g:
            self._check_shared(block)
        if 40 in block.g:
            self._check_dwell(block)
            bare_x = self.dialect.bare_dwell_unit is not None and "X" in words
            seconds = self._waiting(block, "X" if bare_x else "P", "G4 needs a time, P")
            if seconds < 0:
                raise fail(block.line, f"G4 waits for {seconds:g} s; write P 0 or more")
            self._row(Kind.DWELL, block.line, self.x, self.y, self.z, seconds=seconds)
        if not MOTIONS.issuperset(block.g):
            self._modes(block, words)
            self._length_offset(block)
            self._work_offset(block, words)
            self._tables(block, words)
        self.keep_state()
        if 280 in block.g or 300 in block.g:
            self._home(block, words)
        self._move(block, words)
        self._check_idle(block.line, contour)
        if words:
            raise fail(block.line, f"{next(iter(words))} means nothing in this line")
        self._stop(block)

    def _check_axes(self, block: Block) -> None:
        """Refuse axis words that the control drops, or takes for an error, in the state it is in."""
        polar = next((letter for letter in block.words if letter in POLAR), "")
        if polar and not self.dialect.axis_commands.isdisjoint(block.g):
            raise fail(block.line, f"{polar} means nothing in this line")
        named = [code for code in block.g if code in MOTIONS]
        dropping = next((code for code in block.g if code in self.dialect.drops_axes), None)
        if dropping is not None:
            raise fail(
                block.line,
                f"{self.dialect.name} drops X, Y and Z beside {spell(dropping)}; write "
                f"{spell(dropping)} in a line of its own",
            )
        if self.dialect.motion_for_axes and (800 in named or (self.cancelled and not named)):
            raise fail(
                block.line,
                f"{self.dialect.name} takes no X, Y or Z while G80 is in force; write G0 in a line before",
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

    def _moving(self, block: Block) -> int | None:
        """The motion that a block makes, named in it or in force; None if nothing moves."""
        if not self.dialect.axis_commands.isdisjoint(block.g):
            return None
        letters = set("XYZIJKR") | POLAR
        if 40 in block.g and self.dialect.bare_dwell_unit is not None and "P" not in block.words:
            letters.discard("X")  # the time
        named = next((code for code in block.g if code in MOTIONS - {800}), None)
        return self.motion if named is None and not block.words.keys().isdisjoint(letters) else named

    def _check_dwell(self, block: Block) -> None:
        """Refuse a dwell beside a move where nothing says which comes first."""
        motion = self._moving(block)
        if motion is not None and not self.dialect.dwells_first:
            why = "which of them comes first, nothing says"
            raise fail(block.line, f"G4 beside {spell(motion)}: {why}; write each in a line of its own")

    def _check_shared(self, block: Block) -> None:
        """Refuse a P or a Q that two codes of a block would take."""
        takers = {letter: set(block.g) & codes for letter, codes in TAKERS.items()}
        if not self.dialect.corners.tolerance:
            takers = {letter: codes - {640} for letter, codes in takers.items()}
        motion = self._moving(block)
        for letter, motions in MOTION_TAKERS.items():
            if motion in motions and (motion not in {20, 30} or self.dialect.arc_turns):
                takers[letter].add(motion)
        for letter, codes in takers.items():
            if letter in block.words and len(codes) > 1:
                first, second = map(spell, sorted(codes, key=lambda code: (code in MOTIONS, code))[:2])
                raise fail(
                    block.line,
                    f"{first} beside {second}: both take {letter}; write each in a line of its own",
                )

    def _feeds(self, block: Block) -> bool:
        """Whether a block moves at a feed."""
        named = next((code for code in block.g if code in GROUPS["motion"] - {800}), self.motion)
        return named not in {None, 0} and 530 not in block.g and not block.words.keys().isdisjoint("XYZ")

    def _check_codes(self, block: Block) -> None:
        for code in block.g:
            if code in self.dialect.g_codes:
                continue
            letters = dict(self.dialect.inert).get(code)
            if letters is not None:
                if code in self.dialect.inert_with and letters[0] not in block.words:
                    raise fail(block.line, f"{spell(code)} needs {letters[0]}")
                self._check_looser(block, code)
                for letter in letters:
                    block.words.pop(letter, None)
                continue
            for refused, remedy in self.dialect.unsupported:
                if code == refused:
                    raise fail(block.line, f"{spell(code)} is not supported; {remedy}")
            raise fail(block.line, no_code(spell(code), self.dialect))
        self._check_together(block)
        for code in block.m:
            if code not in self.dialect.m_codes | self.dialect.inert_m:
                raise fail(block.line, no_code(f"M{code}", self.dialect))

    def _check_together(self, block: Block) -> None:
        """Refuse codes that the control does not take in one line."""
        if not self.dialect.both_coolants and {7, 8} <= set(block.m):
            raise fail(block.line, f"M7 and M8 in one line; {self.dialect.name} wants a line for each")
        motion = [code for code in block.g if code in GROUPS["motion"] - {800}]
        takers = motion + [code for code in block.g if code in self.dialect.axis_commands]
        if len(takers) > 1:
            names = f"{spell(takers[0])} and {spell(takers[1])}"
            raise fail(block.line, f"{names} both take the axes; write a line for each")

    def _check_looser(self, block: Block, code: int) -> None:
        """Refuse a word that lets the control leave the path further than its setting."""
        for looser, letter, kept, remedy in self.dialect.corners.looser:
            value = block.words.get(letter)
            if code == looser and value is not None and value not in kept:
                raise fail(
                    block.line,
                    f"{spell(code)} {letter}{value:g} lets {self.dialect.name} round corners further than "
                    f"the setting of the machine; {remedy}",
                )

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
