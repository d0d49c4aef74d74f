"""How controls differ in reading the same text, and how far they leave the path that it programs."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

ROUGH = 0.02
"""Where a program gives tolerances, roughing may be rounded by so much, mm: a tenth of the least that it
leaves to finishing, and no program gets faster by more."""


@dataclass(frozen=True, slots=True)
class Corners:
    """What one control does at corners.

    A control that follows the path within a setting of the machine counts as exact here: no word of a program
    can change that. Where a word lets it go further, that word counts.
    """

    unsaid: float = 0.0
    """How far the control may leave the path while the program has chosen neither G61 nor G64, mm; inf
    without a bound."""
    after_g64: float = 0.0
    """The same after a G64 that gives no tolerance."""
    tolerance: bool = False
    """Whether G64 takes a tolerance, P (and Q)."""
    looser: tuple[tuple[int, str, frozenset[float], str], ...] = ()
    """Words that let the control go further than its setting: code in tenths, letter, the values of it that
    do not, what to do instead."""

    def bound(self, blend: float | None, merge: float | None) -> float:
        """How far the control may leave the path after G64 with P ``blend`` and Q ``merge``, mm.

        LinuxCNC first merges lines into one that passes within Q (as wide as P if there is no Q), then rounds
        the corners of what it has made within P; P 0 is to it no tolerance at all.

        >>> free = float("inf")
        >>> linuxcnc = Corners(unsaid=free, after_g64=free, tolerance=True)
        >>> linuxcnc.bound(0.002, None), linuxcnc.bound(0.002, 0.0)
        (0.004, 0.002)
        >>> linuxcnc.bound(0.0, 0.0), linuxcnc.bound(None, 0.01)
        (inf, inf)
        """
        if blend is None or not blend > 0:
            return self.after_g64
        return blend + (blend if merge is None or merge < 0 else merge)


EXACT = Corners()
"""A control that follows the path, or whose settings alone say how far it leaves it."""


PECK_CLEARANCE = 0.254
"""How far above the last depth a peck starts, mm: LinuxCNC's 0.010 inch."""
USUAL_M = frozenset({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 30})
"""M codes that mean the same on nearly every mill."""


class OffsetTable(NamedTuple):
    """One use of G10: its L, the letters of the values that it writes, and the least and greatest P."""

    number: int
    letters: str
    first: int = 1
    last: float = math.inf


@dataclass(frozen=True, slots=True)
class Dialect:
    """What one control understands, and what it means by it."""

    g_codes: frozenset[int]
    """G codes that are interpreted, in tenths (``591`` is G59.1)."""
    m_codes: frozenset[int] = USUAL_M
    """M codes that are interpreted."""
    m_words: tuple[tuple[int, int], ...] = ()
    """Usual M codes that the control spells otherwise, each with its own; the usual one is then none of its
    words, unless it spells another of them."""
    unsupported: tuple[tuple[int, str], ...] = ()
    """G codes in tenths that the control knows and this interpreter refuses, each with what to do instead."""
    inert: tuple[tuple[int, str], ...] = ()
    """G codes in tenths that change no path (smoothing, S in rev/min, a cancel of what is refused anyway),
    each with the letters that belong to it."""
    inert_with: frozenset[int] = frozenset()
    """Those of them that say nothing without the first of their letters, and are refused so."""
    inert_m: frozenset[int] = frozenset()
    """M codes that change nothing the proof asks about."""
    dwell_unit: float = 1.0
    """Seconds per unit of P in G4."""
    bare_dwell_unit: float | None = None
    """The same for a P without a decimal point; None if the point makes no difference."""
    dwells_first: bool = True
    """Whether a dwell beside a move is carried out before it, and not as nobody has said."""
    whole_dwells: bool = False
    """Whether P of a dwell has no decimal point."""
    one_unit: bool = False
    """Whether a program keeps to the units that it has stated first."""
    absolute_centres: bool = False
    """Whether I and J are absolute coordinates at the start of a program."""
    semicolon_comments: bool = True
    """Whether ``;`` starts a comment that runs to the end of the line."""
    peck_clearance: float = PECK_CLEARANCE
    """How far above the last depth the next peck of G83 starts, and how far G73 draws back, mm."""
    arc_absolute: float = 0.0283
    arc_relative: float = 0.001
    """The control refuses an arc whose radii differ by more than both, in mm and as a part of the radius."""
    arc_inch: float = 1.0
    """So many times ``arc_absolute`` and ``arc_most`` are in inches (G20)."""
    arc_of_larger: bool = False
    """Whether that part is of the larger radius, and not of that at the start."""
    arc_least: float = 0.0
    """The control refuses an arc of no larger radius, mm."""
    arc_least_turn: float = 0.0
    """The control takes an arc that turns by less for a full circle, rad."""
    arc_chord: float | None = None
    """By so much half the distance of the ends may be larger than R, mm; None for ``arc_absolute``. Below 0
    where the control's rounding may find R too small for a half circle."""
    arc_turns: bool = False
    """Whether P of an arc is the number of its turns."""
    arc_entry: bool = True
    """Whether cutter compensation may be turned on along an arc."""
    idle_most: float = math.inf
    """Blocks in a row without X and Y past which the control sees the next move beside compensation."""
    digits: int | None = None
    """So many digits of a number the control reads, zeros at its front included; None for all."""
    line_length: int = 255
    """Longest line, characters."""
    ascii_comments: bool = False
    """Whether comments have to be ASCII as well: some controls obey other bytes, or cannot store them."""
    active_comments: tuple[str, ...] = ()
    """Beginnings of comments, in small letters, that the control carries out and this interpreter refuses."""
    capitals: bool = False
    """Whether words have to be written in capitals."""
    largest_n: int = 99_999
    """Largest line number."""
    entry_along_z: bool = True
    """Whether a move of Z alone may stand between G41 or G42 and the move to the contour."""
    parts_of_n: bool = False
    """Whether a line number may have decimals."""
    one_m: bool = False
    """Whether a line may hold one M code only, as the control would drop the others."""
    mode_ends_feed: bool = False
    """Whether G94 takes the feed back, though it was in force, so that F has to be stated anew."""
    both_coolants: bool = True
    """Whether M7 and M8 may stand in one line."""
    stored_homes: frozenset[str] = frozenset({"G30"})
    """Which of G28 and G30 go to a place that operators or makers set, not to the reference point."""
    axis_commands: frozenset[int] = frozenset()
    """G codes in tenths, other than motions, that take the axis words of their block: the control refuses a
    block with two of them, or with one beside a motion code."""
    drops_axes: frozenset[int] = frozenset()
    """Those of them that take the axis words and do nothing with them."""
    motion_for_axes: bool = False
    """Whether the control refuses every axis word while G80 is in force, also beside G10, G28 and G43.1."""
    arc_needs_end: bool = False
    """Whether an arc has to name an axis of its plane, so that I and J alone are no full circle."""
    highest_tool: float = math.inf
    """The highest T that the control takes."""
    tables: tuple[OffsetTable, ...] = (
        OffsetTable(2, "XYZ", 0, 6),
        *(OffsetTable(number, "R") for number in (10, 11, 12, 13)),
        OffsetTable(20, "XYZ", 1, 300),
    )
    """What the control writes by G10."""
    tapping: Literal["", "G33.1", "M29", "always"] = ""
    """What keeps feed and spindle together: a code of its own, an M code before the cycle, every cycle, or
    nothing."""
    taps_out: bool = False
    """Whether a tapping cycle feeds out as far as it goes up, and not only to the R plane."""
    change_stops_spindle: bool = True
    """Whether M6 stops the spindle."""
    change_stops_coolant: bool = False
    """Whether M6 may stop the coolant, so that it has to be stated anew."""
    feed_mode_stays: bool = False
    """Whether G95, feeds by revolution, may hold from an earlier program, so that G94 has to be stated."""
    usual: frozenset[str] = frozenset()
    """Words that hold at the start unless an earlier program has left others (G94, G91.1): that a program
    does without them is told, and not refused."""
    cycles_apart: bool = False
    """Whether cycles are no motions: behind G80 the motion before the cycle is in force again."""
    starts_first: bool = True
    """Whether M3 and M4 beside a move are carried out before it, and not as the builder has set it."""
    stops_behind: bool = False
    """Whether M5 and M9 beside a move are carried out behind it."""
    repeats: str = "L"
    """The letter by which a drilling cycle says how often it is run."""
    ends_cycles: bool = False
    """Whether a drilling cycle has to be ended by G80, or a move, before G28 and G30."""
    percent_ends: bool = True
    """Whether a second ``%`` line ends the program as M2 does."""
    percent: bool = True
    """Whether a line may be a ``%`` at all."""
    arc_most: float = math.inf
    """The control refuses any arc whose radii differ by more, mm."""
    counts_code: bool = False
    """Whether blanks and comments count for the length of a line."""
    decimals: int = 4
    """Decimals of a coordinate, mm, that the control keeps."""
    decimals_inch: int = 5
    """The same of a coordinate in inches."""
    point_needed: bool = False
    """Whether a length or feed without a decimal point would mean thousandths; it is refused then."""
    feeds_with_point: Literal["", "inch", "always"] = ""
    """Where a feed without a decimal point may be another: F15 is 0.15 inch/min, 0.015 mm/min on Haas."""
    whole_words: str = ""
    """Letters, of S, T, H, D, L and M, whose numbers have no decimal point, or the control gives an alarm."""
    arc_idle: bool = False
    """Whether an arc may name the centre's third distance, across its plane, as 0."""
    program_numbers: bool = False
    """Whether a line may be a program number, O1234."""
    tool_by_t: bool = False
    """Whether a tool counts as changed at its T word, by hand, because there is no M6."""
    forbidden: str = ""
    """Characters that the control obeys out of the stream, wherever they stand."""
    macros: Callable[..., Any] | None = None
    """Gives the lines that are run of a program that works out its values and its way, such as
    :class:`mechwright_cam.controls.reading.macros.Macros`; None if the control has no such programs."""
    calls: Literal["98", "97"] | None = None
    """The M code that calls subprograms of the same file; None if none are read so."""
    translate: Callable[[str, bool], str] | None = None
    """Gives a program of another language in words that are read here, line by line; with True lines that
    start with ``/`` are skipped. None if the control has these words itself."""
    home_cancels_length: bool = False
    """Whether G28 of Z may end G43, so that it has to be stated anew."""
    length_moves: str = ""
    """What in the control lets G43 and G49 move Z by the length themselves, so that the height has to stand
    beside them; empty where they move nothing."""
    numbers_needed: str = ""
    """Letters, of D and H, that G41, G42 and G43 do not take from the tool where they are not written."""
    length_write: tuple[int, str] | None = (1, "Z")
    """L of the G10 that sets a tool's length, and the letter of the length; None without such a table."""
    bare_home: bool = True
    """Whether G28 without an axis sends all of them home."""
    corners: Corners = EXACT
    """How far the control leaves the path between two moves."""
    name: str = "the control"
    """Name for messages; a control gives its own title."""

    @property
    def centres_stay(self) -> bool:
        """Whether G90.1, absolute centres of arcs, may hold from an earlier program."""
        return 901 in self.g_codes

    @property
    def inert_g(self) -> frozenset[int]:
        """G codes in tenths that change no path."""
        return frozenset(code for code, _ in self.inert)

    @property
    def chord_slack(self) -> float:
        """By so much half the distance of an arc's ends may be larger than its R, mm."""
        return self.arc_absolute if self.arc_chord is None else self.arc_chord

    def refuses(self, first: Any, last: Any, inches: bool) -> Any:
        """Whether arcs are refused whose radii at the start and at the end are these; (n,) or one, mm.

        >>> Dialect(frozenset()).refuses(10.0, 10.02, False), Dialect(frozenset()).refuses(10.0, 10.03, False)
        (np.False_, np.True_)
        """
        factor, error = self.arc_inch if inches else 1.0, np.abs(np.subtract(first, last))
        part = self.arc_relative * (np.maximum(first, last) if self.arc_of_larger else first)
        beyond = (error > self.arc_absolute * factor) & (error > part)
        small = np.minimum(first, last) <= self.arc_least
        return beyond | (error > self.arc_most * factor) | small

    def m(self, code: int) -> int:
        """The control's own M code for a usual one.

        >>> dialect = Dialect(frozenset(), m_words=((8, 108),))
        >>> dialect.m(8), dialect.m(9)
        (108, 9)
        """
        return dict(self.m_words).get(code, code)

    def standard_m(self, code: int) -> int | None:
        """The usual M code for one of the control's own; None for a usual one that is none of its words.

        >>> dialect = Dialect(frozenset(), m_words=((8, 108),))
        >>> dialect.standard_m(108), dialect.standard_m(9), dialect.standard_m(8)
        (8, 9, None)
        """
        if not self.m_words:
            return code
        for usual, own in self.m_words:
            if code == own:
                return usual
        return None if code in dict(self.m_words) else code


CENTRE = "shift the origin with a work offset"
FEEDS = "write feeds in units per minute (G94)"
_MACRO = "macros and subprograms are not read; post the program without them"

RETURN = 300
"""G30: to the second reference point."""
MILLING = frozenset(
    {
        0,
        10,
        20,
        30,
        40,
        280,
        RETURN,
        530,
        170,
        180,
        190,
        410,
        420,
        200,
        210,
        400,
        430,
        490,
        540,
        550,
        560,
        570,
    }
    | {580, 590, 610, 640, 800, 810, 820, 830, 900, 910, 940, 100, 730, 850, 890, 980, 990, 840}
)
"""G codes that Fanuc and those who follow it share, in tenths."""
NOT_SIMULATED = (
    (650, _MACRO),
    (660, _MACRO),
    (520, CENTRE),
    (920, CENTRE),
    (930, FEEDS),
    (950, FEEDS),
    (680, "rotation is not simulated"),
    (510, "scaling is not simulated"),
)
"""G codes that they share as well, and that are refused, each with what to do."""
