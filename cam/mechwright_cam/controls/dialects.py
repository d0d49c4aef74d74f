"""The dialects of the controls that the program writes for.

LinuxCNC's and Grbl's are from their documents and sources. Fanuc's, Haas's and Mach3's are common practice:
many details are settings of the machine, and docs/controls.md says which reading is taken here.
"""

from mechwright_cam.controls.dialect import LINUXCNC, Dialect
from mechwright_cam.controls.reading.corners import FANUC_CORNERS, GRBL_CORNERS, HAAS_CORNERS, MACH3_CORNERS

_TAPPING = "tapping is not simulated"
_CENTRE = "shift the origin with a work offset"
_FEEDS = "write feeds in units per minute (G94)"
_MACRO = "macros and subprograms are not read; post the program without them"

_COMMON = {0, 10, 20, 30, 40, 280, 530, 170, 180, 190, 410, 420, 200, 210, 400, 430, 490, 800, 810, 820, 830}
_COMMON |= {540, 550, 560, 570, 580, 590, 610, 640, 900, 910, 940, 100}
_CYCLES = {730, 850, 890, 980, 990}
_M = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 30}
_SHARED = (
    (650, _MACRO),
    (660, _MACRO),
    (740, _TAPPING),
    (840, _TAPPING),
    (520, _CENTRE),
    (920, _CENTRE),
    (930, _FEEDS),
    (950, _FEEDS),
    (680, "rotation is not simulated"),
    (510, "scaling is not simulated"),
)

FANUC = Dialect(
    name="Fanuc",
    bare_home=False,
    corners=FANUC_CORNERS,
    retract="G91 G28 Z0., then G90",
    home_cancels_length=True,
    numbers_needed="DH",
    length_write=(10, "R"),
    percent_ends=False,
    g_codes=frozenset(_COMMON | _CYCLES | {541, 300}),
    m_codes=frozenset(_M),
    unsupported=_SHARED,
    inert=((90, ""), (51, "QR"), (80, "P"), (150, ""), (500, ""), (690, "")),
    inert_m=frozenset({19}),
    dwell_unit=1.0,
    bare_dwell_unit=0.001,
    semicolon_comments=False,
    peck_clearance=1.0,
    decimals=3,
    point_needed=True,
    program_numbers=True,
    change_stops_spindle=True,
)
"""Fanuc 0i and 30i: milling, offset memory C, conventional decimal point."""

HAAS = Dialect(
    name="Haas",
    corners=HAAS_CORNERS,
    home_cancels_length=True,
    numbers_needed="DH",
    length_write=(10, "R"),
    percent_ends=False,
    g_codes=frozenset(_COMMON | _CYCLES | {1540, 300}),
    m_codes=frozenset(_M),
    unsupported=_SHARED,
    inert=((1030, "P"), (1870, "P"), (500, ""), (690, ""), (150, "")),
    inert_m=frozenset({19, 31, 33, 88, 89}),
    dwell_unit=1.0,
    bare_dwell_unit=0.001,
    semicolon_comments=False,
    peck_clearance=1.27,
    decimals=3,
    point_needed=True,
    program_numbers=True,
)
"""Haas mills; the next peck starts as setting 22 comes from the factory, 0.05 inch above the last depth."""

MACH3 = Dialect(
    name="Mach3",
    corners=MACH3_CORNERS,
    numbers_needed="H",
    g_codes=frozenset(_COMMON | _CYCLES | {901, 911, 300}),
    m_codes=frozenset(_M),
    unsupported=_SHARED,
    inert=((500, ""), (690, "")),
    inert_m=frozenset({48, 49}),
    semicolon_comments=False,
    percent=True,
    peck_clearance=0.254,
)
"""Mach3 mill, G4 in seconds."""

GRBL = Dialect(
    name="Grbl",
    corners=GRBL_CORNERS,
    switch_at_zero=True,
    g_codes=frozenset(
        {0, 10, 20, 30, 40, 100, 280, 300, 530, 170, 180, 190, 200, 210, 400, 431, 490, 800, 900, 910, 911}
        | {540, 550, 560, 570, 580, 590, 610, 940}
    ),
    m_codes=frozenset({0, 1, 2, 3, 4, 5, 7, 8, 9, 30}),
    unsupported=(
        (410, "Grbl has G40 only; post the path of the tool's centre"),
        (420, "Grbl has G40 only; post the path of the tool's centre"),
        (430, "Grbl has no table of lengths; write G43.1 Z"),
        (382, "probing is not simulated"),
        (383, "probing is not simulated"),
        (384, "probing is not simulated"),
        (385, "probing is not simulated"),
        (920, _CENTRE),
        (930, _FEEDS),
    ),
    arc_absolute=0.005,
    arc_most=0.5,
    line_length=80,
    counts_code=True,
    percent=False,
    decimals=3,
    tool_by_t=True,
    length_table=False,
    length_write=None,
    forbidden="?!~",
)
"""Grbl 1.1; arc limits are those of its source."""

DIALECTS = {"linuxcnc": LINUXCNC, "fanuc": FANUC, "haas": HAAS, "mach3": MACH3, "grbl": GRBL}
"""Name of a control to how it reads a program."""
