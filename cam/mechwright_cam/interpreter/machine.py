"""The machine that runs the words.

Order of execution within a line and the meaning of each code follow RS274/NGC (Kramer, Proctor, Messina:
The NIST RS274NGC Interpreter, version 3, 2000, table 8) and LinuxCNC's documents.
"""

import math
import re
from collections.abc import Iterable, Mapping
from typing import Any

from mechwright_cam.interpreter.arcs import centre_of, sweep_of
from mechwright_cam.interpreter.blocks import NUMBER, POLAR, Block, fail, read_block
from mechwright_cam.interpreter.dialect import LINUXCNC, Dialect
from mechwright_cam.interpreter.groups import CYCLES, GROUPS, spell
from mechwright_cam.interpreter.macros import Macros, uses_macros
from mechwright_cam.interpreter.modes import CENTRES, PLANES, Modal
from mechwright_cam.interpreter.run import Kind, Remark, Run

MOST_TURNS = 1000
"""Turns of one arc beyond which P is a slip of the pen."""
CHORD = 0.0005
"""Chord error of an arc in another plane than XY, mm: a tenth of the gouge limit."""
HIGHEST_PARAMETER = 5000
"""Parameters beyond this are probe results, offsets and states of the machine."""
_AXES = "XYZ"
# A plain motion line in the order that posts write it. Nearly all lines are such; they skip the general path.
_PLAIN, _POINTED = (
    re.compile(
        r"(?:N\d+ ?)?(?:G0?([0-3]) ?)?"
        + "".join(rf"(?:{letter}({number}) ?)?" for letter in "XYZIJ")
        + rf"(?:F({NUMBER}) ?)?"
    )
    for number in (NUMBER, r"[+-]?(?:\d+\.\d*|\.\d+)")
)


def interpret(
    text: str,
    dialect: Dialect = LINUXCNC,
    *,
    block_delete: bool = False,
    upper_end: float = 0.0,
    diameters: Mapping[int, float] | None = None,
    start: tuple[float, float, float] | None = None,
) -> Run:
    r"""Run a program.

    Parameters
    ----------
    text
        The whole program.
    dialect
        The control that would read it.
    block_delete
        Whether lines that start with ``/`` are skipped.
    upper_end
        Machine Z of a full retract, mm: G53 to there or higher is at the machine's upper end.
    diameters
        D number to diameter, mm, for G41 and G42.
    start
        Where the tool stands at first, mm, if that is known; then all work offsets and lengths are taken
        for 0, as another simulator may do.

    Returns
    -------
    run
        All steps, in work coordinates.

    Raises
    ------
    ProgramError
        The control would stop, or this interpreter would have to guess. The message names the line.

    Examples
    --------
    >>> run = interpret("G21 G90 G17\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG2 X10 I5 J0\nM2")
    >>> run.end[-2].tolist(), run.ended
    ([10.0, 0.0, -1.0], True)
    """
    machine = _Machine(dialect, upper_end)
    machine.diameters = diameters or {}
    if start is not None:
        machine.x, machine.y, machine.z = start
        machine.offsets_are_zero = True
    plain = (_POINTED if dialect.point_needed else _PLAIN).fullmatch
    lines = text.replace("\r\n", "\n").split("\n")
    source: Iterable[tuple[int, str]] = enumerate(lines, start=1)
    if dialect.variables and uses_macros(text):
        source = Macros(lines, machine.system_value, machine.look_anew).run()
    percents = 0
    for number, raw in source:
        match = plain(raw) if len(raw) <= dialect.line_length else None
        if match is not None:
            if not raw or machine.run_plain(number, match.groups()):
                continue
        elif raw.strip() == "%" and dialect.percent:
            percents += 1
            if percents == 2:
                machine.ended = machine.ended or dialect.percent_ends
                break
            continue
        block = read_block(number, raw, dialect)
        if block.deleted and block_delete:
            continue
        machine.run(block)
        if machine.ended:
            break
    return machine.result(len(lines))


class _Machine(Modal):
    """The machine while a program runs; lengths in mm."""

    def __init__(self, dialect: Dialect, upper_end: float) -> None:
        super().__init__(dialect)
        self.upper_end = upper_end
        self.motion: int | None = None
        self.sticky: dict[str, float] = {}
        self.initial = math.nan

    def system_value(self, name: float | str) -> float:
        """A parameter that the machine keeps; numbered ones that nothing has set are 0."""
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
            if name in place:
                if not math.isfinite(value):
                    raise ValueError(f"#{name} is asked for, and the text does not say where the tool is")
                value /= self.scale
            return value
        if isinstance(name, str):
            raise ValueError(f"#<{name}> has no value")
        if name > HIGHEST_PARAMETER:
            raise ValueError(f"#{name:g} is kept by the machine, and not known here")
        return 0.0

    # -- motion lines -----------------------------------------------------------------------------------

    def run_plain(self, line: int, words: tuple[Any, ...]) -> bool:
        """Run a line of G0 to G3, X, Y, Z, I, J and F; False if it needs the general path."""
        g, x, y, z, i, j, f = words
        motion = self.motion if g is None else 10 * int(g)
        if (
            self.side
            or self.left is not None
            or self.plane != 170
            or not self.absolute
            or motion is None
            or motion > 30
            or (x is None and y is None and z is None)
        ):
            return False
        if motion >= 20:
            if i is None or j is None or self.absolute_centres:
                return False
        elif i is not None or j is not None:
            return False
        scale = self.scale
        if f is not None:
            self.feed = float(f) * scale
        self.motion = motion
        x = self.x if x is None else float(x) * scale
        y = self.y if y is None else float(y) * scale
        z = self.z if z is None else float(z) * scale
        if motion == 0:
            self._row(Kind.RAPID, line, x, y, z)
        elif motion == 10:
            self._feed_to(line, x, y, z)
        else:
            centre = (self.x + float(i) * scale, self.y + float(j) * scale)
            self._arc_to(line, x, y, z, centre, motion == 30)
        return True

    # -- any line ---------------------------------------------------------------------------------------

    def run(self, block: Block) -> None:
        """Run one block."""
        for comment in block.comments:
            self.remarks.append(Remark(block.line, comment, len(self.rows)))
        if not (block.g or block.m or block.words):
            return
        self._check_codes(block)
        words = block.words
        self._units(block)  # first, so that every length of this line is read in the units it states
        self._speeds(block, words)
        self._tool(block, words)
        self._spindle_and_coolant(block)
        if 40 in block.g:
            seconds = self._waiting(block, words)
            if seconds < 0:
                raise fail(block.line, f"G4 waits for {seconds:g} s; write P 0 or more")
            self._row(Kind.DWELL, block.line, self.x, self.y, self.z, seconds=seconds)
        self._modes(block, words)
        self._length_offset(block, words)
        self._work_offset(block, words)
        self._tables(block, words)
        self._keep_state()
        if 280 in block.g or 300 in block.g:
            self._home(block, words)
        self._move(block, words)
        if words:
            raise fail(block.line, f"{next(iter(words))} means nothing in this line")
        self._stop(block)

    def _waiting(self, block: Block, words: dict[str, float]) -> float:
        """The time of G4, s."""
        bare, unit = self.dialect.bare_dwell_unit, self.dialect.dwell_unit
        if bare is not None and "X" in words:
            return words.pop("X") * (bare if "X" in block.bare else unit)
        seconds = self._take(block, "P", "G4 needs a time, P")
        return seconds * (bare if bare is not None and "P" in block.bare else unit)

    def _check_codes(self, block: Block) -> None:
        for code in block.g:
            if code in self.dialect.g_codes:
                continue
            letters = dict(self.dialect.inert).get(code)
            if letters is not None:
                for letter in letters:
                    block.words.pop(letter, None)
                continue
            for refused, remedy in self.dialect.unsupported:
                if code == refused:
                    raise fail(block.line, f"{spell(code)} is not supported; {remedy}")
            raise fail(block.line, f"{spell(code)} is no code that {self.dialect.name} is known to read")
        for code in block.m:
            if code not in self.dialect.m_codes | self.dialect.inert_m:
                raise fail(block.line, f"M{code} is no code that {self.dialect.name} is known to read")

    def _home(self, block: Block, words: dict[str, float]) -> None:
        """G28 and G30: by way of a point in work coordinates to the machine's home; without axes all go."""
        axes = [axis for axis in _AXES if axis in words] or list(_AXES)
        if words.keys() & set(_AXES):
            via = self._target(block, words)
            here = (self.x, self.y, self.z)
            if any(a != b and not (math.isnan(a) and math.isnan(b)) for a, b in zip(via, here, strict=True)):
                self._row(Kind.RAPID, block.line, *via)
        self._row(
            Kind.HOME,
            block.line,
            math.nan if "X" in axes else self.x,
            math.nan if "Y" in axes else self.y,
            math.inf if "Z" in axes else self.z,
        )
        if "Z" in axes and self.dialect.home_cancels_length:
            self._set(length_offset=None, length=None)

    def _target(self, block: Block, words: dict[str, float]) -> tuple[float, float, float]:
        here = {"X": self.x, "Y": self.y, "Z": self.z}
        if self.side:
            here["X"], here["Y"] = self.contour
        elif self.left is not None:
            here["X"], here["Y"] = self.left
            self.left = None
        if words.keys() & POLAR:
            here["X"], here["Y"] = self._polar(block, words, here["X"], here["Y"])
        for axis in _AXES:
            if axis not in words:
                continue
            value = words.pop(axis) * self.scale
            if self.absolute:
                here[axis] = value
            elif value != 0:
                if not math.isfinite(here[axis]):
                    raise fail(block.line, f"{axis} moves by a distance (G91) from an unknown position")
                here[axis] += value
        return here["X"], here["Y"], here["Z"]

    def _polar(self, block: Block, words: dict[str, float], x: float, y: float) -> tuple[float, float]:
        """The place that @ (distance from X0 Y0) and ^ (angle) name; what is not named stays as it is."""
        if words.keys() & {"X", "Y"}:
            raise fail(block.line, "polar coordinates beside X or Y")
        if not math.isfinite(x + y) or (math.hypot(x, y) == 0 and not {"@", "^"} <= words.keys()):
            raise fail(block.line, "polar coordinates from a place without a direction")
        radius, angle = math.hypot(x, y), math.atan2(y, x)
        if "@" in words:
            named = words.pop("@") * self.scale
            radius = named if self.absolute else radius + named
        if "^" in words:
            turn = math.radians(words.pop("^"))
            angle = turn if self.absolute else angle + turn
        return radius * math.cos(angle), radius * math.sin(angle)

    def _move(self, block: Block, words: dict[str, float]) -> None:
        named = next((code for code in block.g if code in GROUPS["motion"]), None)
        if named is not None:
            if named == 800:
                self.motion = None
            elif named in CYCLES and named != self.motion:
                self.sticky = {}
                self.initial = self.z
                self.motion = named
            else:
                self.motion = named
        axes = words.keys() & (set(_AXES) | POLAR)
        centre = words.keys() & {"I", "J", "K", "R"} if self.motion in {20, 30} else set()
        if 530 in block.g:
            self._machine_move(block, words)
        elif axes or centre:
            if self.motion is None:
                raise fail(block.line, "an axis without a motion; write G0, G1, G2, G3 or a cycle")
            if self.motion in CYCLES:
                if self.side or self.plane != 170:
                    raise fail(block.line, "a cycle is read in the XY plane and without compensation only")
                self._cycle(block, words, self.motion)
            elif self.motion in {20, 30}:
                self._arc(block, words)
            else:
                x, y, z = self._target(block, words)
                if self.side:
                    kind = Kind.RAPID if self.motion == 0 else Kind.FEED
                    self.compensated(block.line, kind, x, y, z, None, False)
                elif self.motion == 0:
                    self._row(Kind.RAPID, block.line, x, y, z)
                else:
                    self._feed_to(block.line, x, y, z)
        elif named in CYCLES | {20, 30}:
            raise fail(block.line, f"{spell(named or 0)} without an axis")

    def _machine_move(self, block: Block, words: dict[str, float]) -> None:
        """G53: machine coordinates, whose place in the work the text does not know."""
        if self.motion not in {0, 10}:
            raise fail(block.line, "G53 needs G0 or G1")
        if self.side:
            raise fail(block.line, "G53 while compensation is on; write G40 before")
        axes = {axis: words.pop(axis) for axis in _AXES if axis in words}
        if not axes:
            raise fail(block.line, "G53 without an axis")
        x = math.nan if "X" in axes else self.x
        y = math.nan if "Y" in axes else self.y
        z = self.z
        if "Z" in axes:
            z = math.inf if axes["Z"] * self.scale >= self.upper_end else math.nan
        self._row(Kind.HOME, block.line, x, y, z)

    def _arc(self, block: Block, words: dict[str, float]) -> None:
        ccw = self.motion == 30
        axes = PLANES[self.plane]
        here = {"X": self.x, "Y": self.y, "Z": self.z}
        if self.side:
            here["X"], here["Y"] = self.contour
        target = dict(zip(_AXES, self._target(block, words), strict=True))
        start, end = ((place[axes[0]], place[axes[1]]) for place in (here, target))
        turns = self._whole(block, "P", words.pop("P", 1.0))
        if not 1 <= turns <= MOST_TURNS:
            raise fail(block.line, f"P is the number of turns, 1 to {MOST_TURNS}")
        first, second = CENTRES[axes[0]], CENTRES[axes[1]]
        if "R" in words:
            if words.keys() & {first, second}:
                raise fail(block.line, f"an arc has either R, or {first} and {second}")
            radius = words.pop("R") * self.scale
            try:
                centre = centre_of(start, end, radius, ccw, self.dialect.arc_absolute)
            except ValueError as error:
                raise fail(block.line, str(error)) from None
        elif words.keys() & {first, second}:
            if self.absolute_centres and not {first, second} <= words.keys():
                raise fail(block.line, f"with G90.1 an arc needs both {first} and {second}")
            i, j = words.pop(first, 0.0) * self.scale, words.pop(second, 0.0) * self.scale
            centre = (i, j) if self.absolute_centres else (start[0] + i, start[1] + j)
        else:
            raise fail(block.line, f"an arc without a centre; write {first} and {second}, or R")
        if self.side:
            if turns > 1:
                raise fail(block.line, "several turns while compensation is on; write one after the other")
            self.compensated(block.line, Kind.ARC, end[0], end[1], target["Z"], centre, ccw)
        elif self.plane == 170:
            self._arc_to(block.line, target["X"], target["Y"], target["Z"], centre, ccw, turns)
        else:
            self._arc_in_pieces(block.line, here, target, centre, ccw, turns)

    def _arc_in_pieces(
        self,
        line: int,
        here: dict[str, float],
        target: dict[str, float],
        centre: tuple[float, float],
        ccw: bool,
        turns: int,
    ) -> None:
        """An arc in the ZX or YZ plane, as short straight moves: the proof looks from above."""
        a, b, c = tuple(PLANES[self.plane])
        start, end = (here[a], here[b]), (target[a], target[b])
        if not all(map(math.isfinite, (*here.values(), *target.values()))):
            raise fail(line, "an arc from an unknown position; move to X, Y and Z first")
        radius = self._check_arc(line, start, end, centre)
        sweep = sweep_of(start, end, centre, ccw)
        sweep += math.copysign(math.tau * (turns - 1), sweep)
        count = math.ceil(abs(sweep) / (2 * math.acos(max(1 - CHORD / radius, 0.0))))
        angle = math.atan2(start[1] - centre[1], start[0] - centre[0])
        for number in range(1, count):
            share = number / count
            at = angle + sweep * share
            place = {a: centre[0] + radius * math.cos(at), b: centre[1] + radius * math.sin(at)}
            place[c] = here[c] + (target[c] - here[c]) * share
            self.pieces.append(len(self.rows))
            self._feed_to(line, place["X"], place["Y"], place["Z"])
        self._feed_to(line, target["X"], target["Y"], target["Z"])

    def _cycle(self, block: Block, words: dict[str, float], code: int) -> None:
        line, name = block.line, spell(code)
        if not self.absolute:
            raise fail(line, f"{name} with distances (G91) is not supported; write G90")
        for letter in "ZRQP":
            if letter in words:
                bare, unit = self.dialect.bare_dwell_unit, self.dialect.dwell_unit
                time = bare if bare is not None and letter in block.bare else unit
                self.sticky[letter] = words.pop(letter) * (time if letter == "P" else self.scale)
        here = {axis: words.pop(axis) * self.scale for axis in "XY" if axis in words}
        if words.keys() & POLAR:
            here["X"], here["Y"] = self._polar(block, words, self.x, self.y)
        x, y = here.get("X", self.x), here.get("Y", self.y)
        for letter in "ZR" + ("Q" if code in {730, 830} else "") + ("P" if code in {820, 890} else ""):
            if letter not in self.sticky:
                raise fail(line, f"{name} needs {letter}")
        bottom, plane = self.sticky["Z"], self.sticky["R"]
        if plane < bottom:
            raise fail(line, f"{name} has its R plane below the bottom of the hole")
        if math.isnan(self.initial) or math.isnan(x + y):
            raise fail(line, f"{name} from an unknown position; move to X, Y and Z first")
        step = self.sticky.get("Q", math.inf) if code in {730, 830} else math.inf
        if not step > 0:
            raise fail(line, f"{name} needs Q above 0")
        if self.z < plane:
            self._rapid(line, self.x, self.y, plane)
        self._rapid(line, x, y, self.z)
        self._rapid(line, x, y, plane)
        up = max(self.initial, plane) if self.to_initial else plane
        self._drill(line, code, bottom, plane, step)
        if code in {820, 890}:
            seconds = self.sticky["P"]
            self._row(Kind.DWELL, line, x, y, self.z, seconds=seconds)
        if code in {850, 890}:
            # LinuxCNC feeds out to the R plane after G85, and all the way up after G89.
            self._feed_to(line, x, y, plane if code == 850 else up)
        self._rapid(line, x, y, up)

    def _stop(self, block: Block) -> None:
        for code in block.m:
            if code in {0, 1}:
                by_hand = self.dialect.tool_by_t and self.rows and self.rows[-1][0] == Kind.TOOL
                self._row(Kind.MAYBE if code else Kind.STOP, block.line, self.x, self.y, self.z)
                if by_hand:  # whoever has touched the tool off has left it somewhere
                    self._lose_place()
                    self.z = math.nan
            elif code in {2, 30}:
                self._row(Kind.END, block.line, self.x, self.y, self.z)
                self.ended = True
