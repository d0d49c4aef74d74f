"""How controls differ in reading the same text."""

import math
from dataclasses import dataclass

from mechwright_cam.controls.reading.corners import EXACT, LINUXCNC_CORNERS, Corners

PECK_CLEARANCE = 0.254
"""How far above the last depth a peck starts, mm: LinuxCNC's 0.010 inch."""


@dataclass(frozen=True, slots=True)
class Dialect:
    """What one control understands, and what it means by it.

    Parameters
    ----------
    name
        Name for messages.
    g_codes, m_codes
        Codes that are interpreted, G codes in tenths (``591`` is G59.1).
    unsupported
        G codes in tenths that the control knows and this interpreter refuses, each with what to do instead.
    inert
        G codes in tenths that change no path (smoothing, a cancel of what is refused anyway), each with the
        letters that belong to it.
    inert_m
        M codes that change nothing the proof asks about.
    dwell_unit
        Seconds per unit of P in G4.
    bare_dwell_unit
        The same for a P without a decimal point; None if the point makes no difference.
    absolute_centres
        Whether I and J are absolute coordinates at the start of a program.
    semicolon_comments
        Whether ``;`` starts a comment that runs to the end of the line.
    peck_clearance
        How far above the last depth the next peck of G83 starts, and how far G73 draws back, mm.
    arc_absolute, arc_relative
        The control refuses an arc whose two radii differ by more than both, in mm and as a part of the
        radius.
    line_length
        Longest line, characters.
    change_stops_spindle
        Whether M6 stops the spindle.
    percent_ends
        Whether a second ``%`` line ends the program as M2 does.
    percent
        Whether a line may be a ``%`` at all.
    arc_most
        The control refuses any arc whose radii differ by more, mm.
    counts_code
        Whether blanks and comments count for the length of a line.
    decimals
        Decimals of a coordinate, mm, that the control keeps.
    point_needed
        Whether a length or feed without a decimal point would mean thousandths; it is refused then.
    program_numbers
        Whether a line may be a program number, O1234.
    tool_by_t
        Whether a tool counts as changed at its T word, by hand, because there is no M6.
    length_table
        Whether the control has a table of tool lengths for G43 H.
    variables
        Whether parameters, expressions and O-words are worked out.
    numbers_needed
        Letters, of D and H, that G41, G42 and G43 do not take from the tool where they are not written.
    home_cancels_length
        Whether G28 of Z may end G43, so that it has to be stated anew.
    length_write
        L of the G10 that sets a tool's length, and the letter of the length; None without such a table.
    retract
        How a full retract is written; the machine's Z of it stands for ``{}``.
    switch_at_zero
        Whether machine Z0 is where the homing switch is, so that a retract ends below it.
    forbidden
        Characters that the control obeys out of the stream, wherever they stand.
    bare_home
        Whether G28 without an axis sends all of them home.
    corners
        How far the control leaves the path between two moves.
    """

    name: str
    g_codes: frozenset[int]
    m_codes: frozenset[int]
    unsupported: tuple[tuple[int, str], ...] = ()
    inert: tuple[tuple[int, str], ...] = ()
    inert_m: frozenset[int] = frozenset()
    dwell_unit: float = 1.0
    bare_dwell_unit: float | None = None
    absolute_centres: bool = False
    semicolon_comments: bool = True
    peck_clearance: float = PECK_CLEARANCE
    arc_absolute: float = 0.0283
    arc_relative: float = 0.001
    line_length: int = 255
    change_stops_spindle: bool = True
    percent_ends: bool = True
    percent: bool = True
    arc_most: float = math.inf
    counts_code: bool = False
    decimals: int = 4
    point_needed: bool = False
    program_numbers: bool = False
    tool_by_t: bool = False
    length_table: bool = True
    length_write: tuple[int, str] | None = (1, "Z")
    retract: str = "G53 G0 Z{}"
    switch_at_zero: bool = False
    forbidden: str = ""
    variables: bool = False
    home_cancels_length: bool = False
    numbers_needed: str = ""
    bare_home: bool = True
    corners: Corners = EXACT


_MOTION = {0, 10, 20, 30, 730, 800, 810, 820, 830, 850, 890}
_PLANE_UNITS = {170, 180, 190, 200, 210}
_OFFSETS = {100, 400, 410, 411, 420, 421, 430, 431, 490, 540, 550, 560, 570, 580, 590, 591, 592, 593}
_MODES = {40, 280, 530, 610, 611, 640, 900, 901, 910, 911, 940, 980, 990}

LINUXCNC = Dialect(
    name="LinuxCNC",
    variables=True,
    corners=LINUXCNC_CORNERS,
    g_codes=frozenset(_MOTION | _PLANE_UNITS | _OFFSETS | _MODES),
    m_codes=frozenset({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 30}),
    unsupported=(
        (300, "retract with G53 G0 Z0 or G28"),
        (840, "tapping is not simulated"),
        (920, "shift the origin with the work offset, G54 to G59.3"),
        (930, "write feeds in units per minute (G94)"),
        (950, "write feeds in units per minute (G94)"),
    ),
)
"""LinuxCNC 2.9, three axes. The arc limits are those of its interpreter's source in millimetres."""
