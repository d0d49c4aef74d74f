"""The blocks that may stand in a program, for each control; any other block cannot be checked.

A row is an action and the words of a block: ``X#`` is a letter with a number, ``[...]`` may be absent, and of
``name:A|B`` one is there and is kept by that name. Words of G-code are matched in the order G, M, T, H, D, S,
X, Y, Z, I, J, R, Q, P, F, however the block has them; a word that stands twice matches nothing.
"""

import re
from dataclasses import dataclass

ORDER = ("G", "SUPA", "COMPOF", "M", "T", "H", "D", "S", "X", "Y", "Z", "I", "J", "R", "Q", "P", "F")
OFFSETS = "offset:G54|G55|G56|G57|G58|G59"

MOVES = (
    ("move", "[motion:G0|G1|G2|G3] [X#] [Y#] [Z#] [I#] [J#] [F#]"),
    ("offset", OFFSETS),
    ("start", f"[{OFFSETS}] turn:M3|M4 S#"),
    ("stop", "M5"),
    ("coolant", "coolant:M7|M8|M9"),
    ("pause", "M0|M1"),
    ("end", "M2|M30"),
)
RS274 = (
    *MOVES,
    ("machine", "G0 G53 [X#] [Y#] [Z#]"),
    ("dwell", "G4 P#"),
    ("cancel", "G80"),
)
CYCLES = (
    ("ready", "T#"),
    ("length", "[G0] G43 H# Z#"),
    ("change", "M6 T#"),
    ("cycle", "cycle:G81 G98 X# Y# Z# R# [F#]"),
    ("cycle", "cycle:G82 G98 X# Y# Z# R# P# [F#]"),
    ("cycle", "cycle:G83 G98 X# Y# Z# R# Q# [F#]"),
    ("cycle", "cycle:G73 G98 X# Y# Z# R# Q# [F#]"),
)
LINUXCNC = (
    *RS274,
    *CYCLES,
    ("modes", "G17 units:G20|G21 G40 G49 G80 G90 G91.1 G94"),
    ("corners", "G64 Q# P#"),
    ("corners", "G61"),
)
MACH3 = (
    *RS274,
    *CYCLES,
    ("modes", "G17 units:G20|G21 G40 G49 G80 G90 G91.1 G94"),
    ("nothing", "G61|G64"),
)
FANUC = (
    *MOVES,
    *CYCLES,
    ("dwell", "G4 P#"),
    ("cancel", "G80"),
    ("modes", "G17 units:G20|G21 G40 G49 G80 G90 G94"),
    ("home", "G28 G91 Z#"),
    ("absolute", "G90"),
    ("nothing", "G61|G64"),
)
HAAS = (*FANUC, ("machine", "G0 G53 [X#] [Y#] [Z#]"))
GRBL = (
    *RS274,
    ("change", "T#"),
    ("modes", "G17 units:G20|G21 G40 G49 G80 G90 G91.1 G94"),
    ("touched", "G49"),
    ("measured", "[G0] G43.1 Z#"),
)
SIEMENS = (
    *MOVES,
    ("nothing", "G60|G64"),
    ("dwell", "G4 F#"),
    ("modes", "G17 G40 G90 G94 units:G700|G710 COMPOF"),
    ("machine", "G0 SUPA D# [X#] [Y#] [Z#]"),
    ("select", "T#"),
    ("change", "M6"),
    ("length", "[G0] D# Z#"),
)
KLARTEXT = (
    ("modes", "BEGIN PGM NAME units:MM|INCH"),
    ("end", "M30"),
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
    ("call", "TOOL CALL N# Z S#"),
    ("ready", "TOOL DEF N#"),
    ("start", "turn:M3|M4"),
    ("stop", "M5"),
    ("coolant", "coolant:M7|M8|M9"),
    ("pause", "M0|M1"),
)

NUMBER = r"[-+]?(?:\d{1,9}\.?\d{0,9}|\.\d{1,9})"
WORD = re.compile(rf"(SUPA|COMPOF|[A-Z])({NUMBER})?")


def pattern(row: str) -> re.Pattern[str]:
    """The expression that a row stands for."""
    terms = []
    for term in row.split():
        name, _, choice = term.strip("[]").rpartition(":")
        words = []
        for word in choice.split("|"):
            stem, number, _ = word.partition("#")
            key = stem[-1] if stem.endswith("=N") else stem
            stem = stem.removesuffix("N") if number and key == "N" else stem
            words.append(re.escape(stem) + (f"(?P<{key}>{NUMBER})" if number else ""))
        found = f"(?P<{name}>{'|'.join(words)})" if name else f"(?:{'|'.join(words)})"
        terms.append(f"(?:{found} )?" if term.startswith("[") else f"{found} ")
    return re.compile("".join(terms))


@dataclass(frozen=True)
class Dialect:
    """A control: its rows, the longest line, and whether a length without a point is something else there."""

    rows: tuple[tuple[str, str], ...]
    longest: int = 250
    point: bool = False
    klartext: bool = False
    gap: float = 0.254
    """Height above the last peck at which the next one is fed, mm."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "table", [(action, pattern(row)) for action, row in self.rows])


DIALECTS = {
    "linuxcnc": Dialect(LINUXCNC),
    "fanuc": Dialect(FANUC, point=True, gap=1.0),
    "haas": Dialect(HAAS, point=True, gap=1.27),
    "mach3": Dialect(MACH3),
    "grbl": Dialect(GRBL, longest=80),
    "siemens-840d": Dialect(SIEMENS),
    "heidenhain-tnc": Dialect(KLARTEXT, klartext=True),
}
