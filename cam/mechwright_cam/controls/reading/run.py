"""What the interpreter gives back: steps as arrays, and the machine states they ran in."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

Ints = NDArray[np.int64]
Coolant = Literal["off", "mist", "flood", "both"]


class Kind(IntEnum):
    """Kinds of step."""

    RAPID = 0
    FEED = 1
    ARC = 2
    HOME = 3
    """A rapid in machine coordinates (G53, G28)."""
    DWELL = 4
    TOOL = 5
    """A tool change."""
    STOP = 6
    """M0."""
    END = 7
    MAYBE = 8
    """M1: a stop if the operator has switched it on."""
    TABLE = 9
    """G10: the program writes into a table of the control."""


@dataclass(frozen=True, slots=True)
class State:
    """Everything modal that the proof asks about."""

    tool: int = 0
    """T number in the spindle, 0 for none."""
    length_offset: int | None = None
    """Active H number; 0 after G49, -1 after G43.1, None if the program never said."""
    length: float | None = None
    """The length that G43.1 gave, mm; None without one."""
    work_offset: str | None = None
    """``"G54"`` to ``"G59.3"``, ``"G54.1 P7"``, ``"G154 P7"``; None if the program never said."""
    spindle: int = 0
    """1 clockwise, -1 counter-clockwise, 0 stopped."""
    rpm: float = 0.0
    """Programmed speed, rev/min."""
    synchronous: bool = False
    """Whether the control keeps feed and spindle together, as in rigid tapping."""
    coolant: Coolant = "off"
    """What runs."""
    side: int = 0
    """1 with cutter compensation on the left of the contour (G41), -1 on the right, 0 without."""
    diameter_offset: int | None = None
    """D number of that; None without compensation, or if the program gives the diameter itself."""
    stated: frozenset[str] = frozenset()
    """The groups of the safe start (``"units"``, ``"distance"``, ``"plane"``, ``"cutter compensation"``,
    ``"feed mode"``, ``"return"``, ``"centres"``) that the program has set itself.
    """
    off_path: float = 0.0
    """How far the control may leave the programmed path between two moves, mm; inf without a bound."""
    path_mode: int = 0
    """G code in tenths of how corners are taken: 610, 611 or 640; 0 if the program never said."""
    blend: float = 0.0
    """What of ``off_path`` is for rounding corners, mm; 0 in an exact mode."""

    @property
    def spindle_rotation(self) -> int:
        """1 or -1 while the spindle turns, as ``spindle`` has it; 0 also at a speed of 0."""
        return self.spindle if self.rpm > 0 else 0


COLUMNS: dict[str, int | slice] = {
    "kind": 0,
    "line": 1,
    "start": slice(2, 5),
    "end": slice(5, 8),
    "centre": slice(8, 10),
    "sweep": 10,
    "arc_error": 11,
    "feed": 12,
    "seconds": 13,
    "state": 14,
}
"""What a step of a run is recorded by: where it stands in a row."""
WIDTH = 15
"""Numbers in such a row."""


@dataclass(frozen=True, slots=True)
class Remark:
    """A comment: its line, its text, and the number of steps before it."""

    line: int
    text: str
    step: int


@dataclass(frozen=True, slots=True)
class TableWrite:
    """What one G10 writes: its step, L and P, its axes and R by letter (mm), and whether G91 was in force."""

    step: int
    table: int
    number: int
    values: Mapping[str, float]
    incremental: bool


@dataclass(frozen=True, slots=True)
class MachinePlace:
    """Where a move in machine coordinates goes: its step, and the axes that it names, mm."""

    step: int
    axes: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class SpindleChange:
    """Where the spindle starts, stops or turns back.

    Its line, the tool and the place of its tip, mm, the number of steps before it, and the index of its file.
    """

    line: int
    tool: int
    place: tuple[float, float, float]
    step: int
    file: int = 0


@dataclass(frozen=True, slots=True)
class Selection:
    """A T word: its line, its T number, and the index of its file."""

    line: int
    tool: int
    file: int = 0


@dataclass(frozen=True)
class Run:
    """A program as the machine would run it: n steps.

    Coordinates are those of the active work offset, mm. A coordinate is NaN where the text does not say it
    (before the first move, after a change of offsets), and z is +inf at the machine's upper end.
    """

    kind: Ints
    """(n,) int, see :class:`Kind`."""
    line: Ints
    """(n,) int, line of the text, from 1."""
    start: Array
    end: Array
    """Both (n, 3) float, mm."""
    centre: Array
    """(n, 2) float, mm; NaN unless an arc."""
    sweep: Array
    """(n,) float, rad, positive counter-clockwise; 0 unless an arc."""
    feed: Array
    """(n,) float, mm/min; 0 unless a feed move."""
    seconds: Array
    """(n,) float; time of a dwell."""
    arc_error: Array
    """(n,) float, mm: difference of an arc's radii at its start and its end."""
    state: Ints
    """(n,) int, index into ``states``."""
    states: tuple[State, ...]
    """The machine states."""
    remarks: tuple[Remark, ...] = field(default=())
    """Comments in order."""
    ended: bool = False
    """Whether the program says that it ends."""
    lines: int = 0
    """Number of lines read."""
    beyond: int = 0
    """Number of the first line of a program that stands behind its end, and is not run; 0 if none does."""
    unsaid: tuple[int, str] | None = None
    """Line of the first move that goes as an earlier program may have said, and the word to say it anew."""
    stored: tuple[int, str] | None = None
    """Line and word of the first G28 or G30 of Z to a place that somebody has stored in the control."""
    hoped: tuple[int, str] | None = None
    """The same of a move that goes as programs begin, unless an earlier one has left something else."""
    piece: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, dtype=np.bool_))
    """(n,) bool, whether the step is a piece of an arc in another plane than XY, and not its last one."""
    machine_xy: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, dtype=np.bool_))
    """(n,) bool, whether the step belongs to a move of X or Y to a place in machine coordinates (G53) or to
    a reference point (G28, G30): the way there by a point in the work, and the way from it."""
    writes: tuple[TableWrite, ...] = ()
    """What the program writes into tables of the control (G10), in order."""
    machine_places: tuple[MachinePlace, ...] = ()
    """Where moves in machine coordinates (G53) go, in order."""
    selected: tuple[Selection, ...] = ()
    """The T words in order, with or without a change to the tool; one that repeats itself is left out."""
    spindle_changes: tuple[SpindleChange, ...] = ()
    """Where the spindle starts, stops or turns back, in order."""
    files: tuple[str, ...] = ()
    """Names of the files that were run one after the other; empty if it was one text."""
    file: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    """(n,) int, index into ``files``."""

    def __len__(self) -> int:
        return int(self.kind.size)

    @cached_property
    def tool(self) -> Ints:
        """(n,) T number in the spindle."""
        return np.array([state.tool for state in self.states], dtype=np.int64)[self.state]

    @cached_property
    def radius(self) -> Array:
        """(n,) radius of arcs at their start, mm; NaN elsewhere."""
        return np.hypot(self.start[:, 0] - self.centre[:, 0], self.start[:, 1] - self.centre[:, 1])

    @cached_property
    def cutting(self) -> NDArray[np.bool_]:
        """(n,) whether the step is a feed move."""
        cutting: NDArray[np.bool_] = (self.kind == Kind.FEED) | (self.kind == Kind.ARC)
        return cutting

    @cached_property
    def moving(self) -> NDArray[np.bool_]:
        """(n,) whether the step moves the tool in work coordinates."""
        moving: NDArray[np.bool_] = self.cutting | (self.kind == Kind.RAPID)
        return moving

    def only(self, steps: Ints) -> "Run":
        """Some of the steps, without remarks and what else counts steps."""
        names = (*COLUMNS, *(name for name in ("piece", "machine_xy", "file") if getattr(self, name).size))
        return replace(
            self,
            **{name: getattr(self, name)[steps] for name in names},
            remarks=(),
            writes=(),
            machine_places=(),
            spindle_changes=(),
        )

    def of_states(self, value: "Callable[[State], Any]") -> NDArray[Any]:
        """(n,) a value of the state that each step runs in."""
        return np.array([value(state) for state in self.states])[self.state]

    @cached_property
    def length(self) -> Array:
        """(n,) length of path, mm; NaN or inf where an end is unknown or at the machine's upper end."""
        # At the machine's upper end inf - inf is an honest "unknown".
        with np.errstate(invalid="ignore"):
            move = self.end - self.start
        flat = np.where(self.kind == Kind.ARC, np.abs(self.sweep) * self.radius, np.hypot(*move[:, :2].T))
        return np.hypot(flat, move[:, 2])


def joined(names: tuple[str, ...], runs: "Sequence[Run]") -> Run:
    """Several files, run one after the other; between two of them the machine is where it happens to be."""
    states: list[State] = []
    remarks: list[Remark] = []
    writes: list[TableWrite] = []
    places: list[MachinePlace] = []
    selected: list[Selection] = []
    changes: list[SpindleChange] = []
    first: list[int] = []
    step = 0
    for file, run in enumerate(runs):
        first.append(len(states))
        states += run.states
        remarks += [Remark(r.line, r.text, r.step + step) for r in run.remarks]
        writes += [replace(write, step=write.step + step) for write in run.writes]
        places += [replace(place, step=place.step + step) for place in run.machine_places]
        selected += [replace(selection, file=file) for selection in run.selected]
        changes += [replace(change, step=change.step + step, file=file) for change in run.spindle_changes]
        step += len(run)

    return Run(
        **{
            name: np.concatenate([getattr(run, name) for run in runs])
            for name in (COLUMNS.keys() - {"state"}) | {"piece", "machine_xy"}
        },
        state=np.concatenate([run.state + at for run, at in zip(runs, first, strict=True)]),
        states=tuple(states),
        remarks=tuple(remarks),
        writes=tuple(writes),
        machine_places=tuple(places),
        selected=tuple(selected),
        spindle_changes=tuple(changes),
        ended=all(run.ended for run in runs),
        lines=runs[-1].lines,
        beyond=max(run.beyond for run in runs),
        unsaid=next((run.unsaid for run in runs if run.unsaid), None),
        stored=next((run.stored for run in runs if run.stored), None),
        hoped=next((run.hoped for run in runs if run.hoped), None),
        files=names,
        file=np.repeat(np.arange(len(runs)), [len(run) for run in runs]),
    )
