"""How controls differ in reading the same text, and how far they leave the path that it programs."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from mechwright_cam.controls.words.kept import Kept, Then
from mechwright_cam.controls.words.table import Words

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


@dataclass(frozen=True, slots=True)
class Arcs:
    """The arcs that a control refuses, or takes for others."""

    absolute: float = 0.0283
    relative: float = 0.001
    """An arc is refused whose radii differ by more than both, in mm and as a part of the radius."""
    inch: float = 1.0
    """So many times ``absolute`` and ``most`` are in inches (G20)."""
    of_larger: bool = False
    """Whether that part is of the larger radius, and not of that at the start."""
    most: float = math.inf
    """Any arc is refused whose radii differ by more, mm."""
    least: float = 0.0
    """An arc of no larger radius is refused, mm."""
    least_turn: float = 0.0
    """An arc that turns by less is taken for a full circle, rad."""
    chord: float | None = None
    """By so much half the distance of the ends may be larger than R, mm; None for ``absolute``. Below 0
    where the control's rounding may find R too small for a half circle."""

    @property
    def chord_slack(self) -> float:
        """By so much half the distance of an arc's ends may be larger than its R, mm."""
        return self.absolute if self.chord is None else self.chord

    def refuses(self, first: Any, last: Any, inches: bool) -> Any:
        """Whether arcs are refused whose radii at the start and at the end are these; (n,) or one, mm.

        >>> Arcs().refuses(10.0, 10.02, False), Arcs().refuses(10.0, 10.03, False)
        (np.False_, np.True_)
        """
        factor, error = self.inch if inches else 1.0, np.abs(np.subtract(first, last))
        part = self.relative * (np.maximum(first, last) if self.of_larger else first)
        beyond = (error > self.absolute * factor) & (error > part)
        small = np.minimum(first, last) <= self.least
        return beyond | (error > self.most * factor) | small


@dataclass(frozen=True, slots=True)
class Text:
    """The lines and characters that a control reads."""

    longest: int = 255
    """Longest line, characters."""
    counts_code: bool = False
    """Whether blanks and comments do not count for that."""
    semicolon_comments: bool = True
    """Whether ``;`` starts a comment that runs to the end of the line."""
    ascii_comments: bool = False
    """Whether comments have to be ASCII as well: some controls obey other bytes, or cannot store them."""
    active_comments: tuple[str, ...] = ()
    """Beginnings of comments, in small letters, that the control carries out and this interpreter refuses."""
    capitals: bool = False
    """Whether words have to be written in capitals."""
    forbidden: str = ""
    """Characters that the control obeys out of the stream, wherever they stand."""
    digits: int | None = None
    """So many digits of a number the control reads, zeros at its front included; None for all."""
    percent: bool = True
    """Whether a line may be a ``%`` at all."""
    percent_ends: bool = True
    """Whether a second ``%`` line ends the program as M2 does."""
    program_numbers: bool = False
    """Whether a line may be a program number, O1234."""


PECK_CLEARANCE = 0.254
"""How far above the last depth a peck starts, mm: LinuxCNC's 0.010 inch."""


@dataclass(frozen=True, slots=True)
class Dialect:
    """What one control understands, and what it means by it."""

    words: Words = field(default_factory=Words)
    """Which code takes which words."""
    text: Text = Text()
    arcs: Arcs = Arcs()
    kept: tuple[Kept, ...] = ()
    """The states that an earlier program may have left."""
    m_words: tuple[tuple[int, int], ...] = ()
    """Usual M codes that the control spells otherwise, each with its own; the usual one is then none of its
    words, unless it spells another of them."""
    dwell_unit: float = 1.0
    """Seconds per unit of P in G4."""
    bare_dwell_unit: float | None = None
    """The same for a P without a decimal point; None if the point makes no difference."""
    one_unit: bool = False
    """Whether a program keeps to the units that it has stated first."""
    peck_clearance: float = PECK_CLEARANCE
    """How far above the last depth the next peck of G83 starts, and how far G73 draws back, mm."""
    arc_entry: bool = True
    """Whether cutter compensation may be turned on along an arc."""
    idle_most: float = math.inf
    """Blocks in a row without X and Y past which the control sees the next move beside compensation."""
    entry_along_z: bool = True
    """Whether a move of Z alone may stand between G41 or G42 and the move to the contour."""
    mode_ends_feed: bool = False
    """Whether G94 takes the feed back, though it was in force, so that F has to be stated anew."""
    stored_homes: frozenset[str] = frozenset({"G30"})
    """Which of G28 and G30 go to a place that operators or makers set, not to the reference point."""
    tapping: Literal["", "G33.1", "M29", "always"] = ""
    """What keeps feed and spindle together: a code of its own, an M code before the cycle, every cycle, or
    nothing."""
    taps_out: bool = False
    """Whether a tapping cycle feeds out as far as it goes up, and not only to the R plane."""
    change_stops_coolant: bool = False
    """Whether M6 may stop the coolant, so that it has to be stated anew."""
    stops_behind: bool = False
    """Whether M5 and M9 beside a move are carried out behind it."""
    decimals: int = 4
    """Decimals of a coordinate, mm, that the control keeps."""
    decimals_inch: int = 5
    """The same of a coordinate in inches."""
    tool_by_t: bool = False
    """Whether a tool counts as changed at its T word, by hand, because there is no M6."""
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
    length_write: tuple[int, str] | None = (1, "Z")
    """L of the G10 that sets a tool's length, and the letter of the length; None without such a table."""
    corners: Corners = EXACT
    """How far the control leaves the path between two moves."""
    name: str = "the control"
    """Name for messages; a control gives its own title."""

    @property
    def point_needed(self) -> bool:
        """Whether a length without a decimal point would mean thousandths; it is refused then."""
        return self.words.of("X").point == "needed"

    def then(self, state: str) -> Then | None:
        """What becomes of a program that has not set a state before it reads it; None if it is not kept."""
        return next((one.then for one in self.kept if one.name == state), None)

    def m(self, code: int) -> int:
        """The control's own M code for a usual one.

        >>> dialect = Dialect(m_words=((8, 108),))
        >>> dialect.m(8), dialect.m(9)
        (108, 9)
        """
        return dict(self.m_words).get(code, code)

    def standard_m(self, code: int) -> int | None:
        """The usual M code for one of the control's own; None for a usual one that is none of its words.

        >>> dialect = Dialect(m_words=((8, 108),))
        >>> dialect.standard_m(108), dialect.standard_m(9), dialect.standard_m(8)
        (8, 9, None)
        """
        if not self.m_words:
            return code
        for usual, own in self.m_words:
            if code == own:
                return usual
        return None if code in dict(self.m_words) else code
