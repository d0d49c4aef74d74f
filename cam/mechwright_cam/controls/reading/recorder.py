"""The record that a run leaves: positions, and one row for each step."""

import math
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading.arcs import sweep_of
from mechwright_cam.controls.reading.blocks import fail
from mechwright_cam.controls.reading.run import (
    COLUMNS,
    WIDTH,
    Kind,
    MachinePlace,
    Remark,
    Run,
    Selection,
    SpindleChange,
    State,
    TableWrite,
)
from mechwright_cam.controls.words.groups import spell
from mechwright_cam.controls.words.kept import Then

MOST_PECKS = 10_000
"""Pecks of one hole beyond which Q is a slip of the pen."""
MOST_STEPS = 500_000
"""Moves of a program beyond which it is refused: no proof of more ends in time and memory."""
LARGEST = 1e5
"""Coordinates and radii beyond this are a slip of the pen, mm: no machine is 100 m long."""


class Recorder:
    """Position and feed, and the steps so far; lengths in mm."""

    def __init__(self, dialect: Dialect) -> None:
        self.dialect = dialect
        self.x = self.y = self.z = math.nan
        self.lost: dict[str, tuple[int, str]] = {}
        """Axis to the line and the word that last left it where the text does not say."""
        self.feed = 0.0
        self.scale = 1.0
        """Length of a unit of the program, mm."""
        self.ended = False
        self.states: list[State] = [State(off_path=dialect.corners.unsaid)]
        self.known = {self.states[0]: self.states[0]}
        """Every state that has been, each once: those that come again are the same object."""
        self.numbers = {id(self.states[0]): 0}
        """Which of the states each is, by its identity."""
        self.index = 0
        self.tables: list[Array] = []
        self.rows: list[tuple[float, ...]] = []
        """Steps since the last table."""
        self.unsaid: list[tuple[int, str]] = []
        """Lines that go as an earlier program may have said, and the word that says it anew."""
        self.hoped: list[tuple[int, str]] = []
        """The same where the control begins with the word, unless an earlier program has left another."""
        self.stored: list[tuple[int, str]] = []
        """Lines that take Z to a place that is stored in the control, and their words."""
        self.before = 0
        """Number of steps in all tables."""
        self.pieces: list[int] = []
        self.machine_xy: list[int] = []
        self.writes: list[TableWrite] = []
        self.machine_places: list[MachinePlace] = []
        self.selections: list[Selection] = []
        self.spindle_changes: list[SpindleChange] = []
        self.remarks: list[Remark] = []

    def _row(
        self,
        kind: Kind,
        line: int,
        x: float,
        y: float,
        z: float,
        *,
        feed: float = 0.0,
        seconds: float = 0.0,
        arc: tuple[float, float, float, float] = (math.nan, math.nan, 0.0, 0.0),
    ) -> None:
        self.rows.append((kind, line, self.x, self.y, self.z, x, y, z, *arc, feed, seconds, self.index))
        self.x, self.y, self.z = x, y, z

    def lose(self, line: int, word: str, axes: str = "XYZ") -> None:
        """Remember which word of a line takes axes from known places to where the text does not say."""
        known = [axis for axis in axes if not math.isnan(getattr(self, axis.lower()))]
        self.lost |= dict.fromkeys(known, (line, word))

    def astray(self, line: int, what: str, axes: str = "XYZ") -> ProgramError:
        """The error of something that has to begin at a known place, with the line after which it is none."""
        unknown = [axis for axis in axes if not math.isfinite(getattr(self, axis.lower()))]
        since = ""
        if unknown and self.lost.keys() >= set(unknown):
            number, word = max(self.lost[axis] for axis in unknown)
            # The words of a program in another language are none of these.
            since = f", unknown since {f'{word} in ' if self.dialect.translate is None else ''}line {number}"
        places = " and ".join(filter(None, (", ".join(axes[:-1]), axes[-1])))
        return fail(line, f"{what} from an unknown position{since}; move to {places} first")

    def lacks(self, line: int, state: str, word: str) -> None:
        """Tell that a line hangs on a state that the program has not set, and the word that sets it."""
        then = self.dialect.then(state)
        if then in {Then.REFUSED, Then.TOLD}:
            (self.hoped if then is Then.TOLD else self.unsaid).append((line, word))

    @property
    def steps(self) -> int:
        """Number of steps so far."""
        return self.before + len(self.rows)

    def check_steps(self, line: int, more: int = 0) -> None:
        """Raise ProgramError if the program, with so many more steps, makes more than any should."""
        if self.steps + more > MOST_STEPS:
            raise fail(line, f"more than {MOST_STEPS} moves; split the program")

    def append(self, table: Array) -> None:
        """Record steps (k, 15), as COLUMNS has them; the tool is where the last of them ends."""
        self._close()
        self.tables.append(table)
        self.before += len(table)
        self.x, self.y, self.z = table[-1, 5:8].tolist()

    def _close(self) -> None:
        """Turn the rows so far into a table."""
        if self.rows:
            self.tables.append(np.array(self.rows, dtype=np.float64))
            self.before += len(self.rows)
            self.rows = []

    def _rapid(self, line: int, x: float, y: float, z: float) -> None:
        if (x, y, z) != (self.x, self.y, self.z):
            self._row(Kind.RAPID, line, x, y, z)

    def _feed_to(self, line: int, x: float, y: float, z: float) -> None:
        if not self.feed > 0:
            raise fail(line, "a feed move without a feed; write F above 0")
        self._row(Kind.FEED, line, x, y, z, feed=self.feed)

    def _arc_to(
        self, line: int, x: float, y: float, z: float, centre: tuple[float, float], ccw: bool, turns: int = 1
    ) -> None:
        if not self.feed > 0:
            raise fail(line, "a feed move without a feed; write F above 0")
        if not (math.isfinite(self.x + self.y + self.z) and math.isfinite(x + y + z)):
            raise self.astray(line, "an arc")
        here = (self.x, self.y)
        _, error = self._check_arc(line, here, (x, y), centre)
        sweep = self._turn(line, here, (x, y), centre, ccw)
        sweep += math.copysign(math.tau * (turns - 1), sweep)
        self._row(Kind.ARC, line, x, y, z, feed=self.feed, arc=(*centre, sweep, error))

    def _turn(
        self,
        line: int,
        start: tuple[float, float],
        end: tuple[float, float],
        centre: tuple[float, float],
        ccw: bool,
    ) -> float:
        """Signed angle of an arc, rad, as :func:`sweep_of` gives it.

        Raises ProgramError if the control takes it for a full circle.
        """
        sweep = sweep_of(start, end, centre, ccw)
        if abs(sweep) < self.dialect.arcs.least_turn:
            raise fail(
                line,
                f"the arc turns by {abs(sweep):.1g} rad; {self.dialect.name} takes an arc below "
                f"{self.dialect.arcs.least_turn:g} rad for a full circle; write a line (G1)",
            )
        return sweep

    def _check_arc(
        self, line: int, start: tuple[float, float], end: tuple[float, float], centre: tuple[float, float]
    ) -> tuple[float, float]:
        """Give an arc's radius at its start, and by how much it differs at its end, mm.

        Raises ProgramError if the control refuses the arc.
        """
        first, last = math.dist(start, centre), math.dist(end, centre)
        error = abs(first - last)
        if min(first, last) <= self.dialect.arcs.least:
            raise fail(line, f"an arc of radius {min(first, last):.4g}")
        if self.dialect.arcs.refuses(first, last, self.scale != 1.0):
            raise fail(
                line,
                f"the arc ends {error:.4f} mm nearer or further from its centre than it starts "
                f"(radius {first:.4f} mm); {self.dialect.name} refuses it",
            )
        return first, error

    def _drill(self, line: int, code: int, bottom: float, plane: float, step: float) -> None:
        """Feed to the bottom, in steps where the cycle pecks (G83) or breaks the chip (G73)."""
        x, y, gap = self.x, self.y, self.dialect.peck_clearance
        if plane - bottom > MOST_PECKS * step:
            raise fail(line, f"{spell(code)} would peck more than {MOST_PECKS} times; Q is too small")
        if math.isfinite(step):
            self.check_steps(line, 3 * int((plane - bottom) / step))
        depth = plane - step
        while depth > bottom:
            self._feed_to(line, x, y, depth)
            if code == 830:
                self._rapid(line, x, y, plane)
            self._rapid(line, x, y, depth + gap)
            depth -= step
        self._feed_to(line, x, y, bottom)

    def result(self, lines: int) -> Run:
        """The record of the whole run."""
        self._close()
        table = np.concatenate((np.empty((0, WIDTH)), *self.tables))
        places = np.abs(table[:, 2:10])
        beyond = np.flatnonzero(((places > LARGEST) & np.isfinite(places)).any(axis=1))
        if beyond.size:
            line = int(table[beyond[0], 1])
            raise fail(
                line, f"a coordinate or an arc's centre is beyond {LARGEST / 1000:g} m; that is no move"
            )
        columns: dict[str, Any] = {name: table[:, at].copy() for name, at in COLUMNS.items()}
        for name in ("kind", "line", "state"):
            columns[name] = columns[name].astype(np.int64)
        if self.dialect.then("feed mode") in {Then.REFUSED, Then.TOLD}:
            said = np.array(["feed mode" in state.stated for state in self.states])[columns["state"]]
            fed = np.isin(columns["kind"], (Kind.FEED, Kind.ARC)) & ~said
            for line in columns["line"][fed][:1].tolist():
                self.lacks(line, "feed mode", "G94")
        return Run(
            **columns,
            states=tuple(self.states),
            remarks=tuple(self.remarks),
            ended=self.ended,
            lines=lines,
            unsaid=min(self.unsaid, default=None),
            stored=min(self.stored, default=None),
            hoped=min(self.hoped, default=None),
            piece=np.isin(np.arange(len(table)), self.pieces),
            machine_xy=np.isin(np.arange(len(table)), self.machine_xy),
            writes=tuple(self.writes),
            machine_places=tuple(self.machine_places),
            selected=tuple(self.selections),
            spindle_changes=tuple(self.spindle_changes),
        )
