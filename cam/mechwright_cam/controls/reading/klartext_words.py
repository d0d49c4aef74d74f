"""The words of Klartext blocks: which are read, as what, and what is said of the others."""

import re

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading.blocks import fail
from mechwright_cam.controls.reading.characters import NO_LINE_END
from mechwright_cam.controls.reading.groups import STOPPING

NAME = "HEIDENHAIN"
LONGEST = 128
"""Characters of a block."""
MOST_M = 2
"""M functions of a block."""
M_CODES = frozenset({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 30})
"""M codes of the interpreter that blocks come to."""
BOTH_M = {13: "M3 M8", 14: "M4 M8"}
"""M functions that are two others."""
AT_THE_END = frozenset({0, 1, 2, 5, 9, 30})
"""M functions that act when the move of their block is done."""
AT_THE_START = frozenset({3, 4, 7, 8, 13, 14})
"""Those that act before it."""
NO_CYCLE = "cycles are not read; post the moves"
_SHIFT = "shifts or turns the work; set a preset with CYCL DEF 247"
NO_JUMP = "parameters, jumps and calls are not read; post the program without them"
_ROUNDED = "write L, C with CC, CR or CP"
CYCLES = {
    **dict.fromkeys((7, 8, 10, 11, 19, 26), _SHIFT),
    12: NO_JUMP,
    13: "it turns the spindle; post the program without it",
}
"""Cycles that are refused with other words than the rest."""
REFUSED = {
    **dict.fromkeys(("LBL", "CALL", "FN", "Q", "QL", "QR", "QS", "SEL", "PGM", "REP", "DECLARE"), NO_JUMP),
    **dict.fromkeys(("RND", "CHF", "CT", "CTP", "LP", "APPR", "DEP", "LN", "SPL"), _ROUNDED),
    **dict.fromkeys(("FL", "FC", "FLT", "FCT", "FPOL"), _ROUNDED),
    **dict.fromkeys(("PLANE", "TRANS", "FUNCTION"), _SHIFT),
    **dict.fromkeys(("TCH", "PATTERN"), NO_CYCLE),
    **dict.fromkeys(("RL", "RR"), "cutter compensation is not read; post the path of the tool's centre, R0"),
    **dict.fromkeys(("IX", "IY", "IPR"), "write places as absolute coordinates"),
    "IZ": "write heights as absolute coordinates; IZ is read with CP",
    "PA": "write IPA, the angle from where the tool stands",
    "FAUTO": "write the feed",
    **dict.fromkeys(("FT", "FZ", "FU"), "write feeds in mm/min, or in tenths of an inch a minute"),
    **dict.fromkeys(("A", "B", "U", "V", "W"), "this is a three-axis interpreter"),
    "M6": "write TOOL CALL, which changes the tool",
    **dict.fromkeys(("M89", "M99"), NO_CYCLE),
    "M92": "its datum is the machine builder's own; write M91",
    "M140": "it goes as far as the machine can; write L Z R0 FMAX M91",
    **dict.fromkeys(
        ("M90", "M103", "M112", "M124", "M136"), "it changes path or feed as it likes; take it out"
    ),
}
"""Words that the control knows and that are not read, each with what to do instead."""
NUMBER = r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)"
"""A number, with a point or a comma."""
_WORD = re.compile(rf"([A-Z]+)(?:({NUMBER})|(?<=DR)([+-]))?(?= |$)")
_NAMED = re.compile(r"[A-Z]*")


def check_length(number: int, text: str) -> None:
    """Raise ProgramError for a line that is longer than a block."""
    if "\r" in text:
        raise fail(number, NO_LINE_END)
    if len(text) > LONGEST:
        raise fail(number, f"{len(text)} characters; {NAME} reads {LONGEST} in a block")


def plain(value: str) -> str:
    """A number as the interpreter reads it."""
    return value.replace(",", ".").removeprefix("+")


def worked_out(value: float) -> str:
    """A number that was worked out."""
    return f"{value:.9f}".rstrip("0").rstrip(".")


def words_of(number: int, code: str, letters: str | tuple[str, ...]) -> dict[str, str]:
    """Name and value of each word behind the first: R0 as G40, DR as G2 or G3, M functions together."""
    words: dict[str, str] = {}
    first, *pieces = code.replace("F MAX", "FMAX").split()
    if not (first.isalpha() or first == "-"):
        raise refused(number, first)
    for piece in pieces:
        match = _WORD.fullmatch(piece)
        if match is None:
            raise refused(number, piece)
        name, value = match[1], plain(match[2] or "")
        if name == "M" and value.isdigit():
            words["M"] = f"{words.get('M', '')} M{int(value)}".strip()
            continue
        if name == "FMAX" and not value:
            name, value = "F", "MAX"
        elif name == "R" and "R" in letters and float(value or "0"):
            name = "RADIUS"
        elif (name, value) == ("R", "0"):
            value = "G40"
        elif name == "DR" and "DR" in letters and match[3]:
            value = "G3" if match[3] == "+" else "G2"
        elif name not in {"F", *letters} or not value or name in {"R", "DR"}:
            raise refused(number, piece)
        if name in words:
            raise fail(number, f"two {name} words in a block; take one out")
        words[name] = value
    return words


def functions_of(number: int, code: str, *, moving: bool) -> str:
    """M functions as the interpreter has them; M91 stays for who moves."""
    found = [int(word[1:]) for word in code.split()]
    if len(found) > MOST_M:
        raise fail(number, f"more than {MOST_M} M functions in a block")
    for m in found:
        if m == 91 and moving:
            continue
        if m not in AT_THE_START | AT_THE_END:
            raise refused(number, f"M{m}")
        if moving and m in AT_THE_END - STOPPING:
            raise fail(number, f"M{m} beside a move acts at its end; write it in a block behind it")
    return " ".join(BOTH_M.get(m, f"M{m}") for m in found)


def refused(number: int, word: str) -> ProgramError:
    """The error of a word that is not read, with what to do instead."""
    if (worked := re.match(r"([A-Z]+)[+-]?Q[LRS]?\d", word)) is not None:
        return fail(number, f"{word} is a Q parameter; write {worked[1]} with a plain number")
    found = _NAMED.match(word)
    name = word if word in REFUSED or found is None else found[0]
    what = REFUSED.get(name, "post the program without it")
    return fail(number, f"{word} is no word that is read in programs for {NAME}; {what}")


_DWELL = re.compile(rf"(?:DWELL|V\.ZEIT) ?({NUMBER})")
_TOLERANCE = re.compile(rf"(?:T ?({NUMBER}))?")


def dwell_of(number: int, rest: str) -> str:
    """The second block of cycle 9 as the interpreter has it."""
    match = _DWELL.fullmatch(rest)
    if match is None:
        raise fail(number, "CYCL DEF 9.1 needs DWELL and its seconds")
    return f"G4 P{plain(match[1])}"


def tolerance_of(number: int, rest: str) -> str:
    """The second block of cycle 32 as the interpreter has it."""
    match = _TOLERANCE.fullmatch(rest)
    if match is None:
        raise fail(number, "CYCL DEF 32.1 is read with T alone, how far the control may leave the path")
    if match[1] is None:
        return "G64"
    if not float(plain(match[1])) > 0:
        raise fail(number, "T of CYCL DEF 32.1 has to be above 0; without T the machine's setting holds")
    return f"G64 P{plain(match[1])} Q0"
