"""A machining program that no control has touched yet: what a post turns into text.

Coordinates are those of the work offset, mm: x and y from the origin the setup sheet names, z = 0 on top of
the stock. Feeds are mm/min.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.posting import Compensation, Measured, Posting
from mechwright_cam.shop.tool import Tool

OPERATION_COMMENT = "operation: "
"""How a program's text names the operation that follows, in a comment; times are reported by that name."""


@dataclass(frozen=True, slots=True)
class Rapid:
    """A positioning move; an axis that is None stays where it is."""

    x: float | None = None
    y: float | None = None
    z: float | None = None


@dataclass(frozen=True, slots=True)
class Feed:
    """A straight cut; an axis that is None stays where it is.

    With a ``side`` it turns cutter compensation on (G41 ``"left"`` or G42 ``"right"`` of the contour, with
    the tool's D number) or ``"off"`` (G40). From the end of the one on to the end of the last move before the
    other, coordinates are those of the contour, and the control keeps the tool beside it.
    """

    x: float | None
    y: float | None
    z: float | None
    feed: float
    side: Literal["left", "right", "off"] | None = None


@dataclass(frozen=True, slots=True)
class FeedArc:
    """A circular cut in XY, a helix where z differs from the present one.

    ``i`` and ``j`` lead from the start to the centre. An end equal to the start is a full turn.
    """

    x: float
    y: float
    z: float | None
    i: float
    j: float
    ccw: bool
    feed: float


@dataclass(frozen=True, slots=True)
class Drill:
    """A hole: rapid over it and down to ``retract``, feed to ``bottom``, rapid out to the height it began at.

    With ``peck`` it is drilled in pecks of so many mm. After each peck the drill comes out of the hole, or if
    ``breaking`` it only draws back a little, so that the chip breaks.
    """

    x: float
    y: float
    bottom: float
    retract: float
    feed: float
    peck: float | None = None
    dwell: float = 0.0
    breaking: bool = False


@dataclass(frozen=True, slots=True)
class Tap:
    """A tapped hole: rapid over it and down to ``retract``; in to ``bottom`` and out, a pitch in every turn.

    The spindle turns back at the bottom, after ``dwell`` seconds; the tool is back at the height it began at.
    """

    x: float
    y: float
    bottom: float
    retract: float
    feed: float
    dwell: float = 0.0


@dataclass(frozen=True, slots=True)
class Pause:
    """The machine stops until the operator goes on, at a safe height with spindle and coolant off."""

    message: str


Move = Rapid | Feed | FeedArc | Drill | Tap | Pause


@dataclass(frozen=True)
class Operation:
    """A named run of moves with one tool, for comments, setup sheet and proof.

    ``tolerance``: so far off the path the control may round its corners, mm, 0 for not at all; None for what
    the control is usually asked for.
    """

    name: str
    moves: tuple[Move, ...]
    tolerance: float | None = None


@dataclass(frozen=True)
class ToolSection:
    """Everything between two tool changes. The first move is a Rapid with x and y."""

    tool: Tool
    spindle: float
    coolant: Literal["flood", "mist", "off"]
    operations: tuple[Operation, ...]


@dataclass(frozen=True)
class Program:
    """A whole program.

    Parameters
    ----------
    name
        Stem of its file.
    work_offset
        ``"G54"`` to ``"G59"``, or one of the extended offsets of a control.
    clearance
        Height of rapid moves, mm.
    notes
        Lines for the head: part, material, stock, origin.
    sections
        In cutting order.
    machine
        The mill, whose places the program goes to between tools and at its end.
    posting
        How the text is written.
    measured
        Offsets as measured, where they are to stand in the text.
    compensation
        What D holds where the moves turn cutter compensation on.
    wear_limit
        By so much D may differ from what is planned, up or down, as a radius, mm.
    more_offsets
        Further work offsets, at which each tool makes the same moves before the next is changed to.
    """

    name: str
    work_offset: str
    clearance: float
    sections: tuple[ToolSection, ...]
    notes: tuple[str, ...] = field(default=())
    machine: Machine = field(default=Machine())
    posting: Posting = field(default=Posting())
    measured: Measured = field(default=Measured())
    compensation: Compensation = field(default="computer")
    wear_limit: float = field(default=0.0)
    more_offsets: tuple[str, ...] = field(default=())

    @property
    def offsets(self) -> tuple[str, ...]:
        """All work offsets, in the order in which they are gone to."""
        return (self.work_offset, *self.more_offsets)

    @cached_property
    def compensated(self) -> tuple[Tool, ...]:
        """The tools that cut with compensation, in order of first use."""
        found = {
            section.tool.number: section.tool
            for section in self.sections
            for operation in section.operations
            if any(isinstance(move, Feed) and move.side is not None for move in operation.moves)
        }
        return tuple(found.values())

    @property
    def tools(self) -> tuple[Tool, ...]:
        """The tools in order of first use, each once."""
        return tuple({section.tool.number: section.tool for section in self.sections}.values())
