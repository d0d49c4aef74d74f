"""The blocks that may stand in a program, for each control; any other block cannot be checked.

A row is an action and the words of a block: ``X#`` is a letter with a number, ``[...]`` may be absent, and of
``name:A|B`` one is there and is kept by that name. Words of G-code are matched in the order G, M, T, H, D, S,
X, Y, Z, I, J, R, Q, P, F, however the block has them; a word that stands twice matches nothing.
"""

import re

ORDER = ("G", "SUPA", "COMPOF", "M", "T", "H", "D", "S", "X", "Y", "Z", "I", "J", "R", "Q", "P", "F")
NUMBER = r"[-+]?(?:\d{1,9}\.?\d{0,9}|\.\d{1,9})"
WORD = re.compile(rf"(SUPA|COMPOF|[A-Z])({NUMBER})?")
OFFSETS = "offset:G54|G55|G56|G57|G58|G59"
ALL = (
    ("start", "turn:M3|M4"),
    ("stop", "M5"),
    ("coolant", "coolant:M7|M8|M9"),
    ("pause", "stop:M0|M1"),
    ("end", "M2|M30"),
)
GCODE = (
    *ALL,
    ("move", "[motion:G0|G1|G2|G3] [X#] [Y#] [Z#] [I#] [J#] [F#]"),
    ("offset", OFFSETS),
    ("start", f"[{OFFSETS}] turn:M3|M4 S#"),
)
RS274 = (*GCODE, ("nothing", "G4 P#"), ("cancel", "G80"))
MACHINE = ("machine", "G0 G53 [X#] [Y#] [Z#]")
MODES = ("modes", "G17 units:G20|G21 G40 G49 G80 G90 G91.1 G94")
CHANGER = (
    *RS274,
    ("ready", "T#"),
    ("change", "M6 T#"),
    ("length", "[G0] G43 H# Z#"),
    ("cycle", "cycle:G81 G98 X# Y# Z# R# [F#]"),
    ("cycle", "cycle:G82 G98 X# Y# Z# R# P# [F#]"),
    ("cycle", "cycle:G73|G83 G98 X# Y# Z# R# Q# [F#]"),
)
FANUC = (
    *CHANGER,
    ("modes", "G17 units:G20|G21 G40 G49 G80 G90 G94"),
    ("home", "G28 G91 Z#"),
    ("absolute", "G90"),
    ("nothing", "G61|G64"),
)
SIEMENS = (
    *GCODE,
    ("nothing", "G60|G64"),
    ("nothing", "G4 F#"),
    ("modes", "G17 G40 G90 G94 units:G700|G710 COMPOF"),
    ("machine", "G0 SUPA D# [X#] [Y#] [Z#]"),
    ("ready", "T#"),
    ("change", "M6"),
    ("length", "[G0] D# Z#"),
)
KLARTEXT = (
    *ALL,
    ("modes", "BEGIN PGM NAME units:MM|INCH"),
    ("nothing", "END PGM NAME MM|INCH"),
    ("nothing", "CYCL DEF 247 DATUM SETTING ~"),
    ("preset", "Q339=N#"),
    ("nothing", "CYCL DEF 32.0 TOLERANCE"),
    ("corners", "CYCL DEF 32.1 T#"),
    ("nothing", "CYCL DEF 9.0 DWELL TIME"),
    ("nothing", "CYCL DEF 9.1 DWELL N#"),
    ("machine", "L [X#] [Y#] [Z#] R0 FMAX M91"),
    ("rapid", "L [X#] [Y#] [Z#] R0 FMAX"),
    ("feed", "L [X#] [Y#] [Z#] [F#]"),
    ("centre", "CC X# Y#"),
    ("arc", "C X# Y# turn:DR+|DR- [F#]"),
    ("helix", "CP IPA# IZ# turn:DR+|DR- [F#]"),
    ("change", "TOOL CALL N# Z S#"),
    ("ready", "TOOL DEF N#"),
)
ROWS = {
    "linuxcnc": (*CHANGER, MACHINE, MODES, ("corners", "G64 Q# P#"), ("corners", "G61")),
    "mach3": (*CHANGER, MACHINE, MODES, ("nothing", "G61|G64")),
    "fanuc": FANUC,
    "haas": (*FANUC, MACHINE),
    "grbl": (*RS274, MACHINE, MODES, ("change", "T#"), ("touched", "G49"), ("length", "[G0] G43.1 Z#")),
    "siemens-840d": SIEMENS,
    "heidenhain-tnc": KLARTEXT,
}
POINTS, GAP = {"fanuc", "haas"}, {"fanuc": 1.0, "haas": 1.27}
"""Where a length without a point is another; height above the last peck where a cycle feeds on, or 0.254."""


def pattern(row: str) -> re.Pattern[str]:
    """The expression that a row stands for."""
    terms = []
    for term in row.split():
        name, _, choice = term.strip("[]").rpartition(":")
        words = []
        for word in choice.split("|"):
            stem, number, _ = word.partition("#")
            key, text = ("N", stem.removesuffix("N")) if number and stem.endswith("N") else (stem, stem)
            words.append(re.escape(text) + (f"(?P<{key}>{NUMBER})" if number else ""))
        found = f"(?P<{name}>{'|'.join(words)})" if name else f"(?:{'|'.join(words)})"
        terms.append(f"(?:{found} )?" if term.startswith("[") else f"{found} ")
    return re.compile("".join(terms))
