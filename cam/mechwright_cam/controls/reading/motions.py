"""Moves that need more than a plain line says: polar places, arcs of every form, machine places, cycles."""

import math
from collections.abc import Collection

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading.arcs import centre_of
from mechwright_cam.controls.reading.blocks import POLAR, Block, fail
from mechwright_cam.controls.reading.modes import AXES, CENTRES, PLANES
from mechwright_cam.controls.reading.run import Kind, MachinePlace
from mechwright_cam.controls.reading.tapping import Tapping
from mechwright_cam.controls.words.groups import CYCLES, MOTIONS, TAPPING, spell

RETURN = 300
"""G30: to the second reference point."""
MOST_TURNS = 1000
"""Turns of one arc beyond which P is a slip of the pen."""
PLACES = POLAR | set(AXES)
"""Letters that say where to go."""
ARC_CHORD = 0.0005
"""Chord error of an arc in another plane than XY, mm: a tenth of the gouge limit."""


class Moving(Tapping):
    """A machine that moves."""

    sticky: dict[str, float]
    """Words of a drilling cycle that hold until the next cycle."""
    upper_end: float
    initial = math.nan
    """Height at which a cycle began, mm."""
    before_cycle: int | None = None
    """The motion that was in force there."""
    cancelled = False
    """Whether G80 is in force."""

    def _move(self, block: Block) -> None:
        codes = [code for code in block.g if code in MOTIONS]
        if codes:
            self.cancelled = 800 in codes
        if 800 in codes:  # where cycles are no motions, another one may stand beside it
            self.end_rigid()
            self.motion = self._without_cycle()
        named = next((code for code in codes if code != 800), None)
        if named is not None:
            if named not in TAPPING:
                self.end_rigid()
            if named in CYCLES and named != self.motion:
                self.sticky = {}
                if self.motion not in CYCLES:  # the next cycle goes back to where the first began
                    self.initial, self.before_cycle = self.z, self.motion
                self.motion = named
            else:
                self.motion = named
        if named == 10 and not self.feed > 0 and 530 not in block.g:
            raise fail(block.line, "G1 without a feed; write F above 0")
        words = block.of(self.motion) if self.motion is not None else {}
        axes = not words.keys().isdisjoint(PLACES)
        centre = self.motion in {20, 30} and not words.keys().isdisjoint("IJKR")
        if 530 in block.g:
            self._machine_move(block)
        elif axes or centre:
            if self.motion in CYCLES:
                if self.side or self.plane != 170:
                    raise fail(block.line, "a cycle is read in the XY plane and without compensation only")
                self._cycle(block, words, self.motion)
            elif self.motion in {20, 30}:
                self._arc(block, words)
            elif self.motion == 331:
                self.rigid_tap(block, words)
            else:
                x, y, z = self._target(block, words)
                if self.side:
                    kind = Kind.RAPID if self.motion == 0 else Kind.FEED
                    self.compensated(block.line, kind, x, y, z, None, False)
                elif self.motion == 0:
                    self._row(Kind.RAPID, block.line, x, y, z)
                else:
                    self._feed_to(block.line, x, y, z)
        elif named in CYCLES | {20, 30, 331}:
            raise fail(block.line, f"{spell(named or 0)} without an axis")
        elif named in {0, 10} and self.side:
            self.compensated(block.line, Kind.RAPID, *self.contour, self.z, None, False)

    def _without_cycle(self) -> int | None:
        """The motion that G80 leaves in force."""
        if not self.dialect.words.cycles_apart:
            return None
        return self.before_cycle if self.motion in CYCLES else self.motion

    def _home(self, block: Block) -> None:
        """G28 and G30: by way of a point in work coordinates to the machine's home; without axes all go."""
        code = 280 if 280 in block.g else RETURN
        name, words, row = spell(code), block.of(code), self.dialect.words.g[code]
        if self.side:
            raise fail(block.line, f"{name} while compensation is on; write G40 before")
        if self.motion in CYCLES and not row.in_cycles:
            raise fail(block.line, f"{name} while {spell(self.motion)} is in force; write G80 before")
        named = [axis for axis in AXES if axis in words]
        if not named and row.one_of:
            raise fail(block.line, f"{name} without an axis sends none home; write G91 {name} Z0")
        axes = named or list(AXES)
        if words.keys() & set(AXES):
            via = self._target(block, words)
            here = (self.x, self.y, self.z)
            if any(a != b and not (math.isnan(a) and math.isnan(b)) for a, b in zip(via, here, strict=True)):
                self._mark("X" in axes or "Y" in axes)
                self._row(Kind.RAPID, block.line, *via)
        self._home_axes(block.line, name, axes, math.inf)
        if "Z" in axes and name in self.dialect.stored_homes:
            self.stored.append((block.line, name))
        if "Z" in axes and self.dialect.home_cancels_length:
            self._set(length_offset=None, length=None)

    def _home_axes(self, line: int, name: str, axes: Collection[str], z: float) -> None:
        """Take some axes to places that the work does not know; of Z it may."""
        self.lose(line, name, "".join(axes))
        self._mark("X" in axes or "Y" in axes)
        x, y = (math.nan if axis in axes else here for axis, here in (("X", self.x), ("Y", self.y)))
        self._row(Kind.HOME, line, x, y, z if "Z" in axes else self.z)

    def _mark(self, machine_xy: bool) -> None:
        """Tell of the next step whether it takes X or Y to a place that the work does not know."""
        if machine_xy:
            self.machine_xy.append(self.steps)

    def _machine_move(self, block: Block) -> None:
        """G53: machine coordinates, whose place in the work the text does not know."""
        if self.motion not in {0, 10}:
            raise fail(block.line, "G53 needs G0 or G1")
        if self.side:
            raise fail(block.line, "G53 while compensation is on; write G40 before")
        if not self.absolute:
            raise fail(
                block.line, "G53 with distances (G91): some controls refuse or skip it; write G90 before"
            )
        words = block.of(530)
        axes = {axis: words.pop(axis) for axis in AXES if axis in words}
        if not axes:
            raise fail(block.line, "G53 without an axis")
        if self.motion == 10 and not self.feed > 0:
            raise fail(block.line, "a feed move without a feed; write F above 0")
        high = axes.get("Z", math.nan) * self.scale >= self.upper_end
        places = {axis: value * self.scale for axis, value in axes.items()}
        self.machine_places.append(MachinePlace(self.steps, places))
        self._home_axes(block.line, "G53", axes, math.inf if high else math.nan)

    def _target(self, block: Block, words: dict[str, float]) -> tuple[float, float, float]:
        here = {"X": self.x, "Y": self.y, "Z": self.z}
        if self.side:
            here["X"], here["Y"] = self.contour
        elif self.left is not None:
            here["X"], here["Y"] = self.left
            self.left = None
        if not words.keys().isdisjoint(POLAR):
            here["X"], here["Y"] = self._polar(block, words, here["X"], here["Y"])
        for axis in AXES:
            if axis not in words:
                continue
            value = words.pop(axis) * self.scale
            if self.absolute:
                here[axis] = value
            elif value != 0:
                if not math.isfinite(here[axis]):
                    raise self.astray(block.line, f"{axis} moves by a distance (G91)", axis)
                here[axis] += value
        return here["X"], here["Y"], here["Z"]

    def _polar(self, block: Block, words: dict[str, float], x: float, y: float) -> tuple[float, float]:
        """The place that @ (distance from X0 Y0) and ^ (angle) name; what is not named stays as it is."""
        if words.keys() & {"X", "Y"}:
            raise fail(block.line, "polar coordinates beside X or Y")
        if self.plane != 170:
            raise fail(block.line, "polar coordinates are read in the XY plane only (G17)")
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

    def _arc(self, block: Block, words: dict[str, float]) -> None:
        ccw = self.motion == 30
        axes = PLANES[self.plane]
        here = {"X": self.x, "Y": self.y, "Z": self.z}
        if self.side:
            here["X"], here["Y"] = self.contour
        elif self.left is not None:
            raise fail(block.line, "the move after compensation has ended (G40) is an arc; leave on a line")
        named = words.keys() & set(AXES)
        target = dict(zip(AXES, self._target(block, words), strict=True))
        start, end = ((place[axes[0]], place[axes[1]]) for place in (here, target))
        row = self.dialect.words.known[spell(self.motion or 0)]
        if row.ends_in_plane and not named & {axes[0], axes[1]}:
            raise fail(
                block.line,
                f"{self.dialect.name} takes no arc without {axes[0]} or {axes[1]}; write where it ends",
            )
        turns = self._whole(block, "P", words.pop("P", 1.0))
        if not 1 <= turns <= MOST_TURNS:
            raise fail(block.line, f"P is the number of turns, 1 to {MOST_TURNS}")
        first, second = CENTRES[axes[0]], CENTRES[axes[1]]
        if "R" in words:
            if words.keys() & {first, second}:
                raise fail(block.line, f"an arc has either R, or {first} and {second}")
            radius = words.pop("R") * self.scale
            try:
                centre = centre_of(start, end, radius, ccw, self.dialect.arcs.chord_slack)
            except ValueError as error:
                raise fail(block.line, str(error)) from None
        elif words.keys() & {first, second}:
            if self.absolute_centres and not {first, second} <= words.keys():
                raise fail(block.line, f"with G90.1 an arc needs both {first} and {second}")
            self.by_centre(block.line)
            i, j = words.pop(first, 0.0) * self.scale, words.pop(second, 0.0) * self.scale
            centre = (i, j) if self.absolute_centres else (start[0] + i, start[1] + j)
            idle = CENTRES[axes[2]]
            if row.across and words.get(idle) == 0:
                del words[idle]
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
            raise self.astray(line, "an arc")
        try:
            radius, _ = self._check_arc(line, start, end, centre)
        except ProgramError as error:
            raise ProgramError(
                f"{error}; it lies in the plane of {a} and {b} ({spell(self.plane)})"
            ) from None
        sweep = self._turn(line, start, end, centre, ccw)
        sweep += math.copysign(math.tau * (turns - 1), sweep)
        count = math.ceil(abs(sweep) / (2 * math.acos(max(1 - ARC_CHORD / radius, 0.0))))
        self.check_steps(line, count)
        angle = math.atan2(start[1] - centre[1], start[0] - centre[0])
        for number in range(1, count):
            share = number / count
            at = angle + sweep * share
            place = {a: centre[0] + radius * math.cos(at), b: centre[1] + radius * math.sin(at)}
            place[c] = here[c] + (target[c] - here[c]) * share
            self.pieces.append(self.steps)
            self._feed_to(line, place["X"], place["Y"], place["Z"])
        self._feed_to(line, target["X"], target["Y"], target["Z"])

    def _cycle(self, block: Block, words: dict[str, float], code: int) -> None:
        line, name = block.line, spell(code)
        if "return" not in self.state.stated:
            self.lacks(line, "return", "G98")
        if not self.absolute:
            raise fail(line, f"{name} with distances (G91) is not supported; write G90")
        row = self.dialect.words.known[name]
        asked = [letter for letter in "ZRQP" if letter in row.takes]
        if code in TAPPING:
            self.sticky.setdefault("P", 0.0)
        for letter in asked:  # what it does not ask for is left over, and refused
            if letter in words:
                time = (
                    self._waiting(block, words, "P", "") if letter == "P" else words.pop(letter) * self.scale
                )
                self.sticky[letter] = time
        if self.sticky.get("P", 0.0) < 0:
            raise fail(line, f"{name} waits for {self.sticky['P']:g} s; write P 0 or more")
        for letter in row.pointless:
            if (often := words.pop(letter, 1.0)) != 1:
                raise fail(
                    line,
                    f"{name} is run as often as {letter}{often:g} says, which is not read; write each hole",
                )
        polar = None if words.keys().isdisjoint(POLAR) else self._polar(block, words, self.x, self.y)
        here = {axis: words.pop(axis) * self.scale for axis in "XY" if axis in words}
        if polar is not None:
            here["X"], here["Y"] = polar
        x, y = here.get("X", self.x), here.get("Y", self.y)
        for letter in asked:
            if letter not in self.sticky:
                raise fail(line, f"{name} needs {letter}")
        bottom, plane = self.sticky["Z"], self.sticky["R"]
        if plane < bottom:
            raise fail(line, f"{name} has its R plane below the bottom of the hole")
        if math.isnan(self.initial) or math.isnan(x + y):
            raise self.astray(line, name)
        step = self.sticky.get("Q", math.inf) if code in {730, 830} else math.inf
        if not step > 0:
            raise fail(line, f"{name} needs Q above 0")
        if self.z < plane:
            self._rapid(line, self.x, self.y, plane)
        self._rapid(line, x, y, self.z)
        self._rapid(line, x, y, plane)
        up = max(self.initial, plane) if self.to_initial else plane
        if code in TAPPING:
            self.tap(line, code, bottom, up if self.dialect.taps_out else plane, self.sticky["P"])
            self._rapid(line, x, y, up)
            return
        self._drill(line, code, bottom, plane, step)
        if code in {820, 890}:
            seconds = self.sticky["P"]
            self._row(Kind.DWELL, line, x, y, self.z, seconds=seconds)
        if code in {850, 890}:
            # LinuxCNC feeds out to the R plane after G85, and all the way up after G89.
            self._feed_to(line, x, y, plane if code == 850 else up)
        self._rapid(line, x, y, up)
